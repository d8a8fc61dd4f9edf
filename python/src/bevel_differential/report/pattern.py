"""Contact pattern of planet 1 with the left side gear: the largest pressure at each position of a flank during the run."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..pair import Pair
from . import svg_style, words
from .blocks import Picture, Section
from .gears import pair_of
from .simulated import Simulated

PAIRS = 3
ENDS = ("toe", "middle", "heel")
# number of positions along the profile and along the face
ROWS, COLUMNS = 240, 48
# strips with a half width below this fraction of the height are drawn this wide, to be visible
THINNEST = 0.006
# relative radius of the flanks over its value at the pitch point, below which the foot of a flank is a seam: for the same load, the
# pressure is twice as high there
LEAST_RADIUS = 0.25
MM, MPA = 1e3, 1e6
# room above and below a flank, mm
EDGE = 0.3
FLANKS = ((1.0, "drive"), (-1.0, "coast"))


@dataclass(frozen=True)
class Contacts:
    """Loaded pairs on one kind of flank, by time and tooth: `time` (s), `tooth`, `force` (N), `height` (m, at the mean cone distance),
    `pressure` (Pa, shape (contacts, 3): toe, middle, heel), and `half_width` of the strip of contact in the middle, m. `in_seam`: true
    if the flanks' relative radius is less than `LEAST_RADIUS` of its value at the pitch point. Toward a base circle the radius vanishes,
    so Hertz's pressure grows without limit and has no meaning."""

    time: np.ndarray
    tooth: np.ndarray
    force: np.ndarray
    height: np.ndarray
    pressure: np.ndarray
    half_width: np.ndarray
    in_seam: np.ndarray

    @classmethod
    def of(cls, run: Simulated, sign: float, pair: Pair) -> "Contacts":
        """Contacts of a run on drive (+1) or coast flanks (−1)."""
        columns = []
        for k in range(1, PAIRS + 1):
            name = f"mesh.pair[{k}]"
            table = [run.time, *(run.series(f"{name}.{what}") for what in ("tooth", "force", "height")),
                     *(run.series(f"{name}.{end}_pressure") for end in ENDS)]
            rows = np.column_stack(table)
            columns.append(rows[(rows[:, 1] >= 0.0) & (sign * rows[:, 2] > 0.0)])
        found = np.vstack(columns)
        found = found[np.lexsort((found[:, 0], found[:, 1]))]
        force, pressure = np.abs(found[:, 2]), found[:, 4:]
        # Hertz: the force on a length b is π/2 times half width times pressure
        half = 2.0 * force / (np.pi * pair.face_width * np.maximum(pressure[:, 1], 1.0))
        modulus = float(run.value("material.young_modulus")) / (2.0 * (1.0 - float(run.value("material.poisson_ratio")) ** 2))
        least = LEAST_RADIUS * radius_at_pitch(pair)
        return cls(found[:, 0], found[:, 1], force, found[:, 3], pressure, half,
                   np.pi * pair.face_width * least * pressure[:, 1] ** 2 > force * modulus)

    def most(self) -> float:
        """Largest pressure, Pa, outside the seam if there is a contact outside."""
        return float((self.pressure if np.all(self.in_seam) else self.pressure[~self.in_seam]).max())

    def along(self, longest: float, step: float) -> Iterator[tuple[float, float, np.ndarray]]:
        """Yields (height, half width, pressures) at the contacts, and interpolated values at most `step` of height apart between contacts
        of one tooth that are at most `longest` s apart."""
        for k, height in enumerate(self.height):
            yield height, self.half_width[k], self.pressure[k]
            if k + 1 < len(self.height) and self.tooth[k + 1] == self.tooth[k] and self.time[k + 1] - self.time[k] <= longest:
                for share in np.linspace(0.0, 1.0, int(abs(self.height[k + 1] - height) / step) + 2)[1:-1]:
                    yield (height + share * (self.height[k + 1] - height),
                           self.half_width[k] + share * (self.half_width[k + 1] - self.half_width[k]),
                           self.pressure[k] + share * (self.pressure[k + 1] - self.pressure[k]))


def section(run: Simulated) -> Section:
    """Section with the picture, or with the reason for its absence."""
    found = Section("pattern", "Contact pattern")
    if not run.has_pairs:
        found.say(f"With scene.gear_contact = {run.literal('scene.gear_contact')} there are no single tooth pairs, so that "
                  "there is no pattern.")
        return found
    pair = pair_of(run)
    loaded = [(name, Contacts.of(run, sign, pair)) for sign, name in FLANKS]
    loaded = [(name, contacts) for name, contacts in loaded if len(contacts.force)]
    if not loaded:
        found.say("No tooth of planet 1 touched the left side gear at any communication point.")
        return found
    caption = " ".join(_caption(name, contacts, run.time[-1]) for name, contacts in loaded) + _reading(pair, loaded)
    found.add(Picture("pattern", _draw(run, pair, loaded), caption))
    return found


def radius_at_pitch(pair: Pair) -> float:
    """Relative radius of curvature of the flanks at the pitch point, m at the mean cone distance. Each flank's radius is R tan ψ."""
    planet, side = (np.tan(gear.arc(gear.pitch)) for gear in pair.gears)
    return 0.5 * (pair.inner_cone + pair.outer_cone) * planet * side / (planet + side)


def envelope(contacts: Contacts, heights: np.ndarray, shares: np.ndarray, longest: float) -> np.ndarray:
    """Largest pressure (Pa), shape (heights, shares): at `heights` (m) along the profile at the mean cone distance, and at `shares` of
    the face from the toe. Across the strip of contact, the pressure is elliptic."""
    # parabola through toe, middle and heel
    weights = np.array([(2.0 * shares - 1.0) * (shares - 1.0), 4.0 * shares * (1.0 - shares), shares * (2.0 * shares - 1.0)])
    largest, thinnest = np.zeros((len(heights), len(shares))), THINNEST * float(heights[-1] - heights[0])
    for height, half, pressure in contacts.along(longest, 0.5 * (heights[1] - heights[0])):
        half = max(half, thinnest)
        first, last = np.searchsorted(heights, [height - half, height + half])
        across = np.sqrt(np.maximum(1.0 - ((heights[first:last] - height) / half) ** 2, 0.0))
        np.maximum(largest[first:last], across[:, None] * (pressure @ weights), out=largest[first:last])
    return largest


@svg_style.drawn("pattern")
def _draw(picture, run, pair: Pair, loaded):
    planet = pair.gears[0]
    mean = 0.5 * (pair.inner_cone + pair.outer_cone)
    root, tip = mean * (planet.root - planet.pitch), mean * (planet.tip - planet.pitch)
    heights, shares = np.linspace(root, tip, ROWS), np.linspace(0.0, 1.0, COLUMNS)
    cones = pair.inner_cone + shares * pair.face_width
    largest = [envelope(contacts, heights, shares, 1.5 * run.scene.step) for _, contacts in loaded]
    top = max(contacts.most() for _, contacts in loaded) / MPA
    picture.set_figheight(3.5 * len(loaded))
    panels = picture.subplots(len(loaded), 2, squeeze=False, width_ratios=[2.6, 1])
    for (flank, loads), (name, contacts), pressure in zip(panels, loaded, largest):
        # all lengths of a tooth grow with the distance from the apex
        height = MM * np.outer(heights, cones / mean)
        mesh = flank.pcolormesh(np.broadcast_to(MM * cones, height.shape), height, np.ma.masked_less(pressure / MPA, 0.02 * top),
                                cmap="plasma", vmin=0.0, vmax=top, shading="gouraud", rasterized=True)
        ends = MM * cones[[0, -1]]
        for height, dash in ((root, "-"), (tip, "-"), (0.0, "--")):
            flank.plot(ends, MM * height * cones[[0, -1]] / mean, color=svg_style.GREY, ls=dash, lw=1.2)
        for end in (0, -1):
            flank.plot([MM * cones[end]] * 2, MM * np.array([root, tip]) * cones[end] / mean, color=svg_style.GREY, lw=1.2)
        flank.text(ends[1] + 0.3, 0.0, "pitch line", color=svg_style.GREY, fontsize=8, va="center")
        flank.text(ends[1] + 0.3, MM * tip * cones[-1] / mean, "tip", color=svg_style.GREY, fontsize=8, va="center")
        flank.text(ends[1] + 0.3, MM * root * cones[-1] / mean, "root", color=svg_style.GREY, fontsize=8, va="bottom")
        flank.set(title=f"{name} flanks of planet 1", xlabel="toe ← cone distance, mm → heel", ylabel="height, mm",
                  xlim=(ends[0] - 1.0, ends[1] + 3.0), ylim=(MM * root * cones[-1] / mean - EDGE, MM * tip * cones[-1] / mean + EDGE))
        flank.set_aspect("equal")
        flank.grid(False)
        bar = picture.colorbar(mesh, ax=flank, pad=0.01, aspect=25, extend="max" if pressure.max() / MPA > top else "neither")
        bar.set_label("largest pressure, MPa")
        scale, unit = svg_style.unit_prefix([contacts.force])
        loads.plot(contacts.force / scale, MM * contacts.height, ".", color=svg_style.BLUE, ms=4)
        loads.set(title="load of one pair", xlabel=f"force, {unit}N", ylabel="height at the mean cone distance, "
                                                                             "mm", ylim=(MM * root - EDGE, MM * tip + EDGE))
        loads.set_xlim(0.0, 1.08 * float(contacts.force.max()) / scale)


def _caption(name, contacts, end):
    low, high = MM * contacts.height.min(), MM * contacts.height.max()
    sound = np.where(contacts.in_seam & ~np.all(contacts.in_seam), 0.0, contacts.pressure.max(axis=1))
    k = int(np.argmax(sound))
    where = ENDS[int(np.argmax(contacts.pressure[k]))]
    widest = 2.0 * MM * contacts.half_width.max()
    peak = (f"up to {words.quantity(contacts.pressure[k].max() / MPA, 'MPa')} ({where}, "
            f"{words.quantity(MM * contacts.height[k], 'mm', 3)} from the pitch line, {words.moment(contacts.time[k], end)})")
    teeth = len(np.unique(contacts.tooth))
    who = f"{teeth} {'tooth' if teeth == 1 else 'teeth'} loaded"
    if high - low < widest:
        return (f"{name.capitalize()} flanks: {who}, {peak}. The teeth do not roll: contact is one line from toe to heel, "
                f"{words.quantity(low, 'mm', 3)} from the pitch line at the mean cone distance, as wide as "
                f"Hertz's strip, {words.quantity(widest, 'mm', 2)}.")
    return (f"{name.capitalize()} flanks: {who}, {peak}; contact from {words.number(low, 3)} to {words.quantity(high, 'mm', 3)} "
            f"at the mean cone distance, in strips up to {words.quantity(widest, 'mm', 2)} wide.")


def _reading(pair, loaded):
    planet = pair.gears[0]
    least = 2.0 * MM * THINNEST * 0.5 * (pair.inner_cone + pair.outer_cone) * (planet.tip - planet.root)
    thin = (f" Strips thinner than {words.quantity(least, 'mm', 2)} are drawn that wide."
            if any(2.0 * MM * contacts.half_width.min() < least for _, contacts in loaded) else "")
    highest = max(float(contacts.pressure.max()) for _, contacts in loaded)
    seam = (f" The scale ends at the largest pressure outside the seam at the foot, where the flank's radius vanishes and Hertz's formula "
            f"gives up to {words.quantity(highest / MPA, 'MPa')}, which has no further meaning."
            if highest > max(contacts.most() for _, contacts in loaded) else "")
    return (" Colour: the largest pressure at each position, from the FMU's pressures at toe, middle and heel, all "
            f"teeth laid on one flank of {words.quantity(MM * pair.face_width, 'mm')}. Teeth are straight: a line of contact "
            f"runs along a ray through the apex. Right: load of one pair over the height.{thin}{seam}")
