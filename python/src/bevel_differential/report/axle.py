"""Lash at the port of the drive by its source, and natural frequencies of the scene."""

import math

from ..coupling.vibration import SHAFT, vibrations
from ..drive_port import drive_ratio, port_name
from ..lash import closed_dogs, lash_by_source
from ..values import DifferentialError
from . import dogs, words
from .blocks import Block, Section, Table, Text
from .simulated import Simulated, reason_of

# bodies are named if they move at least this fraction of the body that moves most; maximum number of bodies
NAMED, MOST = 0.1, 4


def section(run: Simulated) -> Section:
    """Section with both tables, or with sentences that say why there is none."""
    found = Section("axle", "Lash and natural frequencies")
    found.add(lash(run), *natural_frequencies(run))
    return found


def lash(run: Simulated) -> Block:
    """Table of the lash at the port, or a sentence if there is none."""
    sources, port, ratio = lash_by_source(run.value, run.has_teeth), port_name(run.value), drive_ratio(run.value)
    total = sum(source.angle for source in sources)
    if not total:
        return Text(f"There is no lash between the {port} and the wheels.")
    at_carrier = port == "carrier"
    rows = [(source.source, *_length(source),
             *([] if at_carrier else [_degrees(source.angle / ratio)]), _degrees(source.angle)) for source in sources]
    rows.append(("total", "", "", *([] if at_carrier else [_degrees(total / ratio)]), _degrees(total)))
    head = ("source of lash", "lash, mm", "at radius, mm", "at the carrier, °", *([] if at_carrier else [f"at the {port}, °"]))
    times = "" if at_carrier else f", times the ratio {words.number(ratio)} at the {port}"
    half = " A dog clutch counts with half of its lash, because only one side gear turns by it." if closed_dogs(run.value) else ""
    return Table(head, rows, f"Angles through which the {port} turns freely while both wheels are held: lash over radius{times}. "
                             f"The gears of the differential have their lash at the outer pitch radius of the side gears.{half}")


def _length(source):
    """Texts of lash and radius."""
    if not source.radius:
        return "", ""
    return (words.number(1e3 * source.length), words.number(1e3 * source.radius)) if source.length else ("none", "")


def _degrees(angle):
    return f"{math.degrees(angle):.4f}"


def natural_frequencies(run: Simulated) -> list[Block]:
    """Table of the natural frequencies, or a sentence if nothing vibrates; and a sentence about teeth without load."""
    try:
        result = vibrations(run.scene)
    except DifferentialError as reason:
        return [Text(f"There are no natural frequencies, because the FMU does not start the scene in equilibrium: {reason_of(reason)}.")]
    found: list[Block] = []
    if result.found:
        rows = [(_text(run, one), words.number(one.frequency), words.number(one.damping, 3)) for one in result.found]
        found.append(Table(("bodies that move most", "natural frequency, Hz", "damping ratio"), rows, _caption(run, result)))
    else:
        why = _singly(result) or "no elastic part is between bodies that are free to turn"
        found.append(Text(f"Nothing vibrates at the start of the scene: {why}."))
    if not result.rests:
        found.append(Text("The scene has no equilibrium at the start, so that these numbers are those of a state near it."))
    unloaded = [name for name in result.unloaded if _has_teeth(run, name)]
    if unloaded:
        found.append(Text(f"The teeth of the {words.listed(unloaded)} have no stiffness here, because they are not loaded at the start."))
    for side in dogs.loose(run):
        found.append(Text(f"The {side} half-shaft has no stiffness here, because its dog clutch is open or in its lash at the start."))
    return found


def _has_teeth(run, name):
    return run.has_teeth if name == "differential" else bool(run.value("effects.final_drive") and run.value("final_drive.elastic_mesh"))


def _caption(run, result):
    said = ["Small vibrations about the equilibrium at the start, the slowest first, with undamped frequencies. Behind each body is its "
            "speed relative to the body that moves most; a minus sign means opposite motion."]
    bodies = {body for one in result.found for body, _ in _moving(one)}
    if "planets" in bodies:
        said.append("Planets spin relative to the carrier.")
    if run.value("effects.final_drive") and {"pinion", SHAFT} & bodies:
        said.append(f"Speeds of pinion and propeller shaft are divided by the ratio {words.number(drive_ratio(run.value))}.")
    if result.decaying or result.growing:
        said.append(f"In addition, {_singly(result)}.")
    return " ".join(said)


def _singly(result):
    """Text about the motions that do not swing."""
    parts = [f"{count} motion{'' if count == 1 else 's'} {does if count == 1 else do} without swinging"
             for count, does, do in ((result.decaying, "decays", "decay"), (result.growing, "grows", "grow")) if count]
    return words.listed(parts)


def _moving(vibration):
    return [(body, speed) for body, speed in vibration.shape.items() if abs(speed) >= NAMED][:MOST]


def _text(run, vibration):
    return ", ".join(f"{_named(run, body)} {words.number(speed, 2)}" for body, speed in _moving(vibration))


def _named(run, body):
    """Name of a body, with another body that is rigid with it."""
    if body == "carrier" and run.value("effects.final_drive") and not run.value("final_drive.elastic_mesh"):
        return "carrier with pinion"
    side, _, gear = body.partition(" ")
    if gear == "side gear" and run.literal(f"scene.{side}_drive") == "torque" and not run.value("effects.half_shaft"):
        return f"{body} with wheel" if run.value(f"inertia.{side}_end") else body
    return body
