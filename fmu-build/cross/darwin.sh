#!/usr/bin/env bash
# usage: darwin.sh FOLDER OLDEST_RUST
#
# Makes in FOLDER what links libraries for macOS, of tool chains in the folders beside it: the linker of Debian's LLVM, or of
# rustup's Rust, and zig's description of the one library of macOS that is linked. FOLDER/bin/ld64.lld is to be called;
# FOLDER/sdk is laid out as Apple's SDK.
set -euo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
rm -rf "$folder/bin" "$folder/sdk"
mkdir -p "$folder/bin" "$folder/sdk/usr/lib"
missing() {
    echo "$1 is missing; it comes with: cargo run --release -- toolchains darwin64" >&2
    exit 1
}
# those who have rustup's targets need nothing of Debian
linker=$folder/../rust/bin/ld64.lld
[ -x "$linker" ] || linker=$(rustc --print target-libdir)/../bin/gcc-ld/ld64.lld
[ -x "$linker" ] || missing "LLVM's linker for macOS"
described=$(echo "$folder"/../linux/lib/python3*/site-packages/ziglang/lib/libc/darwin/libSystem.tbd)
[ -f "$described" ] || missing "zig's description of macOS"
# Apple's SDK gives parts of it names of their own. Rust also names a library for encodings, of which nothing is used. A kind of
# ARM that the linker may not know yet exports what the others do
for name in libSystem libc libm libiconv; do
    sed 's/arm64e\.x1-/arm64e-/g' "$described" > "$folder/sdk/usr/lib/$name.tbd"
done
# names the library by its file, not by where it is built; leaves out names that are not exported, and places of debuggers; signs
cat > "$folder/bin/ld64.lld" <<END
#!/bin/bash
for given in "\$@"; do
    [[ \$before == -o ]] && built=\${given##*/}
    before=\$given
done
exec '$linker' "\$@" -install_name "@rpath/\$built" -x -S -adhoc_codesign
END
chmod +x "$folder/bin/ld64.lld"
"$folder/bin/ld64.lld" --version
