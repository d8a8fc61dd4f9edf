"""Start values of the FMU that take effect in a run and that nobody set: which of them are accepted, and their warning in one line."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, TypeAlias

from .values import NOBODY_SET, DifferentialError

if TYPE_CHECKING:
    from .fmu import Fmu

# True to accept all start values, or names of accepted ones
Accepted: TypeAlias = bool | Sequence[str]
# group of the FMU's list with complete names of variables
INPUTS = "drives and loads"


def checked(fmu: "Fmu", accepted: Accepted) -> Accepted:
    """Accepted start values, with the present names of their variables."""
    if isinstance(accepted, bool):
        return accepted
    if isinstance(accepted, str):
        raise DifferentialError(f"accept_start_values = {accepted!r}: it is True, False, or a list of names, such as [{accepted!r}]")
    return [fmu.settable(name).name for name in accepted]


def unaccepted(listed: str, accepted: Accepted) -> str:
    """List of the FMU, groups with "; " between them, without accepted values."""
    if accepted is True or not listed:
        return ""
    groups = []
    for group in listed.split("; "):
        name, _, values = group.partition(": ")
        left = [value for value in values.split(", ") if _full(name, value.partition(" = ")[0]) not in (accepted or ())]
        groups += [f"{name}: {', '.join(left)}"] if left else []
    return "; ".join(groups)


def in_short(texts: Iterable[str], accepted: Accepted = False) -> list[str]:
    """Texts with the list of start values as one line that states their number; without this line if all are accepted."""
    found = []
    for text in texts:
        head, prefix, listed = text.partition(NOBODY_SET)
        left = unaccepted(listed, accepted)
        if left:
            found.append(f"{head}{left.count(' = ')} start values of the study influence this scene, and nobody set them: `plan SCENE`, or "
                         "nobody_set() in Python, lists them; accept_start_values = true accepts them")
        elif not prefix:
            found.append(text)
    return found


def _full(group: str, name: str) -> str:
    return name if group == INPUTS else f"{group}.{name}"
