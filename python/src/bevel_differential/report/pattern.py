"""Contact pattern of planet 1 with the left side gear: the largest pressure at each position of a flank during the run."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..pair import Pair
from ..panel import Axis, Mark, Panel, curve, scaled_axis
from . import words
from .blocks import Section
from .gears import pair_of
from .simulated import Simulated
from .svg_style import BLUE, GREY, picture

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
    found.add(picture("pattern", _panels(run, pair, loaded), caption, 3.5 * len(loaded), width_ratios=[2.6, 1]))
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


def _panels(run, pair: Pair, loaded):
    planet = pair.gears[0]
    mean = 0.5 * (pair.inner_cone + pair.outer_cone)
    root, tip = mean * (planet.root - planet.pitch), mean * (planet.tip - planet.pitch)
    heights, shares = np.linspace(root, tip, ROWS), np.linspace(0.0, 1.0, COLUMNS)
    cones = pair.inner_cone + shares * pair.face_width
    # all lengths of a tooth grow with the distance from the apex
    toe, heel = ends = cones[[0, -1]]
    growth = ends / mean
    outline = [*(curve(ends, height * growth, None, GREY, form, lw=1.2) for height, form in ((root, "-"), (tip, "-"), (0.0, "--"))),
               *(curve([end] * 2, np.array([root, tip]) * end / mean, None, GREY, lw=1.2) for end in ends),
               *(Mark("text", heel + 0.3 / MM, height * growth[1], name, color=GREY, fontsize=8, va=align)
                 for height, name, align in ((0.0, "pitch line", "center"), (tip, "tip", "center"), (root, "root", "bottom")))]
    top = max(contacts.most() for _, contacts in loaded) / MPA
    for name, contacts in loaded:
        pressure = envelope(contacts, heights, shares, 1.5 * run.scene.step) / MPA
        height = np.outer(heights, cones / mean)
        flank = Mark("pcolormesh", np.broadcast_to(cones, height.shape), height, np.ma.masked_less(pressure, 0.02 * top), cmap="plasma",
                     vmin=0.0, vmax=top, shading="gouraud", rasterized=True,
                     bar={"label": "largest pressure, MPa", "extend": "max" if pressure.max() > top else "neither"})
        yield [Panel(Axis("toe ← cone distance, mm → heel", _mm), Axis("height, mm", _mm), [flank, *outline], f"{name} flanks of planet 1", grid="",
                     xlim=(MM * toe - 1.0, MM * heel + 3.0), ylim=(MM * root * growth[1] - EDGE, MM * tip * growth[1] + EDGE), aspect="equal"),
               Panel(scaled_axis("force", "N", [contacts.force]), Axis("height at the mean cone distance, mm", _mm),
                     [curve(contacts.force, contacts.height, None, BLUE, ".", ms=4)], "load of one pair", xlim=(0.0, None),
                     ylim=(MM * root - EDGE, MM * tip + EDGE))]


def _mm(lengths):
    return MM * lengths


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
