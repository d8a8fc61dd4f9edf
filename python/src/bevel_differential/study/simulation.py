"""Simulation and evaluation of the study's two cases."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..answers import Progress
from ..differential import Differential
from ..fmu import Fmu
from ..scene import Scene
from ..values import DifferentialError
from ..writing import whole
from .stated import CASES, DURATION, INTERVAL, Case
from .theory import Expected, Theory

MESH_OUTPUTS = ["left_normal_force", "right_normal_force", "left_pairs", "right_pairs", "pin_force", "thrust_force",
                "left_transmission_error", "right_transmission_error"]
OUTPUTS = [
    *(f"carrier.{name}" for name in ["angle", "speed", "torque"]),
    *(f"{side}.{name}" for side in ["left", "right"]
      for name in ["angle", "speed", "shaft_torque", "tangential_force", "normal_force", "thrust_force"]),
    "planet[1].spin_speed",
    *(f"planet[1].{name}" for name in MESH_OUTPUTS),
    "mesh.frequency", "power.in", "power.out", "power.loss", "heat.contact",
    "solver.steps", "solver.rhs_calls", "solver.step_size", "solver.energy_residual",
]
# lines of the spectrum count above LINE_SHARE times the strongest line and above LINE_FLOOR times the mean force
LINE_SHARE = 0.02
LINE_FLOOR = 1e-6
# length of the record [s], and mesh periods of the turn in the window at its end from which the spectrum is calculated
RECORD, SPECTRUM_PERIODS = 2.0, 10.0
# length and interval of the record of the start [s]: the teeth meet and settle within it, and move at some 10 kHz
START_RECORD, START_INTERVAL = 1e-3, 1e-6
# after the start, speeds within this fraction of theory count as settled
SETTLED_BAND = 0.01


@dataclass
class Run:
    """Simulated case. `record`, `start`: outputs at every communication point of the whole run, and of its beginning; `spectrum`:
    amplitudes of forces; `results`: numbers for the comparison."""

    case: Case
    expected: Expected
    record: np.ndarray
    start: np.ndarray
    spectrum: dict[str, np.ndarray]
    results: dict[str, Any]


def simulate_cases(fmu: Fmu, folder: Path, progress: Progress) -> dict[str, Run]:
    """Simulates both cases, writes their records into `folder`, and returns the runs by case."""
    forms, runs = Theory(start_values(fmu)), {}
    window = SPECTRUM_PERIODS / forms.expected(CASES["turning"]).mesh_frequency
    for index, (name, case) in enumerate(CASES.items()):
        progress(index / len(CASES), name)
        expected = forms.expected(case)
        with Differential(Scene.load(case.scene, fmu=fmu).values, fmu=fmu) as differential:
            try:
                record = differential.run(outputs=OUTPUTS, stop=RECORD, step=INTERVAL)
                start = differential.run(outputs=OUTPUTS, stop=START_RECORD, step=START_INTERVAL)
            except DifferentialError as error:
                raise DifferentialError(f"the {name} case fails: {error}", kind=error.kind) from error
        spectrum = force_spectra(record, window)
        runs[name] = Run(case, expected, record, start, spectrum, evaluate(expected, record, start, spectrum))
        write_csv(folder / f"{name}.csv", cut(record), fmu.variables)
        write_csv(folder / f"{name}_start.csv", start, fmu.variables)
    write_spectra(folder / "force_spectrum.csv", {name: run.spectrum for name, run in runs.items()})
    return runs


def start_values(fmu: Fmu) -> dict[str, Any]:
    """Start values of parameters and inputs, SI, by name."""
    return {name: variable.start for name, variable in fmu.variables.items()}


def cut(record):
    """Part of a record within the study's duration."""
    return record[record["time"] <= DURATION + 1e-9]


def settled_part(record, frequency):
    """Settled part of the record within the study's duration: the second half straight ahead, the last whole mesh periods in the
    turn."""
    own = cut(record)
    begin = DURATION / 2.0
    if frequency > 0.0:
        begin = DURATION - np.floor(DURATION * frequency - 0.5) / frequency
    # whole periods: the last sample is the first one of the next period
    return own[(own["time"] > begin - 1e-9) & (own["time"] < DURATION - 1e-9)]


def evaluate(expected, record, start, spectrum):
    """Means over the settled part, and values of the start from its finely sampled record. Speeds in deg/s, otherwise SI; ripple in
    % from peak to peak."""
    own, part = cut(record), settled_part(record, expected.mesh_frequency)
    speeds = [np.degrees(part[f"{side}.speed"]) for side in ["left", "right"]]
    throughput = np.mean(np.abs(part["power.in"])) * DURATION
    peak_side = max(["left", "right"], key=lambda side: np.max(start[f"{side}.tangential_force"]))
    peak = start[f"{peak_side}.tangential_force"]
    return {
        "side_speeds": [float(np.mean(s)) for s in speeds],
        "ripple": [float(100.0 * np.ptp(s) / abs(np.mean(s))) for s in speeds],
        "carrier_speed": float(np.degrees(np.mean(part["carrier.speed"]))),
        "normal_force": [float(np.mean(part[f"planet[1].{side}_normal_force"])) for side in ["left", "right"]],
        "tangential_force": [float(np.mean(part[f"{side}.tangential_force"])) for side in ["left", "right"]],
        "peak_tangential_force": float(np.max(peak)),
        "peak_time": float(start["time"][np.argmax(peak)]),
        "mesh_frequency": float(np.mean(part["mesh.frequency"])),
        "first_line": first_line(spectrum, float(np.mean(part["left.normal_force"]))),
        "settled_after": settling_time(start, expected.side_speeds),
        "steps": float(own["solver.steps"][-1]),
        "relative_energy_residual": float(own["solver.energy_residual"][-1] / throughput),
    }


def settling_time(start, expected):
    """Last time at which a speed deviated from its theoretical value by more than `SETTLED_BAND`."""
    speeds = zip(["left", "right"], expected)
    far = [np.abs(np.degrees(start[f"{side}.speed"]) / speed - 1.0) > SETTLED_BAND for side, speed in speeds]
    outside = np.any(far, axis=0)
    return float(start["time"][outside][-1]) if np.any(outside) else 0.0


def force_spectra(record, window):
    """Amplitudes of the forces over the last `window` [s] of the record. The window contains whole mesh periods of the turn, so a
    rectangular window causes no leakage."""
    count = round(window / INTERVAL)
    part = record[-count - 1:-1]
    spectra = {"frequency": np.fft.rfftfreq(count, INTERVAL)}
    for name in ["left.normal_force", "right.normal_force", "left.thrust_force", "right.thrust_force",
                 "left.tangential_force"]:
        amplitude = 2.0 / count * np.abs(np.fft.rfft(part[name]))
        # the mean and, in an even count, the highest frequency have no mirror image
        amplitude[[0, -1] if count % 2 == 0 else 0] /= 2.0
        spectra[name] = amplitude
    return spectra


def first_line(spectra, mean_force):
    """Lowest frequency of a line in the spectrum of the left normal force, or None without a line."""
    amplitude = spectra["left.normal_force"][1:]
    threshold = max(LINE_SHARE * np.max(amplitude), LINE_FLOOR * mean_force)
    lines = np.flatnonzero(amplitude >= threshold)
    return float(spectra["frequency"][1:][lines[0]]) if len(lines) else None


def write_csv(path, record, variables):
    """Writes a record in display units, with the units in the header."""
    columns = [("time [s]", record["time"])]
    for name in record.dtype.names[1:]:
        unit, values = variables[name].shown(record[name])
        columns.append((f"{name} [{unit or 1}]", values))
    save(path, columns)


def write_spectra(path, spectra):
    columns = [("frequency [Hz]", spectra["straight"]["frequency"])]
    for case, spectrum in spectra.items():
        columns += [(f"{case} {name} [N]", spectrum[name]) for name in spectrum if name != "frequency"]
    save(path, columns)


def save(path, columns):
    header = ",".join(title for title, _ in columns)
    with whole(path) as part:
        np.savetxt(part, np.column_stack([values for _, values in columns]), delimiter=",", header=header, comments="",
                   fmt="%.10g")
