"""The one exception that stands for a fault of the input rather than of the program."""


class UserError(Exception):
    """A fault of a file or an option, told in one line: ``<file or option>: <cause>, <allowed range>``.

    The command line prints it as ``polyshade: error: <message>`` and exits with status 2.
    Line breaks and runs of blanks in the message (a quoted file may bring them) are folded to one blank.
    """

    def __init__(self, message: str) -> None:
        super().__init__(" ".join(message.split()))
