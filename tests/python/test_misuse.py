"""Mistakes that would give wrong results silently, or a traceback: each is one error with a remedy."""

import subprocess
import sys
from pathlib import Path

import pytest
from bevel_differential import Differential, DifferentialError, Fmu, Scene
from bevel_differential.designs import Space, Task
from bevel_differential.designs.plan import Plan
from bevel_differential.designs.sweep import sweep
from bevel_differential.tolerance.plan import Plan as Tolerances
from bevel_differential.want import Condition
from refusals import refused

SPIN, TORQUE = "spin.command", "left.load_torque"
WIDE = """description = "a backlash below 0"
scene = "study_turning"
wants = ["left.speed:mean"]
runs = 8
[factors]
geometry.backlash = "0.02 mm +- 0.2 mm"
"""


@pytest.fixture
def driven(fmu_file):
    """Scene whose left load follows a table."""
    table = (TORQUE, [0.0, 0.01], [0.0, 1.0], None)
    with Scene(stop=0.01, outputs=[TORQUE, "left.speed"], tables=[table], fmu=fmu_file) as scene:
        yield scene


@pytest.mark.parametrize("text", ["1..200 deg/s", "1 deg/s..200", "1, 2 deg/s", "uniform(1, 2 deg/s)", "normal(4, 0.1 deg/s)"])
def test_a_unit_of_only_some_numbers_is_an_error(fmu, text):
    with refused("write it at each number"):
        Space.parse(fmu, {SPIN: text})


@pytest.mark.parametrize("text", ["0..10 deg/s", "1 deg/s..2 rpm", "1..2", "0, 5 deg/s", "normal(0, 1 deg/s)"])
def test_zero_needs_no_unit_and_units_may_differ(fmu, text):
    assert Space.parse(fmu, {SPIN: text}).names == [SPIN]


def test_a_value_for_an_input_that_follows_a_table_is_an_error(driven):
    two = {TORQUE: 2.0}
    for use in (lambda: driven.set(two), lambda: driven.set(left__load_torque=2.0), lambda: driven.run(values=two),
                lambda: driven.final(values=two),
                lambda: sweep(driven, {TORQUE: "1, 2"}, "grid", wants=["left.speed"], workers=0)):
        with pytest.raises(DifferentialError, match=f"{TORQUE} follows a table"):
            use()


def test_figures_need_two_points(driven):
    Task(driven, ["left.speed:peak_to_peak"], start=0.008)
    Task(driven, ["left.speed"], start=0.0099)
    for start in (0.0085, 0.009, 0.0099):
        with refused("less than two steps"):
            Task(driven, ["left.speed:peak_to_peak"], start=start)


def test_the_limit_of_a_time_is_a_time(fmu):
    assert Condition.parse(fmu, "left.speed:time_of_peak > 20 ms").limit == 0.02
    with refused("units that do: s, ms, us, min, h"):
        Condition.parse(fmu, "left.speed:time_of_peak > 20 deg/s")


def test_a_grid_never_repeats_a_whole_number_and_stays_small(fmu):
    teeth = Plan.parse(Space.parse(fmu, {"geometry.planet_teeth": "10..20:4"}), "grid").designs()
    assert [values["geometry.planet_teeth"] for _, values in teeth] == [10, 13, 17, 20]
    with refused("leave the count 4 out"):
        Plan.parse(Space.parse(fmu, {"geometry.planet_teeth": "10..20:4"}), "lhs", 4)
    with refused("only 3 whole numbers"):
        Space.parse(fmu, {"geometry.planet_teeth": "18..20:9"})
    for vary in ({SPIN: "0..1:1000000000000000"}, {"tooth_errors.seed": "0..2000000000"}):
        with refused("are more than"):
            Plan.parse(Space.parse(fmu, vary), "grid")


@pytest.mark.parametrize("value", [3_000_000_000, -2**31 - 1, 1e300])
def test_whole_numbers_beyond_those_of_fmi_are_an_error(fmu, value):
    with refused("must be a whole number from -2147483648 to 2147483647"):
        fmu.variable("tooth_errors.seed").number(value)


@pytest.mark.parametrize("content", [b"", b"no archive"])
def test_a_file_that_is_not_an_fmu_is_reported(tmp_path, content):
    (tmp_path / "my.fmu").write_bytes(content)
    with refused("not an FMU"):
        Fmu.of(tmp_path / "my.fmu")


SCENE = """description = "short"
stop_time = 0.01
step = 0.001
outputs = ["left.speed"]
"""


@pytest.mark.parametrize("old, new, said", [
    ('["left.speed"]', '"left.speed"', r"(?s)line 4.*expected a sequence"), ('["left.speed"]', "[3]", r"(?s)line 4.*integer `3`, expected a string"),
    ('"short"', "5", r"(?s)line 1.*integer `5`, expected a string"), ("step", "set = 3\nstep", r"(?s)line 3.*integer `3`, expected a map"),
    ('["left.speed"]', '["left.speed"]\n[at]\ntime = 0.005', r"(?s)line 5.*map, expected a sequence"),
    ('["left.speed"]', '["left.speed"]\n[[table]]\ninput = "left.load_torque"\ntime = 5', r"(?s)line 7.*integer `5`, expected a sequence")])
def test_wrong_kinds_in_a_scene_file_are_reported(tmp_path, fmu, old, new, said):
    (tmp_path / "short.toml").write_text(SCENE.replace(old, new, 1))
    with pytest.raises(DifferentialError, match=said):
        Scene.load(tmp_path / "short.toml", fmu)


def test_a_draw_outside_the_range_is_an_error_of_the_tolerances(tmp_path):
    (tmp_path / "wide.toml").write_text(WIDE)
    with refused("geometry.backlash: … of … draws are outside 0 mm to"):
        Tolerances.load(tmp_path / "wide.toml")


def test_a_closed_instance_reports_that_and_not_an_old_warning(fmu):
    with fmu.open() as instance:
        # a face wider than usual gives a warning
        instance.set({"geometry.face_width": "25 mm"})
        instance.initialise()
        assert instance.messages
    for use in (lambda: instance.get("left.speed"), lambda: instance.step(1e-3), instance.initialise, instance.reset, instance.save):
        with refused("the instance is closed"):
            use()


def test_outputs_are_a_list_without_repetition(fmu_file):
    with Differential(fmu=fmu_file) as straight:
        with refused("names are a list"):
            straight.run(outputs="left.speed", stop=0.01)
        with refused("left.speed: it is recorded twice"):
            straight.run(outputs=["left.speed", "right.speed", "left.speed"], stop=0.01)
        with pytest.raises(DifferentialError, match="more than 1e[+]08 steps"):
            straight.run(stop=1e9, step=1e-9)


def test_an_extracted_fmu_is_removed_at_exit(fmu_file):
    script = f"from bevel_differential import Fmu; print(Fmu({fmu_file!r}).folder); print(Fmu.of({fmu_file!r}).folder)"
    folders = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert len(set(folders)) == 2 and not any(Path(folder).exists() for folder in folders)
