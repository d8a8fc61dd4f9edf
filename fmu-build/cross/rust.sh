#!/usr/bin/env bash
# usage: rust.sh FOLDER OLDEST_RUST
#
# Unpacks into FOLDER what builds libraries for browsers, for Linux on ARM and for macOS: Debian's Rust with the source of its
# standard library, and the linkers of the same LLVM for WebAssembly and Mach-O. FOLDER/bin holds what is to be called.
source "$(cd "$(dirname "$0")" && pwd)/debian.sh"
begin "$1" "$2"
rust_packages
# libllvm22 and lld-22
llvm_version=${llvm//[!0-9]/}
unpack "${rust[@]}" "lld-$llvm_version"
script rustc "$(with_libraries "$root/usr/bin/rustc")"
for linker in wasm-ld ld64.lld; do
    script "$linker" "$(with_libraries "$root/usr/lib/llvm-$llvm_version/bin/$linker")"
done
rust_runs
"$folder/bin/wasm-ld" --version
"$folder/bin/ld64.lld" --version
