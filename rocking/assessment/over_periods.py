"""Over periods: what becomes of one structure on a support whose period is not known, period by period.

The verdicts stand side by side and are not mixed: a share of periods would be no probability.
"""

import math
from collections.abc import Mapping, Sequence
from itertools import groupby

from rocking.assessment.decide import Verdict


def periods_in_words(verdicts: Mapping[float, Verdict]) -> str:
    """Return the verdicts by the period [s] of a support, 0 of the ground, in intervals: one need not change once only.

    "stands on a building of T_b ≤ 0.25 s, is uncertain at T_b 0.3 s, overturns from 0.36 s on (tried to 0.6 s)".
    """
    groups = [
        (verdict, [period for period, _ in many])
        for verdict, many in groupby(sorted(verdicts.items()), lambda pair: pair[1])
    ]
    last = len(groups) - 1
    return ", ".join(
        f"{verdict.predicate} {_interval(periods, place == last)}"
        for place, (verdict, periods) in enumerate(groups)
    )


def _interval(periods: Sequence[float], is_last: bool) -> str:
    """The interval in which one verdict holds; periods: ascending, 0 of the ground."""
    first = periods[0]
    end = periods[-1]
    if end == 0:
        return "on the ground"
    if first == 0:
        whatever = "on the ground and " if is_last else ""
        return f"{whatever}on a building of T_b ≤ {end:.3g} s"
    if first == end:
        return f"at T_b {first:.3g} s"
    return f"from {first:.3g} s on (tried to {end:.3g} s)" if is_last else f"from {first:.3g} to {end:.3g} s"


def placed(structure: str, support_period: float | None) -> str:
    """Return the name of a structure with the period [s] of its support: "parapet, T_b 0.25 s"; 0: its ground."""
    if support_period is None or math.isnan(support_period):
        return structure
    return f"{structure}, T_b {support_period:.3g} s" if support_period else f"{structure}, on the ground"
