"""Laws of a tooth pair over gears and loads: difference to the richest model in force, transmission error and ripple."""

import math

import numpy as np

from bevel_differential import Differential, Scene
from bevel_differential.points import from_time
from bevel_differential.text import markdown
from bevel_differential.want import Want
from tools import percent, say

# gear pairs: teeth of planet and side gear, module [m], face width as a fraction of the cone distance, bores [m]
PAIRS = [(10, 16, 4.5e-3, 0.471, 0.0, 0.0), (10, 16, 4.5e-3, 0.3, 16e-3, 30e-3), (12, 20, 3e-3, 0.28, 11e-3, 24e-3),
         (14, 18, 6e-3, 0.3, 22e-3, 40e-3)]
# loads of a wheel, as fractions of the study's torque [N·m] for gears of its size, which is the outer cone distance [m]
LOADS, STUDY_LOAD, STUDY_CONE = (0.1, 0.5, 1.0), 835.0, 42.45e-3
# compared quantities: columns of the table
WANTS = {"mean force": "planet[1].left_normal_force:mean", "largest force": "planet[1].left_normal_force:max",
         "mean transmission error": "planet[1].left_transmission_error:mean",
         "peak to peak": "planet[1].left_transmission_error:peak_to_peak", "ripple of speed": "left.speed:peak_to_peak"}
# laws, with elastic gear bodies if True; the last one is the richest
LAWS = {"`impact`": ("impact", False), "`line`": ("line", False), "`line_weber`": ("line_weber", False),
        "`line` + gear bodies": ("line", True), "`line_weber` + gear bodies": ("line_weber", True)}
# fraction of the turn in which the teeth meet, which is ignored
START = 0.1
TITLE = ("Smallest and largest errors of each law, compared with `line_weber` + gear bodies. The four gear pairs have 10/16 teeth without "
         "bores, and 10/16, 12/20 and 14/18 teeth with bores; their modules are 3 to 6 mm. Loads are 10 to 100 % of the study's load, "
         "scaled to the size of the gears")


def figures(fmu, scene, values, law, bodies):
    """Wanted quantities of a run, each with the size of 100 %."""
    wants = [Want.parse(fmu, text) for text in WANTS.values()]
    names = list(dict.fromkeys(want.name for want in wants))
    with Differential({**values, "contact.law": law, "effects.body_compliance": bodies}, fmu=fmu.file) as turn:
        record = turn.run(outputs=names, stop=scene.stop, step=scene.step)
    record = from_time(record, START * scene.stop, scene.step)
    for want in wants:
        value = want.of(record, values["geometry.planet_teeth"])
        wholes = {"mean": Want.parse(fmu, f"{want.name}:rms").of(record, 1), "max": float(np.abs(record[want.name]).max())}
        yield value, wholes.get(want.statistic.word, value)


def laws(fmu, begin, end):
    """Returns the table; the bar moves from `begin` to `end`."""
    cases = [(pair, load) for pair in PAIRS for load in LOADS]
    *plainer, richest = LAWS.values()
    errors = np.empty((len(cases), len(plainer), len(WANTS)))
    with Scene.load("study_turning", fmu=fmu.file) as scene:
        for place, ((planet, side, module, face, planet_bore, side_bore), load) in enumerate(cases):
            say(begin + (end - begin) * place / len(cases), f"laws, {planet}/{side} teeth")
            cone = 0.5 * module * math.hypot(planet, side)
            torque = load * STUDY_LOAD * (cone / STUDY_CONE) ** 3
            values = {**scene.values, "geometry.planet_teeth": planet, "geometry.side_teeth": side, "geometry.module": module,
                      "geometry.face_width": face * cone, "geometry.planet_bore": planet_bore, "geometry.side_bore": side_bore,
                      "left.load_torque": torque, "right.load_torque": torque}
            reference = list(figures(fmu, scene, values, *richest))
            for law, row in zip(plainer, errors[place]):
                row[:] = [abs(value - wanted) / whole for (value, _), (wanted, whole) in zip(figures(fmu, scene, values, *law), reference)]
    ranges = np.stack([errors.min(axis=0), errors.max(axis=0)], axis=-1)
    rows = [[name, *(f"{percent(least)} … {percent(most)}" for least, most in row)] for name, row in zip(LAWS, ranges)]
    return f"{TITLE}:\n\n{markdown([['law', *WANTS], *rows], range(len(WANTS) + 1))}"
