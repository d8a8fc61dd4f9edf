"""The page in a browser, operated as a user would, with its controls, keys and address."""

from pathlib import Path
from urllib.parse import parse_qsl, quote, urlencode

import numpy as np

HERE = Path(__file__).parent
# maximum wait for a run or for a change of the page [ms]
PATIENCE = 60_000
# harmless warnings: the software renderer is slow, and tests read the pixels of plots
REMARKS = ("GL Driver Message (OpenGL, Performance", "willReadFrequently")


def address_of(settings):
    """Fragment of a link with the settings {scene: …, variable: …}."""
    return urlencode(settings, quote_via=quote)


class Live:
    """An opened page. `asked` lists all addresses that it has requested, and `faults` its errors and warnings."""

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
        """Waits until a JavaScript expression, or a function of `argument`, is true."""
        self.page.wait_for_function(condition, arg=argument, polling=20)

    def ask(self, expression, argument=None):
        """Value of a JavaScript expression, or of a function of `argument`."""
        return self.page.evaluate(expression, argument)

    @property
    def number(self):
        """Number of the last requested run."""
        return self.ask("ear.asked.number")

    def answer(self, *kinds):
        """Waits for an answer of one of these `kinds` to the last run, by default for its end. Returns all answers so far."""
        wanted = list(kinds or ("over", "refused", "trap"))
        self.wait("kinds => kinds.some((kind) => ear.answers[ear.asked.number][kind])", wanted)
        return self.ask("ear.answers[ear.asked.number]")

    def go(self, fragment, *kinds):
        """Follows a link within the page and waits for its run."""
        if self.ask("location.hash") != f"#{fragment}":
            before = self.number
            self.ask("fragment => { location.hash = fragment; }", fragment)
            self.wait("before => ear.asked.number > before", before)
        return self.answer(*kinds)

    def control(self, name):
        """Returns the control of a variable and opens its group if necessary."""
        control = self.page.locator(f'[id="set {name}"]')
        if not control.is_visible():
            control.locator("xpath=ancestor::details/summary").click()
        return control

    def put(self, name, value, *kinds):
        """Sets a control as a user does and waits for the run. `value` is a text, a bool or the name of a literal."""
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
        """Presses the button next to a control that restores the value of the scene, and waits for the run."""
        before = self.number
        self.control(name).locator("xpath=..").locator(".back").click()
        self.wait("before => ear.asked.number > before", before)
        return self.answer(*kinds)

    def value(self, name):
        """Value of a variable in the set-up [SI]."""
        return self.ask("name => page.setup.value(name)", name)

    def link(self):
        """The set-up in the address, as {name: text}."""
        return dict(parse_qsl(self.ask("location.hash.slice(1)"), keep_blank_values=True))

    def complaints(self):
        """Visible messages at controls, as {variable: text}."""
        return self.ask("ear.complaints()")

    def message(self):
        """Message over the picture, or ""."""
        return self.ask("ear.message()")

    def seen(self, name):
        """Value of a variable, its text in the address, all messages at controls, and the message over the picture."""
        return self.ask("name => ear.seen(name)", name)

    def text(self, element):
        """Text of the element with this id."""
        return self.ask("id => document.getElementById(id).textContent", element)

    def record(self, names):
        """Waits until the page has recorded all points. Returns {name: values}, with the times as "time"."""
        self.wait("ear.answers[ear.asked.number].points === page.record.count")
        columns = self.ask("names => [page.record.times, ...names.map((n) => page.record.column(n))].map((c) => Array.from(c))",
                           list(names))
        return {name: np.array(column, float) for name, column in zip(["time", *names], columns)}

    def rest(self):
        """Pauses the picture and stops drawing, for tests that do not need pictures."""
        self.ask("ear.hold()")
        self.pause()

    def pause(self):
        """Pauses the picture if it is playing."""
        if self.ask("page.player.playing"):
            self.page.locator("#play").click()
