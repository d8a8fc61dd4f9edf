"""The report of a scene: one self-contained file, with figures that show something, for every scene."""

import re
from functools import cache
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from bevel_differential import Scene, shipped_scenes
from bevel_differential.report import runup
from bevel_differential.report.write import write
from command_line import command
from report_page import ReportPage, checked

MOST_BYTES = 5e6
# duration of the first part of a long scene, s; a rattle has two periods in its part
LONGEST = {"drive_cycle": 60.0, "hil": 3.0, "rattle": 0.1}
# figures of a scene with teeth, rolling planets and changing inputs
ALL = {"inputs", "section", "teeth", "outputs", "speeds", "torques", "forces", "error", "waterfall", "pattern", "stress", "bias",
       "power", "worth"}
WITHOUT = {"hil": {"forces", "error", "waterfall", "pattern", "stress", "worth"}, "study_straight": {"inputs"}, "study_turning": {"inputs"},
           "one_wheel_on_ice": {"inputs"}, "torque_bias": {"inputs"}, "rattle": {"bias"},
           "drive_cycle": {"pattern", "waterfall"}}


# scenes with arranged panels and a complete run-up, as for users; the others take half the time
WHOLE = ("study_turning", "locked")

pytestmark = pytest.mark.usefixtures("folder")


def in_haste(patch):
    """Skips the layout of panels and shortens run-ups, to save time."""
    patch.setattr(Figure, "get_layout_engine", lambda _: None)
    patch.setattr(runup, "TURNS", runup.FEWER)


@cache
def text_of(name):
    """Report of a shipped scene."""
    with Scene.load(name) as scene, pytest.MonkeyPatch.context() as patch:
        if name not in WHOLE:
            in_haste(patch)
        scene.stop = LONGEST.get(name, scene.stop)
        return write(scene, "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", shipped_scenes())
def test_every_scene_has_a_report_whose_figures_show_something(name):
    text = text_of(name)
    page = checked(text, ALL - WITHOUT.get(name, set()))
    assert len(text.encode()) < MOST_BYTES
    assert all(len(section.strip()) > 40 for section in page.sections.values())


def test_a_quick_report_omits_the_parts_that_need_other_runs(monkeypatch):
    in_haste(monkeypatch)
    command("report study_turning --quick --set 'left.load_torque=700 N.m'")
    page = ReportPage(Path("report-study_turning.html").read_text(encoding="utf-8"))
    assert set(page.figures) == ALL - {"inputs", "waterfall", "worth"}
    assert "700 N·m" in page.sections["setup"]


def test_texts_of_a_scene_are_escaped_and_not_markup(monkeypatch):
    in_haste(monkeypatch)
    scene = Scene("a<b>", description="<script>alert(1)</script>", stop=0.01, outputs=["left.speed"])
    with scene:
        text = write(scene, "report.html", quick=True).read_text(encoding="utf-8")
    assert "<script" not in text and "&lt;script&gt;" in text and "a&lt;b&gt;" in text


def test_effects_that_are_off_are_tried_and_refusals_come_from_the_fmu():
    worth = ReportPage(text_of("study_turning")).sections["worth"]
    assert "effects.body_compliance: does not work with contact.law = impact" in worth
    assert re.search(r"tooth_errors\s+changes nothing beyond the solver's tolerance \(tooth_errors.accuracy_grade", worth)
    assert re.search(r"half_shaft\s+changes nothing [^.]*\(.*inertia.left_end", worth)
    assert "Not tried: tooth_fault, limited_slip, clutches, disconnect, final_drive, propeller_shaft and wheel_brake" in worth

