"""Tests over time: judder in a run-up of the slip, fade on a hot lap, a start in winter."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..losses.axes import axes
from ..losses.tables import bias as ratio_of
from ..panel import Axis, Panel, curve
from ..scene import Scene
from ..values import DifferentialError
from .steady import drawn

# friction that rises with speed, as with a fresh oil that has a friction modifier
RISING = {"limited_slip.static_ratio": 1.0, "limited_slip.stribeck_speed": 0.0, "limited_slip.slip_slope": 0.02}
# judder ends when the speed vibrates by less than this, rad/s, within this time window, s
QUIET, WINDOW = 0.1, 0.1
# duration of a lap, and the time in the lap at which the car is in the middle of a hairpin, s
LAP, HAIRPIN = 60.0, 20.0


def judder(scene: Scene, out: Path, _farm: Mapping[str, Any]) -> str:
    """Measures the vibration of a side gear about its wheel's speed, with the scene's friction and with one that rises with speed."""
    names, (_, _, slips, _) = ["left.speed", "right.speed"], axes(scene)
    run_up = {table[0]: table for table in scene.tables}
    try:
        wheels = [run_up[f"{side}.speed_command"] for side in ("left", "right")]
    except KeyError as missing:
        raise DifferentialError(f"the bench of judder needs a run-up of the slip: tables of both wheel speeds, also of {missing}") from None
    falling, rising = (scene.run(names, values) for values in ({}, RISING))
    time = falling["time"]
    left, right = (np.interp(time, table[1], table[2]) for table in wheels)
    count = round(WINDOW / scene.step)
    swings = [np.ptp(np.lib.stride_tricks.sliding_window_view(record["left.speed"] - left, count), axis=1)
              for record in (falling, rising)]
    loud = np.flatnonzero(swings[0] > QUIET)
    slip = (left - right)[loud[-1] + count - 1] if len(loud) else 0.0
    last = "the end of the run-up, " if len(loud) and loud[-1] + count >= len(time) else ""
    conclusion = (f"friction that falls with speed lets the side gear swing by up to {slips.text(swings[0].max(), 3)}, and it judders up to "
            f"{last}a slip of {slips.text(slip, 3)} between the wheels; friction that rises keeps it below "
            f"{slips.text(swings[1][count:].max(), 2)} after the start")
    _written(scene, falling, out, conclusion, [
        (slips.named("side gear − wheel"), {"falling friction": falling["left.speed"] - left, "rising friction": rising["left.speed"] - left}),
        (slips.named("difference of wheels"), {"run-up": left - right})])
    return conclusion


def hot_lap(scene: Scene, out: Path, _farm: Mapping[str, Any]) -> str:
    """Measures temperatures and locking value over laps."""
    if scene.stop < LAP:
        raise DifferentialError(f"stop_time = {scene.stop:g} s: the bench of hot laps needs laps of {LAP:g} s, with a hairpin at {HAIRPIN:g} s")
    record = _recorded(scene, "hot laps", "left.shaft_torque", "right.shaft_torque", "held.sides", *_names("clutch", "oil", "case"))
    time, left, right, (*_, warmth) = record["time"], record["left.shaft_torque"], record["right.shaft_torque"], axes(scene)
    # only while the differential differentiates
    effect = np.array([np.nan if held or ratio_of(*torques)[1] is None else ratio_of(*torques)[1]
                       for held, *torques in zip(record["held.sides"] > 0, left.tolist(), right.tolist())])
    first, last = (float(np.interp(at, time, effect)) for at in (HAIRPIN, time[-1] - LAP + HAIRPIN))
    conclusion = (f"in the same hairpin LE falls from {first:.1f} % in the first lap to {last:.1f} % in the last one, as the clutch packs warm "
            f"up to {warmth.text(record['temperature.clutch'].max(), 3)}: TBR {_ratio(first):.2f} becomes {_ratio(last):.2f}")
    _written(scene, record, out, conclusion, [(warmth.named("temperature"), _temperatures(record, "clutch", "oil", "case")),
                                               (Axis("locking value, %"), {"LE": effect})])
    return conclusion


def winter_start(scene: Scene, out: Path, _farm: Mapping[str, Any]) -> str:
    """Measures temperatures and loss after a cold start."""
    record, (*_, warmth) = _recorded(scene, "a winter start", "power.loss", *_names("oil", "gears", "case")), axes(scene)
    time, loss = record["time"], record["power.loss"]
    half = time[np.argmax(loss < 0.5 * (loss[0] + loss[-1]))]
    conclusion = (f"the loss is {loss[0]:.0f} W at the start and {loss[-1]:.0f} W after {time[-1] / 60.0:.0f} min; half of the fall takes "
            f"{half:.0f} s, in which the oil warms up from {warmth.text(record['temperature.oil'][0], 3)} to "
            f"{warmth.text(float(np.interp(half, time, record['temperature.oil'])), 3)}")
    _written(scene, record, out, conclusion, [(warmth.named("temperature"), _temperatures(record, "oil", "gears", "case")),
                                               (Axis("power loss, W"), {"loss": loss})])
    return conclusion


def _ratio(effect):
    return (100.0 + effect) / (100.0 - effect)


def _recorded(scene, what, *names):
    """Record of the scene's outputs and of those with these `names`."""
    if not scene.value("effects.warm_up"):
        raise DifferentialError(f"effects.warm_up = false: the bench of {what} needs temperatures that change")
    return scene.run([*dict.fromkeys([*scene.outputs, *names])])


def _names(*nodes):
    return [f"temperature.{node}" for node in nodes]


def _temperatures(record, *nodes):
    return {node: record[name] for node, name in zip(nodes, _names(*nodes))}


def _written(scene: Scene, record: np.ndarray, out: Path, conclusion: str, panels: Sequence[tuple[Axis, Mapping[str, np.ndarray]]]) -> None:
    scene.to_csv(record, out.with_suffix(".csv"))
    time = Axis("time, s")
    rows = [[Panel(time, axis, [curve(record["time"], values, name, linewidth=1.2) for name, values in curves.items()], xmargin=0.0)]
            for axis, curves in panels]
    drawn(scene, out, conclusion, rows, 6.4)
