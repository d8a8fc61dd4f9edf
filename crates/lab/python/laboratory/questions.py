"""Random questions to the library of answers, through its C interface and from several threads at the same time. Each question must get
an answer or a problem. The Rust program `lab questions` asks them."""

import json
import random
import tempfile
import xml.etree.ElementTree as xml
from collections import Counter
from pathlib import Path

from .paths import SCENES, WORKSPACE, printed
from .terminal import Finding, aligned

# absurd numbers and texts
ODD = ["0", "-1", "1e308", "-1e-320", "1e999", "nan", "inf", "", "°", "4.5 mm", "3 kg", "true", "line_weber", "a\0b"]
# maximum number of characters of a question that is printed
LONGEST = 400
# kinds of questions, each with its keys; "of[]" is the key "of" with a list of scenes
KINDS = {
    "scenes": ["scenes"], "scene": ["of"], "plan": ["of"], "run": ["of", "out"], "export": ["of", "format"], "loads": ["of", "out", "every"],
    "accuracy": ["of", "want", "within", "from"], "pattern": ["of[]"], "geometry": ["set", "facets", "thicken", "solids"],
    "word": ["statistic"], "statistics": ["points", "figures"], "weather": ["results"],
}
NAMES = ["clunk", "hil", "limited_slip", "locked", "rattle", "split_friction", "study_turning", "torque_bias"]
DURATIONS = ["1 ms", "0.1", "1e-300", "-1", "nan", "1 mm", "0.05mm"]
# values of keys that are drawn from a list
LISTS = {
    "out": ["/nowhere/at/all.csv", "/dev/null/x.csv", "/dev/null/x.csv"], "format": ["ssv", "python", "pdf"],
    "every": DURATIONS, "from": DURATIONS, "thicken": DURATIONS, "within": ["1%", "0.01", "5 %", "0", "nan", "1e-9", "200%", "1"],
    "solids": [True, False], "facets": [2, 7, 32, 0, 1_000_000], "points": [0, 1, 2, 4, 10**12], "scenes": [str(SCENES)],
}


class Questions(random.Random):
    """Generator of random questions."""

    def __init__(self, seed):
        super().__init__(seed)
        description = xml.parse(WORKSPACE / "modelDescription" / "modelDescription.xml")
        self.variables = [row.get("name") for row in description.iter("ScalarVariable")]

    def chance(self, n):
        """True with probability 1 / `n`."""
        return self.randrange(n) == 0

    def several(self, draw, most):
        """List of up to `most` drawn values."""
        return [draw() for _ in range(self.randrange(most + 1))]

    def line(self):
        """A question and the numbers that belong to it, as JSON."""
        odd = ["0", "1", "2", "-1", "1e308", "nan", "inf"]
        numbers = [self.choice(odd) if self.chance(4) else str(number) for number in range(self.randrange(13))]
        return json.dumps([self.text(), numbers])

    def text(self):
        """Text of a question, sometimes corrupted."""
        text = bytearray(json.dumps(self.question(), ensure_ascii=False).encode())
        for _ in range(self.randint(1, 3) if self.chance(5) else 0):
            at = self.randrange(len(text) or 1)
            text[at:] = self.choice([b"", bytes([self.randint(1, 255)]) + text[at + 1:], self.choice("{}[],:\"0e-\\n").encode() + text[at:]])
        return text.decode(errors="replace")

    def question(self):
        """Question with most of the keys of its kind, and sometimes with a key that does not belong."""
        kind = self.choice(list(KINDS))
        keys = [key for key in KINDS[kind] if not self.chance(12)]
        question = {"ask": kind} | {key.removesuffix("[]"): self.anything() if self.chance(25) else self.value(key) for key in keys}
        if self.chance(40):
            question[self.choice(["of", "set", "within", "nothing"])] = self.anything()
        return question

    def value(self, key):
        """Value of a key."""
        if key in LISTS:
            return self.choice(LISTS[key])
        if key == "of":
            return self.source()
        if key == "of[]":
            return self.several(self.source, 2)
        if key == "set":
            return self.several(self.assignment, 3)
        if key == "want":
            kinds = ["mean", "max", "final", "mesh_order_1", "moon", ""]
            return self.several(lambda: f"{self.choice(self.variables)}:{self.choice(kinds)}", 2)
        if key == "statistic":
            return self.choice(["mean", "mesh_order_", "order 2 of shaft", "tip"]) + self.choice(ODD)
        if key == "figures":
            return [{"statistic": self.choice(["mean", "rms", "time_of_peak", "mesh_order_1", "moon"]), "series": self.randrange(4),
                     "phase": self.randrange(4)}]
        return self.anything()

    def source(self):
        """A scene: mostly an existing one, with changes."""
        source = {"name": self.choice(ODD if self.chance(10) else NAMES), "scenes": str(SCENES), "set": self.several(self.assignment, 3)}
        if self.chance(6):
            table = {"input": "left.load_torque", "time": [0, self.number()], "value": [0, self.number()]}
            source["given"] = {"description": "given", "stop_time": self.number(), "step": self.number(), "outputs": ["left.speed"],
                               "set": {self.choice(self.variables): self.number()}, "table": [table]}
        return source

    def assignment(self):
        """Assignment to a variable, or only a value."""
        name = self.choice(["stop_time", "step"] if self.chance(6) else self.variables)
        text = self.choice(ODD) if self.chance(2) else json.dumps(self.number())
        return text if self.chance(30) else f"{name}={text}"

    def number(self):
        """A number or an absurd text."""
        plain = [0.0, 1.0, -1.0, 0.5, 1e-3, 1e9, 1e-12, 1e300, 3.0, 200.0]
        return self.choice(ODD) if self.chance(8) else self.choice(plain) * self.uniform(0.5, 2.0)

    def anything(self):
        """A value of any type."""
        kind = self.randrange(7)
        plain = [None, self.chance(2), self.number(), self.choice(ODD), [0] * self.randrange(1000)]
        return plain[kind] if kind < 5 else [self.anything()] if kind == 5 else {"name": self.anything()}


def write(file, count, seed):
    """Writes random questions into a file, one on each line."""
    questions = Questions(seed)
    Path(file).write_text("".join(f"{questions.line()}\n" for _ in range(count)), encoding="utf-8")


def ask(count, seed, threads):
    """Asks the questions and prints a table of the replies. Fails if a reply is invalid or reports an internal error."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "questions")
        write(file, count, seed)
        replies = [json.loads(line) for line in printed("lab", "questions", file, threads).split("\n") if line]
        questions = [json.loads(line)[0][:LONGEST] for line in file.read_text(encoding="utf-8").splitlines()]
    counts = Counter(kind or "" for _, kind, *_ in replies)
    print("\n".join(aligned([["reply", "questions"], *([kind, str(number)] for kind, number in sorted(counts.items()))], (0,))))
    for index, _, seconds, _ in sorted(replies, key=lambda reply: -reply[2])[:1]:
        print(f"longest: {seconds:.1f} s, {questions[index]}")
    findings = [f"{questions[index]} was answered by {reply}" for index, kind, _, reply in replies if kind in (None, "internal")]
    if findings:
        raise Finding(f"{len(findings)} findings, the first: {findings[0]}")
