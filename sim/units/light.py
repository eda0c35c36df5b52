"""Light models: interpolated intensities and normals to lit pixels."""

from __future__ import annotations

from collections.abc import Iterator

from sim.units.case import Case


def cases() -> Iterator[Case]:
    """All cases of ``rtl/light``."""
    yield from ()
