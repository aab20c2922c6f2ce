"""The codes: scipy's integrators, RockingBC of OpenSees, LMGC90, and this package, each driven through one case.

OpenSees and LMGC90 keep one model per process and print as they go; each case runs in a process of its own.
"""

import json
import math
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from docs.research.comparison.cases import CodeCase
from docs.research.comparison.runs import Answer
from docs.research.reference import event_landings
from rocking.errors import MotionError
from rocking.motion import integrate
from rocking.motion.response import Response

SLOWEST = 1e-3
"""Speed of arrival, in p φ_cr, of the weakest impact that is counted."""
TIMEOUT = 900.0
"""Seconds that a process of another code may take."""
LMGC90, ROCKING_BC = "LMGC90 (compas_lmgc90), NSCD", "OpenSees RockingBC"
ANOTHER_MODEL = frozenset({("arch", LMGC90)})
"""What solves a motion other than the reference's: hinges open where they like, and its shocks are its own."""
_DRIVERS = {
    LMGC90: "docs.research.comparison.lmgc90",
    ROCKING_BC: "docs.research.comparison.opensees",
}
Code = Callable[[CodeCase], Answer]


def inner_codes() -> Mapping[str, Code]:
    """Return this package and scipy, which take every case."""
    ours = {f"rocking, tolerance {tolerance:.0e}": _ours(tolerance) for tolerance in (1e-3, 1e-6, 1e-9)}
    return ours | {f"scipy {method}, 1e-6": _scipy(method) for method in ("RK45", "DOP853")}


def outer_codes() -> Mapping[str, Code]:
    """Return the other codes, each in a process of its own."""
    return {name: _outer(module) for name, module in _DRIVERS.items()}


def landings_of(response: Response) -> np.ndarray:
    """Return the times (k,) s of the impacts of a response with history: two lines at rest angle at one instant."""
    if response.times is None or response.rotation is None:
        return np.empty(0)
    same = (np.diff(response.times) == 0) & (response.rotation[:-1] == 0) & (response.rotation[1:] == 0)
    return response.times[:-1][same]


def _ours(tolerance: float) -> Code:
    def run(case: CodeCase) -> Answer:
        integrate(case.mechanism, case.motion, tolerance)  # the table of the mechanism, and the compiled code
        start = time.process_time()
        ratio = integrate(case.mechanism, case.motion, tolerance).rotation_ratio
        spent = time.process_time() - start
        history = integrate(case.mechanism, case.motion, tolerance, history=True)
        return Answer(ratio, spent, landings=landings_of(history))

    return run


def _scipy(method) -> Code:
    def run(case: CodeCase) -> Answer:
        start = time.process_time()
        try:
            ratio, landings = event_landings(case.mechanism, case.motion, method, 1e-6, TIMEOUT)
        except MotionError as error:
            return Answer(math.nan, time.process_time() - start, reason=str(error))
        return Answer(ratio, time.process_time() - start, landings=landings[:, 0])

    return run


def _outer(module: str) -> Code:
    def run(case: CodeCase) -> Answer:
        given = {
            "structure": case.structure,
            "critical_rotation": case.mechanism.critical_rotation,
            "frequency_parameter": case.mechanism.positive.frequency_parameter,
            "acceleration": case.motion.acceleration.tolist(),
            "time_step": case.motion.time_step,
        }
        found, reason = ask(module, given)
        if found is None:
            return Answer(math.nan, math.nan, reason=reason)
        landings = None if found["landings"] is None else np.array(found["landings"])
        return Answer(**found | {"landings": landings})

    return run


def ask(module: str, given: Mapping[str, object], timeout: float = TIMEOUT) -> tuple[Any, str]:
    """Return what a driver answers to a case, in a process of its own; or None, and why there is no answer."""
    try:
        done = subprocess.run(
            [sys.executable, "-m", module], cwd=Path(__file__).parents[3],
            input=json.dumps(given), capture_output=True, text=True, timeout=timeout, check=False,
        )  # fmt: skip
        return json.loads(done.stdout.strip().splitlines()[-1]), ""
    except subprocess.TimeoutExpired:
        return None, f"It took more than {timeout:.0f} s."
    except (IndexError, ValueError):
        return None, (done.stderr.strip().splitlines() or ["It said nothing."])[-1]
