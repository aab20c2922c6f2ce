"""Cost of making a structure and of its functions, and the onset beside a linear programme, in one run.

Run it as a script. Prints milliseconds, errors and ratios; nothing is asserted.
"""

import sys
import timeit
from pathlib import Path

import numpy as np
from scipy.optimize import linprog

from rocking.structures.arch import Arch
from rocking.structures.arch_onset import static_onset
from rocking.structures.arch_ring import EXTRADOS, INTRADOS, Ring
from rocking.structures.block import Block
from rocking.structures.equivalence import measure_equivalence
from rocking.structures.wall import Wall

sys.path.append(str(Path(__file__).parents[1] / "oracles"))
from kinematic_onset import kinematic_onset

EMBRACE = np.radians(157.5)
NAMES = ("inertia", "inertia_slope", "gravity", "gravity_slope", "ground")


def milliseconds(call, number=20) -> float:
    """Best of three means."""
    return 1e3 * min(timeit.repeat(call, number=number, repeat=3)) / number


def programme(joints: int) -> float:
    """λ of the same ring by scipy's linear programme over the thrust line at `joints` sections."""
    ring = Ring(0.15, EMBRACE, joints - 1)
    rows = ring.gaps(np.tile(ring.sections(), 2), np.repeat([INTRADOS, EXTRADOS], joints))
    return linprog([0, 0, 0, -1], A_ub=-rows[:, :4], b_ub=rows[:, 4], bounds=[(None, None)] * 4).x[3]


def main() -> None:
    """Print the tables."""
    print("structure   make [ms]   five functions at 1000 rotations [ms]   equivalence, 3 + 3 points [ms]")
    makers = {
        "block": lambda: Block(2.0, 0.2),
        "wall": lambda: Wall(1.5, 2.5, 0.4),
        "arch": lambda: Arch(10.0, 1.5, EMBRACE),
        "voussoirs": lambda: Arch(10.0, 1.5, EMBRACE, 7),
    }
    for name, make in makers.items():
        side = make().mechanism().positive
        rotation = np.linspace(0, side.end_rotation, 1000)
        made = milliseconds(lambda make=make: make().mechanism())
        functions = milliseconds(lambda s=side, r=rotation: [getattr(s, f)(r) for f in NAMES])
        measured = milliseconds(lambda s=side: measure_equivalence(s, [0.2, 0.5, 0.9], [1.1, 2, 9]), 2)
        print(f"{name:10} {made:10.3f} {functions:28.3f} {measured:32.1f}")
    ring = Ring(0.15, EMBRACE)
    exact = static_onset(ring).multiplier
    base = milliseconds(lambda: static_onset(ring))
    print("\nonset of the continuous arch       [ms]   ratio   λ error")
    for name, call, found in (
        ("exchange and tangency", lambda: static_onset(ring), exact),
        ("minimum over mechanisms", lambda: kinematic_onset(ring), kinematic_onset(ring).multiplier),
        ("linear programme, 200 sections", lambda: programme(200), programme(200)),
        ("linear programme, 2000 sections", lambda: programme(2000), programme(2000)),
    ):
        cost = milliseconds(call, 3)
        print(f"{name:32} {cost:8.2f} {cost / base:7.1f} {found - exact:10.1e}")


if __name__ == "__main__":
    main()
