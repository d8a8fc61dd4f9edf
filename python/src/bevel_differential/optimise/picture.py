"""A picture of a front: each objective against the first one that is minimised."""

from collections.abc import Sequence

from ..values import FileName
from .design_task import DesignRow
from .front import costs, dominates
from .problem import Objective, Problem
from .quantities import Catalogue
from .report import LETTERS


def picture(front: Sequence[DesignRow], chosen: Sequence[DesignRow], compared: dict[str, DesignRow], problem: Problem,
            file: FileName) -> None:
    """Draws the front in panels, with the chosen designs by letter and the compared ones as stars; PNG."""
    from .. import style
    objectives, catalogue = problem.objectives, Catalogue(problem.scene.fmu)
    across = next((each for each in objectives if each.sign > 0.0), objectives[0])
    others = [each for each in objectives if each is not across]
    compared = {name: row for name, row in compared.items() if all(str(each.want) in row.figures for each in objectives)}
    def shown(rows, objective):
        variable = catalogue.variable(objective.want.name)
        return [variable.shown(row.figures[str(objective.want)])[1] for row in rows]

    better = _dominating(front, compared, objectives)
    plain = [row for row in front if row not in better]
    with style.styled():
        figure, panels = style.panels(1, len(others), 4.8, squeeze=False)
        for panel, up in zip(panels[0], others):
            panel.plot(shown(plain, across), shown(plain, up), "o", ms=3.5, color=style.GREY, label="front")
            if better:
                panel.plot(shown(better, across), shown(better, up), "o", ms=4.5, color=style.BLUE,
                           label="front, better in all than a compared design")
            for k, (name, row) in enumerate(compared.items()):
                panel.plot(shown([row], across), shown([row], up), "*", ms=14, color=(style.RED, style.GREEN, style.BROWN)[k % 3],
                           label=name + (" (breaks conditions)" if row.refused else ""))
            for letter, x, y in zip(LETTERS, shown(chosen, across), shown(chosen, up)):
                panel.plot([x], [y], "o", ms=8, mfc="none", mec=style.INK)
                panel.annotate(letter, (x, y), xytext=(5, 5), textcoords="offset points", fontweight="bold")
            panel.set(xlabel=_label(catalogue, across), ylabel=_label(catalogue, up))
        handles, labels = panels[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
        style.save(figure, file)


def _label(catalogue, objective: Objective) -> str:
    unit = catalogue.variable(objective.want.name).shown(0.0)[0]
    better = "less" if objective.sign > 0.0 else "more"
    name = str(objective.want).removesuffix(":final").replace("_transmission_error", "\n_transmission_error")
    return f"{name}{f', {unit}' if unit else ''}\n({better} is better)"


def _dominating(front, compared, objectives):
    olds = costs(list(compared.values()), objectives)
    return [row for row, cost in zip(front, costs(front, objectives)) if any(dominates(cost, old) for old in olds)]
