"""Names of variables form a tree, which tools need for buses or records; former names still find their variables."""

import math
import re
import subprocess
import sys
import warnings

import numpy as np
import pytest
from bevel_differential import Differential, DifferentialError, DifferentialWarning, Scene, accuracy
from bevel_differential.optimise.problem import Problem
from bevel_differential.spectrum import spectrum
from bevel_differential.designs.sweep import sweep
from bevel_differential.want import Want
from fmpy import read_model_description

# former and present names
FORMER = {"planet.spin_command": "spin.command", "planet.spin_torque": "spin.torque",
          **{f"planet[1].left_pair[{k}].{part}": f"mesh.pair[{k}].{part}" for k in (1, 2, 3)
             for part in ("tooth", "force", "height", "toe_pressure", "middle_pressure", "heel_pressure")}}
SPIN = {"scene.planet_spin": "imposed", "scene.gear_contact": "ideal"}


class Node:
    """Node of the tree: kinds by its uses, members and elements."""

    def __init__(self):
        self.kinds, self.below = set(), {}

    def add(self, parts):
        """Adds the rest of a name: [("", "left"), ("[", "1"), ...]."""
        if not parts:
            self.kinds.add("leaf")
            return
        (kind, word), *rest = parts
        self.kinds.add("array" if kind == "[" else "record")
        self.below.setdefault(word, Node()).add(rest)

    def shape(self):
        """All variables below this node."""
        return frozenset((word, node.shape()) for word, node in self.below.items())

    def faults(self, name):
        """Yields faults that a tree of records and arrays cannot have."""
        if len(self.kinds) > 1:
            yield f"{name} is {' and '.join(sorted(self.kinds))}"
        if "array" in self.kinds and len({node.shape() for node in self.below.values()}) > 1:
            yield f"elements of {name} differ"
        for word, node in self.below.items():
            yield from node.faults(f"{name}.{word}")


def faults(names):
    """Faults of the tree of all names; derivatives have a separate tree."""
    trees = {"": Node(), "der": Node()}
    for name in names:
        inner = re.fullmatch(r"der\((.*)\)", name)
        parts = re.findall(r"(^|\.|\[)([^.\[\]]+)\]?", inner[1] if inner else name)
        assert "".join(f"{kind}{word}{']' if kind == '[' else ''}" for kind, word in parts) == (inner[1] if inner else name)
        trees["der" if inner else ""].add(parts)
    return [fault for name, tree in trees.items() for fault in tree.faults(name)]


def test_the_tree_of_names_finds_conflicts():
    for names, fault in [(["a.b", "a[1]"], ".a is array and record"), (["a", "a.b"], ".a is leaf and record"),
                         (["a", "a[1]"], ".a is array and leaf"), (["a[1].b", "a[2].c"], "elements of .a differ"),
                         (["a[1].b[1].c", "a[2].b[1].d"], "elements of .a differ")]:
        assert faults(names) == [fault]
    assert faults(["a.b[1].c", "a.b[2].c", "a.d", "der(a.d)", "e"]) == []


@pytest.mark.parametrize("version", [2, 3])
def test_names_make_a_tree_of_records_and_arrays(fmu_file, fmu3, version):
    names = [variable.name for variable in read_model_description(fmu_file if version == 2 else fmu3).modelVariables]
    assert {*FORMER.values()} < {*names} and not {*FORMER} & {*names}
    if version == 3:
        assert {f"mesh.pairs_{part}" for part in ("tooth", "force", "height")} < {*names}
    assert faults(names) == []


def told(caught):
    """Warnings about former names."""
    return {str(warning.message) for warning in caught
            if issubclass(warning.category, DifferentialWarning) and "is now named" in str(warning.message)}


def says(once):
    return f"{once} is now named {FORMER[once]}; write the new name"


def test_all_former_names_find_their_variables(fmu):
    for once, now in FORMER.items():
        with pytest.warns(DifferentialWarning, match=re.escape(says(once))):
            assert fmu.variable(once) is fmu.variable(now)
    for name in ("planet.spin", "planet[1].left_pair[4].force", "planet[1].left_pair", "planet.spin_speed"):
        with pytest.raises(DifferentialError, match="there is no such variable"):
            fmu.variable(name)


def test_a_unit_that_is_shown_hides_no_former_name(fmu):
    with pytest.warns(DifferentialWarning, match="spin.command"):
        assert fmu.displaying(["rpm"]).variable("planet.spin_command").shown(math.tau / 60.0) == ("rpm", pytest.approx(1.0))


def test_a_differential_takes_former_names_and_its_records_answer_to_both(fmu_file):
    with Differential({**SPIN, "planet.spin_command": "200 deg/s"}, fmu=fmu_file) as old, \
            Differential({**SPIN, "spin.command": "200 deg/s"}, fmu=fmu_file) as new:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            table = {"planet.spin_command": ([0.0, 0.01], [1.0, 2.0])}
            found = old.run(table, ["planet.spin_torque", "left.speed"], stop=0.01)
            last = old.final(["planet.spin_torque"], values={"planet.spin_command": 2.0}, stop=0.01)
        wanted = new.run({"spin.command": ([0.0, 0.01], [1.0, 2.0])}, ["spin.torque", "left.speed"], stop=0.01)
        assert told(caught) == {says("planet.spin_command"), says("planet.spin_torque")}
        assert found.dtype.names == wanted.dtype.names == ("time", "spin.torque", "left.speed")
        for name in wanted.dtype.names:
            np.testing.assert_array_equal(found[name], wanted[name])
        np.testing.assert_array_equal(found["planet.spin_torque"], wanted["spin.torque"])
        assert last == {"planet.spin_torque": new.final(["spin.torque"], values={"spin.command": 2.0}, stop=0.01)["spin.torque"]}
        with pytest.raises(DifferentialError, match="spin.command: it is given twice"):
            old.run(values={"spin.command": 1.0, "planet.spin_command": 2.0})
        with pytest.raises(DifferentialError, match="spin.command: it is given twice"):
            old.run({"spin.command": 1.0, "planet.spin_command": 2.0})


SCENE = """description = "old names"
stop_time = 0.01
step = 0.005
outputs = ["planet.spin_torque", "planet[1].left_pair[1].force"]
[set]
scene.planet_spin = "imposed"
scene.gear_contact = "ideal"
"planet.spin_command" = 1.0
[[at]]
time = 0.005
planet.spin_command = 2.0
"""
TABLE = SCENE.partition('"planet.spin_command"')[0] + """[[table]]
input = "planet.spin_command"
time = [0.0, 0.01]
value = [1.0, 2.0]
"""
FILE = SCENE.partition('"planet.spin_command"')[0] + """[[inputs]]
file = "inputs.csv"
"""


@pytest.fixture
def scene_file(tmp_path):
    """scene_file(text): scene file with former names and its CSV file, and a second pair of files with present names."""
    def made(text, folder="old"):
        place = tmp_path / folder
        place.mkdir(exist_ok=True)
        (place / "scene.toml").write_text(text)
        (place / "inputs.csv").write_text(renamed("time [s],planet.spin_command [rad/s]\n0,1\n0.01,2\n", folder))
        return place / "scene.toml"

    def renamed(text, folder):
        for once, now in FORMER.items() if folder == "new" else ():
            text = text.replace(once, now)
        return text

    return lambda text: [made(renamed(text, folder), folder) for folder in ("old", "new")]


@pytest.mark.parametrize("text", [SCENE, TABLE, FILE], ids=["set", "table", "file"])
def test_scenes_take_former_names(fmu_file, scene_file, text):
    old, new = scene_file(text)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = Scene.load(old, fmu_file).run()
    assert told(caught) == {says(once) for once in ("planet.spin_torque", "planet[1].left_pair[1].force", "planet.spin_command")}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        wanted = Scene.load(new, fmu_file).run()
    assert not told(caught)
    assert found.dtype.names == wanted.dtype.names
    np.testing.assert_array_equal(found, wanted)


@pytest.mark.parametrize("text, why", [
    (SCENE.replace("[[at]]", "spin.command = 3.0\n[[at]]"), "[set] spin.command is set twice; leave one out"),
    (TABLE + "[[at]]\ntime = 0.005\nspin.command = 1.0\n", "spin.command follows a table, which would override this value"),
    (TABLE + '[[inputs]]\nfile = "inputs.csv"\n', "spin.command has another table in the scene already"),
])
def test_a_variable_by_both_names_is_one_variable(fmu_file, scene_file, text, why):
    with pytest.raises(DifferentialError, match=re.escape(why)):
        Scene.load(scene_file(text)[0], fmu_file)


def test_a_scene_in_python_takes_former_names(fmu_file):
    old = {"set": {**SPIN, "planet.spin_command": 1.0}, "outputs": ["planet.spin_torque"]}
    with Scene("old", stop=0.01, changes=[(0.005, {"planet.spin_command": 2.0})], fmu=fmu_file, **old) as scene:
        assert scene.value("planet.spin_command") == scene.value("spin.command") == 1.0
        assert scene.run().dtype.names == ("time", "spin.torque")
        assert scene.final(values={"planet.spin_command": 3.0}) == scene.final(values={"spin.command": 3.0})
        assert scene.contents()["at"] == [{"time": 0.005, "spin.command": 2.0}]
        assert scene.unfelt_of({"planet.spin_command": 3.0}) == {}
    driven = Scene("old", stop=0.01, tables=[("planet.spin_command", [0.0, 0.01], [1.0, 2.0], None)], fmu=fmu_file,
                   set=SPIN, outputs=["left.speed"])
    for name in ("planet.spin_command", "spin.command"):
        with driven, pytest.raises(DifferentialError, match="spin.command follows a table"):
            driven.set({name: 1.0})


def command(*arguments):
    done = subprocess.run([sys.executable, "-m", "bevel_differential", *map(str, arguments)], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done


SET = ("--set", "scene.planet_spin=imposed", "--set", "scene.gear_contact=ideal", "--set", "planet.spin_command=3 rad/s")


@pytest.mark.parametrize("arguments", [
    ("run", "study_turning", *SET, "--output", "planet.spin_torque", "--stop", "2 ms", "--csv", "out.csv"),
    ("plan", "study_turning", *SET),
    ("plan", "study_turning", *SET, "--ssv", "out.ssv"),
    ("accuracy", "study_turning", *SET, "--set", "stop_time=10ms", "--want", "planet.spin_torque:mean", "--within", "10%"),
    ("sweep", "--scene", "study_turning", *SET[:4], "--vary", "planet.spin_command=1, 2", "--plan", "grid", "--want",
     "planet.spin_torque", "--condition", "planet.spin_torque < 1e9", "--workers", "0"),
    ("loads", "study_turning", "--set", "planet.spin_command=3 rad/s", "--set", "stop_time=2ms", "--out", "out.csv"),
], ids=lambda arguments: " ".join(arguments[:1]))
def test_commands_print_the_new_name_once_to_standard_error(tmp_path, monkeypatch, fmu_file, arguments):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)
    done = command(*arguments)
    for once in ("planet.spin_command", "planet.spin_torque"):
        if any(once in argument for argument in arguments):
            assert done.stderr.count(says(once)) == 1, done.stderr
        assert once not in done.stdout
    if arguments[0] == "run":
        assert "spin.torque" in (tmp_path / "out.csv").read_text()


def test_a_name_that_is_given_by_both_names_is_refused(tmp_path, monkeypatch, fmu_file):
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)
    done = subprocess.run([sys.executable, "-m", "bevel_differential", "plan", "study_turning", *SET, "--set", "spin.command=1"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 or done.returncode == 1
    assert "--set spin.command: it is given twice" in done.stderr


def test_wants_problems_and_sweeps_take_former_names(fmu, tmp_path):
    assert str(Want.parse(fmu, "planet.spin_torque:mean")) == "spin.torque:mean"
    file = tmp_path / "problem.toml"
    file.write_text('description = "x"\nscene = "study_turning"\n'
                    'objectives = ["minimise planet.spin_torque", "minimise planet[1].left_pair[1].force:max"]\n'
                    'conditions = ["planet.spin_torque >= 0"]\n[vary]\nplanet.spin_command = "1..2"\n'
                    '[[compare]]\nname = "a"\nplanet.spin_command = 1.5\n')
    problem = Problem.load(file, fmu)
    assert problem.space.names == ["spin.command"] and problem.compare == {"a": {"spin.command": 1.5}}
    assert [str(want) for want in problem.wants] == ["spin.torque:final", "mesh.pair[1].force:max"]
    with pytest.raises(DifferentialError, match="spin.command: it is given twice"):
        sweep(problem.scene, {"planet.spin_command": "1, 2", "spin.command": "1, 2"}, "grid", wants=["left.speed"])


def test_a_duty_cycle_takes_former_names(fmu_file, tmp_path):
    head = "name,count,duration [s],left.load_torque [N.m],right.load_torque [N.m],carrier.speed_command [rpm]"
    results = []
    for name in ("planet.spin_command", "spin.command"):
        file = tmp_path / "cycle.csv"
        file.write_text(f"{head},{name} [rad/s]\na,10,1,300,300,100,2\n")
        results.append(spectrum(file, {"scene.planet_spin": "imposed"}, fmu=fmu_file).damage)
    assert results[0] == results[1]


def test_a_chosen_scene_is_written_with_the_names_of_its_file(fmu_file, scene_file):
    old, _ = scene_file(SCENE.replace("step = 0.005", "step = 0.0005"))
    found = accuracy(old, "planet.spin_torque:max", "10%", set={"spin.command": 1.5}, file=old.with_name("chosen.toml"))
    again = old.with_name("chosen.toml")
    again.write_text(found.answer["file"])
    assert Scene.load(again, fmu_file).value("spin.command") == 1.5
    assert again.read_text().count("spin_command") == old.read_text().count("spin_command")
