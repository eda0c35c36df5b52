# SPDX-License-Identifier: Apache-2.0
"""``make report``: all that was measured on one page, ``build/report/index.html``, which needs nothing else.

Every part is made from a report that another command left in ``build``. A part whose report is missing or cannot be
read is named at the top of the page, with the command that makes it; the rest is there all the same. Pictures and
plots stand in the page itself: it can be sent, and is read without a network.
"""

from __future__ import annotations

import base64
import datetime
import io
import json
import re
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup
from polyshade.sim.sources import BUILD, ROOT, modules
from polyshade.sim.tools import versions

TEMPLATE = "page.html.j2"
PICTURES = ("image", "reference", "difference")
REPORTS = {  # name: the command that leaves it
    "units": "make units",
    "formal": "make formal",
    "mutants": "make mutants",
    "coverage": "make coverage",
    "gate": "make gate",
    "synth": "make synth",
    "machines": "make machines",
    "papers": "make papers",
    "budget": "make budget",
    "soak": "make soak",
    "bench": "make bench",
}
FRAME_KEYS = ("mismatches", "pixels", "cycles", "pixels_per_cycle", "light_evaluations_per_pixel", "nmse_diffuse",
              "nmse_specular", "max_error")  # fmt: skip
Faults = list[str]


def part(name: str, make: Callable[[], object], faults: Faults, default: object) -> object:
    """What ``make`` gives; where it fails a default, and a line among the faults."""
    try:
        return make()
    except (ValueError, KeyError, TypeError, AttributeError, IndexError, OSError) as error:
        faults.append(f"{name}: cannot be shown ({type(error).__name__}: {error})")
        return default


def load(build: Path, faults: Faults) -> dict[str, object]:
    """The reports that are there."""
    found: dict[str, object] = {}
    for name, command in REPORTS.items():
        path = build / f"{name}.json"
        if not path.exists():
            faults.append(f"{name}: not measured, {command} leaves it")
            continue
        try:
            found[name] = json.loads(path.read_text())
        except ValueError as error:
            faults.append(f"{name}: build/{name}.json cannot be read ({error}), {command} makes it anew")
    return found


# ---- one row a module ----------------------------------------------------------------------------------------------


def bare(name: str) -> str:
    """``shade_third[WIDTH=9]/paper`` belongs to ``shade_third``."""
    return re.split(r"[\[/]", name)[0]


def exact(reports: dict, module: str) -> str:
    rows = [row for name, row in reports["units"].items() if bare(name) == module]
    if not rows:
        return ""
    wrong, vectors = (sum(row[key] for row in rows) for key in ("mismatches", "vectors"))
    every = "all inputs" if all(row["exhaustive"] for row in rows) else f"{vectors:,} vectors"
    return f"{wrong} of {vectors:,} differ" if wrong else f"equal, {every}"


def proven(reports: dict, module: str) -> str:
    results = [row["result"] for row in reports["formal"] if bare(row["module"]) == module]
    counts = {result: results.count(result) for result in ("proven", "bounded", "failed")}
    return ", ".join(f"{count} {result}" for result, count in counts.items() if count)


def killed(reports: dict, module: str) -> str:
    row = reports["mutants"].get(module)
    if not row:
        return ""
    real = row["generated"] - row["equivalent"]
    return f"{row['killed']} of {real}" + (f" ({100 * row['killed'] / real:.0f} %)" if real else "")


def covered(reports: dict, module: str) -> str:
    row = reports["coverage"].get(module)
    if not row or row["line"] is None:
        return ""
    return " / ".join("–" if row[kind] is None else f"{row[kind]:.1f}" for kind in ("line", "branch", "toggle"))


def netlists(reports: dict, module: str) -> str:
    rows = [row for row in reports["gate"] if bare(row["netlist"]) == module]
    if not rows:
        return ""
    wrong, families = sum(row["mismatches"] for row in rows), sorted({row["family"] for row in rows})
    return f"{wrong} differ" if wrong else f"equal on {', '.join(families)}"


def area(reports: dict, module: str) -> str:
    row = reports["synth"].get(module, {}).get("ecp5")
    return f"{row['lut']} / {row['ff']} / {row['dsp']}" if row else ""


def clock(reports: dict, module: str) -> str:
    row = reports["synth"].get(module, {}).get("ecp5")
    return f"{row['fmax_mhz']:.0f}" if row and row.get("fmax_mhz") else ""


COLUMNS: dict[str, tuple[str, Callable[[dict, str], str]]] = {  # heading: the report that it needs, function
    "Exact": ("units", exact),
    "Proven": ("formal", proven),
    "Mutants killed": ("mutants", killed),
    "Line / branch / toggle %": ("coverage", covered),
    "Netlist": ("gate", netlists),
    "LUT / FF / DSP": ("synth", area),
    "MHz": ("synth", clock),
}


def summary(reports: dict, faults: Faults) -> list[tuple[str, list[str]]]:
    """Every module with what was found of it."""
    rows = [(module, []) for module in modules()]
    for heading, (name, function) in COLUMNS.items():
        if name in reports:
            cells = part(
                f"summary, {heading}", lambda f=function: [f(reports, m) for m, _ in rows], faults, [""] * len(rows)
            )
        else:
            cells = [""] * len(rows)
        for (_, row), cell in zip(rows, cells, strict=True):
            row.append(cell)
    return rows


def bad(cell: str) -> bool:
    """Does a cell of the summary tell of something wrong?"""
    return bool(re.search(r"differ|failed", cell))


# ---- frames and plots ----------------------------------------------------------------------------------------------


def address(kind: str, content: bytes) -> str:
    """An address that holds a picture."""
    return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"


def inline(path: Path) -> str:
    """A picture in a file as an address that holds it."""
    return address({"svg": "svg+xml"}.get(path.suffix[1:], path.suffix[1:]), path.read_bytes())


def frames(build: Path) -> Iterator[dict]:
    """Rendered frames: pictures and figures."""
    for path in sorted(build.glob("render/*/report.json")):
        pictures = {name: path.with_name(f"{name}.png") for name in PICTURES}
        if all(picture.exists() for picture in pictures.values()):
            report = json.loads(path.read_text())
            figures = {key.replace("_", " "): _short(report[key]) for key in FRAME_KEYS if report.get(key) is not None}
            shown = {name: inline(picture) for name, picture in pictures.items()}
            yield {"name": path.parent.name, "figures": figures, "pictures": shown}


def _short(value: object) -> str:
    return f"{value:,}" if isinstance(value, int) else f"{value:.3g}" if isinstance(value, float) else str(value)


def pareto(machines: dict) -> Iterator[tuple[str, str]]:
    """LUT and DSP against pixels a clock on the head of 1024, a point a machine."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "polyshade"
    from matplotlib import pyplot

    for key, what in (("lut", "LUT"), ("dsp", "DSP")):
        figure, axes = pyplot.subplots(figsize=(7, 4.2))
        for path in sorted({name.partition("/")[0] for name in machines}):
            own = {name: row for name, row in machines.items() if name.partition("/")[0] == path and row.get(key)}
            places = [(row["pixels_per_clock"]["head1024"], row[key]) for row in own.values()]
            axes.plot(*zip(*places, strict=True), "o", label=path) if places else None
            for name, place in zip(own, places, strict=True):
                axes.annotate(name.partition("/")[2], place, xytext=(5, 4), textcoords="offset points", fontsize=7)
        axes.set(xlabel="pixels a clock, head 1024 × 1024", ylabel=what)
        axes.grid(alpha=0.3)
        axes.legend()
        out = io.BytesIO()
        figure.savefig(out, format="svg", bbox_inches="tight", metadata={"Date": None})
        pyplot.close(figure)
        yield f"{what} against pixels a clock of every machine", address("svg+xml", out.getvalue())


def figures(build: Path) -> Iterator[tuple[str, str]]:
    """The papers' figures, drawn again."""
    for path in sorted([*build.glob("papers/*.svg"), *build.glob("papers/*.png")]):
        yield path.stem.replace("_", " ").replace("-", " "), inline(path)


# ---- the page ------------------------------------------------------------------------------------------------------


def commit() -> str:
    """The commit that is checked out; a mark when files differ from it."""
    told = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True)
    return told.stdout.strip() or "unknown"


def page(build: Path = BUILD) -> tuple[str, Faults]:
    """The page, and what is missing in it."""
    faults: Faults = []
    reports = load(build, faults)
    shown = part("frames", lambda: list(frames(build)), faults, [])
    if not shown:
        faults.append("frames: none rendered, make leaves one")
    rows = summary(reports, faults)
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent), autoescape=select_autoescape(["j2"]), undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.tests["bad"] = bad
    machines = reports.get("machines", {})
    plots = part("machines", lambda: list(pareto(machines)) if machines else [], faults, [])
    papers = part("figures of the papers", lambda: list(figures(build)), faults, [])

    def made(template: str, **values: object) -> str:
        return environment.get_template(template).render(**values)

    sections = {}
    for name in ("papers", "machines", "budget", "mutants", "coverage", "formal", "soak"):
        if name in reports:
            values = {"report": reports[name], "plots": plots, "figures": papers, "name": name}
            try:
                sections[name] = Markup(made("sections.html.j2", **values))
            except Exception as error:  # a report of another shape may fail in a template in any way
                faults.append(f"{name}: cannot be shown ({type(error).__name__}: {error})")
    tools = part("versions", versions, faults, {})
    seeds = {name: found["seeds"] for name, found in reports.items() if isinstance(found, dict) and "seeds" in found}
    date = datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%d %H:%M UTC")
    text = made(
        TEMPLATE, columns=list(COLUMNS), rows=rows, frames=shown, faults=faults, sections=sections, tools=tools,
        seeds=seeds, commit=commit(), date=date,
    )  # fmt: skip
    return text, faults


def main() -> int:
    """Write the page and tell what it lacks."""
    text, faults = page()
    out = BUILD / "report" / "index.html"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(text)
    for fault in faults:
        print(fault)
    print(f"{out.relative_to(ROOT)}: {len(text) // 1024} KiB, {len(faults)} parts are missing")
    return 0
