"""Is what an ensemble says right? Its few members held against thousands of random draws of the same causes.

This measures the design, not the causes: whether the motion and the restitution are known as well as the ranges say
is for measured tests to tell. The design is a published one. The allowance of the verdicts was chosen on half of the
near-fault sites, named "chosen" here; the other half and all further sites are left out of every choice.

And does the verdict over all cracks that may form miss one, and does the share of what governs? Both are held against
the full ensembles of every crack.
"""

import zlib
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

import numpy as np
import pandas as pd

from docs.research import scores, sites
from docs.research.report import Tables, Target
from rocking.assessment.cracks import (
    CrackEnsembles,
    FollowedCrack,
    cracks,
    ensemble_over_cracks,
    slides_first,
)
from rocking.assessment.decide import Verdict, decide
from rocking.assessment.ensemble import CAUSES, drawn, ensemble, lattice
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.records import Accelerogram
from rocking.signal.rotation import rotate
from rocking.structures import Structure
from rocking.structures.crackable import Crackable
from rocking.tables import column, row

DRAWS = 4000
STRUCTURES_PER_RECORD = 3
OPEN = (0.02, 0.98)
"""Shares between which an error of the design matters."""
ALLOWED = {64: 0.07, 256: 0.035}
"""Error asked of a share, by members."""
BEYOND = 0.03
"""By how much the share of the opposite may exceed the risk of a verdict."""
CHOSEN, LEFT_OUT, PAIRS = "chosen", "left out", "pairs, all directions"
ALL_DIRECTIONS = 24
"""Between which the draws of a pair choose."""
SCALES = 3
"""Trials of the cracks of each structure under each record."""
HALF = 0.5
"""Share of a crack beside which no other one may stand for the structure with 0."""
WORST, CRACK_DRAWS = 2, 512
"""Cracks of a case that stands that are followed again, and the random members of each."""


@row("ensemble_trials", "One row per record and structure: the ensemble beside random draws of its causes")
class EnsembleTrial(sites.Trial):
    """One case."""

    half: str = column("chosen: a site on which the allowance was chosen; left out: another; or a pair")
    verdict: Verdict = column("Verdict of the ensemble")
    members: int = column("Members it took")
    share: float = column("Share of them that overturn")
    share_64: float = column("Share of 64 members that overturn")
    share_256: float = column("Share of 256 members that overturn")
    share_drawn: float = column("Share of the random draws that overturn")
    draws: int = column("Random draws")
    inside_band: float = column("Share of the draws in its 5-95 % band; empty: it rests or may overturn")


@row("screening", "One row per record and structure: the verdict over all cracks beside the ensembles of all")
class ScreeningTrial(sites.Trial):
    """One case."""

    verdict: Verdict = column("Verdict over all cracks that may form, followed as they are in a study")
    exhaustive: Verdict = column("Verdict of the full ensembles of all of them")
    share: float = column("Share that overturns with the crack which governs in a study")
    largest_share: float = column("Largest share that overturns in one of the full ensembles")
    fresh_share: float = column("Largest share of random draws, of the worst that stand; else empty")


def calibrate_ensemble(target: Target) -> None:
    """Hold ensembles under near-fault and other records against random draws."""
    near_fault, others = target.catalogues
    trials = list(try_ensembles(near_fault, others, target.structures))
    subtitle = f"Shares of few members beside {DRAWS} random draws of the same causes."
    tables: Tables = {EnsembleTrial: trials, scores.Score: list(ensemble_scores(trials))}
    target.publish("How right the share of an ensemble is", subtitle, tables)


def try_ensembles(
    near_fault: sites.Records, others: sites.Records, structures: Mapping[str, Structure]
) -> Iterator[EnsembleTrial]:
    """Yield trials of the components that count, and of the pairs, at scales that spread from uplift to overturning.

    others: records that took no part in any choice. Each component and each pair is tried with some of `structures`.
    """
    first = list(near_fault)
    names = list(structures)
    near = {sites.site_of(record) for _, record in first}
    alone: list[tuple[dict[str, str], list[Accelerogram]]] = []
    pairs: dict[str, tuple[dict[str, str], list[Accelerogram]]] = {}
    for component in sites.independent(chain(first, others)):
        record = component.accelerogram
        site = component.site
        odd = zlib.crc32(f"{record.event}; {record.station}".encode()) % 2  # how the halves were once drawn
        about = {
            "record": component.identifier,
            "site": site,
            "earthquake": component.earthquake,
            "half": CHOSEN if odd and site in near else LEFT_OUT,
        }
        alone.append((about, [record]))
        pairs.setdefault(site, (about | {"half": PAIRS}, []))[1].append(record)
    for group in (alone, [pair for pair in pairs.values() if len(pair[1]) > 1]):
        for place, (about, components) in enumerate(group):
            draw = sites.draw_of(about["record"])
            for k in range(STRUCTURES_PER_RECORD):
                structure = names[(place * STRUCTURES_PER_RECORD + k) % len(names)]
                yield _trial(about | {"structure": structure}, structures[structure], components, draw)


def _trial(
    about: dict[str, str], structure: Structure, components: Sequence[Accelerogram], draw: np.random.Generator
) -> EnsembleTrial:
    """Return the trial of a structure under one component, or two. about: what names it."""
    mechanism, settings = structure.mechanism(), EnsembleSettings()
    factor = sites.lifting_factor(components[0], mechanism.uplift_multiplier, sites.UPLIFTS, draw)
    scaled = [component.scaled(factor) for component in components]
    motions = everywhere = GroundMotions.of(scaled[0])
    if len(scaled) > 1:
        first, second = scaled
        motions = GroundMotions.of(first, second)
        angles = (np.pi * np.arange(ALL_DIRECTIONS) / ALL_DIRECTIONS).tolist()
        everywhere = GroundMotions({(str(angle), ""): rotate(first, second, angle) for angle in angles})
    many = drawn(mechanism, everywhere, draw.random((DRAWS, len(CAUSES))), settings)
    whole, ratios = ensemble(mechanism, motions, settings), many.rotation_ratios
    inside = (ratios >= whole.rotation_ratio_low) & (ratios <= whole.rotation_ratio_high)
    # Where some overturn the band is open above and holds more than its share, so it says nothing of the design.
    is_closed = whole.rotation_ratio_median > NEGLIGIBLE and not np.isinf(ratios).any()
    shares = {size: drawn(mechanism, motions, lattice(size), settings).overturning_share for size in ALLOWED}
    return EnsembleTrial(
        **about,
        verdict=whole.facts().step(settings.risk),
        members=whole.members,
        scale_factor=factor,
        share=whole.overturning_share,
        share_drawn=many.overturning_share,
        draws=many.members,
        inside_band=float(inside.mean()) if is_closed else np.nan,
        share_64=shares[64],
        share_256=shares[256],
    )


def ensemble_scores(trials: Sequence[EnsembleTrial]) -> Iterator[scores.Score]:
    """Yield every measure on each half of the sites, with intervals."""
    risk = EnsembleSettings().risk
    for half, own in pd.DataFrame(trials).groupby("half"):
        truth = own.share_drawn
        is_open = truth.between(*OPEN, inclusive="neither")
        decided = own.verdict.map(lambda word: word.is_sure)
        opposite = truth.where(own.verdict == Verdict.STANDS, 1 - truth).where(decided)
        measures: dict[str, scores.Measured] = {}
        for size, allowed in ALLOWED.items():
            within = (own[f"share_{size}"] - truth).abs() <= allowed
            measures[f"share within {allowed} with {size} members (0.95 is asked)"] = within.where(is_open)
        for more, limit in ((BEYOND, f" by more than {BEYOND} (0 is asked)"), (0.0, "")):
            measures[f"share of verdicts beyond their risk{limit}"] = (opposite > risk + more).where(decided)
        measures["share of draws inside the 5-95 % band (0.87 to 0.93 is asked)"] = own.inside_band
        measures["verdicts"] = number_of(decided.to_numpy())
        yield from scores.scored("ensemble", str(half), measures, sites.sample_of(own.site, own.earthquake))


def number_of(which: np.ndarray) -> scores.Measure:
    """Return the number of cases of which `which` (n,) is true, as a measure."""
    return lambda rows: float(which[rows].sum())


def screen(target: Target) -> None:
    """Hold the verdict over all cracks against the ensembles of all, on the first component of each site."""
    trials: list[ScreeningTrial] = []
    for component in sites.one_of_each(sites.independent(target.records)):
        trials += screening_trials(component, target.structures)
        target.tell(component.identifier)
    tables: Tables = {ScreeningTrial: trials, scores.Score: list(screening_scores(trials))}
    target.publish("What the verdict over all cracks misses", f"{len(trials)} cases.", tables)


def screening_trials(
    component: sites.SiteRecord, structures: Mapping[str, Structure]
) -> Iterator[ScreeningTrial]:
    """Yield SCALES trials of each structure that may crack elsewhere and does not say where."""
    record = component.accelerogram
    draw = sites.draw_of(component.identifier)
    for structure_name, structure in SCALES * list(structures.items()):
        every = cracks(structure)
        if len(every) == 1 or not isinstance(structure, Crackable) or structure.crack_is_known:
            continue
        factor = sites.lifting_factor(record, every[0].mechanism.uplift_multiplier, sites.UPLIFTS, draw)
        motions = GroundMotions.of(record.scaled(factor))
        settings = AssessmentSettings()
        in_study = ensemble_over_cracks(structure, motions, settings)
        # What slides before it lifts is left out where another crack is left.
        forms = tuple(candidate for candidate in every if not slides_first(candidate, motions)) or every
        in_full = CrackEnsembles(
            tuple(
                FollowedCrack(form.description, form.position, ensemble(form.mechanism, motions))
                for form in forms
            )
        )
        fresh = np.nan
        exhaustive = decide(in_full.facts).verdict
        if exhaustive is Verdict.STANDS:
            severities = [crack.facts.severity(EnsembleSettings().risk) for crack in in_full.followed]
            worst = sorted(range(len(forms)), key=severities.__getitem__)[-WORST:]
            points = draw.random((CRACK_DRAWS, len(CAUSES)))
            again = [drawn(forms[k].mechanism, motions, points, EnsembleSettings()) for k in worst]
            fresh = max(decision.overturning_share for decision in again)
        yield ScreeningTrial(
            **component.named,
            structure=structure_name,
            scale_factor=factor,
            verdict=decide(in_study.facts).verdict,
            exhaustive=exhaustive,
            share=in_study.governing.ensemble.overturning_share,
            largest_share=in_full.governing.ensemble.overturning_share,
            fresh_share=fresh,
        )


def screening_scores(trials: Sequence[ScreeningTrial]) -> Iterator[scores.Score]:
    """Yield misses and verdicts against fresh draws, by structure and of all, with intervals by earthquake."""
    every = pd.DataFrame(trials)
    for part, own in [("all", every), *every.groupby("structure", sort=False)]:
        stands, fresh = own.verdict == Verdict.STANDS, own.fresh_share
        # Where statics' crack overturns, it says all, and no other one is followed.
        open_ = own.verdict != Verdict.OVERTURNS
        measures = {
            'share of "stands"': stands,
            'cracks missed among "stands"': (own.exhaustive != Verdict.STANDS).where(stands),
            '"stands" whose worst crack overturns in more than its risk': (
                fresh > EnsembleSettings().risk
            ).where(fresh.notna()),
            "other verdict than that of all cracks": own.verdict != own.exhaustive,
            f"share more than {ALLOWED[64]} below that of the worst crack": (
                own.largest_share - own.share > ALLOWED[64]
            ).where(open_),
            "0 beside a crack that overturns in half": (own.largest_share >= HALF).where(
                open_ & (own.share == 0)
            ),
        }
        yield from scores.scored(
            "verdict over all cracks", part, measures, sites.sample_of(own.site, own.earthquake)
        )
