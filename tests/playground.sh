#!/bin/sh
# Builds the playground and tests it in Chromium: web/build.sh says what the build needs, and the tests need
# Debian's packages chromium and chromium-driver, or others that are called so. It takes a few minutes.
# PLAYGROUND=FOLDER tests one that has been built already.
set -eu
cd "$(dirname "$0")/.."
for program in chromium chromedriver; do
    command -v "$program" >/dev/null || {
        echo "tests/playground.sh: there is no $program" >&2
        exit 1
    }
done
[ -n "${PLAYGROUND:-}" ] || web/build.sh web/dist
PLAYGROUND=${PLAYGROUND:-web/dist} cargo test --workspace --locked --test playground -- --ignored --nocapture --test-threads=1
