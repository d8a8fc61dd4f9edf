"""The guided walk."""

from bevel_differential import Scene


def test_the_walk_has_five_steps_and_each_runs_its_scene(live, found, scene_names):
    live.page.locator("#walk-open").click()
    scenes, texts = [], set()
    for step in range(5):
        live.wait("place => document.querySelector('[data-walk=place]').textContent === place", f"{step + 1} of 5")
        name = live.link()["scene"]
        live.wait("name => page.setup.scene.name === name", name)
        answer = live.answer()
        assert "over" in answer, f"{name}: {answer}"
        record = live.record(["carrier.speed"])
        assert record["time"][-1] == Scene.load(name).stop
        assert live.page.locator("#scene").input_value() == name
        shown = live.ask("[...document.querySelectorAll('.legend span')].map((each) => each.title)")
        assert sorted(shown) == sorted(live.link()["show"].split(" "))
        scenes.append(name)
        texts.add(live.page.locator("[data-walk=text]").inner_text())
        assert live.page.locator("[data-walk=back]").is_disabled() == (step == 0)
        live.page.locator("[data-walk=next]").click()
    assert not live.page.locator("#walk").is_visible()
    assert len(set(scenes)) == len(texts) == 5 and {*scenes} <= {*scene_names}
    found(", ".join(scenes))
