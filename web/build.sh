#!/bin/sh
# Builds the playground: the live view's page with its session as WebAssembly, a folder of static files.
# The first argument names the folder, web/dist if left out. It needs the Rust toolchain with the target
# wasm32-unknown-unknown (`rustup target add wasm32-unknown-unknown`). Where that target cannot be had, it
# takes Debian's compiler for it: packages unpacked below target/, nothing is installed. That takes
# about ten minutes once. WEB_RUST=debian asks for it in any case.
set -eu
cd "$(dirname "$0")/.."
dist=${1:-web/dist}
target=${CARGO_TARGET_DIR:-target}
triple=wasm32-unknown-unknown
largest=4000000 # bytes, compressed

fail() {
    printf 'web/build.sh: %s\n' "$1" >&2
    exit 1
}

# What the compiler would write into messages of panics: where this computer keeps its sources.
registry=${CARGO_HOME:-$HOME/.cargo}/registry/src
between=$(printf '\037')
CARGO_ENCODED_RUSTFLAGS="--remap-path-prefix=$registry/=$between--remap-path-prefix=$(pwd)/="
export CARGO_ENCODED_RUSTFLAGS

# Debian's compiler with the sources of the standard library, unpacked.
unpack() {
    command -v apt-get >/dev/null && command -v dpkg >/dev/null || fail "there is no target $triple for $(rustc --version).
rustup has it: rustup target add $triple"
    mkdir -p "$root.new"
    folder=$(cd "$root.new" && pwd)
    lists=$(apt-cache depends rustc-web libstd-rust-web-dev rust-web-src 2>/dev/null) || lists=
    std=$(printf '%s\n' "$lists" | sed -n 's/.*Depends: \(libstd-rust-web-[0-9.]*\)$/\1/p' | head -n 1)
    [ -n "$std" ] || fail "apt knows no package rustc-web: add Debian's security archive, then apt-get update"
    llvm=$(apt-cache depends "$std" | sed -n 's/.*Depends: \(libllvm[0-9]*\)$/\1/p' | head -n 1)
    (
        cd "$folder"
        # shellcheck disable=SC2086
        apt-get download rustc-web rust-web-src libstd-rust-web-dev "$std" $llvm libz3-4 || exit
        for package in *.deb; do
            dpkg -x "$package" . || exit
            rm "$package"
        done
    ) || fail "Debian's packages cannot be fetched: try apt-get update"
    mv "$root.new" "$root"
}

if [ "${WEB_RUST:-}" != debian ] && [ -d "$(rustc --print target-libdir --target "$triple" 2>/dev/null)" ]; then
    cargo build --locked -p aplomb-web --profile web --target "$triple"
else
    root=$target/web-rust
    linker=$(find "$(rustc --print sysroot)/lib/rustlib" -name rust-lld -type f 2>/dev/null | head -n 1)
    [ -n "$linker" ] || linker=$(command -v wasm-ld || command -v rust-lld || true)
    [ -n "$linker" ] || fail "there is no linker for WebAssembly: the package lld has wasm-ld"
    [ -d "$root" ] || unpack
    libraries=$(find "$(cd "$root" && pwd)/usr/lib" -maxdepth 1 -name '*-linux-gnu*' -type d | head -n 1)
    sources=$(cd "$root" && pwd)/usr
    CARGO_ENCODED_RUSTFLAGS="$CARGO_ENCODED_RUSTFLAGS$between--remap-path-prefix=$sources/="
    LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} RUSTC=$sources/bin/rustc RUSTC_BOOTSTRAP=1 \
        CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$linker \
        cargo build --locked -p aplomb-web --profile web --target "$triple" -Zbuild-std=std,panic_abort
fi

rm -rf "$dist"
mkdir -p "$dist"
cp -R src/live/page/. "$dist"
cp web/worker.js "$dist"
cp "$target/$triple/web/aplomb_web.wasm" "$dist/aplomb.wasm"
sed 's/<html lang="en">/<html lang="en" data-worker="worker.js">/' src/live/page/index.html >"$dist/index.html"
grep -q '<html.*data-worker' "$dist/index.html" || fail "src/live/page/index.html has another <html> tag than expected"

# Bytes of all files, as they are and compressed one by one.
whole=$(find "$dist" -type f -exec cat {} + | wc -c)
packed=$(find "$dist" -type f -exec gzip -9 -c {} \; | wc -c)
printf '%s: %d kB, %d kB compressed, of which %d kB WebAssembly\n' "$dist" $((whole / 1000)) $((packed / 1000)) \
    $(($(gzip -9 -c "$dist/aplomb.wasm" | wc -c) / 1000))
[ "$packed" -le "$largest" ] || fail "it is larger than $((largest / 1000)) kB compressed"
