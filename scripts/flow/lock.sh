#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes requirements.txt, the pinned and hashed closure of requirements.in: scripts/flow/lock.sh
# The resolver's settings stand in pyproject.toml, [tool.uv]. It lives in a scratch environment.
set -eu
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"${PYTHON:-python3}" -m venv "$scratch/venv"
"$scratch/venv/bin/python" -m pip install --quiet uv==0.13.9
{
    echo "# Made from requirements.in by \`make lock\`; install with pip --no-deps --require-hashes."
    "$scratch/venv/bin/uv" pip compile --quiet requirements.in
} >"$scratch/requirements.txt"
if grep -n '://' "$scratch/requirements.txt"; then
    echo "polyshade: error: requirements.txt: a download address, allowed names and hashes only" >&2
    exit 2
fi
mv "$scratch/requirements.txt" requirements.txt
