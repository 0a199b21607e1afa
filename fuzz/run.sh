#!/bin/sh
# Fuzzes one target: sh fuzz/run.sh TARGET [SECONDS]. What is found stays in fuzz/corpus and fuzz/artifacts, which git ignores.
# Needs cargo-fuzz (cargo install cargo-fuzz); a stable compiler will do, since the code is safe and needs no sanitizer.
set -eu
cd "$(dirname "$0")"

target=${1:?"name a target: $(ls fuzz_targets | sed 's/\.rs$//' | tr '\n' ' ')"}
seconds=${2:-300}
export RUSTC_BOOTSTRAP=1 # cargo-fuzz passes flags that stable compilers keep to themselves
mkdir -p "corpus/$target"
case $target in
scene) set -- ../scenes ;;
checkpoint)
    cargo run --quiet --release --manifest-path ../Cargo.toml -p curveflow-tests --bin checkpoint_seeds corpus/checkpoint
    set --
    ;;
*) set -- ;;
esac
[ ! -d "seeds/$target" ] || set -- "seeds/$target" "$@"
exec cargo fuzz run --sanitizer none "$target" "corpus/$target" "$@" -- -dict=scene.dict \
    -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=20000 -print_final_stats=1
