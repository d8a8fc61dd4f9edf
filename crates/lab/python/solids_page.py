"""Text about facets: tables and sentences for docs/inside/cost.md and docs/study.md."""

from bevel_differential.text import markdown
from solids_errors import fitted
from tools import machine, significant

# facets from which an order is fitted: with fewer facets, no single term dominates yet
FINE = 16
# facet numbers of the short table
SHORT = (4, 8, 16, 32, 64, 128)
# rpm for 1 deg/s
RPM = 1.0 / 6.0
# columns of the table
SHOWN = {"speed_rms": "speed, rpm", "speed_path_rms": "on the path", "speed_corner_rms": "at corners", "force_mean": "mean force, N",
         "te_rms": "TE, µm", "te_swing_rms": "its swing, µm"}
# quantities whose orders are stated, with their names
ORDERED = {"te_rms": "transmission error", "te_swing_rms": "its swing", "force_mean": "mean force",
           "force_path_ripple": "force ripple on the path", "speed_path_rms": "speed on the path",
           "speed_corner_rms": "speed at tip corners", "speed_max": "largest error of speed"}


def three(value):
    """Formats with three significant digits."""
    return significant(value, 3)


def percent(part, whole):
    return three(100.0 * part / whole)


def page(found):
    """Text for docs/inside/cost.md."""
    parts = [_sentences(found)]
    for title, which in [("Patch (`solid.smoothing` = 1): errors against exact teeth, and cost.", 1),
                         ("Deepest point (`solid.smoothing` = 0.02): errors against exact teeth, and cost.", 0)]:
        parts.append(f"{title}\n\n{markdown(_errors(found, which), left=())}")
    parts.append(f"Last rows: exact teeth at 1e-6 against themselves at 1e-9. Measured on {machine()}.")
    return "\n".join(parts)


def _sentences(found):
    orders = []
    for quantity, what in ORDERED.items():
        fine = [[pair for pair in found.series(quantity, which) if pair[0] >= FINE] for which in (0, 1)]
        orders.append(f"{what} {' and '.join(f'{fitted(pairs):.1f}' if len(pairs) > 1 else '–' for pairs in fine)}")
    return f"Observed orders in 1/facets, fitted from {FINE} facets on, deepest point and patch: {'; '.join(orders)}.\n"


def _errors(found, which):
    """Errors and cost by facets at one smoothing."""
    def cells(row, errors):
        cost = [str(row.counts[0]), three(row.taken / found.tooth.taken), three(row.real_time)]
        return [*(three(errors[name] * (RPM if name.startswith("speed") else 1.0)) for name in SHOWN), *cost]

    rows = [found.solid(facets, which) for facets in filter(SHORT.__contains__, found.plan.facets)]
    return [["facets", "arc, µm", *SHOWN.values(), "steps", "× tooth", "× real time"],
            *([str(row.facets), three(1e6 * row.arc), *cells(row, row.errors[0])] for row in rows),
            ["tooth", "0", *cells(found.tooth, found.tooth.errors[1])]]


def study(found):
    """Table and sentences for docs/study.md: the part of the force's ripple that facets cause."""
    def cells(row):
        return [f"{row.look['peak'] / row.look['mean']:.4f}", *(f"{percent(value, row.look['mean'])} %"
                                                                for value in (row.look["ripple"], row.path_ripple))]

    ripple = ["ripple", "only from facets"]
    table = [["facets", "arc / overlap", "deepest point: peak / mean", *ripple, "patch: peak / mean", *ripple]]
    for facets in filter(SHORT.__contains__, found.plan.facets):
        deepest, patch = (found.solid(facets, which) for which in (0, 1))
        table.append([str(facets), f"{percent(patch.arc, found.overlap)} %", *cells(deepest), *cells(patch)])
    tooth = found.tooth
    table.append(["exact teeth", "0", *cells(tooth), *cells(tooth)])
    worst = max(row.look["tangential"] for row in found.rows)
    text = (f"The force of exact teeth swings by {three(tooth.look['ripple'])} N, {percent(tooth.look['ripple'], tooth.look['mean'])} % of "
            f"the mean of {tooth.look['mean']:.0f} N, because tip corners take over and release load. A single loaded pair overlaps by "
            f"{three(1e3 * found.overlap)} mm under the study's K. T/r_p, the quantity of the study, varies by at most {three(worst)} N "
            f"for any number of facets, because the load is constant and the gears are light.\n")
    return f"{markdown(table, left=())}\n{text}"
