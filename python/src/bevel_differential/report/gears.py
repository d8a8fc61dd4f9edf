"""Gears of a scene: drawings and a table with the symbols of ISO 23509."""

import math
from dataclasses import replace

from ..pair import Pair
from . import drawings, words
from .blocks import Section, Table
from .simulated import Simulated
from .svg_style import picture

GEARS = ("planet", "side")
# face width over outer cone distance of cut gears, at most
USUAL_FACE = 1.0 / 3.0


def section(run: Simulated) -> Section:
    """Section with both drawings and the table."""
    pair = pair_of(run)
    found = Section("gears", "The gears")
    found.add(picture("section", [[drawings.section(pair)]], _section_caption(pair), 6.0),
              picture("teeth", [[drawings.teeth(run, pair)]], _teeth_caption(run, pair), 4.3))
    found.add(_table(run, pair))
    return found


def pair_of(run: Simulated) -> Pair:
    """Pair with the cones of the FMU."""
    names = [name for name in run.scene.fmu.variables if name.startswith("geometry.")]
    pair = Pair.of({name: run.value(name) for name in names})
    cones = ("pitch", "base", "tip", "root")
    planet, side = (replace(gear, **{cone: run.constant(f"geometry.{name}_{cone}_angle") for cone in cones})
                    for gear, name in zip(pair.gears, GEARS))
    return replace(pair, gears=(planet, side), outer_cone=run.constant("geometry.outer_cone_distance"))


def _deg(angle):
    return words.quantity(math.degrees(angle), "°").replace(" °", "°")


def _section_caption(pair):
    planet, side = pair.gears
    share = pair.face_width / pair.outer_cone
    usual = "" if share <= USUAL_FACE else " Cut gears usually have at most a third of it, forged ones up to half."
    return (f"Axial section: side gears with {side.teeth} teeth on the carrier's axis, two of the {pair.planets} planets with "
            f"{planet.teeth} teeth across it" + ("" if pair.planets == 2 else " (turned into the section)") +
            ". All cones meet in the apex. Teeth (the stronger colour) are between root and tip cone over the face of "
            f"{words.mm(pair.face_width)}, {share:.2f} of the outer cone distance; dashed: pitch cones.{usual} Bodies end at "
            "planes through the root circles, as the FMU has them for masses.")


def _teeth_caption(run, pair):
    planet, side = pair.gears
    lands = [words.mm(pair.land(i)) for i in (0, 1)]
    return ("Planet 1 (above) in mesh with the left side gear at the heel, seen from outside at the end of the run: spherical "
            f"involutes of the base cones {_deg(planet.base)} and {_deg(side.base)}, on the sphere of {words.mm(pair.outer_cone)} "
            f"unrolled about the pitch point. Fillets at the roots are left out. Tip lands {lands[0]} and {lands[1]} wide; "
            f"lash {words.mm(float(run.value('geometry.backlash')))} along the pitch circles; contact ratio "
            f"{words.number(run.constant('geometry.contact_ratio'))}. The dashed line is the line of action of one flank.")


def _table(run, pair):
    of_gears = [("number of teeth", "z", [str(gear.teeth) for gear in pair.gears]),
                ("pitch angle", "δ", [_deg(gear.pitch) for gear in pair.gears]),
                ("face angle (tip cone)", "δ_a", [_deg(gear.tip) for gear in pair.gears]),
                ("root angle", "δ_f", [_deg(gear.root) for gear in pair.gears]),
                ("base angle", "δ_b", [_deg(gear.base) for gear in pair.gears]),
                ("outer pitch diameter", "d_e", [words.mm(pair.module * gear.teeth) for gear in pair.gears]),
                ("outside diameter", "d_ae", [words.mm(pair.module * gear.teeth + 2.0 * gear.addendum * math.cos(gear.pitch))
                                              for gear in pair.gears]),
                ("outer addendum", "h_ae", [words.mm(gear.addendum) for gear in pair.gears]),
                ("outer dedendum", "h_fe", [words.mm(gear.dedendum) for gear in pair.gears]),
                ("bore", "", [words.mm(gear.bore) if gear.bore else "none" for gear in pair.gears]),
                ("mass", "", [words.quantity(run.constant(f"geometry.{name}_mass"), "kg") for name in GEARS])]
    of_pair = [("outer transverse module", "m_et", words.mm(pair.module)), ("normal pressure angle", "α_n", _deg(pair.pressure_angle)),
               ("shaft angle", "Σ", _deg(run.value("geometry.shaft_angle"))), ("face width", "b", words.mm(pair.face_width)),
               ("outer cone distance", "R_e", words.mm(pair.outer_cone)),
               ("mean cone distance", "R_m", words.mm(pair.outer_cone - 0.5 * pair.face_width)),
               ("inner cone distance", "R_i", words.mm(pair.inner_cone)),
               ("outer transverse backlash", "j_et", words.mm(float(run.value("geometry.backlash")))),
               ("contact ratio", "ε_α", words.number(run.constant("geometry.contact_ratio"))),
               ("number of planets", "", str(pair.planets))]
    rows = [(name, symbol, *values) for name, symbol, values in of_gears]
    rows += [(name, symbol, value, value) for name, symbol, value in of_pair]
    return Table(("quantity", "symbol", "planet", "side gear"), rows,
                 "The gears, with the symbols of ISO 23509. Addenda by the rule "
                 f"{run.literal('geometry.addendum_system')}.", left=2)
