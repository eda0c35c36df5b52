# SPDX-License-Identifier: Apache-2.0
"""The SoC of ``make soc``: a program in C on a soft core draws what the golden model draws."""

from __future__ import annotations

import pytest
from polyshade.scripts.handoff import soc
from polyshade.sim.errors import UserError


def test_without_litex(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(soc, "PYTHON", soc.ROOT / "nowhere" / "python")
    with pytest.raises(UserError, match=r"^nowhere/python: LiteX is not installed, make it with: make soc$"):
        soc.build("", tmp_path)


@pytest.mark.full
def test_picture(tmp_path) -> None:
    told = soc.draw(16, tmp_path)
    assert told["pixels"] > 50 and told["mismatches"] == 0 and not told["first"]


@pytest.mark.full
def test_a_wrong_word_is_found(tmp_path, monkeypatch) -> None:
    """The program gets another highlight (K1) than the golden model."""
    plain = soc.drawing
    monkeypatch.setattr(soc, "drawing", lambda lines, words: plain(lines, words | {0x84: words[0x84] // 2}))
    assert soc.draw(16, tmp_path)["mismatches"] > 0
