"""The page survives a run that hangs."""


def test_a_run_that_hangs_is_stopped_by_the_next_change_with_the_set_up_kept(fresh):
    live = fresh("scene=study_straight", ["failing.js", "hang.js"])
    assert "over" in live.answer() and live.ask("ear.workers") == 1
    live.put("geometry.module", "4.75", "taken", "started")
    # a new worker answers the next change
    answer = live.put("geometry.planet_count", "4")
    assert "over" in answer and live.ask("ear.workers") == 2 and live.message() == ""
    assert live.value("geometry.module") == 0.00475 and live.ask("page.record.count") == answer["points"]
