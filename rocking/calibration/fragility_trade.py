"""What accuracy costs in a fragility: its median by every method at the same levels, and the time of each."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from time import process_time

import numpy as np

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility import (
    Fragility,
    IncrementalDynamicAnalysis,
    incremental_dynamic_analysis,
    multi_fidelity_analysis,
)
from rocking.assessment.fragility.cases import MEMBERS, Cases
from rocking.assessment.fragility.curve import fragility_of
from rocking.assessment.rows.of_trade import MultiFidelityRow, TradeFragilityRow, TradeMethod
from rocking.calibration.accuracy import Pulses
from rocking.calibration.multifidelity import Answers, multi_fidelity_rows
from rocking.pulses import Pulse
from rocking.pulses.methods.sine_by_demand import CANDIDATES
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maxima
from rocking.structures import EquivalentBlock, Mechanism

TIGHT = 1e-9
"""Tolerance of the reference."""
ONE_IN = 10
"""Cases for each in which multi-fidelity follows the mechanism."""


@dataclass(frozen=True, eq=False)
class Suite:
    """Records with their pulses. ensemble: what is not known of a case."""

    records: Sequence[Accelerogram]
    pulses: Sequence[Pulses]
    intensity_measure: str
    ensemble: EnsembleSettings

    @property
    def stations(self) -> int:
        """Independent records."""
        return len({(record.event, record.station) for record in self.records})


@dataclass
class _Measured:
    """One structure under the suite: what each method finds at the levels of the reference, and its time, s."""

    suite: Suite
    mechanism: Mechanism
    reference: IncrementalDynamicAnalysis
    cpu: dict[TradeMethod, float] = field(default_factory=dict)
    outcomes: dict[TradeMethod, np.ndarray] = field(default_factory=dict)

    def curve(self, method: TradeMethod, run: Callable[[], np.ndarray | Fragility]) -> Fragility:
        started = process_time()
        found = run()
        if not isinstance(found, Fragility):
            self.outcomes[method] = found
            found = fragility_of(self.reference.levels, found, self.reference.stations)
        self.cpu[method] = process_time() - started
        return found

    def scaled(self, ensemble: EnsembleSettings | None = None) -> Fragility:
        return incremental_dynamic_analysis(
            self.suite.records,
            self.mechanism,
            intensity_measure=self.suite.intensity_measure,
            levels=self.reference.levels,
            ensemble=ensemble,
        ).fragility()


def trade_fragility_rows(
    structure: str, mechanism: Mechanism, suite: Suite
) -> tuple[list[TradeFragilityRow], list[MultiFidelityRow]]:
    """Return the rows of one structure. Raises ConfigurationError as `incremental_dynamic_analysis` does."""
    reference = incremental_dynamic_analysis(
        suite.records, mechanism, intensity_measure=suite.intensity_measure, tolerance=TIGHT
    )
    measured, block = _Measured(suite, mechanism, reference), mechanism.equivalent_block("rest")
    cases = reference.rotation_ratios.size
    runs = max(20, cases // ONE_IN)
    every: dict[TradeMethod, tuple[int, Callable[[], np.ndarray | Fragility]]] = {
        TradeMethod.ONE_SINE: (cases, partial(_by_sines, block, measured, 1)),
        TradeMethod.SINES: (cases * CANDIDATES, partial(_by_sines, block, measured, CANDIDATES)),
        TradeMethod.BLOCK: (cases, partial(_by_block, block, measured)),
        TradeMethod.MULTI_FIDELITY: (runs, partial(_multi_fidelity, measured, runs)),
        TradeMethod.MECHANISM: (cases, measured.scaled),
        TradeMethod.ENSEMBLE: (cases * MEMBERS, partial(measured.scaled, suite.ensemble)),
    }
    rows = [
        _row(structure, method, responses, measured.curve(method, run), measured)
        for method, (responses, run) in every.items()
    ]
    answers = Answers(
        reference.levels,
        np.isinf(reference.rotation_ratios[:, :, 0]).astype(float),
        measured.outcomes[TradeMethod.BLOCK],
        measured.outcomes[TradeMethod.ONE_SINE],
        measured.cpu[TradeMethod.MECHANISM] / cases,
        measured.cpu[TradeMethod.BLOCK] / cases,
    )
    return rows, list(multi_fidelity_rows(structure, answers))


def _row(
    structure: str, method: TradeMethod, responses: int, found: Fragility, measured: _Measured
) -> TradeFragilityRow:
    exact, suite = measured.reference.fragility(), measured.suite
    is_open = (exact.probability > 0.02) & (exact.probability < 0.98)
    sines = method in (TradeMethod.ONE_SINE, TradeMethod.SINES)
    return TradeFragilityRow(
        structure=structure,
        method=method,
        intensity_measure=suite.intensity_measure,
        records=len(suite.records),
        stations=suite.stations,
        responses=responses,
        median=found.median,
        reference_median=exact.median,
        error=found.median / exact.median - 1,
        curve_error=float(np.abs(found.probability - exact.probability)[is_open].mean()),
        interval_ratio=found.interval[1] / found.interval[0],
        cpu_s=measured.cpu[method],
        preparation_s=sum(pulses.cpu for pulses in suite.pulses) if sines else 0.0,
    )


def _by_sines(block: EquivalentBlock, measured: _Measured, many: int) -> np.ndarray:
    """Whether the worst of the first `many` sines overturns the block, (r, k); a record without any never does."""
    levels = measured.reference.levels

    def overturns() -> Iterator[np.ndarray]:
        for pulses, intensity in zip(measured.suite.pulses, measured.reference.intensities, strict=True):
            scaled = [
                Pulse(pulse.amplitude * factor, pulse.circular_frequency, pulse.start_time)
                for pulse in pulses.sines[:many]
                for factor in levels / intensity
            ]
            found = predict_maxima([block], scaled)[0] if scaled else np.zeros(levels.size)
            yield np.asarray(np.isinf(found.reshape(-1, levels.size)).any(axis=0))

    return np.array(list(overturns()), dtype=float)


def _by_block(block: EquivalentBlock, measured: _Measured) -> np.ndarray:
    cases = Cases(measured.suite.records, block, measured.reference.intensities, None, 1e-6)
    return np.asarray(np.isinf(cases.at_levels(measured.reference.levels)[:, :, 0]), dtype=float)


def _multi_fidelity(measured: _Measured, runs: int) -> Fragility:
    return multi_fidelity_analysis(
        measured.suite.records,
        measured.mechanism,
        runs,
        intensity_measure=measured.suite.intensity_measure,
        levels=measured.reference.levels,
    ).fragility()
