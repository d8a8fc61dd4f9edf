"""Tables of the map: CSV or Parquet, and MATLAB arrays in the layout of Simulink's blocks."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..records import write
from ..values import FileName
from ..writing import write_whole
from . import MeasuredMap, coupling
from .grid import efficiency, grid_points, torques_of
from .loss_map import MAPPED, SIGNS

MEANINGS = {
    "kind": "map: a point of the map, which slips; stuck: a point without a difference of speeds; unseen: a random point that "
            "measured the error",
    "carrier.torque": "torque of the drive, referred to the carrier: with a final drive, that of its port times the ratio, N·m",
    "carrier.speed": "speed of the carrier, the mean of the wheels' speeds, rad/s",
    "speed_difference": "speed of the left wheel less that of the right wheel, rad/s",
    "oil.temperature": "temperature of the oil and of all surfaces, K; 0 °C are 273.15 K",
    "left.shaft_torque": "torque of the left half-shaft, a mean over mesh cycles, N·m",
    "right.shaft_torque": "torque of the right half-shaft, a mean over mesh cycles, N·m",
    "power.loss": "power that becomes heat, with that of final drive and propeller shaft, a mean over mesh cycles, W",
    "left.shaft_torque_min": "map: the least left torque of a mesh cycle; stuck: that at which the left wheel breaks loose ahead, N·m",
    "left.shaft_torque_max": "map: the greatest left torque of a mesh cycle; stuck: that at which the right wheel breaks loose ahead, N·m",
    "torque_bias_ratio": "T_high/T_low (SAE J2817), stuck: where the right wheel breaks loose ahead; empty where the torques "
                             "oppose each other or one is below 0.1 N·m",
    "locking_value [%]": "100 (TBR − 1)/(TBR + 1): the difference of the torques over their sum, at most 100; empty where there is no "
                          "ratio",
}
HEAD = list(MEANINGS)
BETWEEN = ("between points of the map TL − TR, T − TL − TR and (P + (TL − TR) s/2) / (|w| + |s|/2) are linear; T, w carrier torque "
           "and speed, s speed_difference, TL, TR, P torques and loss")
# smallest efficiency in the table of a block
LEAST = 0.01
# meaning of eta_tbl, for readers of the script
CONVENTION = [
    f"% eta is power out over power in, without a difference of wheel speeds, at least {LEAST:g}: for torque in the direction of the",
    "% speed wheels over carrier, 1 - P/(T w); for torque against the speed (overrun) carrier over wheels, |T w|/(|T w| + P).",
    "% The blocks' documentation names one table for both signs and no exchange of input and output; that of the Gearbox block, which",
    "% reads the same table, multiplies the torque by eta. For losses in overrun take the n-D tables below, right for both signs.",
]
# a fraction of the power below this is rounding
ROUNDING = 1e-6
# a torque below this counts as zero, N·m: the usual bound allows this error of the map
NONE = 0.1


def bias(left: float, right: float) -> tuple[float | None, float | None]:
    """Torque bias ratio T_high/T_low and locking value 100 (TBR − 1)/(TBR + 1) in % of two torques (SAE J2817). Both are None if the
    torques oppose each other or if one is below NONE, because their difference over a vanishing sum means nothing."""
    low, high = sorted(map(abs, (left, right)))
    if low < NONE or left * right < 0.0:
        return None, None
    return high / low, 100.0 * (high - low) / (high + low)


def save(result: MeasuredMap, file: FileName) -> Path:
    """Writes points of the map, stuck points and unseen points. Ratio and effect of a stuck point are those at breakaway."""
    return write(file, HEAD, _rows(result), result.error, result.scene.name, BETWEEN)


def _rows(result: MeasuredMap) -> Iterator[list[object]]:
    at = grid_points(result.lines)
    for sign, values in zip(SIGNS, result.slipping):
        for point, figures in zip((at * [1.0, 1.0, sign, 1.0]).reshape(-1, 4), values.reshape(-1, values.shape[-1])):
            yield _row("map", point, figures.tolist(), figures[:2])
    still = grid_points([*result.lines[:2], np.zeros(1), result.lines[3]])
    for point, figures in zip(still.reshape(-1, 4), result.stuck.reshape(-1, result.stuck.shape[-1])):
        left = figures[4]
        yield _row("stuck", point, figures.tolist(), (left, figures[0] + figures[1] - left))
    for point, figures in zip(result.unseen, result.found):
        yield _row("unseen", point, [*figures.tolist(), "", ""], figures[:2])


def _row(kind, point, figures, torques):
    return [kind, *point.tolist(), *figures, *("" if one is None else float(one) for one in bias(*torques))]


def save_for_simulink(result: MeasuredMap, file: FileName) -> Path:
    """Writes a MATLAB script with the arrays for the masks of blocks and for n-D Lookup Tables."""
    torque, speed, slip, temperature = result.lines
    share = _efficiencies(result)
    # over the signed difference, including the stuck means at 0
    slips = np.concatenate([-slip[::-1], [0.0], slip])
    whole = np.concatenate([result.slipping[1][:, :, ::-1], result.stuck, result.slipping[0]], axis=2)[..., :MAPPED]
    torques = torques_of(whole, grid_points([torque, speed, slips, temperature]))
    text = [
        f"% Loss map of {result.scene.name}, SI (N.m, rad/s, K, W); {result.error}.",
        "% Axes are those of the carrier. With a final drive of ratio i: torques / i, speeds * i.",
        "% Blocks Open Differential and Limited Slip Differential, Efficiency factors = Driveshaft torque, temperature and speed:",
        *CONVENTION,
        *(f"% {text}." for text in [lossless(result)] if text),
        _vector("Trq_bpts", torque), _vector("omega_bpts", speed), _vector("Temp_bpts", temperature),
        _array("eta_tbl", np.clip(share, LEAST, 1.0)),
        *_coupling(result),
        "% n-D Lookup Tables, linear, over torque T, speed w, slip s = left - right, temperature; of the torques left and right TL, TR",
        "% and the loss P: locking = TL - TR, dragging = T - TL - TR, P = -locking s/2 + lost (|w| + |s|/2):",
        _vector("slip_bpts", slips),
        *(_array(f"{name}_tbl", torques[..., index]) for index, name in enumerate(("locking", "dragging", "lost"))),
    ]
    write_whole(file, "\n".join(text) + "\n")
    return Path(file)


def lossless(result: MeasuredMap) -> str:
    """Reason why all values of eta_tbl are 1; empty if some are below."""
    if np.any(_efficiencies(result) < 1.0 - ROUNDING):
        return ""
    return ("eta_tbl is 1 everywhere, because the scene has no drag, so that nothing is lost without a difference of wheel speeds; the losses "
            "by a difference are in locking_tbl and lost_tbl")


def _efficiencies(result):
    """Efficiencies without a difference of wheel speeds, shape (torques, speeds, temperatures)."""
    torque, speed, _, temperature = result.lines
    return efficiency(grid_points([torque, speed, np.zeros(1), temperature]), result.stuck[..., :MAPPED])[:, :, 0]


def _coupling(result):
    """Lines with the tables of the coupling torque, or with the reason why there are none."""
    if why := coupling.left_out(result):
        return [f"% Limited Slip Differential: no table of the coupling torque, because {why}."]
    torque, speed, slip, warmth = (f"{line[index]:.6g} {unit}" for line, index, unit in
                                   zip(result.lines, coupling.middle(result), ("N.m", "rad/s", "rad/s", "K")))
    (slips, of_slip), (inputs, of_input) = coupling.over_slip(result), coupling.over_input(result)
    found = [
        "% Limited Slip Differential. The coupling torque is the difference of the axle torques, T2 - T1, of both clutches together: each",
        "% axle gets half of it. The slip is half the difference of the axle speeds, (w1 - w2)/2. Axle 1 is the left one. A final drive of",
        "% ratio i changes only Tin, which is then Tin / i.",
        f"% Slip speed dependent torque data, dwT in rad/s and Tdw in N.m, at {torque}, {speed}, {warmth}. The differential sticks at",
        "% slip 0, so dry friction has its full torque from the next slip on:",
        _vector("dwT", slips), _vector("Tdw", of_slip),
    ]
    if len(inputs) < coupling.FEWEST:
        return [*found, "% Input torque dependent torque data: left out, because the map has a single torque; give more by --torque."]
    return [*found, f"% Input torque dependent torque data, Tin and TTin in N.m, at {speed}, {warmth} and a difference of {slip}:",
            _vector("Tin", inputs), _vector("TTin", of_input)]


def _vector(name, values):
    return f"{name} = [{' '.join(f'{value:.9g}' for value in values)}];"


def _array(name, values):
    # in MATLAB the first axis changes fastest
    return f"{name} = reshape([{' '.join(f'{value:.9g}' for value in values.ravel(order='F'))}], [{' '.join(map(str, values.shape))}]);"
