"""Methods of integration that were removed: every way to set one is refused with the remaining choices and advice."""

import pytest
from bevel_differential import Differential, DifferentialError, Scene
from bevel_differential.command import main
from fmi3 import Unit3

NUMBERS = {"rodas4": 4, "dormand_prince": 5}
REMAIN = ("adaptive", "fixed_step", "radau")


def assert_advises(message, value):
    assert all(text in message for text in ("solver.method", str(value), *REMAIN, "this method was removed, use adaptive")), message


@pytest.fixture
def scene(tmp_path):
    """scene(value): scene file with the method, written as in TOML."""
    def made(value):
        file = tmp_path / "scene.toml"
        file.write_text('description = "a removed method"\nstop_time = 0.01\nstep = 0.001\noutputs = ["left.speed"]\n[set]\n'
                        f'solver.method = {value}\n')
        return file

    return made


@pytest.mark.parametrize("number", NUMBERS.values())
def test_calls_of_fmi_refuse_it(fmu, fmu3, number):
    with fmu.open() as unit:
        with pytest.raises(Exception, match="fmi2SetInteger"):
            unit.raw.setInteger([fmu.variable("solver.method").reference], [number])
        assert_advises(unit.messages[-1], number)
    with Unit3(fmu3) as unit:
        with pytest.raises(Exception, match="fmi3SetInt64"):
            unit.set({"solver.method": number})
        assert_advises(unit.messages[-1][1], number)


@pytest.mark.parametrize("name", NUMBERS)
def test_python_scenes_and_commands_refuse_it(fmu_file, scene, monkeypatch, capsys, name):
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)
    for value in (name, NUMBERS[name]):
        with pytest.raises(DifferentialError) as refused:
            Differential({"solver.method": value}, fmu=fmu_file)
        assert_advises(str(refused.value), value)
    for value in (f'"{name}"', NUMBERS[name]):
        with pytest.raises(DifferentialError) as refused:
            Scene.load(scene(value), fmu_file)
        assert_advises(str(refused.value), str(value).strip('"'))
    assert main(["run", "study_turning", "--set", f"solver.method={name}"]) == 2
    assert_advises(capsys.readouterr().err, name)


def test_other_wrong_choices_get_no_such_advice(fmu_file):
    for wrong in ({"solver.method": 6}, {"solver.method": "rodau"}, {"contact.law": 5}, {"contact.law": "rodas4"}):
        with pytest.raises(DifferentialError) as refused:
            Differential(wrong, fmu=fmu_file)
        assert "removed" not in str(refused.value)
