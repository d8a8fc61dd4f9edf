"""Images of scenes and of what they put out: reflections of a differential, by the table tests/data/symmetry.csv.

A scene is {"start": values by name, "steps": [(size, inputs)]} as in random_scenes.py."""

import csv
from math import atan2, cos, sin
from pathlib import Path

import numpy as np

TABLE = Path(__file__).resolve().parents[1] / "data" / "symmetry.csv"
IDEAL, BY_TORQUE = 1, 2
NONE, PLANET = 1, 2
EXCHANGED = {"left": "right", "right": "left"}


def table():
    """Columns `reversed` and `swapped` by pattern."""
    with open(TABLE, encoding="utf-8") as file:
        return {row["variable"]: row for row in csv.DictReader(line for line in file if not line.startswith("#"))}


class Image:
    """The image of one scene: `way` is reversed or swapped."""

    def __init__(self, fmu, scene, way):
        self.way, self.columns = way, table()
        self.variables = fmu.variables
        self.start = {v.name: v.start for v in self.variables.values() if v.causality in ("parameter", "input")}
        self.start |= {v.name: number for v, number in fmu.numbers(scene["start"])}
        self.steps = [(size, {v.name: number for v, number in fmu.numbers(inputs)}) for size, inputs in scene["steps"]]
        self.planets, self.planet_teeth, self.side_teeth = (
            self.start[f"geometry.{name}"] for name in ("planet_count", "planet_teeth", "side_teeth"))

    def entry(self, name):
        """Pattern of a variable in the table: its own, or that of its group; a derivative is what its state is."""
        opened = name.removeprefix("der(").removesuffix(")").replace("left", "SIDE").replace("right", "SIDE")
        for i in range(1, 5):
            opened = opened.replace(f"planet[{i}]", "planet[I]")
        if opened in self.columns:
            return opened
        return next(pattern for pattern in self.columns if pattern.endswith("*") and opened.startswith(pattern[:-1]))

    def parity(self, name):
        return self.columns[self.entry(name)][self.way]

    def factor(self, name):
        parity = self.parity(name)
        # the FMU takes no negative amplitude: one that does nothing stays
        driven = self.start["effects.final_drive"] and self.start["scene.carrier_drive"] == BY_TORQUE
        wave = parity == "wave" and driven
        return -1.0 if parity in ("-", "lash") or wave else 1.0

    def name(self, name):
        """Of a variable in the image."""
        if self.way == "swapped":
            for one, other in EXCHANGED.items():
                if one in name:
                    return name.replace(one, other)
            return name
        for i in range(2, self.planets + 1):
            if f"planet[{i}]" in name:
                return name.replace(f"planet[{i}]", f"planet[{self.planets + 2 - i}]")
        return name

    def values(self, values):
        image = {}
        for name, value in values.items():
            changes = self.variables[name].kind == "Real" and self.factor(name) < 0.0
            image[self.name(name)] = -value if changes else value
        return image

    def scene(self):
        start = self.values(self.start)
        if start["tooth_fault.gear"] != NONE:
            start["tooth_fault.index"], start["tooth_fault.tooth"] = self.tooth()
        return {"start": start, "steps": [(size, self.values(inputs)) for size, inputs in self.steps]}

    def tooth(self):
        """Index of the gear and number of the broken tooth, as tests/model/mirror/teeth.rs has them."""
        index, tooth = self.start["tooth_fault.index"], self.start["tooth_fault.tooth"]
        n, z_p, z_s = self.planets, self.planet_teeth, self.side_teeth
        shifted = 2 * z_s * index // n % 2
        if self.start["tooth_fault.gear"] == PLANET:
            if self.way == "swapped":
                return index, (z_p // 2 - shifted - tooth) % z_p
            return (n - index) % n, (-shifted - tooth) % z_p
        if self.way == "swapped":
            return 1 - index, tooth
        return index, (-1 - (index * z_p) % 2 - tooth) % z_s

    def lash(self):
        """Backlash along the line of action at the mean cone distance."""
        s = self.start
        if s["scene.gear_contact"] == IDEAL or not s["effects.backlash"]:
            return 0.0
        cone = s["geometry.module"] * self.planet_teeth / (2.0 * sin(atan2(self.planet_teeth, self.side_teeth)))
        return s["geometry.backlash"] * cos(s["geometry.pressure_angle"]) * (cone - s["geometry.face_width"] / 2.0) / cone

    def has(self, name):
        """Whether the image has the output: single tooth pairs are read of planet 1's left mesh alone."""
        return self.way == "reversed" or "mesh.pair[" not in name

    def expected(self, outputs):
        """Outputs of the image, given those of the scene."""
        image = {}
        for name, value in outputs.items():
            if not self.has(name):
                continue
            if name.endswith("].tooth"):
                # planet 1 is its own image, and its teeth are counted the other way
                image[name] = np.where(value < 0.0, value, -value % self.planet_teeth)
                continue
            there = any(f"planet[{i}]" in name for i in range(1, self.planets + 1))
            apart = self.lash() if there and self.parity(name) == "lash" else 0.0
            image[self.name(name)] = self.factor(name) * value - apart
        return image
