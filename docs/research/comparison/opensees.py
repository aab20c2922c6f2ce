"""A block by OpenSees' RockingBC element (Avgenakis & Psycharis 2020), from standard input to JSON.

The element is deformable; three stiffnesses are run, each twice the one before, and extrapolated to the rigid body.
The strain under all that a column carries, σ/E, measures the flexibility. Time steps shrink at impacts, as those of
its authors do.
"""

import ctypes
import importlib.util
import math
import time
from pathlib import Path
from types import ModuleType

import numpy as np
from scipy.integrate import cumulative_trapezoid

from docs.research.comparison.codes import (
    STILL,
    Answer,
    StructureQuestion,
    landings,
    run_of,
    serve,
    still_from,
    structures,
)
from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures import Block

STRAINS = (4e-5, 2e-5, 1e-5)
"""σ/E of the three runs."""
LONGEST = 5e-4
"""Time step at most, s."""
SHORTEST = 1e-7
DAMPING = 0.05
"""Of the first mode, stiffness-proportional."""
DENSITY = 2000.0
REVERSALS = 3
"""Reversals on still ground after which nothing new comes."""
BUDGET = 90.0
"""Processor seconds of one run."""
_WATCHED = 12
"""Node in the middle of the block, whose rotation is read."""
_LIBRARIES = ("libquadmath.so.0", "libgfortran.so.4", "libblas.so.3", "liblapack.so.3")


def run(case: StructureQuestion, strain: float) -> Answer:
    """Return the run of a case at a flexibility."""
    ops = _opensees()
    structure = structures()[case["structure"]]
    if not isinstance(structure, Block):
        raise StructureError(
            f"structure is {case['structure']!r}, but RockingBC follows a block only; ask for that."
        )
    _build(ops, structure, strain)
    ops.timeSeries("Path", 200, "-dt", case["time_step"], "-values", *case["acceleration"])
    ops.pattern("UniformExcitation", 300, 1, "-accel", 200)
    ops.wipeAnalysis()
    _solver(ops, ("RelativeNormUnbalance", 1e-8, 50))
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    still = still_from(case)
    followed = _follow(ops, still, still + STILL / case["frequency_parameter"])
    if followed is None:
        return Answer(math.nan)
    times, rotation = followed
    if abs(rotation[-1]) > 1.0:
        return Answer(math.inf, landings=landings(times, rotation))
    # All energy of the rigid body where it turns back is ∫ G dφ.
    side = structure.mechanism().positive
    grid = np.linspace(0.0, side.end_rotation * 0.999, 2001)
    potential = cumulative_trapezoid(side.gravity(grid), grid, initial=0.0)
    return run_of(case, times, rotation, np.interp(np.abs(rotation), grid, potential))


def _follow(ops: ModuleType, still: float, end: float) -> np.ndarray | None:
    """Times and rotations (2, n), until it overturned, reversed often enough, or all the time; None: to no end."""
    step, good, reversals, start = LONGEST, 0, 0, time.process_time()
    history = [(0.0, 0.0)]
    while ops.getTime() < end and abs(history[-1][1]) <= 1.0 and reversals < REVERSALS:
        if ops.analyze(1, step) == 0:
            good += 1
            history.append((ops.getTime(), ops.nodeDisp(_WATCHED, 3)))
            reversals += history[-1][0] > still and history[-1][1] * history[-2][1] < 0
            if good >= 10:
                step = min(LONGEST, 1.5 * step)
        elif step > SHORTEST:
            step, good = max(SHORTEST, 0.5 * step), 0
        else:
            return None
        if time.process_time() - start > BUDGET:
            return None
    return np.array(history).T


def _build(ops: ModuleType, block: Block, strain: float) -> None:
    """A column that rocks at its foot (node 11); all mass is in its middle (12), above which nothing rocks."""
    breadth, height = block.breadth, block.height
    modulus, mass = DENSITY * GRAVITY * height / strain, DENSITY * breadth * height
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.node(11, 0.0, 0.0)
    ops.node(_WATCHED, 0.0, height / 2)
    ops.element(
        "RockingBC", 11, _WATCHED, 11, 15, modulus, 0.0, -4e3 * DENSITY * GRAVITY * height, breadth, 1.0, 0.0,
        "-convlim", 1e-14, "-useshear", 0, "-blevery", 1, "-useUelNM", 1, "-usecomstiff", 0, "-af", 1.0,
        "-aflim", 0.4, "-convlimmult", 1.0, "-maxtries", 50, "-NlimN", 0.01, "-NlimT", 1.0, "-Dtlim", SHORTEST,
        "-errorifNexceeds", 1,
    )  # fmt: skip
    ops.fix(11, 1, 1, 1)
    ops.mass(_WATCHED, mass, mass, mass * (breadth**2 + height**2) / 12)
    ops.load(_WATCHED, 0.0, -mass * GRAVITY, 0.0)
    ops.node(13, 0.0, height)
    ops.geomTransf("Corotational", 1)
    ops.element("elasticBeamColumn", 12, _WATCHED, 13, breadth, modulus, breadth**3 / 12, 1)
    _solver(ops, ("EnergyIncr", 1e-10, 100))
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    ops.analyze(10)
    ops.loadConst("-time", 0.0)
    ops.rayleigh(0, 2 * DAMPING / math.sqrt(ops.eigen("-fullGenLapack", 1)[0]), 0, 0)


def _solver(ops: ModuleType, test: tuple[str, float, int]) -> None:
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test(*test)
    ops.algorithm("Newton")


def _opensees() -> ModuleType:
    """Import OpenSees; its own libraries first, which it does not find by itself."""
    package = importlib.util.find_spec("openseespylinux")
    if package is not None:
        folder = Path(str(package.origin)).parent / "lib"
        for path in (folder / name for name in _LIBRARIES):
            if path.is_file():
                ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
    return importlib.import_module("openseespy.opensees")


if __name__ == "__main__":
    serve(run, STRAINS, "The verdict depends on the stiffness, or a run did not end in its time.")
