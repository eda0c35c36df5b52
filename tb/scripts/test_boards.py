# SPDX-License-Identifier: Apache-2.0
"""The boards: tables, the golden model of what the machine draws, symbols of DVI, and the whole board in Verilator."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from polyshade.scripts import boards
from polyshade.scripts.boards import ulx3s
from polyshade.scripts.boards.decimate import decimate
from polyshade.sim import tools, verilate
from polyshade.sim.errors import UserError
from polyshade.sim.scene.sphere import sphere
from polyshade.sim.sources import ROOT


def test_unknown_board() -> None:
    with pytest.raises(UserError, match=r"^ulx4s: no such board, allowed ulx3s$"):
        boards.main("ulx4s")


def test_decimate() -> None:
    """A sphere stays closed, outside stays outside, and all of it is of its own vertices."""
    vertices, faces = sphere(2)
    fewer = decimate(vertices, faces, 60)
    assert len(np.unique(fewer)) == 60
    edges = {tuple(edge) for f in fewer.tolist() for edge in zip(f, f[1:] + f[:1], strict=True)}
    assert len(edges) == 3 * len(fewer) and all((b, a) in edges for a, b in edges)
    a, b, c = (vertices[fewer[:, i]] for i in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) > 0).all()


def test_tables_fit() -> None:
    """Places and normals in 16 bits at every angle, at most 512 vertices and 1024 triangles, 15 words a choice."""
    head = ulx3s.head()
    assert len(head.places) <= 512 and len(head.faces) <= 1024
    for step in range(256):
        sent = ulx3s.turned(step)
        assert sent.x.min() >= 0 and sent.x.max() < 1 << 17
        assert sent.y.min() >= 0 and sent.y.max() < 1 << 16
        assert sent.depth.min() > 0 and sent.depth.max() < 1 << 24
        assert np.abs(sent.normal).max() < 1 << 16
    lines = {name: text.splitlines() for name, text in ulx3s.tables().items()}
    assert {name: len(rows) for name, rows in lines.items()} == {
        "vertices.hex": 512, "triangles.hex": 1024, "angles.hex": 256, "settings.hex": 512,
    }  # fmt: skip


def encode(byte: int, more: int) -> tuple[int, int]:
    """A byte's symbol and the balance behind it, by the flow chart of DVI 1.0, Figure 3-5."""
    ones = byte.bit_count()
    invert = ones > 4 or (ones == 4 and not byte & 1)
    q = [byte & 1]
    for i in range(1, 8):
        bit = q[-1] ^ byte >> i & 1
        q.append(1 - bit if invert else bit)
    word, xor = sum(bit << i for i, bit in enumerate(q)), int(not invert)
    n1, n0 = sum(q), 8 - sum(q)
    if more == 0 or n1 == n0:
        symbol = (1 - xor) << 9 | xor << 8 | (word if xor else word ^ 0xFF)
        return symbol, more + (n1 - n0 if xor else n0 - n1)
    if (more > 0) == (n1 > n0):
        return 1 << 9 | xor << 8 | word ^ 0xFF, more + 2 * xor + n0 - n1
    return xor << 8 | word, more - 2 * (1 - xor) + n1 - n0


def test_symbols_are_decoded() -> None:
    """Every byte at every balance that occurs."""
    more, seen = 0, set()
    for byte in np.random.default_rng(1).integers(0, 256, 50_000).tolist():
        symbol, more = encode(byte, more)
        seen.add((byte, symbol))
        assert int(ulx3s.decoded(np.array([symbol]))[0]) == byte
    assert len(seen) >= 256 + 128


def test_reads_in_verilator(tmp_path) -> None:
    """-Wall without a warning of the board's own files."""
    for name, text in ulx3s.tables().items():
        (tmp_path / name).write_text(text)
    files = [*ulx3s.sources(), *ulx3s.OWN, ulx3s.HERE / "sim" / "primitives.v"]
    command = [tools.verilator().program, "--lint-only", "-Wall", "--timing", "--top-module", "ulx3s", *files]
    done = subprocess.run(command, cwd=tmp_path, env=tools.environment(), capture_output=True, text=True)
    own = [line for line in done.stderr.splitlines() if line.startswith("%") and "boards/ulx3s/rtl" in line]
    assert not [line for line in own if "TIMESCALEMOD" not in line]
    assert "%Error" not in done.stderr.replace("%Error: Exiting due to", "")


@pytest.mark.full
def test_symbols_of_the_rtl(tmp_path) -> None:
    """board_tmds gives the symbols of the flow chart."""
    bench = tmp_path / "bench.sv"
    bytes_ = np.random.default_rng(2).integers(0, 256, 3000).tolist()
    (tmp_path / "bytes.hex").write_text("".join(f"{byte:x}\n" for byte in bytes_))
    bench.write_text("""
`timescale 1ns / 1ps
module bench;
  logic clk = 0; logic [7:0] bytes[0:2999]; logic [9:0] symbol; int i = 0; logic shown = 0;
  initial $readmemh("bytes.hex", bytes);
  always #5 clk = !clk;
  board_tmds dut (.clk_i(clk), .shown_i(shown), .data_i(bytes[i]), .control_i(2'b00), .symbol_o(symbol));
  int clocks = 0;
  always @(posedge clk) begin
    clocks <= clocks + 1;
    shown <= clocks >= 4 && i < 2999;
    if (shown) i <= i == 2999 ? i : i + 1;
    if (clocks >= 4 && clocks < 3000) $display("%0d", symbol);
    if (clocks == 3000) $finish;
  end
endmodule
""")
    program = tools.verilator().program
    options = ["--cc", "--main", "--exe", "--timing", "-Wno-fatal", "--prefix", "Vb", "--top-module", "bench"]
    options += ["--Mdir", "o"]
    verilate.run([program, *options, ulx3s.HERE / "rtl" / "board_tmds.sv", bench], tmp_path)
    verilate.run(["make", "-s", "-C", "o", "-f", "Vb.mk", *ulx3s.COMPILER, "Vb"], tmp_path)
    done = subprocess.run([tmp_path / "o" / "Vb"], cwd=tmp_path, capture_output=True, text=True, check=True)
    found = [int(line) for line in done.stdout.split("\n") if line.isdigit()]
    more, wanted = 0, []
    for byte in bytes_:
        symbol, more = encode(byte, more)
        wanted.append(symbol)
    start = found.index(wanted[0])
    assert start < 4 and found[start : start + 2900] == wanted[:2900]


@pytest.mark.full
def test_pictures_off_the_pins(tmp_path: Path) -> None:
    """Models and levels by the buttons, the head turning: every pixel of every picture is golden's."""
    shots = ulx3s.capture(8, model=2, level=4, work=tmp_path)
    assert [shot.number for shot in shots] == list(range(len(shots))) and len(shots) >= 5
    assert len({(shot.model, shot.level) for shot in shots}) == 3
    for shot in shots:
        assert np.array_equal(shot.pixels, ulx3s.picture(shot.number, shot.model, shot.level)), shot.number


def test_pins() -> None:
    """Every port of the top has a place."""
    top = (ulx3s.HERE / "rtl" / "ulx3s.sv").read_text()
    constraints = (ulx3s.HERE / "ulx3s.lpf").read_text()
    wanted = ["clk_25mhz", "wifi_gpio0", *(f"btn[{i}]" for i in range(7)), *(f"led[{i}]" for i in range(8))]
    for name in [*wanted, *(f"gpdi_dp[{i}]" for i in range(4))]:
        assert f'LOCATE COMP "{name}"' in constraints and name.split("[")[0] in top
    assert (ROOT / "boards" / "ulx3s" / "README.md").exists()
