#!/bin/sh
# Makes the environment .venv in this folder, with every Python package that the project uses, at the
# versions of constraints.txt. Needs Python >= 3.10; choose a Python with PYTHON=...
set -eu
cd "$(dirname "$0")/.."
python=${PYTHON:-python3}

"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' || {
    echo "setup: Python 3.10 or later is needed; choose it with 'make PYTHON=...'" >&2
    exit 1
}
if ! .venv/bin/python -m pip --version >/dev/null 2>&1; then
    if ! "$python" -c 'import ensurepip' 2>/dev/null; then
        tools/setup_debian.sh python3-venv
        "$python" -c 'import ensurepip' || {
            echo "setup: $python does not have the module ensurepip; install the venv package of this Python" >&2
            exit 1
        }
    fi
    echo "setup: creating the environment .venv with $("$python" --version)"
    "$python" -m venv --clear .venv
fi
echo "setup: installing this project and the packages of constraints.txt into .venv, from PyPI"
.venv/bin/python -m pip install --quiet --disable-pip-version-check \
    --constraint constraints.txt --editable packages/common --editable packages/rossmarie \
    --editable packages/ezskiros --editable packages/crosscheck --editable packages/heron \
    --editable ".[dev${EXTRAS:+,$EXTRAS}]"
