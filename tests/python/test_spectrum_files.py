"""Duty cycles from files: the example, the command, and helpful errors."""

import numpy as np
import pytest
from command_line import command
from duty_cycles import DUTY_CYCLE, HEAD, ROOT

from bevel_differential import DifferentialError
from bevel_differential.spectrum import spectrum
from refusals import refused


def test_the_example_is_complete_and_sorted(tmp_path):
    result = spectrum(DUTY_CYCLE)
    table = result.table()
    assert len(table) == len(result.events) == 22
    assert np.all(np.diff(table["share"]) <= 0.0)
    assert table["share"].sum() == pytest.approx(1.0)
    for name in result.damage:
        assert table[name].sum() == pytest.approx(result.damage[name])
    assert table["km"].sum() == pytest.approx(result.km) and 90.0 < result.km < 110.0
    file = result.save(tmp_path / "table.csv")
    back = np.genfromtxt(file, delimiter=",", names=True, dtype=None, encoding="utf-8", deletechars="")
    assert np.array_equal(back["damage.planet"], table["damage.planet"])
    assert result.plot(tmp_path / "picture.png").stat().st_size > 10_000
    ranges, means, counts = result.slow.matrix(8)
    assert counts.shape == (8, 8) and counts.sum() == pytest.approx(result.slow.count.sum())


def test_the_table_of_the_docs_is_that_of_the_example():
    text = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    written = text.partition("<!-- duty cycle begin")[2].partition("<!-- duty cycle end")[0].splitlines()[1:]
    lines = iter(spectrum(DUTY_CYCLE).markdown())
    # the worst events in their order
    assert len(written) > 10 and all(line in lines for line in written)


def test_an_event_without_a_turn_goes_straight_ahead_in_a_scene_that_turns(cycle):
    lines = [HEAD, "start,2,4,20,,1500", "corner,1,4,20,20,300"]
    assert np.array_equal(cycle(*lines, scene="study_turning").by_event, cycle(*lines).by_event)


@pytest.mark.parametrize("separator, comma", [(";", ","), (";", "."), ("\t", ","), ("\t", ".")])
def test_a_cycle_from_a_spreadsheet_of_any_country_is_the_same(cycle, tmp_path, separator, comma):
    lines = ["name,count,duration [s],speed [km/h],torque [N.m],wheel_radius [m],history", "1.5,2,0.25,20.5,100,0.3,", "b,1.5,,,100,0.3,history.csv"]
    history = ["time [s],speed [km/h]", "0,20", "0.125,21.75", "0.2,20"]
    (tmp_path / "history.csv").write_text("\n".join(history), encoding="utf-8")
    expected = cycle(*lines)
    (tmp_path / "history.csv").write_text("\ufeff" + "\r\n".join(_as(history, separator, comma)), encoding="utf-8")
    found = cycle(*_as(lines, separator, comma))
    assert np.array_equal(found.by_event, expected.by_event)
    # a name is not read as a number
    assert [each.event.name for each in found.events] == [f"1{comma}5", "b"]


def _as(lines, separator, comma):
    """The lines with another separator and decimal sign."""
    rows = [line.split(",") for line in lines]
    point = [row if place == 0 else [cell if cell.endswith(".csv") else cell.replace(".", comma) for cell in row] for place, row in enumerate(rows)]
    return [separator.join(row) for row in point]


@pytest.mark.parametrize("lines, parts", [
    (["name,count,duration [s],torqe [N.m]", "a,1,1,1"], "line 1, column torqe [N.m] … did you mean torque"),
    (["name;count;duration [s];speed [m/s]", "a;1;1;1.500"], "line 2, column speed [m/s], value \"1.500\" … thousands"),
    (["name;count;duration [s];speed [m/s]", "a;1;0,5;1.5"], "line 2, column duration [s], value \"0,5\" … value \"1.5\" … same decimal sign"),
    (["name,count,duration [s]", "a,1,0,5"], "line 2 … 4 cells where the header has 3 … decimal commas … semicolons or tabs"),
    (["name|count|duration [s]", "a|1|0.5"], "line 1 … separated by vertical bars … commas, semicolons or tabs"),
    (["name,count,duration [fortnights]", "a,1,1"], "line 1, column duration [fortnights] … fortnights … min"),
    (["name,count,left.load_torque [stone.ft]", "a,1,1"], "line 1 … stone.ft … N.m"),
    (["name,count,count", "a,1,1"], "line 1, column count … twice"),
    (["name,duration [s]", "a,1"], "no column count"),
    (["name,count,left.speed [rpm]", "a,1,1"], "column left.speed [rpm] … not an input or parameter"),
    (["name,count,geometry.module [mm]", "a,1,4"], "geometry.module … whole cycle"),
    ([HEAD], "no line below the header"),
    ([HEAD, "a,1,1,20,,100,7"], "line 2 … 7 cells where the header has 6"),
    ([HEAD, "# comment", "a,many,1,20,,100"], "line 3, column count, value \"many\" … number"),
    ([HEAD, "a,-1,1,20,,100"], "line 2, column count, value \"-1\" … 0 times or more"),
    ([HEAD, "a,0,1,20,,100"], "no event of the cycle occurs"),
    ([HEAD, ",1,1,20,,100"], "line 2, column name … write a value"),
    ([HEAD, "a,1,0,20,,100"], "line 2, column duration [s], value \"0\" … more than 0"),
    ([HEAD, "a,1,,20,,100"], "line 2 … needs a duration, or a distance"),
    ([HEAD, "a,1,1,20,0.5,100"], "line 2 … turn_radius … half the track"),
    ([HEAD, "a,1,1,,9,100"], "line 2 … turn_radius … needs speed"),
    ([HEAD, "a,1,1,nan,,100"], "line 2, column speed [km/h], value \"nan\" … finite"),
    (["name,count,duration [s],speed [m/s],wheel_radius [m]", "a,1,1,5,-0.3"], "line 2 … wheel_radius … more than 0"),
    (["name,count,duration [s],torque [N.m],left.load_torque [N.m]", "a,1,1,1,1"], "line 2 … left.load_torque … remove one"),
    (["name,count,duration [s],left.load_torque [N.m]", "a,1,1,"], "line 2, column left.load_torque [N.m] … write a value"),
    (["name,count,distance [m],speed [m/s]", "a,1,10,0"], "line 2, column distance [m] … speed other than 0"),
    (["name,count,history", "a,1,missing.csv"], "missing.csv: there is no such file"),
    (["name,count,duration [s],speed [m/s],wheel_radius [m],torque [N.m],lock.command", "a,1,1,5,0.3,100,7"],
     "event 'a' … lock.command"),
])
def test_errors_in_a_cycle_are_reported_with_their_place(cycle, lines, parts):
    with refused(parts):
        cycle(*lines)


@pytest.mark.parametrize("lines, parts", [
    (["time [s],torque [N.m]", "0,1", "1,x"], "line 3, column torque [N.m], value \"x\""),
    (["time [s],torque [N.m]", "1,1", "0,1"], "line 3, column time [s] … must not fall"),
    (["time [s],torque [N.m]", "0,1"], "two times or more"),
    (["torque [N.m]", "0"], "no column time"),
    (["time [s],contact.damping", "0,1"], "contact.damping … not an input of"),
    (["time [s],torque [N.m]", "0,", "1,1"], "line 2, column torque [N.m] … write a value"),
])
def test_errors_in_a_history_are_reported_with_their_place(cycle, tmp_path, lines, parts):
    (tmp_path / "history.csv").write_text("\n".join(lines))
    with refused(f"history.csv … {parts}"):
        cycle("name,count,speed [km/h],history", "a,1,20,history.csv")


def test_the_command_reports_results(tmp_path):
    table, picture = tmp_path / "table.csv", tmp_path / "picture.png"
    assert "life by the" in command(f"spectrum {DUTY_CYCLE} --csv {table} --plot {picture} --set contact.law=line").out
    assert table.is_file() and picture.is_file()


LOADS = ["left.load_torque", "right.load_torque"]


def by_torque(result):
    return list(result.damage.values())


@pytest.mark.parametrize("head, row", [(HEAD, "turn,1,20,10,6,"), (HEAD.replace(",torque [N.m]", ""), "turn,1,20,10,6"),
                                       (f"{HEAD.replace(',torque [N.m]', '')},left.load_torque [N.m]", "turn,1,20,10,6,")])
def test_a_missing_load_is_refused_unless_the_scene_gives_it(cycle, scene_file, head, row):
    with pytest.raises(DifferentialError, match="line 2.*(torque|left.load_torque).*nobody gives"):
        cycle(head, row)
    scene = scene_file(dict.fromkeys(LOADS, 1100.0))
    found = cycle(head, row, scene=scene)
    # half of a torque of the ring gear loads each side
    assert by_torque(found) == pytest.approx(by_torque(cycle(HEAD, "turn,1,20,10,6,2200")), rel=1e-9)
    assert found.loads == tuple(f"load not in the duty cycle: {name} = 1100 N·m from scene {scene}, in all events" for name in LOADS)
    assert all(line in found.summary() for line in found.loads)
    given = cycle(head, row, parameters=dict.fromkeys(LOADS, "1100 N.m"))
    assert by_torque(given) == pytest.approx(by_torque(found), rel=1e-9) and "from the parameters (--set)" in given.loads[0]


def test_one_blank_load_among_others_is_refused_and_a_full_duty_cycle_names_no_source(cycle):
    lines = [HEAD, "one,1,20,10,6,2200", "two,1,20,10,6,"]
    with refused("line 3, column torque"):
        cycle(*lines)
    assert cycle(*lines[:2]).loads == ()
    found = cycle(*lines, parameters=dict.fromkeys(LOADS, 300.0))
    assert [line.endswith("in 1 event (two)") for line in found.loads] == [True, True]


def test_a_carrier_that_is_driven_by_torque_needs_its_torque(cycle):
    with refused("carrier.torque_command in the scene … nobody gives"):
        cycle(HEAD, "a,1,20,10,6,", parameters={"scene.carrier_drive": "torque", **dict.fromkeys(LOADS, 300.0)})


@pytest.mark.parametrize("driven, name", [("speed", "carrier.speed_command"), ("torque", None)])
def test_a_missing_speed_is_refused(cycle, driven, name):
    lines = ["name,count,duration [s],torque [N.m]", "a,1,20,900"]
    if name is None:
        assert cycle(*lines, parameters={"scene.carrier_drive": driven}).loads == ()
        return
    with pytest.raises(DifferentialError, match=f"line 2: speed.*{name}.*nobody gives"):
        cycle(*lines, parameters={"scene.carrier_drive": driven})


def test_events_from_python_need_their_loads_too():
    from bevel_differential.spectrum import Event

    with refused("left.load_torque: event 'one' … nobody gives"):
        spectrum([Event("one", 1.0, 1.0, values={"carrier.speed_command": 50.0})])
