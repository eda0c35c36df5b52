# SPDX-License-Identifier: Apache-2.0
"""``make report``: one page that needs nothing else, whatever is missing; looked at in a browser where there is one."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from polyshade.scripts.drawings import page
from polyshade.sim.sources import modules

from tb.runner import HANGS

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
VOID = {"meta", "img", "input", "br", "link", "hr", "use", "path", "rect"}
MACHINE = {"lut": 100, "ff": 90, "dsp": 3, "bram": 0, "fmax_mhz": 150.0, "pixels_per_clock": {"head1024": 0.9}}
REPORTS = {
    "units": {"shade_third/paper": {"vectors": 5, "mismatches": 0, "exhaustive": True},
              "shade_round/refined": {"vectors": 1000, "mismatches": 2, "exhaustive": False}},
    "formal": [{"module": "shade_fifo[LOG2=1]", "property": "order", "meaning": "a < b & c", "result": "proven",
                "engine": "pdr", "depth": 4, "mutant": True},
               {"module": "shade_fifo", "property": "inner", "meaning": "", "result": "failed", "engine": "pdr",
                "depth": 0, "mutant": None}],
    "mutants": {"shade_third": {"generated": 10, "killed": 7, "equivalent": 2, "survived": ["3: <x> inv"], "seed": 1}},
    "coverage": {"shade_third": {"line": 100.0, "branch": None, "toggle": 98.5, "holes": ["line 7"]},
                 "functional": {"core.model x path": {"per_cent": 50.0, "holes": ["model=ward"]}}},
    "gate": [{"netlist": "shade_third[WIDTH=9]", "family": "ecp5", "vectors": 9, "mismatches": 0}],
    "synth": {"shade_third": {"ecp5": {"lut": 66, "ff": 77, "dsp": 0, "fmax_mhz": 301.4}}},
    "machines": {"direct/1/blinn/1": MACHINE, "patch/4/blinn/1": MACHINE},
    "papers": [{"paper": "P1", "claim": "c", "claimed": 1, "measured": 2.5, "holds": False}],
    "budget": {"shade_unit/refined": {"formula": "v / \\|v\\|", "bound": 1.65, "worst": 1.6, "vectors": 9},
               "light": {"8": 1.0}},
    "soak": {"seconds": 3, "seeds": [1, 9], "failed": [],
             "kinds": {"unit": {"items": 2, "compared": 9, "mismatches": 0}}},
    "bench": {},
}  # fmt: skip


class Reader(HTMLParser):
    """Tags in their order, checked for balance."""

    def __init__(self, text: str):
        super().__init__()
        self.tags: list[tuple[str, dict]] = []
        self.open: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open.pop() == tag

    def all(self, tag: str) -> list[dict]:
        return [attributes for name, attributes in self.tags if name == tag]


def build(folder: Path, reports: dict) -> Path:
    for name, report in reports.items():
        (folder / f"{name}.json").write_text(report if isinstance(report, str) else json.dumps(report))
    frame = folder / "render" / "head"
    frame.mkdir(parents=True)
    for level, name in enumerate(page.PICTURES):
        Image.fromarray(np.full((32, 32, 3), 80 * level, np.uint8)).save(frame / f"{name}.png")
    (frame / "report.json").write_text(json.dumps({"mismatches": 0, "pixels": 1234, "nmse_diffuse": 1.5e-7}))
    return folder


@pytest.fixture
def whole(tmp_path: Path) -> str:
    text, faults = page.page(build(tmp_path, REPORTS))
    assert faults == []
    return text


def test_self_contained_and_accessible(whole: str) -> None:
    """No address outside, every picture with words, every control with a label, headings in order, ids that exist."""
    read = Reader(whole)
    assert not re.search(r"(src|href|url)\s*[=(]\s*[\"']?(https?:)?//", whole)
    ids = [attributes["id"] for _, attributes in read.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = [a["href"] for a in read.all("a")]
    assert links and all(link[0] == "#" and link[1:] in ids for link in links)
    assert all(image.get("alt") and image["src"].startswith("data:image/") for image in read.all("img"))
    assert len(read.all("figure")) == len(read.all("figcaption")) == 2
    labelled = {label.get("for") for label in read.all("label")}
    assert all(control["type"] == "radio" or control["id"] in labelled for control in read.all("input"))
    assert read.all("html")[0]["lang"] == "en" and len(read.all("h1")) == len(read.all("main")) == 1
    assert all(head.get("scope") for head in read.all("th"))
    assert len(read.all("caption")) == len(read.all("table"))


def test_what_it_says(whole: str) -> None:
    """A row a module, in the reports' words; what is wrong is marked; text of reports is text."""
    rows = dict(re.findall(r'<tr><th scope="row">(shade_\w+)</th>(.*?)</tr>', whole)[: len(modules())])
    assert list(rows) == list(modules())
    cells = re.findall(r"<td[^>]*>(.*?)</td>", rows["shade_third"])
    assert cells == [
        "equal, all inputs",
        "",
        "7 of 8 (88 %)",
        "100.0 / – / 98.5",
        "equal on ecp5",
        "66 / 77 / 0",
        "301",
    ]
    assert '<td class="bad">2 of 1,000 differ</td>' in rows["shade_round"]
    assert '<td class="bad">1 proven, 1 failed</td>' in rows["shade_fifo"]
    assert "a &lt; b &amp; c" in whole and "&lt;x&gt; inv" in whole and "v / |v|" in whole
    assert "seeds of soak" in whole and "1 to 9" in whole and "Not on this page" not in whole


def test_missing_and_broken_parts(tmp_path: Path) -> None:
    """The page is there, and says what is not and how to make it."""
    broken = {name: report for name, report in REPORTS.items() if name != "gate"}
    broken |= {"formal": "[{", "papers": [1], "synth": {"shade_third": {"ecp5": {}}}}
    text, faults = page.page(build(tmp_path, broken))
    Reader(text)
    told = "\n".join(faults)
    assert "gate: not measured, make gate leaves it" in told
    assert "formal: build/formal.json cannot be read" in told and "make formal makes it anew" in told
    assert "papers: cannot be shown" in told and len(faults) <= 6
    assert all(line.partition(":")[0] in text for line in faults) and "Not on this page" in text
    (tmp_path / "empty").mkdir()
    text, faults = page.page(tmp_path / "empty")
    Reader(text)
    assert len(faults) == len(page.REPORTS) + 1


@pytest.mark.skipif(not BROWSER, reason="no Chromium on this machine: only the page's structure is checked")
@pytest.mark.parametrize("width", [360, 1280])
def test_in_a_browser(whole: str, tmp_path: Path, width: int) -> None:
    """Wide and narrow: nothing sticks out, the slider cuts the picture, the other picture is chosen."""
    probe = """<script>window.addEventListener("load", function () {
      var cut = document.querySelector("input[type=range]"), under = document.querySelector(".under"), old = under.src;
      cut.value = 25; cut.dispatchEvent(new Event("input"));
      document.querySelector("input[value=difference]").click();
      document.title = [document.documentElement.scrollWidth <= window.innerWidth,
        document.querySelector(".over").style.clipPath, under.src !== old, document.images.length].join(" ");
    });</script></body>"""
    path = tmp_path / "page.html"
    path.write_text(whole.replace("</body>", probe))
    options = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}",
               f"--window-size={max(width, 500)},900", "--virtual-time-budget=5000"]  # fmt: skip
    address = path.as_uri()
    if width < 500:  # no window is narrower: a frame in the page is
        outer = tmp_path / "outer.html"
        outer.write_text(
            f'<iframe id="f" src="{path.name}" width="{width}" height="800"></iframe><script>'
            'setTimeout(function () { document.title = document.getElementById("f").contentDocument.title; }, 2000);'
            "</script>"
        )
        address, options = outer.as_uri(), [*options, "--allow-file-access-from-files"]
    dom = subprocess.run([*options, "--dump-dom", address], capture_output=True, text=True, timeout=HANGS).stdout
    assert re.search(r"<title>true inset\(0px 75% 0px 0px\) true 4</title>", dom), dom[:2000]
    shot = tmp_path / "shot.png"
    subprocess.run([*options, f"--screenshot={shot}", path.as_uri()], capture_output=True, timeout=HANGS, check=True)
    assert np.unique(np.asarray(Image.open(shot).convert("L"))).size > 20
