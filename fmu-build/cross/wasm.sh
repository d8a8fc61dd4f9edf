#!/usr/bin/env bash
# usage: wasm.sh FOLDER OLDEST_RUST
#
# Unpacks into FOLDER what builds the library for browsers: Debian's Rust with the source of its standard library, and the linker of
# the same LLVM. FOLDER/bin holds what is to be called.
source "$(cd "$(dirname "$0")" && pwd)/debian.sh"
begin "$1" "$2"
rust_packages
# libllvm22 and lld-22
unpack "${rust[@]}" "lld-${llvm//[!0-9]/}"
script rustc "$(with_libraries "$root/usr/bin/rustc")"
script wasm-ld "$(with_libraries "$root/usr/lib/llvm-${llvm//[!0-9]/}/bin/wasm-ld")"
rust_runs
"$folder/bin/wasm-ld" --version
