"""Cost of a design by simulated model: final values of a 0.5 s turn in one long step, on one core.

    python crates/lab/python/design_cost.py [--designs N] [--write]

Needs the package with its extra [sweep] and the FMU (BEVEL_DIFFERENTIAL_FMU)."""

import argparse
import statistics

from bevel_differential import Fmu, Scene
from bevel_differential.designs import Space, Task
from bevel_differential.designs.plan import Plan
from bevel_differential.text import aligned, markdown
from laboratory.documents import renew

TURN = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s",
        "geometry.face_width": "17 mm"}
LINE = {"contact.law": "line_weber"}
FRICTION = LINE | {"effects.tooth_friction": True, "effects.thrust_friction": True}
PINS = FRICTION | {"effects.pin_compliance": True}
ERRORS = PINS | {"effects.tooth_errors": True, "tooth_errors.accuracy_grade": 7}
MODELS = {
    "no teeth: `ideal`": {"scene.gear_contact": "ideal", "scene.planet_spin": "free"},
    "a spring per mesh: `lumped`": {"scene.gear_contact": "lumped"},
    "teeth by `impact`": {},
    "teeth by `impact`, tolerance 1e-4": {"solver.relative_tolerance": 1e-4},
    "teeth by `line_weber`": LINE,
    "… with friction of teeth and washers": FRICTION,
    "… and elastic pins": PINS,
    "… and pitch errors of grade 7": ERRORS,
    "teeth by `line_weber` on gear bodies": LINE | {"effects.body_compliance": True},
}
DRAWN = {"loads": {"left.load_torque": "normal(835 N.m, 40 N.m)", "right.load_torque": "normal(835 N.m, 40 N.m)"},
         "loads and module": {"left.load_torque": "normal(835 N.m, 40 N.m)", "geometry.module": "normal(4.5 mm, 0.02 mm)"}}


def cost(fmu, values, vary, designs):
    """Median time of a design [s]."""
    with Scene("turn", stop=0.5, set={**TURN, **values}, fmu=fmu.file) as scene:
        task = Task(scene, ["left.speed", "efficiency"])
        rows = [task.evaluate(*design) for design in Plan.parse(Space.parse(fmu, vary), "random", designs + 1, 1).designs()]
    failed = next((row.message for row in rows if row.message), None)
    assert failed is None, failed
    return statistics.median(row.seconds for row in rows[1:])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--designs", type=int, default=40, help="designs of each kind")
    parser.add_argument("--write", action="store_true", help="renew the table of docs/design.md")
    given = parser.parse_args()
    fmu = Fmu.of()
    rows = [("simulated", *(f"{what} drawn, ms" for what in DRAWN))]
    for what, values in MODELS.items():
        taken = [cost(fmu, values, vary, given.designs) for vary in DRAWN.values()]
        rows.append((what, *(f"{1e3 * seconds:.3g}" for seconds in taken)))
    print("\n".join(aligned(rows, left=1)))
    if given.write:
        renew("docs/design.md", "cost", markdown(rows))


if __name__ == "__main__":
    main()
