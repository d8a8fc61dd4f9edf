"""Step response of a clutch on command: its command steps up and back to zero while the clutch slips.

The step passes a dead band u₀, a limit of the rate, and a filter of second order with the time constant τ and the damping ratio ζ:

    g = max(0, (u − u₀)/(1 − u₀))        |ṙ| ≤ 1/T until r = g        τ² ÿ + 2 ζ τ ẏ + y = r

With the poles p of the filter, its responses to an impulse, a step and a ramp at the time s τ are D, S = 1 − e^(p₁ s) + p₁ D, and
τ (s − 2 ζ S − D). The torque is max(y, 0) times the torque at full command.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..drive_port import SPEED, port_command, port_value
from ..losses.axes import Axis
from ..losses.point import benched
from ..panel import GREY, INK, Panel, curve, time_axis
from ..records import write
from ..report import words
from ..scene import Scene
from ..values import Number

# the clutch that is pressed, and the other one
PRESSED, OTHER = "left.clutch_command", "right.clutch_command"
# fractions of the torque whose times are reported; the first one ends the dead time
LEVELS = (0.01, 0.1, 0.5, 0.9)
# difference of speeds of clutch and wheel, rad/s, so large that a wound-up half-shaft does not end the slip
SLIP = 25.0
# time constants after which the free motion of the filter has decayed; relative duration before the step; points
DECAYED, BEFORE, POINTS = 8.0, 0.1, 4000
# digits of times in s, so that the points of the steps have exactly their times
DIGITS = 12
HEAD = ["time [s]", "clutch_command [1]", "clutch_torque [N.m]", "closed_form [N.m]"]


@dataclass(frozen=True)
class Actuator:
    """Parameters of an actuator, SI."""

    dead_band: float
    stroke_time: float
    response_time: float
    response_damping: float

    @classmethod
    def of(cls, scene: Scene) -> "Actuator":
        """Actuator of the clutches in a scene."""
        return cls(*(float(scene.value(f"clutches.{name}")) for name in cls.__dataclass_fields__))

    @property
    def is_immediate(self) -> bool:
        """True if the torque follows the command without delay."""
        return self.stroke_time == self.response_time == 0.0

    @property
    def duration(self) -> float:
        """Time after which the response to a step has ended [s]."""
        damping = self.response_damping
        slowest = damping + np.sqrt(damping**2 - 1.0) if damping > 1.0 else 1.0 / damping
        return self.stroke_time + DECAYED * self.response_time * slowest

    def pulse(self, times: np.ndarray, command: float, length: float) -> np.ndarray:
        """Output at `times` [s], if the command has a value from the time 0 on, for a `length` [s] after which the output rests."""
        target = max(0.0, (command - self.dead_band) / (1.0 - self.dead_band))
        return np.maximum(self._rise(times, target) - self._rise(times - length, target), 0.0)

    def _rise(self, times, target):
        if self.stroke_time == 0.0:
            return target * self._filtered(times)[0]
        ends = target * self.stroke_time
        return (self._filtered(times)[1] - self._filtered(times - ends)[1]) / self.stroke_time

    def _filtered(self, times):
        """Responses of the filter to a step and to a ramp of one per second, both from the time 0 on."""
        times, tau, damping = np.maximum(times, 0.0), self.response_time, self.response_damping
        if tau == 0.0:
            return (times > 0.0).astype(float), times
        s, root = times / tau, np.sqrt(damping**2 - 1.0 + 0j)
        first = np.exp((root - damping) * s)
        impulse = -first * np.expm1(-2.0 * root * s) / (2.0 * root) if root else s * first
        step = 1.0 - first + (root - damping) * impulse
        return step.real, tau * (s - 2.0 * damping * step - impulse).real


@dataclass(frozen=True, eq=False)
class StepResponse:
    """Torque of the left clutch on its side gear [N·m] at `times` [s], if its `command` steps up at the time 0 and back after `length` [s].
    `course`: output of the actuator by the closed form."""

    times: np.ndarray
    torque: np.ndarray
    course: np.ndarray
    command: float
    length: float

    @property
    def final(self) -> float:
        """Torque before the step back [N·m]."""
        return self._at_end(self.torque)

    @property
    def expected(self) -> np.ndarray:
        """Torque by the closed form [N·m]."""
        return self.course * (self.final / self._at_end(self.course))

    @property
    def deviation(self) -> float:
        """Largest deviation from the closed form, relative to the final torque."""
        return float(np.abs(self.torque - self.expected).max() / self.final)

    def rise(self) -> list[float]:
        """Times after the step up at which the torque first reaches each of LEVELS [s]."""
        return self._first(0.0, self.torque)

    def fall(self) -> list[float]:
        """Times after the step back at which the torque has first fallen by each of LEVELS [s]."""
        return self._first(self.length, self.final - self.torque)

    def _first(self, since, change):
        begin = np.searchsorted(self.times, since, "right") - 1
        ends = [begin + int(np.argmax(change[begin:] >= level * self.final)) for level in LEVELS]
        return [float(np.interp(level * self.final, change[end - 1:end + 1], self.times[end - 1:end + 1])) - since
                for level, end in zip(LEVELS, ends)]

    @property
    def commands(self) -> np.ndarray:
        """Command at `times`."""
        # times of a step have two rows, before and after it
        steps = [np.searchsorted(self.times, time, "right") - 1 for time in (0.0, self.length)]
        found = np.zeros(len(self.times))
        found[slice(*steps)] = self.command
        return found

    def _at_end(self, values):
        return float(values[np.searchsorted(self.times, self.length)])


def step_response(scene: Scene, drive: Mapping[str, Number], out: Path, of_torque: Axis) -> tuple[str, list[list[Panel]]]:
    """Steps the command of the left clutch to its value in the scene, or to 1 if that is 0. `drive`: torque and speeds on the bench. Writes the
    courses; returns a sentence and the panels. There are no panels if the torque follows the command without delay, or not at all."""
    actuator, command = Actuator.of(scene), float(scene.value(PRESSED)) or 1.0
    if actuator.is_immediate:
        return "No actuator delays the torque", []
    if command <= actuator.dead_band or not scene.value("clutches.torque"):
        why = f"{PRESSED} = {command:g} is within the dead band" if command <= actuator.dead_band else "clutches.torque = 0"
        return f"There is no response to a step, because {why}", []
    found = measured(scene, drive, actuator, command)
    text = _conclusion(found, of_torque)
    columns = (found.times, found.commands, found.torque, found.expected)
    write(out, HEAD, zip(*(each.tolist() for each in columns)), text)
    return text, [_panels(found, of_torque)]


def measured(scene: Scene, drive: Mapping[str, Number], actuator: Actuator, command: float) -> StepResponse:
    """Simulates the step."""
    length = round(actuator.duration, DIGITS)
    begin, stop = BEFORE * length, (BEFORE + 2.0) * length
    # the wheels impose the speed of the carrier
    given = {port_command(scene.value, name): port_value(scene.value, name, float(number)) for name, number in drive.items() if name != SPEED}
    values = benched(scene, (PRESSED, OTHER)).values | given | {OTHER: 0.0}
    table = (PRESSED, [0.0, begin, begin, begin + length, begin + length, stop], [0.0, 0.0, command, command, 0.0, 0.0], None)
    with Scene(scene.name, stop=stop, step=stop / POINTS, set={name: value for name, value in values.items() if name != PRESSED},
               tables=[table], accept_start_values=True, fmu=scene.fmu) as stepped:
        record = stepped.run(["left.clutch_torque"])
    times = (record["time"] - begin).round(DIGITS)
    return StepResponse(times, np.abs(record["left.clutch_torque"]), actuator.pulse(times, command, length), command, length)


def _conclusion(found, of_torque):
    rise, fall = ([words.quantity(1e3 * time, "ms", 3) for time in times] for times in (found.rise(), found.fall()))
    return (f"After a step of the command to {found.command:g}, the dead time to 1 % of {of_torque.text(found.final)} is {rise[0]}, and the torque "
            f"reaches 10, 50 and 90 % after {words.listed(rise[1:])}. After the step back, the dead time is {fall[0]}, and the torque has "
            f"fallen by as much after {words.listed(fall[1:])}. It deviates from the closed form by up to {100.0 * found.deviation:.1f} %")


def _panels(found, of_torque):
    time = time_axis(found.times[-1])
    limits = {"xlim": (found.times[0], found.times[-1])}
    return [Panel(time, "command", [curve(found.times, found.commands, colour=GREY)], **limits),
            Panel(time, of_torque.named("torque of the left clutch"),
                  [curve(found.times, found.torque, "simulated", linewidth=3.0),
                   curve(found.times, found.expected, "closed form", INK, "--", linewidth=1.2)], **limits)]
