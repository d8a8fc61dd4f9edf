#!/usr/bin/env bash
# usage: windows.sh FOLDER
#
# Unpacks into FOLDER what builds the library for Windows and runs it there: Debian's Rust with the source of its standard
# library, the MinGW linker, and wine. Nothing is installed and no rights are needed; FOLDER/bin holds what is to be called.
# Versions are those of the Debian release at hand: archives keep no older ones, so they cannot be pinned.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
root=$folder/root
for tool in apt-get apt-cache dpkg-deb; do
    command -v "$tool" >/dev/null || { echo "$tool is needed: this works on Debian and what descends from it" >&2; exit 1; }
done

dependency() { # PACKAGE BEGINNING: the package that PACKAGE depends on whose name begins so
    apt-cache depends "$1" | sed -n "s/^ *Depends: \($2[^ ]*\)$/\1/p" | head -n 1
}
std=$(dependency libstd-rust-web-dev libstd-rust-web-)
llvm=$(dependency "$std" libllvm)
[ -n "$std" ] && [ -n "$llvm" ] || { echo "the package rustc-web is unknown here: run apt-get update as root" >&2; exit 1; }
rust=(rustc-web rust-web-src libstd-rust-web-dev "$std" "$llvm")
mingw=(gcc-mingw-w64-x86-64-win32 gcc-mingw-w64-base gcc-mingw-w64-x86-64-win32-runtime mingw-w64-common
       mingw-w64-x86-64-dev binutils-mingw-w64-x86-64)
wine=(wine64 libwine libz-mingw-w64)

rm -rf "$folder/packages" "$root" "$folder/bin" "$folder/wine"
mkdir -p "$folder/packages" "$root" "$folder/bin"
echo "downloading ${rust[*]} ${mingw[*]} ${wine[*]}"
(cd "$folder/packages" && apt-get download -qq -o APT::Sandbox::User=root "${rust[@]}" "${mingw[@]}" "${wine[@]}")
for package in "$folder"/packages/*.deb; do
    echo "unpacking $(basename "$package" .deb)"
    # of Rust's source only the standard library is built, of all else no tests and manuals are read
    dpkg-deb --fsys-tarfile "$package" | tar -x -C "$root" --no-wildcards-match-slash --exclude='./usr/src/rustc-*/[!l]*' \
        --exclude='./usr/share/man' \
        --exclude='./usr/lib/gcc/i686-w64-mingw32' --exclude='./usr/i686-w64-mingw32' --exclude='./usr/lib/debug' \
        --exclude='./usr/lib/x86_64-linux-gnu/wine/i386-windows'
done
rm -r "$folder/packages"

# Debian looks for both of these where packages are installed
ln -sf wineserver64 "$root/usr/lib/wine/wineserver"
mkdir -p "$folder/wine/drive_c/windows/system32"
cp "$root/usr/x86_64-w64-mingw32/lib/zlib1.dll" "$folder/wine/drive_c/windows/system32/"

script() { # NAME COMMAND...: FOLDER/bin/NAME that calls the command with its own arguments
    local name=$1
    shift
    { echo '#!/bin/sh'; echo "exec $* \"\$@\""; } > "$folder/bin/$name"
    chmod +x "$folder/bin/$name"
}
script rustc env "LD_LIBRARY_PATH='$root/usr/lib/x86_64-linux-gnu'" "'$root/usr/bin/rustc'"
script x86_64-w64-mingw32-gcc "'$root/usr/bin/x86_64-w64-mingw32-gcc-win32'"
script x86_64-w64-mingw32-dlltool "'$root/usr/bin/x86_64-w64-mingw32-dlltool'"
script wine64 env "WINEDLLPATH='$root/usr/lib/x86_64-linux-gnu/wine'" "WINEPREFIX='$folder/wine'" WINEDEBUG=-all \
    DISPLAY= "'$root/usr/lib/wine/wine64'"
"$folder/bin/rustc" --version
"$folder/bin/x86_64-w64-mingw32-gcc" --version | head -n 1
echo "preparing wine"
if [ ! -e "$root/usr/lib/x86_64-linux-gnu/wine/x86_64-windows/bcryptprimitives.dll" ]; then
    "$folder/bin/x86_64-w64-mingw32-gcc" -shared -O1 -o "$folder/wine/drive_c/windows/system32/bcryptprimitives.dll" \
        "$here/bcryptprimitives.c" -ladvapi32
fi
"$folder/bin/wine64" --version
# the first run makes the prefix; the code that comes back proves that Windows programs run
code=0
"$folder/bin/wine64" cmd /c exit 7 </dev/null >/dev/null 2>&1 || code=$?
[ "$code" = 7 ] || { echo "wine does not run: cmd /c exit 7 came back with $code" >&2; exit 1; }
