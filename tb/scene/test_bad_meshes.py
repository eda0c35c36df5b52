# SPDX-License-Identifier: Apache-2.0
"""Every bad file is refused in one line that names it; sound files, and only those, are read."""

from pathlib import Path

import pytest
from polyshade.sim.errors import LONGEST, UserError
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.normals import joined

from tb.scene.bad_meshes import WRITERS, bad_meshes, plant


def test_sound_files_are_read(tmp_path: Path) -> None:
    """The writers of the corpus are not to blame: without a fault what they write is a tetrahedron."""
    for suffix, writers in WRITERS.items():
        for writer in writers:
            path = tmp_path / f"{writer.__name__}.{suffix}"
            path.write_bytes(writer())
            mesh = load_mesh(str(path))
            assert len(joined(mesh.vertices)[0]) == 4
            assert mesh.faces.shape == (4, 3)


def test_names_are_unique() -> None:
    names = [name for name, _ in bad_meshes()]
    assert len(names) == len(set(names))
    assert len(names) >= 500


def test_bad_files_are_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for path in plant(tmp_path):
        with pytest.raises(UserError) as refusal:
            load_mesh(str(path))
            pytest.fail(f"{path.name} was accepted")
        message = str(refusal.value)
        assert len(message.splitlines()) == 1
        assert len(message) <= LONGEST
        assert path.name[-20:].replace("\0", "?") in message
        assert message.isprintable()
    assert capfd.readouterr() == ("", "")  # nor does a library print anything of its own


@pytest.mark.parametrize("spec", ["", ".", "/", "nowhere", "heads", "Sphere"])
def test_specs(spec: str) -> None:
    with pytest.raises(UserError):
        load_mesh(spec)


@pytest.mark.parametrize("steps", [-1, 5, 1000])
def test_subdivisions(steps: int) -> None:
    with pytest.raises(UserError, match=f"^--subdivide: {steps} is out of range, allowed is 0 to 4$"):
        load_mesh("sphere", steps)


def test_messages_are_one_printable_line() -> None:
    assert str(UserError("a.obj: line 3:\n\t'v\x1b\0'")) == "a.obj: line 3: 'v??'"
    long = str(UserError("start " + "x" * 1000 + " end"))
    assert len(long) <= LONGEST
    assert long.startswith("start") and " ... " in long and long.endswith("end")
