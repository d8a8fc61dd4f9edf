#!/usr/bin/env bash
# usage: aarch64.sh FOLDER OLDEST_RUST
#
# Unpacks into FOLDER what runs the library for Linux on ARM: qemu for single programs, which needs no library, and glibc.
# FOLDER/bin/qemu-aarch64 runs a program.
source "$(cd "$(dirname "$0")" && pwd)/debian.sh"
begin "$1" "$2"
unpack qemu-user-static libc6-arm64-cross
script qemu-aarch64 "'$root/usr/bin/qemu-aarch64-static' -L '$root/usr/aarch64-linux-gnu'"
"$folder/bin/qemu-aarch64" --version | head -n 1
# the loader of that glibc says its version
"$folder/bin/qemu-aarch64" "$root/usr/aarch64-linux-gnu/lib/ld-linux-aarch64.so.1" --version | head -n 1
