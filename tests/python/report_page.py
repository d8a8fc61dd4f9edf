"""Reads a report like a browser: its figures, their contents, and the resources that it would load."""

import re
from html.parser import HTMLParser

from bevel_differential.report.svg_style import MARK

VOID = {"meta", "link", "br", "hr", "img", "input"}
# commands of a path in SVG that draw something
DRAWN = re.compile(r"[LCQ]")


class ReportPage(HTMLParser):
    """Contents of a report. Attributes: `figures`: marks of data by name of the figure, each with the number of drawn pieces; `captions`
    by name; `sections`: texts by name; `references`: all references."""

    def __init__(self, text):
        super().__init__()
        self.figures, self.captions, self.sections, self.references = {}, {}, {}, []
        self._stack, self._figure, self._mark, self._section = [], None, None, None
        self.feed(text)
        self.close()
        assert not self._stack, f"not closed: {self._stack}"

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.references += [value for name, value in attributes if name in ("src", "href")]
        self.references += re.findall(r"url\(([^)]*)\)", given.get("style", "") + given.get("clip-path", ""))
        if tag not in VOID:
            self._stack.append((tag, given.get("id", "")))
        if tag == "section":
            self._section = given["id"]
            self.sections[self._section] = ""
        elif tag == "figure":
            self._figure = given["id"].removeprefix("figure-")
            self.figures[self._figure], self.captions[self._figure] = {}, ""
        elif self._figure and tag == "g" and f"-{MARK}-" in given.get("id", ""):
            self._mark = given["id"]
            self.figures[self._figure][self._mark] = 0
        elif self._figure and tag == "image":
            self._drawn(1, given.get("id", "") if f"-{MARK}-" in given.get("id", "") else None)
        elif self._mark and tag == "path":
            self._drawn(len(DRAWN.findall(given.get("d", ""))))
        elif self._mark and tag == "use":
            self._drawn(1)

    def _drawn(self, pieces, name=None):
        name = name or self._mark
        if name:
            self.figures[self._figure][name] = self.figures[self._figure].get(name, 0) + pieces

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag):
        opened, name = self._stack.pop()
        assert opened == tag, f"{tag} closes {opened}"
        if name and name == self._mark:
            self._mark = None
        if tag == "figure":
            self._figure = None
        elif tag == "section":
            self._section = None
        elif tag in ("td", "th") and self._section:
            self.sections[self._section] += "\n"

    def handle_data(self, data):
        if self._section:
            self.sections[self._section] += data
        if self._figure and any(tag == "figcaption" for tag, _ in self._stack):
            self.captions[self._figure] += data


def checked(text, figures):
    """Page of a report with these figures. Checks that each figure shows something and has a caption with numbers, and that the page loads
    nothing."""
    page = ReportPage(text)
    assert set(page.figures) == figures
    for name, marks in page.figures.items():
        caption = page.captions[name]
        assert marks and max(marks.values()) >= 1, f"{name} is empty"
        assert re.search(r"\d", caption) and not re.search(r"\bnan\b|\binf\b", caption), caption
    assert all(reference.startswith(("#", "data:")) for reference in page.references)
    assert not re.search(r"https?:|@import|<script", text)
    return page
