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


def least(
    tasks: dict[str, Callable[[Path], object]], paths: list[Path], rounds: int = 15
) -> dict[str, float]:
    """Return s per file for each task: the least of `rounds` for each file, the tasks in turn, averaged over files."""
    times = {name: [float("inf")] * len(paths) for name in tasks}
    for _ in range(rounds):
        for i, path in enumerate(paths):
            for name, task in tasks.items():
                start = time.perf_counter()
                task(path)
                times[name][i] = min(times[name][i], time.perf_counter() - start)
    return {name: sum(values) / len(values) for name, values in times.items()}


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        tasks = {"read": read, "numpy.fromstring": bare_fromstring, "numpy.loadtxt": bare_loadtxt}
        taken = least(tasks, written(Path(folder)))
    ours = taken.pop("read")
    print(f"rocking.records.read   {1e3 * ours:7.3f} ms a file of 40 s at 200 Hz, mean over {FILES} files")
    for name, bare in taken.items():
        print(
            f"{name:<22} {1e3 * bare:7.3f} ms; read takes {ours / bare:.2f} times as long (at most 2 wanted)"
        )
    print(
        f"gmprocess, as reported {1e3 * GMPROCESS:7.0f} ms; read is {GMPROCESS / ours:.0f} times faster (5 wanted)"
    )


if __name__ == "__main__":
    main()
