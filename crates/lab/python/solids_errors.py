"""What facets make wrong: a record compared with that of teeth on the path of contact.

On the path of contact, away from tip corners, involutes turn each other evenly: speed and force stand still, and what
moves there is of the facets alone. Where a tip corner takes load over, the teeth themselves move, and facets
change when and how. So differences are counted together and in both parts.

Records are dicts of arrays, of shape (points,) or (points, 2): left and right side gear."""

import numpy as np

# speeds nearer than this to Willis' equation are those of a contact on the path alone [deg/s]
EVEN = 1e-3
# quantities whose error is reported: unit, and the order in 1/facets that is expected
QUANTITIES = {
    "speed_max": ("deg/s", 1), "speed_rms": ("deg/s", 1), "speed_path_rms": ("deg/s", 1), "speed_corner_rms": ("deg/s", 1),
    "force_mean": ("N", 2), "force_peak": ("N", 1), "force_max": ("N", 1), "force_rms": ("N", 1), "force_path_ripple": ("N", 1),
    "te_max": ("um", 2), "te_rms": ("um", 2), "te_swing_max": ("um", 2), "te_swing_rms": ("um", 2),
}


def rms(values):
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values)))) if np.size(values) else np.nan


def on_path(exact, side, willis):
    """Stretches (places of points) in which exact teeth run evenly at the speeds `willis`: the middle half of each, as what happens
    at a corner reaches some way onto the path where contact is spread over a patch."""
    even = np.flatnonzero(np.abs(exact["speed"][:, side] - willis[side]) < EVEN)
    pairs = exact["pairs"][even, side]
    stretches = np.split(even, np.flatnonzero((np.diff(even) > 1) | (np.diff(pairs) != 0)) + 1)
    found = []
    for stretch in filter(len, stretches):
        times = exact["time"][stretch]
        found.append(stretch[np.abs(times - 0.5 * (times[0] + times[-1])) <= 0.25 * (times[-1] - times[0])])
    return found


def errors(points, exact, close, willis):
    """Errors of a record against that of exact teeth at the same times, by quantity; from `close` on it is a close one."""
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
    """What the close part of a record shows of the left side gear: forces [N] and mean deflection [m]."""
    own = points["time"] > close
    force, tangential = points["force"][own, 0], points["tangential"][own, 0]
    return {"mean": float(np.mean(force)), "peak": float(force.max()), "ripple": float(np.ptp(force)),
            "tangential": float(np.ptp(tangential)), "deflection": float(np.mean(points["error"][own, 0]))}


def path_ripple(points, exact, close, willis):
    """What facets alone make of the left side gear's force: its greatest distance from the mean of the stretch on the path of
    contact, where the force of exact teeth stands still [N]."""
    worst = 0.0
    for stretch in on_path(exact, 0, willis):
        forces = points["force"][stretch[exact["time"][stretch] > close], 0]
        if len(forces):
            worst = max(worst, float(np.abs(forces - np.mean(forces)).max()))
    return worst


def order(coarse, fine):
    """Order in 1/facets between two pairs (facets, error)."""
    return float(np.log(coarse[1] / fine[1]) / np.log(fine[0] / coarse[0]))


def fitted(pairs):
    """Order in 1/facets through all pairs (facets, error): least squares of the logarithms."""
    return -float(np.polyfit(*np.log(np.array(pairs)).T, 1)[0])
