"""Every unit against its golden model: all vectors of reduced widths, millions at full width; and its error bound.

The vectors, the golden twin and the exact value of each formula stand in ``sim/units.py``.
"""

import pytest

from golden import contract as k
from sim.units import Case, cases, check_poly_span
from tb.runner import SEED

FULL = 10_000_000

# |golden - exact formula| in ulp. Rounding to nearest: 1/2; x/3 is never halfway: 1/3; Horner: 1/2 + 3/16.
BOUND = {
    "shade_delay": 0,
    "shade_fifo": 0,
    "shade_saturate": 0,
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
    "shade_rsqrt": 7 / 8,
    "shade_normalize": 5 / 8,
}
NEEDS_FULL = {
    name
    for name in BOUND
    if name.startswith(("shade_coef", "shade_horner", "shade_fdiff", "shade_rsqrt", "shade_normalize"))
}


@pytest.mark.parametrize("case", cases(), ids=str)
def test_unit(case: Case) -> None:
    refined = case.form == "refined"
    wanted = FULL if refined and case.module in NEEDS_FULL else FULL // 10
    result = case.check(wanted, SEED)
    assert result.mismatches == 0, result.first_mismatch
    assert result.vectors >= (1 if case.all_vectors else wanted)
    assert result.max_error_ulp <= (BOUND[case.module] if refined else 1 / 2) + 1e-9, result.worst_input
    assert result.throughput == pytest.approx(1 / case.clocks_per_vector, rel=0.01 if result.vectors > 1000 else 0.5)


@pytest.mark.parametrize("form", ["refined", "paper"])
@pytest.mark.parametrize("evaluator", [k.EVALUATOR_HORNER, k.EVALUATOR_FDIFF])
@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.4, 0), (0, 0.4), (0.3, 0.3)])
def test_poly_span(form: str, evaluator: int, in_gap: float, out_stall: float) -> None:
    result = check_poly_span(form, evaluator, 40_000, SEED, in_gap, out_stall)
    assert result.mismatches == 0, result.first_mismatch
    # coefficients to nearest: 1/3 ulp each in A and C; evaluator: 1/2, Horner 3/16 more
    coefficients = 2 / 3 if form == "refined" else 1
    evaluation = 11 / 16 if evaluator == k.EVALUATOR_HORNER else 1 / 2
    assert result.max_error_ulp <= coefficients + evaluation + 1e-9, result.worst_input
    if not in_gap and not out_stall:
        assert result.throughput >= 0.99
