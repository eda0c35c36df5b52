# SPDX-License-Identifier: Apache-2.0
"""Every check of ``make lint`` as a test of its own; most parameter points and synthesis only in ``make test-all``."""

import pytest
from polyshade.scripts.flow import lint

from tb.runner import FULL


def checks() -> list:
    """Verilator reads the first point of every module, Yosys that of every top."""
    return [
        pytest.param(item, id=item.name.replace(" ", "-"), marks=pytest.mark.full if item.slow else ())
        for item in lint.items(synth=FULL)
    ]


@pytest.mark.parametrize("item", checks())
def test_lint(item: lint.Item) -> None:
    """No fault found."""
    faults = item.check()
    assert not faults, "\n".join(faults)
