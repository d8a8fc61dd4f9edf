"""The page in a browser, used as a reader uses it: by its controls, keys and address."""

from pathlib import Path
from urllib.parse import parse_qsl, quote, urlencode

import numpy as np

HERE = Path(__file__).parent
# of a run, or until the page shows something, ms
PATIENCE = 60_000
# of the driver that draws without a graphics card, on its speed, and on tests that read a plot's pixels
REMARKS = ("GL Driver Message (OpenGL, Performance", "willReadFrequently")


def address_of(settings):
    """The fragment for {scene: …, variable: …}, as in a link."""
    return urlencode(settings, quote_via=quote)


class Live:
    """One opened page. `asked` are all addresses it has requested, `faults` its errors."""

    def __init__(self, page, address, fragment="", scripts=()):
        self.page, self.address = page, address
        self.asked, self.faults = [], []
        page.set_default_timeout(PATIENCE)
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        page.context.on("request", lambda request: self.asked.append(request.url))
        for script in ("ear.js", *scripts):
            page.add_init_script(path=HERE / script)
        page.goto(f"{address}#{fragment}" if fragment else address)
        self.wait("window.ear?.asked")
        self.answer()

    def _hear(self, said):
        if said.type in ("error", "warning") and not any(each in said.text for each in REMARKS):
            self.faults.append(said.text)

    def wait(self, condition, argument=None):
        """Waits until a JavaScript expression, or a function of `argument`, holds."""
        self.page.wait_for_function(condition, arg=argument, polling=20)

    def ask(self, expression, argument=None):
        """The value of a JavaScript expression, or of a function of `argument`."""
        return self.page.evaluate(expression, argument)

    @property
    def number(self):
        """Of the run that was asked for last."""
        return self.ask("ear.asked.number")

    def answer(self, *kinds):
        """What the worker has said to the last run, when it is of one of these kinds; else when the run has come to an end."""
        wanted = list(kinds or ("over", "refused", "trap"))
        self.wait("kinds => kinds.some((kind) => ear.answers[ear.asked.number][kind])", wanted)
        return self.ask("ear.answers[ear.asked.number]")

    def go(self, fragment, *kinds):
        """Follows a link of the page itself, and waits for its run."""
        if self.ask("location.hash") != f"#{fragment}":
            before = self.number
            self.ask("fragment => { location.hash = fragment; }", fragment)
            self.wait("before => ear.asked.number > before", before)
        return self.answer(*kinds)

    def control(self, name):
        """The control of a variable, in an open group."""
        control = self.page.locator(f'[id="set {name}"]')
        if not control.is_visible():
            control.locator("xpath=ancestor::details/summary").click()
        return control

    def put(self, name, value, *kinds):
        """Gives a value to a control as a reader does, and waits for the run: text, True or False, or a literal's name."""
        control, before = self.control(name), self.number
        assert control.evaluate("c => c.type === 'checkbox' ? c.checked : c.selectedOptions?.[0].label ?? c.value") != value, (
            f"{name} is {value} already")
        if isinstance(value, bool):
            control.set_checked(value)
        elif control.evaluate("control => control.tagName") == "SELECT":
            control.select_option(label=value)
        else:
            control.fill(value)
            control.press("Enter")
        self.wait("before => ear.asked.number > before", before)
        return self.answer(*kinds)

    def back(self, name, *kinds):
        """Presses the button beside a control that brings the scene's value back."""
        before = self.number
        self.control(name).locator("xpath=..").locator(".back").click()
        self.wait("before => ear.asked.number > before", before)
        return self.answer(*kinds)

    def value(self, name):
        """A value of the set-up, in SI."""
        return self.ask("name => page.setup.value(name)", name)

    def link(self):
        """The set-up in the address: texts by name."""
        return dict(parse_qsl(self.ask("location.hash.slice(1)"), keep_blank_values=True))

    def complaints(self):
        """Texts of the messages that stand at controls, by the control's variable."""
        return self.ask("ear.complaints()")

    def message(self):
        """The message over the picture, "" where there is none."""
        return self.ask("ear.message()")

    def seen(self, name):
        """What the page shows of a variable: value, word in the address, complaints, message."""
        return self.ask("name => ear.seen(name)", name)

    def text(self, element):
        """Text of the element with this id."""
        return self.ask("id => document.getElementById(id).textContent", element)

    def record(self, names):
        """The page's record of a run that is over: {name: values}, and the times as "time"."""
        self.wait("ear.answers[ear.asked.number].points === page.record.count")
        columns = self.ask("names => [page.record.times, ...names.map((n) => page.record.column(n))].map((c) => Array.from(c))",
                           list(names))
        return {name: np.array(column, float) for name, column in zip(["time", *names], columns)}

    def rest(self):
        """The picture stands still and is not drawn, for tests that do not look at it."""
        self.ask("ear.hold()")
        self.pause()

    def pause(self):
        """Stops the picture, so that nothing is drawn that a test does not ask for."""
        if self.ask("page.player.playing"):
            self.page.locator("#play").click()
