"""Compares the packaged FMUs in other hosts with fmpy: each host runs each scene in a separate process. Prints the table. Hosts step the
scene in co-simulation, or evaluate derivatives and their Jacobian at points of the scene in model exchange.

usage: hosts.py FMU PLAIN_FMU FOLDER [--require] [--with-fmi-sim]

PLAIN_FMU is the FMU with Integers, for hosts that cannot set Enumerations. The FMU of FMI 3.0 is next to FMU: hosts that read it are
compared with fmpy and FMI 2.0. Fails if results differ, or with --require if a host cannot be loaded."""

import csv
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from bevel_differential.text import markdown
from fmpy import read_model_description
from tools import WORKSPACE, Finding, say

HOSTS = WORKSPACE / "tests" / "hosts"
# maximum deviation between two hosts
MOST = 1e-9
# exit status of a script whose host cannot be loaded, as in common.py
CANNOT_LOAD = 3
# crate fmi-sim, which is a separate program
FMI_SIM, FMI_SIM_VERSION = "fmi-sim", "0.7.0"
PACKAGES = "pip install -r tests/hosts/requirements.txt"


@dataclass(frozen=True)
class Host:
    """A host.

    `call`: script of tests/hosts with its arguments; `loader`: software that imports the FMU; `sets`: variables that it sets before
    initialisation; `hint`: advice if it cannot be loaded; `steps`: False if it evaluates derivatives; `three`: True if the host reads
    the FMU of FMI 3.0; `unset`: types and causalities that it does not set there."""

    name: str
    call: tuple[str, ...]
    loader: str
    sets: str
    hint: str = PACKAGES
    enumerations: bool = True
    reads_start: bool = True
    steps: bool = True
    three: bool = False
    unset: tuple[str, ...] = ()


# hosts that evaluate derivatives are compared with this one
DERIVATIVES = Host("fmpy, derivatives", ("derivatives.py",), "its own, ctypes", "all types", steps=False)
# all others are compared with the first one
ALL = [
    Host("fmpy", ("with_fmpy.py",), "its own, ctypes", "all types", three=True),
    Host("libcosim", ("with_libcosim.py",), "FMI Library", "no Enumerations",
         enumerations=False, reads_start=False),
    Host("ecos", ("with_ecos.py",), "fmi4c", "no Enumerations",
         "apt install libtbb12", enumerations=False, three=True, unset=("Enumeration", "structuralParameter")),
    Host("ecos, process", ("with_ecos.py", "--process"), "fmi4c, proxyfmu", "no Enumerations",
         "apt install libtbb12", enumerations=False, three=True,
         unset=("Enumeration", "structuralParameter")),
    Host("fmucontainer", ("with_fmu_container.py",), "its own, an FMU around it",
         "choices as Integers", three=True, unset=("structuralParameter",)),
    Host("casadi", ("with_casadi.py",), "its own, derivatives", "all types", steps=False),
    Host(FMI_SIM, ("with_fmi_sim.py",), "fmi", "by --init-values, choices as numbers",
         "cargo must reach crates.io, and libclang is needed"),
]


@dataclass(frozen=True)
class Scene:
    """A scene of tests/hosts/scenes with the content of its file."""

    name: str
    path: Path
    known: dict


class Absent(Exception):
    """A host that cannot be loaded here."""


@dataclass(frozen=True)
class Deviation:
    """Largest deviation over all outputs and communication points.

    `largest`: relative to the value, or to the output's natural scale if that is larger; `place`: its output and point; `different`:
    number of values with different bits, out of `compared` values."""

    largest: float
    place: str
    different: int
    compared: int


def read(file):
    """Outputs by communication point, from the file of a host's script."""
    with open(file, encoding="utf-8") as lines:
        return {int(row.pop("point")): {name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)}


def deviation(own, other, without_start, scales):
    """Deviation of `other` from `own`. Both must have the same outputs at the same points, except for the start if `without_start`."""
    points = [point for point in own if point > 0 or not without_start]
    if points != [point for point in other if point > 0 or not without_start]:
        raise SystemExit(f"{len(other)} communication points were recorded in place of {len(points)}")
    found, different = (0.0, ""), 0
    for point in points:
        if own[point].keys() != other[point].keys():
            raise SystemExit(f"other outputs were recorded: {', '.join(other[point])}")
        for name, value in own[point].items():
            if name not in scales:
                raise SystemExit(f"the scene states no natural scale of {name}")
            apart = abs(other[point][name] - value) / max(abs(value), scales[name])
            if apart != apart:
                raise SystemExit(f"{name} at point {point} is {other[point][name]} in place of {value}")
            # hexadecimal, because 0 and −0 are equal but have different bits
            different += other[point][name].hex() != value.hex()
            found = max(found, (apart, f"{name} at point {point}"), key=lambda pair: pair[0])
    return Deviation(*found, different, sum(len(own[point]) for point in points))


def largest(record):
    """Natural scales of derivatives, which no scene states: the largest value of each, or 1 if all are 0."""
    return {name: max(abs(values[name]) for values in record.values()) or 1.0 for name in record[0]}


class Bench:
    """Requirements of hosts: FMUs, a folder, and fmi-sim."""

    def __init__(self, fmu, plain, folder, with_fmi_sim):
        self.fmu, self.plain, self.folder, self.with_fmi_sim = fmu, plain, folder, with_fmi_sim
        self.three = fmu.with_name(f"{fmu.stem}3.fmu")
        self.needs = {each.name: {each.type, each.causality} for each in read_model_description(str(self.three)).modelVariables}
        self.fmi_sim = "left out without --with-fmi-sim, because its build takes minutes"
        if with_fmi_sim:
            say(0.0, "building fmi-sim (many minutes)")
            root = folder / FMI_SIM
            done = subprocess.run([os.environ.get("CARGO", "cargo"), "install", FMI_SIM, "--version", FMI_SIM_VERSION, "--root", root,
                                   "--locked", "--quiet"], capture_output=True, text=True)
            self.fmi_sim = f"it does not build: {last_line(done.stderr)}" if done.returncode else root / "bin" / FMI_SIM

    def leaves_out(self, host):
        """True if the host was left out because it was not requested."""
        return not self.with_fmi_sim and host.name == FMI_SIM

    def can_by_three(self, host, scene):
        """True if a host can run a scene with the FMU of FMI 3.0: it reads the FMU and sets all variables of the scene."""
        needed = {need for part in ("parameters", "inputs") for name in scene.known[part] for need in self.needs[name]}
        return host.three and needed.isdisjoint(host.unset)

    def run(self, host, scene, three=False):
        """Runs a host on a scene, with FMI 3.0 if `three`. Returns its record and its version. Raises `Absent`."""
        out = self.folder / f"{scene.name}_{host.name.replace(', ', '_')}{'_3' if three else ''}.csv"
        program, *arguments = host.call
        environment = dict(os.environ)
        if host.name == FMI_SIM:
            if isinstance(self.fmi_sim, str):
                raise Absent(self.fmi_sim)
            environment["FMI_SIM"] = str(self.fmi_sim)
        fmu = self.three if three else self.fmu if host.enumerations else self.plain
        # some hosts write logs into the current folder
        ended = subprocess.run([sys.executable, HOSTS / program, fmu, scene.path, out, *arguments], cwd=self.folder, env=environment, capture_output=True,
                               text=True)
        if ended.returncode == CANNOT_LOAD:
            raise Absent(f"{last_line(ended.stderr)} ({host.hint})")
        if ended.returncode:
            raise SystemExit(f"{host.name} fails on {scene.name} ({ended.returncode}):\n{ended.stderr.rstrip()}")
        report = json.loads(last_line(ended.stdout))
        return read(out), report["version"]


def last_line(text):
    return (text.rstrip().splitlines() or [""])[-1]


def compared(bench, scenes):
    """Returns by host its version and its deviations by scene, for FMI 2.0 and FMI 3.0, and the reasons why other hosts are absent."""
    results, absent, own, derivatives = {}, {}, [], {}
    for done, host in enumerate(ALL):
        say(done / len(ALL), host.name)
        ran = {}, {}
        try:
            for place, scene in enumerate(scenes):
                for three in (False, True):
                    if three and not bench.can_by_three(host, scene):
                        continue
                    record, version = bench.run(host, scene, three)
                    if host is ALL[0] and not three:
                        own.append(record)
                    if not host.steps and scene.name not in derivatives:
                        derivatives[scene.name] = bench.run(DERIVATIVES, scene)[0]
                    expected = own[place] if host.steps else derivatives[scene.name]
                    scales = scene.known["outputs"] if host.steps else largest(expected)
                    try:
                        ran[three][scene.name] = deviation(expected, record, not host.reads_start, scales)
                    except SystemExit as wrong:
                        raise SystemExit(f"{host.name} on {scene.name}: {wrong}") from None
        except Absent as why:
            if host is ALL[0]:
                raise SystemExit(f"{host.name}, which the others are compared with, cannot be loaded: {why}") from None
            absent[host] = why
            continue
        results[host] = (version, ran)
    return results, absent


def page(results, absent, scenes):
    """Text for docs/inside/hosts.md."""
    rows = [["host", "import", "sets before the start", "FMI 2.0", "FMI 3.0"]]
    for host, (version, ran) in results.items():
        rows.append([f"{host.name} {version}", host.loader, host.sets, *(cell(found, scenes) for found in ran)])
    every = [one for _, ran in results.values() for found in ran for one in found.values()]
    text = markdown(rows, range(5)) + "\n" + "".join(f"- `{scene.name}`: {scene.known['description']}.\n" for scene in scenes)
    text += (f"\nDeviations are the largest from {ALL[0].name} by FMI 2.0, relative to the value or, if larger, to the output's "
             f"natural scale. {sum(one.compared for one in every)} values were compared, {sum(one.different for one in every)} have "
             "other bits.\n")
    return text + "".join(f"\n{host.name}: not run: {why}\n" for host, why in absent.items())


def cell(found, scenes):
    """Deviations of a host with one version of FMI, as text."""
    if not found:
        return "–"
    differ = [f"{scene}: {one.largest:.1e}".replace("e-0", "e-") for scene, one in found.items() if one.different]
    if not differ:
        return "same bits" if len(found) == len(scenes) else f"same bits, {len(found)} scenes"
    return "; ".join(differ)


def main():
    fmu, plain, folder = (Path(text).resolve() for text in sys.argv[1:4])
    bench = Bench(fmu, plain, folder, "--with-fmi-sim" in sys.argv)
    files = sorted((HOSTS / "scenes").glob("*.json"))
    scenes = [Scene(file.stem, file, json.loads(file.read_text(encoding="utf-8"))) for file in files]
    results, absent = compared(bench, scenes)
    text = page(results, absent, scenes)
    wrong = [f"{host.name} on {scene}: {one.largest:.1e}, {one.place}" for host, (_, ran) in results.items()
             for found in ran for scene, one in found.items() if one.largest > MOST]
    if wrong:
        raise Finding(f"{text}\nhosts differ by more than {MOST:g}:\n" + "\n".join(wrong))
    missing = [host.name for host in absent if not bench.leaves_out(host)]
    if "--require" in sys.argv and missing:
        raise SystemExit(f"{text}\nnot run here, though required: {'; '.join(missing)}")
    print(text, end="")


if __name__ == "__main__":
    main()
