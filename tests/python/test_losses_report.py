"""The report of a loss map: figures with captions, the sentence of the bound, numbers of the table, and no incomplete file."""

import re
from html.parser import HTMLParser
from math import pi

import pytest
from command_line import command
from command_list import CLUTCH
from bevel_differential import Scene
from bevel_differential.csv_table import CsvTable, Text
from bevel_differential.losses import VARIABLES, MeasuredMap, losses
from bevel_differential.losses.grid import Bound
from bevel_differential.losses.picture import draw
from bevel_differential.losses.report import write
from bevel_differential.losses.tables import HEAD, save
from bevel_differential.values import Quantity
from matplotlib.figure import Figure
from report_page import ReportPage, checked

RICH = {"scene.gear_contact": "ideal", "effects.limited_slip": True, "limited_slip.preload": 60.0, "limited_slip.torque_coefficient": 0.0,
        "limited_slip.static_ratio": 1.25, "limited_slip.stribeck_speed": 0.3, "limited_slip.cold_factor": 1.3,
        "limited_slip.hot_factor": 0.8, "effects.bearing_drag": True, "bearing_drag.carrier_torque": 2.0,
        "bearing_drag.carrier_viscous": 0.02}
PLAIN = {name: RICH[name] for name in list(RICH)[:4]}
LEVELS = dict(zip(VARIABLES, ([90.0, 900.0], [5.0, 40.0], [0.5, 20.0], [273.15, 353.15])))
FIGURES = {"loss_map", "over_difference", "ratio", "stuck", "error"}
SECTIONS = {"head", "loss", "bias", "error", "setup", "columns"}
ZERO_CELSIUS = 273.15


@pytest.fixture
def in_haste(monkeypatch):
    """Skips the layout of panels, to save time."""
    monkeypatch.setattr(Figure, "get_layout_engine", lambda _: None)


class Tables(HTMLParser):
    """Cells of all tables, each a list of rows."""

    def __init__(self, text):
        super().__init__()
        self.tables, self._cell = [], None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self._cell = ""

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self.tables[-1][-1].append(self._cell)
            self._cell = None

    def handle_data(self, data):
        if self._cell is not None:
            self._cell += data

    def of(self, head):
        """Rows of the tables whose first column has this head."""
        return [table[1:] for table in self.tables if table[0][0] == head]


def made_map(values, levels, unseen=40, most=400):
    with Scene("<rich>", description="clutch & drag", set=values) as scene:
        return losses(scene, levels, bound=Bound(0.02, 0.1), unseen=unseen, most=most, workers=0)


@pytest.fixture(scope="module")
def mapped():
    return made_map(RICH, LEVELS)


@pytest.fixture(scope="module")
def single():
    """Map of a single point, whose report is drawn fastest."""
    return made_map(RICH, {name: values[:1] for name, values in LEVELS.items()}, unseen=0)


@pytest.fixture(scope="module")
def text(mapped, tmp_path_factory):
    return write(mapped, tmp_path_factory.mktemp("report") / "map.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def rows(mapped, tmp_path_factory):
    file = save(mapped, tmp_path_factory.mktemp("table") / "map.csv")
    return [values for _, values in CsvTable(file, lambda name: Text(name) if name == "kind" else Quantity(name, "%")).rows]


def number(cell):
    return float(re.match(r"[−\d.e]+", cell)[0].replace("−", "-"))


def test_the_report_is_one_page_with_no_empty_figure(text):
    assert set(checked(text, FIGURES).sections) == SECTIONS
    assert "Loss map of &lt;rich&gt;" in text and "clutch &amp; drag" in text


def test_the_page_has_the_sentence_of_the_bound_and_the_meaning_of_every_column(text, mapped):
    page = ReportPage(text)
    says = mapped.error.replace("N.m", "N·m")
    assert says in page.sections["head"] and says in page.sections["error"] and "40 unseen points" in says
    assert all(f"{name}\n" in page.sections["columns"] for name in HEAD)
    assert str(mapped.slipping[0, ..., 0].size) in page.sections["head"]


def test_the_numbers_of_the_page_are_those_of_the_table(text, rows):
    far = {"carrier.torque": 900.0, "carrier.speed": 40.0}

    def row(kind, difference, temperature):
        found, = (one for one in rows if one["kind"] == kind and one["speed_difference"] == difference
                  and one["oil.temperature"] == pytest.approx(temperature) and all(one[name] == value for name, value in far.items()))
        return found

    loss, ratio = Tables(text).of("oil")
    assert len(loss) == len(ratio) >= 3
    for (oil, *lost), (_, *ratios) in zip(loss, ratio):
        temperature = number(oil) + ZERO_CELSIUS
        left, right, stuck = (row(kind, sign * 20.0, temperature) for kind, sign in (("map", 1.0), ("map", -1.0), ("stuck", 0.0)))
        assert [number(cell) for cell in lost] == pytest.approx([one["power.loss"] for one in (left, right, stuck)], rel=1e-3)
        assert [number(cell) for cell in ratios[:2]] == pytest.approx([one["torque_bias_ratio"] for one in (left, right)], rel=1e-3)
        assert number(ratios[3]) == pytest.approx(stuck["torque_bias_ratio"], rel=1e-3)
        ends = [stuck[f"left.shaft_torque_{end}"] for end in ("min", "max")]
        assert [number(cell) for cell in ratios[4:]] == pytest.approx(ends, rel=1e-3)


def test_the_worst_unseen_points_are_rows_of_the_table(text, rows, mapped):
    listed, = Tables(text).of("worst in")
    unseen = [one for one in rows if one["kind"] == "unseen"]
    names = ("carrier.torque", "carrier.speed", "speed_difference", "oil.temperature")
    assert len(listed) == 10 and number(listed[0][1]) == pytest.approx(mapped.errors.max(), rel=5e-3)
    for _, error, *point in listed:
        # N·m, rpm, rpm and °C
        place = [number(point[0]), *(number(cell) * pi / 30.0 for cell in point[1:3]), number(point[3]) + ZERO_CELSIUS]
        near = min(unseen, key=lambda one: sum(abs(one[name] - at) for name, at in zip(names, place)))
        assert [near[name] for name in names] == pytest.approx(place, rel=1e-3)
        for cell, name in zip(point[4:], ("left.shaft_torque", "right.shaft_torque", "power.loss")):
            assert number(cell) == pytest.approx(near[name], rel=1e-3)
        assert number(error) <= number(listed[0][1])


@pytest.mark.usefixtures("in_haste")
def test_temperatures_without_effect_share_a_curve_and_a_map_without_drag_says_so(tmp_path):
    made = made_map(PLAIN, LEVELS, unseen=5)
    page = ReportPage(write(made, tmp_path / "map.html").read_text(encoding="utf-8"))
    assert "Temperature changes nothing" in page.sections["loss"]
    assert "the scene has no drag" in page.captions["loss_map"]


@pytest.mark.usefixtures("in_haste")
@pytest.mark.parametrize("axis", range(4))
def test_an_axis_of_a_single_value_has_its_report(axis, tmp_path):
    levels = {name: values[:1] if axis == place else values for place, (name, values) in enumerate(LEVELS.items())}
    text = write(made_map(RICH, levels, unseen=3, most=100), tmp_path / "map.html").read_text(encoding="utf-8")
    checked(text, FIGURES if axis > 1 else FIGURES - {"loss_map"})


def test_a_single_point_without_unseen_ones_has_its_report(single, tmp_path):
    page = checked(write(single, tmp_path / "map.html").read_text(encoding="utf-8"), FIGURES - {"loss_map", "error"})
    assert "the error of the map is not measured" in page.sections["error"]


def test_warnings_of_runs_and_of_the_map_are_on_the_page(tmp_path):
    values = RICH | {"limited_slip.friction_area": 1e-4, "limited_slip.pv_limit": 1e5}
    made = made_map(values, LEVELS | {VARIABLES[0]: [900.0], VARIABLES[3]: [300.0]}, unseen=3, most=9)
    assert made.estimate > 1.0
    head = ReportPage(write(made, tmp_path / "map.html").read_text(encoding="utf-8")).sections["head"]
    assert re.search(r"The FMU warns: .*pv.*corners of the map", head), head
    assert "carrier.speed_command" not in head
    assert ("Allow more by --most" in head) == (made.estimate > 1.0)


def test_the_command_writes_the_page_in_addition_to_the_table(tmp_path):
    (tmp_path / "clutch.toml").write_text(CLUTCH, encoding="utf-8")
    file = tmp_path / "map.html"
    printed = command(f"losses {tmp_path / 'clutch.toml'} --torque 300 --speed 20 --difference 1,5 --temperature 350 --unseen 3 --workers 0 "
                      f"--report {file}").out
    assert f"written: {file}" in printed
    assert "3 unseen points" in ReportPage(file.read_text(encoding="utf-8")).sections["head"]


def test_the_page_names_the_model_that_accuracy_chose(single, tmp_path):
    made = type(single)(**{**single.__dict__, "model": "lumped, 1e-3"})
    assert "lumped, 1e-3: chosen by accuracy" in ReportPage(write(made, tmp_path / "map.html").read_text(encoding="utf-8")).sections["head"]


def test_a_report_and_a_picture_are_in_the_units_that_are_preferred(mapped, tmp_path):
    with Scene("rich", set=RICH, display_units=["rpm", "kN.m", "K"]) as scene:
        shown = MeasuredMap(**{**mapped.__dict__, "scene": scene})
        text = write(shown, tmp_path / "map.html").read_text(encoding="utf-8")
        draw(shown, tmp_path / "map.svg")
    assert not re.search(r"rad/s|(?<!k)N·m|°C", text.partition("Measured error")[0].partition("Axes of the map")[2].replace("N·m on top", ""))
    axes, = Tables(text).of("axis")
    # 60 s per minute and 2π rad per turn, 1000 N·m per kN·m
    sizes = (1e-3, 30.0 / pi, 30.0 / pi, 1.0)
    assert [name.rsplit(" ", 1)[-1] for _, name, *_ in axes] == ["kN·m", "rpm", "rpm", "K"]
    for (_, first, last, *_), size, values in zip(axes, sizes, LEVELS.values()):
        assert [number(first), number(last)] == pytest.approx([size * values[0], size * values[-1]], rel=1e-4)
    picture = (tmp_path / "map.svg").read_text(encoding="utf-8")
    assert "carrier torque, kN·m" in picture and "difference of speeds (left − right), rpm" in picture and "rad/s" not in picture
    # programs read the map, so it stays in SI
    assert save(shown, tmp_path / "own.csv").read_text().splitlines()[3:] == save(mapped, tmp_path / "si.csv").read_text().splitlines()[3:]
