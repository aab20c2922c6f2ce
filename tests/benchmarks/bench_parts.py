"""CPU of each part of the work on one record, and the memory that many reports leave: bench_parts.py [REPORTS].

Run it as a script. Each time is the least of several turns in one run; nothing is asserted.
"""

import dataclasses
import resource
import sys
import tempfile
from pathlib import Path

import numpy as np
from clock import least_cpu, shaking

sys.path.append(str(Path(__file__).parents[1] / "unit" / "reports"))

from conftest import assessed, shaken

from rocking import Arch, Block, Pulse, Wall
from rocking.pulses import extract_pulses
from rocking.records import read
from rocking.records.synthetic import SyntheticRecord, at2_text
from rocking.sine_pulse import predict_maxima, pulse_spectrum

RATIOS = np.linspace(0.2, 12, 200)


def parts(folder: Path) -> dict[str, object]:
    """Each part by what it does."""
    path = folder / "bench.AT2"
    path.write_text(at2_text(SyntheticRecord("bench", 1, 4.0, 1.0, 8.0, 2.0, 40.0, 0.005)))
    record = shaking(40, 3.0)
    blocks = [Block(height, 0.2).mechanism().equivalent_block() for height in np.linspace(1, 5, 100)]
    draw = np.random.default_rng(1)
    pulses = [Pulse(float(a), float(w)) for a, w in draw.uniform((0.5, 1), (12, 30), (10_000, 2))]
    return {
        "read a file of 40 s at 200 Hz": lambda: read(path),
        "numpy.loadtxt of the same file": lambda: np.loadtxt(path, skiprows=4),
        "dominant pulses of 40 s at 200 Hz": lambda: extract_pulses(record),
        "mechanism of an arch of seven voussoirs": lambda: Arch(10.0, 1.5, 2.75, 7).mechanism(),
        "a million predictions under one sine pulse": lambda: predict_maxima(blocks, pulses),
        "spectrum of one sine pulse, 200 x 200 cells": lambda: pulse_spectrum(RATIOS, RATIOS, 0.9),
    }


def report_of_ten_structures():
    """Return what sets another report at each call: the typesetter remembers what it has set before."""
    structures = {f"block {height} m": Block.of_size(0.22 * height, height) for height in (2, 3, 5, 8)}
    structures |= {f"wall {h} m": Wall(0.5 * h, 0.45 * h, 0.1 * h) for h in (2.5, 3.5, 5)}
    structures |= {f"arch {r} m": Arch(r, 0.15 * r, np.radians(157.5)) for r in (5, 10, 15)}
    case = assessed("ten", [shaken(station="STA")], structures)
    places = iter(range(10_000))

    def another() -> bytes:
        moved = [each.scaled(1 + 1e-3 * next(places)) for each in case.accelerograms]
        return dataclasses.replace(case, accelerograms=moved).pdf()

    return another


def main(reports: int) -> None:
    """Print the table, and the growth of memory over so many reports."""
    with tempfile.TemporaryDirectory() as folder:
        calls = parts(Path(folder))
        report = report_of_ten_structures()
        calls["report of a record with ten structures"] = report
        for name, seconds in zip(calls, least_cpu(*calls.values(), repeats=5), strict=True):
            print(f"{1e3 * seconds:10.3f} ms  {name}")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(reports):
        report()
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"memory after {reports} more reports: {after / before:.3f} times as much")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
