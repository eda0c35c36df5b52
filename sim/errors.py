# SPDX-License-Identifier: Apache-2.0
"""The one exception that stands for a fault of the input rather than of the program."""

LONGEST = 300
"""Characters of a message; the middle of a longer one (a long path, a quoted line) is left out."""


class UserError(Exception):
    """A fault of a file or an option, told in one line: ``<file or option>: <cause>, <allowed range>``.

    The command line prints it as ``polyshade: error: <message>`` and exits with status 2. A damaged file may put
    anything into the message: blanks and line breaks are folded, unprintable characters become ``?``.
    Example: ``str(UserError("a.obj: line 3:\\n 'v\\x1b'"))`` is ``a.obj: line 3: 'v?'``.
    """

    def __init__(self, message: str) -> None:
        line = "".join(c if c.isprintable() else "?" for c in " ".join(message.split()))
        if len(line) > LONGEST:
            half = (LONGEST - 5) // 2
            line = f"{line[:half]} ... {line[-half:]}"
        super().__init__(line)
