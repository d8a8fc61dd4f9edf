"""Files are written whole or not at all: errors, Ctrl-C, permissions, links, devices, folders of files, two processes, one module."""

import ast
import multiprocessing
import os
import re
import stat
import time
from pathlib import Path

import pytest

from bevel_differential import DifferentialError, writing
from bevel_differential.writing import OutputError, in_folder, locked, whole, write_whole

PACKAGE = Path(writing.__file__).parent


def content(folder):
    """Files below a folder, with their contents."""
    return {file.relative_to(folder).as_posix(): file.read_text() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt(), ZeroDivisionError()])
def test_an_error_leaves_the_old_file_and_no_other(tmp_path, error):
    file = tmp_path / "table.csv"
    file.write_text("old")
    with pytest.raises(OutputError if isinstance(error, OSError) else type(error)) as raised, whole(file) as part:
        part.write_text("half")
        raise error
    assert content(tmp_path) == {"table.csv": "old"}
    if isinstance(error, OSError):
        assert str(raised.value).startswith(f"{file}: No space left on device; nothing is written to it; ")


def test_permissions_are_those_of_the_old_file_or_of_a_new_one(tmp_path):
    old, new = tmp_path / "old", tmp_path / "new"
    old.write_text("old")
    old.chmod(0o604)
    before = os.umask(0o027)
    try:
        for file in (old, new):
            write_whole(file, "written")
    finally:
        os.umask(before)
    assert [stat.S_IMODE(file.stat().st_mode) for file in (old, new)] == [0o604, 0o640]


def test_a_link_stays_and_its_file_is_written(tmp_path):
    (tmp_path / "place").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "place" / "file")
    for text in ("new", "newer"):
        write_whole(tmp_path / "link", text)
        assert (tmp_path / "link").is_symlink() and content(tmp_path / "place") == {"file": text}


def test_a_pipe_and_a_device_are_written_and_stay(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    opened = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_whole(pipe, "text")
    assert os.read(opened, 100) == b"text" and stat.S_ISFIFO(pipe.stat().st_mode)
    os.close(opened)
    with pytest.raises(OutputError, match="^/dev/full: No space left on device"):
        write_whole("/dev/full", "text")


def test_the_longest_name_can_be_written(tmp_path):
    name = "ä" * 127
    write_whole(tmp_path / name, "text")
    assert content(tmp_path) == {name: "text"}


def test_a_folder_cannot_be_written_as_a_file(tmp_path):
    with pytest.raises(OutputError, match=f"^{tmp_path}: Is a directory"):
        write_whole(tmp_path, "text")


def test_a_file_that_may_not_be_written_is_not_replaced(tmp_path, monkeypatch):
    # root may write to all files
    monkeypatch.setattr(writing.os, "access", lambda *_: False)
    (tmp_path / "file").write_text("old")
    with pytest.raises(OutputError, match="file: Permission denied"):
        write_whole(tmp_path / "file", "new")
    assert content(tmp_path) == {"file": "old"}


def test_a_folder_gets_all_files_or_none(tmp_path):
    out = tmp_path / "new" / "folder"
    with pytest.raises(OutputError, match=f"^{out / 'b'}: No space left on device"), in_folder(out) as stage:
        write_whole(stage / "a", "new")
        with whole(stage / "b"):
            raise OSError(28, "No space left on device")
    assert not list(tmp_path.iterdir())
    with in_folder(out) as stage:
        write_whole(stage / "a", "new")
        with in_folder(stage / "inner") as inner:
            write_whole(inner / "b", "new")
        assert not content(out).keys() & {"a", "inner/b"}
    assert content(out) == {"a": "new", "inner/b": "new"}
    with pytest.raises(KeyboardInterrupt), in_folder(out) as stage:
        write_whole(stage / "a", "newer")
        raise KeyboardInterrupt
    assert content(out) == {"a": "new", "inner/b": "new"}


def test_a_name_that_is_a_folder_is_reported_and_no_file_is_renamed(tmp_path):
    (tmp_path / "b").mkdir()
    (tmp_path / "c").write_text("old")
    with pytest.raises(OutputError, match=f"^{tmp_path / 'b'}: Is a directory; nothing"), in_folder(tmp_path) as stage:
        for name in "abc":
            write_whole(stage / name, "new")
    assert content(tmp_path) == {"c": "old"}


def test_a_name_that_is_refused_at_the_end_is_reported_with_the_complete_files(tmp_path, monkeypatch):
    replace = Path.replace

    def refused(part, final):
        if final.name == "b" and part.parent == tmp_path:
            raise OSError(30, "Read-only file system")
        return replace(part, final)

    monkeypatch.setattr(Path, "replace", refused)
    with pytest.raises(OutputError, match=rf"b: Read-only file system \(complete are {tmp_path / 'a'}\); nothing"):
        with in_folder(tmp_path) as stage:
            for name in "abc":
                write_whole(stage / name, "new")
    assert content(tmp_path) == {"a": "new"}


def test_other_errors_pass_through_a_folder(tmp_path):
    for error in (DifferentialError("the scene fails"), FileNotFoundError(2, "No such file or directory", "scene.toml")):
        with pytest.raises(type(error)) as raised, in_folder(tmp_path / "out"):
            raise error
        assert raised.value is error
    assert not list(tmp_path.iterdir())


def hold(file, begun, ended):
    with locked(file):
        begun.set()
        ended.wait()


def holder(file):
    """A process that holds the lock of `file`, and the event that ends it."""
    spawn = multiprocessing.get_context("spawn")
    begun, ended = spawn.Event(), spawn.Event()
    other = spawn.Process(target=hold, args=(file, begun, ended))
    other.start()
    assert begun.wait(60)
    return other, ended


def test_a_second_command_with_the_same_results_waits_and_says_so(tmp_path):
    other, ended = holder(tmp_path / "results")
    # the other process ends as soon as this process has reported that it waits
    with pytest.warns(match="results: another command writes there; waiting") as caught:
        caught_by = writing.warn

        def said(texts):
            caught_by(texts)
            ended.set()

        writing.warn = said
        try:
            with locked(tmp_path / "results"):
                assert ended.is_set()
        finally:
            writing.warn = caught_by
    other.join()
    assert len(caught) == 1 and not list(tmp_path.iterdir())


def test_the_lock_of_a_killed_process_is_free(tmp_path):
    other, _ = holder(tmp_path / "results")
    other.kill()
    other.join()
    start = time.monotonic()
    with locked(tmp_path / "results"):
        assert time.monotonic() - start < 5.0


# calls that write a file, including those of libraries
WRITERS = {"write_text", "write_bytes", "savefig", "to_csv", "to_parquet", "to_excel", "to_json", "to_html", "savetxt", "save", "savez",
           "tofile", "write_table", "copy", "copy2", "copyfile", "copytree", "move", "replace", "rename", "touch", "export", "saveas", "dump"}
# calls with such a name that write through `writing`
OWN = {"scene.to_csv", "scene.to_parquet", "style.save", "save", "to_csv", "copy.copy"}


def writes(call):
    """True if a call writes a file, judged by its name and its arguments."""
    function = ast.unparse(call.func)
    name = function.rpartition(".")[2]
    if name == "open":
        modes = [*call.args, *(keyword.value for keyword in call.keywords if keyword.arg == "mode")]
        return any(isinstance(mode, ast.Constant) and re.fullmatch("[rwxabt+]*[wxa+][rwxabt+]*", str(mode.value)) for mode in modes)
    if name not in WRITERS or function in OWN or not call.args:
        return False
    # `replace` of texts has two arguments, and that of times has named arguments
    return name != "replace" or function == "os.replace" or len(call.args) == 1 and not call.keywords


def direct(source):
    """Calls that write a file other than the temporary file of `whole`."""
    tree, found = ast.parse(source), []
    memory = {node.targets[0].id for node in ast.walk(tree) if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
              and ast.unparse(node.value).startswith("io.")}

    def visit(node, parts):
        if isinstance(node, ast.With):
            parts = parts | {item.optional_vars.id for item in node.items if isinstance(item.optional_vars, ast.Name)
                             and ast.unparse(item.context_expr).startswith("whole(")}
        if isinstance(node, ast.Call) and writes(node) and not {name.id for name in ast.walk(node) if isinstance(name, ast.Name)} & parts:
            found.append(f"{node.lineno}: {ast.unparse(node)}")
        for child in ast.iter_child_nodes(node):
            visit(child, parts)

    visit(tree, frozenset(memory))
    return found


@pytest.mark.parametrize("line", ["open(file, 'w')", "file.open('ab')", "open(file, mode='x')", "file.write_text(text)", "np.savetxt(file, rows)",
                                  "table.to_csv(file)", "figure.savefig(file)", "shutil.copyfile(a, b)", "pq.write_table(table, file)",
                                  "part.replace(file)", "os.replace(a, b)", "Image.save(few, file)"])
def test_a_direct_writer_is_found(line):
    assert direct(line) and direct(f"with whole(other) as part:\n    x = 1\n{line.replace('part', 'old')}")


def test_only_one_module_writes_files():
    found = {file.relative_to(PACKAGE).as_posix(): direct(file.read_text(encoding="utf-8")) for file in sorted(PACKAGE.rglob("*.py"))}
    assert found.pop("writing.py")
    assert {file: lines for file, lines in found.items() if lines} == {}


RUST = [file for folder in ("fmu-build/src", "crates/answers/src", "crates/lab/src") for file in sorted((PACKAGE.parents[2] / folder).rglob("*.rs"))]
# modules for files and locks; a folder that replaces another, and the files that pip and programs of tests wrote
RUST_OWNERS = {"whole_file.rs", "lock.rs"}
RUST_OTHERS = {"fs::rename(made, &old)", "fs::rename(&wheel, &target)", "File::create(&file)"}


def test_only_one_module_in_rust_writes_files():
    found = []
    for file in RUST:
        source = file.read_text(encoding="utf-8").partition("#[cfg(test)]\nmod tests")[0]
        calls = re.findall(r"(?:fs::(?:write|copy|rename)|File::(?:create|create_new|options)|OpenOptions::new)\([^()]*\)?", source)
        found += [(file.name, call) for call in calls if file.name not in RUST_OWNERS and not re.search(r"\bpart\b", call)
                  and call not in RUST_OTHERS]
    assert RUST and not found
