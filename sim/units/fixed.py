# SPDX-License-Identifier: Apache-2.0
"""Round, saturate, multiply, delay, a third, the weighted sum, the reciprocal square root."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import fixed
from polyshade.sim.units.case import FORMS, Arrays, Case, Real, every, in_forms, mixed, shortened, signed_range


def _steps(form: str) -> Iterator[Case]:
    """The building blocks: round, saturate, multiply."""
    for width, drop, more in ((20, 7, {}), (26, 9, {}), (2, 1, {}), (9, 8, {}), (40, 16, {}), (20, 3, {"OUT_W": 17})):
        ranges = {"x_i": signed_range(width)}
        if more:  # a caller that asks for fewer bits promises that the result fits
            ranges = {"x_i": (-(1 << width - 1), (1 << width - 1) - (1 << drop - 1) - 1)}
        point = {"WIDTH": width, "DROP": drop} | more
        yield Case(
            "shade_round", form, point, lambda i, d=drop: {"y_o": fixed.round(i["x_i"], d)},
            lambda i, d=drop: {"y_o": np.ldexp(i["x_i"].astype(Real), -d)},
            lambda i, d=drop: {"y_o": np.ldexp(i["x_i"].astype(Real), -d)},
            _ties(ranges, drop) if width > 20 else None, every(ranges) if width <= 20 else None, 0,
        )  # fmt: skip
    x_i = lambda width: {"x_i": signed_range(width)}  # noqa: E731
    for width, out_w in ((20, 12), (k.VALUE_W, k.PIXEL_W), (9, 4), (3, 1)):
        clamp = lambda i, o=out_w: {"y_o": fixed.saturate(i["x_i"], o)}  # noqa: E731
        yield _whole("shade_saturate", {"WIDTH": width, "OUT_W": out_w}, clamp, x_i(width), 0, 1 << out_w)
    for width, out_w in ((20, 12), (k.DOT_W, k.INTENSITY_W), (9, 4), (3, 2)):
        limit = lambda i, o=out_w: {"y_o": fixed.limit(i["x_i"], o)}  # noqa: E731
        yield _whole("shade_limit", {"WIDTH": width, "OUT_W": out_w}, limit, x_i(width), 0)
    for width, f in ((k.INTENSITY_W, k.INTENSITY_F), (20, 18), (6, 2)):
        clamp = lambda i, f=f: dict(zip(("y_o", "clamped_o"), fixed.clamp(i["x_i"], f), strict=True))  # noqa: E731
        yield _whole("shade_clamp", {"WIDTH": width, "F": f}, clamp, x_i(width), 0)
    square = lambda i: {"y_o": fixed.square(i["x_i"])}  # noqa: E731
    for width in (k.INTENSITY_W, 9, 11, 2):
        yield _whole("shade_square", {"WIDTH": width}, square, x_i(width), k.LATENCY_MUL)
    product = lambda i: {"p_o": fixed.mul(i["a_i"], i["b_i"])}  # noqa: E731
    cuts = [sign * (1 << bits) - less for bits in (17, 18) for sign in (1, -1) for less in (0, 1)]  # where a is cut
    for a_w, b_w, stages in (
        (30, 18, 2), (18, 18, 2), (30, 18, 3), (35, 18, 0), (18, 18, 0), (10, 10, 2), (20, 2, 2), (19, 2, 2)
    ):  # fmt: skip
        ranges = {"a_i": signed_range(a_w), "b_i": signed_range(b_w)}
        yield _whole("shade_mul", {"A_W": a_w, "B_W": b_w, "STAGES": stages}, product, ranges, stages, *cuts)


def _whole(
    module: str, point: dict[str, int], of: Callable[[Arrays], Arrays], ranges: dict[str, tuple[int, int]],
    latency: int, *more: int,
) -> Case:  # fmt: skip
    """A unit that rounds nothing: all inputs there are, of more than 22 bits random ones and the corners."""
    many = sum((high - low).bit_length() for low, high in ranges.values()) > 22
    vectors = (mixed(ranges, *more), None) if many else (None, every(ranges))
    return Case(module, "refined", point, of, of, of, *vectors, latency, bound=0)


def _ties(ranges: dict[str, tuple[int, int]], drop: int) -> Callable[[np.random.Generator, int], Arrays]:
    """Of the vectors a third is half way between two results, or next to it."""

    def make(rng: np.random.Generator, rows: int) -> Arrays:
        x = mixed(ranges)(rng, rows)["x_i"]
        tie = (x >> drop << drop) + (1 << drop - 1) + rng.integers(-1, 2, rows)
        return {"x_i": np.where(rng.random(rows) < 1 / 3, tie, x)}

    return make


def _delay(form: str) -> Iterator[Case]:
    delays = [(20, 0), (12, 3), (16, 41), (33, 5), (1, 0), (8, 47)]
    rings = [(12, 3), (16, 41), (2, 51), (18, 16), (6, 8), (8, 17), (5, 47), (33, 5), (21, 32)]
    blocks = [(20, 3), (56, 13), (9, 64)]
    same = lambda i: {"q_o": i["d_i"]}  # noqa: E731
    for module, sizes, more in (
        ("shade_delay", delays, {}), ("shade_ring", rings, {}), ("shade_ring", blocks, {"BLOCK": 1})
    ):  # fmt: skip
        for width, depth in sizes:
            word = {"d_i": (0, (1 << width) - 1)}
            yield _whole(module, {"WIDTH": width, "DEPTH": depth} | more, same, word, depth)


def _third(form: str) -> Iterator[Case]:
    def exact(inputs: Arrays) -> Arrays:
        x = inputs["x_i"].astype(Real)
        return {"y_o": x / 3 if form == "refined" else x * 43 / 128}

    for width in (20, 18, 12, 9, 4, 26):
        ranges = {"x_i": signed_range(width)}
        yield Case(
            "shade_third", form, {"WIDTH": width, "FORM": FORMS[form]},
            lambda i: {"y_o": fixed.third(i["x_i"], FORMS[form])}, exact, lambda i: {"y_o": i["x_i"].astype(Real) / 3},
            mixed(ranges) if width > 20 else None, every(ranges) if width <= 20 else None, k.LATENCY_THIRD, bound=1 / 3,
        )  # fmt: skip


def _weigh(form: str) -> Iterator[Case]:
    for width, f, out_w, out_f, weights in (
        (20, k.SQUARE_F, 26, k.SQUARE_F, (k.INVC2_0, k.INVC2_C, k.INVC2_CC, 1)),
        (6, 4, 20, 16, (k.D1_0, k.ETA2_C, k.ETA2_CC, -1)),
        (6, 4, 6, 2, (-65536, 65535, 0, -21845)),
        (12, 6, 21, 12, (-70000, 43691, -65535, 3)),
        (8, 4, 12, 2, (0, 0, 0, -131072)),
    ):
        k0, *by_input = weights

        def golden(i: Arrays, f=f, out_f=out_f, k0=k0, by_input=by_input) -> Arrays:
            terms = itertools.chain(*zip(by_input, (i["x_i"], i["y_i"], i["z_i"]), strict=True))
            return {"w_o": fixed.weigh(k0, *terms, f=f, out_f=out_f)}

        def exact(i: Arrays, f=f, out_f=out_f, k0=k0, by_input=by_input) -> Arrays:
            value = sum(w * i[f"{n}_i"].astype(Real) for w, n in zip(by_input, "xyz", strict=True)) / (1 << f) + k0
            return {"w_o": value * (1 << out_f) / (1 << k.CONSTANT_F)}

        ranges = {f"{n}_i": signed_range(width) for n in "xyz"}
        parameters = {"WIDTH": width, "F": f, "OUT_W": out_w, "OUT_F": out_f}
        yield Case(
            "shade_weigh", form, parameters | dict(zip(("K0", "KX", "KY", "KZ"), weights, strict=True)), golden, exact,
            exact, mixed(ranges) if width > 6 else None, None if width > 6 else every(ranges), k.LATENCY_WEIGH,
            unit_f=out_f,
        )  # fmt: skip


def _root(form: str) -> Iterator[Case]:
    """Reciprocal square root and its table: arguments of every length, down to one unit."""

    def rsqrt(i: Arrays) -> Arrays:
        y, e = fixed.rsqrt(i["z_i"])
        return {"y_o": y, "e_o": e, "zero_o": (i["z_i"] == 0).astype(np.int64)}

    def root(i: Arrays) -> Arrays:
        golden = rsqrt(i)
        z = np.maximum(i["z_i"], 1).astype(Real)
        exact = np.ldexp(1 / np.sqrt(z), golden["e_o"] + k.RSQRT_F)
        return golden | {"y_o": np.where(i["z_i"] == 0, 0, exact)}

    row = lambda i: {"row_o": fixed.rsqrt_rom(i["i_i"])}  # noqa: E731
    yield _whole("shade_rsqrt_rom", {}, row, {"i_i": (0, (1 << k.RSQRT_INDEX_W) - 1)}, 1)
    argument = {"z_i": (0, (1 << k.RSQRT_W) - 1)}
    yield Case(
        "shade_rsqrt", form, {}, rsqrt, root, root, shortened(mixed(argument), k.RSQRT_W), None, k.LATENCY_RSQRT,
        bound=7 / 8, unit_f=k.RSQRT_F,
    )  # fmt: skip


def cases() -> Iterator[Case]:
    """All cases of ``rtl/fixed``."""
    yield from in_forms(_steps, _weigh, _delay, only="refined")
    yield from in_forms(_third)
    yield from in_forms(_root, only="refined")
