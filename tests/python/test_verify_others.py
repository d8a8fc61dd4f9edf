"""The command `verify` on evidence of other units: the forms that FMI-LS-REF allows, and faults that occur."""

import re

import pytest
import stand_in
from stand_in import DEFAULT, experiments, manifest, related

from bevel_differential import DifferentialError
from bevel_differential.command import main
from bevel_differential.verify import verify
from bevel_differential.verify.evidence import MANIFEST

EXP = "application/x-ma-ls-experiments"
SSV = ('<ssv:ParameterSet xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" version="1.0" name="twice"><ssv:Parameters>'
       '<ssv:Parameter name="gain"><ssv:Real value="2.0"/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>')
TIMES = 'startTime="1" stopTime="3" stepSize="0.5"'
ALL = '<Parameters source="twice.ssv"/><Stimuli source="in.csv"/><References source="out.csv"/>'
# u is 10 throughout, and the gain 2
FILES = {"twice.ssv": SSV, "in.csv": "time,u\n0,10\n3,10\n", "out.csv": "time,y\n1,22\n2,24\n3,26\n"}


@pytest.fixture
def simulated(monkeypatch):
    """The stand-in that simulates."""
    found = stand_in.StandIn()
    monkeypatch.setattr("bevel_differential.verify.experiment.simulate_fmu", found)
    return found


@pytest.fixture
def held(simulated, tmp_path):
    """held(entries of the manifest, {file: text}): the experiments as judged, and the faults."""

    def judged(entries, files, **given):
        return verify(stand_in.packed(tmp_path / "unit.fmu", {MANIFEST: manifest(*entries, **given), **files}))

    return judged


@pytest.fixture
def experiment(held):
    """experiment(element, role and files): the one experiment of a file as judged, and the faults."""

    def judged(element, role="experiment/validation", **files):
        found, faults = held([related("a.exp", role, EXP)], {**FILES, "a.exp": experiments(element), **files})
        assert len(found) == 1
        return found[0], faults

    return judged


def test_a_result_alone_is_of_the_default_experiment(held, simulated):
    (found,), faults = held([related("out.csv")], {"out.csv": DEFAULT}, description=None)
    assert (found.name, found.kind, found.verdict, found.assumed) == ("out", "default experiment", "passed", True)
    assert simulated.asked == {"values": {}, "start": None, "stop": 1.0, "step": 0.25, "tolerance": None}
    assert len(faults) == 1 and "fmi-ls-description is missing" in faults[0]


def test_a_result_alone_that_differs_fails_where_it_differs(held):
    (found,), _ = held([related("out.csv")], {"out.csv": DEFAULT.replace("0.5,0.5", "0.5,0.51")})
    assert (found.verdict, found.worst.variable, found.worst.time) == ("failed", "y", 0.5)
    assert found.worst.size == pytest.approx(0.01)


def test_times_that_nothing_states_are_those_of_the_result(simulated, tmp_path):
    bare = stand_in.DESCRIPTION.replace('<DefaultExperiment startTime="0" stopTime="1" stepSize="0.25"/>', "")
    text = "time,y\n0,0\n1,1\n1,1\n1.5,1.5\n4,4\n"
    (found,), _ = verify(stand_in.packed(tmp_path / "unit.fmu", {MANIFEST: manifest(related("out.csv")), "out.csv": text}, bare))
    assert found.verdict == "passed" and (simulated.asked["stop"], simulated.asked["step"]) == (4.0, 0.5)


@pytest.mark.parametrize("given, fault", [
    ({}, None),
    ({"version": "1.0.0-beta.1"}, None),
    ({"version": "1.0.0-alpha.9"}, "fmi-ls-version is '1.0.0-alpha.9'"),
    ({"version": None}, "fmi-ls-version is missing"),
    ({"name": "org.fmi-standard.fmi-ls-other"}, "fmi-ls-name is 'org.fmi-standard.fmi-ls-other'"),
    ({"description": "Results"}, "fmi-ls-description is 'Results'"),
    ({"root": "References"}, "the root element is References"),
    ({"more": "<a:b/>"}, "no valid XML"),
])
def test_faults_of_the_root_are_told(held, given, fault):
    (found,), faults = held([related("out.csv")], {"out.csv": DEFAULT}, **given)
    assert found.verdict == "passed"
    assert len(faults) == (fault is not None) and all(fault in each for each in faults), faults


@pytest.mark.parametrize("place, old, new, fault", [
    (MANIFEST, "fmi-ls:fmi-ls-version", "fmi-ls-version", "fmi-ls-version is not in the namespace"),
    (f"../fmi-ls-ref/{MANIFEST}", "out.csv", "../org.fmi-standard.fmi-ls-ref/out.csv", "the manifest belongs into"),
])
def test_faults_of_names_are_told(simulated, tmp_path, place, old, new, fault):
    text = manifest(related("out.csv")).replace(old, new)
    (found,), faults = verify(stand_in.packed(tmp_path / "unit.fmu", {place: text, "out.csv": DEFAULT}))
    assert found.verdict == "passed" and len(faults) == 1 and fault in faults[0]


@pytest.mark.parametrize("entry, fault", [
    ('<Related role="document"/>', "source is missing"),
    ('<Related source="a.txt"/>', "role is missing"),
    (related("a.txt", "results"), "'results' is no role"),
    (related("a.exp", "experiment/long"), "'experiment/long' is no role"),
    (related("a.txt", "document"), "a.txt is not in the FMU"),
    (related("a.h5", "result", "application/hdf5"), "application/hdf5 is not read"),
    (related("a.mo", "experiment", "text/modelica"), "text/modelica is not read"),
    (related("https://example.org/a.txt", "document"), None),
    (related("b%20c.txt", "document"), None),
    (related("b%20c.txt", "serialized-state/x86_64-linux", "application/octet-stream"), None),
    (related("b%20c.txt", "meta-data"), None),
    (related("more.csv", kind="text/csv; charset=utf-8"), None),
])
def test_faults_of_an_entry_take_no_other(held, entry, fault):
    found, faults = held([entry, related("out.csv")], {"out.csv": DEFAULT, "b c.txt": "text", "more.csv": DEFAULT})
    assert [each.verdict for each in found] == ["passed"] * (1 + ("more.csv" in entry))
    assert len(faults) == (fault is not None) and all(fault in each for each in faults), faults


def test_arrays_are_compared_by_elements(held):
    rows = ["time,w,count", *(f"{time},{time} {2 * time} {3 * time},{int(time)}" for time in (0.0, 0.5, 1.0))]
    (found,), faults = held([related("out.csv")], {"out.csv": "\n".join(rows)})
    assert found.verdict == "passed" and not faults
    assert [each.variable for each in found.deviations] == ["w[1]", "w[2]", "w[3]", "count"]
    (found,), _ = held([related("out.csv")], {"out.csv": "\n".join(rows).replace("0.5 1.0 1.5", "0.5 1.2 1.5")})
    assert [each.variable for each in found.deviations if each.ratio > 1.0] == ["w[2]"] and found.worst.time == 0.5


@pytest.mark.parametrize("text, problem", [
    ("time,w\n0,0 0 0\n1,1 2\n", "line 3, column w: it has 2 elements, 3 in the first line"),
    ("time,w\n0,\n", "line 2, column w: it has 0 elements"),
    ("time,w\n0,0 0\n1,1 2\n", "w: it has 3 elements, 2 in the result"),
    ("time,w\n0,0 x 0\n", "line 2, column w is 'x': it is no number"),
    ("time,y\n0,0 0\n", "line 2, column y is '0 0': it is no number"),
    ("time,y,time\n0,0,0\n", "time stands here twice"),
    ("time,a,text\n0,0,0\n", "no column that can be read"),
    ("time,y\n", "it has no values"),
    ("time,y\n0,0\n2,2\n", "the run ends at 1 s"),
])
def test_a_result_that_cannot_be_compared_is_broken(held, text, problem):
    (found,), _ = held([related("out.csv")], {"out.csv": text})
    assert found.verdict == "broken" and problem in found.problem


def test_columns_of_no_variable_and_of_texts_are_left_out_with_a_fault(held):
    text = DEFAULT.replace("time,y", 'time,"y",Y,text,raw').replace("\n", ",1,Set me!,666f6f\n").replace("raw,1,Set me!,666f6f", "raw")
    (found,), faults = held([related("out.csv")], {"out.csv": text})
    assert found.verdict == "passed" and [each.variable for each in found.deviations] == ["y"]
    assert len(faults) == 3 and all(part in fault and "left out" in fault for part, fault in zip(
        ["Y: there is no such variable", "text: values of the type String", "raw: values of the type Binary"], faults))


@pytest.mark.parametrize("source, place", [("my%20out.csv", "my out.csv"), ("100%25/a%2Bb.csv", "100%/a+b.csv"), ("./out.csv", "out.csv"),
                                           ("../own/out.csv", "../own/out.csv"), ("%C3%B6.csv", "ö.csv")])
def test_a_path_is_a_uri(held, source, place):
    (found,), faults = held([related(source)], {place: DEFAULT})
    assert found.verdict == "passed" and not faults


@pytest.mark.parametrize("source", ["gone.csv", "../../../../../etc/hostname", "/etc/hostname", "https://example.org/out.csv", "a%00.csv", ".",
                                    "//[/out.csv", "x" * 300])
def test_a_result_that_is_not_in_the_unit_is_broken(held, source):
    (found,), _ = held([related(source)], {"out.csv": DEFAULT})
    assert found.verdict == "broken" and "it is not in the FMU" in found.problem


@pytest.mark.parametrize("element", [
    f'<Experiment name="a" {TIMES} tolerance="1e-5">{ALL}</Experiment>',
    f'<Experiment name="a" tolerance="1e-5"><TransientSimulation {TIMES}/>{ALL}<Annotations/></Experiment>',
])
@pytest.mark.parametrize("role, kind", [("experiment", "smoke test"), ("experiment/smoke-test", "smoke test"),
                                        ("experiment/validation", "validation"), ("experiment/uncertainty-analysis", "uncertainty analysis")])
def test_an_experiment_is_run_as_its_file_says(experiment, simulated, element, role, kind):
    found, faults = experiment(element, role)
    assert (found.name, found.kind, found.verdict) == ("a", kind, "passed") and not faults
    assert simulated.asked == {"values": {"gain": "2.0"}, "start": 1.0, "stop": 3.0, "step": 0.5, "tolerance": 1e-5}


@pytest.mark.parametrize("left_out, value", [("Parameters", 13.0), ("Stimuli", 2.0)])
def test_an_experiment_without_a_file_does_without_it(experiment, left_out, value):
    children = re.sub(f"<{left_out}.*?/>", "", ALL)
    found, _ = experiment(f'<Experiment name="a" {TIMES}>{children}</Experiment>')
    assert found.verdict == "failed" and found.worst.value == value


def test_an_experiment_without_a_result_shows_that_it_runs(experiment, simulated):
    element = f'<Experiment name="a" {TIMES}><Stimuli source="in.csv"/></Experiment>'
    found, faults = experiment(element)
    assert found.verdict == "passed" and not found.deviations and not found.assumed
    assert len(faults) == 1 and "names no result" in faults[0]
    simulated.ends = 0.5
    for times, stop in ((TIMES.replace('"1"', '"0"'), 3), ("", 1)):
        found, _ = experiment(element.replace(TIMES, times))
        assert found.verdict == "broken" and f"ends at 0.5 s, before its stop time, {stop} s" in found.problem


@pytest.mark.parametrize("key, text", [("startTime", "early"), ("stopTime", "nan"), ("stepSize", "1e-3 s"), ("tolerance", "")])
def test_a_wrong_number_is_a_fault_and_the_default_holds(experiment, simulated, key, text):
    found, faults = experiment(f'<Experiment name="a" {key}="{text}"><References source="out.csv"/></Experiment>', **{"out.csv": DEFAULT})
    assert found.verdict == "passed"
    assert len(faults) == 1 and f"a.exp, experiment a: {key} is {text!r}" in faults[0]
    assert simulated.asked == {"values": {}, "start": None, "stop": 1.0, "step": 0.25, "tolerance": None}


@pytest.mark.parametrize("children, problem", [
    ('<References source="gone.csv"/>', "gone.csv: it is not in the FMU"),
    ('<References type="application/hdf5" source="out.h5"/>', "out.h5: the type application/hdf5 is not read"),
    ("<References/>", "References has no source"),
    ('<Parameters source="twice.ssv"/><Parameters source="twice.ssv"/><References source="out.csv"/>', "Parameters stands here twice"),
    ('<Stimuli source="said.csv"/><References source="out.csv"/>', "said: values of the type String are not read"),
    ('<Stimuli source="other.csv"/><References source="out.csv"/>', "other.csv, line 1: v: there is no such variable"),
    ('<References source="other.csv"/>', "other.csv, line 1: v: there is no such variable"),
    ('<SteadyState/><References source="out.csv"/>', "no simulation over time but SteadyState"),
])
def test_an_experiment_that_cannot_be_run_as_meant_is_broken(experiment, children, problem):
    found, _ = experiment(f'<Experiment name="a">{children}</Experiment>', **{"said.csv": "time,said\n0,hello\n", "other.csv": "time,v\n0,0\n"})
    assert found.verdict == "broken" and problem in found.problem


def test_a_text_in_the_result_of_an_experiment_is_left_out_with_a_fault(experiment):
    found, faults = experiment('<Experiment name="a"><References source="text.csv"/></Experiment>', **{"text.csv": "time,y,text\n0,0,Set me!\n"})
    assert found.verdict == "passed" and len(faults) == 1 and "text: values of the type String" in faults[0]


@pytest.mark.parametrize("text, problem", [
    (None, "a.exp: it is not in the FMU"),
    (b"", "a.exp: it holds no experiment"),
    (b"name,start\nfirst,0\n", "a.exp: it holds no experiment"),
    (b"\xff\xfe\x00", "a.exp: it holds no experiment"),
    (experiments(), "a.exp: it holds no experiment"),
])
def test_a_file_of_experiments_that_says_nothing_is_broken_and_the_others_are_run(held, text, problem):
    good = experiments(f'<Experiment name="good" {TIMES}>{ALL}</Experiment>')
    files = {**FILES, "b.exp": good, **({} if text is None else {"a.exp": text})}
    found, _ = held([related("a.exp", "experiment/validation", EXP), related("b.exp", "experiment", EXP)], files)
    assert [(each.name, each.kind, each.verdict) for each in found] == [("a.exp", "validation", "broken"), ("good", "smoke test", "passed")]
    assert found[0].problem == problem


def test_of_a_damaged_file_is_run_what_can_be_read(held):
    text = experiments(f'<Experiment name="a" {TIMES} x:y="1">{ALL}</Experiment>', "<Experiment>").removesuffix("</Experiments>")
    found, faults = held([related("a.exp", "experiment", EXP)], {**FILES, "a.exp": text})
    assert (found[0].name, found[0].verdict) == ("a", "passed")
    assert any("a.exp: it is no valid XML" in fault for fault in faults) and any("the attribute name is missing" in fault for fault in faults)


def test_files_of_experiments_name_theirs_from_their_own_place(held):
    element = f'<Experiment name="a" {TIMES}>{ALL.replace("in.csv", "../in.csv")}</Experiment>'
    files = {f"sub/{name}" if name != "in.csv" else name: text for name, text in FILES.items()}
    # the tolerances are those of the manifest's folder: too narrow for a result that is off by 0.001
    files |= {"sub/a.exp": experiments(element), "tolerances.csv": "experiment,variable,unit,tolerance\na,y,1,0.0001\n",
              "sub/out.csv": "time,y\n3,26.001\n"}
    (found,), faults = held([related("sub/a.exp", "experiment", EXP), related("tolerances.csv", "other")], files)
    assert (found.verdict, found.assumed) == ("failed", False) and not faults
    assert found.worst.tolerance == 0.0001


def test_a_result_of_an_experiment_is_not_that_of_the_default_one_too(held):
    files = {**FILES, "a.exp": experiments(f'<Experiment name="a" {TIMES}>{ALL}</Experiment>'), "default.csv": DEFAULT}
    found, _ = held([related("out.csv"), related("default.csv"), related("a.exp", "experiment", EXP)], files)
    assert [(each.name, each.verdict) for each in found] == [("a", "passed"), ("default", "passed")]
    # two that are missing are not one and the same
    found, _ = held([related("gone.csv"), related("a.exp", "experiment", EXP)], {**files, "out.csv": None})
    assert [(each.name, each.verdict) for each in found] == [("a", "broken"), ("gone", "broken")]


@pytest.mark.parametrize("entries", [[], [related("a.txt", "document")], [related("a.h5", "result", "application/hdf5")],
                                     ['<Experiment name="a" result="out.csv"/>'], ['<Result file="out.csv"/>']])
def test_a_manifest_without_experiments_and_results_is_refused(held, entries):
    with pytest.raises(DifferentialError, match="names no experiment and no result"):
        held(entries, {"out.csv": DEFAULT})


def test_the_command_tells_faults_and_fails_where_a_file_of_experiments_is_missing(simulated, tmp_path, capsys):
    entries = manifest(related("gone.exp", "experiment/validation", EXP), related("out.csv"), description=None)
    assert main(["verify", stand_in.packed(tmp_path / "unit.fmu", {MANIFEST: entries, "out.csv": DEFAULT})]) == 3
    said = capsys.readouterr().out
    assert "fault: fmi-ls-manifest.xml: the attribute fmi-ls-description is missing" in said
    assert "gone.exp, validation: gone.exp: it is not in the FMU" in said and "2 experiments, 1 passed, 1 not" in said
