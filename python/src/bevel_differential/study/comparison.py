"""The study, theory and this program: rows and notes of the comparison."""

import textwrap
from collections.abc import Callable, Mapping
from math import cos, degrees, floor, log10
from typing import Any

from ..text import aligned, markdown
from . import stated, theory
from .simulation import SETTLED_BAND, Run
from .theory import Theory

HEAD = ["quantity", "study", "theory", "this program", "program / theory"]
# width of notes in a terminal
WIDTH = 118
# numbers of the notes to which rows refer; no row refers to the last note, on the geometry
INPUTS, STIFFNESS, RIPPLE, FORCE, START, FREQUENCY, ENERGY = range(1, 8)


class Comparison:
    """Comparison of both `runs`, by case, with theory and with the study; `start`: start values of the FMU, SI, by name."""

    def __init__(self, start: Mapping[str, Any], runs: Mapping[str, Run]):
        forms = Theory(start)
        self.rows, self.notes = _rows(forms, runs), _notes(forms, runs["straight"].results)

    def terminal(self) -> str:
        """Table and notes for a terminal."""
        head, *rows = aligned([HEAD, *self.rows], 1)
        notes = [textwrap.fill(note, WIDTH, initial_indent=f"[{i}] ", subsequent_indent=" " * len(f"[{i}] "), break_on_hyphens=False,
                               break_long_words=False) for i, note in enumerate(self.notes, 1)]
        return "\n".join([head, "-" * len(head), *rows, "", *notes, ""])

    def document(self) -> str:
        """Table and notes in Markdown, for docs/study.md."""
        notes = "".join(f"{i}. {note}\n" for i, note in enumerate(self.notes, 1))
        return f"{markdown([HEAD, *self.rows])}\n{notes}"


def signed_percent(fraction: float) -> str:
    """Text of a fraction in percent with two significant digits and its sign."""
    percent = fraction * 100.0
    if abs(percent) < 1e-12:
        return "0 %"
    decimals = max(1 - floor(log10(abs(percent))), 0)
    return f"{_scientific(percent, '+.1e')} %" if decimals > 5 else f"{percent:+.{decimals}f} %"


def _rows(forms, runs):
    start, straight, turning = forms.start, runs["straight"], runs["turning"]
    found, turn = straight.results, turning.results
    return [
        _row("input: carrier at 60 km/h, deg/s", INPUTS, f"{straight.case.carrier_speed:.2f}", theory.carrier_speed(straight.case),
             degrees(start["carrier.speed_command"]), _fixed(2)),
        _row("input: carrier at 20 km/h, deg/s", INPUTS, f"{turning.case.carrier_speed:.2f}", theory.carrier_speed(turning.case),
             turn["carrier_speed"], _fixed(2)),
        _row("input: load per half-shaft, N.m", INPUTS, f"{stated.LOAD:.2f}", theory.load_torque(), start["left.load_torque"], _fixed(2)),
        _row("input: stiffness K, N/mm^1.5", STIFFNESS, _scientific(stated.STIFFNESS_PRINTED), _per_mm(forms.hertz_stiffness),
             _per_mm(start["contact.stiffness"]), _scientific),
        *_speed_rows("straight", straight),
        _row("straight: ripple, peak to peak", RIPPLE, f"{2.0 * stated.RIPPLE:g} %", "0.00 %", f"{found['ripple'][0]:.2f} %"),
        *_speed_rows("turn", turning),
        _row("turn: sum, deg/s", None, f"{sum(turning.case.side_speeds):.0f}", sum(turning.expected.side_speeds), sum(turn["side_speeds"]),
             _fixed(3)),
        *(_row(f"turn: ripple {side}, peak to peak", RIPPLE, f"{2.0 * stated.RIPPLE:g} %", None, f"{ripple:.2f} %")
          for side, ripple in zip(("left", "right"), turn["ripple"])),
        *(_row(name, FORCE, f"{stated.FORCE:.0f}", run.expected.tangential_force, run.results["tangential_force"][0], _fixed(0))
          for name, run in (("T/r_p, all planets, outer, N", straight), ("turn: T/r_p, N", turning))),
        *(_row(name, FORCE, None, run.expected.normal_force, sum(run.results["normal_force"]) / 2.0, _fixed(0))
          for name, run in (("normal force per mesh, N", straight), ("turn: normal force per mesh, N", turning))),
        _row("start: largest T/r_p, N", START, "spikes", None, found["peak_tangential_force"], _fixed(0)),
        _row("start: settled after, ms", START, None, None, found["settled_after"] * 1e3, _fixed(2)),
        _row("straight: mesh frequency, Hz", FREQUENCY, f"{stated.MESH_FREQUENCY:.1f}", straight.expected.mesh_frequency,
             found["mesh_frequency"], _fixed(3)),
        _row("straight: first line of force, Hz", FREQUENCY, None, "none", found["first_line"] or "none", _fixed(3)),
        _row("turn: mesh frequency, Hz", FREQUENCY, None, turning.expected.mesh_frequency, turn["mesh_frequency"], _fixed(3)),
        _row("turn: first line of force, Hz", FREQUENCY, None, turning.expected.mesh_frequency, turn["first_line"] or "none", _fixed(3)),
        *(_row(f"{name}: energy residual", ENERGY, None, "0", run.results["relative_energy_residual"], _scientific)
          for name, run in (("straight", straight), ("turn", turning))),
        *(_row(f"{name}: integrator steps", None, None, None, run.results["steps"], _fixed(0))
          for name, run in (("straight", straight), ("turn", turning))),
    ]


def _speed_rows(name, run):
    values = zip(("left", "right"), run.case.side_speeds, run.expected.side_speeds, run.results["side_speeds"])
    return [_row(f"{name}: {side}, deg/s", None, f"{study:.0f}", expected, found, _fixed(3)) for side, study, expected, found in values]


def _row(quantity: str, note: int | None, study: str | None, expected: float | str | None, program: float | str,
         form: Callable[[float], str] = str) -> list[str]:
    """Texts of a row, with the difference between theory and program if both are numbers. Cells with None contain a dash."""
    comparable = isinstance(expected, float) and isinstance(program, float) and expected != 0.0
    texts = ("–" if cell is None else cell if isinstance(cell, str) else form(cell) for cell in (study, expected, program))
    return [f"{quantity} [{note}]" if note else quantity, *texts, signed_percent(program / expected - 1.0) if comparable else ""]


def _fixed(decimals):
    return f"{{:.{decimals}f}}".format


def _scientific(value, form=".3e"):
    """Text of a number with a power of ten, without the zeros and the plus sign that Python writes before an exponent."""
    mantissa, exponent = format(value, form).split("e")
    return f"{mantissa}e{int(exponent)}"


def _per_mm(stiffness):
    """Stiffness per mm^1.5 from a stiffness per m^1.5."""
    return stiffness / 1e3 ** 1.5


def _notes(forms, straight):
    """Texts of the notes. `straight`: results of driving straight ahead."""
    start, pair = forms.start, forms.pair
    ahead, turn = stated.CASES.values()
    hertz, load = _per_mm(forms.hertz_stiffness), forms.normal_force
    expected = forms.expected(ahead)
    consequence = {
        (True, True): "undercut the planet and jam in the side gear",
        (True, False): "undercut the planet, because the side gear's tips reach below its base circle",
        (False, True): "jam in the side gear",
        (False, False): "are free of interference",
    }[forms.standard_addenda_interfere]
    sphere, planar = pair.contact_ratio, forms.planar_contact_ratio
    return [
        f"The study rounds its inputs. Unrounded, the speeds are {theory.carrier_speed(ahead):.2f} and {theory.carrier_speed(turn):.2f} "
        f"deg/s (v / tyre radius). The load is {theory.load_torque():.2f} N.m (mass · g · front share · adhesion · tyre radius, half of "
        f"it on each side). For comparison, the program runs with the study's {degrees(start['carrier.speed_command']):.0f} and "
        f"{turn.carrier_speed:.0f} deg/s and {start['left.load_torque']:.0f} N.m.",
        f"K = 4/3 √R E* is {_scientific(hertz, '.4e')} N/mm^1.5. The study prints {_scientific(stated.STIFFNESS_PRINTED, '.2e')}, which is "
        f"wrong by a factor of ten. It then uses {_scientific(stated.STIFFNESS_USED, '.2e')}, which deviates by "
        f"{(stated.STIFFNESS_USED / hertz - 1.0) * 100.0:+.1f} %. The program's default is "
        f"{_scientific(_per_mm(start['contact.stiffness']), '.2e')}, too. With contact.stiffness_from_hertz, the program uses the formula.",
        f"The study states ±{stated.RIPPLE:g} % for all speeds. Straight ahead, the ripple is 0 after the start, because no tooth rolls. "
        "In the turn, exact teeth give only the ripple of this table, with the study's contact law and constants.",
        f"T/r_p with r_p = {forms.side_radius * 1e3:.0f} mm is the tangential force of all planets on one side gear, referred to its outer "
        f"pitch circle. The teeth transmit it around the mean cone distance. With {pair.planets} planets, each mesh therefore has F_t = "
        f"{load * cos(pair.pressure_angle):.0f} N and F_n = {load:.0f} N.",
        "The run starts in the middle of the backlash. The load throws the side gears back until the teeth strike. The force peaks after "
        f"{straight['peak_time'] * 1e6:.0f} µs at {straight['peak_tangential_force'] / expected.tangential_force:.2f} times the static "
        f"force. Speeds are within {SETTLED_BAND * 100.0:.0f} % of theory after {straight['settled_after'] * 1e3:.2f} ms. The study's "
        f"output every {stated.INTERVAL * 1e3:.0f} ms cannot show this.",
        "Straight ahead, planets and side gears do not roll on each other, so the mesh frequency z_p |spin| / 360 is "
        f"{expected.mesh_frequency:.0f} Hz. In the turn, it is {forms.expected(turn).mesh_frequency:.3f} Hz. The study's "
        f"{stated.MESH_FREQUENCY:g} Hz is ten times the carrier's rotation ({pair.gears[0].teeth * ahead.carrier_speed / 360.0:.2f} Hz).",
        "The residual is the stored energy minus the work of the inputs plus the heat. It is divided by the energy that was transmitted in "
        "the same time. An exact solution has 0.",
        f"This note on the geometry belongs to no row. Standard addenda (1.0 modules) {consequence}. The limit is "
        f"{forms.addendum_limit:.3f} modules at {degrees(pair.pressure_angle):.0f} deg. The default, long and short addenda, avoids this. "
        f"The face width of {pair.face_width * 1e3:.0f} mm is {pair.face_width / pair.outer_cone:.3f} R_e, above R_e/3, the usual limit of "
        f"cut gears. The contact ratio is {sphere:.4f} on the sphere. Tredgold's planar approximation, which the study uses, gives "
        f"{planar:.4f} ({100.0 * (planar / sphere - 1.0):+.2f} %).",
    ]
