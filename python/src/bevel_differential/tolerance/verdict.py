"""Which tolerance is worth its money: a line for each alternative, from its own runs."""

from dataclasses import dataclass

import numpy as np

from .figures import Estimate, gain, proportion
from .study import Alternative, Draws, Indices, Result, Study


@dataclass(frozen=True)
class Verdict:
    """Judgement on an alternative.

    `word`: "worth its money", "not worth its money" or "undecided"; without costs "raises the yield", "lowers the yield" or
    "no change seen". `yield_`: its yield. `gain`: this less (1 + cost) times the yield before: above 0 where a good
    differential becomes cheaper, (1 + cost)/yield being its price if the others are scrapped. `why`: the factor's part in a
    variance."""

    alternative: Alternative
    word: str
    yield_: Estimate
    gain: Estimate
    why: str

    def line(self, before: float) -> str:
        """The answer in a line; `before`: the yield with the tolerances as they are."""
        cost = "" if self.alternative.cost is None else f" at {100.0 * self.alternative.cost:+.3g} % of the price"
        gain = f"{self.gain.value:+.3f} [{self.gain.low:+.3f}, {self.gain.high:+.3f}]"
        return (f"{self.word}: {self.alternative.name}{cost} (yield {self.yield_.value:.3f} for {before:.3f}, gain {gain}"
                f"{'; ' + self.why if self.why else ''})")


def verdicts(study: Study, result: Result) -> list[Verdict]:
    """Judgements on all alternatives, the best first; none without limits, as there is no yield then."""
    if not study.limits:
        return []
    found = [_verdict(study, result, one, draws) for one, draws in zip(study.alternatives, result.others)]
    return sorted(found, key=lambda verdict: verdict.gain.value, reverse=True)


def _verdict(study, result, one: Alternative, draws: Draws):
    cost = one.cost or 0.0
    change = gain(result.base.good, draws.good, cost)
    if one.cost is None:
        words = "raises the yield", "lowers the yield", "no change seen"
    else:
        words = "worth its money", "not worth its money", "undecided"
    word = words[0] if change.low > 0.0 else words[1] if change.high < 0.0 else words[2]
    return Verdict(one, word, proportion(draws.good), change, _why(study, result, one))


def _why(study, result, one):
    """Where its factors take the largest part in the variance of a figure that has a limit."""
    places = [result.names.index(name) for name in one.factors if name in result.names]
    parts = []
    for limit in study.limits:
        indices = result.indices[str(limit.want)]
        if places and isinstance(indices, Indices):
            parts.append((float(np.max(indices.total[places])), str(limit.want)))
    if not parts:
        return ""
    part, want = max(parts)
    return f"it has a part in {100.0 * min(max(part, 0.0), 1.0):.0f} % of the variance of {want}"
