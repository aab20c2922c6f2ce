"""What a cheap figure is worth: an estimate of the share of members that overturn, with its interval.

Each tier is a logistic regression on intensity measures, fitted by the target `calibrate` to the ensembles of
mechanisms under real records; tiers.json holds the coefficients. The interval of an estimate is that of the fit, by
resampling sites in the large (a sandwich of their scores).
"""

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from enum import StrEnum
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from rocking.tables import write_whole

STRUCTURE = ("restitution", "restoring_defect", "forcing_defect")
"""Terms of the structure, which every tier has last."""
NORMAL_95 = 1.6449
"""95 % quantile of the normal distribution."""
_SLACK = 0.05
"""Share of the range of a property by which a structure may lie beyond those behind the fit."""


class Tier(StrEnum):
    """What an estimate rests on."""

    PEAK_VELOCITY = "peak velocity"
    BLOCK_AT_FIVE_SCALES = "block at five scales"

    @property
    def terms(self) -> tuple[str, ...]:
        """The measures it takes, of rocking.assessment.intensity."""
        return (*_TERMS[self], *STRUCTURE)


_TERMS: Mapping[Tier, tuple[str, ...]] = {
    Tier.PEAK_VELOCITY: ("peak_velocity",),
    Tier.BLOCK_AT_FIVE_SCALES: (
        "block",
        "block_overturns",
        "block_high",
        "block_overturning_share",
        "block_never_overturns",
        "block_always_overturns",
    ),
}


@dataclass(frozen=True)
class Estimate:
    """What a tier says of a case: share of members that overturn, and its 90 % interval."""

    tier: Tier
    share: float
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class TierFit:
    """One fitted tier.

    centre, spread, least, largest: (k,) of the terms. coefficients: (k + 1,) and their covariance (k + 1, k + 1),
    intercept first. frequencies: least and largest frequency parameter behind the fit, rad/s.
    """

    tier: Tier
    centre: np.ndarray
    spread: np.ndarray
    least: np.ndarray
    largest: np.ndarray
    coefficients: np.ndarray
    covariance: np.ndarray
    frequencies: tuple[float, float]

    def unlike(self, measures: Mapping[str, float]) -> str:
        """Say which property of a structure lies beyond those behind the fit; "" where none does."""
        ranges = {"frequency_parameter": self.frequencies}
        for place, name in enumerate(STRUCTURE, start=-len(STRUCTURE)):
            ranges[name] = float(self.least[place]), float(self.largest[place])
        for name, (least, largest) in ranges.items():
            slack, value = _SLACK * (largest - least), measures[name]
            if not least - slack <= value <= largest + slack:
                shown, low, high = (f"{float(f'{each:.2g}'):g}" for each in (value, least, largest))
                return f"{name.replace('_', ' ')} is {shown}, beyond the {low} to {high} of the calibration"
        return ""

    def design(self, terms: np.ndarray) -> np.ndarray:
        """(n, k + 1) of the terms (n, k): an intercept, and what is centred and scaled."""
        return np.column_stack([np.ones(len(terms)), (terms - self.centre) / self.spread])

    def log_odds(self, terms: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Log odds of overturning (n,) of terms (n, k), and their standard error."""
        design = self.design(terms)
        variance = np.einsum("ij,jk,ik->i", design, self.covariance, design)
        return design @ self.coefficients, np.sqrt(np.maximum(variance, 0.0))

    def estimate(self, measures: Mapping[str, float]) -> Estimate | None:
        """Return what the tier says of a case; None of a structure unlike all behind it.

        Raises KeyError where a measure is missing.
        """
        if self.unlike(measures):
            return None
        odds, error = (
            float(each[0]) for each in self.log_odds(np.array([[measures[t] for t in self.tier.terms]]))
        )
        return Estimate(self.tier, *(_share(odds + k * NORMAL_95 * error) for k in (0, -1, 1)))


def _share(odds: float) -> float:
    return 1 / (1 + math.exp(-odds))


@lru_cache(maxsize=1)
def shipped_tiers() -> dict[Tier, TierFit]:
    """Return the tiers that the package ships, made by the target `calibrate` from real records."""
    return read_tiers(Path(__file__).with_name("tiers.json"))


def read_tiers(path: Path) -> dict[Tier, TierFit]:
    """Return the tiers in a file that `write_tiers` made."""
    fits = json.loads(path.read_text(encoding="utf-8"))["tiers"]
    return {Tier(name): _fit(Tier(name), each) for name, each in fits.items()}


def _fit(tier: Tier, content: Mapping[str, Any]) -> TierFit:
    arrays = {name: np.array(each) for name, each in content.items() if name not in ("terms", "frequencies")}
    low, high = content["frequencies"]
    return TierFit(tier=tier, frequencies=(low, high), **arrays)


def write_tiers(path: Path, fits: Mapping[Tier, TierFit], about: Mapping[str, object]) -> None:
    """Write tiers as JSON. about: records, sites and cases behind them, and records_sha256 of the records' hashes."""
    tiers = {
        str(tier): {"terms": tier.terms}
        | {name: np.asarray(each).tolist() for name, each in asdict(fit).items() if name != "tier"}
        for tier, fit in fits.items()
    }
    write_whole(path, (json.dumps({"about": dict(about), "tiers": tiers}, indent=1) + "\n").encode())
