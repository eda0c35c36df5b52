# SPDX-License-Identifier: Apache-2.0
"""The tables of the documents, made from what was measured: ``make tables`` (``--check``: compare).

Long runs leave their results in ``build/*.json``. ``docs/figures.json`` keeps the extract of them that the documents
show; a report that is not in ``build`` leaves its part of the extract as it is. A table stands in a document between
``<!-- table: NAME -->`` and ``<!-- end -->``; ``make lint`` compares it with the extract.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from polyshade.scripts.flow.families import FAMILIES
from polyshade.scripts.report import save
from polyshade.sim.sources import BUILD, ROOT

FIGURES = ROOT / "docs" / "figures.json"
DOCUMENTS = ("README.md", "docs/results.md", "docs/architecture.md", "docs/integration.md")
BLOCK = re.compile(r"(<!-- table: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
SHORT = ("direct/1/blinn/1", "patch/1/blinn/1", "patch/4/blinn/1", "line/1/blinn/1", "vector/1/blinn/1")
UNIT_KEYS = ("vectors", "exhaustive", "mismatches", "max_error_ulp", "max_error_ideal", "latency", "throughput")
Figures = dict[str, object]


def rounded(value: object, digits: int = 4) -> object:
    """The same with all real numbers cut to so many digits: what a table shows, not what a disk can hold."""
    if isinstance(value, dict):
        return {key: rounded(each, digits) for key, each in value.items()}
    if isinstance(value, list):
        return [rounded(each, digits) for each in value]
    return float(f"{value:.{digits}g}") if isinstance(value, float) else value


def of_synth(report: dict) -> Figures:
    """Area and clock rate of every module, families with an entry."""
    return {name: {family: part for family, part in found.items() if part} for name, found in report.items()}


def of_families(report: dict) -> Figures:
    """The direct form on every family."""
    return report.get("shade_direct", {})


def of_units(report: dict) -> Figures:
    """What was compared and the worst error; the input that causes it stays in the report."""
    return {name: {key: entry.get(key) for key in UNIT_KEYS} for name, entry in report.items()}


def of_papers(report: list) -> list:
    """Claims as they are."""
    return report


def of_gallery(report: dict) -> list:
    """Errors of every model and form."""
    keys = ("model", "energy", "form", "nmse_diffuse", "nmse_specular", "light_evaluations_per_pixel", "mismatches")
    return [{key: frame.get(key) for key in keys} for frame in report["frames"]]


def of_formal(report: list) -> Figures:
    """Of every module the number of properties by result, and the least depth of the bounded ones."""
    modules: dict[str, dict] = {}
    for entry in report:
        row = modules.setdefault(entry["module"], {"proven": 0, "bounded": 0, "failed": 0, "depth": None})
        row[entry["result"]] += 1
        if entry["result"] == "bounded":
            row["depth"] = min(entry["depth"], row["depth"] or entry["depth"])
    return modules


def as_it_is(report: dict) -> Figures:
    """The whole report."""
    return report


REPORTS: dict[str, tuple[str, Callable]] = {  # part of the extract: report in build, what is taken of it
    "machines": ("machines.json", as_it_is),
    "synth": ("synth.json", of_synth),
    "families": ("synth.json", of_families),
    "units": ("units.json", of_units),
    "papers": ("papers.json", of_papers),
    "bench": ("bench.json", as_it_is),
    "gallery": ("gallery/report.json", of_gallery),
    "formal": ("formal.json", of_formal),
}


def extract(figures: Figures, build: Path = BUILD, told: Callable[[str], None] = print) -> Figures:
    """The extract, with the parts renewed whose report is there; ``told`` which are not, or hold a part of it."""
    for part, (name, take) in REPORTS.items():
        if not (build / name).exists():
            told(f"build/{name}: not there, its tables stay as they are: {command(part)}")
            continue
        made, before = rounded(take(json.loads((build / name).read_text()))), figures.get(part, ())
        if not made or 2 * len(made) < len(before):  # of a run that was asked for a few modules
            told(f"build/{name}: {len(made)} of {len(before)} entries, its tables stay as they are: {command(part)}")
            continue
        figures = figures | {part: made}
    return figures


def command(part: str) -> str:
    """By what a report is made."""
    return {"gallery": "polyshade gallery", "families": "polyshade synth shade_direct"}.get(part, f"make {part}")


# ---- tables --------------------------------------------------------------------------------------------------------


def markdown(head: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    """A table: the first column to the left, the others to the right."""
    head = list(head)
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "".join("| " + " | ".join("–" if cell is None else str(cell) for cell in line) + " |\n" for line in lines)


def small(value: float | None) -> str | None:
    """An error, or any number of many magnitudes."""
    return None if value is None else f"{value:.1e}".replace("e-0", "e-").replace("e+0", "e")


def fixed(value: float | None, digits: int = 2) -> str | None:
    """A number of a few digits."""
    return None if value is None else f"{value:.{digits}f}"


def machine_rows(machines: dict, names: Iterable[str]) -> Iterable[list]:
    """Of every machine area, clock, speed, sharing and error; the middle shininess of those measured."""
    for name in names:
        if not (found := machines.get(name)):
            continue
        path, lanes, models, lights = name.split("/")
        speed, shares = found["pixels_per_clock"], found["evaluations_per_pixel"]
        yield [
            f"{path}, {lanes} lane{'s' * (lanes != '1')}, {'6 models' if models == 'all' else 'Lambert, Blinn'}, "
            f"{lights} light{'s' * (lights != '1')}",
            found["lut"], found["ff"], found["dsp"], fixed(found["fmax_mhz"], 0),
            fixed(speed.get("head1024"), 3), fixed(speed.get("sphere320"), 3), fixed(shares.get("32")),
            small(found["nmse_diffuse"].get("32")), small(found["nmse_specular"].get("32")),
        ]  # fmt: skip


MACHINE_HEAD = (
    "machine", "LUT", "FF", "DSP", "MHz", "pixels a clock, head", "sphere", "evaluations a pixel", "NMSE diffuse",
    "specular",
)  # fmt: skip


def short_machines(figures: Figures) -> str:
    """The README's: which machine to choose."""
    return markdown(MACHINE_HEAD, machine_rows(figures["machines"], SHORT))


def machines(figures: Figures) -> str:
    """All of them."""
    return markdown(MACHINE_HEAD, machine_rows(figures["machines"], figures["machines"]))


def choice(figures: Figures) -> str:
    """Cost for a rate of pixels; bold: no other machine is at least as good in all five."""
    costs = {}
    for name, each in figures["machines"].items():
        rate = each["fmax_mhz"] * each["pixels_per_clock"]["head1024"]
        costs[name] = (each["lut"], each["ff"], each["dsp"], -rate, each["nmse_specular"]["32"])

    def beaten(own: tuple) -> bool:
        return any(other != own and all(a <= b for a, b in zip(other, own, strict=True)) for other in costs.values())

    rows = []
    for name, own in sorted(costs.items(), key=lambda pair: pair[1][3]):
        *area, rate, error = own
        shown = name if beaten(own) else f"**{name}**"
        rows.append([shown, *area, fixed(-rate, 0), fixed(area[0] / -rate, 1), small(error)])
    return markdown(["machine", "LUT", "FF", "DSP", "Mpixel/s", "LUT per Mpixel/s", "NMSE specular, n = 32"], rows)


AREA = ("lut", "ff", "dsp", "bram")


def synth(figures: Figures) -> str:
    """ECP5 of every module and point; other families where they were measured."""
    families = sorted({family for found in figures["synth"].values() for family in found} - {"ecp5"})
    head = ["module", "LUT", "FF", "DSP", "block RAM", "MHz", *(f"{family} LUT / FF / DSP" for family in families)]
    rows = []
    for name, found in sorted(figures["synth"].items()):
        ecp5 = found.get("ecp5", {})
        row = [f"`{name}`", *(ecp5.get(key) for key in AREA), fixed(ecp5.get("fmax_mhz"), 0)]
        others = (found.get(family) for family in families)
        rows.append(row + [each and f"{each['lut']} / {each['ff']} / {each['dsp']}" for each in others])
    return markdown(head, rows)


def families(figures: Figures) -> str:
    """The direct form on every family: area; clock rate, or why there is none."""
    head = ["family", "device", *(key.upper() for key in AREA[:3]), "block RAM", "MHz", "not placed"]
    rows = []
    for name, each in FAMILIES.items():
        if found := figures["families"].get(name):
            no = "not placed yet" if each.placer else "Yosys alone"
            why = found.get("unplaced", None if found["fmax_mhz"] else no)
            device = each.placer.device if each.placer else None
            rows.append([each.title, device, *(found[key] for key in AREA), fixed(found["fmax_mhz"], 0), why])
    return markdown(head, rows)


def units(figures: Figures) -> str:
    """Every unit: vectors, worst error, latency, throughput."""
    head = ["unit / form", "vectors", "all inputs", "mismatches", "worst error, ulp", "latency", "per clock"]
    rows = (
        [f"`{name}`", each["vectors"], "yes" if each["exhaustive"] else "", each["mismatches"],
         fixed(each["max_error_ulp"], 3), each["latency"], each["throughput"]]
        for name, each in figures["units"].items()
    )  # fmt: skip
    return markdown(head, rows)


def papers(figures: Figures) -> str:
    """Every claim."""
    head = ["claim", "paper", "claimed", "measured", "holds"]
    rows = (
        [each["claim"], each["paper"], each["claimed"], each["measured"], "yes" if each["holds"] else "no"]
        for each in figures["papers"]
    )
    return markdown(head, rows)


def bench(figures: Figures) -> str:
    """Speeds and gains."""
    rows = (
        [name, f"{each['value']:.4g}", each["unit"], each.get("versus"), fixed(each.get("ratio"), 2)]
        for name, each in figures["bench"].items()
    )
    return markdown(["what", "value", "unit", "versus", "ratio"], rows)


def models(figures: Figures) -> str:
    """Errors of every model and form."""
    head = ["model", "energy scale", "form", "NMSE diffuse", "NMSE specular", "evaluations a pixel", "mismatches"]
    rows = (
        [each["model"], each["energy"], each["form"], small(each["nmse_diffuse"]), small(each["nmse_specular"]),
         fixed(each["light_evaluations_per_pixel"]), each["mismatches"]]
        for each in figures["gallery"]
    )  # fmt: skip
    return markdown(head, rows)


def formal(figures: Figures) -> str:
    """Of every module the number of properties proven, bounded, failed."""
    rows = (
        [f"`{name}`", each["proven"], each["bounded"], each["depth"], each["failed"]]
        for name, each in figures["formal"].items()
    )
    return markdown(["module", "proven", "bounded", "least depth", "failed"], rows)


TABLES: dict[str, tuple[str, Callable[[Figures], str]]] = {  # name: part of the extract, function
    "short_machines": ("machines", short_machines),
    "machines": ("machines", machines),
    "choice": ("machines", choice),
    "synth": ("synth", synth),
    "families": ("families", families),
    "units": ("units", units),
    "papers": ("papers", papers),
    "bench": ("bench", bench),
    "models": ("gallery", models),
    "formal": ("formal", formal),
}


def filled(text: str, figures: Figures) -> str:
    """A document with its tables renewed."""

    def block(match: re.Match) -> str:
        part, made = TABLES[match[2]]
        missing = "" if match[2].startswith("short_") else f"Not measured yet: `{command(part)}`, then `make tables`.\n"
        body = made(figures) if part in figures else missing
        return f"{match[1]}{body}{match[3]}"

    return BLOCK.sub(block, text)


def check() -> list[str]:
    """The documents whose tables differ from ``docs/figures.json``, a line each."""
    figures = json.loads(FIGURES.read_text())
    return [
        f"{name}: its tables are not those of docs/figures.json, run `make tables`"
        for name in DOCUMENTS
        if (ROOT / name).exists() and filled(text := (ROOT / name).read_text(), figures) != text
    ]


def main() -> int:
    """Renew extract and tables, or tell which documents are out of date."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="fail when a table on disk is not up to date")
    if parser.parse_args().check:
        faults = check()
        print("\n".join(faults), end="\n" * bool(faults))
        return int(bool(faults))
    figures = extract(json.loads(FIGURES.read_text()) if FIGURES.exists() else {})
    save(FIGURES, figures)
    for name in DOCUMENTS:
        if (ROOT / name).exists():
            (ROOT / name).write_text(filled((ROOT / name).read_text(), figures))
    return 0


if __name__ == "__main__":
    sys.exit(main())
