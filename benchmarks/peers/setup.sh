#!/bin/sh
# Installs the peers into build/bench: rtamt, reelay, rdflib and owlready2 from PyPI; R2U2 and RTLola
# (the interpreter, and the compiler to Rust) from crates.io. If a peer cannot be installed, the table
# reports that the peer is not measured.
set -u
cd "$(dirname "$0")/../.."
bench=$PWD/build/bench
mkdir -p "$bench"

echo "bench: installing rtamt and reelay from PyPI into build/bench/venv"
[ -x "$bench/venv/bin/python" ] || "${PYTHON:-python3}" -m venv "$bench/venv"
"$bench/venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    numpy rtamt==0.4.10 reelay==25.0.0 || echo "bench: rtamt and reelay are not measured"
echo "bench: installing rdflib and owlready2 from PyPI into build/bench/venv"
"$bench/venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    rdflib==7.6.0 owlready2==0.51 || echo "bench: rdflib and owlready2 are not measured"

if command -v cargo >/dev/null; then
    echo "bench: building R2U2 and RTLola from crates.io (some minutes the first time)"
    export CARGO_TARGET_DIR="$bench/cargo"
    (cd benchmarks/peers/rust && cargo build --quiet --release) || echo "bench: RTLola is not measured"
    [ -x "$bench/tools/bin/r2u2_cli" ] ||
        cargo install --quiet r2u2_cli@4.2.4 --root "$bench/tools" || echo "bench: R2U2 is not measured"
    [ -x "$bench/tools/bin/rtlola2rust" ] ||
        cargo install --quiet rtlola2rust@0.1.0 --root "$bench/tools" ||
        echo "bench: RTLola compiled to Rust is not measured"
else
    echo "bench: no cargo, so R2U2 and RTLola are not measured"
fi
