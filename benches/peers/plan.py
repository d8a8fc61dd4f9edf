"""Settings to run: enough to show convergence of the ripple with smaller steps or tolerances."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A row of the table: one tool with one setting, run on both cases."""

    group: str
    """Rows of a group differ in one number; the last one is the finest, with which the others are compared."""
    label: str
    script: str
    needs: str | None
    """Python package that the row needs, or None."""
    settings: dict
    quick: bool = False
    """True if the row is in the short form."""
    repeats: int = 3


def mujoco(step, quick=False, many_points=False, facets=16, at_once=False):
    name = "MuJoCo, several points" if many_points else "MuJoCo, one point"
    name += "" if facets == 16 else f", {facets} facets"
    name += ", load at once" if at_once else ""
    return Row(name, f"step {1e3 * step:g} ms", "mujoco_case.py", "mujoco",
               {"step": step, "facets": facets, "many_points": many_points, "at_once": at_once}, quick)


def drake(contact, step, facets, quick=False, repeats=3):
    return Row(f"Drake, {contact}, {facets} facets", f"step {1e3 * step:g} ms", "drake_case.py", "pydrake",
               {"step": step, "facets": facets, "contact": contact}, quick, repeats)


def tooth(law, tolerance, quick=False):
    exponent = f"{tolerance:.0e}".replace("e-0", "e-")
    return Row(f"this program, `tooth`, `{law}`", f"tolerance {exponent}", "this_program.py", None,
               {"contact": "tooth", "law": law, "tolerance": tolerance}, quick)


def simpler(contact):
    return Row(f"this program, `{contact}`", "tolerance 1e-6", "this_program.py", None,
               {"contact": contact, "tolerance": 1e-6}, True)


ROWS = [
    *(tooth("impact", tolerance, tolerance == 1e-6) for tolerance in (1e-4, 1e-6, 1e-8)),
    *(tooth("line", tolerance, tolerance == 1e-6) for tolerance in (1e-4, 1e-6, 1e-8)),
    simpler("lumped"),
    simpler("ideal"),
    *(mujoco(step, quick=step == 2e-4) for step in (1e-3, 5e-4, 2e-4, 1e-4)),
    mujoco(2e-4, facets=64),
    # shows an effect that means hide: it skips teeth
    mujoco(2e-4, at_once=True),
    *(mujoco(step, many_points=True) for step in (5e-4, 2e-4, 1e-4)),
    drake("hydroelastic", 1e-3, 8, quick=True),
    # these two show if the row above has converged; their cost matters less, and they take long
    drake("hydroelastic", 5e-4, 8, repeats=1),
    drake("hydroelastic", 1e-3, 24, repeats=1),
    *(drake("point", step, 16) for step in (2e-4, 1e-4)),
]
