"""Names in docs/inside/architecture.md and docs/inside/theory.md exist: files, folders, types, constants, functions, variables, test
programs."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("src", "crates", "fmu-build", "python", "tests", "benches", "scenes", "examples")
SOURCES = {".rs", ".py", ".toml", ".js", ".h", ".c", ".csv"}
FILES = {file.relative_to(ROOT).as_posix(): file for folder in FOLDERS for file in (ROOT / folder).rglob("*")
         if file.suffix in SOURCES and file != Path(__file__) and not {"target", "node_modules"} & set(file.parts)}
TEXT = "\n".join(file.read_text(encoding="utf-8") for path, file in FILES.items() if not path.endswith(".csv"))
PATH = re.compile(r"[\w./*-]+")
# names of the standard library
STANDARD = {"Arc", "Copy"}
# form of a word in a span, and the pattern of its definition
DEFINITIONS = [(r"[A-Z][A-Z0-9_]*", r"const {}\b|static {}\b"), (r"[A-Z]\w+", r"(?:struct|enum|trait|type|macro_rules!) {}\b")]


def spans(page):
    """Code spans outside code blocks, each once."""
    prose = re.sub(r"^```.*?^```|^    .*?$", "", (ROOT / "docs" / page).read_text(encoding="utf-8"), flags=re.M | re.S)
    return sorted({" ".join(span.split()) for span in re.findall(r"`([^`]+)`", prose)})


CASES = [(page, span) for page in ("inside/architecture.md", "inside/theory.md") for span in spans(page)]


def on_disk(path):
    """True if a path from the root, or the end of a path, exists, with or without a file ending; `*` matches anything."""
    plain = path.rstrip("/")
    if (ROOT / plain).exists():
        return True
    pattern = re.escape(plain).replace(r"\*", r"[^/]*")
    return any(re.search(rf"(^|/){pattern}(\.rs|\.py)?(/|$)", name) for name in FILES)


def is_defined(word):
    if word in STANDARD:
        return True
    for form, definition in DEFINITIONS:
        if re.fullmatch(form, word):
            return re.search(definition.replace("{}", word), TEXT) is not None
    return re.search(rf"\b{word}\b", TEXT) is not None


def is_there(span):
    span = re.sub(r"^target/", "", span)  # folders created by commands are named after the commands
    if span.startswith("cargo "):
        # test programs, and modules in them
        program, module = (re.search(pattern, span) for pattern in (r"--test (\w+)", r" (\w+)::"))
        return (not program or on_disk(f"tests/{program[1]}")) and (not module or on_disk(f"{program[1]}/{module[1]}"))
    if PATH.fullmatch(span) and ("/" in span or re.search(r"\.(rs|py|toml|h|csv)$", span)):
        return on_disk(span)
    if re.fullmatch(r"BEVEL_DIFFERENTIAL_\w+=\w+", span):
        return span.split("=")[0] in TEXT
    words = re.findall(r"[A-Za-z_]\w*", re.sub(r'"[^"]*"', "", span))
    return bool(words) and all(map(is_defined, words))


@pytest.mark.parametrize(("page", "span"), CASES)
def test_files_named_on_the_pages_are_in_the_repository(page, span):
    assert is_there(span), f"docs/{page}: `{span}` is nowhere"


@pytest.mark.parametrize("name", ["src/variables/parameters.rs", "assembly/bodies.rs", "NO_SUCH_CONSTANT", "NoSuchType", "no.such_variable",
                                  "cargo test --release --test tooth_finite_elements"])
def test_an_unknown_name_is_detected(name):
    assert not is_there(name)


def test_numbers_of_the_page_are_those_of_the_source():
    page = " ".join((ROOT / "docs" / "inside" / "architecture.md").read_text(encoding="utf-8").split())

    def constant(file, name):
        return re.search(rf"const {name}: usize = (\d+);", FILES[file].read_text(encoding="utf-8"))[1]

    sizes = {name: constant("src/model/dynamics/shape.rs", name) for name in ("PLAIN_SIZE", "TWO_GROUPS_SIZE", "FEW_SIZE", "MAX_SIZE")}
    assert f"There are {constant('src/model/assembly/cache.rs', 'ENTRIES')} entries for each kind" in page
    assert f"| plain teeth | {sizes['PLAIN_SIZE']}, {sizes['TWO_GROUPS_SIZE']} |" in page
    assert f"two planets that differ | {sizes['TWO_GROUPS_SIZE']} |" in page
    assert f"half-shafts that twist | {sizes['FEW_SIZE']} |" in page
    assert f"| teeth, `Largest` | up to {sizes['MAX_SIZE']} |" in page
    assert f"| gears without teeth | up to {sizes['FEW_SIZE']}, 8 |" in page
