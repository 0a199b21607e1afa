#!/bin/sh
# Measures every table of benches/README.md anew, on this machine: half an hour or more. Leave the machine alone meanwhile.
set -eu
cd "$(dirname "$0")/.."

[ -x .venv/bin/python ] || python3 -m venv .venv
PATH="$PWD/.venv/bin:$PATH" # HDF5 is built with the cmake of .venv
export PATH
python -m pip install --quiet --disable-pip-version-check "cmake>=3.26" "scikit-sundae>=1.2" "scipy>=1.11"
python -m pip install --quiet --disable-pip-version-check .

cargo build --release --package curveflow-benches
cargo build --release --manifest-path benches/diffsol/Cargo.toml --target-dir target

for table in dial generality scaling methods; do
    target/release/$table
done
OPENBLAS_NUM_THREADS=1 python benches/peers --limit "${LIMIT:-10}"
