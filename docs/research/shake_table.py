"""The shake-table campaign: measured table motions of each test, and how it ended.

384 tests of two granite specimens (repository ZhiangChen/virtual_shake_robot_pybullet, GPL-3.0). Nothing of them is
part of this package: a folder in the form of `Campaign.open` is read as it stands, and table motions that are not in
it are fetched from the source and checked against the catalogue.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd

from rocking.catalogue.files import download
from rocking.errors import RecordError
from rocking.hashes import sha256_of_bytes
from rocking.quantities import GRAVITY
from rocking.signal.accelerogram import Accelerogram, Source
from rocking.tables import Row, column, read_rows, row

REPOSITORY = "ZhiangChen/virtual_shake_robot_pybullet"
COMMIT = "9f239e7e21280702be9ba7a40ed9b47a35868a52"
TESTS, MOTIONS = "tests.csv", "accelerations.npz"
SPECIMENS = (1, 2)
CELLS = {
    int: ("a whole number", r"\d+"),
    float: ("a number", r"\d*\.?\d+(e-?\d+)?"),
    str: ("a name", ".+"),
    bool: ("0 or 1", "[01]"),
}
"""What a cell of tests.csv may be, in words and as a pattern."""


@row("shake_table", "One row per test: where its table motion is, and what must be true of it")
class TableMotion(Row):
    """A row of the catalogue of table motions."""

    test: int = column("Number of the test")
    source_path: str = column("Path in the repository of the source")
    samples: int = column("Number of samples")
    samples_sha256: str = column("SHA-256 of the acceleration as little-endian float32, g")

    def holds(self, samples: np.ndarray) -> bool:
        """Whether `samples` (n,) are those of the catalogue."""
        content = np.ascontiguousarray(samples, dtype="<f4").tobytes()
        return sha256_of_bytes(content) == self.samples_sha256


@dataclass(frozen=True, eq=False)
class Campaign:
    """The tests in the order of their numbers (`read_tests`), and where their files are."""

    tests: pd.DataFrame
    folder: Path
    catalogue: Mapping[int, TableMotion]

    @classmethod
    def open(cls, catalogue: Path, mirror: Path | None) -> "Campaign":
        """Open the campaign in `mirror`, or in `shake_table` inside it or beside it.

        The folder holds tests.csv and accelerations.npz (float32, g, one array a test, key "011"), which is fetched
        where it is missing. Raises RecordError when there is no such folder or tests.csv has a defect.
        """
        tried = [] if mirror is None else [mirror, mirror / "shake_table", mirror.parent / "shake_table"]
        folder = next((folder for folder in tried if (folder / TESTS).is_file()), None)
        if folder is None:
            places = ", ".join(map(str, tried)) or "the setting mirror, which is null"
            raise RecordError(
                f"no {TESTS} of the shake-table campaign in {places}; name its folder, or one beside it, as mirror.",
                mirror=mirror,
            )
        listed = {motion.test: motion for motion in read_rows(TableMotion, catalogue)}
        return cls(read_tests(folder / TESTS), folder, listed)

    def table_motion(self, number: int) -> Accelerogram:
        """Return the unfiltered acceleration of the table, its numbers checked against the catalogue."""
        name, listed = f"{number:03d}", self.catalogue.get(number)
        if name in self._arrays:
            samples = self._arrays[name]
        elif listed is not None:
            samples = _download(listed)
        else:
            raise RecordError(f"test {number}: no samples in {self.folder / MOTIONS} nor in the catalogue.")
        if listed is not None and not listed.holds(samples):
            raise RecordError(
                f"test {number}: the samples have another sha256 than {listed.samples_sha256} of the catalogue; "
                "it is another version.",
                samples_sha256=listed.samples_sha256,
            )
        (test,) = self.tests[self.tests.test == number].itertuples()
        source = Source(path=f"Test{name}", unit="g", format="shake table")
        acceleration = samples.astype(np.float64) * GRAVITY
        return Accelerogram(acceleration, test.dt, component="table", event=test.motion, source=source)

    @cached_property
    def _arrays(self) -> Mapping[str, np.ndarray]:
        path = self.folder / MOTIONS
        return np.load(path, allow_pickle=False) if path.is_file() else {}


def read_tests(path: Path) -> pd.DataFrame:
    """Return tests.csv by number: test, dt [s], motion (what the table played, scaled) and verdicts, as truths.

    The verdicts are overturned_specimen_1 and _2, and published ones of other codes as specimen_K_NAME. Of the columns
    pga_g and pgv_over_pga the nominal peak velocity is made, m/s. Raises RecordError naming the line of a defect.
    """
    tests = pd.read_csv(path, dtype=str, keep_default_na=False)
    own = [f"overturned_specimen_{specimen}" for specimen in SPECIMENS]
    verdicts = dict.fromkeys([*own, *(name for name in tests if name.startswith("specimen_"))], bool)
    kinds = {"test": int, "dt": float, "pga_g": float, "pgv_over_pga": float, "motion": str, **verdicts}
    for name, kind in kinds.items():
        if name not in tests:
            raise RecordError(f"{path}: the column {name!r} is missing; mend the table.", **{name: "missing"})
        allowed, pattern = CELLS[kind]
        fits = tests[name].str.fullmatch(pattern)
        if not fits.all():
            line, value = int(np.argmin(fits)) + 2, tests[name][np.argmin(fits)]
            raise RecordError(
                f"{path}, line {line}: {name} is {value!r}, but must be {allowed}; mend the row.",
                **{name: value},
            )
    tests = tests.astype(dict.fromkeys(verdicts, int)).astype(kinds)
    tests["nominal_peak_velocity"] = tests.pga_g * tests.pgv_over_pga * GRAVITY
    return tests.sort_values("test", ignore_index=True)


def _download(listed: TableMotion) -> np.ndarray:
    """The samples of a test, float32 (n,), g, from the source; a file that does not hold those listed is not kept.

    In TestNNN.txt one header line stands before eight columns: the second is the acceleration along the shaking.
    """
    path = download(listed.source_path, REPOSITORY, COMMIT, listed.source_path)
    is_right = False
    try:
        lines = path.read_bytes().decode("ascii").splitlines()[1:]
        samples = np.array([float(line.split()[1]) for line in lines if line.strip()], dtype="<f4")
        is_right = listed.holds(samples)
        return samples
    except (UnicodeDecodeError, IndexError, ValueError) as error:
        sentence = f"{path.name}: the file is no table of a test, {error}; fetch it again."
        raise RecordError(sentence, file=path.name) from None
    finally:
        if not is_right:
            path.unlink()
