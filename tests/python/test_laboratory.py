"""Calculations in scripts of the laboratory: errors of facets, deviations of hosts, counts of instructions, figures of the ladder."""

import math
import queue
import sys
from pathlib import Path

import numpy as np
import pytest

from bevel_differential import Fmu
from bevel_differential.text import markdown

sys.path.append(str(Path(__file__).parents[2] / "crates" / "lab" / "python"))
import counting  # noqa: E402
import drives  # noqa: E402
import fuzz  # noqa: E402
import hosts  # noqa: E402
import ladder  # noqa: E402
import platform_scenes  # noqa: E402
import precision  # noqa: E402
import solids_errors  # noqa: E402
import survey_scenes  # noqa: E402
import tools  # noqa: E402


def record(values):
    """Record of pairs (speed, force), equal on both sides."""
    speed, force = (np.array([[value] * 2 for value in column], float) for column in zip(*values))
    ones = np.ones_like(speed)
    return {"time": 1.0 + np.arange(len(values)), "communicates": np.ones(len(values), bool), "speed": speed, "force": force,
            "tangential": 0.0 * ones, "error": 0.0 * ones, "pairs": ones}


def test_errors_are_separated_at_the_times_when_exact_teeth_run_evenly():
    exact = record([(10.0, 100.0)] * 5 + [(12.0, 100.0)])
    found = record([(11.0, 90.0), (10.5, 101.0), (10.5, 102.0), (10.5, 103.0), (11.0, 90.0), (13.0, 140.0)])
    errors = solids_errors.errors(found, exact, 0.0, [10.0, 10.0])
    # the middle half of the smooth interval, and all other points
    parts = [errors[name] for name in ("speed_max", "speed_path_rms", "speed_corner_rms", "force_path_ripple")]
    assert parts == [1.0, 0.5, 1.0, 1.0]
    assert solids_errors.look(found, 0.0)["ripple"] == 50.0


def test_orders_are_slopes():
    pairs = [(facets, 3.0 / facets**2) for facets in (4.0, 8.0, 32.0)]
    assert solids_errors.fitted(pairs) == pytest.approx(2.0, abs=1e-12)
    assert solids_errors.order(pairs[0], pairs[2]) == pytest.approx(2.0, abs=1e-12)


def host_record(*rows):
    return {point: {"a": a, "b": b} for point, a, b in rows}


def test_deviations_of_hosts_are_relative_to_the_value_or_the_natural_scale():
    own, scales = host_record((0, 1.0, 0.0), (1, 200.0, 0.0)), {"a": 20.0, "b": 20.0}
    found = hosts.deviation(own, host_record((0, 1.0, 0.0), (1, 202.0, 0.1)), False, scales)
    assert (found.different, found.compared, found.place) == (2, 4, "a at point 1")
    assert found.largest == pytest.approx(0.01, abs=1e-15)


def test_the_scale_of_a_derivative_is_its_largest_value():
    own = host_record((0, 1.0, 0.0), (1, -200.0, 0.0))
    assert hosts.largest(own) == {"a": 200.0, "b": 1.0}
    assert hosts.deviation(own, host_record((0, 3.0, 0.0), (1, -200.0, 0.0)), False, hosts.largest(own)).largest == 0.01


def test_a_missing_point_is_an_error_but_for_the_start():
    own, scales = host_record((0, 1.0, 0.0), (1, 2.0, 0.0)), {"a": 1.0, "b": 1.0}
    later = host_record((1, 2.0, 0.0))
    with pytest.raises(SystemExit, match="communication points were recorded in place of 2"):
        hosts.deviation(own, later, False, scales)
    assert hosts.deviation(own, later, True, scales).different == 0
    for other in (host_record((0, 1.0, 0.0)), host_record((0, 1.0, 0.0), (1, math.nan, 0.0))):
        with pytest.raises(SystemExit):
            hosts.deviation(own, other, True, scales)


def test_arithmetic_and_branches_are_work_and_moves_are_not():
    kinds = {counting.FLOAT: ["vaddsd", "mulsd", "vfmadd213pd", "ucomisd", "vsqrtsd", "vandpd", "vcvtsi2sd", "vmaxsd"],
             counting.BRANCH: ["ja", "jbe", "call", "ret"],
             counting.ARRANGED: ["vmovsd", "mov", "jmp", "nopw", "vxorpd", "xor", "lea", "add", "vunpcklpd", "data16"]}
    for kind, mnemonics in kinds.items():
        assert {counting.kind_of(mnemonic) for mnemonic in mnemonics} == {kind}


def test_a_profile_is_counted_without_what_its_calls_contain():
    profile = "ob=/p\nfn=f\n0x10 1 5\n0x14 1 5\ncalls=5 0x90\n0x14 1 1000\nob=/libc.so.6\nfn=memcpy\n0x10 3 7\n"
    named = dict(map(counting.disassembled, ["  10:\tvaddsd %xmm0,%xmm1,%xmm2", "  14:\tcall 90"]))
    assert counting.disassembled("0000000000001000 <f>:") is None
    counts = counting.of_profile(profile, "/p", named)
    assert [counts[kind] for kind in (counting.FLOAT, counting.BRANCH, counting.ARRANGED)] == [5, 5, 7]


def test_figures_of_the_ladder_are_means_ranges_and_peaks():
    speed = np.array([1.0, 3.0, 2.0])
    points = dict(zip(["time", *ladder.OUTPUTS, "heat"],
                      [np.array([0.0, 1.0, 2.0]), speed, 7.0 + 0.0 * speed, 100.0 * speed, -speed, 1e-6 * speed, np.array([0.0, 1.0, 2.0])]))
    assert ladder.Turn.quantities_of(points) == pytest.approx([2.0, 200.0, 300.0, 1.0, 2e-6, 2e-6, 2.0])
    assert ladder.Clunk.quantities_of(points) == pytest.approx([7.0, -1.0, 0.0, math.sqrt(14.0 / 3.0), 300.0, 2.0])


def test_every_rung_of_the_ladder_is_richer_than_the_one_before():
    values = {}
    for name, (_, more) in ladder.RUNGS.items():
        assert more.items() - values.items(), name
        values |= more


def test_cases_run_and_end_on_time():
    for motion, fidelity in precision.CASES:
        case = precision.Case(Fmu.of(), motion, fidelity)
        samples, counts = case.samples("adaptive", 1e-3)
        assert samples.shape == (len(case.times), 4) and np.all(np.isfinite(samples)), case.name
        # steps do not depend on the times of samples, and a step beyond the last sample is not completed
        assert counts[0] + counts[2] > 0, case.name
        assert case.times[-1] == pytest.approx(case.stretches[-1][0])


def test_a_run_without_patience_is_given_up():
    with pytest.raises(ValueError, match="given up at"):
        precision.Case(Fmu.of(), "turn", "line").samples("fixed_step", 1e-6, patience=0.0)


def test_errors_are_relative_to_the_largest_speed_and_the_mean_force():
    reference = np.array([[10.0, 0.0, 100.0, 100.0], [-20.0, 0.0, 300.0, 300.0]])
    samples = np.array([[10.0, 0.0, 100.0, 100.0], [-19.0, 0.0, 280.0, 280.0]])
    assert precision.errors(reference, samples) == [0.05, 0.1]
    assert math.isnan(precision.errors(reference, samples * math.nan)[0])


def test_a_file_of_references_is_read_at_the_times_asked_for_and_says_what_it_lacks(tmp_path):
    head = ["left.speed", "right.speed", "planet[1].left_normal_force", "x", "planet[1].right_normal_force"]
    strays = "#   " + ", ".join(f"{name} {k}.0e-12" for k, name in enumerate(precision.COMPARED, 1))
    file = tmp_path / "reference.csv"
    file.write_text(f"# a line\n{strays}\ntime,{','.join(head)}\n0,1,2,3,9,4\n0.1,5,6,7,9,8\n", encoding="utf-8")
    samples, own = precision.from_file(file, [0.1])
    assert samples.tolist() == [[5.0, 6.0, 7.0, 8.0]] and own == [2e-12, 4e-12]
    with pytest.raises(SystemExit, match="no row for 0.2 s"):
        precision.from_file(file, [0.2])
    file.write_text("time\n0\n", encoding="utf-8")
    with pytest.raises(SystemExit, match="no column left.speed"):
        precision.from_file(file, [0.0])


def test_ideal_gears_in_a_turn_are_their_closed_form():
    case = precision.Case(Fmu.of(), "turn", "ideal")
    exact, source, _ = case.reference()
    assert source == "closed form"
    assert max(precision.errors(exact, case.samples("adaptive", 1e-2)[0])) < 1e-14


def test_a_scene_of_the_survey_is_known_by_its_number():
    assert survey_scenes.drawn(3, 7).contents() == survey_scenes.drawn(3, 7).contents() != survey_scenes.drawn(3, 8).contents()
    # scene files contain plain numbers
    assert all(type(value) in (bool, int, float, str) for k in range(20) for value in survey_scenes.drawn(1, k).values.values())


def test_the_survey_draws_all_kinds_of_clutches_and_the_unit_accepts_them(fmu):
    scenes = [survey_scenes.drawn(1, index) for index in range(400)]
    kinds = ["limited_slip.coast_ratio", "limited_slip.viscous_torque", "limited_slip.curve[1].slip"]
    for kind in kinds:
        drawn = [scene for scene in scenes if kind in scene.values]
        assert drawn and all(scene.values["effects.limited_slip"] for scene in drawn)
        with fmu.open() as instance:
            instance.initialise(drawn[0].values)
            instance.step(1e-4)
    curves = [scene.values for scene in scenes if kinds[2] in scene.values]
    assert {values[kinds[2]] == 0.0 for values in curves} == {False, True}


def test_scenes_of_all_platforms_have_clutches_whose_values_act(fmu):
    scenes = {name: values for name, values, *_ in platform_scenes.all_scenes(Path("scenes"), []) if "clutches" in name}
    torques = []
    for values in scenes.values():
        with fmu.open() as instance:
            instance.initialise(values)
            instance.step(0.05)
            assert not instance.unfelt
            torques.append(instance.read(["carrier.torque", "heat.clutch"]))
    (drive, hot), (coast, warm) = torques
    # in drive, ramps press the packs by four times as much torque per torque
    assert drive > 0.0 > coast and hot > warm > 0.0


def test_tallies_of_processes_add_up():
    def tally(seconds):
        rows = [{"function": name, "statuses": [4, 3, 2, 1], "seconds": seconds, "longest": seconds}
                for name in ("fmi2DoStep", "fmi2CompletedIntegratorStep")]
        return {"scenes": 5, "compared": 6, "updates": 7, "rows": rows, "longest": {"function": "fmi2DoStep", "seconds": seconds, "seed": 9, "at": 2}}

    page = fuzz.page([tally(0.5), tally(1.5)])
    assert "| all                         |    40 | 16 |      12 |       8 |     4 | 100000.0 |      1500.0 |" in page
    assert "longest call: fmi2DoStep, 1.500 s of the processor (call 2 of the round with seed 9); simulations started: 10;" in page
    assert "communication steps done: 8; updates within them: 14; steps completed in model exchange: 8; states" in " ".join(page.split())


def test_a_drive_whose_process_ends_is_reported_and_the_next_one_follows():
    found = queue.Queue()
    drives.Worker("no such file", 1, 0, 3).verdicts(found)
    records = [found.get() for _ in range(found.qsize())]
    assert records.pop() is None
    assert [record["number"] for record in records] == [0, 2]
    assert all("the process ended with 1" in record["problems"][0] for record in records)


def test_numbers_keep_their_significant_digits():
    numbers = [123.4, 1.234, 0.01234, 1e-5, 0.0, math.nan]
    assert [tools.significant(number, 3) for number in numbers] == ["123", "1.23", "0.0123", "1.0e-5", "0", "–"]
    assert [tools.percent(part) for part in (0.0, 0.0123, 1e-9, 25.0, math.inf)] == ["0 %", "1.2 %", "1e-7 %", "25 x", "no number"]


def test_a_table_of_markdown_has_aligned_columns():
    rows = [["case", "error, µm"], ["`turn`", "2"], ["straight ahead", "128"]]
    assert markdown(rows) == ("| case           | error, µm |\n|----------------|----------:|\n| `turn`         |         2 |\n"
                              "| straight ahead |       128 |\n")
