"""Every unit against its golden model: all vectors of reduced widths, millions at full width; and its error bound.

The vectors, the golden twin and the exact value of each formula stand in ``sim/units``.
"""

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import light, normal
from polyshade.golden.fixed import ONE
from polyshade.sim.units import Case, cases, check_pixel_normals, check_poly_span, unit_vectors

from tb.runner import SEED

FULL = 10_000_000

# |golden - exact formula| in ulp. Rounding to nearest: 1/2; x/3 is never halfway: 1/3; Horner: 1/2 + 3/16.
BOUND = {
    "shade_delay": 0,
    "shade_fifo": 0,
    "shade_saturate": 0,
    "shade_limit": 0,
    "shade_mul": 0,
    "shade_round": 1 / 2,
    "shade_third": 1 / 3,
    "shade_coef_a": 1 / 3,
    "shade_coef_b": 0,
    "shade_coef_c": 1 / 3,
    "shade_coef_d": 0,
    "shade_coef": 1 / 3,
    "shade_horner_step": 1 / 2,
    "shade_horner_pipe": 1 / 2 + 3 / 16,
    "shade_horner_seq": 1 / 2 + 3 / 16,
    "shade_fdiff": 1 / 2,
    "shade_rsqrt_rom": 0,
    "shade_rsqrt": 7 / 8,
    "shade_normalize": 5 / 8,
    "shade_unit": 1.65,  # 1/2, 3/8 of s, and of a vector longer than 2 the rounding to 18 bits
    "shade_clamp": 0,
    "shade_square": 0,
    "shade_square_fabric": 0,
    "shade_weigh": 1 / 2,
    "shade_dot3": 1 / 2,
    "shade_scale3": 1 / 2,
    "shade_bisect": 1 / 2,
    "shade_half": 0.53,  # 1/2, and what the cuts of the powers are worth: of u^4, up to 8 times its last bit
    "shade_invc": 0.82,  # the same, in ulp of U0.18
    "shade_midpoint": 1.05,  # 1/2, and 0.55 of half an ulp times a sum of at most 2
    "shade_node_chain": 2,
    "shade_metric": 1 / 2,
    "shade_criterion": 0.85,
    "shade_kappa": 1,  # cut, behind the cuts of its factors; those make 2^-12 of it at most, see tb/golden/test_plan.py
    "shade_planner": 0,
    "shade_increment": 1 / 2,
    "shade_versine": 1 / 2,
    "shade_reflect": 1.5,  # 1/2, and m's half ulp times a component of N: of a unit normal at most 1
    "shade_halfway": 4.25,  # 1/2, and H's 5/8 times the sum of V's components; of unit vectors at most 1.6, see below
    "shade_lobe": 1.5,  # 1/2, and 2^power times what s, y and z lack near the peak
    "shade_fresnel": 1,
    "shade_colour": 1 / 2,
    "shade_angles": 1 / 2,
    "shade_geometry": 2.6,  # of 1 + w: the root's 0.85/4 and d's 1/2, times 2.83 by squaring and doubling, and 1/2
    "shade_gain": 2.5,  # 1/2, and the rounding of a factor of at least 1/2, in light of at most 2
    "shade_reflectance": 4.5,  # the two above together, 2^-15 of light of at most 2, and 1/2
    "shade_light": 4.5,
    "shade_light_folded": 4.5,
    "shade_light_local": 4.5,
}
NEEDS_FULL = {
    *(name for name in BOUND if name.startswith(("shade_coef", "shade_horner"))),
    *("shade_fdiff", "shade_rsqrt", "shade_normalize", "shade_dot3", "shade_scale3", "shade_bisect", "shade_midpoint"),
    *("shade_node_chain", "shade_criterion", "shade_kappa", "shade_planner", "shade_increment", "shade_unit"),
    *("shade_versine", "shade_reflect"),
    *("shade_halfway", "shade_fresnel", "shade_colour", "shade_angles", "shade_geometry", "shade_gain"),
    *("shade_light", "shade_light_local"),
}


@pytest.mark.parametrize("case", cases(), ids=str)
def test_unit(case: Case) -> None:
    refined = case.form == "refined"
    wanted = FULL if refined and case.module in NEEDS_FULL else FULL // 10
    result = case.check(wanted, SEED)
    assert result.mismatches == 0, result.first_mismatch
    assert result.vectors >= (1 if case.all_vectors else wanted)
    bound = BOUND[case.module] if refined else max(BOUND[case.module], 1 / 2)
    assert result.max_error_ulp <= bound + 1e-9, result.worst_input
    assert result.throughput == pytest.approx(1 / case.clocks_per_vector, rel=0.01 if result.vectors > 1000 else 0.5)


@pytest.mark.parametrize("form", ["refined", "paper"])
@pytest.mark.parametrize("evaluator", [k.EVALUATOR_HORNER, k.EVALUATOR_FDIFF])
@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.4, 0), (0, 0.4), (0.3, 0.3)])
def test_poly_span(form: str, evaluator: int, in_gap: float, out_stall: float) -> None:
    result = check_poly_span(form, evaluator, 40_000, SEED, in_gap, out_stall)
    assert result.mismatches == 0, result.first_mismatch
    # Refined: A and C err by 1/3 ulp at most, never in the same direction, because 3 divides the sum of 3 A and 3 C:
    # (t - t^3)/3 <= 2/(9 sqrt 3). Paper: 1/2 each. Evaluator: 1/2, Horner 3/16 more.
    coefficients = 2 / (9 * 3**0.5) if form == "refined" else 1
    evaluation = 11 / 16 if evaluator == k.EVALUATOR_HORNER else 1 / 2
    assert result.max_error_ulp <= coefficients + evaluation + 1e-9, result.worst_input
    if not in_gap and not out_stall:
        assert result.throughput >= 0.99


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.4, 0), (0, 0.4), (0.3, 0.3)])
def test_pixel_normals(in_gap: float, out_stall: float) -> None:
    steady = not in_gap and not out_stall
    vectors = 0
    for part in range(11 if steady else 1):  # 100,000 lines are a million normals
        result = check_pixel_normals(100_000, SEED + part, in_gap, out_stall)
        assert result.mismatches == 0, result.first_mismatch
        assert result.max_error_ulp <= BOUND["shade_normalize"]
        assert result.throughput >= 0.98 or not steady
        vectors += result.vectors
    assert vectors >= FULL or not steady


def test_midpoint_of_every_cosine() -> None:
    """The sum of two unit normals is 2 cos(psi/2) long; times InvC it is 1, exactly so for equal normals."""
    c = np.arange(ONE + 1)
    invc, half, clamped = normal.invc(c)
    true = np.sqrt((1 + c / ONE) / 2)
    length, wrong = np.abs(2 * true * invc / (1 << k.INVC_F) - 1), np.abs(half / ONE - true)
    narrow = c >= ONE // 2  # up to 60 degrees
    assert length.max() <= 1.6e-4
    assert wrong[narrow].max() <= 7.2e-5
    assert wrong.max() <= 1.8e-4
    assert (invc[-1], half[-1]) == (1 << k.INVC_F - 1, ONE)
    assert not clamped.any()


def test_halfway_of_unit_vectors() -> None:
    """V.H is within 1.6 ulp; up to 120 degrees between L and V it is, as good as their lengths, |L + V| / 2."""
    l, v = (unit_vectors(np.random.default_rng([SEED, part]), 1_000_000) for part in range(2))  # noqa: E741
    *_, vh, zero = light.halfway(*l, *v)
    s = (l + v).astype(np.longdouble)
    length = np.sqrt((s * s).sum(axis=0))
    assert not zero.any()
    assert np.abs(vh - ((v * s).sum(axis=0) / length).clip(0, ONE)).max() <= 1.6
    assert np.abs(vh - length / 2)[length >= ONE].max() <= 3.4


def test_midpoint_of_equal_normals() -> None:
    a = unit_vectors(np.random.default_rng(SEED), 1_000_000)
    middle = np.stack(normal.midpoint(*a, *a, normal.dot3(*a, *a))[:3])
    assert np.abs(np.linalg.norm(middle, axis=0) - ONE).max() <= 2


def test_nodes_lie_on_the_arc() -> None:
    """Up to 60 degrees every node is within 2.5e-4 of the point that slerp gives; the ends are the ends."""
    rng = np.random.default_rng(SEED)
    a, across = (v / np.linalg.norm(v, axis=0) for v in rng.standard_normal((2, 3, 1_000_000)))
    across -= a * (a * across).sum(axis=0)
    across /= np.linalg.norm(across, axis=0)
    angle = rng.random(a.shape[1]) * np.pi / 3
    arc = [a * np.cos(t * angle) + across * np.sin(t * angle) for t in np.arange(5) / 4]
    ends = [np.rint(v * ONE).astype(np.int64) for v in (arc[0], arc[-1])]
    nodes = normal.node_chain(*ends[0], *ends[1], np.minimum(normal.dot3(*ends[0], *ends[1]), ONE))
    for node, exact in zip(np.reshape(nodes[:15], (5, 3, -1)), arc, strict=True):
        assert np.linalg.norm(node / ONE - exact, axis=0).max() <= 2.5e-4
    assert np.array_equal(nodes[:3], ends[0])
    assert np.array_equal(nodes[12:15], ends[1])
