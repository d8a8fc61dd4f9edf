"""Wrong uses of single commands: each is one line that names the fault, before any work. test_every_command.py has those of all commands."""

import re
from pathlib import Path

import pytest
from command_line import command
from command_list import SCENE, TOLERANCES, prepare
from refusals import pattern

from bevel_differential.command import WRONG

DUTY_CYCLE = Path(__file__).resolve().parents[2] / "examples" / "design" / "duty_cycle.csv"
SWEEP = "sweep --scene scene.toml --want left.speed --runs 2 --workers 0 --vary left.load_torque=1..2"
# a backlash below 0, a scene without a common output, and a scene without duration
FILES = {"below.toml": TOLERANCES.format(band="0.02 mm +- 0.2 mm").replace("left.load_torque", "geometry.backlash"),
         "apart.toml": SCENE.replace("safety.root_min", "efficiency"), "still.toml": SCENE.replace("stop_time = 0.001", "stop_time = 0"),
         **{f"plan_{key}.toml": f"{key} = {value}" for key, value in
            {"scene": "3", "runs": '"many"', "seed": "1.5", "want": "[3]", "plan": "7", "condition": "[1]", "scen": "1"}.items()}}
# commands, and parts of their messages in their order
CASES = [
    ("swep", "swep … did you mean sweep"),
    ("optimize", "did you mean optimise"),
    ("variable", "did you mean variables"),
    ("loads", "scene … loads --help"),
    ("report", "required: scene"),
    ("run --set geometry.module='4 mm'", "--set … name a scene"),
    ("run clonk", "clonk … did you mean … clunk … study_straight"),
    ("run study_turning --set geometry.module='4 ft'", "geometry.module … ft"),
    ("run study_turning --set planet.count=3", "did you mean geometry.planet_count"),
    ("run study_turning --output wheel.speed", "left.wheel_speed"),
    ("run study_turning --stop '-1 ms'", 'stop_time = "-1 ms": it must be 0 s or more'),
    ("report still.toml", "has no duration"),
    ("accuracy still.toml --want carrier.speed --within 1%", "too short to judge"),
    ("run scene.toml scene.toml", "scene: it is named twice"),
    ("run scene.toml apart.toml", "no output is recorded by all of scene, apart"),
    ("run scene.toml clunkk", "did you mean clunk"),
    ("run scene.toml clunk --output left.sped", "did you mean left.speed"),
    ("sweep --plan all", "--plan … all"),
    ("sweep --vary left.load_torque=1..2", "--scene"),
    ("sweep --plan-file nowhere.toml", "nowhere.toml"),
    ("sweep --scene scene.toml --want left.speed --runs 2", "nothing varies"),
    ("sweep --scene scene.toml --vary left.load_torque=1..2 --runs 2", "nothing is wanted"),
    (f"{SWEEP} --vary left.load_torque=2", "given twice"),
    (f"{SWEEP} --from '0.7 s'", "from … 0.7"),
    (f"{SWEEP} --workers -1", "workers … -1"),
    *((f"sweep --plan-file plan_{key}.toml", f"plan_{key}.toml: {key} is a") for key in ("scene", "runs", "seed", "want", "plan", "condition")),
    ("sweep --plan-file plan_scen.toml", "scen"),
    ("tolerance below.toml --runs 0", "runs = 0"),
    ("spectrum nowhere.csv", "nowhere.csv"),
    (f"spectrum {DUTY_CYCLE} --set contact.law=lin", "contact.law"),
    (f"spectrum {DUTY_CYCLE} --set wheel_radus=0.3", "did you mean wheel_radius"),
    (f"spectrum {DUTY_CYCLE} --scene nowhere", "no scene file 'nowhere'"),
    (f"spectrum {DUTY_CYCLE} --set scene.gear_contact=ideal", "it needs scene.gear_contact"),
    ("optimise light.toml --population 1", "population = 1"),
    ("optimise light.toml --resume", "leave out --resume"),
    ("optimise light.toml --sead 1", "--sead"),
    ("losses clutch.toml --difference='-1 rad/s..1 rad/s'", "above 0"),
    ("losses clutch.toml --bound 2", "2,0.1"),
    ("losses clutch.toml --temperature='-200 degC'", "oil.temperature"),
    ("losses clutch.toml --torque '3 rad'", "N.m"),
    ("bench hotlap", "did you mean hot_lap"),
    ("bench --scene clunk", "name the one test"),
]


@pytest.mark.parametrize("line, message", CASES, ids=[line[:60] for line, _ in CASES])
def test_wrong_use_is_one_line_that_names_the_fault(line, message, folder):
    prepare(folder)
    for name, text in FILES.items():
        Path(name).write_text(text, encoding="utf-8")
    [said] = command(line, WRONG).errors
    assert said.startswith("bevel-differential") and re.search(pattern(message), said), said
