"""What a library for Linux (ELF) or Windows (PE) exports and what it needs of a system."""

import pefile
from elftools.elf.elffile import ELFFile


def of_linux(file):
    """Exported symbols, libraries, and the newest version of glibc that is required, as (2, 17)."""
    with open(file, "rb") as stream:
        elf = ELFFile(stream)
        exported = [symbol.name for symbol in elf.get_section_by_name(".dynsym").iter_symbols()
                    if symbol["st_shndx"] != "SHN_UNDEF" and symbol["st_info"]["bind"] in ("STB_GLOBAL", "STB_WEAK")]
        needed = [tag.needed for tag in elf.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")]
        wanted = [version.name for _, versions in elf.get_section_by_name(".gnu.version_r").iter_versions()
                  for version in versions]
        glibc = [tuple(int(part) for part in name.removeprefix("GLIBC_").split(".")) for name in wanted
                 if name.startswith("GLIBC_")]
    return exported, needed, max(glibc)


def of_windows(file):
    """Exported symbols and libraries."""
    image = pefile.PE(str(file))
    exported = [symbol.name.decode() for symbol in image.DIRECTORY_ENTRY_EXPORT.symbols]
    needed = [entry.dll.decode() for entry in image.DIRECTORY_ENTRY_IMPORT]
    return exported, needed
