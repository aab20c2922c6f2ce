"""A block by OpenSees' RockingBC element (Avgenakis & Psycharis 2020): a case from standard input, its answer as JSON.

The element is deformable; three stiffnesses are run, each twice the one before, and extrapolated to the rigid block.
The strain under its own weight, ρ g H/E, measures the flexibility. Time steps shrink at impacts as its authors do.
"""

import ctypes
import importlib.util
import json
import math
import sys
import time
from pathlib import Path

import numpy as np

from rocking.calibration.comparison.extrapolation import limit_of
from rocking.quantities import GRAVITY

STRAINS = (4e-5, 2e-5, 1e-5)
"""ρ g H/E of the three runs."""
LONGEST, SHORTEST = 5e-4, 1e-7
"""Time steps, s."""
DAMPING = 0.05
"""Of the first mode, stiffness-proportional."""
DENSITY = 2000.0
STILL = 6.0
"""How long still ground is followed, in units of 1/p."""
BUDGET = 20.0
"""Processor seconds of one run."""
_LIBRARIES = ("libquadmath.so.0", "libgfortran.so.4", "libblas.so.3", "liblapack.so.3")


def answer(given: dict) -> dict:
    """Return rotation_ratio, error_bar and duration of a case."""
    start = time.process_time()
    ratios = [_largest(given, strain) for strain in STRAINS]
    spent = time.process_time() - start
    ratio, bar = limit_of(ratios)
    reason = (
        ""
        if not math.isnan(ratio)
        else "The verdict depends on the stiffness, or a run did not end in its time."
    )
    return {"rotation_ratio": ratio, "error_bar": bar, "duration": spent, "reason": reason}


def _largest(given: dict, strain: float) -> float:
    ops = _opensees()
    _build(ops, given["breadth"], given["height"], strain)
    samples = np.array(given["acceleration"])
    ops.timeSeries("Path", 200, "-dt", given["time_step"], "-values", *samples.tolist())
    ops.pattern("UniformExcitation", 300, 1, "-accel", 200)
    ops.wipeAnalysis()
    _solver(ops, ("RelativeNormUnbalance", 1e-8, 50))
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    end = (samples.size - 1) * given["time_step"] + STILL / given["frequency_parameter"]
    return _follow(ops, end) / given["critical_rotation"]


def _follow(ops, end: float) -> float:
    """Largest rotation; inf if it overturns, nan if it fails or takes too long."""
    step, good, largest, start = LONGEST, 0, 0.0, time.process_time()
    while ops.getTime() < end:
        if ops.analyze(1, step) == 0:
            good += 1
            largest = max(largest, abs(ops.nodeDisp(2, 3)))
            if good >= 10:
                step = min(LONGEST, 1.5 * step)
        elif step <= SHORTEST:
            return math.nan
        else:
            step, good = max(SHORTEST, 0.5 * step), 0
        if largest > 1.0:
            return math.inf
        if time.process_time() - start > BUDGET:
            return math.nan
    return largest


def _build(ops, breadth: float, height: float, strain: float) -> None:
    mass = DENSITY * breadth * height
    modulus = DENSITY * GRAVITY * height / strain
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for tag, level in ((1, 0.0), (2, height / 2), (3, height)):
        ops.node(tag, 0.0, level)
    ops.element(
        "RockingBC", 1, 2, 1, 15, modulus, 0.0, -1e3 * DENSITY * GRAVITY * height, breadth, 1.0, 0.0,
        "-convlim", 1e-14, "-useshear", 0, "-blevery", 1, "-useUelNM", 1, "-usecomstiff", 0, "-af", 1.0,
        "-aflim", 0.4, "-convlimmult", 1.0, "-maxtries", 50, "-NlimN", 0.01, "-NlimT", 1.0, "-Dtlim", SHORTEST,
        "-errorifNexceeds", 1,
    )  # fmt: skip
    ops.geomTransf("Corotational", 1)
    ops.element("elasticBeamColumn", 2, 2, 3, breadth, modulus, breadth**3 / 12, 1)
    ops.fix(1, 1, 1, 1)
    ops.mass(2, mass, mass, mass * (breadth**2 + height**2) / 12)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -mass * GRAVITY, 0.0)
    _solver(ops, ("EnergyIncr", 1e-10, 100))
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    ops.analyze(10)
    ops.loadConst("-time", 0.0)
    ops.rayleigh(0, 2 * DAMPING / math.sqrt(ops.eigen("-fullGenLapack", 1)[0]), 0, 0)


def _solver(ops, test: tuple) -> None:
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test(*test)
    ops.algorithm("Newton")


def _opensees():
    """Import OpenSees; its own libraries first, which it does not find by itself."""
    found = importlib.util.find_spec("openseespylinux")
    for name in _LIBRARIES if found and found.origin else ():
        path = Path(str(found.origin)).parent / "lib" / name
        if path.is_file():
            ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
    import openseespy.opensees as ops

    return ops


if __name__ == "__main__":
    print("\n" + json.dumps(answer(json.load(sys.stdin))))
