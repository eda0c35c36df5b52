# SPDX-License-Identifier: Apache-2.0
"""``make budget``: the oracle agrees with the exact values of the cases, and a golden model that is off is seen."""

from dataclasses import replace

import pytest
from polyshade.scripts.studies import budget
from polyshade.sim.errors import UserError
from polyshade.sim.units import cases

FIRST = {case.module: case for case in reversed(cases()) if budget.fits(case) and case.vectors}


@pytest.mark.parametrize("module", FIRST)
def test_oracle(module: str) -> None:
    """Of few vectors: within the bound, with the exact value of the case to a thousandth of an ulp."""
    found = budget.judge(FIRST[module], 3000, 1)
    assert 0 < found["worst"] <= FIRST[module].limit + 1e-9, found["input"]
    assert found["disagreement"] < 1e-3
    assert found["rows"] >= budget.LARGEST and set(found["input"]) - {"output"}


def test_a_golden_model_that_is_off_is_seen() -> None:
    """By an ulp, with an exact value that is off as much: the oracle knows neither."""
    case = FIRST["shade_colour"]
    off = replace(case, golden=lambda i: {name: value + 1 for name, value in case.golden(i).items()},
                  exact=lambda i: {name: value + 1 for name, value in case.exact(i).items()})  # fmt: skip
    found = budget.judge(off, 3000, 1)
    assert found["worst"] >= 1 and found["disagreement"] >= 0.99


def test_document() -> None:
    """It is that of the stages that are known, and names each with its bound."""
    text = budget.DOCUMENT.read_text()
    assert all(f"| `{module}/" in text for module in budget.ORACLES)
    assert (
        len(set(map(len, (line.replace("\\|", "").split("|") for line in text.splitlines() if line[:3] == "| `")))) == 1
    )


def test_bad_input() -> None:
    with pytest.raises(UserError, match="--vectors: 0 is out of range, allowed is 1 to 100000000"):
        budget.main(0)
