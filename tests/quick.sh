#!/bin/sh
# The unit tests alone: once they are built, an answer within 3 minutes on two cores. all.sh runs these and
# everything else. PROPTEST_CASES=N tries N random cases in each property. Arguments go to the tests:
# `tests/quick.sh render` runs those that have render in their names.
set -eu
cd "$(dirname "$0")/.."
cargo test --workspace --locked --lib --bins --no-run
begun=$(date +%s)
cargo test --workspace --locked --lib --bins -- "$@"
printf '\n%6d s  unit tests\n' $(($(date +%s) - begun))
