# SPDX-License-Identifier: Apache-2.0
"""Light over whole triangles: the golden twins of ``rtl/surface``, see ``direct`` and ``patch``."""

from . import patch
from .direct import chord, direct, dot_scaled, rho, rho_rom, scalar_light

__all__ = ["chord", "direct", "dot_scaled", "patch", "rho", "rho_rom", "scalar_light"]
