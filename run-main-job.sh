#!/bin/sh
# Sets everything up inside this folder and runs the main job: the three-fold membrane, to equilibrium.
# Needs cargo (rustup), a C compiler and python3 with venv; everything else is installed into .venv.
set -eu
cd "$(dirname "$0")"

.venv/bin/python -c "" 2>/dev/null || python3 -m venv --clear .venv # also where its Python has gone
PATH="$PWD/.venv/bin:$PATH" # HDF5 is built with the cmake of .venv
CARGO_TARGET_DIR="$PWD/target" # where the commands below look for what is built
export PATH CARGO_TARGET_DIR
python -m pip install --quiet --disable-pip-version-check "cmake>=3.26"

cargo build --release --package flow-cli
mkdir -p out
target/release/curveflow run scenes/three_fold.toml -o out/three_fold.h5 --replace
target/release/curveflow plot out/three_fold.h5 -o out/three_fold.png --replace

# The Python package; shares what cargo has built.
python -m pip install --quiet --disable-pip-version-check ".[plot]"
