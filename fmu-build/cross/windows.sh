#!/usr/bin/env bash
# usage: windows.sh FOLDER OLDEST_RUST
#
# Unpacks into FOLDER what builds the library for Windows and runs it there: Debian's Rust with the source of its standard
# library, MinGW, the linker of the same LLVM, and wine. FOLDER/bin holds what is to be called.
here=$(cd "$(dirname "$0")" && pwd)
source "$here/debian.sh"
begin "$1" "$2"
rust_packages
unpack "${rust[@]}" gcc-mingw-w64-x86-64-win32 gcc-mingw-w64-base gcc-mingw-w64-x86-64-win32-runtime mingw-w64-common \
    mingw-w64-x86-64-dev binutils-mingw-w64-x86-64 wine64 libwine libz-mingw-w64 "lld-${llvm//[!0-9]/}"

# Debian looks for both of these where packages are installed
ln -sf wineserver64 "$root/usr/lib/wine/wineserver"
rm -rf "$folder/wine"
mkdir -p "$folder/wine/drive_c/windows/system32"
cp "$root/usr/x86_64-w64-mingw32/lib/zlib1.dll" "$folder/wine/drive_c/windows/system32/"

script rustc "$(with_libraries "$root/usr/bin/rustc")"
# GNU's linker keeps all functions of a DLL, called or not, as tables for unwinding name them; LLVM's drops those that nothing calls
mkdir -p "$folder/linker"
script ../linker/ld.lld "$(with_libraries "$root/usr/lib/llvm-${llvm//[!0-9]/}/bin/ld.lld")"
cat > "$folder/bin/x86_64-w64-mingw32-gcc" <<END
#!/bin/bash
# an option of other systems, which Rust passes and LLVM's linker does not know
for given in "\$@"; do [[ \$given == -Wl,-soname=* ]] || taken+=("\$given"); done
exec '$root/usr/bin/x86_64-w64-mingw32-gcc-win32' -fuse-ld=lld '-B$folder/linker' "\${taken[@]}"
END
chmod +x "$folder/bin/x86_64-w64-mingw32-gcc"
script x86_64-w64-mingw32-dlltool "'$root/usr/bin/x86_64-w64-mingw32-dlltool'"
script wine64 env "WINEDLLPATH='$root/usr/lib/x86_64-linux-gnu/wine'" "WINEPREFIX='$folder/wine'" WINEDEBUG=-all \
    DISPLAY= "'$root/usr/lib/wine/wine64'"
rust_runs
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
