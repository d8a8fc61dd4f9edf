"""The car with four-wheel drive as SSP archives, run by FMPy and compared with the script.

    python compare.py FMU FOLDER

Builds motor, tyres and body with pythonfmu, and writes archives of SSP 1.0 and 2.0 to FOLDER. Fails if an archive does not conform to its
standard, or if the run deviates from the script by 1 % of the largest value. It needs the packages of `../../drivetrain/requirements.txt`.
"""

import contextlib
import os
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
DRIVETRAIN = HERE.parents[1] / "drivetrain"
sys.path.extend(map(str, (HERE.parent, DRIVETRAIN, HERE / "parts", DRIVETRAIN / "parts")))

import validation  # noqa: E402
from car_structure import structure  # noqa: E402
from car import AXLES, SHAFT, STOP, WHEELS, FourWheelDrive  # noqa: E402
from fmus import make_parts  # noqa: E402
from hosts import fmpy  # noqa: E402
from system import VERSIONS, archive_file, write_ssp  # noqa: E402

# communication step of FMPy, and distance of compared points [s]
STEP, GRID = 1e-4, 1e-2
WITHIN = 0.01
SOURCES = {"Motor": HERE / "parts" / "motor.py", "Tyre": HERE / "parts" / "tyre.py", "Body": HERE / "parts" / "body.py"}
# files that these parts need
NEEDED = [DRIVETRAIN / "parts" / "wheel.py", DRIVETRAIN / "parts" / "vehicle.py"]
# output of the system for each value of the record that parts exchange
SIGNALS = {f"{axle}_{side}.speed": (f"{axle}_axle", f"{side}.wheel_speed") for axle, side in (wheel.split("_") for wheel in WHEELS)} | {
    f"{axle}.propeller_torque": ("centre", f"{SHAFT[axle]}.shaft_torque") for axle in AXLES} | {"body.speed": ("body", "speed")}


def write(fmus, folder, car):
    """Archives of both versions of the standard."""
    for version in VERSIONS:
        write_ssp(archive_file(folder, "four_wheel_drive", version), fmus, structure(car), version)


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: compare.py FMU FOLDER")
    fmu, folder = map(Path, sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    car = FourWheelDrive(fmu=fmu)
    times = GRID * np.arange(1, round(STOP / GRID) + 1)
    # messages of the builder and of FMPy do not belong in the table
    with open(os.devnull, "w") as silence, contextlib.redirect_stdout(silence):
        write(make_parts(fmu, folder / "parts", SOURCES, NEEDED), folder, car)
        wrong = validation.wrong(folder, "four_wheel_drive")
        hosted = fmpy(archive_file(folder, "four_wheel_drive", "1.0"), list(SIGNALS.values()), STEP, times)
    record = car.run()
    print(f"largest deviation of FMPy (all parts at the same time, inputs held, steps of {1e3 * STEP:g} ms), over the largest value:")
    for name, values in zip(SIGNALS, hosted.T):
        own = np.interp(times, record["time"], record[name])
        deviation = np.abs(values - own).max() / np.abs(own).max()
        print(f"    {name:<24}{100.0 * deviation:>8.3f} %")
        if not deviation < WITHIN:
            wrong.append(f"{name}: FMPy deviates from the script by {100.0 * deviation:.2g} %")
    if wrong:
        raise SystemExit("\n".join(wrong))


if __name__ == "__main__":
    main()
