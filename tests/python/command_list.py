"""List of all commands for tests: quick examples by exit status, the files that they write, and the warnings that they print.

Lines are those of a folder with `FILES`, and with the units good.fmu and bad.fmu (see conftest.py)."""

import argparse
import importlib
from dataclasses import dataclass, field
from pathlib import Path

from bevel_differential.command import COMMANDS, PACKAGE

# start and run take a few milliseconds: a given stiffness saves nine tenths of the start, and does not change mass and stress
SCENE = """description = "one spring per mesh, loaded"
stop_time = 0.001
step = 0.001
outputs = ["safety.root_min"]
[set]
scene.gear_contact = "lumped"
scene.planet_spin = "imposed"
spin.command = "200 deg/s"
effects.strength = true
contact.mesh_stiffness_from_geometry = false
left.load_torque = "835 N.m"
right.load_torque = "835 N.m"
"""
CLUTCH = """description = "gears without teeth, a clutch"
stop_time = "10 ms"
step = "1 ms"
outputs = ["left.speed"]
[set]
scene.gear_contact = "ideal"
effects.limited_slip = true
limited_slip.preload = "60 N.m"
carrier.torque_command = "800 N.m"
carrier.speed_command = "40 rad/s"
"""
# gears that differ from the study's but have its stiffness, with an unusual width, and a value that changes nothing
WARNED = """description = "a turn"
stop_time = 0.02
step = 1e-3
outputs = ["left.speed", "efficiency"]
[set]
carrier.speed_command = 50.0
left.load_torque = 400.0
right.load_torque = 400.0
scene.planet_spin = "imposed"
spin.command = 20.0
geometry.module = "4.3 mm"
geometry.face_width = "21 mm"
left.brake_torque = 200.0
"""
PROBLEM = """description = "light or strong"
scene = "{scene}"
objectives = ["minimise gears.mass", "maximise safety.root_min"]
conditions = ["envelope.diameter <= {diameter} mm"]
population = 4
generations = 1
[set]
effects.strength = true
[vary]
geometry.module = "3.5 mm..6 mm"
geometry.face_width = "6 mm..{width} mm"
"""
TOLERANCES = """description = "one tolerance"
scene = "study_turning"
runs = 8
wants = ["left.speed:mean"]
[factors]
left.load_torque = "{band}"
"""
CYCLE = """name,count,duration [s],speed [km/h],torque [N.m],wheel_radius [m],turn_radius [m],track [m]
turn,{count},10,50,{torque},0.3,20,1.5
"""
FILES = {"scene.toml": SCENE, "clutch.toml": CLUTCH, "warned.toml": WARNED, "light.toml": PROBLEM.format(scene="scene.toml", diameter=95, width=12),
         "tiny.toml": PROBLEM.format(scene="scene.toml", diameter=5, width=12),
         "warning.toml": PROBLEM.format(scene="warned.toml", diameter=200, width=30),
         "narrow.toml": TOLERANCES.format(band="800 N.m +- 10 N.m"), "wide.toml": TOLERANCES.format(band="1e7 N.m +- 9.9e6 N.m"),
         "light.csv": CYCLE.format(count=1, torque=500), "heavy.csv": CYCLE.format(count=1000000, torque=3000), "there.toml": ""}
# a load that pushes teeth past each other in the first step
TOO_MUCH = "--set left.load_torque=1e7"
# parts of warnings: unusual gears, a value that changes nothing, gears that have the stiffness of the study's
WIDE, UNFELT = "geometry.face_width: ", "left.brake_torque: 200 N.m changes nothing in this scene. "
STIFFNESS = "contact.law: impact has the stiffness of the study's gears"


@dataclass(frozen=True)
class Files:
    """Options that write files. `old`: one of them that exists before; `room`: free bytes of a disk on which the command fails; `new`:
    files that it may have completed by then."""

    options: str
    old: str | None = "a.csv"
    room: int = 0
    new: tuple[str, ...] = ()


@dataclass(frozen=True)
class Example:
    """Quick lines of a command, without its name: `done` succeeds, `wrong` is wrong use, `failed` fails (where this is not only the
    writing of files), `finding` ends with a finding. `files`: what it writes; `table`: option for a table in CSV; `warned`: a line that
    succeeds with the `warnings`; `quick`: options of a quick answer."""

    done: str
    wrong: str
    failed: str | None = None
    finding: str | None = None
    files: list[Files] = field(default_factory=list)
    table: str | None = None
    warned: str | None = None
    warnings: tuple[str, ...] = (WIDE, UNFELT, STIFFNESS)
    quick: str = "--quick"


_ACCURACY = "--stop 5ms --want left.speed:mean --within 30%"
_SWEEP = "--plan grid --workers 0 --scene"
_OPTIMISE = "--workers 0 --out"
_TOLERANCE = "--stop 2ms --workers 0 --no-indices"
_LOSSES = "--speed 20,40 --difference 1,5 --temperature 350 --unseen 2 --workers 0"
_COUPLING = "one_wheel_on_ice --set scene.gear_contact=ideal --host"
_SPRING = "left:k=9000,c=12,J=1"
EXAMPLES = {
    "run": Example("scene.toml", "study_turnin", f"study_turning {TOO_MUCH}", table="--csv", warned="warned.toml --csv a.csv --plot a.png", files=[
        Files("--csv a.csv --plot a.png"), Files("--csv a.parquet", "a.parquet"), Files("--csv a.csv --plot a.svg", "a.svg", 8192, ("a.csv",))]),
    "plan": Example("study_turning", "study_turning --set geometry.module=0", warned="warned.toml",
                    files=[Files("--ssv a.ssv --python a.py", "a.ssv")]),
    "accuracy": Example(f"study_turning {_ACCURACY}", "study_turning --within soon", f"study_turning {_ACCURACY} {TOO_MUCH}",
                        f"study_turning {_ACCURACY}", [Files("--csv a.csv --plot a.png --write a.toml --ssv a.ssv --python a.py")],
                        warned=f"warned.toml {_ACCURACY} --set scene.gear_contact=lumped", warnings=(WIDE, UNFELT)),
    "report": Example("study_turning --quick --stop 5ms", "study_turning --stop soon", f"study_turning --quick {TOO_MUCH}",
                      files=[Files("--out a.html", "a.html", 100_000)], warned="warned.toml --quick"),
    "loads": Example("study_turning --stop 100ms --out a.csv", "study_turning --every 2s --out a.csv", f"study_turning {TOO_MUCH} --out a.csv",
                     files=[Files("", room=20_000)], table="--stop 1ms --out", warned="warned.toml --out a.csv"),
    "geometry": Example("", "--set geometry.module=0", finding="--set geometry.addendum_system=standard",
                        files=[Files("--dxf --out out", "out/dimensions.json", 150_000)], warned="--set geometry.face_width='22 mm'",
                        warnings=(WIDE,)),
    "pattern": Example("study_turning --quick", "study_turning --set scene.gear_contact=lumped", f"study_turning {TOO_MUCH}",
                       files=[Files("--out out", "out/summary.csv", 100_000)], warned="warned.toml"),
    "sweep": Example(f"{_SWEEP} scene.toml --want left.speed --vary left.load_torque=700,800.5", f"{_SWEEP} scene.toml --vary left.load_torque=7,8oo",
                     finding=f"{_SWEEP} study_turning --want left.speed --vary left.load_torque=700,1e7 --stop 2ms", table="--csv",
                     warned=f"{_SWEEP} warned.toml --want efficiency --vary left.load_torque=300,400",
                     files=[Files("--csv a.csv"), Files("--out a.parquet --force", "a.parquet")]),
    "optimise": Example(f"light.toml {_OPTIMISE} out", f"none.toml {_OPTIMISE} out", finding=f"tiny.toml {_OPTIMISE} out",
                        files=[Files("", "out/front.png", 60_000, ("out/problem.json", "out/evaluations.parquet", "out/front.csv"))],
                        warned=f"warning.toml {_OPTIMISE} out --quick --starts 1", warnings=(STIFFNESS,),
                        quick="--quick --population 4 --generations 1 --starts 1"),
    "tolerance": Example(f"narrow.toml {_TOLERANCE}", "narrow.toml --runs 9", finding=f"wide.toml {_TOLERANCE}",
                         files=[Files("--csv a.csv --plot a.png")], table="--csv"),
    "spectrum": Example("light.csv", "none.csv", finding="heavy.csv", files=[Files("--csv a.csv --plot a.pdf", "a.pdf", 4096, ("a.csv",))],
                        table="--csv", warned="light.csv --set geometry.module='4.3 mm' --set geometry.face_width='21 mm'",
                        warnings=(WIDE, STIFFNESS)),
    "losses": Example(f"clutch.toml --torque 400,800 {_LOSSES}", f"torque_bias {_LOSSES} --set geometry.module=0",
                      finding=f"torque_bias --torque 100,200 {_LOSSES} --bound 1e-4,1e-4 --most 4", table="--csv",
                      files=[Files("--csv a.csv --simulink a.m --plot a.png --report a.html")], warnings=(WIDE,),
                      warned=f"warned.toml --torque 100,200 {_LOSSES} --bound 100,1000 --set scene.gear_contact=lumped"),
    "bench": Example("winter_start --workers 0", "winter_start --set geometry.module=0",
                     files=[Files("--out out", "out/winter_start.toml", 150_000)]),
    "coupling": Example(f"{_COUPLING} {_SPRING}", f"{_COUPLING} left:k=9000,c=soon", finding=f"{_COUPLING} left:k=9000,c=0,J=1,reads=both",
                        files=[Files("--plot a.png", "a.png", 8192)], warned=f"warned.toml --host {_SPRING}"),
    "study": Example("--quick", "--quick --fmu none.fmu", files=[Files("--out out", "out/table.md", 190_000)]),
    "verify": Example("good.fmu", "none.fmu", finding="bad.fmu", files=[Files("--csv a.csv")]),
    "examples": Example("", "--out there", files=[Files("--out .", None, 12_288)]),
    "variables": Example("drag", "--acting study_turnin", files=[Files("--csv a.csv")], table="--csv"),
    "page": Example("", "--paht", ""),
}


def line(name, kind="done"):
    """Line of a command, such as its `done` one."""
    return f"{name} {getattr(EXAMPLES[name], kind)}"


def options(name):
    """Options of a command: pairs of a name and the name of its value."""
    parser = argparse.ArgumentParser()
    importlib.import_module(COMMANDS[name][0], PACKAGE).add_arguments(parser)
    return [(action.option_strings[0], action.metavar or "") for action in parser._actions if action.option_strings]


def having(option):
    """Commands that have an option."""
    return [name for name in COMMANDS if option in dict(options(name))]


def prepare(folder):
    """Writes the files of the lines into a folder."""
    for name, text in FILES.items():
        Path(folder, name).write_text(text, encoding="utf-8")
