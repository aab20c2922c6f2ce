"""Is the probability of an ensemble right? Its few members held against thousands of random draws of the same causes.

This measures the design, not the causes: whether the motion and the restitution are known as well as the ranges say
is for measured tests to tell. The design is a published one. The allowance of the verdicts was chosen on half of the
near-fault sites, named "chosen" here; the other half and all further sites are left out of every choice.
"""

import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from docs.research import scores
from docs.research.reliability_figure import write_reliability
from docs.research.tier_cases import independent
from rocking.assessment.ensemble import CAUSES, Ensemble, EnsembleSettings, GroundMotions, drawn, ensemble
from rocking.assessment.ensemble.design import lattice
from rocking.assessment.verdict import NEGLIGIBLE, Verdict
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.tables import Row, column, frame, row, write_tables

DRAWS = 4000
STRUCTURES_PER_RECORD = 3
UPLIFTS = (1.3, 8.0)
"""Range of peak acceleration over uplift acceleration to which the records are scaled, log-uniform."""
OPEN = (0.02, 0.98)
"""Probabilities between which an error of the design matters."""
ALLOWED = {64: 0.07, 256: 0.035}
"""Error asked of a probability, by members."""
BEYOND = 0.03
"""By how much the probability of the opposite may exceed the risk of a verdict."""
REPLICATES = 2000
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
    probability: float = column("Share of them that overturn")
    probability_64: float = column("Share of 64 members that overturn")
    probability_256: float = column("Share of 256 members that overturn")
    probability_drawn: float = column("Share of the random draws that overturn")
    draws: int = column("Random draws")
    inside_band: float = column(
        "Share of the draws within the 5-95 % band of the ensemble; empty where it rests or may overturn"
    )


@row(
    "ensemble_accuracy", "One row per half of the sites and measure, with a 90 % interval by resampling sites"
)
class EnsembleAccuracy(Row):
    """One measure."""

    half: str = column("chosen or left out")
    measure: str = column("What was measured")
    value: float = column("Its value")
    value_low: float = column("5 % quantile over resampled sites")
    value_high: float = column("95 % quantile over resampled sites")
    asked: str = column("What is asked of it")
    cases: int = column("Cases behind it")
    sites: int = column("Sites behind it")


def try_ensembles(
    near_fault: Iterable[tuple[str, Accelerogram]],
    others: Iterable[tuple[str, Accelerogram]],
    structures: Mapping[str, Structure],
    draws: int = DRAWS,
) -> Iterator[EnsembleTrial]:
    """Yield trials of the components that count, at scales that spread from uplift to overturning.

    others: records that took no part in any choice. Each component is tried with some of `structures`.
    """
    chosen: set[str] = set()

    def marked() -> Iterator[tuple[str, Accelerogram]]:
        for name, record in near_fault:
            if zlib.crc32(_site(record).encode()) % 2:
                chosen.add(_site(record))
            yield name, record
        yield from others

    names = list(structures)
    for place, (name, _, record) in enumerate(independent(marked())):
        rng = np.random.default_rng(zlib.crc32(name.encode()))
        half = CHOSEN if _site(record) in chosen else LEFT_OUT
        for k in range(STRUCTURES_PER_RECORD):
            structure = names[(place * STRUCTURES_PER_RECORD + k) % len(names)]
            found = _trial(structures[structure], record, rng, draws)
            yield EnsembleTrial(record=name, site=_site(record), half=half, structure=structure, **found)


def _site(record: Accelerogram) -> str:
    return f"{record.event}; {record.station}"


def _trial(
    structure: Structure, record: Accelerogram, rng: np.random.Generator, draws: int
) -> dict[str, Any]:
    """The columns of one trial, but those that name it."""
    mechanism, settings = structure.mechanism(), EnsembleSettings()
    wanted = np.exp(rng.uniform(*np.log(UPLIFTS))) * mechanism.uplift_multiplier * GRAVITY
    factor = float(wanted / record.peak_acceleration)
    motions = GroundMotions.of(record.scaled(factor))
    few, more = (drawn(mechanism, motions, lattice(size, CAUSES), settings) for size in ALLOWED)
    many = drawn(mechanism, motions, rng.random((draws, CAUSES)), settings)
    found = ensemble(mechanism, motions, settings)
    return {
        "scale_factor": factor,
        "verdict": found.verdict,
        "members": found.members,
        "probability": found.overturning_probability,
        "probability_64": few.overturning_probability,
        "probability_256": more.overturning_probability,
        "probability_drawn": many.overturning_probability,
        "draws": many.members,
        "inside_band": _inside(found, many),
    }


def _inside(found: Ensemble, many: Ensemble) -> float:
    """Where some overturn the band is open above and holds more than its share, so it says nothing of the design."""
    if found.median <= NEGLIGIBLE or np.isinf(many.rotation_ratios).any():
        return float("nan")
    return float(((many.rotation_ratios >= found.low) & (many.rotation_ratios <= found.high)).mean())


Measure = Callable[[Sequence[EnsembleTrial]], float]


def _error(size: int) -> tuple[str, str, Measure]:
    def measure(trials: Sequence[EnsembleTrial]) -> float:
        errors = [abs(getattr(t, f"probability_{size}") - t.probability_drawn) for t in trials if _open(t)]
        return float(np.mean(np.array(errors) <= ALLOWED[size])) if errors else float("nan")

    return f"share within {ALLOWED[size]} with {size} members", "0.95 at least", measure


def _open(trial: EnsembleTrial) -> bool:
    return OPEN[0] < trial.probability_drawn < OPEN[1]


def _opposite(trial: EnsembleTrial) -> float:
    """Probability of what the verdict excludes; nan without a verdict."""
    excluded = {Verdict.STANDS: trial.probability_drawn, Verdict.OVERTURNS: 1 - trial.probability_drawn}
    return excluded.get(trial.verdict, float("nan"))


def _each(trials: Sequence[EnsembleTrial], column: str) -> np.ndarray:
    return np.array([getattr(trial, column) for trial in trials])


def _band(trials: Sequence[EnsembleTrial]) -> float:
    inside = _each(trials, "inside_band")
    return float(np.nanmean(inside)) if np.isfinite(inside).any() else float("nan")


def _too_sure(trials: Sequence[EnsembleTrial]) -> float:
    limit = EnsembleSettings().risk + BEYOND
    decided = [_opposite(trial) > limit for trial in trials if not np.isnan(_opposite(trial))]
    return float(np.mean(decided)) if decided else float("nan")


MEASURES: tuple[tuple[str, str, Measure], ...] = (
    _error(64),
    _error(256),
    ("share of draws inside the 5-95 % band", "0.87 to 0.93", _band),
    (f"share of verdicts beyond their risk by more than {BEYOND}", "0", _too_sure),
    (
        "share of cases decided",
        "",
        lambda trials: float(np.mean([t.verdict is not Verdict.UNDECIDED for t in trials])),
    ),
    (
        "Brier score",
        "",
        lambda trials: scores.brier(_each(trials, "probability"), _each(trials, "probability_drawn")),
    ),
    (
        "Brier score of the draws themselves",
        "",
        lambda trials: scores.brier(*[_each(trials, "probability_drawn")] * 2),
    ),
)
"""Name, what is asked, and how it is computed."""


def ensemble_accuracy(
    trials: Sequence[EnsembleTrial], replicates: int = REPLICATES
) -> list[EnsembleAccuracy]:
    """Return every measure on each half of the sites, with its interval."""
    halves = {half: [trial for trial in trials if trial.half == half] for half in (CHOSEN, LEFT_OUT)}
    return [row for half, own in halves.items() if own for row in _accuracy(half, own, replicates)]


def _accuracy(half: str, trials: Sequence[EnsembleTrial], replicates: int) -> Iterator[EnsembleAccuracy]:
    places: dict[str, int] = {}
    sites = [places.setdefault(trial.site, len(places)) for trial in trials]
    draws = scores.resampled(sites, replicates)
    counts = {"cases": len(trials), "sites": len(places)}
    for name, asked, measure in MEASURES:
        found = scores.scored(scores.of_cases(measure, trials), len(trials), draws)
        yield EnsembleAccuracy(half=half, measure=name, asked=asked, **found, **counts)


def write_ensemble_accuracy(
    near_fault: Iterable[tuple[str, Accelerogram]],
    others: Iterable[tuple[str, Accelerogram]],
    structures: Mapping[str, Structure],
    folder: Path,
) -> list[EnsembleAccuracy]:
    """Write ensemble_trials.csv and ensemble_accuracy.csv into `folder` and return the rows of the second."""
    trials = list(try_ensembles(near_fault, others, structures))
    accuracy = ensemble_accuracy(trials)
    write_tables({EnsembleTrial: trials, EnsembleAccuracy: accuracy}, folder)
    shown = frame(EnsembleTrial, folder / EnsembleTrial.table.file_name)
    write_reliability(shown, folder / "ensemble_reliability.svg")
    return accuracy
