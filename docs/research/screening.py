"""Does the verdict over all cracks that may form miss one? Beside the ensemble of every crack, and fresh draws."""

import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from docs.research import scores
from docs.research.report import publish
from docs.research.scores import Score
from docs.research.sites import independent, lifting_factor, one_of_each
from rocking.assessment.ensemble import CAUSES, Ensemble, GroundMotions, drawn, ensemble
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.variations import cracks, ensemble_over_cracks
from rocking.assessment.verdict import Verdict
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.tables import Row, column, row

UPLIFTS = (1.3, 8.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
SCALES = 3
"""Trials of each structure under each record."""
WORST, DRAWS = 2, 512
"""Mechanisms of a case that stands that are followed again, and the random members of each."""


@row("screening", "One row per record and structure: the verdict over all cracks beside the ensembles of all")
class ScreeningTrial(Row):
    """One case."""

    record: str = column("Identifier of the record in the catalogue")
    site: str = column("Event and station")
    structure: str = column("Name of the structure")
    scale_factor: float = column("What the record was multiplied by")
    verdict: Verdict = column("Verdict over all cracks that may form, followed as they are in a study")
    exhaustive: Verdict = column("Verdict of the full ensembles of all of them")
    largest_share: float = column("Largest share that overturns in one of these")
    fresh_share: float = column("Largest share of random draws, of the worst that stand; else empty")


def write_screening(
    records: Iterable[tuple[str, Accelerogram]],
    structures: Mapping[str, Structure],
    folder: Path,
    tell: Callable[[str], None],
) -> None:
    """Write the trials, their scores and their report into `folder`; tell: is given a line for each record."""
    trials: list[ScreeningTrial] = []
    for name, site, record in one_of_each(independent(records)):
        trials += screening_trials(name, site, record, structures)
        tell(name)
    tables = {ScreeningTrial: trials, Score: list(screening_scores(trials))}
    publish(folder, "What the verdict over all cracks misses", f"{len(trials)} cases.", tables)


def screening_trials(
    name: str, site: str, record: Accelerogram, structures: Mapping[str, Structure]
) -> Iterator[ScreeningTrial]:
    """Yield SCALES trials of each structure that may crack elsewhere."""
    draw = np.random.default_rng(zlib.crc32(name.encode()))
    for structure_name, structure in SCALES * list(structures.items()):
        mechanisms = [mechanism for _, mechanism in cracks(structure)]
        if len(mechanisms) == 1:
            continue
        factor = lifting_factor(record, mechanisms[0].uplift_multiplier, UPLIFTS, draw)
        motions = GroundMotions.of(record.scaled(factor))
        found = [ensemble(mechanism, motions) for mechanism in mechanisms]
        exhaustive, fresh = verdict_of_all(found), np.nan
        if exhaustive is Verdict.STANDS:
            again = [mechanisms[k] for k in _worst(found)]
            points = draw.random((DRAWS, len(CAUSES)))
            fresh = max(drawn(each, motions, points, EnsembleSettings()).overturning_share for each in again)
        yield ScreeningTrial(
            record=name,
            site=site,
            structure=structure_name,
            scale_factor=factor,
            verdict=ensemble_over_cracks(structure, motions, AssessmentSettings()).verdict,
            exhaustive=exhaustive,
            largest_share=max(each.overturning_share for each in found),
            fresh_share=fresh,
        )


def verdict_of_all(found: Sequence[Ensemble]) -> Verdict:
    """Return what the ensembles of all mechanisms say, that of statics first."""
    if all(each.verdict is Verdict.STANDS for each in found):
        return Verdict.STANDS
    return Verdict.OVERTURNS if found[0].verdict is Verdict.OVERTURNS else Verdict.UNDECIDED


def _worst(found: Sequence[Ensemble]) -> list[int]:
    order = sorted(
        range(len(found)), key=lambda k: (found[k].overturning_share, found[k].rotation_ratio_high)
    )
    return order[-WORST:]


def screening_scores(trials: Sequence[ScreeningTrial]) -> Iterator[Score]:
    """Yield misses and verdicts against fresh draws, by structure and of all, with intervals by site."""
    risk = EnsembleSettings().risk
    for part in ("all", *dict.fromkeys(each.structure for each in trials)):
        own = [each for each in trials if part in ("all", each.structure)]
        stands = [each.verdict is Verdict.STANDS for each in own]
        missed = [each.exhaustive is not Verdict.STANDS for each in own]
        fresh = [each.fresh_share > risk if each.fresh_share >= 0 else np.nan for each in own]
        measures = {
            'share of "stands"': scores.mean(stands),
            'cracks missed among "stands"': scores.mean(np.where(stands, missed, np.nan)),
            '"stands" whose worst crack overturns in more than its risk': scores.mean(fresh),
            "other verdict than that of all cracks": scores.mean(
                [e.verdict is not e.exhaustive for e in own]
            ),
        }
        yield from scores.scored("verdict over all cracks", part, measures, [each.site for each in own])
