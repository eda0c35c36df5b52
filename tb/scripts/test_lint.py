"""Every check of ``make lint`` as a test of its own."""

import pytest
from polyshade.scripts.flow import lint


@pytest.mark.parametrize("item", list(lint.items()), ids=lambda item: item.name.replace(" ", "-"))
def test_lint(item: lint.Item) -> None:
    """No fault found."""
    faults = item.check()
    assert not faults, "\n".join(faults)
