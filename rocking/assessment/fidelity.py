"""The method that settles with the least work whether a structure overturns under a record: the first of these.

1. Nothing: |ü_g| / (g + ü_v) never exceeds λ, so it stays at rest. Exact.
2. Peak velocity: from p PGV/(gλ) the structure stands, where the estimate's 90 % interval lies within the risk. Of a
   structure unlike those of the calibration, and with vertical motion, it says nothing.
3. Mechanism on record, which settles what happens as recorded.
4. The ensemble, where the settings have one, which ends after 16 members that all stay far from overturning.

The estimate is a logistic regression of the share of members that overturn, fitted by the target `calibrate` to the
ensembles of mechanisms under real records; estimate.json holds the coefficients. Its interval is that of the fit, by
resampling sites in the large (a sandwich of their scores).
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from rocking.assessment.methods import Method
from rocking.errors import StructureError
from rocking.motion.integration import integrate
from rocking.motion.response import Response
from rocking.motion.table import forcing_of
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.measures import record_measures
from rocking.structures import EquivalentBlock, Mechanism, Outcome

_SMALLEST = 1e-3
"""Least ratio whose logarithm is taken."""
_LARGEST = 1e3
"""Largest p PGV/(gλ) whose logarithm is taken."""
STRUCTURE = ("restitution", "restoring_defect", "forcing_defect")
"""Terms of the structure."""
TERMS = ("peak_velocity", *STRUCTURE)
"""Terms of the estimate."""
NORMAL_95 = 1.6449
"""95 % quantile of the normal distribution."""
SHIPPED = Path(__file__).with_name("estimate.json")
"""File of the fit that the package ships."""
_SLACK = 0.05
"""Share of the range of a property by which a structure may lie beyond those behind the fit."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """Share of the members that overturn, as it is estimated, and its 90 % interval."""

    share: float
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class EstimateFit:
    """The fitted estimate of the share that overturns.

    centre, spread: (k,) of the terms. coefficients: (k + 1,) and their covariance (k + 1, k + 1), intercept first.
    ranges: least and largest value behind the fit of each property of a structure. lapse: share of the members that
    stand whatever the terms, so that no estimate of strong motions is too sure.
    """

    centre: np.ndarray
    spread: np.ndarray
    coefficients: np.ndarray
    covariance: np.ndarray
    ranges: Mapping[str, Sequence[float]]
    lapse: float = 0.0

    def unlike(self, measures: Mapping[str, float]) -> bool:
        """Whether a property of a structure lies beyond those behind the fit."""
        for name, (least, largest) in self.ranges.items():
            slack = _SLACK * (largest - least)
            if not least - slack <= measures[name] <= largest + slack:
                return True
        return False

    def design(self, terms: np.ndarray) -> np.ndarray:
        """Return 1 and the scaled terms (..., k): times the coefficients, the log odds of overturning."""
        return np.insert((terms - self.centre) / self.spread, 0, 1.0, axis=-1)

    def estimate(self, measures: Mapping[str, float]) -> Estimate | None:
        """Return the estimate of a case; None of a structure unlike all behind the fit."""
        if self.unlike(measures):
            return None
        design = self.design(np.array([measures[term] for term in TERMS]))
        error = np.sqrt(max(design @ self.covariance @ design, 0.0))
        ends = design @ self.coefficients + NORMAL_95 * error * np.array([0.0, -1.0, 1.0])
        most = np.array([1 - self.lapse, 1 - self.lapse, 1.0])  # the upper end decides what stands
        share, low, high = (most / (1 + np.exp(-ends))).tolist()
        return Estimate(share=share, low=low, high=high)


@lru_cache(maxsize=1)
def read_fit(path: Path = SHIPPED) -> EstimateFit:
    """Return the fit in a file that the target `calibrate` made; by default the shipped one."""
    fitted = json.loads(path.read_text(encoding="utf-8"))["fit"]
    values: dict[str, Any] = {
        name: np.array(value) if isinstance(value, list) else value for name, value in fitted.items()
    }
    return EstimateFit(**values)


def of_structure(mechanism: Mechanism) -> dict[str, float]:
    """Return the terms of a structure: restitution, defects of its equivalent block, and its frequency parameter."""
    defects = mechanism.block_defects
    return {
        "restitution": min(side.restitution for side in mechanism.sides),
        "restoring_defect": defects.restoring,
        "forcing_defect": defects.forcing,
        "frequency_parameter": mechanism.equivalent_block("exact_at_rest").frequency_parameter,
    }


_PEAK_VELOCITIES: WeakKeyDictionary[Accelerogram, float] = WeakKeyDictionary()


def peak_velocity(record: Accelerogram) -> float:
    """Return PGV by the trapezoidal rule from rest, m/s; measured once, as every structure asks for it."""
    if record not in _PEAK_VELOCITIES:
        _PEAK_VELOCITIES[record] = record_measures(record).peak_velocity
    return _PEAK_VELOCITIES[record]


def per_velocity(block: EquivalentBlock) -> float:
    """Return p/(gλ) of the side that lifts first, s/m."""
    return block.frequency_parameter / (GRAVITY * min(side.uplift_multiplier for side in block.sides))


def of_velocity(record: Accelerogram, block: EquivalentBlock) -> dict[str, float]:
    """Return ln of p PGV/(gλ)."""
    severity = per_velocity(block) * peak_velocity(record)
    return {"peak_velocity": float(np.log(np.clip(severity, _SMALLEST, _LARGEST)))}


@dataclass(frozen=True)
class MethodAnswer:
    """The method that settled a case, its outcome, and why no dearer one followed. response: of an integration."""

    method: Method
    outcome: Outcome
    reason: str
    response: Response | None = None


def stays_at_rest(
    mechanism: Mechanism, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> bool:
    """Whether the ground never reaches the uplift acceleration, whatever its phase with the vertical component."""
    return forcing_of(accelerogram, vertical).excitation <= mechanism.uplift_multiplier


def cheapest_answer(
    mechanism: Mechanism,
    record: Accelerogram,
    *,
    risk: float = 0.01,
    tolerance: float = 1e-6,
    vertical: Accelerogram | None = None,
    history: bool = False,
    fit: EstimateFit | None = None,
) -> MethodAnswer:
    """Return the first answer that settles whether `mechanism` overturns; the mechanism's own where nothing else does.

    risk: largest probability of the opposite outcome; 0: no estimate is trusted. tolerance, history: of the
    integration. fit: another one than the package ships. Raises MotionError as `integrate` does.
    """
    if stays_at_rest(mechanism, record, vertical):
        reason = "the ground never reaches the uplift acceleration"
        still = Response(rotation_ratio=0.0, outcome=Outcome.NO_UPLIFT)
        return MethodAnswer(Method.NOTHING_TO_INTEGRATE, Outcome.NO_UPLIFT, reason, still)
    if vertical is None and risk > 0:
        estimate = estimated(mechanism, record, fit)
        if estimate is not None and estimate.high <= risk:
            reason = f"p PGV/(gλ) settles it at a risk of {100 * risk:g} %"
            return MethodAnswer(Method.PEAK_VELOCITY, Outcome.ROCKS, reason)
    whole = integrate(mechanism, record, tolerance, history=history, vertical=vertical, repeat_fragile=True)
    reason = "the peak velocity does not settle it"
    return MethodAnswer(Method.MECHANISM_ON_RECORD, whole.outcome, reason, whole)


def estimated(mechanism: Mechanism, record: Accelerogram, fit: EstimateFit | None = None) -> Estimate | None:
    """Return the estimated share that overturns; None of a structure unlike those of the calibration."""
    if not all(side.can_overturn for side in mechanism.sides):
        return None
    fit = fit or read_fit()
    try:
        own = of_structure(mechanism)
        block = mechanism.equivalent_block("exact_at_rest")
    except StructureError:
        return None
    return fit.estimate(own | of_velocity(record, block))
