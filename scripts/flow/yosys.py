# SPDX-License-Identifier: Apache-2.0
"""Yosys as a program: ``python -m polyshade.scripts.flow.yosys SCRIPT``.

Yosys comes as a Python extension, and a command that fails ends the whole process. So every job is a
process of its own, with the log on standard output and the cause in its last line.
"""

import sys

from pyosys import libyosys


def main() -> None:
    """Run the commands of the script file named on the command line."""
    libyosys.run_pass(f"script {sys.argv[1]}")
    libyosys.log_flush()


if __name__ == "__main__":
    main()
