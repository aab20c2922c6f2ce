"""Scores of the research that a page prints: kept as the target wrote them, and named cell by cell.

`docs/measured/scores/TARGET.csv` is the `scores.csv` of the last run of a target, whose row of figures.csv says when
and on what that was. A page prints a score by `<!-- score FORM: TARGET; SUBJECT; PART; MEASURE -->`, where the form is
one of `FORMS`.
"""

import math
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

from docs.research.scores import Score
from rocking.errors import ConfigurationError
from rocking.tables import read_rows

SCORES = Path(__file__).parents[1] / "measured" / "scores"


@cache
def scores_of(target: str) -> tuple[Score, ...]:
    """Return the scores of the last run of a target. Raises ConfigurationError where none are kept."""
    path = SCORES / f"{target}.csv"
    if not path.is_file():
        names = ", ".join(sorted(known.stem for known in SCORES.glob("*.csv")))
        raise ConfigurationError(f"target is {target!r}, but must be one whose scores are kept: {names}.")
    return tuple(read_rows(Score, path))


def score(target: str, subject: str, part: str, measure: str) -> Score:
    """Return one score by its names. Raises ConfigurationError where the target has none such, or several."""
    named = [
        kept
        for kept in scores_of(target)
        if (kept.subject, kept.part, kept.measure) == (subject, part, measure)
    ]
    if len(named) != 1:
        raise ConfigurationError(
            f"score is {'; '.join((target, subject, part, measure))!r}, of which {target}.csv has {len(named)}, but "
            "must have one; take subject, part and measure from that table."
        )
    return named[0]


def printed_score(form: str, content: str) -> str:
    """Return what a page prints for `content`, "TARGET; SUBJECT; PART; MEASURE", in a form.

    Raises ConfigurationError for an unknown form or score.
    """
    if form not in FORMS:
        raise ConfigurationError(f"form of a score is {form!r}, but must be one of {', '.join(FORMS)}.")
    names = [name.strip() for name in content.split(";")]
    if len(names) != 4:
        raise ConfigurationError(f"score is {content!r}, but must be TARGET; SUBJECT; PART; MEASURE.")
    return FORMS[form](score(*names))


def _percent(decimals: int) -> Callable[[Score], str]:
    """The share with its interval in per cent: "52 % (45–60)"."""

    def words(kept: Score) -> str:
        value, low, high = (
            f"{100 * end:.{decimals}f}" for end in (kept.value, kept.value_low, kept.value_high)
        )
        return "–" if math.isnan(kept.value) else f"{value} % ({low}–{high})"

    return words


def _number(decimals: int) -> Callable[[Score], str]:
    """The value with its interval: "0.97 (0.90–1.02)"."""

    def words(kept: Score) -> str:
        value, low, high = (
            f"{end:.{decimals}f}".replace("-", "−") for end in (kept.value, kept.value_low, kept.value_high)
        )
        between = " to " if kept.value_low < 0 else "–"
        return "–" if math.isnan(kept.value) else f"{value} ({low}{between}{high})"

    return words


def _count(kept: Score) -> str:
    """How many of the cases: "8 of 278"."""
    return f"{round(kept.value * kept.cases)} of {kept.cases}"


def _count_and_share(kept: Score) -> str:
    """The same with the share: "8 of 278, 2.9 % (1.4–4.6)"; where none or all do, what the share is below or above."""
    if not kept.cases:
        return "–"
    if kept.value == 0:
        return f"{_count(kept)}, below {100 * kept.value_high:.1f} %"
    if kept.value == 1:
        return f"{_count(kept)}, above {100 * kept.value_low:.1f} %"
    return f"{_count(kept)}, {_percent(1)(kept)}"


def _sample(kept: Score) -> str:
    """On what: "49 sites of 19 earthquakes; 278 cases"."""
    return f"{kept.sites} sites of {kept.earthquakes} earthquakes; {kept.cases} cases"


FORMS: Mapping[str, Callable[[Score], str]] = {
    "%": _percent(0),
    "%.1": _percent(1),
    "%.2": _percent(2),
    "=%": lambda kept: f"{100 * kept.value:.0f} %",
    ".2": _number(2),
    ".3": _number(3),
    "=.2": lambda kept: f"{kept.value:.2f}",
    "=.3": lambda kept: f"{kept.value:.3f}",
    "=n": lambda kept: f"{round(kept.value * kept.cases)}",
    "n": _count,
    "n%": _count_and_share,
    "sites": _sample,
}
"""How a score may be printed."""
