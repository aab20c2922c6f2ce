"""Is the share of an ensemble right? Its few members held against thousands of random draws of the same causes.

This measures the design, not the causes: whether the motion and the restitution are known as well as the ranges say
is for measured tests to tell. The design is a published one. The allowance of the verdicts was chosen on half of the
near-fault sites, named "chosen" here; the other half and all further sites are left out of every choice.
"""

import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path

import numpy as np

from docs.research import scores
from docs.research.report import publish
from docs.research.scores import Score
from docs.research.sites import independent, lifting_factor, site_of
from rocking.assessment.ensemble import (
    CAUSES,
    Ensemble,
    EnsembleSettings,
    GroundMotions,
    drawn,
    ensemble,
    lattice,
)
from rocking.assessment.verdict import NEGLIGIBLE, Verdict
from rocking.pulses import rotated
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.tables import Row, column, row

DRAWS = 4000
STRUCTURES_PER_RECORD = 3
UPLIFTS = (1.3, 8.0)
"""Range of peak acceleration over uplift acceleration to which the records are scaled, log-uniform."""
OPEN = (0.02, 0.98)
"""Shares between which an error of the design matters."""
ALLOWED = {64: 0.07, 256: 0.035}
"""Error asked of a share, by members."""
EDGES = (0.0, 0.02, 0.2, 0.4, 0.6, 0.8, 0.98, 1.0)
"""Of the classes of a reliability diagram."""
BEYOND = 0.03
"""By how much the share of the opposite may exceed the risk of a verdict."""
CHOSEN, LEFT_OUT, PAIRS = "chosen", "left out", "pairs, all directions"
ALL_DIRECTIONS = 24
"""Between which the draws of a pair choose."""


@row(
    "ensemble_trials", "One row per record and structure: the ensemble beside random draws of the same causes"
)
class EnsembleTrial(Row):
    """One case."""

    record: str = column("Identifier of the record in the catalogue")
    site: str = column("Event and station")
    half: str = column("chosen: a site on which the allowance was chosen; left out: another; or a pair")
    structure: str = column("Name of the structure")
    scale_factor: float = column("What the record was multiplied by")
    verdict: Verdict = column("Verdict of the ensemble")
    members: int = column("Members it took")
    share: float = column("Share of them that overturn")
    share_64: float = column("Share of 64 members that overturn")
    share_256: float = column("Share of 256 members that overturn")
    share_drawn: float = column("Share of the random draws that overturn")
    draws: int = column("Random draws")
    inside_band: float = column(
        "Share of the draws within the 5-95 % band of the ensemble; empty where it rests or may overturn"
    )


def try_ensembles(
    near_fault: Iterable[tuple[str, Accelerogram]],
    others: Iterable[tuple[str, Accelerogram]],
    structures: Mapping[str, Structure],
    draws: int = DRAWS,
) -> Iterator[EnsembleTrial]:
    """Yield trials of the components that count, and of the pairs, at scales that spread from uplift to overturning.

    others: records that took no part in any choice. Each component and each pair is tried with some of `structures`.
    """
    first, names = list(near_fault), list(structures)
    near = {site_of(record) for _, record in first}
    alone: list[tuple[str, str, str, list[Accelerogram]]] = []
    pairs: dict[str, tuple[str, str, str, list[Accelerogram]]] = {}
    for name, site, record in independent(chain(first, others)):
        odd = zlib.crc32(f"{record.event}; {record.station}".encode()) % 2  # how the halves were once drawn
        alone.append((name, site, CHOSEN if odd and site in near else LEFT_OUT, [record]))
        pairs.setdefault(site, (name, site, PAIRS, []))[-1].append(record)
    for group in (alone, [each for each in pairs.values() if len(each[-1]) > 1]):
        for place, (name, site, half, components) in enumerate(group):
            rng = np.random.default_rng(zlib.crc32(name.encode()))
            for k in range(STRUCTURES_PER_RECORD):
                structure = names[(place * STRUCTURES_PER_RECORD + k) % len(names)]
                about = {"record": name, "site": site, "half": half, "structure": structure}
                yield _trial(about, structures[structure], components, rng, draws)


def _trial(
    about: Mapping[str, str],
    structure: Structure,
    components: Sequence[Accelerogram],
    rng: np.random.Generator,
    draws: int,
) -> EnsembleTrial:
    """Return the trial of a structure under one component, or two. about: what names it."""
    mechanism, settings = structure.mechanism(), EnsembleSettings()
    factor = lifting_factor(components[0], mechanism.uplift_multiplier, UPLIFTS, rng)
    scaled = [each.scaled(factor) for each in components]
    motions = GroundMotions.of_pair(*scaled) if len(scaled) > 1 else GroundMotions.of(*scaled)
    everywhere = _all_directions(*scaled) if len(scaled) > 1 else motions
    few, more = (drawn(mechanism, motions, lattice(size), settings) for size in ALLOWED)
    many = drawn(mechanism, everywhere, rng.random((draws, len(CAUSES))), settings)
    whole = ensemble(mechanism, motions, settings)
    shares = {"share": whole, "share_64": few, "share_256": more, "share_drawn": many}
    return EnsembleTrial.of(
        about,
        whole,
        {name: each.overturning_share for name, each in shares.items()},
        scale_factor=factor,
        draws=many.members,
        inside_band=_inside(whole, many),
    )


def _all_directions(first: Accelerogram, second: Accelerogram) -> GroundMotions:
    turned = [rotated(first, second, np.pi * k / ALL_DIRECTIONS) for k in range(ALL_DIRECTIONS)]
    return GroundMotions({(str(k), ""): motion for k, motion in enumerate(turned)})


def _inside(whole: Ensemble, many: Ensemble) -> float:
    """Where some overturn the band is open above and holds more than its share, so it says nothing of the design."""
    if whole.rotation_ratio_median <= NEGLIGIBLE or np.isinf(many.rotation_ratios).any():
        return float("nan")
    low, high = whole.rotation_ratio_low, whole.rotation_ratio_high
    return float(((many.rotation_ratios >= low) & (many.rotation_ratios <= high)).mean())


def ensemble_scores(trials: Sequence[EnsembleTrial], replicates: int = scores.REPLICATES) -> list[Score]:
    """Return every measure on each half of the sites and the reliability of the shares, with intervals."""
    found: list[Score] = []
    for half in sorted({trial.half for trial in trials}):
        own = [trial for trial in trials if trial.half == half]
        sites = [trial.site for trial in own]
        stated, drawn_share = (
            np.array([getattr(trial, name) for trial in own]) for name in ("share", "share_drawn")
        )
        found += scores.scored("ensemble", half, _measures(own), sites, replicates)
        found += scores.reliability("ensemble", half, stated, drawn_share, sites, EDGES, replicates)
    return found


def _measures(trials: Sequence[EnsembleTrial]) -> Mapping[str, scores.Measure]:
    said, truth, inside = (
        np.array([getattr(trial, name) for trial in trials])
        for name in ("share", "share_drawn", "inside_band")
    )
    is_open = (truth > OPEN[0]) & (truth < OPEN[1])
    verdicts = [trial.verdict for trial in trials]
    excluded = {Verdict.STANDS: truth, Verdict.OVERTURNS: 1 - truth}
    against = np.array([excluded[each][k] if each in excluded else np.nan for k, each in enumerate(verdicts)])
    beyond, too_sure = (
        np.where(np.isnan(against), np.nan, against > EnsembleSettings().risk + more) for more in (0, BEYOND)
    )
    measures: dict[str, scores.Measure] = {}
    for size, allowed in ALLOWED.items():
        few = np.array([getattr(trial, f"share_{size}") for trial in trials])
        within = np.where(is_open, np.abs(few - truth) <= allowed, np.nan)
        measures[f"share within {allowed} with {size} members (0.95 is asked)"] = scores.mean(within)
    return measures | {
        "share of draws inside the 5-95 % band (0.87 to 0.93 is asked)": scores.mean(inside),
        f"share of verdicts beyond their risk by more than {BEYOND} (0 is asked)": scores.mean(too_sure),
        "share of verdicts beyond their risk": scores.mean(beyond),
        "verdicts": lambda rows: float((~np.isnan(against[rows])).sum()),
        "share of cases decided": scores.mean(
            np.array([float(v is not Verdict.UNDECIDED) for v in verdicts])
        ),
        "Brier score": lambda rows: scores.brier(said[rows], truth[rows]),
        "Brier score of the draws themselves": lambda rows: scores.brier(truth[rows], truth[rows]),
    }


def write_ensemble_accuracy(
    near_fault: Iterable[tuple[str, Accelerogram]],
    others: Iterable[tuple[str, Accelerogram]],
    structures: Mapping[str, Structure],
    folder: Path,
) -> None:
    """Write the trials, their scores and their report into `folder`."""
    trials = list(try_ensembles(near_fault, others, structures))
    subtitle = f"Shares of few members beside {DRAWS} random draws of the same causes."
    tables = {EnsembleTrial: trials, Score: ensemble_scores(trials)}
    publish(folder, "How right the share of an ensemble is", subtitle, tables)
