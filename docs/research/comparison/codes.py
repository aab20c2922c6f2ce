"""The cases of the comparison, and the codes: scipy, RockingBC of OpenSees, LMGC90 and this package.

A block, a frame and an arch of seven voussoirs meet pulses and records. OpenSees and LMGC90 keep one model per process
and print as they go; each case runs in a process of its own, which runs it at three settings, each half the one before,
and extrapolates.
"""

import json
import math
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any, NotRequired, TypedDict

import numpy as np

from docs.research import reference
from docs.research.sites import timed
from rocking import Accelerogram, Arch, Block, Frame, Mechanism, Pulse, Response, integrate
from rocking.quantities import GRAVITY

SEED = 20
"""Of the drawn pulses and scales."""
PULSES = 201
"""Cases under a pulse."""
RECORDS = 42
"""Cases under a record."""
SAMPLES = 200
"""Of the strongest stretch of a record that every code is given."""
PER_PERIOD = 48
"""Samples of a pulse; between them every code sees straight lines, so that all are given the same motion."""
SLOWEST = 1e-3
"""Speed of arrival, in p φ_cr, of the weakest impact that is counted."""
VISIBLE = 0.02
"""Largest excursions, over the critical rotation, from which a restitution is read."""
STILL = 6.0
"""How long the other codes follow still ground at most, in units of 1/p."""
TIMEOUT = 900.0
"""Seconds that a process of another code may take."""
TOLERANCES = (1e-3, 1e-6, 1e-9)
"""Of this package."""
LMGC90, ROCKING_BC = "LMGC90 (compas_lmgc90), NSCD", "OpenSees RockingBC"
ANOTHER_MODEL = frozenset({("arch", LMGC90)})
"""What solves a motion other than the reference's: hinges open where they like, and its shocks are its own."""


def structures() -> dict[str, Block | Frame | Arch]:
    """Return the structures by name: m, rad."""
    return {
        "block": Block.of_size(breadth=0.6, height=3.0),
        "frame": Frame(Block.of_size(breadth=0.5, height=4.0), 2, 1.0),
        "arch": Arch(radius=5.0, thickness=0.75, embrace_angle=math.radians(157.5), voussoirs=7),
    }


@dataclass(frozen=True)
class CodeCase:
    """One structure and one motion; kind: pulse or record."""

    name: str
    structure: str
    kind: str
    mechanism: Mechanism
    motion: Accelerogram


def pulse_cases(count: int = PULSES) -> Iterator[CodeCase]:
    """Yield sine pulses of 1.1 to 4 times the acceleration of uplift and 2 to 12 times p, evenly in the logarithm."""
    draw = np.random.default_rng(SEED)
    mechanisms = [(name, structure.mechanism()) for name, structure in structures().items()]
    for k in range(count):
        name, mechanism = mechanisms[k % len(mechanisms)]
        amplitude = mechanism.uplift_multiplier * GRAVITY * _log_uniform(draw, 1.1, 4)
        pulse = Pulse(
            amplitude=amplitude,
            circular_frequency=mechanism.positive.frequency_parameter * _log_uniform(draw, 2, 12),
        )
        step = pulse.period / PER_PERIOD
        samples = pulse.acceleration(np.arange(PER_PERIOD) * step)
        motion = Accelerogram(np.concatenate([samples, np.zeros(3)]), step)
        yield CodeCase(f"{name} pulse {k}", name, "pulse", mechanism, motion)


def record_cases(records: Sequence[Accelerogram], count: int = RECORDS) -> Iterator[CodeCase]:
    """Yield the strongest stretches of `records`, each scaled to 1.3 to 4 times the acceleration of uplift."""
    draw = np.random.default_rng(SEED + 1)
    mechanisms = [(name, structure.mechanism()) for name, structure in structures().items()]
    for k in range(count if records else 0):
        name, mechanism = mechanisms[k % len(mechanisms)]
        record = records[(k // len(mechanisms)) % len(records)]
        energy = np.concatenate([[0.0], np.cumsum(record.acceleration**2)])
        start = int(np.argmax(energy[SAMPLES:] - energy[:-SAMPLES]))
        samples = record.acceleration[start : start + SAMPLES]
        stretch = record.processed_by(samples, f"cut to the {SAMPLES} samples from sample {start}")
        factor = (
            _log_uniform(draw, 1.3, 4) * mechanism.uplift_multiplier * GRAVITY / stretch.peak_acceleration
        )
        yield CodeCase(f"{name} record {k}", name, "record", mechanism, stretch.scaled(factor))


def _log_uniform(draw: np.random.Generator, low: float, high: float) -> float:
    return math.exp(draw.uniform(math.log(low), math.log(high)))


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


Code = Callable[[CodeCase], Answer]


class Question(TypedDict):
    """What a code in a process of its own is asked: the motion, and the scales of rotation [rad] and time [rad/s].

    acceleration: of the ground, m/s², at every time_step [s]. settled: the turn [rad] below which, for a second on
    still ground, nothing more is expected; left out, a motion is followed to its end.
    """

    acceleration: list[float]
    time_step: float
    critical_rotation: float
    frequency_parameter: float
    settled: NotRequired[float]


class StructureQuestion(Question):
    """A question on one of `structures`, by its name."""

    structure: str


def inner_codes() -> Mapping[str, Code]:
    """Return this package and scipy, which take every case."""
    ours = {f"rocking, tolerance {tolerance:.0e}": partial(_ours, tolerance) for tolerance in TOLERANCES}
    return ours | {f"scipy {method}, 1e-6": partial(_scipy, method) for method in ("RK45", "DOP853")}


def outer_codes() -> Mapping[str, Code]:
    """Return the other codes, each in a process of its own."""
    modules = {LMGC90: "lmgc90", ROCKING_BC: "opensees"}
    return {name: partial(_outer, f"docs.research.comparison.{module}") for name, module in modules.items()}


def landings_of(response: Response) -> np.ndarray:
    """Return the times (k,) s of the impacts of a response with history: two lines at rest angle at one instant."""
    if response.times is None or response.rotation is None:
        return np.empty(0)
    same = (np.diff(response.times) == 0) & (response.rotation[:-1] == 0) & (response.rotation[1:] == 0)
    times: np.ndarray = response.times[:-1][same]
    return times


def _ours(tolerance: float, case: CodeCase) -> Answer:
    run = partial(integrate, case.mechanism, case.motion, tolerance)
    run()  # the table of the mechanism, and the compiled code
    response, spent = timed(run)
    return Answer(response.rotation_ratio, spent, landings=landings_of(run(history=True)))


def _scipy(method: str, case: CodeCase) -> Answer:
    run = partial(reference.landings, case.mechanism, case.motion, method, 1e-6, restart=False)
    (ratio, arrivals), spent = timed(run)
    return Answer(ratio, spent, landings=arrivals[:, 0])


def _outer(module: str, case: CodeCase) -> Answer:
    question: StructureQuestion = {
        "structure": case.structure,
        "critical_rotation": case.mechanism.critical_rotation,
        "frequency_parameter": case.mechanism.positive.frequency_parameter,
        "acceleration": case.motion.acceleration.tolist(),
        "time_step": case.motion.time_step,
    }
    answer, reason = ask(module, question)
    if answer is None:
        return Answer(math.nan, reason=reason)
    landings = answer.pop("landings")
    return Answer(**answer, landings=None if landings is None else np.array(landings))


def ask(module: str, question: Question, timeout: float = TIMEOUT) -> tuple[Any, str]:
    """Return what a driver answers to a case, in a process of its own; or None, and why there is no answer."""
    try:
        done = subprocess.run(
            [sys.executable, "-m", module], cwd=Path(__file__).parents[3],
            input=json.dumps(question), capture_output=True, text=True, timeout=timeout, check=False,
        )  # fmt: skip
        return json.loads(done.stdout.strip().splitlines()[-1]), ""
    except subprocess.TimeoutExpired:
        return None, f"It took more than {timeout:.0f} s."
    except (IndexError, ValueError):
        return None, (done.stderr.strip().splitlines() or ["It said nothing."])[-1]


def serve(run: Callable[[StructureQuestion, float], Answer], settings: Sequence[float], reason: str) -> None:
    """Answer the case on standard input in JSON, on the last line of standard output, with the limit of three runs.

    reason: why the largest rotation has none, if so. Where the limit of a small rotation would be negative, the last
    run stands, with the bar of the extrapolation.
    """
    case: StructureQuestion = json.load(sys.stdin)
    start = time.process_time()
    runs = [run(case, setting) for setting in settings]
    ratio, bar = limit_of([run.rotation_ratio for run in runs])
    eta, eta_bar = limit_of([run.restitution for run in runs])
    answer = replace(runs[-1], rotation_ratio_error=bar, restitution=eta, restitution_error=eta_bar)
    if math.isnan(ratio):
        answer = replace(answer, rotation_ratio=ratio, reason=reason, landings=None)
    elif ratio >= 0:
        answer = replace(answer, rotation_ratio=ratio)
    answer = replace(answer, duration=time.process_time() - start)
    print("\n" + json.dumps(vars(answer), default=lambda array: array.tolist()))


def run_of(
    case: Question,
    times: np.ndarray,
    rotation: np.ndarray,
    energy: np.ndarray,
    outside_hinges: float = math.nan,
) -> Answer:
    """Return what a history (n,) that stays up says of the case `case`; energy (n,) as for `restitution`."""
    critical, still = case["critical_rotation"], still_from(case)
    return Answer(
        float(np.abs(rotation).max()) / critical,
        landings=landings(times, rotation),
        restitution=restitution(times, rotation, energy, still, critical),
        outside_hinges=outside_hinges,
    )


def still_from(case: Question) -> float:
    """Return when the ground of a case comes to rest, s."""
    return (len(case["acceleration"]) - 1) * case["time_step"]


def limit_of(answers: Sequence[float]) -> tuple[float, float]:
    """Return the limit of three answers whose setting (time step, flexibility) halves each time, and half its bar.

    The order is the observed one, kept between 1/2 and 2 (Roache 1994, Richardson's extrapolation); the bar is the last
    change, or the extrapolated one if that is larger. Answers that overturn have no limit: inf if all do, else nan.
    """
    if any(not math.isfinite(answer) for answer in answers):
        return (math.inf if all(math.isinf(answer) for answer in answers) else math.nan), math.nan
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
    crossed: np.ndarray = times[at] + share * (times[at + 1] - times[at])
    return crossed


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
