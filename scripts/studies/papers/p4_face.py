# SPDX-License-Identifier: Apache-2.0
"""Paper P4, a face: every normal of its variants from the RTL, what they cost, and polynomials on midpoint nodes."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import normal, plan, poly
from polyshade.golden.reference import light
from polyshade.golden.reference.normal import METHODS, length_error
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check
from polyshade.scripts.studies.papers.view import View, view
from polyshade.sim import frame
from polyshade.sim.core import Lines, quantize

p4 = partial(check, paper="P4")
POWERS = (32, 128, 512)
NMSE_BAR = 1e-4
THRESHOLD = 0.9

# Table 1 of P4: productivity, error of a normal's length in per cent
TABLE = {"V1": (1.42, 3), "V2": (1.37, 0.58), "V3": (1.74, 10), "V4": (1.44, 3), "V5": (1.39, 0.58), "V6": (1.67, 10)}

# Operations (additions, multiplications, divisions, roots). A point: its increment, and the normalization.
POINT = np.array([5, 6, 1, 1])
MEAN = np.array([3, 0, 0, 0])  # a + b
DOT = np.array([2, 3, 0, 0])
METRIC = {"d1a": np.array([2, 2, 0, 0]), "d2": np.array([1, 1, 0, 0])}
STEP = np.array([3, 0, 3, 0])  # increments, P4's formula (1)
MIDDLE = {
    "V1": np.array(METHODS["InvC1"].operations[:4]),
    "V2": np.array(METHODS["InvC2"].operations[:4]),
    "V3": MEAN,
    "V4": np.array(METHODS["InvC1"].operations[:4]) + METRIC["d2"],
    "V5": np.array(METHODS["InvC2"].operations[:4]) + METRIC["d2"],
    "V6": MEAN + DOT + METRIC["d2"],
}
"""Operations of an even point by variant: where it is normalized for V1, V2, V4, V5, where it is not for V3, V6."""
UNNORMALIZED = {"V1": "V3", "V2": "V3", "V4": "V6", "V5": "V6"}
"""Whose operations an even point takes that is above the threshold."""
PER_LINE = {variant: DOT + METRIC["d1a"] if variant in ("V1", "V2", "V3") else 0 * DOT for variant in MIDDLE}
CLOCKS = np.array([4, 4, 14, 16])  # of an addition, a multiplication, a division, a root, one after another
LINES = np.arange(1, 20, 2)  # points of the lines of P4's average triangle: 100


def variants(folder: Path, size: int) -> Iterator[Claim]:
    """Every variant on the head through the RTL: mismatches, clocks, NMSE."""
    ways = [(name, THRESHOLD) for name in frame.VARIANTS] + [(name, 1.0) for name in UNNORMALIZED]
    drawn = {(name, limit, n): draw(size, n, name, limit) for name, limit in ways for n in POWERS}
    pixels = view(size, POWERS[0]).spans.pixels
    frames = [made for made, _ in drawn.values()]
    yield p4(
        f"pixels of {len(frames)} frames of V1 .. V6, refined and exact that differ from the golden model",
        "<= 0",
        sum(made.mismatches for made in frames),
        unit="pixels",
        kind="repair",
        note=f"RTL, head, {size} x {size}, {pixels} normals each, every bit compared",
    )
    yield p4(
        "pixel-normal path: normals a clock, over the slowest of these frames",
        ">= 0.98",
        min(pixels / made.clocks for made in frames),
        kind="repair",
        note="RTL",
    )
    same = np.abs(drawn["V1", THRESHOLD, 128][0].intensity - drawn["V3", THRESHOLD, 128][0].intensity)
    yield p4(
        "V1 at 0.9 is V3: pixels in which the two differ",
        "<= 0",
        np.count_nonzero(same.max(axis=1)),
        unit="pixels",
        kind="defect",
        note="RTL: d1a never is below 0.9",
    )
    multiplications = counted(view(size, POWERS[0]).spans.count)
    for (name, limit, n), (_, errors) in drawn.items():
        ours = name not in TABLE
        label = name if ours else f"{name}, threshold {limit}"
        done = UNNORMALIZED.get(name, name) if limit == THRESHOLD else name
        gain = f"{TABLE[name][0]} times faster" if name in TABLE else ""
        yield p4(
            f"head, {label}, n = {n}: NMSE of the highlight",
            f"<= {NMSE_BAR if not ours else 1e-5}",
            errors["nmse_specular"],
            kind="repair" if ours else "paper",
            figure="p4_variants.png",
            note=f"RTL, {size} x {size}; diffuse {errors['nmse_diffuse']:.1e}; "
            f"{pixels / drawn[name, limit, n][0].clocks:.4f} normals a clock"
            + ("" if ours else f"; {multiplications[done]:.2f} multiplications a normal, exact {POINT[1]}; P4: {gain}"),
        )
    for name, (_, error) in TABLE.items():
        limit = 1.0 if name in UNNORMALIZED else THRESHOLD
        vectors = worst_middles(name)
        yield p4(
            f"Table 1, {name}: largest error of a normal's length" + f", threshold {limit}" * (name in UNNORMALIZED),
            f"<= {error}" if name in ("V1", "V4") else f"= {error}",
            100 * vectors,
            unit="%",
            note="golden model, every angle up to 90 degrees "
            + ("between the ends of three sectors" if name == "V3" else "that the variant admits"),
        )
    with figures.drawing(folder / "p4_variants.png", 10.5, 4.2, 1, 2, width_ratios=(3, 2)) as (left, right):
        names = [("exact", THRESHOLD), ("refined", THRESHOLD), ("V3", THRESHOLD), *((v, 1.0) for v in ("V4", "V5"))]
        titles = {"V3": "V1 .. V6 at 0.9: means", "V4": "V4 at 1.0: InvC1", "V5": "V5 at 1.0: InvC2"}
        colours = (figures.EXACT, figures.REFINED, figures.SHADES[0], figures.PAPER, figures.THIRD)
        for (name, limit), colour in zip(names, colours, strict=True):
            for channel, style in (("specular", "o-"), ("diffuse", "o:")):
                values = [drawn[name, limit, n][1][f"nmse_{channel}"] for n in POWERS]
                label = titles.get(name, name) if channel == "specular" else None
                left.plot(POWERS, values, style, color=colour, label=label)
        left.axhline(NMSE_BAR, color=figures.EXACT, ls=":", lw=1)
        left.set(xscale="log", yscale="log", xlabel="exponent n of the highlight; dotted: diffuse", ylabel="NMSE")
        left.set(title=f"Normals from the RTL, head, {size} × {size}")
        left.set_xticks(POWERS, POWERS)
        left.minorticks_off()
        left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=3)
        place = np.arange(len(TABLE))
        right.bar(place - 0.2, [gain for gain, _ in TABLE.values()], 0.38, color=figures.PAPER, label="P4, Table 1")
        right.bar(place + 0.2, [gains(name)[0] for name in TABLE], 0.38, color=figures.REFINED, label="counted")
        right.set_xticks(place, list(TABLE))
        right.set(title="Productivity", ylabel="times that of normalizing every point")
        right.axhline(1, color=figures.EXACT, lw=1)
        right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)


def productivity(folder: Path, size: int) -> Iterator[Claim]:
    """Table 1's gains against counted operations."""
    model = "; clocks of operations one after another: addition and multiplication 4, division 14, root 16"
    lines = f"a triangle of {LINES.sum()} points in {len(LINES)} lines"
    for name, (claimed, _) in TABLE.items():
        clocks, multiplications, roots = gains(name)
        yield p4(
            f"Table 1, {name}: productivity gain",
            f"= {claimed}",
            clocks,
            unit="times",
            figure="p4_variants.png",
            note=f"{lines}{model}; multiplications alone {multiplications:.2f}, roots and divisions alone {roots:.2f}",
        )
    clocks = {
        name: draw(size, POWERS[0], name, 1.0 if name in UNNORMALIZED else THRESHOLD)[0].clocks
        for name in ("exact", *TABLE)
    }
    yield p4(
        "the RTL gives one normal a clock, normalized or not: most clocks that a variant saves on the head",
        "<= 0",
        max(clocks["exact"] - clocks[name] for name in TABLE),
        unit="clocks",
        kind="repair",
        note=f"RTL, {size} x {size}: a pipeline saves area, not time",
    )


def nodes(folder: Path, size: int) -> Iterator[Claim]:
    """Polynomials whose inner nodes come from the chain of two midpoints, against nodes normalized exactly."""
    found = {}
    powers = (16, *POWERS)
    for n in powers:
        scene = view(2 * size, n)
        records = plan.plan(scene.spans.count, scene.kappa)
        found["float64", n] = scene.shade(records)[0]
        for form, name in ((None, "exact"), (k.FORM_REFINED, "refined"), (k.FORM_PAPER, "InvC2")):
            found[name, n] = shade_nodes(scene, records, form)
    on_head = partial(p4, figure="p4_nodes.png", note=f"RTL, default ladder, head, {2 * size} x {2 * size}")
    for n, claimed in zip(powers, ("= 3.5e-4", "= 1.9e-3", "= 5.7e-2", "= 3.1"), strict=True):
        yield on_head(
            f"nodes by P4's InvC2 and d2: NMSE of the highlight, n = {n}",
            claimed,
            found["InvC2", n]["nmse_specular"],
            kind="defect",
        )
    for n in powers:
        refined, exact = (found[name, n]["nmse_specular"] for name in ("refined", "exact"))
        yield on_head(f"nodes by refined midpoints: NMSE of the highlight, n = {n}", "<= 1e-5", refined, kind="repair")
        yield on_head(
            f"nodes by refined midpoints: NMSE of the highlight over that of exact nodes, n = {n}",
            "<= 1.5",
            refined / exact,
            kind="repair",
            note=f"{on_head.keywords['note']}; exact {exact:.1e}, from float64 normals "
            f"{found['float64', n]['nmse_specular']:.1e}",
        )
    with figures.drawing(folder / "p4_nodes.png", 6.5, 4) as (axes,):
        for name, colour in (
            ("InvC2", figures.PAPER),
            ("refined", figures.REFINED),
            ("exact", figures.EXACT),
            ("float64", "#94a1b2"),
        ):
            values = [found[name, n]["nmse_specular"] for n in powers]
            axes.plot(powers, values, "o-", color=colour, label=f"nodes: {name}")
        axes.set(xscale="log", yscale="log", xlabel="exponent n of the highlight", ylabel="NMSE of the highlight")
        axes.set(title="Nodes of polynomials by midpoints")
        axes.set_xticks(powers, powers)
        axes.minorticks_off()
        axes.legend(loc="upper left")


class Shaded(NamedTuple):
    """The head's pixels, its normals out of the RTL, their light from float64."""

    intensity: NDArray[np.float64]
    clocks: int
    mismatches: int  # normals that differ from the golden model's


def draw(size: int, n: float, variant: str, threshold: float) -> tuple[Shaded, dict]:
    """The head with normals of a variant, light from float64 with the normals as they are, and its errors."""
    scene, way = view(size, n), (frame.VARIANTS[variant], int(quantize(threshold)))
    lines = Lines.of(scene.spans)
    run = sim.load("shade_pixel_normals").run(s_axis_line_tdata=lines.beats, variant_i=way[0], threshold_i=way[1])
    vectors, _ = normal.pixel_normals(lines.n, lines.g, lines.count, lines.cosine, *way)
    shifts = k.INTENSITY_W * np.arange(3)
    actual = (run.m_axis_normal_tdata[:, None] >> shifts & (1 << k.INTENSITY_W) - 1) << 64 - k.INTENSITY_W
    actual >>= 64 - k.INTENSITY_W
    intensity = scene.light(actual / frame.ONE, as_given=True).clip(0, 1)
    mismatches = np.count_nonzero((actual != vectors).any(axis=1))
    return Shaded(intensity, run.clocks, mismatches), frame.errors(intensity, scene.exact, scene.visible)


def middles(count: NDArray[np.integer]) -> int:
    """Even points of lines: those between two odd ones."""
    return int(np.sum((np.maximum(count, 1) - 1) // 2))


def counted(count: NDArray[np.integer]) -> dict[str, float]:
    """Multiplications a normal by variant on lines of these counts, even points treated as in ``MIDDLE``."""
    even, pixels = middles(count), int(np.sum(count))
    return {
        name: float((pixels - even) * POINT[1] + even * MIDDLE[name][1] + len(count) * PER_LINE[name][1]) / pixels
        for name in MIDDLE
    }


def gains(variant: str) -> tuple[float, float, float]:
    """Times fewer clocks, multiplications, roots and divisions than normalizing every point of P4's triangle.

    P4's method has its increments once a triangle, the other once a line.
    """
    points, even = LINES.sum(), middles(LINES)
    before = points * POINT + len(LINES) * STEP
    after = (points - even) * POINT + even * MIDDLE[variant] + len(LINES) * PER_LINE[variant] + STEP
    return (
        float(before @ CLOCKS / (after @ CLOCKS)),
        float(before[1] / after[1]),
        float(before[2:].sum() / after[2:].sum()),
    )


def worst_middles(variant: str) -> float:
    """Largest error of length among the even points of lines of three sectors, over the angle of their ends.

    V1, V2, V4, V5 normalize all of them (threshold 1), V3 none, V6 those with d2 >= 0.9.
    """
    if variant in UNNORMALIZED:
        c = np.arange((1 << k.INTENSITY_F) + 1) / (1 << k.INTENSITY_F)
        degree = 1 if variant in ("V1", "V4") else 2
        value = normal.invc(np.arange(c.size), k.FORM_PAPER, degree)[0] / (1 << k.INVC_F)
        return float(np.abs(value * np.sqrt(2 * (1 + c)) - 1).max())
    degrees = np.linspace(0, 90, 9001)
    apart = np.radians(degrees) * (2 / 3 if variant == "V3" else 1)
    ends = [np.stack([np.sin(x), np.zeros_like(x), np.cos(x)], axis=-1) for x in (-apart / 2, apart / 2)]
    a, b = (np.moveaxis(quantize(side), -1, 0) for side in ends)
    middle = np.stack(normal.bisect(*a, *b, 1 << k.INVC_F - 1), axis=-1) / (1 << k.INTENSITY_F)
    admitted = normal.metric(normal.dot3(*a, *b), k.METRIC_M_MIN)[3] == 0 if variant == "V6" else slice(None)
    return float(length_error(middle[admitted]).max())


def shade_nodes(scene: View, records: plan.Records, form: int | None) -> dict:
    """Errors of a plan's pixels out of the RTL, their nodes' normals in S1.16.

    Inner nodes from ``shade_node_chain`` in a form, or normalized exactly (None) like the ends and pixels lit directly.
    """
    spans = scene.spans

    def at(position: NDArray[np.int64]) -> NDArray[np.int64]:
        """(R, n, 3): normals at positions (R, n) of the records' spans."""
        vectors = spans.normal[records.span, None] + position[..., None] * spans.gradient[records.span, None]
        return quantize(light.unit(vectors))

    vectors = at(records.nodes)
    if form is not None:
        first, last = at(records.start[:, None] + [0, 1] * (1 << records.log2[:, None])).transpose(1, 2, 0)
        chain = sim.load("shade_node_chain", FORM=form).run(a_i=(*first,), b_i=(*last,), c_i=normal.dot3(*first, *last))
        components = [chain.outputs[f"arc_o.n{node}.{axis}"] for node in range(5) for axis in "xyz"]
        chain = np.stack(components, axis=-1).reshape(-1, 5, 3)
        inner = np.take_along_axis(chain, plan.QUARTERS[records.degree][..., None], axis=1)
        vectors = np.where((records.degree == k.DEGREE_DIRECT)[:, None, None], vectors, inner)
    vectors = vectors / (1 << k.INTENSITY_F)
    intensity = scene.light(vectors, as_given=True)
    beats = poly.pack_records(np.moveaxis(quantize(intensity), -1, 1), records.degree, records.count)
    data = sim.load("shade_poly_span", EVALUATOR=k.EVALUATOR_HORNER).run(s_axis_span_tdata=beats).m_axis_pixel_tdata
    pixels = np.stack([data & 0xFFFF, data >> k.PIXEL_W], axis=1) / frame.ONE
    return frame.errors(pixels, scene.exact, scene.visible)


STEPS = [variants, productivity, nodes]
