"""Fate: what became of one structure under one record, all components considered, and the rows that tell it."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar, get_args, get_type_hints

from rocking.assessment.rows import of_record as rows
from rocking.assessment.rows.of_record import ComparisonRow, EnsembleRow, FailureRow, MembersRow, VariationRow
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.verdict import Verdict
from rocking.records import Accelerogram
from rocking.structures import Outcome
from rocking.tables import Row, column, read_table, row, write_tables, written_together

if TYPE_CHECKING:  # else who reads a table would load numba
    from rocking.assessment.assess import Assessment, Failure

R = TypeVar("R", ComparisonRow, EnsembleRow, FailureRow, VariationRow)
BOTH_COMPONENTS = "both"
"""In place of a component: all directions of a record."""
ORDER = (Verdict.OVERTURNS, Verdict.UNDECIDED, Verdict.UNKNOWN, Verdict.STANDS)
"""The worst verdict first; what could not be computed may overturn."""


@row("verdicts")
class Fate(MembersRow):
    """One row per record and structure: the verdict over all components, its count and its reason.

    The component is that of the governing case.
    """

    rotation_ratio: float = column("Largest rotation over critical rotation as recorded; INF if it overturns")
    direction: str = column("Direction of the largest rotation; empty with one")
    polarity: str = column("Sign of the motion of the largest rotation: as recorded, reversed; or empty")
    peak_side: int | None = column(rows.PEAK_SIDE)
    why: str = column("Reason for the verdict")

    @property
    def severity(self) -> tuple[float, ...]:
        """Key by which the worst of several comes last: verdict, then share of members, then rotation."""
        return (-ORDER.index(self.verdict), *map(_or_least, (self.overturning_share, self.rotation_ratio)))

    @property
    def count(self) -> str:
        """Members that overturn, of how many: "12 of 64"; "" without an ensemble."""
        return f"{self.overturning_members} of {self.members}" if self.members else ""

    @property
    def leaning(self) -> str:
        """What an undecided case leans to, with the counts; "" of another.

        "leans to stands, overturns in 0 of 64, with the crack at 3 m in 12 of 64".
        """
        if self.verdict is not Verdict.UNDECIDED:
            return ""
        leans_to = Verdict.OVERTURNS if self.overturning_share >= 0.5 else Verdict.STANDS
        words = [f"leans to {leans_to}"]
        if self.members:
            words.append(f"overturns in {self.count}")
        if self.elsewhere_members:
            there = f"{self.elsewhere_overturning_members} of {self.elsewhere_members}"
            words.append(f"with the {self.elsewhere_crack} in {there}")
        elif self.elsewhere_crack:
            words.append(f"overturns with the {self.elsewhere_crack}")
        return ", ".join(words)


def worst_first(fates: Iterable[tuple[str, Fate]]) -> list[str]:
    """Return the names, of records or structures, by the shares of members that overturn, summed over all of a name."""
    shares: dict[str, float] = {}
    for name, fate in fates:
        share = fate.overturning_share
        shares[name] = shares.get(name, 0.0) + (0.0 if math.isnan(share) else share)
    return sorted(shares, key=shares.__getitem__, reverse=True)


def fates(
    cases: Iterable[ComparisonRow],
    ensembles: Iterable[EnsembleRow] = (),
    failures: Iterable[FailureRow] = (),
    variations: Iterable[VariationRow] = (),
) -> list[Fate]:
    """Return what became of each structure under each record, in the order of `cases`.

    The ensemble over all directions decides, or where there is none the one that overturns, then rotates, most; without
    any ensemble the single run of the worst component. A component that gave no result makes the verdict unknown,
    unless another component overturns or an ensemble over all directions decides. variations: of whose cracks, without
    an ensemble, one that overturns leaves undecided what stands as given.
    """
    by_pair = _by_pair(cases)
    failed = _by_pair(
        each for each in failures if each.stage in ("responses", "directions") and each.structure
    )
    governing = {pair: max(several, key=_weight) for pair, several in _by_pair(ensembles).items()}
    fallen = _by_pair(
        each for each in variations if each.crack and math.isinf(each.integrated_rotation_ratio)
    )
    return [
        _fate(of_pair, governing.get(pair), failed.get(pair, ()), fallen.get(pair, ()))
        for pair, of_pair in by_pair.items()
    ] + [
        Fate.of(first, verdict=Verdict.UNKNOWN, overturning_members=0, members=0, why=first.message)
        for pair, (first, *_) in failed.items()
        if pair not in by_pair
    ]


def _by_pair(rows: Iterable[R]) -> dict[tuple[str, str], list[R]]:
    """The rows of each record and structure, in the order in which they come."""
    grouped: dict[tuple[str, str], list[R]] = {}
    for each in rows:
        grouped.setdefault((each.record, each.structure), []).append(each)
    return grouped


def _fate(
    cases: Sequence[ComparisonRow],
    ensemble: EnsembleRow | None,
    failures: Sequence[FailureRow],
    fallen: Sequence[VariationRow],
) -> Fate:
    worst = max(cases, key=_badness)
    verdict = Verdict.STANDS
    why = worst.answer_reason or "one run as recorded, without an ensemble"
    elsewhere_crack = ensemble.elsewhere_crack if ensemble else ""
    if ensemble is not None:
        verdict = ensemble.verdict
        why = f"{ensemble.overturning_members} of {ensemble.members} members overturn"
    elif worst.answer_outcome is Outcome.OVERTURNS:
        verdict = Verdict.OVERTURNS
    elif fallen:
        verdict = Verdict.UNDECIDED
        elsewhere_crack = fallen[0].crack
        why = f"one run as recorded stands, and with the {elsewhere_crack} it overturns"
    over_all = ensemble is not None and ensemble.component == BOTH_COMPONENTS
    if failures and verdict is not Verdict.OVERTURNS and not over_all:
        verdict = Verdict.UNKNOWN
        missing = ", ".join(failure.component or "not named" for failure in failures)
        why = f"the component {missing} gave no result"
    single = math.nan if verdict is Verdict.UNKNOWN else float(verdict is Verdict.OVERTURNS)
    return Fate.of(
        worst,
        ensemble,
        {"overturning_members": 0, "members": 0, "overturning_share": single},
        component=(ensemble or worst).component,
        verdict=verdict,
        elsewhere_crack=elsewhere_crack,
        rotation_ratio=worst.integrated_rotation_ratio,
        direction=(ensemble and ensemble.worst_direction) or (worst.component if len(cases) > 1 else ""),
        polarity=ensemble and ensemble.worst_polarity,
        why=why,
    )


def _weight(each: EnsembleRow) -> tuple[float, ...]:
    share = each.overturning_share, each.rotation_ratio_high
    return (each.component == BOTH_COMPONENTS, *map(_or_least, share))


def _or_least(value: float) -> float:
    return -1.0 if math.isnan(value) else value


def _badness(case: ComparisonRow) -> tuple[bool, float]:
    return case.answer_outcome is Outcome.OVERTURNS, _or_least(case.integrated_rotation_ratio)


@dataclass(frozen=True)
class RecordTables:
    """Every row of one record, by table; each field is named as its file."""

    record: list[rows.RecordRow] = field(default_factory=list)
    pulses: list[rows.PulseRow] = field(default_factory=list)
    comparison: list[ComparisonRow] = field(default_factory=list)
    ensemble: list[EnsembleRow] = field(default_factory=list)
    variations: list[VariationRow] = field(default_factory=list)
    failures: list[FailureRow] = field(default_factory=list)
    timings: list[rows.TimingRow] = field(default_factory=list)

    @classmethod
    def read(cls, folder: Path) -> "RecordTables":
        """Return the rows of a record's folder. Raises RockingError for a table that cannot be read."""
        return cls(*(read_table(each, folder) for each in PER_RECORD))  # type: ignore[arg-type]

    def write(self, folder: Path) -> None:
        """Write every table into `folder`."""
        with written_together():
            write_tables({each: getattr(self, each.table.name) for each in PER_RECORD}, folder)

    @property
    def verdicts(self) -> list[Fate]:
        """What became of each structure, all components considered."""
        return fates(self.comparison, self.ensemble, self.failures, self.variations)

    def add(
        self,
        identity: rows.ComponentRow,
        assessment: "Assessment",
        settings: AssessmentSettings,
        licence: str,
        vertical: Accelerogram | None,
        motion: rows.HorizontalMotion,
    ) -> None:
        """Append what one assessment gives. motion: of the pair of components, or of one alone."""
        dominant = assessment.analysis.dominant if assessment.analysis else None
        self.record.append(
            rows.record_row(identity, assessment.accelerogram, licence, vertical, motion, dominant)
        )
        self.pulses.extend(rows.pulse_rows(identity, assessment.analysis, assessment.candidates))
        for case in assessment.cases:
            self.comparison.append(rows.comparison_row(identity, case, settings.friction_coefficient))
            if case.ensemble is not None:
                self.ensemble.append(rows.ensemble_row(identity, case.structure, case.ensemble))
        for failure in assessment.failures:
            self.fail(identity.record, assessment.accelerogram.component, failure)

    def fail(self, record: str, component: str, failure: "Failure") -> None:
        """Append a row of the failures."""
        self.failures.append(FailureRow.of(failure, record=record, component=component))


PER_RECORD: tuple[type[Row], ...] = tuple(get_args(each)[0] for each in get_type_hints(RecordTables).values())
"""The rows of every table of one record."""
