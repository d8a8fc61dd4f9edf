"""Contents of the packaged FMU: libraries that only export FMI, a valid description, complete documentation.

The environment variable PLATFORMS names the required platforms of the archive, such as "linux64-glibc-2.17 win64". It is set where
the tool chains are installed; then no platform may be missing. Without it, the archive must agree with its documentation."""

import os
import re
import zipfile
from html.parser import HTMLParser
from pathlib import Path, PurePosixPath

import binaries
import fmpy
import pytest
from fmpy.fmi3 import _FMU3
from lxml import etree

ROOT = Path(__file__).parents[2]

# all functions that the standard's header declares: sections 2.1, 3.2 and 4.2
COMMON = ["GetTypesPlatform", "GetVersion", "SetDebugLogging", "Instantiate", "FreeInstance", "SetupExperiment",
          "EnterInitializationMode", "ExitInitializationMode", "Terminate", "Reset", "GetReal", "GetInteger", "GetBoolean",
          "GetString", "SetReal", "SetInteger", "SetBoolean", "SetString", "GetFMUstate", "SetFMUstate", "FreeFMUstate",
          "SerializedFMUstateSize", "SerializeFMUstate", "DeSerializeFMUstate", "GetDirectionalDerivative"]
STEPPING = ["SetRealInputDerivatives", "GetRealOutputDerivatives", "DoStep", "CancelStep", "GetStatus", "GetRealStatus",
            "GetIntegerStatus", "GetBooleanStatus", "GetStringStatus"]
EXCHANGING = ["EnterEventMode", "NewDiscreteStates", "EnterContinuousTimeMode", "CompletedIntegratorStep", "SetTime",
              "SetContinuousStates", "GetDerivatives", "GetEventIndicators", "GetContinuousStates",
              "GetNominalsOfContinuousStates"]
DECLARED = {"fmi2" + name for name in COMMON + STEPPING + EXCHANGING}
# functions of FMI 3.0, as fmpy calls them
DECLARED |= {name for name in dir(_FMU3) if name.startswith("fmi3")}
# libraries that belong to Windows, in addition to the families below
WINDOWS_OWN = {"kernel32.dll", "ntdll.dll", "msvcrt.dll", "userenv.dll", "ws2_32.dll", "bcrypt.dll", "advapi32.dll",
               "bcryptprimitives.dll"}
# libraries that belong to glibc, and the unwinder of a plain build
LINUX_OWN = {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
# names of processors in ELF, by platform
PROCESSORS = {"linux64": "EM_X86_64", "aarch64-linux": "EM_AARCH64"}
# the only library on which macOS lets programs rely, and the oldest system by processor
MACOS_OWN, MACOS_OLDEST = ["/usr/lib/libSystem.B.dylib"], {"x86_64": "10.12", "arm64": "11.0"}
# maximum sizes in the archive, bytes: of the library of each platform, about one and a half times its present size (two for macOS), and
# of everything else together: description, documentation, licences, icon
MAX_LIBRARY, MAX_REST = {"linux64": 2.6e6, "win64": 2.2e6, "aarch64-linux": 2.0e6, "darwin64": 4.0e6}, 1.0e6
# the page, which is included if it was built, and is not counted
LIVE = "documentation/BevelDifferential.html"
# document that FMI-LS-REF recommends in addition to the documentation
TESTS = "documentation/fmi-ls-ref.txt"
DEMANDED = os.environ.get("PLATFORMS", "").split()


class Page(HTMLParser):
    """Links, pictures and text of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.pictures, self.text = [], [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "href" in attributes:
            self.links.append(attributes["href"])
        if "src" in attributes:
            self.pictures.append(attributes["src"])

    def handle_data(self, data):
        self.text += data + " "


@pytest.fixture(scope="module")
def archive(fmu_file):
    with zipfile.ZipFile(fmu_file) as archive:
        yield archive


@pytest.fixture(scope="module")
def page(archive):
    return Page(archive.read("documentation/index.html").decode("utf-8"))


@pytest.fixture
def libraries(archive, tmp_path):
    """Unpacked libraries of the archive by platform."""
    names = [name for name in archive.namelist() if name.startswith("binaries/")]
    return {PurePosixPath(name).parts[1]: Path(archive.extract(name, tmp_path)) for name in names}


def test_every_demanded_library_is_there(libraries, page):
    assert libraries
    for demanded in DEMANDED:
        platform, *version = demanded.split("-glibc-")
        assert platform in libraries
        for glibc in version:
            assert f"glibc {glibc} or newer" in page.text


def test_libraries_export_the_functions_of_fmi_and_nothing_else(libraries):
    for platform, file in libraries.items():
        if file.suffix == ".dylib":
            all_exported = [library.exported for library in binaries.of_macos(file).values()]
        else:
            all_exported = [binaries.of_windows(file)[0] if file.suffix == ".dll" else binaries.of_linux(file)[0]]
        for exported in all_exported:
            assert len(exported) == len(set(exported))
            assert set(exported) == DECLARED, platform


@pytest.mark.parametrize("platform, processor", [("linux64", "x86-64"), ("aarch64-linux", "64-bit ARM")])
def test_the_library_for_linux_needs_no_newer_glibc_than_the_page_states(libraries, page, platform, processor):
    if platform not in libraries:
        pytest.skip("the archive holds no library for Linux on this processor")
    _, needed, glibc, machine = binaries.of_linux(libraries[platform])
    assert machine == PROCESSORS[platform]
    promised = re.search(rf"Linux on {processor} with glibc (\d+)\.(\d+) or newer", page.text)
    if promised:
        assert glibc <= tuple(int(part) for part in promised.groups())
        assert set(needed) <= LINUX_OWN
    else:
        assert "as new as the machine" in page.text
        assert set(needed) <= LINUX_OWN | {"libgcc_s.so.1"}


def test_the_library_for_windows_needs_only_windows(libraries):
    if "win64" not in libraries:
        pytest.skip("the archive holds no library for Windows")
    _, needed = binaries.of_windows(libraries["win64"])
    others = {name.lower() for name in needed if not name.lower().startswith(("api-ms-win-", "ext-ms-win-"))}
    assert others <= WINDOWS_OWN


def test_the_library_for_macos_has_both_processors_and_is_signed_for_each(libraries):
    if "darwin64" not in libraries:
        pytest.skip("the archive holds no library for macOS")
    found = binaries.of_macos(libraries["darwin64"])
    assert {processor: library.oldest for processor, library in found.items()} == MACOS_OLDEST
    for processor, library in found.items():
        assert library.needed == MACOS_OWN, processor
        assert library.signature == "ad hoc", processor
        # neither contains the path of its build
        assert library.own_name == ["@rpath/libbevel_differential.dylib"] and not library.searched, processor


def test_a_changed_byte_breaks_the_signature(libraries, tmp_path):
    if "darwin64" not in libraries:
        pytest.skip("the archive holds no library for macOS")
    content = bytearray(libraries["darwin64"].read_bytes())
    content[content.index(b"src/variables")] ^= 1
    (tmp_path / "changed.dylib").write_bytes(content)
    assert sorted(library.signature for library in binaries.of_macos(tmp_path / "changed.dylib").values()) == ["ad hoc", "broken"]


def test_fmi_3_has_the_same_libraries_by_its_own_names(archive, fmu_file):
    other = Path(fmu_file).with_name("BevelDifferential3.fmu")
    if not other.is_file():
        pytest.skip("there is no FMU of FMI 3.0 beside this one")
    names = {"linux64": ["x86_64-linux"], "win64": ["x86_64-windows"], "aarch64-linux": ["aarch64-linux"],
             "darwin64": ["x86_64-darwin", "aarch64-darwin"]}
    with zipfile.ZipFile(other) as three:
        libraries = {PurePosixPath(name).parts[1]: three.read(name) for name in three.namelist() if name.startswith("binaries/")}
    for name in [name for name in archive.namelist() if name.startswith("binaries/")]:
        whole = archive.read(name)
        for platform in names[PurePosixPath(name).parts[1]]:
            # part of a universal library
            assert libraries.pop(platform) in whole, platform
    assert not libraries


def test_libraries_contain_no_path_of_the_machine_that_built_them(libraries):
    cargo = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    for platform, file in libraries.items():
        content = file.read_bytes()
        # panics contain source locations
        assert b"src/variables" in content and b"crates/" in content, platform
        for folder in [".cargo", str(cargo), str(ROOT)]:
            assert folder.encode() not in content, (platform, folder)


def test_the_description_is_valid_by_the_standard_s_schema(archive):
    folder = Path(fmpy.__file__).parent / "schema" / "fmi2"
    schema = etree.XMLSchema(etree.parse(str(folder / "fmi2ModelDescription.xsd")))
    description = etree.fromstring(archive.read("modelDescription.xml"))
    schema.assertValid(description)
    description.set("fmiVersion", "3.0")
    assert not schema.validate(description)


def test_pictures_and_links_of_the_documentation_lie_in_the_archive(archive, page):
    names = set(archive.namelist())
    assert len(page.pictures) >= 3 and len(page.links) >= 10
    for link in page.pictures + page.links:
        assert f"documentation/{link}" in names, link
    for picture in page.pictures:
        assert archive.read(f"documentation/{picture}").startswith(b"\x89PNG\r\n\x1a\n")


def test_the_documentation_leads_to_the_document_of_the_evidence(archive, page):
    assert TESTS in {f"documentation/{link}" for link in page.links}
    text = archive.read(TESTS).decode("utf-8")
    parameter_sets = [PurePosixPath(name).stem for name in archive.namelist() if name.endswith(".ssv")]
    assert parameter_sets and all(f"- `{name}`: " in text for name in parameter_sets)


def test_every_variable_is_in_the_documentation(page, fmu):
    words = set(page.text.split())
    for variable in fmu.variables.values():
        if variable.causality in ("parameter", "input", "output"):
            assert variable.name in words


def test_licences_of_all_that_is_linked_in_are_there(archive, page):
    texts = {name: archive.read(name).decode("utf-8") for name in archive.namelist() if "/licenses/" in name}
    for folder in {PurePosixPath(name).parent for name in texts}:
        assert max(len(text) for name, text in texts.items() if PurePosixPath(name).parent == folder) > 400, folder
    assert {f"documentation/{link}" for link in page.links} - {LIVE, TESTS} == set(texts)
    lock = (ROOT / "Cargo.lock").read_text(encoding="utf-8")
    own = re.search(r'name = "bevel-differential"\nversion = "[^"]*"\ndependencies = \[\n(.*?)\]', lock, re.DOTALL)
    crates = set(re.findall(r'^ "([^" ]+)', own[1], re.MULTILINE)) - {"fastrand", "serde_json"}  # only for tests
    assert len(crates) >= 6
    for crate in crates:
        assert re.search(rf"\b{crate}-\d", page.text), crate


def sizes(archive):
    """Sizes in the archive by platform, and of "the rest", bytes."""
    found = {"the rest": 0}
    for entry in archive.infolist():
        parts = PurePosixPath(entry.filename).parts
        part = parts[1] if parts[0] == "binaries" and not entry.is_dir() else "the rest"
        found[part] = found.get(part, 0) + (0 if entry.filename == LIVE else entry.compress_size)
    return found


def too_large(archive):
    """Parts of an archive that exceed their maximum size."""
    return {part: size for part, size in sizes(archive).items() if size > {**MAX_LIBRARY, "the rest": MAX_REST}[part]}


def test_each_library_is_small_and_so_is_the_rest_of_the_archive(archive, fmu_file):
    assert not too_large(archive)
    live = archive.getinfo(LIVE).compress_size if LIVE in archive.namelist() else 0
    # except for the names of its files
    assert sum(sizes(archive).values()) + live == pytest.approx(os.path.getsize(fmu_file), rel=0.02)


@pytest.mark.parametrize("grown, file", [("linux64", "binaries/linux64/BevelDifferential.so"),
                                         ("win64", "binaries/win64/BevelDifferential.dll"),
                                         ("aarch64-linux", "binaries/aarch64-linux/BevelDifferential.so"),
                                         ("darwin64", "binaries/darwin64/BevelDifferential.dylib"), ("the rest", "documentation/large.png")])
def test_a_part_that_grows_is_too_large_whatever_else_is_in_the_archive(tmp_path, grown, file):
    limits = {**MAX_LIBRARY, "the rest": MAX_REST}
    with zipfile.ZipFile(tmp_path / "grown.fmu", "w") as made:
        made.writestr(LIVE, bytes(int(2 * max(limits.values()))))
        for platform, ending in (("linux64", "so"), ("win64", "dll"), ("aarch64-linux", "so"), ("darwin64", "dylib")):
            if platform != grown:
                made.writestr(f"binaries/{platform}/BevelDifferential.{ending}", bytes(int(0.9 * limits[platform])))
        assert not too_large(made)
        made.writestr(file, bytes(int(1.1 * limits[grown])))
        assert list(too_large(made)) == [grown]


def test_the_archive_is_the_same_whenever_it_is_packed(archive):
    names = archive.namelist()
    assert names[0] == "modelDescription.xml" and len(names) == len(set(names))
    assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_the_icon_is_a_square_picture(archive):
    picture = archive.read("model.png")
    assert picture.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = (int.from_bytes(picture[begin:begin + 4], "big") for begin in (16, 20))
    assert width == height >= 120
