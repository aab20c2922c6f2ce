"""Reading 100 AT2 files of 40 s beside numpy's bare parsing of the same numbers, as ratios of CPU time in one run."""

import tempfile
from pathlib import Path

import numpy as np
from clock import least_cpu

from rocking.records import read
from rocking.records.synthetic import SyntheticRecord, at2_text

FILES = 100


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"bench_{seed}.AT2" for seed in range(1, FILES + 1)]
        for seed, path in enumerate(paths, start=1):
            path.write_text(at2_text(SyntheticRecord(path.stem, seed, 4.0, 1.0, 8.0, 2.0, 40.0, 0.005)))
        ours, fromstring, loadtxt = least_cpu(
            lambda: [read(path) for path in paths],
            lambda: [np.fromstring(path.read_bytes().split(b"\n", 4)[4], sep=" ") for path in paths],
            lambda: [np.loadtxt(path, skiprows=4) for path in paths],
            repeats=5,
        )
    print(f"rocking.read      {1e3 * ours / FILES:7.3f} ms a file of 40 s at 200 Hz")
    for name, bare in (("numpy.fromstring", fromstring), ("numpy.loadtxt", loadtxt)):
        print(f"{name:17} {1e3 * bare / FILES:7.3f} ms; read takes {ours / bare:.2f} times as long")


if __name__ == "__main__":
    main()
