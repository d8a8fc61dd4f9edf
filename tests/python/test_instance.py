"""Instances of the Python package in single calls: values of all kinds, steps, states, refusals."""

import pickle
import shutil
import zipfile

import pytest
from bevel_differential import Differential, DifferentialError, Fmu
from driving import TURN
from refusals import refused

DISCARD, ERROR = 2, 3
WATCHED = ["left.speed", "planet[1].left_normal_force", "solver.steps"]


def test_values_of_all_kinds_are_read_as_they_were_written(opened):
    written = {"effects.strength": True, "geometry.planet_teeth": 11, "contact.law": "line", "geometry.module": "5 mm"}
    opened.set(written, left__load_torque="500 N.m")
    assert opened.read([*written, "left.load_torque"]) == [True, 11, 2, 0.005, 500.0]
    assert opened.get("effects.strength") is True


def test_a_run_call_by_call_has_the_bits_of_a_record(opened):
    with Differential(TURN) as differential:
        record = differential.run(outputs=WATCHED, stop=0.02)
    opened.initialise(TURN, stop=0.02)
    rows = [opened.read(WATCHED)]
    for begin, end in zip(record["time"], record["time"][1:]):
        opened.do_step(begin, end - begin)
        rows.append(opened.read(WATCHED))
    assert rows == [[*row] for row in record[WATCHED].tolist()]


def test_initialising_again_is_a_fresh_run(opened):
    ends = []
    for values in (TURN, {"left.load_torque": 100.0}, TURN):
        opened.initialise(values)
        opened.step(5e-3)
        assert opened.time == 5e-3
        ends.append(opened.read(WATCHED))
    assert ends[0] == ends[2] != ends[1]


def test_a_saved_state_goes_on_with_the_same_bits_in_another_instance(fmu):
    def go_on(opened):
        opened.step(3e-3)
        return opened.time, opened.read(WATCHED)

    with fmu.open() as one, fmu.open() as other:
        one.initialise(TURN)
        one.step(5e-3)
        saved = pickle.loads(pickle.dumps(one.save()))
        first = go_on(one)
        assert first[0] == pytest.approx(8e-3, rel=1e-12)
        assert go_on(one.restore(saved)) == first == go_on(other.restore(saved))
        # a restored instance is not fresh: it is reset before it is initialised again
        assert other.initialise(TURN).get("solver.steps") == 0.0


def test_a_run_in_pieces_goes_to_the_stop_time_that_each_instance_announced(fmu):
    with fmu.open() as first, fmu.open() as second, fmu.open() as endless:
        first.initialise(TURN, stop=5e-3).step(5e-3)
        second.initialise(TURN, stop=8e-3).restore(first.save()).step(3e-3)
        assert second.time == pytest.approx(8e-3, rel=1e-12)
        with pytest.raises(DifferentialError, match="stop time 0.008 s$"):
            second.step(1e-3)
        with refused("stop time 0.005 s of the restored state; … fmi2SetupExperiment"):
            endless.initialise(TURN).restore(first.save()).step(1e-3)


def test_a_call_refused_by_the_fmu_has_its_message_and_status_and_a_reset_clears_it(opened):
    opened.initialise()
    with refused("left.load_torque … N.m is outside") as error:
        opened.set({"left.load_torque": 1e30})
    # for hosts, the log also names the call
    assert error.value.status == DISCARD and opened.messages[-1] == f"fmi2SetReal: {error.value}"
    with refused("assembly condition") as error:
        opened.initialise({"geometry.planet_count": 3})
    assert error.value.status == ERROR
    assert pickle.loads(pickle.dumps(error.value)).status == ERROR
    opened.reset()
    assert opened.messages == [] and opened.time == 0.0
    opened.initialise()
    opened.step(1e-3)


@pytest.mark.parametrize("use, parts", [
    (lambda opened: opened.set({"left.speed": 1.0}), "left.speed … cannot be set"),
    (lambda opened: opened.set(contact__law="lin"), "contact.law … did you mean line"),
    (lambda opened: opened.get("left.sped"), "left.sped … did you mean left.speed"),
    (lambda opened: opened.set_slopes({"left.sped": 1.0}), "left.sped"),
    (lambda opened: opened.fmu.open("Exchange"), "'Exchange' … CoSimulation, ModelExchange"),
])
def test_impossible_calls_are_refused_before_the_fmu_is_called(opened, use, parts):
    with refused(parts) as error:
        use(opened)
    assert error.value.status is None


def test_times_of_steps_may_have_units(opened):
    for size, stop in [(1e-3, 3e-3), ("1 ms", "3 ms")]:
        opened.initialise(TURN, stop)
        opened.step(size)
        opened.do_step(size, size)
        port = opened.port(["left.load_torque"], ["left.speed"])
        found = port.do_step(700.0, "2 ms", size)
        assert opened.time == 1e-3
        if size == 1e-3:
            expected = found
    assert found == expected
    with refused("step = '1 mm'"):
        opened.step("1 mm")
    with refused("left.load_torque: its rate is '1 N.m'"):
        opened.set_slopes({"left.load_torque": "1 N.m"})


def test_a_fixed_parameter_after_the_start_is_refused_with_the_call_that_sets_it(opened):
    opened.initialise(TURN)
    with pytest.raises(DifferentialError, match=r"contact.law is a fixed parameter: .*set it in `initialise\(…\)`$"):
        opened.set({"contact.law": "line"})


def test_an_instance_for_model_exchange_takes_no_steps(fmu):
    with fmu.open("ModelExchange") as opened:
        opened.initialise(TURN)
        assert opened.get("left.speed") > 0.0
        with pytest.raises(DifferentialError, match="^the step from 0 s: not legal in the state") as error:
            opened.step(1e-3)
        assert error.value.status == ERROR


BROKEN = {"left.load_torque": 1e7}


@pytest.mark.parametrize("use, begins, kind", [
    (lambda opened: opened.initialise({"geometry.module": 0.0}), "geometry.module: ", "use"),
    (lambda opened: opened.initialise({"geometry.face_width": 0.1, "geometry.planet_count": 3}), "geometry.", "use"),
    (lambda opened: opened.initialise({**TURN, **BROKEN, "scene.start": "equilibrium"}), "left.load_torque: ", "use"),
    (lambda opened: opened.set({"left.load_torque": 1e30}), "left.load_torque: ", "use"),
    (lambda opened: opened.initialise({**TURN, **BROKEN}).step(1e-3), "at t = ", "failed"),
    (lambda opened: opened.initialise(stop=1e-3).do_step(0.0, 1.0), "the step ends at 1 s", "failed"),
    (lambda opened: opened.step(1e-3), "the step from 0 s: not legal", "failed"),
    (lambda opened: opened.initialise().restore((0.0, b"none")), "", "use"),
    (lambda opened: opened.initialise().set_slopes({"contact.damping": 1.0}), "contact.damping is not an input", "use")])
def test_a_message_begins_with_the_matter_and_names_no_call_of_fmi(opened, use, begins, kind):
    with pytest.raises(DifferentialError) as error:
        use(opened)
    said = str(error.value)
    assert said.startswith(begins) and "fmi2" not in said and "initialisation failed" not in said, said
    assert error.value.kind == kind


def test_variables_know_their_start_values_and_ranges(fmu):
    teeth, module, switch = (fmu.variable(name) for name in ("geometry.planet_teeth", "geometry.module", "effects.strength"))
    assert (teeth.start, teeth.minimum, teeth.maximum) == (10, 5, 200)
    assert (module.start, module.minimum, module.maximum) == (0.0045, 2e-4, 0.1)
    assert (switch.start, switch.minimum, switch.maximum) == (False, None, None)
    assert fmu.variable("carrier.speed_command").shown(3.141592653589793) == ("deg/s", pytest.approx(180.0))


def test_another_machine_takes_its_own_copy_of_the_same_fmu_and_no_other(fmu, fmu_file, tmp_path, monkeypatch):
    gone, copy, other = tmp_path / "gone.fmu", tmp_path / "copy.fmu", tmp_path / "other.fmu"
    shutil.copy(fmu_file, gone)
    shutil.copy(fmu_file, copy)
    shutil.copy(fmu_file, other)
    with zipfile.ZipFile(other, "a") as archive:
        archive.writestr("resources/another", "")
    packed = pickle.dumps(Fmu.of(gone))
    gone.unlink()
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", str(copy))
    assert pickle.loads(packed).file == copy.resolve()
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", str(other))
    with refused("gone.fmu … install the same wheel"):
        pickle.loads(packed)


def test_a_unit_of_fmi_3_is_refused_with_the_name_of_the_other(fmu3):
    with refused("BevelDifferential3.fmu: it is a unit of FMI 3.0, and this package runs FMI 2.0"):
        Fmu.of(fmu3).open()
