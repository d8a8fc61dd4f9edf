"""Fixtures for the tests of the page: the page in Chromium, the native FMU and node.

The command `python3 crates/lab/lab.py test-page` runs the tests and sets the environment variables PAGE, FMU, CHROMIUM and NODE."""

import csv
import os
from pathlib import Path

import pytest
from bevel_differential import Fmu
from playwright.sync_api import sync_playwright

from live import Live

ARGUMENTS = ["--no-sandbox", "--enable-unsafe-swiftshader"]
# small, because the time to draw a picture without a graphics card grows with its size
WINDOW = {"width": 900, "height": 480}
# addresses inside the page: its worker and its packed data
INSIDE = ("blob:", "data:")


def pytest_addoption(parser):
    parser.addoption("--shots", type=Path, help="folder that keeps the screenshots")
    parser.addoption("--table", type=Path, help="CSV file for what was checked")


def pytest_configure(config):
    # {name of a test: [cases, results, seconds]}
    config.checked = {}


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if report.when == "call":
        name = item.originalname.removeprefix("test_").replace("_", " ")
        row = item.config.checked.setdefault(name, [0, [], 0.0])
        row[0] += 1
        # for a skipped test, pytest gives file, line and reason
        row[1] += [f"not run: {report.longrepr[2].removeprefix('Skipped: ')}"] if report.skipped else [
            value for key, value in item.user_properties if key == "found"]
        row[2] += report.duration
    return report


def pytest_sessionfinish(session):
    file = session.config.getoption("table")
    if file:
        with open(file, "w", newline="", encoding="utf-8") as out:
            csv.writer(out).writerows([name, cases, "; ".join(found), f"{seconds:.1f}"]
                                      for name, (cases, found, seconds) in session.config.checked.items())


def named_file(variable):
    """Returns the path in an environment variable. Ends the tests if the file does not exist."""
    path = Path(os.environ.get(variable, ""))
    if not path.is_file():
        pytest.exit(f"{variable} names no file; use: python3 crates/lab/lab.py test-page", returncode=2)
    return path


@pytest.fixture
def found(record_property):
    """found(text): records results for the table of checks."""
    return lambda text: record_property("found", text)


@pytest.fixture(scope="session")
def fmu():
    """The native FMU."""
    return Fmu.of(named_file("FMU"))


@pytest.fixture(scope="session")
def scene_names():
    """Sorted names of the scenes in the repository."""
    return sorted(file.stem for file in (Path(__file__).parents[2] / "scenes").glob("*.toml"))


@pytest.fixture(scope="session")
def page_file():
    """Path of the page, a single HTML file."""
    return named_file("PAGE").resolve()


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=named_file("CHROMIUM"), args=ARGUMENTS)
        yield launched
        launched.close()


@pytest.fixture(scope="session")
def opened(browser, page_file):
    """opened(fragment, scripts): a new page in a separate browser context without network. The caller closes it."""

    def open_page(fragment="", scripts=()):
        context = browser.new_context(viewport=WINDOW, color_scheme="light")
        context.set_offline(True)
        return Live(context.new_page(), page_file.as_uri(), fragment, scripts)

    return open_page


def close(live):
    """Closes a page. Fails if the page had errors or requested anything but its file and addresses inside it."""
    live.page.context.close()
    strange = [address for address in live.asked if address.split("#")[0] != live.address and not address.startswith(INSIDE)]
    assert strange == [], "a page that needs no server has asked for these"
    assert live.faults == []


@pytest.fixture
def fresh(opened):
    """fresh(fragment, scripts): a new page with its picture paused. The end of the test closes all pages and checks their requests."""
    pages = []

    def open_page(*arguments):
        pages.append(opened(*arguments))
        pages[-1].rest()
        return pages[-1]

    yield open_page
    for live in pages:
        close(live)


@pytest.fixture(scope="session")
def shared(opened):
    """Page that most tests share, one after another."""
    live = opened("scene=study_straight", ["covered.js", "sweep.js"])
    yield live
    close(live)


@pytest.fixture
def live(shared):
    """Shared page with the straight scene. Its picture is paused and not drawn."""
    shared.rest()
    shared.go("scene=study_straight")
    yield shared
