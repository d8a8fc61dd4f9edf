"""Files of gears for other programs, read back by the usual libraries: STEP by Open CASCADE, meshes by trimesh, DXF by ezdxf.

Expected contents are independent of the program: flanks are compared with the involute of `outline_solids`, masses with its
integrals."""

import io
import json
import math
import re
from functools import cache

import numpy as np
import outline_solids
import pytest
from command_line import command
from step_solids import centre_of, near_faces, parts_of, read_step, ruled_faces, weighed

from bevel_differential import cad
from bevel_differential.answers import ask, assignments
from bevel_differential.command import WRONG

MM = 1e3
MICROMETRE = 1e-3
POINTS = 10_000
# the start values, and five other pairs: with bores, with 9 teeth, mitre gears with steep flanks, sharp corners, three planets
START = {"module": 4.5e-3, "planet_teeth": 10, "side_teeth": 16, "planet_count": 2, "pressure_angle": math.radians(20.0),
         "face_width": 20e-3, "backlash": 1e-4, "root_fillet": 0.4, "planet_bore": 0.0, "side_bore": 0.0,
         "thickness_shift": 0.0, "addendum_system": "gleason"}
PAIRS = {
    "study": {},
    "bored": {"module": 3e-3, "planet_teeth": 12, "side_teeth": 20, "planet_count": 4, "face_width": 12e-3,
              "planet_bore": 12e-3, "side_bore": 20e-3},
    "nine": {"planet_teeth": 9, "side_teeth": 14, "planet_bore": 14e-3},
    "mitre": {"planet_teeth": 14, "side_teeth": 14, "pressure_angle": math.radians(25.0), "addendum_system": "standard"},
    "sharp": {"planet_teeth": 16, "side_teeth": 40, "root_fillet": 0.0, "thickness_shift": 0.0259},
    "three": {"planet_teeth": 10, "side_teeth": 15, "planet_count": 3, "planet_bore": 14e-3, "root_fillet": 0.2},
}
BOTH = pytest.mark.parametrize("i", [0, 1], ids=cad.GEARS)


class Pair:
    """Pair of gears in an answer of the program, and the same pair by independent formulas."""

    def __init__(self, changes):
        values = {**START, **changes}
        told = assignments({f"geometry.{name}": value for name, value in changes.items()})
        self.found = ask({"ask": "geometry", "set": told, "solids": True})
        self.shape = self.found["shape"]
        self.bores = [values["planet_bore"], values["side_bore"]]
        self.gears, cones = outline_solids.gears(values["addendum_system"], values.get)
        self.cones = np.array(cones)
        self.planets = values["planet_count"]
        # cached, as when the package writes all files
        self.solids = {}

    @cache
    def step(self, part):
        """Content of a STEP file."""
        return cad.step(self.shape, part, self.solids)

    @cache
    def read(self, part):
        """Shape of a STEP file, read back."""
        return read_step(self.step(part))


@cache
def pair_of(name):
    return Pair(PAIRS[name])


@pytest.fixture(scope="module", params=PAIRS)
def pair(request):
    """Each pair in turn."""
    return pair_of(request.param)


@pytest.fixture(scope="module")
def bored():
    """Pair with bores and four planets."""
    return pair_of("bored")


@pytest.fixture(scope="module", autouse=True)
def libraries():
    """Skips the tests if packages of the extra are missing."""
    for module in ("OCP.gp", "trimesh", "ezdxf", "networkx"):
        pytest.importorskip(module, reason="the extra `cad` of the package is not installed")


def polar_of(points):
    return np.arctan2(np.hypot(points[..., 0], points[..., 1]), points[..., 2])


def beside(points, teeth):
    """Azimuths from the middle of the nearest tooth, without sign."""
    azimuth = np.arctan2(points[..., 1], points[..., 0])
    return np.abs(azimuth - 2.0 * np.pi / teeth * np.round(azimuth * teeth / (2.0 * np.pi)))


@BOTH
def test_a_step_file_is_one_valid_closed_solid_with_the_mass_of_the_simulation(pair, i):
    from OCP.BRep import BRep_Tool
    from OCP.BRepCheck import BRepCheck_Analyzer

    solid, teeth = pair.read(cad.GEARS[i]), pair.gears[i].teeth
    assert len(list(parts_of(solid, "SOLID"))) == 1 and BRepCheck_Analyzer(solid).IsValid()
    assert all(BRep_Tool.IsClosed_s(shell) for shell in parts_of(solid, "SHELL"))
    volume, axial, *transverse, centre = weighed(solid)
    told = pair.shape["gears"][i]["mass"]
    assert volume == pytest.approx(MM**3 * told["mass"] / told["density"], rel=1e-4)
    assert centre == pytest.approx(MM * told["centre"], rel=1e-4)
    assert axial == pytest.approx(MM**5 * told["axial"] / told["density"], rel=1e-4)
    assert transverse == pytest.approx([MM**5 * told["transverse_at_apex"] / told["density"]] * 2, rel=1e-4)
    own = pair.gears[i].inertias(pair.cones, pair.bores[i], 1.0)
    assert [axial, transverse[0]] == pytest.approx(MM**5 * own, rel=1e-4)
    # flanks, fillets, ends and lands, without facets
    assert 10 * teeth <= len(list(parts_of(solid, "FACE"))) <= 18 * teeth + 3


@BOTH
def test_flanks_and_fillets_are_the_exact_ones_to_a_micrometre(pair, i):
    gear, cones = pair.gears[i], MM * pair.cones
    flanks, fillets = [], []
    for points in ruled_faces(pair.read(cad.GEARS[i]), math.ceil(math.sqrt(POINTS / (2 * gear.teeth)))):
        (flanks if polar_of(points).max() > gear.tip - 1e-6 else fillets).append(points)
    assert len(flanks) == 2 * gear.teeth and len(fillets) in (0, 2 * gear.teeth)
    points = np.concatenate([face.reshape(-1, 3) for face in flanks])
    assert len(points) >= POINTS
    # along the rolling great circle, lengths are sin δ_b times azimuths
    polar, cone = polar_of(points), np.linalg.norm(points, axis=1)
    off = cone * np.sin(gear.base) * (beside(points, gear.teeth) - gear.half_angle(polar))
    assert np.abs(off).max() < MICROMETRE
    # from toe to heel, and from the start of the involute to the tip
    assert [cone.min(), cone.max()] == pytest.approx(cones, abs=MICROMETRE)
    start = max(gear.base, gear.root) if not fillets else max(gear.base, gear.foot()[0][-1])
    assert [polar.min(), polar.max()] == pytest.approx([start, gear.tip], abs=MICROMETRE / cones[1])
    if fillets:
        points = np.concatenate([face.reshape(-1, 3) for face in fillets])
        centre, azimuth = gear.root + gear.fillet, gear.foot()[1][0]
        polar, apart = polar_of(points), beside(points, gear.teeth) - azimuth
        away = np.arccos(np.cos(polar) * np.cos(centre) + np.sin(polar) * np.sin(centre) * np.cos(apart))
        assert np.abs(np.linalg.norm(points, axis=1) * (away - gear.fillet)).max() < MICROMETRE


# two, three and four planets, with and without pins; other tooth shapes have the same positions
@pytest.mark.parametrize("name", ["study", "nine", "three", "bored"])
def test_the_assembly_has_all_gears_and_pins_in_their_places(name):
    from OCP.BRepCheck import BRepCheck_Analyzer

    pair = pair_of(name)
    data, whole = pair.step("assembly"), pair.read("assembly")
    assert BRepCheck_Analyzer(whole).IsValid()
    # names of parts in the order of their occurrence
    occurrences = re.findall(r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\(\s*'[^']*',\s*'([^']*)'", data.decode())
    named = ["side_gear_left", "side_gear_right"] + [f"planet_{k + 1}" for k in range(pair.planets)]
    assert occurrences == named + ["pins"] * bool(pair.bores[0])
    centres = np.array([centre_of(solid) for solid in parts_of(whole, "SOLID")])
    side, planet = (MM * gear["mass"]["centre"] for gear in (pair.shape["gears"][1], pair.shape["gears"][0]))
    around = 2.0 * np.pi * np.arange(pair.planets) / pair.planets
    wanted = [[side, 0.0, 0.0], [-side, 0.0, 0.0]] + [[0.0, planet * np.cos(a), planet * np.sin(a)] for a in around]
    assert centres[:len(wanted)] == pytest.approx(np.array(wanted), abs=planet * 1e-4)
    if pair.bores[0]:
        # the pin is in the bores, and the middle of all pins is in the apex
        assert centres[-1] == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert len(centres) == len(named) + bool(pair.bores[0])


def test_teeth_of_the_assembly_are_half_the_backlash_apart(bored):
    from OCP.BRepExtrema import BRepExtrema_DistShapeShape

    _, side, planet = list(parts_of(bored.read("assembly"), "SOLID"))[:3]
    # at the toe, where all lengths are smallest
    half = MM * START["backlash"] * math.cos(START["pressure_angle"]) / 2.0 * bored.cones[0] / bored.cones[1]
    near = near_faces(side, planet, 2.0 * half)
    assert BRepExtrema_DistShapeShape(*near).Value() == pytest.approx(half, abs=MICROMETRE)


@pytest.mark.parametrize("kind", cad.MESHES)
@pytest.mark.parametrize("part", cad.PARTS)
def test_meshes_are_watertight_and_enclose_the_gears(bored, part, kind):
    import trimesh

    unit = 1.0 if kind == "glb" else MM
    scene = trimesh.load_scene(io.BytesIO(cad.mesh(bored.shape, part, kind)), file_type=kind)
    solids = scene.dump()
    assert all(solid.is_watertight for solid in solids)
    planet, side = (unit**3 * gear["mass"]["mass"] / gear["mass"]["density"] for gear in bored.shape["gears"])
    # a cross of two rods
    rods = 2 * math.pi * (unit * bored.bores[0] / 2.0) ** 2 * 2 * unit * bored.cones[1] * math.cos(bored.gears[0].root)
    wanted = {"planet": planet, "side_gear": side, "assembly": 4 * planet + 2 * side + rods}[part]
    assert sum(solid.volume for solid in solids) == pytest.approx(wanted, rel=1e-3)
    if part == "assembly":
        assert scene.extents[1] == pytest.approx(2 * unit * bored.cones[1] * math.cos(bored.gears[0].root), rel=1e-6)
        if kind != "stl":
            named = {"side_gear_left", "side_gear_right", "pin_1", "pin_2"} | {f"planet_{k}" for k in range(1, 5)}
            assert named <= set(scene.graph.nodes)


@BOTH
def test_a_drawing_has_the_exact_outlines_and_the_dimensions_of_the_table(bored, i):
    import ezdxf

    document = ezdxf.read(io.StringIO(cad.drawing(bored.shape, cad.GEARS[i]).decode()))
    assert not document.audit().errors and document.units == ezdxf.units.MM
    gear, space = bored.gears[i], document.modelspace()
    splines = {layer: space.query(f'SPLINE[layer=="{layer}"]') for layer in ("heel", "toe")}
    for layer, cone in zip(("toe", "heel"), MM * bored.cones, strict=True):
        # flank and fillet on both sides of every tooth
        assert len(splines[layer]) == 4 * gear.teeth
        curves = [np.array([tuple(p) for p in spline.construction_tool().approximate(50)]) for spline in splines[layer]]
        assert max(np.abs(np.linalg.norm(points, axis=1) - cone).max() for points in curves) < MICROMETRE
        flanks = np.concatenate([points for points in curves if polar_of(points).max() > gear.tip - 1e-6])
        off = cone * np.sin(gear.base) * (beside(flanks, gear.teeth) - gear.half_angle(polar_of(flanks)))
        assert np.abs(off).max() < MICROMETRE
    table = json.loads(bored.found["files"]["dimensions.json"])[cad.GEARS[i]]
    names = ["outer_tip_diameter_on_sphere", "outer_root_diameter_on_sphere", "apex_to_crown_on_sphere",
             "apex_to_outer_root_on_sphere", "apex_to_inner_root_on_sphere", "pitch_angle_delta", "face_angle_delta_a",
             "root_angle_delta_f"]
    drawn = [dimension.get_measurement() for dimension in space.query("DIMENSION")]
    for wanted in [*(table[name]["value"] for name in names), MM * bored.bores[i], MM * bored.cones[1]]:
        assert min(abs(value - wanted) for value in drawn) < 1e-9


def test_files_are_written_by_kind_and_part_or_not_at_all(tmp_path):
    printed = command(f"geometry --out {tmp_path / 'new'} --step --dxf --stl --part planet --part assembly").out
    made = {"planet.step", "planet.dxf", "planet.stl", "assembly.step", "assembly.stl"}
    files = {path.name: path.stat().st_size for path in (tmp_path / "new").iterdir()}
    assert {name for name in files if not name.endswith((".txt", ".json"))} == made and made < set(printed.replace(",", " ").split())
    assert all(files[name] > 10_000 for name in made)
    said = command(f"geometry --out {tmp_path / 'none'} --stl --facets 201", WRONG).err
    assert "facets 201: must be a whole number from 2 to 200" in said and not (tmp_path / "none").exists()
