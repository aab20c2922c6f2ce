"""What another code says of a case: runs at three settings, each half the one before, read, extrapolated and told."""

import json
import math
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

VISIBLE = 0.02
"""Largest excursions, over the critical rotation, from which a restitution is read."""


@dataclass(frozen=True, eq=False)
class Run:
    """What a code says at one setting, nan where nothing.

    rotation_ratio: φ_max/φ_cr, inf if it overturns. restitution: of a reversal on still ground. outside_hinges: share
    of joint rotation outside the hinges of the mechanism at the largest rotation. landings: (k,) s.
    """

    rotation_ratio: float
    restitution: float = math.nan
    outside_hinges: float = math.nan
    landings: np.ndarray = field(default_factory=lambda: np.empty(0))


def serve(runs: Callable[[dict], Sequence[Run]], reason: str) -> None:
    """Answer the case on standard input in JSON, on the last line of standard output; reason: why it has no limit."""
    given, start = json.load(sys.stdin), time.process_time()
    found = runs(given)
    print("\n" + json.dumps(answer_of(found, time.process_time() - start, reason)))


def run_of(
    given: dict,
    times: np.ndarray,
    rotation: np.ndarray,
    energy: np.ndarray,
    outside_hinges: float = math.nan,
) -> Run:
    """Return what a history (n,) that stays up says of the case `given`; energy (n,) as for `restitution`."""
    critical, still = given["critical_rotation"], still_from(given)
    kept = restitution(times, rotation, energy, still, critical)
    return Run(float(np.abs(rotation).max()) / critical, kept, outside_hinges, landings(times, rotation))


def still_from(given: dict) -> float:
    """Return when the ground of a case comes to rest, s."""
    return (len(given["acceleration"]) - 1) * given["time_step"]


def answer_of(runs: Sequence[Run], duration: float, reason: str) -> dict:
    """Return the limits of three runs as a mapping for JSON; reason: why the largest rotation has none, if so.

    Where the limit of a small rotation would be negative, the last run stands, with the bar of the extrapolation.
    """
    ratio, bar = limit_of([run.rotation_ratio for run in runs])
    ratio = runs[-1].rotation_ratio if ratio < 0 else ratio
    kept, kept_bar = limit_of([run.restitution for run in runs])
    return {
        "rotation_ratio": ratio,
        "error_bar": bar,
        "restitution": kept,
        "restitution_error": kept_bar,
        "outside_hinges": runs[-1].outside_hinges,
        "landings": runs[-1].landings.tolist(),
        "duration": duration,
        "reason": reason if math.isnan(ratio) else "",
    }


def limit_of(answers: Sequence[float]) -> tuple[float, float]:
    """Return the limit of three answers whose setting (time step, flexibility) halves each time, and half its bar.

    The order is the observed one, kept between 1/2 and 2 (Roache 1994, Richardson's extrapolation); the bar is the last
    change, or the extrapolated one if that is larger. Answers that overturn have no limit: inf if all do, else nan.
    """
    if any(not math.isfinite(each) for each in answers):
        return (math.inf if all(math.isinf(each) for each in answers) else math.nan), math.nan
    coarse, middle, fine = answers
    before, last = middle - coarse, fine - middle
    if last == 0:
        return fine, 0.0
    shrinks = min(max(before / last, math.sqrt(2)), 4.0) if before * last > 0 else math.sqrt(2)
    step = last / (shrinks - 1)
    return fine + step, max(abs(last), abs(step))


def landings(times: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Return when the rotation changes sign: (k,) s, on straight lines between the samples (n,)."""
    before, after = rotation[:-1], rotation[1:]
    at = np.flatnonzero(np.sign(before) * np.sign(after) < 0)
    share = before[at] / (before[at] - after[at])
    return times[at] + share * (times[at + 1] - times[at])


def restitution(
    times: np.ndarray, rotation: np.ndarray, energy: np.ndarray, still: float, critical: float
) -> float:
    """Return √(E₂/E₁) of the first two visible excursions at rest angle 0 after `still` [s]; nan: there are not two.

    Between two excursions lies one reversal; what energy it keeps is the square of its restitution (theory: section 1).
    rotation [rad], energy: (n,) each at `times` [s].
    """
    ends = np.flatnonzero(np.sign(rotation[:-1]) * np.sign(rotation[1:]) < 0) + 1
    peaks = [a + int(np.abs(rotation[a:b]).argmax()) for a, b in pairwise(ends)]
    seen = [at for at in peaks if times[at] > still and abs(rotation[at]) > VISIBLE * critical]
    if len(seen) < 2 or abs(rotation[seen[0]]) >= critical:
        return math.nan
    return math.sqrt(energy[seen[1]] / energy[seen[0]])
