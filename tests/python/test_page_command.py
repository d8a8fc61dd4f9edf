"""The command `bevel-differential page`: it finds the page, or says how to build it."""

import webbrowser

import pytest
from command_line import command

from bevel_differential.command import FAILED, page


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


def test_the_page_of_the_wheel_is_opened(package, monkeypatch):
    made(package.parents[2] / "target" / "page")
    file = made(package / "page")
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    printed = command("page").out
    assert opened == [file.as_uri()] and printed == f"{file.as_uri()}\n"


def test_in_a_checkout_the_command_opens_the_page_made_there(package, monkeypatch):
    file = made(package.parents[2] / "target" / "page")
    monkeypatch.setattr(webbrowser, "open", lambda address: pytest.fail("nothing is opened"))
    assert command("page --path").out == f"{file}\n"


def test_without_a_page_the_message_gives_the_command_that_makes_one(package):
    message = command("page", FAILED).err
    assert "cargo run --release -- page" in message and len(message.splitlines()) == 1


def test_without_a_browser_the_address_is_there_to_be_opened(package, monkeypatch):
    file = made(package / "page")
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    printed = command("page", FAILED)
    assert printed.out == f"{file.as_uri()}\n" and "no browser" in printed.err
