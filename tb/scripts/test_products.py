# SPDX-License-Identifier: Apache-2.0
"""The products that the golden model counts are those that stand in the netlists of the units."""

from pathlib import Path

import pytest
from polyshade.golden import contract as k
from polyshade.golden.core import Drawn, phong_products, products
from polyshade.scripts.flow import tools
from polyshade.sim.sources import Point, label
from polyshade.sim.verilate import reached

LIGHT = k.PRODUCTS_LIGHT, k.PRODUCTS_REFLECT, k.PRODUCTS_DIVIDE
SHARED = 2, 2  # of kappa and of its weight: three products of an arc share a multiplier


def netlist(module: str, point: Point, folder: Path) -> int:
    """Multiplications of an elaborated module, constants and doubles removed."""
    files = " ".join(map(str, reached(module)))
    chosen = "".join(f" -chparam {name} {value}" for name, value in point.items())
    script = f"""
        read_verilog -sv {files}
        hierarchy -check -top {module}{chosen}
        proc
        flatten
        opt -full
        tee -q -o count.txt select -count t:$mul
    """
    tools.yosys(script, folder)
    return int((folder / "count.txt").read_text().split()[0])


@pytest.mark.parametrize(
    ("module", "point", "counted"),
    [
        ("shade_kappa", {}, k.PRODUCTS_KAPPA - SHARED[0]),
        ("shade_planner", {}, k.PRODUCTS_KAPPA + k.PRODUCTS_WEIGHT - sum(SHARED)),
        ("shade_node_walk", {}, 0),
        ("shade_unit", {}, k.PRODUCTS_UNIT),
        ("shade_normalize", {}, k.PRODUCTS_NORMALIZE),
        ("shade_horner_pipe", {}, k.PRODUCTS_HORNER),
        ("shade_poly_span", {"EVALUATOR": k.EVALUATOR_HORNER}, k.CHANNELS * k.PRODUCTS_HORNER),
        ("shade_poly_span", {"EVALUATOR": k.EVALUATOR_FDIFF}, 0),
        ("shade_light", {"REFLECT": 0, "DIVIDE": 0}, LIGHT[0]),
        ("shade_light", {"REFLECT": 1, "DIVIDE": 1}, sum(LIGHT)),
        ("shade_phong", {"REFLECT": 0, "DIVIDE": 0}, phong_products(1, reflect=0, divide=0)),
        (
            "shade_lane",
            {"PATH_NORMALS": 0, "REFLECT": 0, "DIVIDE": 0},
            products([[0, 0, 0]], Drawn([[0, 0]], [0], [0], 1), reflect=0, divide=0) - sum(SHARED),
        ),
        *(pytest.param(*case, marks=pytest.mark.full) for case in (
            ("shade_light", {"REFLECT": 1, "DIVIDE": 0}, LIGHT[0] + LIGHT[1]),
            ("shade_light", {"REFLECT": 0, "DIVIDE": 1}, LIGHT[0] + LIGHT[2]),
            ("shade_phong", {}, phong_products(1)),
            (
                "shade_lane",
                {"PATH_NORMALS": 0, "EVALUATOR": k.EVALUATOR_HORNER},
                products([[0, 0, 0]], Drawn([[0, 0]], [0], [0], 1), evaluator=k.EVALUATOR_HORNER) - sum(SHARED),
            ),
        )),
    ],
    ids=lambda value: label("", value) if isinstance(value, dict) else str(value),
)  # fmt: skip
def test_products(module: str, point: Point, counted: int, tmp_path: Path) -> None:
    """Of a whole module as the sum of its parts: those of a span of one pixel and one node."""
    assert netlist(module, point, tmp_path) == counted


def test_products_of_spans() -> None:
    """kappa's once where neighbours have the same increment, the others at every node, Horner's at every pixel."""
    drawn = Drawn([[0, 0]] * 10, [0] * 10, [0] * 3, 2)
    at_nodes = 3 * (k.PRODUCTS_UNIT + k.PRODUCTS_LIGHT)
    for g, increments in (([[1, 2, 3]] * 4, 1), ([[1, 2, 3], [1, 2, 4], [1, 2, 4], [1, 2, 3]], 3)):
        expected = increments * k.PRODUCTS_KAPPA + 4 * k.PRODUCTS_WEIGHT + at_nodes
        assert products(g, drawn, reflect=0, divide=0) == expected
        horner = products(g, drawn, evaluator=k.EVALUATOR_HORNER, reflect=0, divide=0)
        assert horner == expected + 10 * k.CHANNELS * k.PRODUCTS_HORNER
