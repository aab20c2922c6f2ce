"""Walls below a diaphragm that drifts: does what stands between floors that move with the ground fall on it?

Walls between floor and ceiling are drawn under real motions, scaled to 1 to 3 times what lifts them. A wall whose foot
is on the ground and whose top is on a diaphragm with the drift d(t) rocks as on the ground under ü_g + c d̈, the gravity
of the drift left out (`drift_share`). What is said to stand under the ground alone is followed under that, below a
diaphragm that is one damped oscillator. Nothing is chosen here.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.report import Target
from docs.research.sites import (
    SiteRecord,
    Trial,
    draw_of,
    independent,
    lifting_factor,
    one_of_each,
    sample_of,
    trials_under,
)
from rocking import Mode, Support, Verdict, Wall, assess, integrate
from rocking.errors import StructureWarning
from rocking.tables import column, row

WALLS = 8
"""Drawn under each component."""
UPLIFTS = (1.0, 3.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
PERIODS = (0.15, 1.0)
"""Of diaphragms, s, log-uniform."""
DAMPING = 0.05
"""Of diaphragms."""


@row(
    "diaphragms",
    "One row per wall and component: what is said under the ground alone, and the wall below a diaphragm",
)
class DiaphragmTrial(Trial):
    """One trial."""

    height_m: float = column("Height, m")
    thickness_m: float = column("Thickness, m")
    period_s: float = column("Period of the diaphragm, s")
    share: float = column("Share c of the drift that acts as ground motion")
    verdict: Verdict = column("Verdict of the package under the ground alone")
    falls: int | None = column(
        "Of the motion and its reverse, how many overturn it; empty: not said to stand"
    )


def diaphragms(target: Target) -> None:
    """Hold what is said of walls between floors against the same walls below a diaphragm that drifts."""
    components = one_of_each(independent(target.records))
    places = [(place,) for place in range(WALLS)]
    trials = trials_under(components, diaphragm_trial, places, target.tell, _falling)
    target.publish(
        "Walls below a diaphragm",
        "Walls between floors that move with the ground, and below a diaphragm that drifts.",
        {DiaphragmTrial: trials, scores.Score: list(diaphragm_scores(trials))},
    )


def _falling(trials: Sequence[DiaphragmTrial]) -> str:
    return f", {sum(bool(trial.falls) for trial in trials)} that stand fall below a diaphragm"


def diaphragm_trial(component: SiteRecord, place: int) -> DiaphragmTrial:
    """Return one trial: wall, diaphragm and scale drawn. Raises RockingError where an impact stops so squat a wall."""
    draw = draw_of(component.identifier, 134, place)
    height = float(draw.uniform(2.5, 5.0))
    thickness = float(draw.uniform(0.2, 0.5))
    period = float(np.exp(draw.uniform(*np.log(PERIODS))))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StructureWarning)
        wall = Wall.of_size(height, thickness)
        factor = lifting_factor(component.accelerogram, wall.static_multiplier, UPLIFTS, draw)
        ground = component.accelerogram.scaled(factor)
        verdict = assess(ground, wall).verdict
        share = drift_share(wall.lower_height, wall.upper_height)
        roof = Support((Mode(period=period, damping_ratio=DAMPING, participation=1.0),)).motion(ground)
        # The support rings on after the record, at samples that may be finer.
        below = np.interp(roof.times, ground.times, ground.acceleration, right=0.0)
        mixed = (1 - share) * below + share * roof.acceleration
        responses = [
            integrate(wall.mechanism(), replace(roof, acceleration=sign * mixed)) for sign in (1.0, -1.0)
        ]
    falls = sum(np.isinf(response.rotation_ratio) for response in responses)
    return DiaphragmTrial(
        **component.named,
        structure="wall",
        scale_factor=factor,
        height_m=wall.height,
        thickness_m=wall.thickness,
        period_s=period,
        share=share,
        verdict=verdict,
        falls=int(falls) if verdict is Verdict.STANDS else None,
    )


def drift_share(lower: float, upper: float) -> float:
    """Return c = (2/H²)(h₁²/3 + h₂H/2 − h₂²/3) of the heights below and above the hinge, m; 1/2 at mid-height.

    The drift grows linearly from foot to top: c is its mean, weighted by how far the mechanism moves at each height.
    """
    height = lower + upper
    return 2 / height**2 * (lower**2 / 3 + upper * height / 2 - upper**2 / 3)


def diaphragm_scores(trials: Sequence[DiaphragmTrial]) -> Iterator[scores.Score]:
    """Yield the share of what is said to stand that falls below a diaphragm, with its interval by earthquake."""
    every = pd.DataFrame(trials)
    stands = (every.verdict == Verdict.STANDS).to_numpy()
    measures: dict[str, scores.Measured] = {
        'falls below a diaphragm among "stands"': np.where(stands, every.falls.astype(float) > 0, np.nan),
        '"stands"': stands.astype(float),
    }
    yield from scores.scored("walls", "all stations", measures, sample_of(every.site, every.earthquake))
