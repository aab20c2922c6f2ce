"""Does the share of very many members lie in the class of the word that few gave?

Every site takes part, as nothing was chosen on any for this; each is tried as a pair, as one component, on a support
and with a vertical motion. No record of the suites has its vertical component, so the other horizontal one at VERTICAL
stands in for it.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

import numpy as np
import pandas as pd

from docs.research import scores, sites
from docs.research.report import Tables, Target
from rocking.assessment.causes import lattice
from rocking.assessment.cracks import (
    CrackEnsembles,
    FollowedCrack,
    counting_cracks,
    ensemble_over_cracks,
    slides_first,
)
from rocking.assessment.decide import Verdict, decide
from rocking.assessment.ensemble import drawn
from rocking.assessment.ground_motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.floors.place import place_from_config
from rocking.records import Accelerogram, aligned
from rocking.structures import Structure
from rocking.tables import column, row

MEMBERS = 4096
"""Members of each crack whose share is taken as true."""
VERTICAL = 2 / 3
"""Of the other horizontal component, in place of the vertical one."""
ROOF = {"name": "roof", "period_s": 0.3, "damping_ratio": 0.05, "participation": 1.3}
KINDS = ("pair", "component", "on a support", "with vertical motion")
STRUCTURES_PER_KIND = 2
CLASSES = (
    Verdict.STANDS,
    Verdict.PROBABLY_STANDS,
    Verdict.UNCERTAIN,
    Verdict.PROBABLY_OVERTURNS,
    Verdict.OVERTURNS,
)


@row(
    "stability", "One row per structure and motion: its word beside that of very many members of every crack"
)
class StabilityTrial(sites.Trial):
    """One case."""

    kind: str = column("How the record acts: pair, component, on a support, with vertical motion")
    verdict: Verdict = column("Word of its mechanisms as in a study")
    true_verdict: Verdict = column("Word of 4096 members of every crack that counts")
    members: int = column("Members of all cracks that were followed in the study")
    share: float = column("Share that overturns with the crack that governs, in the study")
    true_share: float = column("The same of 4096 members")

    @property
    def classes_off(self) -> int:
        """By how many classes the word says more than is true: above 0 on the safe side, below on the unsafe one."""
        return CLASSES.index(self.verdict) - CLASSES.index(self.true_verdict)


def stability(target: Target) -> None:
    """Hold words against many members, on every site with two components."""
    trials: list[StabilityTrial] = []
    components = sites.independent(target.records)
    for site, several in groupby(components, lambda component: component.site):
        records = [component.accelerogram for component in several]
        if len(records) == 2:
            trials += stability_trials(site, records, target.structures)
            target.tell(site)
    tables: Tables = {StabilityTrial: trials, scores.Score: list(stability_scores(trials))}
    target.publish("How stable the words are", f"{len(trials)} cases beside {MEMBERS} members.", tables)


def stability_trials(
    site: str, records: Sequence[Accelerogram], structures: Mapping[str, Structure]
) -> Iterator[StabilityTrial]:
    """Yield trials of every kind with some of the structures, drawn by the name of the site."""
    draw = sites.draw_of(site)
    (roof,) = place_from_config(ROOF).supports
    first, second = records
    for kind in KINDS:
        for name in draw.choice(list(structures), STRUCTURES_PER_KIND, replace=False).tolist():
            structure = structures[name]
            multiplier = counting_cracks(structure)[0].mechanism.uplift_multiplier
            factor = sites.lifting_factor(first, multiplier, sites.UPLIFTS, draw)
            one, other = first.scaled(factor), second.scaled(factor)
            vertical = aligned(other.scaled(VERTICAL), one) if kind == "with vertical motion" else None
            motions = GroundMotions.of(one, *([other] if kind == "pair" else []), vertical=vertical)
            motions = motions.on(roof if kind == "on a support" else None)
            in_study, true = words(structure, motions)
            yield StabilityTrial(
                record=first.source.path or site,
                site=site,
                structure=name,
                scale_factor=factor,
                kind=kind,
                verdict=decide(in_study.facts).word,
                true_verdict=decide(true.facts).word,
                members=sum(each.ensemble.members for each in in_study.followed),
                share=in_study.governing.ensemble.overturning_share,
                true_share=true.governing.ensemble.overturning_share,
            )


def words(structure: Structure, motions: GroundMotions) -> tuple[CrackEnsembles, CrackEnsembles]:
    """Return the ensembles of a structure as in a study, and of MEMBERS members of every crack that counts."""
    settings = AssessmentSettings()
    in_study = ensemble_over_cracks(structure, motions, settings)
    several = counting_cracks(structure)
    several = tuple(each for each in several if not slides_first(each, motions, settings)) or several
    followed = (
        FollowedCrack(
            each.description,
            each.position,
            drawn(each.mechanism, motions, lattice(MEMBERS), settings.ensemble),
        )
        for each in several
    )
    return in_study, CrackEnsembles(tuple(followed))


def stability_scores(trials: Sequence[StabilityTrial]) -> Iterator[scores.Score]:
    """Yield how many words are right and how far the others are off, of each kind and of all, by site."""
    every = pd.DataFrame(trials)
    every["off"] = [each.classes_off for each in trials]
    moves = every.true_share.gt(0) & every.true_share.lt(1)
    for part, own in [("all", every), *every.groupby("kind", sort=False)]:
        off = own.off.to_numpy()
        measures: dict[str, scores.Measured] = {
            "share in the class of its word (0.95 is asked)": off == 0,
            "the same where members disagree": np.where(moves[own.index], off == 0, np.nan),
            "one class off on the unsafe side": off == -1,
            "two classes off on the unsafe side or more (0 is asked)": off < -1,
            "off on the safe side": off > 0,
            "members of all cracks": own.members.to_numpy(dtype=float),
        }
        yield from scores.scored("words", str(part), measures, own.site.tolist())
