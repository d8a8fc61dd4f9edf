"""Picture of the comparison: cost of a run of the turn, and convergence of its ripple."""

from bevel_differential import style

MARKERS = {"this program": "o", "MuJoCo": "s", "Drake": "^"}


def draw(path, results):
    """Draws cost and ripple of the turn; a line runs from coarse to fine. `results` are runs without skipped teeth."""
    style.apply()
    figure, axes = style.panels(1, 1, 7.4)
    for group in dict.fromkeys(result["row"].group for result in results):
        turns = [result["cases"]["turn"] for result in results if result["row"].group == group]
        if max(turns[0]["ripple"]) < 1e-6:
            continue
        marker = next(mark for tool, mark in MARKERS.items() if group.startswith(tool))
        costs, ripples = [turn["cost"] for turn in turns], [turn["ripple"][0] for turn in turns]
        drawn, = axes.plot(costs, ripples, marker=marker, ms=7, label=group.replace("`", ""))
        axes.plot(costs[-1:], ripples[-1:], marker=marker, ms=13, mfc="none", color=drawn.get_color(), ls="")
    axes.set(xscale="log", xlabel="seconds on the processor per second simulated", ylabel="ripple, left, peak to peak, %",
             ylim=(0.0, None), title="The study's turn: cost of a run, and the ripple that it finds")
    style.plain_decades(axes.xaxis)
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    style.caption(figure, "Each line runs from coarse to fine settings of one tool; the ring marks the finest. Where a line is level, the "
                  "result no longer depends on the setting, as in this program at every tolerance. Multi-body programs with contact "
                  "for general shapes change their answer with step, facets and kind of contact, and cost more.")
    style.save(figure, path)
