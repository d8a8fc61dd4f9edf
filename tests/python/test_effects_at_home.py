"""Code of the library names an effect only in the effect's own files, except where a reason is given."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "src"
# files of effects: their declarations and forces, temperatures, tooth errors, and laws of tooth friction
HOMES = ("model/effects/", "model/thermal/", "contact/errors/", "friction/")
# files that name effects, with the names and the reason
EXCEPTIONS = {
    "model/assembly/body_effects.rs": ({"half_shaft"}, "ideal gears with no effect but half-shafts have a fast path"),
    "model/assembly/model.rs": ({"strength"}, "the rating follows from gears, which only the model knows"),
    "model/assembly/solid.rs": ({"tooth_errors"}, "solid teeth include their errors directly"),
    "model/outputs/forces.rs": ({"strength"}, "stresses share the evaluation of the teeth with the forces"),
    "model/readings/reports.rs": ({"coupling_advice", "strength", "tooth_friction", "warm_up"}, "warnings need the present forces"),
    "model/run/coupling.rs": ({"coupling_advice", "half_shaft"}, "records the exchange at the ports, which may be behind half-shafts"),
    "model/run/effort.rs": ({"bearing_drag", "thrust_friction"}, "remedies for rattle"),
    "model/run/events.rs": ({"tooth_fault"}, "a broken tooth changes the equations at a time"),
    "model/run/watching.rs": ({"coupling_advice", "mesh_history", "strength"}, "memories at the start, and steps that they record"),
    "model/setup/advice.rs": ({"body_compliance", "wheel_brake"}, "advice on settings of the whole scene"),
    "model/start/preload.rs": ({"half_shaft"}, "half-shafts are wound up at the start"),
    "variables/unset.rs": ({"lock"}, "an effect without a switch is on if its input commands it"),
}
LIST = re.search(r"effects! \{\n    switched \{(.*?)\n    \}\n    commanded \{(.*?)\n    \}",
                 (SOURCES / "model/effects/mod.rs").read_text(encoding="utf-8"), re.S)
EFFECTS = re.findall(r"^\s+(\w+):", LIST[1] + LIST[2], re.M)
ANY = "|".join(EFFECTS)
# fields of switches, parameters and memories, modules, and names of variables in texts
NAMES = re.compile(rf'\b(?:effects|specs|memories)\s*\.\s*({ANY})\b|\beffects::(?:\{{[^}}]*\b)?({ANY})\b'
                   rf'|"(?:effects\.)?({ANY})(?:\.\w+)?"|"[^"\n]*\beffects\.({ANY})\b|"[^"\n]*\b({ANY})\.\w')


def code(text):
    """Text without comments and unit tests."""
    return re.sub(r"//[^\n]*", "", text.partition("#[cfg(test)]\nmod tests {")[0])


def named_in(text):
    return {next(filter(None, found.groups())) for found in NAMES.finditer(code(text))}


def test_effects_are_named_only_at_home_and_where_a_reason_is_given():
    found = {}
    for file in SOURCES.rglob("*.rs"):
        path = file.relative_to(SOURCES).as_posix()
        if not path.startswith(HOMES) and "/tests/" not in path and (names := named_in(file.read_text(encoding="utf-8"))):
            found[path] = names
    assert found == {path: names for path, (names, _) in EXCEPTIONS.items()}
    assert len(EXCEPTIONS) <= 12 and all(reason for _, reason in EXCEPTIONS.values())


@pytest.mark.parametrize("text", ["p.effects.half_shaft", "specs . lock", "use crate::model::effects::warm_up::X;", '"strength.rate_from"',
                                  '"set effects.tooth_errors = true"', "memories.mesh_history"])
def test_a_name_is_detected(text):
    assert len(named_in(text)) == 1 and not named_in(f"// {text}")
