"""Exports and system requirements of a library for Linux (ELF), Windows (PE) or macOS (Mach-O)."""

import hashlib
import struct
from pathlib import Path
from typing import NamedTuple

import lief
import pefile
from elftools.elf.elffile import ELFFile

# Apple's names of processors
PROCESSORS = {lief.MachO.Header.CPU_TYPE.X86_64: "x86_64", lief.MachO.Header.CPU_TYPE.ARM64: "arm64"}
# from Apple's cs_blobs.h: a signature of several parts, the part with the hashes of pages, the kind of hash, and a flag
SUPER_BLOB, CODE_DIRECTORY, SHA_256, AD_HOC = 0xFADE0CC0, 0, 2, 0x2


class MachO(NamedTuple):
    """Library for one kind of processor: exported functions, required libraries, its own name, searched folders, the oldest system
    ("11.0"), and the signature: None, "ad hoc", "by somebody" or "broken"."""

    exported: list[str]
    needed: list[str]
    own_name: list[str]
    searched: list[str]
    oldest: str
    signature: str | None


def of_linux(file):
    """Exported symbols, required libraries, the newest required version of glibc, as (2, 17), and ELF's name of the processor."""
    with open(file, "rb") as stream:
        elf = ELFFile(stream)
        exported = [symbol.name for symbol in elf.get_section_by_name(".dynsym").iter_symbols()
                    if symbol["st_shndx"] != "SHN_UNDEF" and symbol["st_info"]["bind"] in ("STB_GLOBAL", "STB_WEAK")]
        needed = [tag.needed for tag in elf.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")]
        wanted = [version.name for _, versions in elf.get_section_by_name(".gnu.version_r").iter_versions()
                  for version in versions]
        glibc = [tuple(int(part) for part in name.removeprefix("GLIBC_").split(".")) for name in wanted
                 if name.startswith("GLIBC_")]
    return exported, needed, max(glibc), elf["e_machine"]


def of_windows(file):
    """Exported symbols and required libraries."""
    image = pefile.PE(str(file))
    exported = [symbol.name.decode() for symbol in image.DIRECTORY_ENTRY_EXPORT.symbols]
    needed = [entry.dll.decode() for entry in image.DIRECTORY_ENTRY_IMPORT]
    return exported, needed


def of_macos(file):
    """`MachO` of each kind of processor ("x86_64", "arm64")."""
    parsed = lief.MachO.parse(str(file))
    assert parsed is not None, f"{file} is not a library for macOS"
    content = Path(file).read_bytes()
    return {PROCESSORS[binary.header.cpu_type]: _mach_o(binary, content) for binary in parsed}


def _mach_o(binary, content):
    own, named = lief.MachO.LoadCommand.TYPE.ID_DYLIB, list(binary.libraries)
    oldest = binary.build_version.minos if binary.has_build_version else binary.version_min.version
    return MachO([symbol.name.removeprefix("_") for symbol in binary.exported_symbols],
                 [library.name for library in named if library.command != own],
                 [library.name for library in named if library.command == own],
                 [command.path for command in binary.rpaths], ".".join(map(str, oldest[:2])), _signature(binary, content))


def _signature(binary, content):
    """"ad hoc" or "by somebody" if the signature is valid for every page of the code; None without a signature, otherwise "broken"."""
    if not binary.has_code_signature:
        return None
    begin = binary.fat_offset
    start = begin + binary.code_signature.data_offset
    blob = content[start:start + binary.code_signature.data_size]
    magic, _, count = struct.unpack_from(">3I", blob)
    found = {kind: at for kind, at in struct.iter_unpack(">2I", blob[12:12 + 8 * count])}
    at = found.get(CODE_DIRECTORY)
    if magic != SUPER_BLOB or at is None:
        return "broken"
    _, _, _, flags, hashes, _, _, pages, end, size, kind, _, page = struct.unpack_from(">9I4B", blob, at)
    if size != hashlib.sha256().digest_size or kind != SHA_256 or end != binary.code_signature.data_offset:
        return "broken"
    code, step = content[begin:begin + end], 1 << page
    wanted = [hashlib.sha256(code[first:first + step]).digest() for first in range(0, end, step)]
    kept = [blob[at + hashes + k * size:at + hashes + (k + 1) * size] for k in range(pages)]
    if wanted != kept:
        return "broken"
    return "ad hoc" if flags & AD_HOC else "by somebody"
