"""The page survives a library that fails."""


def test_a_worker_that_traps_is_started_anew_with_the_set_up_kept(fresh):
    live = fresh("scene=study_straight", ["failing.js", "trap.js"])
    assert "over" in live.answer() and live.message() == ""
    assert live.ask("ear.workers") == 1
    answer = live.put("geometry.module", "4.75")
    # text of the JavaScript engine for the instruction "unreachable"
    assert answer["trap"] == "unreachable"
    live.wait("!document.getElementById('message').hidden")
    assert "restarted" in live.message() and "your set-up is kept" in live.message() and "unreachable" in live.message()
    assert live.ask("ear.workers") == 2
    assert live.control("geometry.module").input_value() == "4.75" and live.link()["geometry.module"] == "0.00475"
    answer = live.put("geometry.planet_count", "4")
    assert "over" in answer and live.message() == "" and live.ask("ear.workers") == 2
    assert live.value("geometry.module") == 0.00475 and live.ask("page.record.count") == answer["points"]
