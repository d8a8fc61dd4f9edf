# Sourced by the scripts beside it: unpacks Debian's packages into $folder/root, and makes their programs callable in $folder/bin.
# Nothing is installed and no rights are needed. Versions are those of the Debian release at hand: archives keep no older ones, so
# they cannot be pinned.
set -euo pipefail

begin() { # FOLDER OLDEST: where to, and the oldest Rust that will do
    oldest=$2
    mkdir -p "$1"
    folder=$(cd "$1" && pwd)
    root=$folder/root
    for tool in apt-get apt-cache dpkg-deb; do
        command -v "$tool" >/dev/null || { echo "$tool is needed: this works on Debian and what descends from it" >&2; exit 1; }
    done
    rm -rf "$folder/packages" "$root" "$folder/bin"
    mkdir -p "$folder/packages" "$root" "$folder/bin"
}

dependency() { # PACKAGE BEGINNING: the package that PACKAGE depends on whose name begins so
    apt-cache depends "$1" | sed -n "s/^ *Depends: \($2[^ ]*\)$/\1/p" | head -n 1
}

new_enough() { # VERSION: stops if that of Rust is older than the library needs
    local version=${1%%[+~-]*}
    [ "$(printf '%s\n' "$oldest" "$version" | sort -V | head -n 1)" = "$oldest" ] && return
    echo "Debian's rustc-web is Rust $version here, and $oldest or newer is needed. If the lists of packages are old, apt-get update," \
        "as root, renews them; then call this again" >&2
    exit 1
}

rust_packages() { # sets rust: Debian's Rust with the source of its standard library; llvm: the package of its LLVM
    local std
    std=$(dependency libstd-rust-web-dev libstd-rust-web-)
    llvm=$(dependency "$std" libllvm)
    [ -n "$std" ] && [ -n "$llvm" ] || { echo "the package rustc-web is unknown here: run apt-get update as root" >&2; exit 1; }
    # before anything is downloaded
    new_enough "$(apt-cache policy rustc-web | sed -n 's/^ *Candidate: //p')"
    rust=(rustc-web rust-web-src libstd-rust-web-dev "$std" "$llvm")
}

unpack() { # PACKAGE...
    echo "downloading $*"
    (cd "$folder/packages" && apt-get download -qq -o APT::Sandbox::User=root "$@") || {
        echo "if a package is not found, the lists of packages are old: apt-get update, as root, renews them" >&2
        exit 1
    }
    for package in "$folder"/packages/*.deb; do
        echo "unpacking $(basename "$package" .deb)"
        # of Rust's source only the standard library is built, of emulators one is used, of all else no tests and manuals are read
        dpkg-deb --fsys-tarfile "$package" | tar -x -C "$root" --no-wildcards-match-slash --exclude='./usr/src/rustc-*/[!l]*' \
            --exclude='./usr/share/man' --exclude='./usr/lib/debug' \
            --exclude='./usr/lib/gcc/i686-w64-mingw32' --exclude='./usr/i686-w64-mingw32' \
            --exclude='./usr/bin/qemu-[!a]*' --exclude='./usr/libexec/qemu-binfmt' \
            --exclude='./usr/lib/x86_64-linux-gnu/wine/i386-windows'
    done
    rm -r "$folder/packages"
}

script() { # NAME COMMAND...: FOLDER/bin/NAME that calls the command with its own arguments
    local name=$1
    shift
    { echo '#!/bin/sh'; echo "exec $* \"\$@\""; } > "$folder/bin/$name"
    chmod +x "$folder/bin/$name"
}

rust_runs() { # says the version of the Rust that was unpacked, and stops if it is too old
    local said
    said=$("$folder/bin/rustc" --version)
    echo "$said"
    new_enough "$(echo "$said" | cut -d ' ' -f 2)"
}

with_libraries() { # PROGRAM: a command that calls it with the libraries that were unpacked
    echo "env LD_LIBRARY_PATH='$root/usr/lib/x86_64-linux-gnu' '$1'"
}
