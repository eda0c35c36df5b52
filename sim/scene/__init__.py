# SPDX-License-Identifier: Apache-2.0
"""The host's side of the renderer: mesh, camera, scan conversion into spans, z-buffer."""
