"""What another code says of a case: runs at three settings, each half the one before, read, extrapolated and told."""

import json
import math
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

VISIBLE = 0.02
"""Largest excursions, over the critical rotation, from which a restitution is read."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a code says: φ_max/φ_cr (inf: it overturns, nan: nothing), half its error bar, processor time [s].

    landings: (k,) s; None: untold. reason: why there is no number. restitution: what a reversal on still ground kept of
    the speed, and half its error bar. outside_hinges: share of joint rotation outside the hinges of the mechanism at
    the largest rotation. These nan where nothing is measured.
    """

    rotation_ratio: float
    duration: float = math.nan
    rotation_ratio_error: float = math.nan
    landings: np.ndarray | None = None
    reason: str = ""
    restitution: float = math.nan
    restitution_error: float = math.nan
    outside_hinges: float = math.nan


def serve(runs: Callable[[dict], Sequence[Answer]], reason: str) -> None:
    """Answer the case on standard input in JSON, on the last line of standard output; reason: why it has no limit."""
    given, start = json.load(sys.stdin), time.process_time()
    found = limit_of_runs(runs(given), reason)
    found = replace(found, duration=time.process_time() - start)
    print("\n" + json.dumps(vars(found), default=lambda array: array.tolist()))


def run_of(
    given: dict,
    times: np.ndarray,
    rotation: np.ndarray,
    energy: np.ndarray,
    outside_hinges: float = math.nan,
) -> Answer:
    """Return what a history (n,) that stays up says of the case `given`; energy (n,) as for `restitution`."""
    critical, still = given["critical_rotation"], still_from(given)
    return Answer(
        float(np.abs(rotation).max()) / critical,
        landings=landings(times, rotation),
        restitution=restitution(times, rotation, energy, still, critical),
        outside_hinges=outside_hinges,
    )


def still_from(given: dict) -> float:
    """Return when the ground of a case comes to rest, s."""
    return (len(given["acceleration"]) - 1) * given["time_step"]


def limit_of_runs(runs: Sequence[Answer], reason: str) -> Answer:
    """Return the limit of three runs; reason: why the largest rotation has none, if so.

    Where the limit of a small rotation would be negative, the last run stands, with the bar of the extrapolation.
    """
    ratio, bar = limit_of([run.rotation_ratio for run in runs])
    ratio = runs[-1].rotation_ratio if ratio < 0 else ratio
    kept, kept_bar = limit_of([run.restitution for run in runs])
    told = {"reason": reason, "landings": None} if math.isnan(ratio) else {}
    limits = {
        "rotation_ratio": ratio,
        "rotation_ratio_error": bar,
        "restitution": kept,
        "restitution_error": kept_bar,
    }
    return replace(runs[-1], **limits, **told)


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
