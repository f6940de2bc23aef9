#!/bin/sh
# Everything that must hold before a change lands: format, lints, documentation, examples, all tests.
# At the end, also of a failure, it prints how long each part took. It needs the Rust toolchain alone; on
# two cores and without anything built it takes less than 25 minutes. See quick.sh for the unit tests
# alone. PROPTEST_CASES=N tries N random cases in each property instead of those a test asks for;
# LIVE_MESSAGES=N sends the live view N random messages. The live page is tested in Debian's chromium, with
# its chromium-driver; without them these tests are left out, or fail if CI is set.
set -eu
cd "$(dirname "$0")/.."
begun=$(date +%s)
times=
part=

# Prints what each part took, and the part that failed.
summary() {
    code=$?
    [ -z "$part" ] || times="$times$(printf '%6d s  %s: failed' $(($(date +%s) - from)) "$part")
"
    printf '\n%s%6d s  in all\n' "$times" $(($(date +%s) - begun))
    exit "$code"
}
trap summary EXIT

# Runs a command as the part with a name.
run() {
    part=$1
    from=$(date +%s)
    shift
    "$@"
    times="$times$(printf '%6d s  %s' $(($(date +%s) - from)) "$part")
"
    part=
}

run "format" cargo fmt --all --check
run "lints" cargo clippy --workspace --all-targets --locked -- -D warnings
run "documentation" env RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked
# One build of the whole workspace: of one crate alone, its dependencies would be built anew with fewer
# features.
run "building the tests" cargo test --workspace --locked --no-run
run "building the examples" cargo build --workspace --locked --examples
for example in embed own_controller; do
    run "example $example" "${CARGO_TARGET_DIR:-target}/debug/examples/$example"
done
run "unit tests" cargo test --workspace --locked --lib --bins
run "tests of the crates and the program" cargo test --workspace --locked --test '*'
run "examples in the documentation" cargo test --workspace --locked --doc
