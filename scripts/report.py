# SPDX-License-Identifier: Apache-2.0
"""How the reports are written: whole or not at all."""

from __future__ import annotations

import json
import os
from pathlib import Path


def save(path: Path, content: object) -> None:
    """Write plain values as JSON, through a temporary name, so that an interrupted command leaves the old report."""
    path.parent.mkdir(parents=True, exist_ok=True)
    scratch = path.with_name(f".{path.name}.{os.getpid()}")
    scratch.write_text(json.dumps(content, indent=2) + "\n")
    os.replace(scratch, path)
