"""Renders the solids of the differential. Half-shafts, pin and carrier are added for orientation.

Writes the picture of docs/geometry.md and the FMU's icon, from the meshes that `bevel-differential geometry` wrote:

    target/python/bin/bevel-differential geometry --glb --part assembly --out target/geometry
    python3 -m venv target/rendering && target/rendering/bin/pip install -r fmu-build/python/rendering/requirements.txt
    target/rendering/bin/python fmu-build/python/rendering/gears.py [--quick]

usage: gears.py [--quick] [FOLDER [PICTURE ICON]]
"""

import sys
import tempfile
from pathlib import Path

import mitsuba
import numpy as np
import trimesh
from matplotlib.patheffects import withStroke

ROOT = Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "python" / "src"))
from bevel_differential import style  # noqa: E402

mitsuba.set_variant("scalar_rgb")
STEEL, BRASS, SHAFT, CARRIER = (0.24, 0.40, 0.64), (0.84, 0.53, 0.14), (0.42, 0.44, 0.47), (0.16, 0.17, 0.19)
# metres: radius of half-shafts and pin, and of the carrier, which is a hoop around both
SHAFT_RADIUS, PIN_RADIUS = 12e-3, 7.5e-3
HOOP_INNER, HOOP_OUTER, HOOP_WIDTH = 45e-3, 49e-3, 20e-3
SHAFT_END = 70e-3
# back faces of side gears and planets [m]: shafts and pin begin inside
BACK = 16e-3
# edges stay sharp between faces at a larger angle
SHARP = np.radians(25.0)
# labels: text, labelled point [m], position of the text as fractions of the picture
LABELS = [("side gear", (-23e-3, -15e-3, 31e-3), (0.08, 0.20)), ("side gear", (22e-3, -20e-3, 24e-3), (0.93, 0.20)),
          ("planet", (10e-3, 33e-3, 20e-3), (0.88, 0.90)), ("half-shaft", (-62e-3, 8e-3, 9e-3), (0.06, 0.80)),
          ("pin", (-5e-3, 40e-3, 5e-3), (0.27, 0.95)), ("carrier (outline)", (-34e-3, 33e-3, 10e-3), (0.13, 0.90))]
# lines to labels with a halo stay visible on dark parts
HALO = [withStroke(linewidth=3.5, foreground="white")]
# direction and distance of the camera from the middle [m], angle of view, picture sizes and rays per pixel
VIEW, DISTANCE, ANGLE = np.array([0.48, 0.36, 1.0]), 0.5, 18.4
PICTURE, ICON = (1400, 930), (256, 256)
RAYS, ICON_RAYS, QUICK_RAYS = 144, 400, 16


def main():
    style.apply()
    arguments = [argument for argument in sys.argv[1:] if argument != "--quick"]
    folder, picture, icon = (Path(argument) for argument in arguments + [
        ROOT / "target" / "geometry", ROOT / "docs" / "figures" / "gears.png",
        ROOT / "fmu-build" / "model.png"][len(arguments):])
    rays, icon_rays = (QUICK_RAYS, QUICK_RAYS) if "--quick" in sys.argv else (RAYS, ICON_RAYS)
    scene = trimesh.load(folder / "assembly.glb", process=False)
    with tempfile.TemporaryDirectory() as scratch:
        parts = [*gears(scene), *surroundings()]
        shapes = {f"part_{k}": shape(Path(scratch) / f"{k}.ply", mesh, colour, rough)
                  for k, (mesh, colour, rough) in enumerate(parts)}
        labelled(picture, render(shapes, PICTURE, rays))
        write(icon, render(shapes, ICON, icon_rays))


def gears(scene):
    """Mesh, colour and roughness of each gear in its position."""
    for node in scene.graph.nodes_geometry:
        placed, name = scene.graph[node]
        mesh = scene.geometry[name].copy()
        mesh.apply_transform(placed)
        yield mesh, BRASS if name == "planet" else STEEL, 0.32


def surroundings():
    """Half-shafts along x, the pin along y, and the carrier as a hoop through which both pass."""
    for sign in (1.0, -1.0):
        yield cylinder(SHAFT_RADIUS, [sign * BACK, 0.0, 0.0], [sign * SHAFT_END, 0.0, 0.0]), SHAFT, 0.25
    yield cylinder(PIN_RADIUS, [0.0, -HOOP_OUTER - 3e-3, 0.0], [0.0, HOOP_OUTER + 3e-3, 0.0]), SHAFT, 0.25
    yield trimesh.creation.annulus(HOOP_INNER, HOOP_OUTER, HOOP_WIDTH, sections=256), CARRIER, 0.4


def cylinder(radius, begin, end):
    return trimesh.creation.cylinder(radius, segment=[begin, end], sections=128)


def shape(file, mesh, colour, roughness):
    """A part for the renderer: metal with sharp edges and smooth curved faces."""
    mesh.merge_vertices(merge_norm=True, merge_tex=True)
    trimesh.graph.smooth_shade(mesh, angle=SHARP).export(file, vertex_normal=True)
    metal = {"type": "principled", "base_color": {"type": "rgb", "value": list(colour)}, "metallic": 0.55,
             "roughness": roughness, "specular": 0.6}
    return {"type": "ply", "filename": str(file), "material": {"type": "twosided", "bsdf": metal}}


def camera():
    """Position of the camera, and the axes of its picture: right, up, toward the camera."""
    toward = VIEW / np.linalg.norm(VIEW)
    right = np.cross([0.0, 1.0, 0.0], toward)
    right /= np.linalg.norm(right)
    return DISTANCE * toward, np.array([right, np.cross(toward, right), toward])


def render(shapes, size, rays):
    """Picture as sRGB with alpha: pixels without a hit are transparent."""
    look = mitsuba.ScalarTransform4f().look_at(origin=camera()[0].tolist(), target=[0.0, 0.0, 0.0], up=[0.0, 1.0, 0.0])
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 6, "hide_emitters": True},
        "sensor": {"type": "perspective", "fov": ANGLE, "fov_axis": "larger", "to_world": look,
                   "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgba",
                            "rfilter": {"type": "gaussian"}},
                   "sampler": {"type": "multijitter", "sample_count": rays}},
        "sky": {"type": "constant", "radiance": 0.42},
        "key": lamp([0.20, 0.45, 0.45], 0.14, 8.0), "fill": lamp([-0.5, 0.1, 0.3], 0.2, 1.6),
        **shapes,
    }
    bitmap = mitsuba.Bitmap(mitsuba.render(mitsuba.load_dict(scene)))
    return bitmap.convert(mitsuba.Bitmap.PixelFormat.RGBA, mitsuba.Struct.Type.UInt8, srgb_gamma=True)


def lamp(position, size, strength):
    place = mitsuba.ScalarTransform4f().look_at(origin=position, target=[0.0, 0.0, 0.0], up=[0.0, 1.0, 0.0])
    return {"type": "rectangle", "to_world": place @ mitsuba.ScalarTransform4f().scale(size),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": strength}}}


def labelled(file, bitmap):
    """Picture with the names of its parts and a caption."""
    image = np.array(bitmap)
    picture, axes = style.panels(1, 1, 9.6)
    axes.imshow(image, interpolation="antialiased")
    axes.set_axis_off()
    for text, point, place in LABELS:
        axes.annotate(text, projected(np.array(point), image.shape), place, textcoords="axes fraction", fontsize=14,
                      color=style.TEXT, ha="center", va="center",
                      arrowprops={"arrowstyle": "-", "color": style.INK, "lw": 1.1, "shrinkB": 0, "path_effects": HALO})
    style.caption(picture, "The bevel differential with the teeth that the program computes: two side gears with 16 teeth, two "
                  "planets with 10, module 4.5 mm. Flanks are spherical involutes. The carrier turns the pin about the axis of "
                  "the half-shafts; planets that turn on the pin let the half-shafts differ in speed. Half-shafts, pin and "
                  "carrier are drawn for orientation only.")
    style.save(picture, file, shaded=True)
    print(f"written: {file}")


def projected(point, shape):
    """Position of a point in the picture [pixels]."""
    origin, axes = camera()
    x, y, z = axes @ (point - origin)
    scale = 0.5 * shape[1] / np.tan(np.radians(0.5 * ANGLE))
    return 0.5 * shape[1] - scale * x / z, 0.5 * shape[0] + scale * y / z


def write(file, bitmap):
    bitmap.write(str(file))
    print(f"written: {file}")


if __name__ == "__main__":
    main()
