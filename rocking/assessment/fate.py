"""Fate: what became of one structure under one record, all components considered. The only place that decides it."""

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, final

from rocking.assessment.method import Method
from rocking.assessment.rows import meanings
from rocking.assessment.rows.shared import CaseRow
from rocking.assessment.verdict import Verdict
from rocking.structures import Outcome
from rocking.tables import column, row

if TYPE_CHECKING:
    from rocking.assessment.rows.of_case import CandidateRow, ComparisonRow, EnsembleRow, MaximumRow
    from rocking.assessment.rows.of_record import FailureRow

BOTH_COMPONENTS = "both"
"""In place of a component: all directions of a record."""
ORDER = (Verdict.OVERTURNS, Verdict.UNDECIDED, Verdict.UNKNOWN, Verdict.STANDS)
"""The worst verdict first; what could not be computed may overturn."""
_NONE = float("nan")


@row(
    "verdicts", "One row per record and structure: the verdict over all components, its count and its reason"
)
@final
class Fate(CaseRow):
    """What became of one structure under one record. The component is that of the governing case."""

    verdict: Verdict = column("stands, overturns, undecided, or unknown where a component gave no result")
    overturning_members: int = column("Members of the governing ensemble that overturn")
    members: int = column("Members that were followed; 0 without an ensemble")
    overturning_share: float = column("Share of the members that overturn; of a single run 0 or 1")
    crack: str = column(meanings.CRACK)
    elsewhere_crack: str = column(meanings.ELSEWHERE)
    elsewhere_overturning_members: int | None = column("Members that overturn where it cracks there")
    elsewhere_members: int | None = column("Members that were followed there; 0: of a single run")
    rotation_ratio: float = column(
        "Largest rotation over critical rotation of the run as recorded, worst component; INF if it overturns"
    )
    rotation_ratio_low: float = column("5 % quantile over the members; empty without an ensemble")
    rotation_ratio_median: float = column("Median over the members")
    rotation_ratio_high: float = column("95 % quantile over the members; INF if more than 5 % overturn")
    direction: str = column("Direction in which it rotates most; empty with one direction")
    polarity: str = column("Sign of the motion with which it rotates most: as recorded or reversed, or empty")
    peak_side: int | None = column(meanings.PEAK_SIDE)
    why: str = column("What the verdict rests on")

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
        told = f"leans to {leans_to}" + (f", overturns in {self.count}" if self.members else "")
        if not self.elsewhere_crack:
            return told
        there = f"with the {self.elsewhere_crack}"
        if not self.elsewhere_members:
            return f"{told}, overturns {there}"
        return f"{told}, {there} in {self.elsewhere_overturning_members} of {self.elsewhere_members}"


def fates(
    cases: Iterable["ComparisonRow"],
    ensembles: Iterable["EnsembleRow"] = (),
    failures: Iterable["FailureRow"] = (),
    maxima: Iterable["MaximumRow"] = (),
    candidates: Iterable["CandidateRow"] = (),
) -> list[Fate]:
    """Return what became of each structure under each record, in the order of `cases`.

    The ensemble over all directions decides, or where there is none the one that overturns, then rotates, most; without
    any ensemble the single run of the worst component. A component that gave no result makes the verdict unknown,
    unless another component overturns or an ensemble over all directions decides. maxima: tell the side. candidates:
    other cracks, of which without an ensemble one that overturns leaves undecided what stands as given.
    """
    by_pair: dict[tuple[str, str], list[ComparisonRow]] = {}
    for case in cases:
        by_pair.setdefault((case.record, case.structure), []).append(case)
    failed: dict[tuple[str, str], list[FailureRow]] = {}
    for failure in failures:
        if failure.stage == "responses" and failure.structure:
            failed.setdefault((failure.record, failure.structure), []).append(failure)
    governing = governing_ensembles(ensembles)
    sides = {
        (each.record, each.component, each.structure): each.peak_side
        for each in maxima
        if each.method is Method.MECHANISM_ON_RECORD and not each.processing
    }
    fallen: dict[tuple[str, str], CandidateRow] = {}
    for each in candidates:
        if math.isinf(each.integrated_rotation_ratio):
            fallen.setdefault((each.record, each.structure), each)
    return [
        _fate(of_pair, governing.get(pair), failed.get(pair, ()), sides, fallen.get(pair))
        for pair, of_pair in by_pair.items()
    ] + [_failed(found[0]) for pair, found in failed.items() if pair not in by_pair]


def governing_ensembles(rows: Iterable["EnsembleRow"]) -> dict[tuple[str, str], "EnsembleRow"]:
    """Return by record and structure the ensemble that speaks for all components."""
    governing: dict[tuple[str, str], EnsembleRow] = {}
    for each in rows:
        pair = each.record, each.structure
        governing[pair] = max(governing[pair], each, key=_weight) if pair in governing else each
    return governing


def _fate(
    cases: Sequence["ComparisonRow"],
    ensemble: "EnsembleRow | None",
    failures: Sequence["FailureRow"],
    sides: dict[tuple[str, str, str], int | None],
    fallen: "CandidateRow | None",
) -> Fate:
    worst = max(cases, key=_badness)
    verdict, why = _decided(worst, ensemble)
    missing = [case.component for case in cases if case.answer_outcome is Outcome.FAILED]
    missing += [failure.component for failure in failures]
    over_all = ensemble is not None and ensemble.component == BOTH_COMPONENTS
    if missing and verdict is not Verdict.OVERTURNS and not over_all:
        names = ", ".join(name or "not named" for name in missing)
        verdict, why = Verdict.UNKNOWN, f"the component {names} gave no result"
    elsewhere_crack, elsewhere = (ensemble.elsewhere_crack, ensemble) if ensemble else ("", None)
    if ensemble is None and fallen is not None and verdict is Verdict.STANDS:
        verdict, elsewhere_crack = Verdict.UNDECIDED, fallen.description
        why = f"one run as recorded stands, and with the {elsewhere_crack} it overturns"
    followed = ensemble if ensemble is not None and ensemble.members else None
    direction = worst.component if len(cases) > 1 else ""
    single = _NONE if verdict is Verdict.UNKNOWN else float(verdict is Verdict.OVERTURNS)
    return Fate(
        **{name: getattr(worst, name) for name in CaseRow.table.column_names}
        | {"component": ensemble.component if ensemble else worst.component},
        verdict=verdict,
        overturning_members=followed.overturning_members if followed else 0,
        members=followed.members if followed else 0,
        overturning_share=followed.overturning_share if followed else single,
        crack=ensemble.crack if ensemble else "",
        elsewhere_crack=elsewhere_crack,
        elsewhere_overturning_members=elsewhere.elsewhere_overturning_members if elsewhere else None,
        elsewhere_members=elsewhere.elsewhere_members if elsewhere else None,
        rotation_ratio=worst.integrated_rotation_ratio,
        rotation_ratio_low=followed.rotation_ratio_low if followed else _NONE,
        rotation_ratio_median=followed.rotation_ratio_median if followed else _NONE,
        rotation_ratio_high=followed.rotation_ratio_high if followed else _NONE,
        direction=(ensemble.worst_direction if ensemble else "") or direction,
        polarity=ensemble.worst_polarity if ensemble else "",
        peak_side=sides.get((worst.record, worst.component, worst.structure)),
        why=why,
    )


def _decided(worst: "ComparisonRow", ensemble: "EnsembleRow | None") -> tuple[Verdict, str]:
    """The verdict of the ensemble, or of the single run without one, and what it rests on."""
    if ensemble is not None:
        return ensemble.verdict, f"{ensemble.overturning_members} of {ensemble.members} members overturn"
    if worst.answer_outcome is Outcome.FAILED:
        return Verdict.UNKNOWN, "no component gave a result"
    verdict = Verdict.OVERTURNS if worst.answer_outcome is Outcome.OVERTURNS else Verdict.STANDS
    return verdict, worst.answer_reason or "one run as recorded, without an ensemble"


def _failed(failure: "FailureRow") -> Fate:
    """The fate of a structure that no component gave a result for."""
    return Fate(
        record=failure.record,
        component=failure.component,
        structure=failure.structure,
        scale_factor=_NONE,
        record_sha256="",
        settings_sha256="",
        verdict=Verdict.UNKNOWN,
        overturning_members=0,
        members=0,
        overturning_share=_NONE,
        crack="",
        elsewhere_crack="",
        elsewhere_overturning_members=None,
        elsewhere_members=None,
        rotation_ratio=_NONE,
        rotation_ratio_low=_NONE,
        rotation_ratio_median=_NONE,
        rotation_ratio_high=_NONE,
        direction="",
        polarity="",
        peak_side=None,
        why=failure.message,
    )


def _weight(each: "EnsembleRow") -> tuple[float, ...]:
    share = each.overturning_share, each.rotation_ratio_high
    return (each.component == BOTH_COMPONENTS, *map(_or_least, share))


def _or_least(value: float) -> float:
    return -1.0 if math.isnan(value) else value


def _badness(case: "ComparisonRow") -> tuple[int, float]:
    """What is not known may overturn, and so counts for more than any rocking, but less than overturning."""
    kinds = {Outcome.OVERTURNS: 2, Outcome.FAILED: 1}
    return kinds.get(case.answer_outcome, 0), _or_least(case.integrated_rotation_ratio)
