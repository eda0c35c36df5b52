#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes requirements.txt and requirements-soc.txt, the pinned and hashed closures of the .in files: scripts/flow/lock.sh
# The resolver's settings stand in pyproject.toml, [tool.uv]. It lives in a scratch environment.
set -eu
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"${PYTHON:-python3}" -m venv "$scratch/venv"
"$scratch/venv/bin/python" -m pip install --quiet uv==0.13.9
for name in requirements requirements-soc; do
    {
        echo "# Made from $name.in by \`make lock\`; install with pip --no-deps --require-hashes."
        "$scratch/venv/bin/uv" pip compile --quiet "$name.in"
    } >"$scratch/$name.txt"
    if grep -n '://' "$scratch/$name.txt"; then
        echo "polyshade: error: $name.txt: a download address, allowed names and hashes only" >&2
        exit 2
    fi
    mv "$scratch/$name.txt" "$name.txt"
done
