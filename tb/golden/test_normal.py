# SPDX-License-Identifier: Apache-2.0
"""golden.normal: the recurrence of the increments, step by step; lines of normals by hand."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import normal

from tb.runner import SEED

ONE = 1 << k.INTENSITY_F
RNG = np.random.default_rng(SEED)


def test_increment_is_the_recurrence() -> None:
    """P = L = n, P = L = L + l, P = P + g in Python's integers, with the register's width."""
    rows, unit = 3000, 1 << k.STEP_F
    first, line = (RNG.random(rows) < share for share in (0.02, 0.2))
    first[0] = True
    n, g, l = (RNG.integers(-reach, reach, rows) for reach in (2 * unit, unit >> 6, unit >> 6))  # noqa: E741
    pixel = start = 0
    for row, value in enumerate(normal.increment(first.astype(int), line.astype(int), n, g, l).tolist()):
        if first[row]:
            pixel = start = int(n[row])
        elif line[row]:
            pixel = start = start + int(l[row])
        else:
            pixel += int(g[row])
        half = 1 << k.STEP_W - 1
        register = (pixel + half) % (2 * half) - half
        drop = k.STEP_F - k.INTENSITY_F
        assert value == (register + (1 << drop - 1)) >> drop


def test_a_line_by_hand() -> None:
    """Five pixels from x to z: 0, 2, 4 normalized, 1 and 3 the mean of their neighbours or of unit length."""
    n = np.array([[1, 0, 0]]) << k.STEP_F
    g = np.array([[-1, 0, 1]]) << k.STEP_F - 2
    mean, _ = normal.pixel_normals(n, g, [5], [0], k.VARIANT_V3, 0)
    third = round(ONE / np.sqrt(2))
    assert mean[[0, 2, 4]].tolist() == [[ONE, 0, 0], [third, 0, third], [0, 0, ONE]]
    assert mean[1].tolist() == [(ONE + third + 1) // 2, 0, (third + 1) // 2]
    unit, _ = normal.pixel_normals(n, g, [5], [0], k.VARIANT_REFINED, 0)
    assert np.abs(np.linalg.norm(unit, axis=1) / ONE - 1).max() < 2e-4
    exact, of = normal.pixel_normals(n, g, [5], [0], k.VARIANT_EXACT, 0)
    assert exact[1].tolist() == [round(3 / np.sqrt(10) * ONE), 0, round(1 / np.sqrt(10) * ONE)]
    assert of.tolist() == [0] * 5


def test_errors_of_lines() -> None:
    """A line of fewer than 3 sectors or more than 12 is told where d1a decides, a threshold outside [0, 1] always."""
    count = [2, 3, 4, 13, 14, 4, 4]
    threshold = [0, 0, 0, 0, ONE, -1, ONE + 1]
    metric, limit = normal.line_errors(count, k.VARIANT_V1, threshold)
    assert metric.tolist() == [1, 1, 0, 0, 1, 0, 0] and limit.tolist() == [0, 0, 0, 0, 0, 1, 1]
    assert not normal.line_errors(count, k.VARIANT_V4, 0)[0].any()


def test_increments_stay_on_their_plane() -> None:
    """60 lines of 25 pixels of a triangle, and a line of 4096: within 1 ulp, though each increment was rounded."""
    for height, width in ((60, 25), (1, k.PIXELS_MAX)):
        begin, across, down = RNG.uniform(-0.5, 0.5, 3) / [1, width, height]
        y, x = (part.ravel() for part in np.mgrid[:height, :width])
        steps = (np.full(x.size, round(part * (1 << k.STEP_F))) for part in (begin, across, down))
        found = normal.increment((x + y == 0).astype(int), ((x == 0) & (y > 0)).astype(int), *steps)
        assert np.abs(found - (begin + x * across + y * down) * ONE).max() < 1
