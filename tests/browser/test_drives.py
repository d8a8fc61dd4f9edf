"""Ordinary drives on the page: its library and the native FMU give identical bits, and the drives meet the requirements.

The drives, their player and their requirements come from `tests/python`."""

import sys

import numpy as np
import pytest

from live import HERE
from node_runs import run_in_node

sys.path += [str(HERE.parents[1] / folder) for folder in ("tests/python", "fmu-build/python")]

from drive_player import READ, Played, play  # noqa: E402
from drive_requirements import judge, method  # noqa: E402
from effects_list import effects  # noqa: E402
from ordinary_drives import drives, sampled, times  # noqa: E402

SEED, DRAWN = 4, 600
CONTACTS = ["ideal", "lumped", "tooth"]
KINDS = {"Enumeration": "Integer"}


def fits(drive, contact):
    """True if the page can play the drive, its gear contact is `contact`, and brakes hold wheels."""
    return (drive["start"]["scene.gear_contact"] == contact and drive["fmi"] == "2.0" and method(drive) == "adaptive"
            and not drive["slopes"] and drive["holds"])


@pytest.fixture(scope="module")
def chosen(fmu):
    """{level of gear contact: drive}, with the first fitting drive of each level that stops from a speed or on a slope."""
    levels = {effect.name: effect.contact for effect in effects(str(fmu.file))}
    drawn = [drive for drive in drives(SEED, DRAWN, levels) if drive["manoeuvre"] in ("stop", "uneven_stop", "hill", "reverse")]
    return {contact: next(drive for drive in drawn if fits(drive, contact)) for contact in CONTACTS}


def assignments(fmu, values):
    """Values as the page passes them to its library."""
    return [{"kind": KINDS.get(variable.kind, variable.kind), "reference": variable.reference, "value": float(number)}
            for variable, number in fmu.numbers(values)]


def scene_of(fmu, drive):
    """Drive as a scene of the page. Inputs change at communication points and are constant between them."""
    points, inputs = times(drive), sampled(drive)
    rows = [dict(zip(inputs, map(float, row))) for row in np.column_stack(list(inputs.values()))]
    changes = [[time, assignments(fmu, row)] for k, (time, row) in enumerate(zip(points.tolist(), rows)) if k == 0 or row != rows[k - 1]]
    return {"stop": float(points[-1]), "step": drive["step"], "set": assignments(fmu, drive["start"] | rows[0]),
            "changes": changes, "tables": [], "slopes": False}


@pytest.fixture(scope="module")
def names(fmu):
    """Outputs that are compared: the outputs for the requirements and all heat."""
    return [*READ, *(v.name for v in fmu.variables.values() if v.causality == "output" and v.name.startswith("heat."))]


@pytest.fixture(scope="module")
def in_node(chosen, names, fmu, page_file, tmp_path_factory):
    references = [fmu.variable(name).reference for name in names]
    scenes = {contact: {"scene": scene_of(fmu, drive), "references": references} for contact, drive in chosen.items()}
    return run_in_node(page_file, tmp_path_factory.mktemp("drives"), scenes)


@pytest.mark.parametrize("contact", CONTACTS)
def test_the_page_plays_an_ordinary_drive_as_the_native_fmu_does(contact, chosen, names, in_node, fmu, found):
    drive = chosen[contact]
    native = play(fmu, drive, tuple(names))
    assert native.failure is None
    columns = dict(zip(["time", *names], in_node[contact]))
    # the page has a second row where inputs change, with the values after the change
    first = np.append(True, np.diff(columns["time"].view(np.float64)) > 0.0)
    assert np.sum(~first) == len(scene_of(fmu, drive)["changes"])
    columns = {name: numbers[first] for name, numbers in columns.items()}
    for name, numbers in {"time": native.time, **native.values}.items():
        bits = np.ascontiguousarray(numbers, np.float64).view(np.uint64)
        assert columns[name].shape == bits.shape, name
        different = np.flatnonzero(columns[name] != bits)
        assert different.size == 0, f"{name}: {different.size} of {bits.size} differ, from {different[:1]}"
    values = {name: columns[name].view(np.float64) for name in names}
    strange = [name for name in names if not np.all(np.isfinite(values[name]))]
    heat = sum(values[name][-1] for name in names if name.startswith("heat."))
    verdict = judge(fmu, drive, played=Played(columns["time"].view(np.float64), values, None, strange, float(heat)))
    assert not verdict.problems, verdict
    found(f"{drive['manoeuvre']} at {contact}: {len(native.time)} × {len(names)}, {verdict.steps} steps, residual {verdict.residual:.0e}")
