"""Write ``rtl/shade_pkg.sv`` from ``golden/contract.py``: ``python -m scripts.generate`` (``--check``: compare)."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from golden import contract

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "rtl" / "shade_pkg.sv"
HEADER = """\
// shade_pkg: formats, latencies, limits and codes of Polyshade.
//
// Generated from golden/contract.py by `python -m scripts.generate`: change them there.
// W: width in bits, F: fraction bits among them. S1.16: sign, 1 integer bit, 16 fraction bits.
// Latencies are in clocks from an input taken to the output that it causes.

/* verilator lint_off UNUSEDPARAM */  // no single module uses every constant
"""


def package() -> str:
    """The text of the package: one constant a line, with the comment that stands behind it in the contract."""
    source = Path(contract.__file__).read_text()
    lines = [HEADER, "package shade_pkg;"]
    values = contract.constants()
    for line in source.split("def constants")[0].splitlines():
        if section := re.match(r"# -+ (.*?) -+$", line):
            lines += ["", f"  // {section[1]}"]
        elif match := re.match(r"([A-Z0-9_, ]+) = [^#]*(?:#\s*(.*))?$", line):
            for name in match[1].split(", "):
                comment = f"  // {match[2]}" if match[2] else ""
                lines.append(f"  localparam int {name} = {values.pop(name)};{comment}")
    assert not values, f"constants that the generator did not find: {sorted(values)}"
    return "\n".join([*lines, "", "endpackage", "/* verilator lint_on UNUSEDPARAM */", ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="fail when the file on disk is not up to date")
    if parser.parse_args().check:
        if PACKAGE.read_text() != package():
            print(
                "rtl/shade_pkg.sv differs from golden/contract.py: run `python -m scripts.generate`",
                file=sys.stderr,
            )
            return 1
    else:
        PACKAGE.write_text(package())
    return 0


if __name__ == "__main__":
    sys.exit(main())
