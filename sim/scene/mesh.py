from __future__ import annotations
from dataclasses import dataclass
import numpy as np
@dataclass(frozen=True)
class Mesh:
    name: str
    vertices: np.ndarray
    faces: np.ndarray
    normals: np.ndarray
    repairs: dict
def vertex_normals(vertices, faces):
    p=vertices[faces]
    n=np.cross(p[:,1]-p[:,0],p[:,2]-p[:,0]); n/=np.maximum(np.linalg.norm(n,axis=1,keepdims=True),1e-300)
    out=np.zeros_like(vertices)
    for k in range(3):
        a=p[:,(k+1)%3]-p[:,k]; b=p[:,(k+2)%3]-p[:,k]
        ang=np.arctan2(np.linalg.norm(np.cross(a,b),axis=1),(a*b).sum(1))
        for i in range(3): out[:,i]+=np.bincount(faces[:,k],n[:,i]*ang,len(vertices))
    return out/np.maximum(np.linalg.norm(out,axis=1,keepdims=True),1e-300)
