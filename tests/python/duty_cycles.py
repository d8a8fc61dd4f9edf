"""Duty cycles for tests."""

from pathlib import Path

from bevel_differential.spectrum import spectrum

ROOT = Path(__file__).resolve().parents[2]
DUTY_CYCLE = ROOT / "examples" / "design" / "duty_cycle.csv"
VEHICLE = {"wheel_radius": "334 mm", "track": "1.55 m"}
HEAD = "name,count,duration [s],speed [km/h],turn_radius [m],torque [N.m]"
ROOTS, FLANKS = ["damage.planet", "damage.side"], ["damage.planet_flank", "damage.side_flank"]


def spectrum_of(lines, folder, fmu_file, parameters=None, **options):
    """Spectrum for a car of a duty cycle with these lines, which are written to a file in `folder`."""
    file = folder / "cycle.csv"
    file.write_text("\n".join(lines), encoding="utf-8")
    return spectrum(file, {**VEHICLE, **(parameters or {})}, fmu=fmu_file, **options)
