"""Is the share of an ensemble right? Its few members held against thousands of random draws of the same causes.

This measures the design, not the causes: whether the motion and the restitution are known as well as the ranges say
is for measured tests to tell. The design is a published one. The allowance of the verdicts was chosen on half of the
near-fault sites, named "chosen" here; the other half and all further sites are left out of every choice.
"""

import zlib
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path

import numpy as np
import pandas as pd

from docs.research import scores, sites
from docs.research.report import publish
from docs.research.scores import Score
from rocking.assessment.ensemble import CAUSES, Ensemble, GroundMotions, drawn, ensemble, lattice
from rocking.assessment.settings import EnsembleSettings
from rocking.assessment.verdict import NEGLIGIBLE, Verdict
from rocking.records import Accelerogram
from rocking.records.rotation import rotate
from rocking.structures import Structure
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


def write_ensemble_accuracy(
    near_fault: sites.Records, others: sites.Records, structures: sites.Structures, folder: Path
) -> None:
    """Write the trials, their scores and their report into `folder`."""
    trials = list(try_ensembles(near_fault, others, structures))
    subtitle = f"Shares of few members beside {DRAWS} random draws of the same causes."
    tables = {EnsembleTrial: trials, Score: list(ensemble_scores(trials))}
    publish(folder, "How right the share of an ensemble is", subtitle, tables)


def try_ensembles(
    near_fault: sites.Records, others: sites.Records, structures: sites.Structures, draws: int = DRAWS
) -> Iterator[EnsembleTrial]:
    """Yield trials of the components that count, and of the pairs, at scales that spread from uplift to overturning.

    others: records that took no part in any choice. Each component and each pair is tried with some of `structures`.
    """
    first = list(near_fault)
    names = list(structures)
    near = {sites.site_of(record) for _, record in first}
    alone: list[tuple[str, str, str, list[Accelerogram]]] = []
    pairs: dict[str, tuple[str, str, str, list[Accelerogram]]] = {}
    for name, site, record in sites.independent(chain(first, others)):
        odd = zlib.crc32(f"{record.event}; {record.station}".encode()) % 2  # how the halves were once drawn
        alone.append((name, site, CHOSEN if odd and site in near else LEFT_OUT, [record]))
        pairs.setdefault(site, (name, site, PAIRS, []))[-1].append(record)
    for group in (alone, [each for each in pairs.values() if len(each[-1]) > 1]):
        for place, (name, site, half, components) in enumerate(group):
            draw = sites.draw_of(name)
            for k in range(STRUCTURES_PER_RECORD):
                structure = names[(place * STRUCTURES_PER_RECORD + k) % len(names)]
                about = {"record": name, "site": site, "half": half, "structure": structure}
                yield _trial(about, structures[structure], components, draw, draws)


def _trial(
    about: Mapping[str, str],
    structure: Structure,
    components: Sequence[Accelerogram],
    draw: np.random.Generator,
    draws: int,
) -> EnsembleTrial:
    """Return the trial of a structure under one component, or two. about: what names it."""
    mechanism, settings = structure.mechanism(), EnsembleSettings()
    factor = sites.lifting_factor(components[0], mechanism.uplift_multiplier, sites.UPLIFTS, draw)
    scaled = [each.scaled(factor) for each in components]
    motions = everywhere = GroundMotions.of(scaled[0])
    if len(scaled) > 1:
        motions = GroundMotions.of(*scaled)
        angles = np.pi * np.arange(ALL_DIRECTIONS) / ALL_DIRECTIONS
        everywhere = GroundMotions({(str(each), ""): rotate(*scaled, angle=each) for each in angles.tolist()})
    few, more = (drawn(mechanism, motions, lattice(size), settings) for size in ALLOWED)
    many = drawn(mechanism, everywhere, draw.random((draws, len(CAUSES))), settings)
    whole = ensemble(mechanism, motions, settings)
    return EnsembleTrial.of(
        about,
        whole,
        scale_factor=factor,
        share=whole.overturning_share,
        share_64=few.overturning_share,
        share_256=more.overturning_share,
        share_drawn=many.overturning_share,
        draws=many.members,
        inside_band=_inside(whole, many),
    )


def _inside(whole: Ensemble, many: Ensemble) -> float:
    """Where some overturn the band is open above and holds more than its share, so it says nothing of the design."""
    if whole.rotation_ratio_median <= NEGLIGIBLE or np.isinf(many.rotation_ratios).any():
        return float("nan")
    low, high = whole.rotation_ratio_low, whole.rotation_ratio_high
    return float(((many.rotation_ratios >= low) & (many.rotation_ratios <= high)).mean())


def ensemble_scores(trials: Sequence[EnsembleTrial]) -> Iterator[Score]:
    """Yield every measure on each half of the sites, with intervals."""
    for half, own in pd.DataFrame(trials).groupby("half"):
        yield from scores.scored("ensemble", str(half), _measures(own), own.site.tolist())


def _measures(own: pd.DataFrame) -> Mapping[str, scores.Measured]:
    truth, risk = own.share_drawn, EnsembleSettings().risk
    is_open = truth.between(*OPEN, inclusive="neither")
    decided = own.verdict != Verdict.UNDECIDED
    opposite = truth.where(own.verdict == Verdict.STANDS, 1 - truth).where(decided)
    measures: dict[str, scores.Measured] = {}
    for size, allowed in ALLOWED.items():
        within = (own[f"share_{size}"] - truth).abs() <= allowed
        measures[f"share within {allowed} with {size} members (0.95 is asked)"] = within.where(is_open)
    for more, asked in ((BEYOND, f" by more than {BEYOND} (0 is asked)"), (0.0, "")):
        measures[f"share of verdicts beyond their risk{asked}"] = (opposite > risk + more).where(decided)
    return measures | {
        "share of draws inside the 5-95 % band (0.87 to 0.93 is asked)": own.inside_band,
        "verdicts": lambda rows: float(decided.to_numpy()[rows].sum()),
    }
