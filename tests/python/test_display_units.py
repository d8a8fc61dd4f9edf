"""Preferred units in tables, pictures, files, reports and plans, from the command line and from scene files."""

import json
import math
import pickle
import re

import numpy as np
import pytest
from command_line import command
from bevel_differential import Differential, Fmu, Scene
from bevel_differential.answers import about, ask
from bevel_differential.command import WRONG
from refusals import refused
from bevel_differential.plot import plot

# rpm per rad/s: 60 s per minute, 2π rad per turn
RPM = 60.0 / (2.0 * math.pi)
OUTPUTS = ["left.speed", "left.shaft_torque", "temperature.oil", "temperature.flash", "planet[1].left_pairs"]
COMMANDED = 954.0 / 6.0  # 954 deg/s in rpm: 360 deg per turn

pytestmark = pytest.mark.usefixtures("folder")


def a_file(tmp_path, name="turn.toml", display=None, more=""):
    """Scene file; `display`: its display units."""
    units = "" if display is None else f"display_units = {display}\n"
    file = tmp_path / name
    file.write_text(f'description = "a turn"\nstop_time = 0.02\nstep = 1e-3\n{units}'
                    'outputs = ["left.speed", "left.shaft_torque"]\n[set]\ncarrier.speed_command = "954 deg/s"\n'
                    f'left.load_torque = "835 N.m"\nright.load_torque = "835 N.m"\nscene.start = "rolling"\n{more}', encoding="utf-8")
    return str(file)


def cells(text, name):
    """Unit and numbers of an output in a printed table."""
    unit, *numbers = next(line for line in text.splitlines() if line.startswith(name)).split()[1:]
    return unit, [float(number) for number in numbers]


def columns(file):
    """Names of the columns of a CSV file, and its numbers by name."""
    lines = file.read_text(encoding="utf-8").splitlines()
    names = lines[0].split(",")
    return names, dict(zip(names, np.array([line.split(",") for line in lines[1:]], float).T))


@pytest.mark.parametrize("line", ["run {}", "run {} {other}", "sweep --workers 0 --plan grid --scene {} --vary left.load_torque=800,810 "
                                  "--want left.speed:mean"])
def test_a_unit_that_no_shown_value_has_gives_a_warning(line, tmp_path):
    other = a_file(tmp_path, "other.toml", more='geometry.backlash = "0.2 mm"')
    said = command(f"{line.format(a_file(tmp_path), other=other)} --unit rpm --unit mm").err
    assert said.count("warning: --unit mm: no shown value has this unit") == 1 and "--unit rpm" not in said


def test_a_run_prints_draws_and_writes_the_chosen_units(tmp_path):
    file = tmp_path / "run.csv"
    scene = a_file(tmp_path)
    printed = command(f"run {scene} --unit rpm --unit 'kN·m' --csv {file} --plot run.svg").out
    with Scene.load(scene) as plain:
        record = plain.run()
    speeds, torques = record["left.speed"], record["left.shaft_torque"]
    unit, (low, _, high, end) = cells(printed, "left.speed")
    assert unit == "rpm" and [low, high, end] == pytest.approx([RPM * at for at in (speeds.min(), speeds.max(), speeds[-1])], rel=1e-5)
    assert end == pytest.approx(COMMANDED, rel=0.02)
    unit, (*_, end) = cells(printed, "left.shaft_torque")
    assert unit == "kN.m" and end == pytest.approx(1e-3 * torques[-1], rel=1e-5)
    names, found = columns(file)
    assert names == ["time [s]", "left.speed [rpm]", "left.shaft_torque [kN.m]"]
    # full precision, except for the rounding of the conversion
    assert found["left.speed [rpm]"] == pytest.approx(RPM * speeds, rel=4e-16)
    assert found["left.shaft_torque [kN.m]"] == pytest.approx(1e-3 * torques, rel=4e-16)
    assert np.array_equal(found["time [s]"], record["time"])
    picture = (tmp_path / "run.svg").read_text(encoding="utf-8")
    assert "<!-- speed, rpm -->" in picture and "<!-- shaft torque, kN·m -->" in picture and "deg/s" not in picture


def test_a_parquet_file_has_the_same_columns(tmp_path):
    import pyarrow.parquet as pq

    for kind in ("parquet", "csv"):
        command(f"run {a_file(tmp_path)} --unit rpm --csv run.{kind}")
    table, (names, found) = pq.read_table("run.parquet"), columns(tmp_path / "run.csv")
    assert table.column_names == names == ["time [s]", "left.speed [rpm]", "left.shaft_torque [N.m]"]
    assert all(np.array_equal(table[name].to_numpy(), found[name]) for name in names)
    assert table.schema.field("left.speed [rpm]").metadata == {b"unit": b"rpm"}


def test_a_scene_prefers_units_and_the_command_line_wins(tmp_path):
    scene = a_file(tmp_path, display='["rpm", "kN.m"]')
    for options, speed, torque in (("", "rpm", "kN.m"), ("--unit °/s", "deg/s", "kN.m"), ("--unit N.m", "rpm", "N.m")):
        printed = command(f"run {scene} {options} --csv run.csv").out
        assert (cells(printed, "left.speed")[0], cells(printed, "left.shaft_torque")[0]) == (speed, torque)
        assert columns(tmp_path / "run.csv")[0] == ["time [s]", f"left.speed [{speed}]", f"left.shaft_torque [{torque}]"]


def test_a_recorded_input_in_rpm_is_a_table_of_inputs(tmp_path):
    ramp = '[[table]]\ninput = "carrier.speed_command"\ntime = [0.0, 0.02]\nvalue = ["60 rpm", "120 rpm"]\n'
    plain = a_file(tmp_path).replace("turn.toml", "ramp.toml")
    (tmp_path / "ramp.toml").write_text((tmp_path / "turn.toml").read_text().replace('carrier.speed_command = "954 deg/s"\n', "") + ramp)
    command(f"run {plain} --output carrier.speed_command --unit rpm --csv speeds.csv")
    names, found = columns(tmp_path / "speeds.csv")
    assert names == ["time [s]", "carrier.speed_command [rpm]"]
    # inputs are recorded just after a point, by 1e-9 of a step
    assert found[names[1]] == pytest.approx(60.0 + 3000.0 * found["time [s]"], abs=3000.0 * 1.001e-12)
    (tmp_path / "again.toml").write_text((tmp_path / "ramp.toml").read_text().partition("[[table]]")[0] + '[[inputs]]\nfile = "speeds.csv"\n')
    with Scene.load("ramp.toml") as first, Scene.load("again.toml") as again:
        (name, times, values, _), = again.tables
        assert name == "carrier.speed_command" and np.array_equal(times, found["time [s]"])
        assert np.array(values) * RPM == pytest.approx(found[names[1]], rel=4e-16)
        assert again.run()["left.speed"] == pytest.approx(first.run()["left.speed"], rel=1e-9)


def test_the_library_itself_writes_the_same_file(tmp_path):
    scene = a_file(tmp_path, display='["rpm", "kN.m"]')
    said = ask({"ask": "run", "of": about(scene), "out": "own.csv"})["text"]
    assert cells(said, "left.speed")[0] == "rpm" and cells(said, "left.shaft_torque")[0] == "kN.m"
    command(f"run {scene} --csv run.csv")
    (own_names, own), (names, found) = columns(tmp_path / "own.csv"), columns(tmp_path / "run.csv")
    assert own_names == names and all(np.array_equal(own[name], found[name]) for name in names)


def test_a_plan_shows_the_units_and_its_script_keeps_them(tmp_path):
    scene = a_file(tmp_path, display='["rpm"]', more='[[at]]\ntime = 0.01\ncarrier.speed_command = "120 rpm"\n')
    printed = command(f"plan {scene} --python script.py").out
    assert f"carrier.speed_command = {COMMANDED:g} rpm" in printed and "carrier.speed_command = 120 rpm" in printed
    assert "deg/s" not in printed and "rad/s" not in printed
    namespace = {"__name__": "script"}
    exec(compile((tmp_path / "script.py").read_text(encoding="utf-8"), "script.py", "exec"), namespace)
    with namespace["scene"] as of_script, Scene.load(scene) as loaded:
        assert of_script.contents()["display_units"] == loaded.contents()["display_units"] == ["rpm"]
        assert cells(of_script.summary(of_script.run()), "left.speed")[0] == "rpm"
        assert np.array_equal(*(columns(each.to_csv(each.run(), tmp_path / "of.csv"))[1]["left.speed [rpm]"] for each in (of_script, loaded)))
    assert "carrier.speed_command = 954 deg/s" in command(f"plan {scene} --unit deg/s").out


def test_the_chosen_setting_of_accuracy_keeps_the_preference(tmp_path):
    scene = a_file(tmp_path, display='["rpm"]')
    said = command(f"accuracy {scene} --want left.speed:mean --within 20% --write chosen.toml --progress none").out
    value = re.search(r"left\.speed:mean \(reference ([\d.]+) rpm\)", " ".join(said.split()))
    assert value and float(value[1]) == pytest.approx(COMMANDED, rel=0.02)
    with Scene.load("chosen.toml") as chosen:
        assert list(chosen.fmu.display_units.values()) == ["rpm"]


def test_a_sweep_prints_and_writes_figures_in_the_units(tmp_path):
    swept = (f"sweep --scene {a_file(tmp_path)} --vary carrier.speed_command=60rpm,120rpm --plan grid --want left.speed:final --workers 0 "
             "--csv")
    unit, (low, _, high) = cells(command(f"{swept} sweep.csv --unit rpm").out, "left.speed:final")
    assert unit == "rpm" and [low, high] == pytest.approx([60.0, 120.0], rel=0.05)
    head, *rows = (tmp_path / "sweep.csv").read_text(encoding="utf-8").splitlines()
    assert head.split(",")[:3] == ["run", "carrier.speed_command [rpm]", "left.speed:final [rpm]"]
    assert [float(row.split(",")[1]) for row in rows] == pytest.approx([60.0, 120.0], rel=1e-14)
    command(f"{swept} si.csv")
    plain = (tmp_path / "si.csv").read_text(encoding="utf-8").splitlines()
    assert plain[0].split(",")[:3] == ["run", "carrier.speed_command", "left.speed:final"]
    assert [RPM * float(row.split(",")[2]) for row in plain[1:]] == pytest.approx([float(row.split(",")[2]) for row in rows], rel=1e-15)


def test_tolerances_print_and_write_figures_in_the_units(tmp_path):
    (tmp_path / "tolerances.toml").write_text(
        'description = "speeds"\nscene = "turn.toml"\nwants = ["left.speed:final"]\nlimits = ["left.speed:final <= 200 rpm"]\nruns = 8\n'
        '[factors]\ncarrier.speed_command = "159 rpm +- 6 rpm"\n', encoding="utf-8")
    a_file(tmp_path, display='["deg/s"]')
    printed = command("tolerance tolerances.toml --no-indices --workers 0 --csv runs.csv --unit rpm").out
    assert "left.speed:final <= 200 rpm" in printed
    unit, mean, *_ = next(line for line in printed.splitlines() if re.match(r"left\.speed:final +rpm ", line)).split()[1:]
    assert unit == "rpm" and float(mean) == pytest.approx(159.0, abs=6.0)
    head, *rows = (tmp_path / "runs.csv").read_text(encoding="utf-8").splitlines()
    assert head.split(",") == ["run", "carrier.speed_command [rpm]", "left.speed:final [rpm]", "message"]
    # the left speed equals that of the carrier except for backlash
    assert all(abs(float(speed) / float(driven) - 1.0) < 0.02 for _, driven, speed, _ in (row.split(",") for row in rows))


def test_a_report_is_in_the_units(tmp_path):
    scene = a_file(tmp_path, display='["rpm"]')
    command(f"report {scene} --quick --unit kN.m --out page.html --progress none")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    row = re.search(r"<tr>\s*<td[^>]*>left\.speed</td>\s*<td[^>]*>([^<]*)</td>\s*<td[^>]*>([^<]*)</td>", page)
    assert row[1] == "rpm" and float(row[2]) == pytest.approx(COMMANDED, rel=0.02)
    assert not re.search(r"\b(deg|rad)/s\b|\d N·m\b|, N·m\b", page)


def test_temperatures_have_offsets_and_their_differences_none(fmu_file):
    with Differential() as turning:
        record = turning.run(outputs=OUTPUTS, stop=0.002)
        oil, flash = (turning.fmu.variable(f"temperature.{name}") for name in ("oil", "flash"))
    assert oil.shown_in("K").shown(353.15) == ("K", 353.15) and oil.shown_in("degC").shown(353.15)[1] == pytest.approx(80.0)
    assert oil.shown_in("degC").differences().shown(5.0) == ("K", 5.0)
    for units in (["degC"], ["K"], []):
        assert Fmu.of(fmu_file).displaying(units).variable("temperature.flash").shown(36.5) == ("K", 36.5) == flash.shown(36.5)
    figure = plot(Fmu.of(fmu_file).displaying(["K", "rpm"]), record)
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert any(label.endswith(", rpm") for label in labels) and not any("degC" in label for label in labels)


def test_python_takes_units_for_one_call_or_for_all(fmu_file, tmp_path):
    scene = Scene("turn", stop=0.01, outputs=["left.speed"], set={"carrier.speed_command": "60 rpm"})
    with scene:
        record = scene.run()
        assert cells(scene.summary(record), "left.speed")[0] == "deg/s"
        assert cells(scene.summary(record, ["rpm"]), "left.speed")[0] == "rpm"
        assert scene.plot(record, display_units=["rpm"]).axes[0].get_ylabel() == "speed, rpm"
        names, found = columns(scene.to_csv(record, tmp_path / "turn.csv", ["rpm"]))
        assert found["left.speed [rpm]"] == pytest.approx(RPM * record["left.speed"], rel=4e-16)
    with Scene("turn", stop=0.01, outputs=["left.speed"], set={"carrier.speed_command": "60 rpm"}, display_units=["rpm"]) as preferring:
        own = preferring.run()
        assert cells(preferring.summary(own), "left.speed")[0] == "rpm"
        # records stay in SI
        assert np.array_equal(own, record)
        copied = pickle.loads(pickle.dumps(preferring))
        assert copied.fmu.variable("left.speed").shown(1.0)[0] == "rpm"
    with Scene.load("study_straight", fmu=Fmu.of(fmu_file).displaying(["rpm"])) as loaded:
        assert loaded.fmu.variable("left.speed").shown(1.0)[0] == "rpm"
    with Differential(display_units=["rpm"]) as straight:
        assert straight.plot(straight.run(outputs=["left.speed"], stop=0.002)).axes[0].get_ylabel() == "speed, rpm"


def test_units_of_the_same_kind_are_shared(fmu_file):
    fmu = Fmu.of(fmu_file)
    assert fmu.displaying([]) is fmu and fmu.displaying(["rpm"]) is fmu.displaying(["1/min"])
    assert fmu.variable("left.speed").shown(1.0)[0] == "deg/s"


@pytest.mark.parametrize(("units", "message"), [
    ('["rmp"]', "did you mean rpm"), ('["rpm", "deg/s"]', "rpm and deg/s are units of the same quantity"),
    ('["furlong"]', "known: m, mm, um, in, km, rad"), ('["1"]', "there is no unit")])
def test_unknown_units_are_errors(units, message, tmp_path):
    assert message in command(f"run {a_file(tmp_path, 'own.toml', units)}", WRONG).err
    with refused(message):
        Scene("turn", display_units=json.loads(units))
