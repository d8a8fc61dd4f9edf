"""Error against cost of all that was tried for an answer."""

from typing import TYPE_CHECKING, Any

from ..extras import needed
from ..values import FileName

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# kinds of settings, by what their text begins with: the order is that of the legend
KINDS = [("ideal", "o"), ("lumped", "s"), ("tooth impact", "^"), ("tooth line +", "P"), ("tooth line_weber +", "D"),
         ("tooth line_weber", "X"), ("tooth line", "v"), ("solid", "<")]
# settings with another method: their counts do not compare
METHODS = ("rodas4", "dormand_prince", "fixed steps", "radau")
# errors below this part of the accuracy are drawn there
FLOOR = 1e-7
LONGEST = 90


def kind(setting):
    return next((number for number, (text, _) in enumerate(KINDS) if setting.startswith(text)), len(KINDS) - 1)


def picture(found: Any, file: FileName | None = None) -> "Figure":
    """Draws all that was tried for an answer, an `Accuracy`; writes `file` if there is one."""
    needed("matplotlib", "plot")
    from .. import style

    with style.styled():
        return _drawn(style, found, file)


def _drawn(style, found, file):
    runs, within, wanted = found.runs, found.within, ", ".join(found.wants)
    picture = style.figure(6.2)
    axes = picture.subplots()

    def point(run):
        return run.price / found.reference.price, 100.0 * max(run.error, FLOOR * within)

    tried = [run for run in runs[:-1] if not any(method in run.setting for method in METHODS)]
    others = [point(run) for run in runs[:-1] if run not in tried]
    for number, (text, marker) in enumerate(KINDS):
        of_kind = [point(run) for run in tried if kind(run.setting) == number]
        if of_kind:
            axes.plot(*zip(*of_kind), marker, color=style.CYCLE[number % len(style.CYCLE)], ms=6, alpha=0.75,
                      label=text.replace(" +", " + gear bodies"))
    if others:
        axes.plot(*zip(*others), ".", color=style.FAINT, ms=6, label="another method, judged by its time")
    axes.plot(*point(runs[-1]), "*", color=style.INK, ms=13, label="reference, drawn at what it strays")
    front, best = [], float("inf")
    for x, y in sorted(point(run) for run in tried):
        if y < best:
            front.append((x, y))
            best = y
    axes.step(*zip(*front), where="post", color=style.GREY, lw=1, zorder=1)
    chosen = [run for run in runs if run.place == "chosen"]
    for run in chosen:
        axes.plot(*point(run), "o", mfc="none", mec=style.RED, mew=2.2, ms=17, label="chosen")
    axes.axhline(100.0 * within, color=style.RED, lw=1, ls="--")
    axes.annotate("wanted", (0.003, 100.0 * within), xycoords=axes.get_yaxis_transform(), xytext=(4, 3),
                  textcoords="offset points", color=style.RED)
    axes.set(xscale="log", yscale="log", xlabel="cost over that of the reference",
             ylabel="largest error of the wanted quantities, %")
    short = wanted if len(wanted) <= LONGEST else wanted[:LONGEST] + " …"
    axes.set_title(f"{found.scene}: {short}")
    axes.legend(ncols=2)
    told = f"chosen is {chosen[0].setting}" if chosen else "nothing is accurate enough"
    style.caption(picture, "Each mark is a run of the scene with another level, law, set of effects or tolerance, compared with "
                  "the richest model at a fine tolerance. Lower is more accurate, left is cheaper; the grey line joins the "
                  f"cheapest for each accuracy. Below the dashed line is accurate enough; {told}.")
    if file is not None:
        style.save(picture, file)
    return picture
