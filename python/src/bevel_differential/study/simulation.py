"""The study's two cases: simulated, evaluated and drawn."""

import time
from pathlib import Path
from typing import Any

import numpy as np

from ..answers import Progress
from ..differential import Differential
from ..values import DifferentialError, FileName
from ..writing import whole
from . import figures

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
# a spectral line counts above LINE_SHARE times the strongest line and above LINE_FLOOR times the mean force
LINE_SHARE = 0.02
LINE_FLOOR = 1e-6
# share of the progress bar for drawing the figures
FIGURES_SHARE = 0.15


def simulate_cases(request: dict[str, Any], fmu: FileName | None, folder: Path, progress: Progress) -> dict[str, Any]:
    """Simulates both cases, writes their records and pictures into `folder`, and returns the evaluated figures by case.

    `request`: cases and times as the library of answers gives them."""
    runs = {}
    for index, case in enumerate(["straight", "turning"]):
        progress((1.0 - FIGURES_SHARE) / 2.0 * index, case)
        with Differential(fmu=fmu) as differential:
            begin = time.perf_counter()
            record = simulate_case(differential, request, case, request["record"], request["interval"])
            seconds = time.perf_counter() - begin
            start = simulate_case(differential, request, case, request["start_record"], request["start_interval"])
            variables = differential.fmu.variables
        runs[case] = {"record": record, "start": start, "spectrum": force_spectra(record, request)}
        runs[case]["results"] = evaluate(runs[case], request, case) | {"seconds_per_second": seconds / request["record"]}
        write_csv(folder / f"{case}.csv", cut(record, request["duration"]), variables)
        write_csv(folder / f"{case}_start.csv", start, variables)
    write_spectra(folder / "force_spectrum.csv", {case: run["spectrum"] for case, run in runs.items()})
    drawings = [figures.speeds, figures.tooth_forces, figures.force_spectrum]
    for index, draw in enumerate(drawings):
        progress(1.0 - FIGURES_SHARE * (1.0 - index / len(drawings)), f"drawing {draw.__name__}.png")
        draw(folder, request, runs)
    return {case: run["results"] for case, run in runs.items()}


def simulate_case(differential, request, case, duration, interval):
    """A record of a case, sampled at every communication point."""
    values = {name: (value, unit) if unit else value for name, (value, unit) in request[case]["start_values"].items()}
    try:
        return differential.set(values).run(outputs=OUTPUTS, stop=duration, step=interval)
    except DifferentialError as error:
        raise DifferentialError(f"the {case} case fails: {error}", kind=error.kind) from error


def cut(record, end):
    return record[record["time"] <= end + 1e-9]


def settled_part(record, request, case):
    """The settled part of the record over the study's duration: straight ahead the second half, in the turn the last whole mesh
    periods."""
    own = cut(record, request["duration"])
    frequency = request[case]["mesh_frequency"]
    begin = request["duration"] / 2.0
    if frequency > 0.0:
        begin = request["duration"] - np.floor(request["duration"] * frequency - 0.5) / frequency
    # whole periods: the last sample is the first one of the next period
    return own[(own["time"] > begin - 1e-9) & (own["time"] < request["duration"] - 1e-9)]


def evaluate(run, request, case):
    """Means over the settled part, and figures of the start from its finely sampled record."""
    record, start = run["record"], run["start"]
    own, part = cut(record, request["duration"]), settled_part(record, request, case)
    speeds = [np.degrees(part[f"{side}.speed"]) for side in ["left", "right"]]
    throughput = np.mean(np.abs(part["power.in"])) * request["duration"]
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
        "first_line": first_line(run["spectrum"], float(np.mean(part["left.normal_force"]))),
        "settled_after": settling_time(start, request[case]["side_speeds"], request["settled_band"]),
        "steps": float(own["solver.steps"][-1]),
        "relative_energy_residual": float(own["solver.energy_residual"][-1] / throughput),
    }


def settling_time(start, expected, band):
    """Last time at which a speed was off its theoretical value by more than the fraction `band`."""
    speeds = zip(["left", "right"], expected)
    far = [np.abs(np.degrees(start[f"{side}.speed"]) / speed - 1.0) > band for side, speed in speeds]
    outside = np.any(far, axis=0)
    return float(start["time"][outside][-1]) if np.any(outside) else 0.0


def force_spectra(record, request):
    """Amplitudes of the forces over the end of the record. The window has whole mesh periods of the turn, so a rectangular window
    leaks nothing."""
    count = round(request["spectrum_window"] / request["interval"])
    part = record[-count - 1:-1]
    spectra = {"frequency": np.fft.rfftfreq(count, request["interval"])}
    for name in ["left.normal_force", "right.normal_force", "left.thrust_force", "right.thrust_force",
                 "left.tangential_force"]:
        amplitude = 2.0 / count * np.abs(np.fft.rfft(part[name]))
        # neither the mean nor, in an even count, the highest frequency has a mirror image
        amplitude[[0, -1] if count % 2 == 0 else 0] /= 2.0
        spectra[name] = amplitude
    return spectra


def first_line(spectra, mean_force):
    """Lowest frequency of a line in the spectrum of the left normal force; None where no line stands out."""
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
