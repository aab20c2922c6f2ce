"""CPU of a record's report of ten structures, and the memory that many of them leave: bench_reports.py [REPORTS]."""

import resource
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from clock import least_cpu

sys.path.append(str(Path(__file__).parents[1] / "unit" / "reports"))

from conftest import assessed, shaken

from rocking.reports.record import RecordReport
from rocking.structures import Arch, Block, Wall


def ten_structures() -> RecordReport:
    """Blocks, walls and arches under one component."""
    structures = {f"block {height} m": Block.of_size(0.22 * height, height) for height in (2, 3, 5, 8)}
    structures |= {
        f"wall {height} m": Wall(0.5 * height, 0.45 * height, 0.1 * height) for height in (2.5, 3.5, 5)
    }
    structures |= {
        f"arch {radius} m": Arch(radius, 0.15 * radius, np.radians(157.5)) for radius in (5, 10, 15)
    }
    return assessed("ten", [shaken(station="STA")], structures)


def another(case: RecordReport, place: int) -> bytes:
    """A report of another name and motion: the typesetter remembers what it has set before."""
    moved = [accelerogram.scaled(1 + 1e-3 * place) for accelerogram in case.accelerograms]
    return replace(case, record=f"report {place}", accelerograms=moved).pdf()


def resident() -> float:
    """Largest resident memory so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main(reports: int) -> None:
    """Print CPU time and growth of memory."""
    case, places = ten_structures(), iter(range(10_000))
    (whole,) = least_cpu(lambda: another(case, next(places)), repeats=7)
    before = resident()
    for _ in range(reports):
        another(case, next(places))
    print(f"record report, 10 structures: {whole:.3f} s CPU")
    print(f"memory after {reports} more: {resident() / before:.3f} of {before:.0f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
