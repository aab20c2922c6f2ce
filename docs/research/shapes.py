"""Which pulse to take: half a sine, a sine, a cosine and several cycles, each beside the integration of a record."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from docs.research.report import Target
from docs.research.scores import Measured, Score, median, scored
from docs.research.sites import SiteRecord, independent, sample_of
from rocking import Accelerogram, Pulse, integrate, predict_maximum
from rocking.assessment.methods import Agreement, agreement, ratio, rests
from rocking.structures import Structure

SHAPES: Mapping[str, tuple[float, float]] = {
    "half sine": (0.5, 0.0),
    "one sine": (1.0, 0.0),
    "one cycle of cosine": (1.0, math.pi / 2),
    "two cycles of sine": (2.0, 0.0),
    "three cycles of sine": (3.0, 0.0),
}
"""Cycles, and phase at which they begin [rad]."""
BAND = (0.15, 5.0)
"""Frequencies that are tried, Hz."""
PER_OCTAVE = 24


@dataclass(frozen=True)
class Fitted:
    """The pulse of one shape that explains most of a record. explained: share of its energy ∫a² dt."""

    pulse: Pulse
    explained: float


def pulse_shapes(target: Target) -> None:
    """Score each shape on all records and on those that it explains best, and the best one of each record."""
    cases: list[Case] = []
    for record in independent(target.records):
        fits = {name: fit for name in SHAPES if (fit := fitted(record.accelerogram, *SHAPES[name]))}
        if fits:
            cases += compared(record, fits, target.structures)
        target.tell(record.identifier)
    rows = list(scores_of(cases))
    subtitle = f"{len({case.site for case in cases})} sites, {len(target.structures)} structures."
    target.publish("Which pulse to take", subtitle, {Score: rows})


def fitted(record: Accelerogram, cycles: float, phase: float) -> Fitted | None:
    """Return the pulse of a shape of largest energy gain ⟨a, s⟩²/⟨s, s⟩ over the grid; None where none fits the record.

    The sum over a window of every onset is a difference of cumulative sums of a e^{iωt}, turned back to its onset.
    """
    samples, step = record.acceleration, record.time_step
    times = np.arange(samples.size) * step
    octaves = math.log2(BAND[1] / BAND[0])
    best: tuple[float, Pulse] | None = None
    for frequency in BAND[0] * 2 ** (np.arange(octaves * PER_OCTAVE) / PER_OCTAVE):
        omega = 2 * math.pi * float(frequency)
        count = round(cycles / frequency / step) + 1
        if not 8 <= count < samples.size:
            continue
        summed = np.concatenate([[0], np.cumsum(samples * np.exp(1j * omega * times))])
        windows = (summed[count:] - summed[:-count]) * np.exp(
            -1j * (omega * times[: times.size - count + 1] - phase)
        )
        norm = float(np.square(np.sin(omega * times[:count] + phase)).sum())
        place = int(np.argmax(np.abs(windows.imag)))
        sine = float(windows.imag[place])
        if best is None or sine**2 / norm > best[0]:
            best = (
                sine**2 / norm,
                Pulse(
                    amplitude=sine / norm,
                    circular_frequency=omega,
                    start_time=float(times[place]),
                    cycles=cycles,
                    phase=phase,
                ),
            )
    return None if best is None else Fitted(best[1], best[0] / float(np.square(samples).sum()))


@dataclass(frozen=True)
class Case:
    """One structure under one record: by each shape how much it explains, and the rotation ratio by its closed form."""

    site: str
    earthquake: str
    integrated: float
    explained: Mapping[str, float]
    predicted: Mapping[str, float]

    @property
    def best(self) -> str:
        """The shape that explains most."""
        return max(self.explained, key=self.explained.__getitem__)


def compared(
    component: SiteRecord, fits: Mapping[str, Fitted], structures: Mapping[str, Structure]
) -> Iterator[Case]:
    """Yield each structure that a record moves, or that one of its pulses does."""
    explained = {name: fit.explained for name, fit in fits.items()}
    for structure in structures.values():
        mechanism = structure.mechanism()
        block = mechanism.equivalent_block("exact_at_rest")
        integrated = integrate(mechanism, component.accelerogram).rotation_ratio
        predicted = {name: predict_maximum(block, fit.pulse).rotation_ratio for name, fit in fits.items()}
        if not all(map(rests, (integrated, *predicted.values()))):
            yield Case(component.site, component.earthquake, integrated, explained, predicted)


def scores_of(cases: Sequence[Case]) -> Iterator[Score]:
    """Yield the scores of every shape."""
    for name in SHAPES:
        own = [case for case in cases if name in case.predicted]
        yield from _scored(name, "all records", own, [name] * len(own))
        best = [case for case in own if case.best == name]
        yield from _scored(name, f"where {name} explains most", best, [name] * len(best))
        with_sine = [case for case in best if "one sine" in case.predicted]
        yield from _scored(
            "one sine", f"where {name} explains most", with_sine, ["one sine"] * len(with_sine)
        )
    yield from _scored("the best of each record", "all records", cases, [case.best for case in cases])


def _scored(subject: str, part: str, cases: Sequence[Case], shapes: Sequence[str]) -> Iterator[Score]:
    pairs = [(case.predicted[name], case.integrated) for case, name in zip(cases, shapes, strict=True)]
    if not pairs:
        return
    outcomes = [agreement(predicted=predicted, integrated=integrated) for predicted, integrated in pairs]
    errors = [abs(ratio(predicted=predicted, integrated=integrated) - 1) for predicted, integrated in pairs]
    measures: dict[str, Measured] = {
        "wrong verdicts": [float(outcome is not Agreement.SAME) for outcome in outcomes],
        "unsafe verdicts": [float(outcome is Agreement.TOO_LOW) for outcome in outcomes],
        "median error of the rotation": median(errors),
        "explained energy": [case.explained[name] for case, name in zip(cases, shapes, strict=True)],
    }
    sample = sample_of([case.site for case in cases], [case.earthquake for case in cases])
    yield from scored(subject, part, measures, sample)
