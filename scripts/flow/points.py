# SPDX-License-Identifier: Apache-2.0
"""Parameter points at which every module is elaborated on its own, by lint and by synthesis.

The default point is always one of them. ``REFUSED`` holds points that elaboration must refuse in words.
"""

from itertools import product

from polyshade.sim.sources import Point

SMALL: Point = {"REFLECT": 0, "DIVIDE": 0, "PATH_NORMALS": 0}  # a core with Lambert and Blinn, by polynomials
TWO: Point = {"REFLECT": 0, "DIVIDE": 0}  # Lambert and Blinn
FOLDED: Point = {"FOLD": 6, **SMALL}


def grid(**choices: list[int]) -> list[Point]:
    """Every combination of the choices: ``grid(FORM=[0, 1])`` is ``[{"FORM": 0}, {"FORM": 1}]``."""
    return [dict(zip(choices, values, strict=True)) for values in product(*choices.values())]


POINTS: dict[str, list[Point]] = {
    "shade_delay": [{"DEPTH": 0}, {"DEPTH": 17}, {"WIDTH": 1, "DEPTH": 1}, {"WIDTH": 33, "DEPTH": 3}],
    "shade_ring": [{"DEPTH": 0}, {"DEPTH": 17}, {"WIDTH": 2, "DEPTH": 51}, {"WIDTH": 18, "DEPTH": 8}, {"BLOCK": 1}],
    "shade_valid": [{"DEPTH": 2}],
    "shade_round": [
        {"WIDTH": 2, "DROP": 1},
        {"WIDTH": 40, "DROP": 16},
        {"WIDTH": 20, "DROP": 3, "OUT_W": 17},
    ],
    "shade_saturate": [{"WIDTH": 3, "OUT_W": 1}, {"WIDTH": 40, "OUT_W": 8}],
    "shade_mul": [*grid(A_W=[2, 18, 19, 35], STAGES=[0, 2]), {"A_W": 17, "B_W": 2}, {"STAGES": 3}],
    "shade_limit": [{"WIDTH": 19}, {"WIDTH": 3, "OUT_W": 2}],
    "shade_clamp": [{"WIDTH": 20, "F": 18}, {"WIDTH": 3, "F": 1}],
    "shade_square": [{"WIDTH": 2}, {"WIDTH": 11}],
    "shade_weigh": [{"K0": 0, "KX": 0, "KY": 65535, "KZ": 43691}, {"WIDTH": 6, "F": 4, "OUT_F": 2, "OUT_W": 12}],
    "shade_third": grid(WIDTH=[4, 28], FORM=[0, 1]),
    "shade_coef_a": grid(WIDTH=[3, 18, 20], NODES=[0, 1], FORM=[0, 1]),
    "shade_coef_b": grid(WIDTH=[3, 18, 20], NODES=[0, 1]),
    "shade_coef_c": grid(WIDTH=[3, 18, 20], NODES=[0, 1], FORM=[0, 1]),
    "shade_coef": grid(WIDTH=[3, 18, 20], NODES=[0, 1], FORM=[0, 1]),
    "shade_horner_step": grid(WIDTH=[8, 33], T_F=[2, 16]),
    "shade_horner_pipe": [{"COEF_W": 2, "D_W": 2, "T_F": 2}, {"COEF_W": 30, "D_W": 30}, {"COEF_W": 11, "D_W": 4}],
    "shade_horner_seq": [{"COEF_W": 2, "D_W": 2, "T_F": 2}, {"COEF_W": 30, "D_W": 30}, {"COEF_W": 11, "D_W": 4}],
    "shade_fdiff": grid(COEF_W=[2, 25], D_W=[2], LOG2_MAX=[1, 12]),
    "shade_patch_room": [{"LIMIT": 1}],
    "shade_patch_tokens": [{"WIDTH": 1, "LOG2": 5}],
    "shade_patch": [*grid(LANES=[2, 4, 8]), {"LANES": 4, "LIGHTS": 4}],
    "shade_scalar_light": grid(SIGNED=[0, 1], MEMORY=[0, 1]),
    "shade_patch_slots": [{"MEMORIES": 10}, {"WIDTH": 30, "LOG2": 4}],
    "shade_patch_door": [{"TRIANGLES_LOG2": 1}],
    **{
        f"shade_patch_{unit}": grid(LIGHTS=[2, 4])
        for unit in ("far", "boxes", "setup", "walk", "nodes", "light", "lights")
    },
    "shade_credit": [{"LOG2": 1}],
    "shade_stable": [{"WIDTH": 1}],
    "shade_fifo": [*grid(WIDTH=[1, 48], LOG2=[1, 4]), {"BLOCK": 1}],
    "shade_walk": [{"COUNT_W": 4, "CREDIT_LOG2": 1}],
    "shade_widen": [{"IN_W": 64}],
    "shade_span_walk": grid(LOG2_MAX=[2, 12], CREDIT_LOG2=[1, 6]),
    "shade_dot3": grid(OUT_F=[17, 31]),
    "shade_scale3": [{"GAIN": 1}],
    "shade_unit": grid(FOLD=[6, 2, 3, 4, 5, 7, 8]),
    "shade_half": [{"FORM": 0}],
    "shade_invc": grid(FORM=[0], DEGREE=[1, 2]),
    "shade_bisect": [{"WAIT": 2}],
    "shade_midpoint": grid(FORM=[0], DEGREE=[1, 2]),
    "shade_node_chain": grid(FORM=[0], DEGREE=[1, 2]),
    "shade_criterion": grid(FORM=[0], DEGREE=[1, 2]),
    "shade_versine": [{"FORM": 0}],
    "shade_hold": [{"DEPTH": 2}, {"WIDTH": 18, "DEPTH": 41}, {"FOLD": 1}],
    "shade_lobe": [*grid(POWER=[2, 3, 4], FOLD=[1, 6]), *grid(FOLD=[2, 3, 4, 5, 7, 8], TAKE=[1])],
    "shade_lobe_folded": [*grid(FOLD=[2, 3, 4, 5, 7, 8], TAKE=[1]), {"POWER": 2}],
    "shade_wait": [{"FOLD": 1}, {"FOLD": 2, "DEPTH": 32, "WIDTH": 20}, {"DEPTH": 1}],
    "shade_gain": grid(FOLD=[2, 3, 4, 5, 6, 7, 8], TAKE=[1]),
    "shade_angles_folded": grid(FOLD=[2, 3, 4, 5, 7, 8], FORM=[0, 1], TAKE=[1]),
    "shade_angles": [*grid(REFLECT=[0, 1], LOCAL=[0, 1]), {"FORM": 0}, {"REFLECT": 0, "FOLD": 6}],
    "shade_reflectance": [*grid(REFLECT=[0, 1], DIVIDE=[0, 1], LOCAL=[0, 1]), {"FORM": 0}, {**TWO, "FOLD": 6}],
    "shade_light": [*grid(REFLECT=[0, 1], DIVIDE=[0, 1]), {"FORM": 0}, *({**TWO, "FOLD": n} for n in range(2, 9))],
    "shade_light_local": [*grid(REFLECT=[0, 1], DIVIDE=[0, 1]), {"FORM": 0}],
    "shade_registers": [{"DIVIDE": 0, "PATH_NORMALS": 0, "COLOUR": 0}],
    "shade_paint": [{"FIFO_LOG2": 4}],
    "shade_phong": [{"REFLECT": 0, "DIVIDE": 0}, {"FORM": 0}],
    "shade_kappa": [{"PACE": 11}],
    "shade_planner": grid(LOG2_MAX=[4, 12]),
    "shade_weight": [{"PACE": 11}],
    "shade_stretch": [{"LOG2_MAX": 12}],
    "shade_raster": [{"CREDIT_LOG2": 5}],
    "shade_depth": [{"LOG2": 2}],
    "shade_frame": [{"COLUMNS_LOG2": 4, "LINES_LOG2": 3, "DOUBLE": 1}],
    "shade_scene_sites": [{"LOG2": 4}],
    "shade_scene": [{"COLUMNS_LOG2": 4, "LINES_LOG2": 4, "DOUBLE": 1}],
    "shade_node_walk": [{"CREDIT_LOG2": 1}, {"FOLD": 6}],
    "shade_line": grid(FOLD=[6, 3]),
    "shade_poly_span": [*grid(EVALUATOR=[0, 1], FORM=[0, 1]), {"NODES": 1}, {"EVALUATOR": 1, "LOG2_MAX": 4}],
    "shade_poly_start": [{"LOG2_MAX": 12}],
    "shade_poly_state": [{"LOG2_MAX": 12}],
    "shade_poly_line": [{"LOG2_MAX": 12}],
    "shade_lane": [{"EVALUATOR": 0, "FORM": 0, **SMALL}, FOLDED],
    "shade_core": [{"LANES": 4, "COLOUR": 1, "BURST": 1, **FOLDED}],
    "shade_direct_door": [{"LOG2": 1}],
    "shade_direct_line": [{"LOG2": 1}],
}

REFUSED: dict[str, list[Point]] = {
    "shade_delay": [{"WIDTH": 0}],
    "shade_ring": [{"WIDTH": 0}, {"DEPTH": -1}, {"DEPTH": 2, "BLOCK": 1}],
    "shade_valid": [{"DEPTH": 0}],
    "shade_round": [{"WIDTH": 4, "DROP": 4}, {"DROP": 0}],
    "shade_saturate": [{"WIDTH": 8, "OUT_W": 7}],
    "shade_mul": [{"A_W": 36}, {"B_W": 19}, {"STAGES": 1}],
    "shade_limit": [{"OUT_W": 1}, {"OUT_W": 21}],
    "shade_clamp": [{"WIDTH": 17}, {"F": 0}],
    "shade_square": [{"WIDTH": 1}, {"WIDTH": 19}],
    "shade_weigh": [{"WIDTH": 1}, {"OUT_F": 34}, {"KX": 87381, "KY": 87381}, {"KX": 1 << 19}, {"KZ": -(1 << 19)}],
    "shade_third": [{"WIDTH": 3}, {"WIDTH": 29}, {"FORM": 2}],
    "shade_coef_a": [{"WIDTH": 2}, {"WIDTH": 21}, {"NODES": 2}, {"FORM": 2}],
    "shade_coef_b": [{"WIDTH": 2}, {"WIDTH": 21}, {"NODES": 2}],
    "shade_coef_c": [{"WIDTH": 2}, {"WIDTH": 21}, {"NODES": 2}, {"FORM": 2}],
    "shade_horner_step": [{"WIDTH": 36}, {"T_F": 17}],
    "shade_horner_pipe": [{"COEF_W": 31}, {"D_W": 26}, {"T_F": 17}],
    "shade_horner_seq": [{"COEF_W": 31}, {"D_W": 26}, {"T_F": 17}],
    "shade_fdiff": [{"D_W": 1}, {"D_W": 26}, {"LOG2_MAX": 13}],
    "shade_credit": [{"LOG2": 0}],
    "shade_stable": [{"WIDTH": 0}],
    "shade_fifo": [{"WIDTH": 0}, {"LOG2": 0}, {"BLOCK": 2}],
    "shade_walk": [{"COUNT_W": 0}, {"CREDIT_LOG2": 0}],
    "shade_span_walk": [{"LOG2_MAX": 1}, {"LOG2_MAX": 13}],
    "shade_dot3": grid(OUT_F=[0, 32]),
    "shade_scale3": [{"GAIN": 2}],
    "shade_unit": [{"FOLD": 0}, {"FOLD": 9}],
    "shade_half": [{"FORM": 2}],
    "shade_invc": [{"FORM": 2}, {"DEGREE": 1}, {"FORM": 0, "DEGREE": 3}],
    "shade_bisect": [{"WAIT": 0}],
    "shade_criterion": [{"FORM": 2}, {"DEGREE": 1}, {"FORM": 0, "DEGREE": 3}],
    "shade_versine": [{"FORM": 2}],
    "shade_hold": [{"WIDTH": 0}, {"DEPTH": -1}, {"FOLD": 0}],
    "shade_lobe": [{"POWER": 1}, {"POWER": 5}, {"FOLD": 0}, {"FOLD": 9}, {"FOLD": 6, "TAKE": 6}],
    "shade_lobe_folded": [{"POWER": 1}, {"FOLD": 1}, {"TAKE": 6}],
    "shade_wait": [{"WIDTH": 0}, {"DEPTH": 0}, {"FOLD": 0}],
    "shade_gain": [{"FOLD": 9}, {"FOLD": 2, "TAKE": 2}],
    "shade_angles_folded": [{"FOLD": 1}, {"TAKE": 6}],
    "shade_angles": [{"REFLECT": 2}, {"LOCAL": -1}, {"FOLD": 6}, {"FOLD": 6, "REFLECT": 0, "TAKE": 6}],
    "shade_reflectance": [{"DIVIDE": 2}, {"FOLD": 6, "REFLECT": 0}],
    "shade_light": [{"FOLD": 6}, {"FOLD": 9, **TWO}],
    "shade_kappa": [{"PACE": 3}],
    "shade_planner": [{"LOG2_MAX": 3}],
    "shade_weight": [{"PACE": 13}],
    "shade_registers": [{"COLOUR": 2}],
    "shade_stretch": [{"LOG2_MAX": 3}],
    "shade_poly_start": [{"LOG2_MAX": 1}],
    "shade_poly_state": [{"LOG2_MAX": 1}],
    "shade_poly_line": [{"LOG2_MAX": 13}],
    "shade_line": [{"FOLD": 0}],
    "shade_raster": [{"CREDIT_LOG2": 2}],
    "shade_depth": [{"LOG2": 1}],
    "shade_frame": [{"COLUMNS_LOG2": 0}, {"LINES_LOG2": 13}, {"DOUBLE": 2}],
    "shade_node_walk": [{"FOLD": 9}],
    "shade_poly_span": [{"EVALUATOR": 2}],
    "shade_lane": [{"PATH_NORMALS": 2}, {"FOLD": 9, **SMALL}, {"FOLD": 6}],
    "shade_direct_door": [{"LOG2": 0}],
    "shade_direct_line": [{"LOG2": 0}],
    "shade_widen": [{"IN_W": 24}, {"IN_W": 256}, {"IN_W": 4}],
    "shade_core": [{"LANES": 0}, {"LANES": 3}, {"COLOUR": 2}, {"DATA_W": 16}],
    "shade_door": [{"LANES": 0}, {"BURST": 2}],
}

# Points beside the default one that stand in the synthesis report as well.
VARIANTS: dict[str, list[Point]] = {
    "shade_third": [{"FORM": 0}],
    "shade_coef": [{"FORM": 0}, {"NODES": 1}],
    "shade_poly_span": [{"EVALUATOR": 1}],
    "shade_unit": [{"FOLD": 6}],
    "shade_versine": [{"FORM": 0}],
    "shade_lobe": [{"FOLD": 6}, {"POWER": 3}, {"POWER": 2}],
    "shade_light": [TWO, {"FOLD": 6, **TWO}],
    "shade_phong": [{"REFLECT": 0, "DIVIDE": 0}],
    "shade_core": [SMALL, FOLDED, {"COLOUR": 1}, {"LANES": 4, **SMALL}],
    "yardstick_beckmann": [{"WARD": 1}],
    **{f"shade_{unit}": grid(FORM=[0], DEGREE=[1, 2]) for unit in ("invc", "midpoint", "node_chain", "criterion")},
}


def points(module: str) -> list[Point]:
    """The points of a module, the default one (``{}``) first."""
    return [{}, *POINTS.get(module, [])]
