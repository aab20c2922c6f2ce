"""The conclusion on each structure: made once of the rows of the tables, and the same wherever a person reads it."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rocking.assessment.decide import ONE_RUN, Severity, Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.rows import (
    AgreementRow,
    ComparisonRow,
    ExpectedFallsRow,
    VerdictRow,
    WarningRow,
    falls_recorded,
    hardly_spread,
    worst_period_each,
)
from rocking.earthquakes.sample import interval_words
from rocking.quantities import counted, listed, percents
from rocking.structures.kinds import StructureKind
from rocking.warnings import RockingWarning

CLASS = 20
"""Structures from which on a list is a class: how many of them fall is of interest, not which ones."""
UNSAID = (AssessmentKind.NOTHING_TO_DO, AssessmentKind.NOTHING_DECIDES)
"""Warnings of which a row of a report says nothing."""
TO_CHECK = (
    StructureKind.SIZE_UNUSUAL,
    StructureKind.LEVELS_TYPED,
    StructureKind.BROADER_THAN_TALL,
    AssessmentKind.VERTICAL_MISSING,
)
"""Kinds of warnings for which somebody has to check what was typed before anything else is read."""
_MOVES = 0.01
"""Distance below a floor from which on it is said, m."""
_MOST_TO_CHECK = 3
"""Warnings of these kinds that are printed with a conclusion; warnings.csv holds all."""
_MOST_NAMED = 20
FALLING = (Verdict.OVERTURNS, Verdict.PROBABLY_OVERTURNS)


@dataclass(frozen=True)
class Conclusion:
    """What becomes of a structure under a record; of one on a support, at the period that is worst.

    row: its row of that period. case: the row of the component that turns it farthest there; None where no
    component gave a result. elsewhere: its rows at the other periods of the support, without the ground below it.
    """

    row: VerdictRow
    case: ComparisonRow | None
    elsewhere: Sequence[VerdictRow] = ()

    @property
    def ratios(self) -> tuple[float, float, float]:
        """Rotation ratios of the closed form, of the block and of the mechanism under the record; nan without one."""
        if self.case is None:
            return math.nan, math.nan, math.nan
        whole = self.case.integrated_rotation_ratio
        return self.case.predicted_rotation_ratio, self.case.block_on_record_rotation_ratio, whole

    @property
    def severity(self) -> Severity:
        """Key by which the worst comes last: that of its verdict."""
        return self.row.severity

    @property
    def warning(self) -> RockingWarning:
        """What to do about it; where there is nothing to do, what explains the verdict."""
        decision = self.row.decision
        verdict = decision.verdict
        if not math.isnan(self.row.friction_needed) and decision.other_model is None:
            return self._sliding(self.row.friction_needed)
        if decision.warning is not None:
            return decision.warning
        shares = [place.overturning_share for place in self.elsewhere if place.overturning_share >= 0]
        if shares and "–" in (share := percents(*shares)):
            return RockingWarning.of(AssessmentKind.OTHER_PERIODS, share=share)
        # Runs of contact dynamics are on the friction that it has.
        if self.case is not None and self.case.slides and not self.row.stack_runs:
            return self._sliding(self.case.required_friction)
        falls = self.ratios[-1] == math.inf
        if verdict is Verdict.PROBABLY_OVERTURNS and not falls:
            return RockingWarning(AssessmentKind.STANDS_AS_RECORDED)
        if verdict in FALLING:
            return RockingWarning(AssessmentKind.STRENGTHEN)
        if self.case is not None and verdict.stays_up and self.case.bearing_displacement_m >= _MOVES:
            return RockingWarning.of(AssessmentKind.FLOORS_MOVE, moved_m=self.case.bearing_displacement_m)
        if verdict.stays_up:
            return RockingWarning(AssessmentKind.NOTHING_TO_DO)
        if falls and verdict is Verdict.PROBABLY_STANDS:
            return RockingWarning(AssessmentKind.FALLS_AS_RECORDED)
        return RockingWarning(AssessmentKind.NOTHING_DECIDES)

    def _sliding(self, largest: float) -> RockingWarning:
        """The friction that a contact needs as it lifts, and the `largest`: inf where nothing presses it."""
        if largest == math.inf:
            return RockingWarning(AssessmentKind.CONTACTS_OPEN)
        # The largest alone is of an instant, and would call a slender pier one that slides.
        lifting = self.case.lifting_friction if self.case else math.nan
        if math.isnan(lifting):
            return RockingWarning(AssessmentKind.FRICTION_SHORT)
        return RockingWarning.of(AssessmentKind.CONTACT_SLIDES, lifting=lifting, largest=largest)


def worst_cases(comparison: Iterable[ComparisonRow]) -> dict[tuple[str, str, float | None], ComparisonRow]:
    """Return the row of the component that turns a structure farthest, the first of several that overturn it.

    By record, structure and period of its support.
    """
    cases: dict[tuple[str, str, float | None], ComparisonRow] = {}
    rows = list(comparison)
    unknown = [row for row in rows if math.isnan(row.integrated_rotation_ratio)]
    known = [row for row in rows if not math.isnan(row.integrated_rotation_ratio)]
    known.sort(key=lambda row: row.integrated_rotation_ratio, reverse=True)
    for row in (*known, *unknown):
        cases.setdefault((row.record, row.structure, row.support_period_s), row)
    return cases


def conclusions(verdicts: Iterable[VerdictRow], comparison: Iterable[ComparisonRow]) -> list[Conclusion]:
    """Return the conclusion on each structure under each record, the worst first."""
    rows = list(verdicts)
    farthest = worst_cases(comparison)
    others: dict[tuple[str, str], list[VerdictRow]] = {}
    for row in rows:
        others.setdefault((row.record, row.structure), []).append(row)
    made = [
        Conclusion(
            worst,
            farthest.get((worst.record, worst.structure, worst.support_period_s)),
            [
                verdict
                for verdict in others[worst.record, worst.structure]
                if verdict is not worst and verdict.support_period_s
            ],
        )
        for worst in worst_period_each(rows)
    ]
    return sorted(made, key=lambda conclusion: conclusion.severity, reverse=True)


def worst_of_each(made: Iterable[Conclusion]) -> list[Conclusion]:
    """Return of each structure the conclusion under its worst record, the worst first."""
    worst: dict[str, Conclusion] = {}
    for conclusion in sorted(made, key=lambda conclusion: conclusion.severity, reverse=True):
        worst.setdefault(conclusion.row.structure, conclusion)
    return list(worst.values())


def fallen_in_one_run(made: Iterable[Conclusion]) -> frozenset[str]:
    """Return the structures that fall in the one run that was made of them, where no ensemble was followed."""
    decided = ((conclusion.row.structure, conclusion.row.decision) for conclusion in made)
    return frozenset(
        name for name, decision in decided if decision.share_in_words == ONE_RUN and decision.share == 1
    )


def conclusion_in_words(
    words: Mapping[str, Verdict], records: int = 1, fallen: Collection[str] = frozenset()
) -> str:
    """Return the sentence on all structures, by name the worst verdict of each: "4 of 12 structures overturn …".

    records: under which that is. fallen: those of them that fall in one run and are uncertain for want of an ensemble.

    >>> from rocking.assessment.conclusion import conclusion_in_words
    >>> from rocking.assessment.decide import Verdict
    >>> conclusion_in_words({"pier": Verdict.OVERTURNS, "wall": Verdict.STANDS, "spire": Verdict.CANNOT_BE_TOLD})
    '1 of 3 structures overturns or probably does; 1 cannot be told.'
    >>> conclusion_in_words({"pier": Verdict.STANDS, "wall": Verdict.STANDS}, records=7)
    'All 2 structures stand under every record.'
    >>> conclusion_in_words({"pier": Verdict.UNCERTAIN})
    'pier is uncertain.'
    >>> conclusion_in_words({"pier": Verdict.UNCERTAIN, "wall": Verdict.UNCERTAIN}, fallen={"pier"})
    '1 of 2 structures falls in its one run, without an ensemble; 1 is uncertain.'
    """
    every = len(words)
    some = " under some record" if records > 1 else ""
    throughout = " under every record" if records > 1 else ""
    if every <= 1:
        said = (
            f"{name} {verdict.predicate}{throughout if verdict.stays_up else some}."
            for name, verdict in words.items()
        )
        return next(said, "No structure was assessed.")
    if all(verdict.stays_up for verdict in words.values()):
        return f"All {every} structures stand{throughout}."
    falling = sum(verdict in FALLING for verdict in words.values())
    unknown = sum(verdict is Verdict.CANNOT_BE_TOLD for verdict in words.values())
    if unknown == every:
        return f"What becomes of all {every} structures cannot be told."
    of_them = f"All {every}" if falling == every else f"{falling or 'None'} of {every}"
    does = "overturns or probably does" if falling <= 1 else "overturn or probably do"
    under = some.replace("some", "any") if not falling else some
    # Nothing overturns for sure in one run: the verdict alone would read as if nothing fell.
    counted_fallen = [name for name in fallen if words.get(name) is Verdict.UNCERTAIN]
    if counted_fallen and not falling:
        of_them = f"{len(counted_fallen)} of {every}"
        does = "falls in its one run" if len(counted_fallen) == 1 else "fall in their one run"
        does += ", without an ensemble"
        under = some
    uncertain = sum(verdict is Verdict.UNCERTAIN for verdict in words.values())
    uncertain -= 0 if falling else len(counted_fallen)
    verb = "is" if uncertain == 1 else "are"
    # Unsaid, a structure of which half the members fall would be read as one that stands.
    open_ = [f"{uncertain} {verb} uncertain"] if uncertain else []
    open_ += [f"{unknown} cannot be told"] if unknown else []
    whose = "its" if uncertain + unknown == 1 else "their"
    worst = f"under {whose} worst record " if records > 1 else ""
    return f"{of_them} structures {does}{under}" + (f"; {worst}{', '.join(open_)}." if open_ else ".")


def falls_in_words(falls: Sequence[ExpectedFallsRow]) -> str:
    """Return the sentence on how many structures of a class are expected to fall; "" for a shorter list.

    falls: of each record and of all, as the table has them.
    """
    of_all = next((row for row in falls if not row.record), None)
    if of_all is None or of_all.structures < CLASS or of_all.without_share == of_all.structures:
        return ""
    of_records = np.array([row.expected_falls for row in falls_recorded(falls)])
    records = of_records.size
    expected = f"{of_all.expected_falls:.0f} of {of_all.structures} structures are expected to fall"
    sentence = f"{expected} under the record" if records == 1 else f"{expected} under such a record"
    if of_all.earthquakes == 1 < records:
        sentence += f" (no interval: all {counted(of_all.stations, 'station')} are of one earthquake)"
    elif not math.isnan(of_all.expected_falls_low):
        interval = f"{of_all.expected_falls_low:.0f}–{of_all.expected_falls_high:.0f}"
        sample = f"{counted(of_all.stations, 'station')} of {counted(of_all.earthquakes, 'earthquake')}"
        because = f", by the spread over {sample}"
        if hardly_spread(of_records / of_all.structures, of_all.structures):
            middle = float(np.median(of_records))
            falling = "all are" if middle > of_all.structures - 0.5 else "none is"
            if 0.5 <= middle <= of_all.structures - 0.5:
                falling = "the same number is"
            because = f"; wide, as under most of the records, of {sample}, {falling} expected to fall"
        sentence += f" ({interval_words(of_all.earthquakes)}: {interval}{because})"
    if of_all.still:
        sentence += f"; nothing lifts any of them at {of_all.still} of {counted(of_all.stations, 'station')}"
    if not of_all.without_share:
        return f"{sentence}."
    without_share = f"{of_all.without_share:.{0 if records == 1 else 1}f}"
    return (
        f"{sentence}; {without_share} more cannot be told{' per record on average' if records > 1 else ''}."
    )


def to_check(warnings: Iterable[WarningRow]) -> list[str]:
    """Return what has to be checked of what was typed: the first warnings in full, of the others what they are of.

    It is the same with every conclusion: on the first page of a report, and at the end of a run.
    """
    shown: dict[str, WarningRow] = {}
    without_vertical: dict[str, WarningRow] = {}
    for row in warnings:
        if row.kind is AssessmentKind.VERTICAL_MISSING:
            without_vertical.setdefault(row.record, row)
        elif row.kind in TO_CHECK:
            shown[row.sentence] = row
    if without_vertical:  # one setting, whatever number of records it is asked of
        missing = RockingWarning(AssessmentKind.VERTICAL_MISSING, listed(list(without_vertical), _MOST_NAMED))
        shown[str(missing)] = next(iter(without_vertical.values()))
    if len(shown) <= _MOST_TO_CHECK:
        return list(shown)
    first, others = list(shown)[: _MOST_TO_CHECK - 1], list(shown.values())[_MOST_TO_CHECK - 1 :]
    names = list(dict.fromkeys(row.about.partition(": ")[0] for row in others))
    values = counted(len(others), "value")
    return [
        *first,
        f"To be checked likewise, as warnings.csv says: {values} of {listed(names, _MOST_NAMED)}.",
    ]


def falls_seen_in_words(agreed: Sequence[AgreementRow]) -> str:
    """Say how many of the falls the closed form sees: "sees 19 of 28 falls, and 2 of 3 under made records".

    agreed: the counts of all cases first, and among the others those of made records alone.
    """
    of_all, *others = agreed
    of_made = (
        f", and {row.overturning_hits} of {row.overturning} under made records" for row in others if row.made
    )
    return f"sees {of_all.overturning_hits} of {counted(of_all.overturning, 'fall')}{''.join(of_made)}"
