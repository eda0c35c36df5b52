# SPDX-License-Identifier: Apache-2.0
"""Boards: bitstreams, simulations of whole machines, their golden models. ``make board BOARD=ulx3s``."""

from polyshade.sim.errors import UserError

BOARDS = ("ulx3s",)


def main(board: str) -> None:
    """Make the bitstream of a board; UserError for one that is not known."""
    if board not in BOARDS:
        raise UserError(f"{board}: no such board, allowed {', '.join(BOARDS)}")
    from polyshade.scripts.boards import ulx3s

    ulx3s.main()
