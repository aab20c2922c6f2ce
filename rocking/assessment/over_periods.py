"""Over periods: what becomes of one structure on a support whose period is not known, period by period.

The verdicts stand side by side and are not mixed: a share of periods would be no probability.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

from rocking.assessment.verdict import Judgement, Verdict
from rocking.structures import Structure
from rocking.structures.standing import Standing

_DOES = {
    Verdict.STANDS: "stands",
    Verdict.OVERTURNS: "overturns",
    Verdict.UNDECIDED: "is undecided",
    Verdict.UNKNOWN: "is unknown",
    Verdict.CANNOT_OVERTURN: "cannot overturn",
}


@dataclass(frozen=True, eq=False)
class OverPeriods:
    """The judgements on one structure of the list, on the ground first, then by the period of its support.

    standings, judgements: one each for every period.
    """

    standings: tuple[Standing, ...]
    judgements: tuple[Judgement, ...]

    @property
    def structure(self) -> str:
        """Name of the structure in the list."""
        return self.standings[0].listed_structure

    @property
    def place(self) -> str:
        """Name of its support."""
        return self.standings[0].place

    @property
    def periods(self) -> list[float]:
        """Periods of the support, s; 0 is the ground."""
        return [each.period for each in self.standings]

    @property
    def severity(self) -> tuple[float, ...]:
        """Key by which the worst of several comes last: that of the period that is worst."""
        return max(each.severity for each in self.judgements)

    @property
    def sentence(self) -> str:
        """The verdicts over the periods, in intervals: a verdict need not change once only.

        "parapet on roof stands on a building of T_b ≤ 0.25 s, is undecided at T_b 0.3 s, overturns from 0.36 s on
        (tried to 0.6 s)".
        """
        verdicts = [each.verdict for each in self.judgements]
        pairs = zip(self.periods, verdicts, strict=True)
        groups = [
            (verdict, [period for period, _ in many])
            for verdict, many in groupby(pairs, lambda pair: pair[1])
        ]
        last = len(groups) - 1
        parts = [
            f"{_DOES[verdict]} {_interval(periods, place == last)}"
            for place, (verdict, periods) in enumerate(groups)
        ]
        return f"{self.structure} on {self.place} {', '.join(parts)}"


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


def over_periods(stations: Iterable[tuple[Structure, Judgement]]) -> list[OverPeriods]:
    """Return those of the structures that stand on a support of the list, each with all its periods, in their order.

    stations: each structure with what became of it.
    """
    groups: dict[tuple[str, str], list[tuple[Standing, Judgement]]] = {}
    for structure, judgement in stations:
        if (standing := structure.standing) is not None:
            groups.setdefault((standing.listed_structure, standing.place), []).append((standing, judgement))
    swept = []
    for pairs in groups.values():
        pairs.sort(key=lambda pair: pair[0].period)
        standings, judgements = zip(*pairs, strict=True)
        swept.append(OverPeriods(standings, judgements))
    return swept
