#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes the virtual environment: scripts/flow/setup.sh VENV  (PYTHON=... chooses the interpreter).
# Everything that the machine itself must bring is checked first and named at once. POSIX sh, because
# Python may be what is missing.
set -eu
cd "$(dirname "$0")/../.."
venv=${1:-.venv}
python=${PYTHON:-python3}

refuse() {
    printf 'polyshade: error: %s\n' "$*" >&2
    exit 2
}

have() { command -v "$1" >/dev/null 2>&1; }

# Paths go through PATH, C++ and Tcl; a space or a letter of any language is fine there.
case $PWD in *[:\"\\\$\`]*) refuse "folder: $PWD: has one of : \" \\ \$ \`, clone into one without" ;; esac
[ "$(uname -sm)" = "Linux x86_64" ] || refuse "machine: $(uname -sm), the pinned wheels are for Linux x86_64"

shared='
import ctypes, os, sys, sysconfig
found = [sysconfig.get_config_var(name) or "" for name in ("LIBDIR", "INSTSONAME")]
name = "libpython%d.%d.so.1.0" % sys.version_info[:2]
try:
    ctypes.CDLL(name)
except OSError:
    sys.exit(sys.base_prefix == "/usr" and not os.path.exists(os.path.join(*found)))
'
missing=""
for program in git make g++ perl; do
    have "$program" || missing="$missing $program"
done
# Verilator's driver is a Perl program; perl-base alone lacks these two modules.
! have perl || perl -MPod::Usage -MFindBin -e 1 2>/dev/null || missing="$missing perl"

if have "$python"; then
    found=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    "$python" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' ||
        refuse "$python: Python $found, allowed 3.11 to 3.14 (choose one with: make PYTHON=python3.12)"
    # Debian ships the module, but keeps what fills a new environment in a package of its own.
    "$python" -c 'import ensurepip, venv' 2>/dev/null || missing="$missing $(basename "$python")-venv"
    # The tests run Python inside of the simulator. Debian's own Python comes without its shared library.
    "$python" -c "$shared" 2>/dev/null || missing="$missing libpython$found"
elif [ "$python" = python3 ]; then
    missing="$missing python3 python3-venv"
    for word in $(apt-cache depends python3 2>/dev/null || true); do
        case $word in python3.[0-9]*) missing="$missing lib$word" && break ;; esac
    done
else
    refuse "PYTHON=$python: no such program"
fi
[ -z "$missing" ] || refuse "missing:$missing, install with: apt-get install -y$missing"

echo 'int main() { if constexpr (sizeof(int) > 1) return 0; }' |
    g++ -std=c++17 -fsyntax-only -x c++ - 2>/dev/null || refuse "g++: no C++17, allowed g++ 8 or newer"

"$python" -m venv --clear "$venv"
"$venv/bin/python" -m pip install --quiet --no-deps --only-binary :all: --require-hashes -r requirements.txt
"$venv/bin/python" -m pip install --quiet --no-deps --no-build-isolation --editable .
"$venv/bin/python" -m polyshade.scripts.flow.tools
touch "$venv/.stamp"
