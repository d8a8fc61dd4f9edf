"""Scenes run in the page as their files define."""

import re

import numpy as np
import pytest
from bevel_differential import Scene


def communication_points(scene):
    """Number of communication points of a scene: multiples of its step, its end, and the input changes between them."""
    regular = np.append(np.arange(int(scene.stop / scene.step * (1 - 1e-9)) + 1) * scene.step, scene.stop)
    inner = [time for time, _ in scene.changes if np.abs(regular - time).min() > 1e-6 * scene.step]
    return len(regular) + len(inner)


def test_every_scene_runs_to_its_end(live, found, scene_names):
    points = 0
    offered = live.ask("[...document.getElementById('scene').options].map((option) => option.value)")
    assert sorted(offered) == sorted(scene_names)
    for name in scene_names:
        scene = Scene.load(name)
        live.page.locator("#scene").select_option(name)
        live.wait("name => page.setup.scene.name === name", name)
        answer = live.answer()
        assert "over" in answer, f"{name}: {answer}"
        record = live.record(["carrier.speed"])
        times, doubled = record["time"], record["time"][1:][np.diff(record["time"]) == 0.0]
        assert len(np.unique(times)) == communication_points(scene) and len(times) == answer["points"], name
        assert times[0] == 0.0 and times[-1] == scene.stop
        assert np.all(np.diff(times) >= 0.0) and np.all(np.isfinite(record["carrier.speed"]))
        # a change has two rows
        changes = [time for time, _ in scene.changes if 0.0 < time < scene.stop]
        assert all(np.abs(doubled - time).min(initial=np.inf) < 1e-9 for time in changes), name
        assert live.text("about") == scene.description
        assert re.fullmatch(r"[\d.]+(e\d+)? × real time", live.text("speed"))
        points += answer["points"]
    found(f"{len(scene_names)} scenes, {points} points")


DEGREE = np.pi / 180.0


def test_speeds_follow_the_willis_equation_when_a_control_is_changed(live, found):
    # side gear speeds: carrier speed, plus and minus the planet spin times the tooth ratio
    live.go("scene=study_turning&scene.gear_contact=ideal")
    cases = [(954.0, 200.0, 10), (1908.0, 200.0, 10), (1908.0, 400.0, 10), (1908.0, 400.0, 12)]
    for carrier, spin, teeth in cases:
        for name, value in [("carrier.speed_command", carrier), ("spin.command", spin), ("geometry.planet_teeth", teeth)]:
            if live.control(name).input_value() != f"{value:g}":
                answer = live.put(name, f"{value:g}")
                assert "over" in answer, answer
        record = live.record(["left.speed", "right.speed", "carrier.speed"])
        expected = np.add(carrier, [spin * teeth / 16.0, -spin * teeth / 16.0]) * DEGREE
        found_speeds = [record["left.speed"][-1], record["right.speed"][-1]]
        assert np.allclose(found_speeds, expected, rtol=1e-12, atol=0.0), (carrier, spin, teeth)
    found(f"{len(cases)} pairs of speeds")


def outer_cone_distance(module, planet_teeth, side_teeth):
    return 0.5 * module * np.hypot(planet_teeth, side_teeth)


@pytest.mark.parametrize("name, text, gears", [
    ("geometry.module", "5.4", (5.4, 10, 16)), ("geometry.side_teeth", "18", (4.5, 10, 18)),
])
def test_another_module_or_number_of_teeth_draws_other_gears(live, name, text, gears):
    drawn, before = live.ask("[ear.gears.length, ear.gears.at(-1)]")
    answer = live.put(name, text)
    assert "over" in answer, answer
    live.wait("drawn => ear.gears.length > drawn && page.view.differential.reach", drawn)
    planet, side = live.ask("ear.gears.at(-1)")
    # the heels of both gears are on the sphere of the outer cone distance, in single precision
    for gear in (planet, side):
        assert np.isclose(gear["farthest"], outer_cone_distance(*gears), rtol=1e-6)
    assert not np.isclose(before[0]["farthest"], planet["farthest"], rtol=0.05)
    assert np.isclose(live.ask("page.view.differential.reach"), outer_cone_distance(*gears), rtol=1e-6)


def test_another_number_of_planets_draws_as_many(live):
    for count in (4, 2):
        live.put("geometry.planet_count", str(count))
        live.wait("count => page.view.differential.planets?.length === count", count)
