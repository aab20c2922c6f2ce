"""Does the share of very many members lie in the class of the word that a study says?

The rule of the words was chosen on the stations of FEMA P-695, so that those of the other catalogues take part alone.
Each station is tried as a pair, as one component, on a support and with a vertical motion. Few records of the suites
have their vertical component, so the other horizontal one at VERTICAL stands in for it.

That more members follow up to 1024 was decided on those stations. The run of 27 November 2026 therefore took others,
by a rule written down before any word was looked at: every file of real records in the mirror that no catalogue here
names (its folders `formats_*`), as the package reads it; a station counts if it has two horizontal components with a
peak of 0.01 g or more each, and is no site of the catalogues. These are Aydin 0921 in the earthquake of Kos (2017),
Pazarcik 4624 (2023), 23837 in California (2018), Willow Creek 89146 (2012), Lyttelton LPCC (aftershock of
Canterbury), Uki 9CF in Kumamoto (2016), China Lake CLC and T001230 in Ridgecrest (2019), Alto Hospicio (Iquique 2009)
and Acapulco ACAC (Puebla 2017), with three structures of each kind. LPCC and T001230 are in g, which their files do
not say.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, groupby

import numpy as np
import pandas as pd

from docs.research import scores, sites
from docs.research.report import Tables, Target
from docs.research.sites import Records
from rocking.assessment.assessor import Assessor
from rocking.assessment.case import PeriodResult
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack, cracks, slides_first
from rocking.assessment.decide import Verdict, decide
from rocking.assessment.ensemble import drawn, lattice
from rocking.assessment.motions import GroundMotions, Motion, ground_motions
from rocking.assessment.scene import Scene
from rocking.assessment.settings import AssessmentSettings
from rocking.floors.place import GROUND, place_from_config
from rocking.records import Accelerogram
from rocking.signal import aligned
from rocking.structures import Facade, LoadedWall, Spire, Structure
from rocking.tables import column, row

MEMBERS = 4096
"""Members of each crack whose share is taken as true."""
VERTICAL = 2 / 3
"""Of the other horizontal component, in place of the vertical one."""
ROOF = {"name": "roof", "period_s": 0.3, "damping_ratio": 0.05, "participation": 1.3}
KINDS = ("pair", "component", "on a support", "with vertical motion")
STRUCTURES_PER_KIND = 6
SEVERAL_CRACKS: Mapping[str, Structure] = {
    "open spire": Spire(width=3.0, height=15.0, wall_thickness=0.25),
    "loaded wall": LoadedWall.of_size(6.4, 0.4, 19e3, top_load=1e4, one_sided=True, restitution=0.7),
    "two storeys": Facade(
        (3.2, 3.2), (0.6, 0.6), 19e3, floor_loads=(1e4, 1e4), behind="cross_walls", restitution=0.7
    ),
}
"""Beside the structures of the list, of which few may crack in several places."""
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
    verdict: Verdict = column("Its word in a study")
    of_members: Verdict = column(
        "Word of the members of the study alone, which contact dynamics and doubts may limit"
    )
    true_verdict: Verdict | None = column(
        "Word of 4096 members of every crack that counts; empty where a study cannot tell"
    )
    members: int = column("Members of all cracks that were followed in the study")
    share: float = column("Share that overturns with the crack that governs, in the study")
    true_share: float = column("The same of 4096 members")

    @property
    def classes_off(self) -> float:
        """By how many classes the members' word says more than is true: above 0 on the safe side, below on the unsafe.

        nan where a study says no share, or where too many of very many members cannot be followed.
        """
        if self.verdict is Verdict.CANNOT_OVERTURN:
            return -math.inf if self.true_share else 0.0
        if self.verdict is Verdict.CANNOT_BE_TOLD or self.true_verdict not in CLASSES:
            return math.nan
        return float(CLASSES.index(self.of_members) - CLASSES.index(self.true_verdict))


def stability(target: Target) -> None:
    """Hold words against many members, on every site with two components that FEMA P-695 does not hold."""
    trials: list[StabilityTrial] = []
    left_out = left_out_of(*target.catalogues)
    for (site, earthquake), several in groupby(
        left_out, lambda component: (component.site, component.earthquake)
    ):
        records = [component.accelerogram for component in several]
        if len(records) == sites.MOST_COMPONENTS:
            structures = {**target.structures, **SEVERAL_CRACKS}
            trials += stability_trials(site, earthquake, records, structures)
            target.tell(site)
    tables: Tables = {StabilityTrial: trials, scores.Score: list(stability_scores(trials))}
    target.publish("How stable the words are", f"{len(trials)} cases beside {MEMBERS} members.", tables)


def left_out_of(chosen_on: Records, *others: Records) -> Iterator[sites.SiteRecord]:
    """Yield the components that count of sites that the first catalogue does not hold, under whatever name."""
    first = list(chosen_on)
    identifiers = {identifier for identifier, _ in first}
    samples = {accelerogram.sha256 for _, accelerogram in first}
    for component in sites.independent(chain(first, *others)):
        if component.identifier not in identifiers and component.accelerogram.sha256 not in samples:
            yield component


def stability_trials(
    site: str, earthquake: str, records: Sequence[Accelerogram], structures: Mapping[str, Structure]
) -> Iterator[StabilityTrial]:
    """Yield trials of every kind with some of the structures, drawn by the name of the site."""
    draw = sites.draw_of(site)
    first, second = records
    for kind in KINDS:
        number = min(STRUCTURES_PER_KIND, len(structures))
        for name in draw.choice(list(structures), number, replace=False).tolist():
            structure = structures[name]
            multiplier = cracks(structure).counting[0].mechanism.uplift_multiplier
            factor = sites.lifting_factor(first, multiplier, sites.UPLIFTS, draw)
            one, other = first.scaled(factor), second.scaled(factor)
            vertical = aligned(other.scaled(VERTICAL), one) if kind == "with vertical motion" else None
            components = (one, other) if kind == "pair" else (one,)
            place = place_from_config(ROOF) if kind == "on a support" else GROUND
            told = in_study(Scene(name, structure, place), components, vertical)
            true_verdict = None
            true_share = math.nan
            if told.verdict is not Verdict.CANNOT_BE_TOLD:
                motions = ground_motions(Motion(components, vertical, told.support), processing=True)
                true = very_many(structure, motions)
                true_verdict = decide(true.facts).verdict
                true_share = true.governing.ensemble.overturning_share
            followed = told.ensembles.followed if told.ensembles else ()
            yield StabilityTrial(
                record=first.source.path or site,
                site=site,
                earthquake=earthquake,
                structure=name,
                scale_factor=factor,
                kind=kind,
                verdict=told.verdict,
                of_members=decide(told.ensembles.facts).verdict if told.ensembles else told.verdict,
                true_verdict=true_verdict,
                members=sum(crack.ensemble.members for crack in followed),
                share=told.decision.share,
                true_share=true_share,
            )


def in_study(scene: Scene, components: Sequence[Accelerogram], vertical: Accelerogram | None) -> PeriodResult:
    """Return what a study says of a scene, with all that it doubts; the reserve is not sought."""
    settings = AssessmentSettings()
    settings = replace(settings, ensemble=replace(settings.ensemble, reserve=0.0))
    result = Assessor(settings).assess("", components, {scene.name: scene}, vertical)
    return result.scenes[scene.name].worst


def very_many(structure: Structure, motions: GroundMotions) -> CrackEnsembles:
    """Return the ensembles of MEMBERS members of every crack that counts."""
    settings = AssessmentSettings()
    counting = cracks(structure).counting
    lifting = tuple(candidate for candidate in counting if not slides_first(candidate, motions)) or counting
    followed = (
        FollowedCrack(
            candidate.description,
            candidate.position,
            drawn(candidate.mechanism, motions, lattice(MEMBERS), settings.ensemble),
            bulges=candidate.bulges,
            part=candidate.part,
        )
        for candidate in lifting
    )
    return CrackEnsembles(tuple(followed))


def stability_scores(trials: Sequence[StabilityTrial]) -> Iterator[scores.Score]:
    """Yield how many words are right and how far the others are off, of each kind and of all, by earthquake.

    Cases without a class are counted by themselves and enter no other share.
    """
    every = pd.DataFrame(trials)
    every["off"] = [trial.classes_off for trial in trials]
    disagree = every.true_share.gt(0) & every.true_share.lt(1)
    for part, own in [("all", every), *every.groupby("kind", sort=False)]:
        off = own.off.to_numpy()
        told = ~np.isnan(off)
        measures: dict[str, scores.Measured] = {
            "share that cannot be told": ~told,
            "share in the class of its word (0.95 is asked)": np.where(told, off == 0, np.nan),
            "the same where members disagree": np.where(told & disagree[own.index], off == 0, np.nan),
            "one class off on the unsafe side": np.where(told, off == -1, np.nan),
            "two classes off on the unsafe side or more (0 is asked)": np.where(told, off < -1, np.nan),
            "off on the safe side": np.where(told, off > 0, np.nan),
            "members of all cracks": own.members.to_numpy(dtype=float),
        }
        yield from scores.scored("words", str(part), measures, sites.sample_of(own.site, own.earthquake))
