"""Is the share of an ensemble right? Its few members held against thousands of random draws of the same causes.

This measures the design, not the causes: whether the motion and the restitution are known as well as the ranges say
is for measured tests to tell. The design is a published one. The allowance of the verdicts was chosen on half of the
near-fault sites, named "chosen" here; the other half and all further sites are left out of every choice.
"""

import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

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
CHOSEN, LEFT_OUT = "chosen", "left out"


@row(
    "ensemble_trials", "One row per record and structure: the ensemble beside random draws of the same causes"
)
class EnsembleTrial(Row):
    """One case."""

    record: str = column("Identifier of the record in the catalogue")
    site: str = column("Event and station")
    half: str = column("chosen: of the sites on which the allowance was chosen; left out: of the others")
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
    """Yield trials of the components that count, at scales that spread from uplift to overturning.

    others: records that took no part in any choice. Each component is tried with some of `structures`.
    """
    first, names = list(near_fault), list(structures)
    near = {site_of(record) for _, record in first}
    for place, (name, site, record) in enumerate(independent(chain(first, others))):
        rng = np.random.default_rng(zlib.crc32(name.encode()))
        odd = zlib.crc32(f"{record.event}; {record.station}".encode()) % 2  # how the halves were once drawn
        half = CHOSEN if odd and site in near else LEFT_OUT
        for k in range(STRUCTURES_PER_RECORD):
            structure = names[(place * STRUCTURES_PER_RECORD + k) % len(names)]
            trial = _trial(structures[structure], record, rng, draws)
            yield EnsembleTrial(record=name, site=site, half=half, structure=structure, **trial)


def _trial(
    structure: Structure, record: Accelerogram, rng: np.random.Generator, draws: int
) -> dict[str, Any]:
    """The columns of one trial, but those that name it."""
    mechanism, settings = structure.mechanism(), EnsembleSettings()
    factor = lifting_factor(record, mechanism.uplift_multiplier, UPLIFTS, rng)
    motions = GroundMotions.of(record.scaled(factor))
    few, more = (drawn(mechanism, motions, lattice(size), settings) for size in ALLOWED)
    many = drawn(mechanism, motions, rng.random((draws, len(CAUSES))), settings)
    whole = ensemble(mechanism, motions, settings)
    return {
        "scale_factor": factor,
        "verdict": whole.verdict,
        "members": whole.members,
        "share": whole.overturning_share,
        "share_64": few.overturning_share,
        "share_256": more.overturning_share,
        "share_drawn": many.overturning_share,
        "draws": many.members,
        "inside_band": _inside(whole, many),
    }


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
    too_sure = np.where(np.isnan(against), np.nan, against > EnsembleSettings().risk + BEYOND)
    measures: dict[str, scores.Measure] = {}
    for size, allowed in ALLOWED.items():
        few = np.array([getattr(trial, f"share_{size}") for trial in trials])
        within = np.where(is_open, np.abs(few - truth) <= allowed, np.nan)
        measures[f"share within {allowed} with {size} members (0.95 is asked)"] = scores.mean(within)
    return measures | {
        "share of draws inside the 5-95 % band (0.87 to 0.93 is asked)": scores.mean(inside),
        f"share of verdicts beyond their risk by more than {BEYOND} (0 is asked)": scores.mean(too_sure),
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
