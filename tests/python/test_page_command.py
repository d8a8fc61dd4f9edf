"""The command `bevel-differential page`: it finds the page, or says how to build it."""

import webbrowser

import pytest

from bevel_differential.command import main, page


@pytest.fixture
def package(tmp_path, monkeypatch):
    folder = tmp_path / "repository" / "python" / "src" / "bevel_differential"
    folder.mkdir(parents=True)
    monkeypatch.setattr(page.importlib.resources, "files", lambda name: folder)
    return folder


def made(folder):
    folder.mkdir(parents=True)
    file = folder / page.FILE
    file.write_text("<!DOCTYPE html>")
    return file


def test_the_page_of_the_wheel_is_opened(package, monkeypatch, capsys):
    made(package.parents[2] / "target" / "page")
    file = made(package / "page")
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    assert main(["page"]) == 0
    assert opened == [file.as_uri()] and capsys.readouterr().out == f"{file.as_uri()}\n"


def test_in_a_checkout_the_command_opens_the_page_made_there(package, monkeypatch, capsys):
    file = made(package.parents[2] / "target" / "page")
    monkeypatch.setattr(webbrowser, "open", lambda address: pytest.fail("nothing is opened"))
    assert main(["page", "--path"]) == 0
    assert capsys.readouterr().out == f"{file}\n"


def test_without_a_page_the_message_gives_the_command_that_makes_one(package, capsys):
    assert main(["page"]) == 1
    message = capsys.readouterr().err
    assert "cargo run --release -- page" in message and len(message.splitlines()) == 1


def test_without_a_browser_the_address_is_there_to_be_opened(package, monkeypatch, capsys):
    file = made(package / "page")
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    assert main(["page"]) == 1
    printed = capsys.readouterr()
    assert printed.out == f"{file.as_uri()}\n" and "no browser" in printed.err
