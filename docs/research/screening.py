"""Does the verdict over all cracks that may form miss one? Beside the ensemble of every crack, and fresh draws."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from docs.research import scores, sites
from docs.research.report import publish
from docs.research.scores import Score
from rocking.assessment.ensemble import CAUSES, Ensemble, GroundMotions, drawn, ensemble
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.variations import cracks, ensemble_over_cracks
from rocking.assessment.verdict import Verdict
from rocking.records import Accelerogram
from rocking.tables import column, row

SCALES = 3
"""Trials of each structure under each record."""
WORST, DRAWS = 2, 512
"""Mechanisms of a case that stands that are followed again, and the random members of each."""


@row("screening", "One row per record and structure: the verdict over all cracks beside the ensembles of all")
class ScreeningTrial(sites.Trial):
    """One case."""

    verdict: Verdict = column("Verdict over all cracks that may form, followed as they are in a study")
    exhaustive: Verdict = column("Verdict of the full ensembles of all of them")
    largest_share: float = column("Largest share that overturns in one of these")
    fresh_share: float = column("Largest share of random draws, of the worst that stand; else empty")


def write_screening(
    records: sites.Records, structures: sites.Structures, folder: Path, tell: sites.Tell
) -> None:
    """Write the trials, their scores and their report into `folder`."""
    trials: list[ScreeningTrial] = []
    for name, site, record in sites.one_of_each(sites.independent(records)):
        trials += screening_trials(name, site, record, structures)
        tell(name)
    tables = {ScreeningTrial: trials, Score: list(screening_scores(trials))}
    publish(folder, "What the verdict over all cracks misses", f"{len(trials)} cases.", tables)


def screening_trials(
    name: str, site: str, record: Accelerogram, structures: sites.Structures
) -> Iterator[ScreeningTrial]:
    """Yield SCALES trials of each structure that may crack elsewhere."""
    draw = sites.draw_of(name)
    for structure_name, structure in SCALES * list(structures.items()):
        mechanisms = [mechanism for _, mechanism in cracks(structure)]
        if len(mechanisms) == 1:
            continue
        factor = sites.lifting_factor(record, mechanisms[0].uplift_multiplier, sites.UPLIFTS, draw)
        motions = GroundMotions.of(record.scaled(factor))
        of_each = [ensemble(mechanism, motions) for mechanism in mechanisms]
        shares = [each.overturning_share for each in of_each]
        exhaustive, fresh = verdict_of_all(of_each), np.nan
        if exhaustive is Verdict.STANDS:
            high = [each.rotation_ratio_high for each in of_each]
            points = draw.random((DRAWS, len(CAUSES)))
            again = [
                drawn(mechanisms[k], motions, points, EnsembleSettings())
                for k in np.lexsort((high, shares))[-WORST:]
            ]
            fresh = max(each.overturning_share for each in again)
        yield ScreeningTrial(
            record=name,
            site=site,
            structure=structure_name,
            scale_factor=factor,
            verdict=ensemble_over_cracks(structure, motions, AssessmentSettings()).verdict,
            exhaustive=exhaustive,
            largest_share=max(shares),
            fresh_share=fresh,
        )


def verdict_of_all(of_each: Sequence[Ensemble]) -> Verdict:
    """Return what the ensembles of all mechanisms say, that of statics first."""
    if all(each.verdict is Verdict.STANDS for each in of_each):
        return Verdict.STANDS
    return Verdict.OVERTURNS if of_each[0].verdict is Verdict.OVERTURNS else Verdict.UNDECIDED


def screening_scores(trials: Sequence[ScreeningTrial]) -> Iterator[Score]:
    """Yield misses and verdicts against fresh draws, by structure and of all, with intervals by site."""
    every = pd.DataFrame(trials)
    for part, own in [("all", every), *every.groupby("structure", sort=False)]:
        stands = own.verdict == Verdict.STANDS
        measures = {
            'share of "stands"': stands,
            'cracks missed among "stands"': (own.exhaustive != Verdict.STANDS).where(stands),
            '"stands" whose worst crack overturns in more than its risk': (
                own.fresh_share > EnsembleSettings().risk
            ).where(own.fresh_share.notna()),
            "other verdict than that of all cracks": own.verdict != own.exhaustive,
        }
        yield from scores.scored("verdict over all cracks", part, measures, own.site.tolist())
