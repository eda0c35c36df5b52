# SPDX-License-Identifier: Apache-2.0
"""Where the command ``polyshade`` begins: control-C ends it in one line, also while modules are imported."""

import os
import signal  # nothing else that takes time: until main() runs control-C is answered by a traceback

INTERRUPTED = 130
"""The exit status that shells expect."""


def stop(number: int = 0, frame: object = None) -> None:
    """One line, and no traceback of whatever was going on."""
    os.write(2, b"polyshade: interrupted\n")
    os._exit(INTERRUPTED)


def main() -> None:
    """Import the command line, which takes a while, and run it."""
    heard = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # else whoever started it wants it ignored
    if heard:
        signal.signal(signal.SIGINT, stop)
    from polyshade.scripts import cli

    try:
        if heard:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        cli.main()
    except KeyboardInterrupt:
        stop()
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # nothing is left to do but to go


if __name__ == "__main__":
    main()
