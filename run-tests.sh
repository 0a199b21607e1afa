#!/bin/sh
# Runs every check: format, lints, tests of all crates, documentation, the Python package and its stubs.
# Needs cargo (rustup), a C compiler and python3 with venv; everything else is installed into .venv.
set -eu
cd "$(dirname "$0")"

[ -x .venv/bin/python ] || python3 -m venv .venv
PATH="$PWD/.venv/bin:$PATH" # HDF5 is built with the cmake of .venv
export PATH
python -m pip install --quiet --disable-pip-version-check "cmake>=3.26"

# One profile for all, so that HDF5 is built once.
cargo fmt --all --check
cargo clippy --release --workspace --all-targets -- -D warnings
cargo test --release --workspace
RUSTDOCFLAGS="-D warnings" cargo doc --release --workspace --no-deps

python -m pip install --quiet --disable-pip-version-check ".[test]"
python -m mypy python/curveflow
python -m mypy python/gallery
python -m pytest # runs stubtest too
