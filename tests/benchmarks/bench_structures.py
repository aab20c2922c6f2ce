"""Cost of making a structure, of its functions and of its equivalent blocks.

Run it as a script. Prints milliseconds; nothing is asserted.
"""

import timeit

import numpy as np

from rocking.structures.arch import Arch
from rocking.structures.block import Block
from rocking.structures.wall import Wall

EMBRACE = np.radians(157.5)
NAMES = ("inertia", "inertia_slope", "gravity", "gravity_slope", "ground")


def milliseconds(call, number=20) -> float:
    """Best of three means."""
    return 1e3 * min(timeit.repeat(call, number=number, repeat=3)) / number


def main() -> None:
    """Print the tables."""
    print("structure   make [ms]   five functions at 1000 rotations [ms]")
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
        print(f"{name:10} {made:10.3f} {functions:28.3f}")


if __name__ == "__main__":
    main()
