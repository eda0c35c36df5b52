# SPDX-License-Identifier: Apache-2.0
"""Documents: every rule about what they mention bites; tables are those of the extract, which follows the reports."""

import json
from pathlib import Path

import pytest
from polyshade.scripts.drawings import tables
from polyshade.scripts.flow import documents
from polyshade.sim.sources import ROOT


def test_repository() -> None:
    """Nothing is mentioned that does not exist, and every table is current."""
    assert documents.check() == []
    assert tables.check() == []


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("see [it](docs/nowhere.md)", "link to docs/nowhere.md, which does not exist"),
        ("see [it](#no-heading)", "link to #no-heading, a section that does not exist"),
        ("see [it](docs/glossary.md#hardware-2)", "link to docs/glossary.md#hardware-2, a section that does not exist"),
        ("`golden/nothing.py`", "names the file golden/nothing.py, which does not exist"),
        ('as told in README, "Nothing"', 'names the section "Nothing" of README, which does not exist'),
        ("`make nothing`", "names the command make nothing, which does not exist"),
        ("```sh\nmake nothing\n```", "names the command make nothing, which does not exist"),
        ("`polyshade nothing`", "names the command polyshade nothing, which does not exist"),
        (".venv/bin/polyshade nothing", "names the command polyshade nothing, which does not exist"),
    ],
)
def test_what_does_not_exist_is_told(text: str, fault: str) -> None:
    """One fault, and none for what exists."""
    good = (
        '[a](docs/glossary.md#hardware) `golden/poly.py` poly.py README, "What it does" `make test` `polyshade render`'
    )
    found = [*documents.links(ROOT, "README.md", text), *documents.mentions(ROOT, "README.md", text)]
    assert found == [f"README.md: {fault}"]
    assert [*documents.links(ROOT, "README.md", good), *documents.mentions(ROOT, "README.md", good)] == []


def test_header_names_modules() -> None:
    """A module in a comment that is none."""
    text = "// shade_core: as shade_corona, shade_pkg, shade_coef_*\nmodule shade_core;"
    assert [*documents.header("x.sv", text)] == ["x.sv: names the module shade_corona, which does not exist"]


def test_tables_follow_the_reports(tmp_path: Path, monkeypatch) -> None:
    """A report in ``build`` renews its part of the extract alone; a document that differs is told."""
    part = {"lut": 10, "ff": 20, "dsp": 3, "bram": 0, "fmax_mhz": 99.6}
    (tmp_path / "synth.json").write_text(json.dumps({"shade_light": {"ecp5": part}}))
    figures = tables.extract({"synth": {}, "bench": {"x": {"value": 1.0, "unit": "m"}}}, tmp_path)
    assert figures["bench"] == {"x": {"value": 1.0, "unit": "m"}}
    text = "before\n<!-- table: synth -->\nold\n<!-- end -->\nafter\n"
    made = tables.filled(text, figures)
    assert made.splitlines()[2:5] == [
        "| module | LUT | FF | DSP | block RAM | MHz |",
        "| --- | ---: | ---: | ---: | ---: | ---: |",
        "| `shade_light` | 10 | 20 | 3 | 0 | 100 |",
    ]
    assert tables.filled(made, figures) == made

    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text(text)
    (tmp_path / "docs" / "figures.json").write_text(json.dumps(figures))
    monkeypatch.setattr(tables, "ROOT", tmp_path)
    monkeypatch.setattr(tables, "FIGURES", tmp_path / "docs" / "figures.json")
    assert tables.check() == ["README.md: its tables are not those of docs/figures.json, run `make tables`"]
    (tmp_path / "README.md").write_text(made)
    assert tables.check() == []


MACHINE = {
    "lut": 1, "ff": 2, "dsp": 3, "bram": 4, "fmax_mhz": 150.0, "pixels_per_clock": {"head1024": 0.95},
    "evaluations_per_pixel": {"32": 0.2}, "nmse_diffuse": {"32": 1e-7}, "nmse_specular": {"32": 2.5e-6},
}  # fmt: skip
ECP5 = {"lut": 1, "ff": 2, "dsp": 3, "bram": 4, "fmax_mhz": 5.0}
SYNTH = {"m": {"ecp5": ECP5, "xilinx": None}, "shade_direct": {"ecp5": ECP5}}
REPORTS = {
    "families": SYNTH,
    "machines": {"patch/4/all/4": MACHINE, "direct/1/blinn/1": MACHINE},
    "synth": SYNTH,
    "units": {"m/refined": {"vectors": 1, "exhaustive": True, "mismatches": 0, "max_error_ulp": 0.5}},
    "papers": [{"paper": "P1", "claim": "c", "claimed": "1", "measured": "2", "holds": False}],
    "bench": {"b": {"value": 12345678.0, "unit": "u", "versus": "v", "ratio": 2.0}},
    "gallery": {"frames": [{"model": "blinn", "energy": "none", "form": "paper", "nmse_diffuse": 1e-9}]},
    "formal": [{"module": "m", "property": "p", "engine": "pdr", "depth": 3, "result": "bounded", "seconds": 1.0}],
}


def test_every_table_is_made(tmp_path: Path) -> None:
    """Each from a report of its shape, and with a word for a report that is not there."""
    for part, (name, _) in tables.REPORTS.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(json.dumps(REPORTS[part]))
    figures = tables.extract({}, tmp_path)
    for name in tables.TABLES:
        text = f"<!-- table: {name} -->\n<!-- end -->"
        assert tables.filled(text, figures).count("\n|") >= 2, name
        assert ("Not measured yet" in tables.filled(text, {})) == (not name.startswith("short_"))
    shown = tables.filled("<!-- table: machines -->\n<!-- end -->", figures)
    assert "| patch, 4 lanes, 6 models, 4 lights | 1 | 2 | 3 | 150 | 0.950 | – | 0.20 | 1.0e-7 | 2.5e-6 |" in shown


def test_reports_that_are_not_there(tmp_path: Path) -> None:
    """A line for each; what the documents show stays, also when a report holds a few modules only."""
    before, lines = {"synth": {key: {} for key in "abc"}, "formal": {"m": {}}}, []
    (tmp_path / "synth.json").write_text(json.dumps({"m": SYNTH["m"]}))
    assert tables.extract(before, tmp_path, lines.append) == before
    assert "build/synth.json: 1 of 3 entries, its tables stay as they are: make synth" in lines
    assert "build/gallery/report.json: not there, its tables stay as they are: polyshade gallery" in lines
    assert len(lines) == len(tables.REPORTS)
