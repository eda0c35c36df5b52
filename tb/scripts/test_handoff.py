# SPDX-License-Identifier: Apache-2.0
"""The bundle: what is in it, that it stands on its own, and that its checks bite."""

from __future__ import annotations

import json
import tarfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml
from polyshade.scripts.handoff import bundle, configurations, flows, smoke, verify
from polyshade.sim.errors import UserError
from polyshade.sim.sources import ROOT
from polyshade.sim.verilate import Port

PART = configurations.CONFIGURATIONS["direct"]


def test_unknown_configuration() -> None:
    with pytest.raises(UserError, match=r"^corr: no such configuration, allowed core, core_small, .*spans$"):
        bundle.main(["corr"])


@pytest.fixture(scope="module")
def archive(tmp_path_factory) -> Path:
    """The bundle of one machine."""
    folder = tmp_path_factory.mktemp("handoff")
    with pytest.MonkeyPatch.context() as patch:
        for name, path in {"BUILD": folder, "OUT": folder / "out", "ARCHIVE": folder / "bundle.tar.gz"}.items():
            patch.setattr(bundle, name, path)
        bundle.build([PART])
    return folder / "bundle.tar.gz"


def test_stands_on_its_own(archive) -> None:
    """Every check that needs no compilation passes, or tells what is not installed."""
    checks = verify.check(archive, [PART], slow=False)
    assert {entry["check"] for entry in checks} >= {"checksums", "own paths", "driver", "verilator", "slang", "fusesoc"}
    assert not [entry for entry in checks if entry["result"] == "failed"]


@pytest.mark.full
def test_whole_check(archive) -> None:
    """The smoke bench by Verilator on both forms of the RTL; Yosys and nextpnr by the bundle's script."""
    checks = verify.check(archive, [PART])
    assert {"smoke", "yosys", "nextpnr"} <= {entry["check"] for entry in checks}
    assert not [entry for entry in checks if entry["result"] == "failed"]


@pytest.mark.parametrize("name", ["rtl/shade_pkg.sv", "smoke/direct_out.hex", "scripts/vivado.tcl"])
def test_a_changed_file_is_told(archive, tmp_path, name: str) -> None:
    with tarfile.open(archive) as files:
        files.extractall(tmp_path, filter="data")
    (top,) = tmp_path.iterdir()
    with open(top / name, "a") as file:
        file.write("\nchanged\n")
    changed = tmp_path / "changed.tar.gz"
    with tarfile.open(changed, "w:gz") as files:
        files.add(top, top.name)
    checks = verify.check(changed, [], slow=False)
    assert [e["told"] for e in checks if e["check"] == "checksums" and e["result"] == "failed"]


def test_manifest(archive) -> None:
    with tarfile.open(archive) as files:
        told = json.load(files.extractfile(f"polyshade-{flows.RELEASE}/manifest.json"))
    assert told["configurations"]["direct"]["top"] == "shade_direct"
    assert {"name": "clk_i", "direction": "input", "width": 1} in told["configurations"]["direct"]["ports"]
    assert "verilog/direct.v" in told["sha256"]


@pytest.mark.parametrize("part", configurations.CONFIGURATIONS.values(), ids=str)
def test_lists(part: configurations.Configuration) -> None:
    """Files exist, the package first, the top last; a technology replaces what it is for."""
    for technology in ("", "ecp5"):
        names = flows.listed(part, technology)
        assert all((ROOT / name).exists() for name in names)
        modules = [name for name in names if not name.endswith("_pkg.sv")]
        assert names[0] == "rtl/shade_pkg.sv" and modules[-1].endswith(f"/{part.top}.sv")
        assert ("rtl/fixed/shade_mul.sv" in names) == (not technology)


def test_descriptions() -> None:
    """FuseSoC and Bender name files that exist; IP-XACT has every port."""
    core = yaml.safe_load(flows.fusesoc(list(configurations.CONFIGURATIONS.values())))
    names = core["filesets"]["rtl"]["files"]
    assert names and all((ROOT / name).exists() for name in names)
    root = ElementTree.fromstring(bundle.component(configurations.CONFIGURATIONS["core"]))
    space = {"x": root.tag[1:].partition("}")[0]}
    ports = [port.text for port in root.findall(".//x:ports/x:port/x:name", space)]
    assert {"clk_i", "s_axis_span_tdata", "m_axis_pixel_tdata", "s_axil_rresp"} <= set(ports)
    buses = [bus.text for bus in root.findall(".//x:busInterface/x:name", space)]
    assert buses == ["s_axis_span", "m_axis_pixel", "s_axil"]


def test_rows_are_joined_port_by_port() -> None:
    ports = [Port("a", "input", 4, False), Port("b", "input", 40, True), Port("c", "input", 64, False)]
    arrays = [np.array([1, 2]), np.array([-1, 5]), np.array([[7, 1], [8, 0]], np.uint32)]
    assert smoke._joined(ports, arrays, 2) == [1 | ((1 << 40) - 1) << 4 | (7 | 1 << 32) << 44, 2 | 5 << 4 | 8 << 44]
