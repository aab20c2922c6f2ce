"""Reading: 100 AT2 files of 40 s against numpy's bare parsing of the same numbers.

    python tests/benchmarks/bench_reading.py

gmprocess reports 5 s per component for reading and checking. Ratios are taken inside one run; the machine's load
moves the milliseconds, not the ratios.
"""

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from rocking.records import read
from rocking.records.synthetic import SyntheticRecord, at2_text

FILES = 100
GMPROCESS = 5.0
"""s per component, as its authors report."""


def written(folder: Path) -> list[Path]:
    """Write the files, 40 s at 200 Hz, and return their paths."""
    paths = []
    for seed in range(FILES):
        recipe = SyntheticRecord(f"bench_{seed}", seed + 1, 4.0, 1.0, 8.0, 2.0, 40.0, 0.005)
        paths.append(folder / f"{recipe.name}.AT2")
        paths[-1].write_text(at2_text(recipe))
    return paths


def bare_fromstring(path: Path) -> np.ndarray:
    """Parse the numbers and nothing else, with numpy's fastest text parser."""
    return np.fromstring(path.read_bytes().split(b"\n", 4)[4], sep=" ")


def bare_loadtxt(path: Path) -> np.ndarray:
    """Parse the numbers and nothing else, with numpy's usual text parser."""
    return np.loadtxt(path, skiprows=4)


def best(task: Callable[[Path], object], paths: list[Path], rounds: int = 5) -> float:
    """Return the least time of `rounds` over all files, s per file."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        for path in paths:
            task(path)
        times.append((time.perf_counter() - start) / len(paths))
    return min(times)


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        paths = written(Path(folder))
        ours = best(read, paths)
        print(
            f"rocking.records.read   {1e3 * ours:7.3f} ms a file of 40 s at 200 Hz, mean over {FILES}, best of 5"
        )
        for name, task in (("numpy.fromstring", bare_fromstring), ("numpy.loadtxt", bare_loadtxt)):
            bare = best(task, paths)
            print(
                f"{name:<22} {1e3 * bare:7.3f} ms; read takes {ours / bare:.2f} times as long (at most 2 wanted)"
            )
        print(
            f"gmprocess, as reported {1e3 * GMPROCESS:7.0f} ms; read is {GMPROCESS / ours:.0f} times faster (5 wanted)"
        )


if __name__ == "__main__":
    main()
