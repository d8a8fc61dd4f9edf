"""The run of a command: its script in a Python environment, with progress; its output; the renewal of documents."""

import json
import os
import re
import subprocess
import tempfile
from contextlib import ExitStack
from pathlib import Path

from .documents import copy_pictures, locked, renew
from .paths import TARGET, WORKSPACE, builder, shown
from .terminal import FINDING, Failure, Finding, Progress, for_terminal

# environments of scripts: of the Python package's commands, and with the packages of the tests. Other environments are described by the
# folder of requirements.txt, the folder in the target directory, and the main packages
USERS, TESTS = ("users",), ("tests",)
PROGRESS = re.compile(r"progress ([\d.]+) (.*)")


class Work:
    """A running command with the values of its options."""

    def __init__(self, options):
        self.options, self.progress, self.results = options, Progress(), None
        self._open = ExitStack()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.progress.finish()
        self._open.close()

    def folder(self, name):
        """Folder of the results in the target directory. It is locked until the command ends."""
        self.results = TARGET / name
        self._open.enter_context(locked(self.results, self.progress.note))
        self.results.mkdir(exist_ok=True)
        return self.results

    def given(self, *names):
        """Words that pass these options on to a script."""
        words = []
        for name in names:
            value = getattr(self.options, name.replace("-", "_"))
            if value is not None and value is not False:
                words += [f"--{name}"] if value is True else [f"--{name}", value]
        return words

    def environment(self, *kind):
        """The interpreter of a Python environment, and the variables of its processes. The environment is created if it does not exist."""
        made = json.loads(builder("environment", *kind))
        variables = {**os.environ, **made["variables"]}
        return made["program"], {name: value for name, value in variables.items() if value is not None}

    def run(self, script, *arguments, environment=USERS, doing="measuring", sections=(), pictures=False):
        """Runs a script of the workspace or a Python module, prints its tables, and renews documents if the option `write` is set.

        `sections`: the document, the name in the markers of the section, and the file of results, or "" for the output. If the name is
        "", the document becomes a copy of the file. A section whose file the run does not write is unchanged.

        An argument may be a function that returns one or a list of them. It is called when Python is ready, so that a missing
        installation is reported immediately."""
        python, variables = self.environment(*environment)
        given = []
        for argument in arguments:
            value = argument() if callable(argument) else argument
            given += value if isinstance(value, list) else [value]
        # so that every file in the folder after the run is from this run
        for file in [*(self.results / name for _, _, name in sections if name), *(self.results.glob("*.png") if pictures else ())]:
            file.unlink(missing_ok=True)
        self.progress.stage(doing)
        words = [WORKSPACE / script] if script.endswith(".py") else ["-m", script]
        text = self.follow([python, *words, *given], Path(script).name, env=variables)
        self.progress.finish()
        print(for_terminal(text), end="")
        if self.results:
            print(f"\nresults: {shown(self.results)}")
        if getattr(self.options, "write", False):
            self.renew(text, sections, pictures)

    def follow(self, command, name, **settings):
        """Output of a program. Lines "progress FRACTION WHAT" on its standard error move the bar. If it fails, the error consists of the
        other lines."""
        remarks = []
        with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
            process = subprocess.Popen(list(map(str, command)), stdout=output, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                       encoding="utf-8", **settings)
            for line in process.stderr:
                moved = PROGRESS.match(line)
                if moved:
                    self.progress.advance(float(moved[1]), moved[2])
                else:
                    remarks.append(line)
            status = process.wait()
            output.seek(0)
            text = output.read()
        why = "".join(remarks).rstrip()
        if status == FINDING:
            raise Finding(f"{name} has a finding: {why}")
        if status:
            raise Failure(f"{name} failed: {why}")
        return text

    def renew(self, text, sections, pictures=False):
        """Writes the output, or files of results, into sections of documents."""
        renewed = []
        for document, name, file in sections:
            if not file or (self.results / file).is_file():
                renew(document, name, (self.results / file).read_text(encoding="utf-8") if file else text)
                renewed.append(document)
        if pictures:
            copy_pictures(self.results)
            renewed.append("docs/figures")
        print(f"renewed: {', '.join(dict.fromkeys(renewed))}")
