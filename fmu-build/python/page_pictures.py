"""Pictures of the page: docs/figures/page.png of the whole page, and docs/figures/differential.png of only the gears.

usage: page_pictures.py PAGE.html FOLDER [CHROMIUM]

It needs playwright (pip install playwright) and a browser: the given program of Chromium, or by default playwright's own browser.
"""

import sys
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

# software rendering, so that all machines draw the same picture
ARGUMENTS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"]
PATIENCE = 120e3  # ms
# the stage fills the window, and nothing covers it
ALONE = """
header, #transport, #outputs, #controls, #stage > :not(canvas) { display: none !important; }
main { display: block; padding: 0; }
#stage { position: fixed; inset: 0; border: 0; border-radius: 0; }
"""


def opened(page: Page, file: Path, fragment: str, time: float) -> None:
    """Opens a set-up and stops at a time of its run [s]."""
    page.goto(f"{file.resolve().as_uri()}#{fragment}&picture=fine")
    page.wait_for_function("window.page?.isOver && page.view.differential.gears", timeout=PATIENCE)
    page.evaluate(f"page.seek({time})")
    settled(page)


def settled(page: Page) -> None:
    """Waits until the current picture is drawn."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def main(file: Path, folder: Path, program: str | None) -> None:
    """Creates both pictures."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 720}, color_scheme="light")
        page.set_default_timeout(PATIENCE)
        opened(page, file, "scene=study_turning&view=flank", 0.3)
        page.screenshot(path=folder / "page.png")

        page.set_viewport_size({"width": 1280, "height": 640})
        opened(page, file, "scene=study_turning", 0.212)
        page.add_style_tag(content=ALONE)
        settled(page)
        page.screenshot(path=folder / "differential.png")
        browser.close()


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3] if len(sys.argv) == 4 else None)
