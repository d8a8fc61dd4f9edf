"""The linker for macOS on a small library: it names, signs and strips the library as the FMU's library requires."""

import shutil
import subprocess
from pathlib import Path

import binaries
import pytest

ROOT = Path(__file__).parents[2]
OLDEST = {"x86_64": "10.12", "arm64": "11.0"}
SOURCE = """
#include <math.h>
#include <string.h>
__attribute__((noinline)) static double hidden(double x) { char zeros[64]; memset(zeros, (int)x, sizeof zeros); return cos(x) + zeros[7]; }
double shown(double x) { return hidden(x) + hidden(2.0 * x); }
"""


@pytest.fixture(scope="module")
def tools(fmu_file, tmp_path_factory):
    """Folder with the tool chains next to the FMU, and the one for macOS built from them."""
    there, folder = Path(fmu_file).resolve().parents[1] / "toolchains", tmp_path_factory.mktemp("toolchains")
    for needed in ("linux/bin/python", "rust/bin/ld64.lld"):
        if not (there / needed).is_file():
            pytest.skip(f"{needed} is not installed (toolchains darwin64)")
    for name in ("linux", "rust"):
        (folder / name).symlink_to(there / name)
    subprocess.run(["bash", ROOT / "fmu-build" / "cross" / "darwin.sh", folder / "darwin", "1.89"], check=True)
    return folder


@pytest.mark.parametrize("processor, zig", [("x86_64", "x86_64-macos"), ("arm64", "aarch64-macos")])
def test_a_small_library_is_named_by_its_file_signed_and_exports_the_given_functions(tools, tmp_path, processor, zig):
    (tmp_path / "small.c").write_text(SOURCE, encoding="utf-8")
    (tmp_path / "list").write_text("_shown\n", encoding="utf-8")
    compiler = [tools / "linux" / "bin" / "python", "-m", "ziglang", "cc", "-target", zig, "-O1", "-g"]
    subprocess.run([*compiler, "-c", "small.c"], cwd=tmp_path, check=True,
                   env={"PATH": "/usr/bin:/bin", "ZIG_GLOBAL_CACHE_DIR": str(tmp_path / "cache"), "HOME": str(tmp_path)})
    oldest = OLDEST[processor]
    linked = subprocess.run([tools / "darwin" / "bin" / "ld64.lld", "-dylib", "-arch", processor, "-platform_version", "macos", oldest,
                             oldest, "-syslibroot", tools / "darwin" / "sdk", "-lSystem", "-lc", "-lm", "-liconv",
                             "-exported_symbols_list", "list", "-o", tmp_path / "libsmall.dylib", "small.o"],
                            cwd=tmp_path, capture_output=True, text=True, check=False)
    assert linked.returncode == 0, linked.stderr
    found = binaries.of_macos(tmp_path / "libsmall.dylib")
    assert list(found) == [processor]
    library = found[processor]
    assert library.exported == ["shown"] and library.needed == ["/usr/lib/libSystem.B.dylib"]
    assert library.own_name == ["@rpath/libsmall.dylib"] and not library.searched
    assert library.oldest == oldest and library.signature == "ad hoc"
    content = (tmp_path / "libsmall.dylib").read_bytes()
    assert b"hidden" not in content and str(tmp_path).encode() not in content


def test_without_the_tool_chains_beside_it_the_remedy_is_named(tmp_path):
    bash = shutil.which("bash")
    if bash is None:
        pytest.skip("bash makes tool chains")
    made = subprocess.run([bash, ROOT / "fmu-build" / "cross" / "darwin.sh", tmp_path / "darwin", "1.89"], capture_output=True, text=True,
                          check=False)
    assert made.returncode and "cargo run --release -- toolchains darwin64" in made.stderr
