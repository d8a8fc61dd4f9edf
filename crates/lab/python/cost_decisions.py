"""Decisions: the cheapest setting for a quantity of a scene and an accuracy, found by `accuracy`. Writes decisions.csv."""

import math

from bevel_differential import accuracy
from bevel_differential.scene_file import find, read_scene
from bevel_differential.text import markdown
from tools import percent, say, significant, write_measured

# representative questions: description, scene, wanted quantity, accuracy
ALL = [
    ("mean speed in a turn", "study_turning", "left.speed:mean", 0.01),
    ("mean force of a mesh", "study_turning", "planet[1].left_normal_force:mean", 0.01),
    ("largest force of a mesh", "study_turning", "planet[1].left_normal_force:max", 0.05),
    ("ripple of a speed", "study_turning", "left.speed:peak_to_peak", 0.05),
    ("deflection: mean", "study_turning", "planet[1].left_transmission_error:mean", 0.05),
    ("noise: first mesh order", "study_turning", "planet[1].left_transmission_error:mesh_order_1", 0.05),
    ("torque bias", "torque_bias", "torque_bias_ratio:mean", 0.01),
    ("losses", "torque_bias", "efficiency:mean", 0.001),
    ("peak torque of a clunk", "clunk", "left.shaft_torque:max", 0.01),
    ("torque of a slipping wheel", "limited_slip", "left.shaft_torque:rms", 0.01),
    ("speed of a wheel on ice", "one_wheel_on_ice", "left.wheel_speed:max", 0.01),
]
COLUMNS = ["quantity", "scene", "want", "accuracy", "gears", "effects", "solver", "error", "stray", "real_time", "price",
           "reference_price"]
HEAD = ["quantity", "within", "gears", "effects", "tolerance", "error", "× real time"]
QUESTION = ["quantity", "scene", "`--want`"]
TITLE = "The cheapest setting by quantity, each found and checked by `bevel-differential accuracy`"


def decisions(folder, count, begin, end):
    """Answers the first `count` questions, writes the file, and returns the table; the bar moves from `begin` to `end`."""
    rows, table, questions = [COLUMNS], [HEAD], [QUESTION]
    for place, (quantity, name, want, within) in enumerate(ALL[:count]):
        stop = read_scene(find(name))["stop"]
        # the start is a transient
        start = 0.1 * stop if name == "study_turning" else None
        found = accuracy(name, want, within, from_=start, progress=lambda done, what, place=place, quantity=quantity: say(
            begin + (end - begin) * (place + min(done, 1.0)) / count, f"{quantity}: {what}"))
        if found.use is None:
            continue
        run, stray = found.use.run, found.reference.error
        gears, _, rest = run.setting.partition(" with ")
        effects, _, solver = rest.partition("; ")
        effects = "" if effects == "no effect" else effects
        rows.append([quantity, name, want, within, gears, effects.replace(", ", " "), solver, run.error, stray,
                     stop / run.seconds if run.seconds else math.nan, run.price, found.reference.price])
        error = percent(run.error) + (f"; two runs of the richest model differ by {percent(stray)}" if found.uncertain else "")
        questions.append([quantity, f"`{name}{f' --from {start:g}s' if start else ''}`", f"`{want}`"])
        # without teeth and effects, the motion has a closed form
        tolerance = solver.removeprefix("tolerance ") if effects or gears != "ideal" else "–"
        table.append([quantity, f"{100.0 * within:g} %", gears, effects or "–", tolerance, error,
                      significant(stop / run.seconds, 2) if run.seconds else ""])
    write_measured(folder / "decisions.csv", ["error: of the chosen setting against the richest model, as a fraction"], rows)
    return (f"{TITLE}:\n\n{markdown(table, range(len(HEAD)))}\nThe questions to `accuracy`:\n\n"
            f"{markdown(questions, range(len(QUESTION)))}")
