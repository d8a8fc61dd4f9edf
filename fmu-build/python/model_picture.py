"""Draws fmu-build/model.png, the FMU's icon: two side gears, two planets and the cross-shaft, with the program's teeth.

usage: model_picture.py [PNG]
"""

import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

PIXELS = 256
TEETH, MODULE, FACE, ALPHA = (10, 16), 4.5, 20.0, np.radians(20.0)  # planet, side gear; mm
VIEW, UP = np.array([0.75, -0.75, 0.62]), np.array([0.0, 0.0, 1.0])
LIGHT = np.array([0.25, -0.75, 0.85])
STEEL, BRASS, DARK = (0.42, 0.53, 0.66), (0.86, 0.64, 0.30), (0.50, 0.52, 0.56)


def gear(i):
    """Rings of points of gear `i`, axis +z from the apex to the heel: toe bore, toe, heel, heel bore [mm]."""
    z = TEETH[i]
    pitch = np.arctan2(z, TEETH[1 - i])
    base = np.arcsin(np.sin(pitch) * np.cos(ALPHA))
    outer = MODULE * z / (2 * np.sin(pitch))
    side_addendum = (0.540 + 0.460 * (TEETH[0] / TEETH[1]) ** 2) * MODULE
    addendum = [2 * MODULE - side_addendum, side_addendum][i]
    dedendum = 2.188 * MODULE + 0.05 - addendum
    tip, root = pitch + np.arctan2(addendum, outer), pitch - np.arctan2(dedendum, outer)
    shift = ([2 * MODULE - side_addendum, side_addendum][i] - MODULE) / MODULE
    half_pitch = (np.pi / 2 + 2 * shift * np.tan(ALPHA)) / z
    arc = lambda polar: np.arccos(np.clip(np.cos(polar) / np.cos(base), -1, 1))  # noqa: E731
    inv = lambda polar: arc(polar) / np.sin(base) - np.arctan2(np.tan(arc(polar)), np.sin(base))  # noqa: E731
    polar = np.concatenate([[root], np.linspace(max(base, root), tip, 7)])
    azimuth = half_pitch + inv(pitch) - inv(np.maximum(polar, base))
    tooth = [(p, -a) for p, a in zip(polar, azimuth)] + [(p, a) for p, a in zip(polar[::-1], azimuth[::-1])]
    outline = np.array([(p, a + 2 * np.pi * k / z) for k in range(z) for p, a in tooth])
    p, a = outline.T
    rays = np.column_stack([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)])
    bore = [5.0, 5.5][i]  # within the shafts

    def ring(distance):
        return np.column_stack([bore * np.cos(a), bore * np.sin(a), np.full_like(a, distance * np.cos(root))])

    return [ring(outer - FACE), (outer - FACE) * rays, outer * rays, ring(outer)]


def cylinder(radius, begin, end, count=36):
    a = np.linspace(0.0, 2 * np.pi, count, endpoint=False)
    ring = lambda r, h: np.column_stack([r * np.cos(a), r * np.sin(a), np.full_like(a, h)])  # noqa: E731
    levels = np.linspace(begin, end, 12)
    return [ring(1e-3, begin), *(ring(radius, h) for h in levels), ring(1e-3, end)]


def facets(rings):
    """Quadrilaterals between neighbouring rings."""
    for one, two in zip(rings, rings[1:]):
        for k in range(len(one)):
            j = (k + 1) % len(one)
            yield np.array([one[k], one[j], two[j], two[k]])


def frame(axis, toward):
    axis, toward = np.array(axis, float), np.array(toward, float)
    return np.column_stack([toward, np.cross(axis, toward), axis])


def main():
    bodies = []
    half = np.pi / TEETH[1]  # a side gear has a gap where a planet has a tooth
    turned = np.array([[np.cos(half), -np.sin(half), 0], [np.sin(half), np.cos(half), 0], [0, 0, 1]])
    for sign in (1, -1):
        bodies.append((gear(1), frame([sign, 0, 0], [0, 0, 1]) @ turned, STEEL))
        bodies.append((gear(0), frame([0, 0, sign], [1, 0, 0]), BRASS))
        bodies.append((cylinder(6.5, 12.0, 60.0), frame([sign, 0, 0], [0, 0, 1]), DARK))
    bodies.append((cylinder(6.0, -50.0, 50.0), frame([0, 0, 1], [1, 0, 0]), DARK))
    view = VIEW / np.linalg.norm(VIEW)
    right = np.cross(UP, view) / np.linalg.norm(np.cross(UP, view))
    above, light = np.cross(view, right), LIGHT / np.linalg.norm(LIGHT)
    drawn = []
    for rings, rotation, colour in bodies:
        for points in facets(rings):
            points = points @ rotation.T
            normal = np.cross(points[2] - points[0], points[3] - points[1])
            length = np.linalg.norm(normal)
            if length < 1e-9 or normal @ view < 0:
                continue
            shade = 0.45 + 0.62 * max(normal @ light / length, 0.0)
            drawn.append((np.mean(points @ view), points @ np.column_stack([right, above]),
                          np.clip(shade * np.array(colour), 0, 1)))
    drawn.sort(key=lambda polygon: polygon[0])
    figure = plt.figure(figsize=(1, 1), dpi=PIXELS)
    axes = figure.add_axes((0, 0, 1, 1))
    shades = [colour for _, _, colour in drawn]
    axes.add_collection(PolyCollection([shape for _, shape, _ in drawn], facecolors=shades, edgecolors=shades,
                                       linewidths=0.15))
    axes.set(xlim=(-55, 55), ylim=(-55, 55), aspect="equal")
    axes.axis("off")
    default = Path(__file__).resolve().parents[1] / "model.png"
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else default, transparent=True, metadata={"Software": None})


if __name__ == "__main__":
    main()
