# SPDX-License-Identifier: Apache-2.0
"""Synthesis: every unit maps to an ECP5, and the figures that the product promises hold.

``make synth`` measures everything; here one placer seed of the modules with a promise is enough, the margins are wide.
"""

import json

import pytest
from polyshade.scripts.flow import synth, tools
from polyshade.sim.errors import UserError
from polyshade.sim.verilate import reached


@pytest.fixture(autouse=True)
def work(tmp_path, monkeypatch) -> None:
    """Keep the kept results of ``make synth`` out of the tests, and the tests out of them."""
    monkeypatch.setattr(synth, "WORK", tmp_path)
    monkeypatch.setattr(synth, "OUT", tmp_path / "synth.json")


def fast(name: str) -> dict[str, float]:
    """Area and clock rate of a module at its default parameters on an ECP5, with one seed."""
    design = synth.designs([name])[0]
    synth.elaborate(design)
    result = synth.synthesize(design, "ecp5")
    result["lut"], result["fmax_mhz"] = synth.place_and_route(design.folder / "ecp5", seeds=(1,))
    return result


# what is made of many modules takes minutes: those are left to make synth
UNITS = [design for design in synth.designs() if design.module in synth.modules() and len(design.files) < 20]
SAMPLE = [design.name for design in UNITS if len(design.files) < 4 and not design.point][::4]


@pytest.mark.parametrize(
    "design",
    [pytest.param(design, marks=() if design.name in SAMPLE else pytest.mark.full) for design in UNITS],
    ids=lambda design: design.name,
)
def test_every_unit_maps(design: synth.Design) -> None:
    """Every unit and variant synthesizes, by default a few; only what multiplies takes DSP blocks."""
    synth.elaborate(design)
    result = synth.synthesize(design, "ecp5")
    assert sum(result[name] for name in ("lut", "ff", "dsp", "bram")) > 0
    multiplies = any(path.stem == "shade_mul" for path in reached(design.module))
    if not multiplies or design.point.get("EVALUATOR") == 1:
        assert result["dsp"] == 0


@pytest.mark.full
def test_coefficients_against_the_naive_form() -> None:
    """shade_coef: no DSP, at least 5 times the clock rate of ``*`` and ``/ 3`` in one step, at no more LUTs."""
    ours, naive = fast("shade_coef"), fast("yardstick_coef")
    assert ours["dsp"] == 0
    assert ours["fmax_mhz"] >= 5 * naive["fmax_mhz"]
    assert ours["lut"] <= naive["lut"]


@pytest.mark.full
def test_horner_against_a_bare_multiplier() -> None:
    """shade_horner_pipe: at least 0.8 of the clock rate of a registered 18 x 18 multiplier."""
    assert fast("shade_horner_pipe")["fmax_mhz"] >= 0.8 * fast("yardstick_multiplier")["fmax_mhz"]


def test_harness_registers_every_port() -> None:
    """Inputs and outputs get a register each, the clock is passed on, a module without one gets it."""
    ports = {
        "clk_i": {"direction": "input", "bits": [2]},
        "a_i": {"direction": "input", "bits": [3, 4]},
        "y_o": {"direction": "output", "bits": [5]},
    }
    text = synth.harness(ports)
    assert "always @(posedge clk_i) a_i_q <= a_i;" in text
    assert "always @(posedge clk_i) y_o_q <= y_o_d;" in text
    assert "unit u_unit (.clk_i(clk_i), .a_i(a_i_q), .y_o(y_o_d));" in text
    assert ".clk_i(" not in synth.harness({"a_i": ports["a_i"]})


@pytest.mark.parametrize(
    ("family", "cells", "expected"),
    [
        ("ecp5", {"LUT4": 3, "CCU2C": 2, "PFUMX": 9, "L6MUX21": 9, "TRELLIS_DPR16X4": 1}, (13, 0, 0, 0)),
        ("ecp5", {"TRELLIS_FF": 5, "MULT18X18D": 2, "DP16KD": 1, "PDPW16KD": 1}, (0, 5, 2, 2)),
        ("ice40", {"SB_LUT4": 4, "SB_CARRY": 4, "SB_DFFSR": 2, "SB_MAC16": 1, "SB_RAM40_4K": 3}, (4, 2, 1, 3)),
        ("gowin", {"LUT3": 2, "ALU": 8, "MUX2_LUT5": 5, "DFFRE": 4, "MULT18X18": 1, "SDPB": 1}, (10, 4, 1, 1)),
        ("xilinx7", {"LUT6": 2, "CARRY4": 3, "MUXF7": 1, "SRL16E": 2, "RAM32M": 1, "FDRE": 7}, (8, 7, 0, 0)),
        ("nexus", {"LUT4": 1, "CCU2": 2, "FD1P3IX": 3, "MULT18X18": 4, "PDPSC16K": 5}, (5, 3, 4, 5)),
        ("machxo2", {"LUT4": 1, "CCU2D": 1, "TRELLIS_FF": 2, "DP8KC": 3}, (3, 2, 0, 3)),
        ("gatemate", {"CC_L2T4": 1, "CC_ADDF": 2, "CC_DFF": 3, "CC_MULT": 4, "CC_BRAM_40K": 5}, (3, 3, 4, 10)),
        ("cyclonev", {"MISTRAL_ALUT6": 1, "MISTRAL_FF": 2, "MISTRAL_MUL18X18": 3, "MISTRAL_M10K": 4}, (1, 2, 3, 4)),
        ("polarfire", {"CFG3": 1, "ARI1": 1, "SLE": 2, "MACC_PA": 3, "RAM1K20": 4}, (2, 2, 3, 4)),
        ("efinix", {"EFX_LUT4": 1, "EFX_ADD": 1, "EFX_FF": 2, "EFX_RAM_5K": 4}, (2, 2, 0, 4)),
        ("ultrascale", {"LUT6": 1, "FDRE": 2, "DSP48E2": 3, "RAMB18E2": 1, "RAMB36E2": 1}, (1, 2, 3, 3)),
        ("xilinx7", {"DSP48E1": 2, "RAMB18E1": 1, "RAMB36E1": 1}, (0, 0, 2, 3)),
    ],
)
def test_count(family: str, cells: dict[str, int], expected: tuple[int, ...]) -> None:
    """Cells count for what they occupy; wide multiplexers and carry chains for nothing of their own."""
    assert tuple(synth.count(family, cells)[part] for part in ("lut", "ff", "dsp", "bram")) == expected


def test_report(monkeypatch) -> None:
    """The report has the four families, the ECP5's LUTs and clock rate are nextpnr's."""
    monkeypatch.setattr(synth, "place_and_route", lambda folder: (7, 123.4))
    report = synth.main(["shade_round"])
    assert report == json.loads(synth.OUT.read_text())
    assert list(report["shade_round"]) == ["ecp5", "ice40", "gowin", "xilinx7"]
    assert report["shade_round"]["ecp5"] == {"lut": 7, "ff": 0, "dsp": 0, "bram": 0, "fmax_mhz": 123.4}
    assert report["shade_round"]["xilinx7"]["fmax_mhz"] is None


def test_kept_results(monkeypatch) -> None:
    """An unchanged netlist is not synthesized again, not even at another place in its file; a changed one is."""
    monkeypatch.setattr(synth, "place_and_route", lambda folder: (7, 123.4))
    runs = []
    monkeypatch.setattr(synth, "synthesize", lambda *given: runs.append(given) or {"lut": 0})
    design = synth.designs(["shade_round"])[0]
    netlist = synth.elaborate(design)
    file = synth.modules()["shade_round"]
    moved = synth.WORK / file.name
    moved.write_text("// moved\n" + file.read_text())
    files = [moved if path == file else path for path in design.files]
    assert synth.elaborate(synth.Design("shade_round", {}, files)) == netlist

    for _ in range(2):
        assert synth.measure(design, "ecp5", netlist) == {"lut": 7, "fmax_mhz": 123.4}
    assert len(runs) == 1
    synth.measure(design, "ecp5", netlist + " ")
    monkeypatch.setattr(synth, "SEEDS", (1,))
    synth.measure(design, "ecp5", netlist + " ")
    assert len(runs) == 3


def test_unknown_module() -> None:
    """A name that is none is refused with the names that are."""
    with pytest.raises(UserError, match="shade_nothing: no such module, allowed shade_"):
        synth.main(["shade_nothing"])


def test_unknown_family() -> None:
    """So is a family, before any work."""
    with pytest.raises(UserError, match=r"^virtex: no such family, allowed ecp5, ice40, nexus, machxo2, gowin, gate"):
        synth.main(["shade_round"], ("virtex",))
    assert not synth.OUT.exists()


def test_named_family(monkeypatch) -> None:
    """It is placed, its entry is added to those that are there; where it does not fit, the report tells why."""
    monkeypatch.setattr(synth, "place_and_route", lambda folder: (7, 123.4))

    def synthesize(design: synth.Design, name: str) -> dict[str, int]:
        (design.folder / name).mkdir()
        return {"lut": 3, "ff": 0, "dsp": 0, "bram": 0}

    monkeypatch.setattr(synth, "synthesize", synthesize)
    synth.main(["shade_round"])

    def nextpnr(*_given) -> str:
        raise UserError("nextpnr-nexus.log: ERROR: no room")

    monkeypatch.setattr(tools, "nextpnr", nextpnr)
    report = synth.main(["shade_round"], ("nexus",))
    assert list(report["shade_round"]) == ["ecp5", "ice40", "gowin", "xilinx7", "nexus"]
    assert report["shade_round"]["nexus"]["lut"] == 3
    assert report["shade_round"]["nexus"]["fmax_mhz"] is None
    assert report["shade_round"]["nexus"]["unplaced"] == "no room"


def test_a_tool_that_fails_tells_its_cause(tmp_path) -> None:
    """The message of the tool and the place of its log, in one line."""
    with pytest.raises(UserError, match=r"yosys.log: ERROR: No such command: nonsense"):
        tools.yosys("nonsense", tmp_path)
    assert (tmp_path / "yosys.log").exists()


@pytest.mark.full
def test_nextpnr_that_fails_tells_its_cause(tmp_path) -> None:
    with pytest.raises(UserError, match=r"nextpnr-ecp5.log: "):
        tools.nextpnr_ecp5(["--json", "absent.json"], tmp_path)
