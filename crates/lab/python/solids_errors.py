"""Errors caused by facets: comparison of a record of faceted teeth with a record of exact teeth.

On the path of contact, away from tip corners, exact involutes transmit motion evenly. Speed and force are constant, so all variation
there comes from the facets. If a tip corner takes over the load, exact teeth vary too, and facets change the time and shape of the
hand-over. Errors are therefore counted separately: over the whole record, on the path, and at the corners.

Records are dicts of arrays, of shape (points,) or (points, 2): left and right side gear."""

import numpy as np

# a smaller deviation of the speed from Willis' equation means contact only on the path [deg/s]
EVEN = 1e-3
# reported errors, by quantity: unit, and expected order in 1/facets
QUANTITIES = {
    "speed_max": ("deg/s", 1), "speed_rms": ("deg/s", 1), "speed_path_rms": ("deg/s", 1), "speed_corner_rms": ("deg/s", 1),
    "force_mean": ("N", 2), "force_peak": ("N", 1), "force_max": ("N", 1), "force_rms": ("N", 1), "force_path_ripple": ("N", 1),
    "te_max": ("um", 2), "te_rms": ("um", 2), "te_swing_max": ("um", 2), "te_swing_rms": ("um", 2),
}


def rms(values):
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values)))) if np.size(values) else np.nan


def on_path(exact, side, willis):
    """Indices of the points at which exact teeth run evenly at the speeds `willis`, one array for each part of the path.

    Only the middle half of a part counts, because a patch extends the effect of a corner onto the path."""
    even = np.flatnonzero(np.abs(exact["speed"][:, side] - willis[side]) < EVEN)
    pairs = exact["pairs"][even, side]
    stretches = np.split(even, np.flatnonzero((np.diff(even) > 1) | (np.diff(pairs) != 0)) + 1)
    found = []
    for stretch in filter(len, stretches):
        times = exact["time"][stretch]
        found.append(stretch[np.abs(times - 0.5 * (times[0] + times[-1])) <= 0.25 * (times[-1] - times[0])])
    return found


def errors(points, exact, close, willis):
    """Errors of a record compared with exact teeth at the same times, by quantity.

    Values of the last mesh cycle are taken after the time `close` [s]."""
    here, there = look(points, close), look(exact, close)
    apart = {name: (points[name] - exact[name])[points["communicates"]] for name in ("speed", "force", "error")}
    even = np.zeros(exact["speed"].shape, bool)
    for side in (0, 1):
        for stretch in on_path(exact, side, willis):
            even[stretch, side] = True
    even = even[points["communicates"]]
    deflection = 1e6 * apart["error"]
    swing = deflection - np.mean(deflection)
    found = [np.abs(apart["speed"]).max(), rms(apart["speed"]), rms(apart["speed"][even]), rms(apart["speed"][~even]),
             abs(np.mean(apart["force"])), abs(here["peak"] - there["peak"]), np.abs(apart["force"]).max(), rms(apart["force"]),
             path_ripple(points, exact, close, willis),
             np.abs(deflection).max(), rms(deflection), np.abs(swing).max(), rms(swing)]
    return dict(zip(QUANTITIES, map(float, found)))


def look(points, close):
    """Values of the left side gear after the time `close` [s]: forces [N] and mean deflection [m]."""
    own = points["time"] > close
    force, tangential = points["force"][own, 0], points["tangential"][own, 0]
    return {"mean": float(np.mean(force)), "peak": float(force.max()), "ripple": float(np.ptp(force)),
            "tangential": float(np.ptp(tangential)), "deflection": float(np.mean(points["error"][own, 0]))}


def path_ripple(points, exact, close, willis):
    """Ripple of the left side gear's force caused only by facets [N].

    It is the largest distance of the force from its mean over a part of the path of contact, where the force of exact teeth is constant."""
    worst = 0.0
    for stretch in on_path(exact, 0, willis):
        forces = points["force"][stretch[exact["time"][stretch] > close], 0]
        if len(forces):
            worst = max(worst, float(np.abs(forces - np.mean(forces)).max()))
    return worst


def order(coarse, fine):
    """Order in 1/facets from two pairs (facets, error)."""
    return float(np.log(coarse[1] / fine[1]) / np.log(fine[0] / coarse[0]))


def fitted(pairs):
    """Order in 1/facets fitted to all pairs (facets, error) by least squares of the logarithms."""
    return -float(np.polyfit(*np.log(np.array(pairs)).T, 1)[0])
