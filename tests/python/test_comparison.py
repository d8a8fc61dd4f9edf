"""Comparison of scenes: common time, figures and differences, differing settings, pictures, files and names."""

import numpy as np
import pytest
from bevel_differential import DifferentialWarning, Scene, compare
from command_line import command
from refusals import refused

# only the drive acts on ideal gears, so speeds follow from momentum
FREE = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "scene.start": "rest", "carrier.speed_command": 0.0,
        "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.left_end": 1.0, "inertia.right_end": 1.0}
TORQUE = "carrier.torque_command"

pytestmark = pytest.mark.usefixtures("folder")


def free(name, torque, **more):
    return Scene(name, **{"stop": 0.5, "step": 0.01, "outputs": ["carrier.speed"], "set": {**FREE, TORQUE: torque}, **more})


def written(file, torque, stop=0.5, outputs='"carrier.speed", "left.speed"', more=""):
    """Writes a scene file of free bodies under a torque."""
    lines = [f"{name} = {str(value).lower() if isinstance(value, bool) else repr(value)}".replace("'", '"') for name, value in FREE.items()]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(f'description = "{torque} N.m"\nstop_time = {stop}\nstep = 0.01\noutputs = [{outputs}]\n[set]\n{TORQUE} = {torque}\n'
                    + "\n".join(lines) + f"\n{more}", encoding="utf-8")
    return str(file)


def row(found, output, figure):
    return next(row for row in found.table() if (row["output"], row["figure"]) == (output, figure))


def test_differences_are_those_of_momentum():
    single, double = free("single", 100.0), free("double", 200.0)
    found = compare(single, double, display_units=["rad/s"])
    record = single.run()
    # from rest under a constant torque, the speed is a straight line through 0, so its mean is half of its end
    for figure, part in (("end", 1.0), ("peak", 1.0), ("mean", 0.5)):
        values = row(found, "carrier.speed", figure)
        assert values["unit"] == "rad/s"
        assert values["single"] == pytest.approx(part * record["carrier.speed"][-1], rel=1e-6)
        assert values["double"] == pytest.approx(2.0 * values["single"], rel=1e-6)
        assert values["double - single"] == pytest.approx(values["single"], rel=1e-6)
        assert values["double - single, %"] == pytest.approx(100.0, rel=1e-6)
    assert found.differing == [("value", "single", "double"), (TORQUE, "100 N·m", "200 N·m")]
    assert "carrier.torque_command  100 N·m  200 N·m" in str(found)


def test_a_negative_peak_is_a_peak_and_nothing_is_a_percentage_of_zero():
    found = compare(free("still", 0.0), free("backward", -100.0), outputs=["carrier.speed", "left.shaft_torque"])
    values = row(found, "carrier.speed", "peak")
    assert values["still"] == 0.0 and values["backward"] < 0.0 and values["backward"] == row(found, "carrier.speed", "end")["backward"]
    assert np.isnan(values["backward - still, %"]) and "–" in str(found)


def test_temperatures_differ_by_kelvins_and_have_no_percentage():
    scenes = [free(name, 100.0, outputs=["temperature.oil"], set={**FREE, TORQUE: 100.0, "oil.temperature": at})
              for name, at in (("cold", "20 degC"), ("warm", "80 degC"))]
    values = row(compare(*scenes), "temperature.oil", "end")
    assert (values["unit"], values["cold"], values["warm"]) == ("degC", pytest.approx(20.0), pytest.approx(80.0))
    assert values["warm - cold"] == pytest.approx(60.0) and np.isnan(values["warm - cold, %"])


def test_the_common_time_counts_and_is_named(tmp_path):
    long, short = written(tmp_path / "long.toml", 100.0, 0.5), written(tmp_path / "short.toml", 100.0, 0.2, '"carrier.speed", "efficiency"')
    printed = command(f"run {long} {short} --csv both.csv").out
    assert "compared from 0 to 0.2 s, the time that all scenes have: long ends at 0.5 s, short ends at 0.2 s" in printed
    assert "left out (--output names others): left.speed, efficiency" in printed
    assert "The scenes set the same values" in printed
    head, *rows = [line.split(",") for line in (tmp_path / "both.csv").read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    assert head == ["scene", "time", "carrier.speed"]
    by_scene = {name: np.array([each[1:] for each in rows if each[0] == name], float) for name in ("long", "short")}
    assert len(rows) == sum(map(len, by_scene.values())) and np.array_equal(by_scene["long"], by_scene["short"])
    with Scene.load(short) as scene:
        record = scene.run(["carrier.speed"])
    assert np.array_equal(by_scene["short"][:, 0], record["time"]) and np.array_equal(by_scene["short"][:, 1], record["carrier.speed"])


def test_scenes_with_the_same_name_are_distinguished_and_warnings_name_them(tmp_path):
    before, after = written(tmp_path / "before" / "axle.toml", 100.0), written(tmp_path / "after" / "axle.toml", 150.0, 0.5,
                                                                               more="tooth_errors.side_runout = 1e-5\n")
    other = written(tmp_path / "other.toml", 120.0)
    said = command(f"run {before} {after} {other} --plot three.svg --unit rpm")
    for name in ("before/axle", "after/axle", "other"):
        assert name in said.out.splitlines()[2]
        assert f"<!-- {name} -->" in (tmp_path / "three.svg").read_text(encoding="utf-8")
    assert "after/axle − before/axle" in said.out and "other − before/axle" in said.out
    runout = [text for text in said.warnings if "tooth_errors.side_runout" in text]
    assert runout and all(text.startswith("warning: after/axle: ") for text in runout) and not said.errors
    assert all(text.startswith(("warning: before/axle: ", "warning: after/axle: ", "warning: other: ")) for text in said.warnings), said.err


def test_scenes_in_python_may_have_one_name():
    found = compare(free("axle", 100.0), free("axle", 150.0))
    assert found.names == ["axle (1)", "axle (2)"]
    with pytest.warns(DifferentialWarning, match=r"^axle \(2\): "):
        compare(free("axle", 100.0), free("axle", 100.0, set={**FREE, TORQUE: 100.0, "tooth_errors.side_runout": 1e-5}))


def test_tables_changes_and_steps_that_differ_are_listed():
    times = [0.0, 0.5]
    first = free("first", 100.0, tables=[("left.load_torque", times, [0.0, 10.0], None)], set={k: v for k, v in FREE.items()
                                                                                             if k != "left.load_torque"})
    second = free("second", 100.0, step=0.005, changes=[(0.1, {"right.load_torque": "5 N.m"})])
    third = free("third", 100.0, tables=[("left.load_torque", times, [0.0, 10.0], 1.0)])
    rows = {name: cells for name, *cells in compare(first, second, third).differing}
    assert rows["step"] == ["0.01 s", "0.005 s", "0.01 s"]
    assert rows["left.load_torque"] == ["table of 2 points, 0 N·m to 10 N·m", "0 N·m", "table of 2 points, 0 N·m to 10 N·m, every 1 s"]
    assert rows["right.load_torque, later"] == ["–", "5 N·m at 0.1 s", "–"]
    assert rows["tables within a step"] == ["linear", "–", "linear"]


def test_values_that_look_alike_are_written_in_full():
    rows = dict(row[::2] for row in compare(free("first", 100.0), free("second", 100.00001)).differing)
    assert rows[TORQUE] == "100.00001 N·m"


def test_shipped_scenes_are_compared_by_their_names(tmp_path):
    printed = command("run study_straight study_turning --stop '20 ms' --unit rpm --plot study.png --csv study.csv").out
    # 2861 and 954 deg/s, with 360 deg per turn
    line = next(line for line in printed.splitlines() if line.startswith("carrier.speed"))
    assert line.split()[:5] == ["carrier.speed", "rpm", "mean", f"{2861 / 6:.6g}", "159"]
    assert (tmp_path / "study.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "study.csv").read_text(encoding="utf-8").splitlines()[0].startswith("scene,time [s],carrier.speed [rpm]")
    # the spin of the planets is 200 deg/s
    assert f"{200 / 6:.6g} rpm" in printed


def test_a_picture_has_a_panel_for_each_output_and_a_curve_for_each_scene():
    single, double = (free(name, torque, outputs=["carrier.speed", "left.speed"]) for name, torque in (("single", 100.0), ("double", 200.0)))
    figure = compare(single, double, display_units=["rpm"]).plot()
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["carrier.speed", "left.speed"]
    assert [axes.get_ylabel() for axes in figure.axes] == ["rpm", "rpm"]
    record = double.run()
    curve = figure.axes[0].lines[1]
    assert curve.get_label() == "double" and curve.get_ydata() == pytest.approx(record["carrier.speed"] * 30.0 / np.pi, rel=1e-15)
    assert [text.get_text() for text in figure.legends[0].texts] == ["single", "double"]
    caption = " ".join(figure.texts[-1].get_text().split())
    assert "single and double from 0 to 0.5 s" in caption and "carrier.torque_command (100 N·m | 200 N·m)" in caption


@pytest.mark.parametrize("preferred", [(["rpm"], [], "rpm"), (["rpm"], ["rad/s"], "rpm"), ([], ["rad/s"], "rad/s")])
def test_the_first_scene_with_a_preference_wins(preferred):
    first, second, unit = preferred
    found = compare(free("first", 100.0, display_units=first), free("second", 100.0, display_units=second))
    assert row(found, "carrier.speed", "end")["unit"] == unit


def test_a_single_scene_is_not_compared():
    with refused("two scenes or more"):
        compare(free("lonely", 100.0))
