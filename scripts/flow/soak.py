# SPDX-License-Identifier: Apache-2.0
"""``make soak MINUTES=...``: random work for units and cores against the golden model until the time is over.

An item is a kind of work and a seed, from which everything else comes: vectors of a unit, spans for the core with a
random material, form, path and number of lanes, triangles for the patches and the direct form, vertices for the scan
converter; gaps of the source, stalls of the consumer, random contents of registers without reset, and in one of four
items a reset amid the traffic, behind which everything must come as if nothing had been. A kind that differs is printed
with the command that repeats it, at once.

Items run on all cores of this machine, or on a cluster: ``--scheduler``, as of ``polyshade render``. The seeds are
consecutive; ``build/soak.json`` tells which, and how much of what was compared.

    {seconds, seeds: [first, last], kinds: {"<kind>": {items, compared, mismatches}}, failed: [..]}
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field

import distributed
import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import raster
from polyshade.golden.material import DIRECT_MODELS, MODELS, Material, planner_registers, registers
from polyshade.golden.types import SPAN
from polyshade.golden.types import pack as pack_struct
from polyshade.scripts.report import save
from polyshade.sim import core, direct, patch
from polyshade.sim.batch import client as workers
from polyshade.sim.errors import UserError
from polyshade.sim.frame import PATCH_MODELS
from polyshade.sim.scene.camera import Screen
from polyshade.sim.scene.raster import scan_convert
from polyshade.sim.scene.triangles import Triangles
from polyshade.sim.sources import BUILD
from polyshade.sim.units import FORMS, cases
from polyshade.sim.units.stream import pixel_normals, poly_span
from tqdm import tqdm

OUT = BUILD / "soak.json"
MINUTES = (0.01, 7 * 24 * 60)
VECTORS = 2_000_000  # of a unit: an item of a second
ONE = 1 << k.INTENSITY_F
PAUSES = (0.0, 0.0, 0.3, 0.7)
CORES = (  # few points, as each is compiled
    {"LANES": 1, "EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_REFINED},
    {"LANES": 2, "EVALUATOR": k.EVALUATOR_HORNER, "FORM": k.FORM_PAPER},
    {"LANES": 4, "EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_REFINED},
)


@dataclass
class Outcome:
    """What an item compared: vectors or pixels; ``bins``: what it was, for functional coverage."""

    kind: str
    seed: int
    compared: int
    mismatches: int
    first: str = ""
    bins: dict[str, object] = field(default_factory=dict)


def traffic(rng: np.random.Generator, clocks: int, stalls: bool = True) -> tuple[dict, dict]:
    """Options of a run, and the bins that they stand for. ``clocks``: about how long the run is."""
    gap, stall = rng.choice(PAUSES), rng.choice(PAUSES) if stalls else 0.0
    reset = int(rng.integers(1, max(2, clocks))) if rng.random() < 0.25 else None
    options = {"in_gap": float(gap), "out_stall": float(stall), "state": int(rng.integers(1 << 31)), "reset_at": reset}
    return options, {"gap": bool(gap), "stall": bool(stall), "reset": reset is not None}


def material(rng: np.random.Generator, models: tuple[str, ...] = tuple(MODELS), form: str = "refined") -> Material:
    """A random surface."""
    return Material(
        str(rng.choice(models)), float(2 ** rng.uniform(0, 10)), float(rng.uniform(0.05, 0.7)), float(rng.random()),
        form=form,
    )  # fmt: skip


def direction(rng: np.random.Generator) -> tuple[float, float, float]:
    """A direction to the light, most often from the viewer's side."""
    v = rng.normal(size=3) + np.array([0, 0, 1.5])
    return tuple(map(float, v / np.linalg.norm(v)))


def triangles(rng: np.random.Generator, count: int, size: int = 256) -> Triangles:
    """Triangles of 4, 20 and up to all pixels of a frame, of any curvature."""
    reach = rng.choice([4, 20, size / 2], (count, 1, 1))
    corners = np.clip(rng.uniform(0, size, (count, 1, 2)) + rng.uniform(-1, 1, (count, 3, 2)) * reach, 0, size)
    bend = rng.choice([0, 0.02, 0.3], (count, 1, 1))
    normals = rng.normal(size=(count, 1, 3)) * [0.5, 0.5, 0.1] + [0, 0, 1] + bend * rng.normal(size=(count, 3, 3))
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    screen = Screen(xy=corners.reshape(-1, 2), depth=np.zeros(3 * count), normals=normals.reshape(-1, 3))
    return Triangles.of(scan_convert(screen, np.arange(3 * count, dtype=np.int32).reshape(-1, 3), size, cull=False))


def lines(rng: np.random.Generator, count: int) -> core.Lines:
    """Spans of all lengths and curvatures; one in eight holds any bits, one in eight has a normal of length 0."""
    pixels = np.minimum(rng.geometric(rng.choice([0.5, 0.08, 0.01]), count), k.PIXELS_MAX)
    first, other = rng.standard_normal((2, count, 3))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    step = other * rng.choice([0.0, 0.02, 0.2, 1.0], (count, 1)) / np.maximum(pixels - 1, 1)[:, None]
    scale, limit = 1 << k.STEP_F, 1 << k.STEP_W - 1
    normal, step = (np.clip(np.rint(part * scale), -limit, limit - 1).astype(np.int64) for part in (first, step))
    kind = rng.integers(0, 8, (count, 1))
    free = rng.integers(-limit, limit, (2, count, 3))
    normal, step = (
        np.select([kind == 0, kind == 1], [v, 0], part) for v, part in zip(free, (normal, step), strict=True)
    )
    cosine = rng.integers(-2 * ONE, 2 * ONE, count)
    return core.Lines(
        normal, step, pixels.astype(np.int64), cosine, np.arange(count) % core.TAGS, rng.integers(0, 2, count)
    )


# ---- kinds ---------------------------------------------------------------------------------------------------------


def unit(rng: np.random.Generator, seed: int) -> Outcome:
    """Vectors of a unit at one of its points."""
    every = cases()
    case = every[int(rng.integers(len(every)))]
    if case.all_vectors:  # `make test` has them all; here a chunk of them
        case = next(other for other in [*every[every.index(case) :], *every] if other.vectors)
    result = case.check(min(VECTORS, 64 * case.chunk), seed, errors=False)
    return Outcome("unit", seed, result.vectors, result.mismatches, result.first_mismatch, {"unit": str(case)})


def spans(rng: np.random.Generator, seed: int) -> Outcome:
    """Spans through the evaluators."""
    form, evaluator = str(rng.choice([*FORMS])), int(rng.choice([k.EVALUATOR_HORNER, k.EVALUATOR_FDIFF]))
    gap, stall = (float(v) for v in rng.choice(PAUSES, 2))
    result = poly_span(evaluator, form).check(5000, seed, gap, stall)
    bins = {"form": form, "evaluator": evaluator, "gap": gap > 0, "stall": stall > 0}
    return Outcome("spans", seed, result.vectors, result.mismatches, result.first_mismatch, bins)


def normals(rng: np.random.Generator, seed: int) -> Outcome:
    """Lines of normals."""
    gap, stall = (float(v) for v in rng.choice(PAUSES, 2))
    result = pixel_normals().check(5000, seed, gap, stall)
    return Outcome(
        "normals", seed, result.vectors, result.mismatches, result.first_mismatch, {"gap": gap > 0, "stall": stall > 0}
    )


def core_spans(rng: np.random.Generator, seed: int) -> Outcome:
    """Spans and registers for ``shade_core``."""
    point = CORES[int(rng.integers(len(CORES)))]
    form = next(name for name, code in FORMS.items() if code == point["FORM"])
    surface, path = material(rng, form=form), str(rng.choice(["line", "normals"]))
    sent = lines(rng, int(rng.integers(20, 400)))
    words = {**registers(surface, direction(rng)), **planner_registers(surface)}
    words |= {"path": {"line": k.PATH_POLY, "normals": k.PATH_NORMALS}[path], "variant": int(rng.integers(0, 8))}
    options, bins = traffic(rng, int(sent.count.sum()))
    made = core.draw(sent, words, options=options | {"seed": seed}, **point)
    first = made.first_mismatch or made.counter_mismatches
    bins |= {"model": surface.model, "form": form, "path": path, "lanes": point["LANES"]}
    bins |= {"fault": "light" if made.status else "none"}
    wrong = made.mismatches + len(made.counter_mismatches)
    return Outcome("core", seed, len(made.pixels), wrong, str(first or ""), bins)


def patches(rng: np.random.Generator, seed: int) -> Outcome:
    """Triangles for ``shade_patch``."""
    lanes = int(rng.choice([1, 2, 4, 8]))
    surface, sent = material(rng, PATCH_MODELS), triangles(rng, int(rng.integers(20, 200)))
    options, bins = traffic(rng, int(sent.count.sum()) // lanes)
    made = patch.draw(sent, surface, direction(rng), lanes=lanes, seed=seed, **options)
    first = made.first_mismatch or made.counter_mismatches
    bins |= {"model": surface.model, "form": "refined", "path": "patch", "lanes": lanes, "fault": "none"}
    wrong = made.mismatches + len(made.counter_mismatches)
    return Outcome("patch", seed, len(made.pixels), wrong, str(first or ""), bins)


def directly(rng: np.random.Generator, seed: int) -> Outcome:
    """Triangles for ``shade_direct``."""
    surface, sent = material(rng, DIRECT_MODELS), triangles(rng, int(rng.integers(20, 200)))
    options, bins = traffic(rng, int(sent.count.sum()))
    made = direct.draw(sent, surface, direction(rng), seed=seed, **options)
    first = made.first_mismatch or made.counter_mismatches
    bins |= {"model": surface.model, "form": "refined", "path": "direct", "lanes": 1, "fault": "none"}
    wrong = made.mismatches + len(made.counter_mismatches)
    return Outcome("direct", seed, len(made.pixels), wrong, str(first or ""), bins)


def vertices(rng: np.random.Generator, seed: int) -> Outcome:
    """Vertices for ``shade_spans``: small, long, far outside."""
    rows, size, place = int(rng.integers(50, 500)), 128, 1 << k.COORDINATE_W - 1
    span = rng.choice([100, 600, 256 * 20, 256 * 300], (rows, 1, 1))
    places = rng.integers(-size * 64, size * 320, (rows, 1, 2)) + (rng.uniform(-1, 1, (rows, 3, 2)) * span).astype(
        np.int64
    )
    bound = 1 << k.VERTEX_F
    normal = rng.integers(-bound, bound, (rows, 3, 3))
    normal[np.all(normal == 0, axis=2)] = 1
    places = np.clip(places, -place, place - 1)
    sent = raster.Vertices(
        places[..., 0], places[..., 1], rng.integers(0, 1 << k.DEPTH_F, (rows, 3)), normal,
        rng.integers(0, 1 << k.TAG_W, rows), rng.integers(0, 2, rows),
    )  # fmt: skip
    cull = int(rng.choice([k.CULL_NONE, k.CULL_BACK, k.CULL_FRONT]))
    view = raster.View(size, int(rng.integers(16, size)), cull, int(rng.integers(0, 2)))
    options, bins = traffic(rng, 20 * rows)
    run = sim.load("shade_spans").run(
        **raster.beats(sent), **view.ports, seed=seed, drain=1 << 17, patience=1 << 17, **options
    )
    wanted = raster.scan(sent, view)
    expected = raster.lines(wanted)
    spots = {name: expected.pop(name) for name in ("column", "line", "depth", "increase")}
    packets = pack_struct(SPAN, expected)
    common = min(len(packets), len(run.given))
    wrong = np.any(packets[:common] != run.outputs["m_axis_span_tdata"][:common], axis=1)
    for name, value in spots.items():
        wrong |= run.outputs[f"m_axis_span_tuser.{name}"][:common] != value[:common]
    mismatches = int(wrong.sum()) + abs(len(packets) - len(run.given))
    return Outcome("scan", seed, len(packets), mismatches, "spans differ" * bool(mismatches), bins | {"cull": cull})


KINDS: dict[str, Callable[[np.random.Generator, int], Outcome]] = {
    "unit": unit,
    "spans": spans,
    "normals": normals,
    "core": core_spans,
    "patch": patches,
    "direct": directly,
    "scan": vertices,
}


def item(seed: int, kind: str = "") -> Outcome:
    """The work of a seed, and what it gave. A module that hangs or whose assertion fails is a mismatch, too."""
    kind = kind or [*KINDS][seed % len(KINDS)]
    try:
        return KINDS[kind](np.random.default_rng([seed, [*KINDS].index(kind)]), seed)
    except sim.SimulationError as error:
        return Outcome(kind, seed, 0, 1, str(error))


# ---- the whole -----------------------------------------------------------------------------------------------------


def outcomes(first: int, seconds: float, scheduler: str | None) -> Iterator[Outcome]:
    """Items of consecutive seeds until the time is over; those that were begun are waited for."""
    end = time.monotonic() + seconds
    with workers(scheduler, 1 << 20) as client:
        width = 2 * sum(client.nthreads().values())
        seed = first + width
        running = distributed.as_completed([client.submit(item, first + i, pure=False) for i in range(width)])
        for done in running:
            yield done.result()
            if time.monotonic() < end:
                running.add(client.submit(item, seed, pure=False))
                seed += 1


def main(minutes: float = 1.0, seed: int = 1, scheduler: str | None = None, only: str = "") -> int:
    """Run for so many minutes, or the item of ``only`` (a kind) and the seed; 1 if anything differs."""
    if only and only not in KINDS:
        raise UserError(f"--kind: {only!r} is none of {', '.join(KINDS)}")
    if not MINUTES[0] <= minutes <= MINUTES[1]:
        raise UserError(f"--minutes: {minutes:g} is out of range, allowed is {MINUTES[0]} to {MINUTES[1]}")
    if not 0 <= seed < 1 << 31:
        raise UserError(f"--seed: {seed} is out of range, allowed is 0 to {(1 << 31) - 1}")
    if only:
        made = item(seed, only)
        print("\n".join(f"{name}: {value}" for name, value in asdict(made).items()))
        return int(made.mismatches > 0)
    began, last, failed = time.monotonic(), seed, []
    kinds = {kind: {"items": 0, "compared": 0, "mismatches": 0} for kind in KINDS}
    print(f"soak: seeds from {seed} on")
    with tqdm(desc="soak", unit="compared", unit_scale=True, disable=None) as bar:
        for made in outcomes(seed, 60 * minutes, scheduler):
            row, last = kinds[made.kind], max(last, made.seed)
            row["items"] += 1
            row["compared"] += made.compared
            row["mismatches"] += made.mismatches
            bar.update(made.compared)
            if made.mismatches:
                again = f"polyshade soak --kind {made.kind} --seed {made.seed}"
                failed.append(again)
                print(f"{again}: {made.mismatches} mismatches: {made.first}", file=sys.stderr)
    seconds = time.monotonic() - began
    save(OUT, {"seconds": round(seconds, 1), "seeds": [seed, last], "kinds": kinds, "failed": failed})
    for kind, row in kinds.items():
        print(f"{kind:8} {row['items']:6} items, {row['compared']:13,} compared, {row['mismatches']} mismatches")
    print(f"soak: seeds {seed} to {last} in {seconds:.0f} s, {len(failed)} failed")
    return int(bool(failed))
