#!/bin/sh
# Everything that must hold before a change lands: format, lints, documentation, tests, examples.
set -eu
cd "$(dirname "$0")/.."
cargo fmt --all --check
cargo clippy --workspace --all-targets --locked -- -D warnings
RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked
cargo run --locked --example embed
cargo run --locked -p aplomb-controllers --example own_controller
cargo test --workspace --locked
