"""The shake-table campaign: measured table motions of each test, and how it ended.

384 tests of two granite specimens (repository ZhiangChen/virtual_shake_robot_pybullet, GPL-3.0). Nothing of them is
part of this package: a folder in the form of `Campaign.open` is read as it stands, and table motions that are not in
it are fetched from the source and checked against the catalogue.
"""

import csv
import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_factor
from rocking.records.accelerogram import Accelerogram, Source
from rocking.records.fetch import download
from rocking.tables import Row, column, read_rows, row

REPOSITORY = "ZhiangChen/virtual_shake_robot_pybullet"
COMMIT = "9f239e7e21280702be9ba7a40ed9b47a35868a52"
TESTS, MOTIONS = "tests.csv", "accelerations.npz"
SPECIMENS = (1, 2)


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
        return hashlib.sha256(content).hexdigest() == self.samples_sha256


@dataclass(frozen=True)
class TableTest:
    """One test. motion: the input that the table played, scaled. overturned: by specimen. published: verdicts of
    other codes by specimen and name. peak_velocity: nominal, m/s, as published with the test.
    """

    number: int
    motion: str
    time_step: float
    peak_velocity: float
    overturned: Mapping[int, bool]
    published: Mapping[int, Mapping[str, bool]]


@dataclass(frozen=True, eq=False)
class Campaign:
    """The tests in the order of their numbers, and where their files are."""

    tests: tuple[TableTest, ...]
    folder: Path
    catalogue: Mapping[int, TableMotion]

    @classmethod
    def open(cls, catalogue: Path, mirror: Path | None) -> "Campaign":
        """Open the campaign in `mirror`, or in `shake_table` inside it or beside it.

        The folder holds tests.csv (test, dt, motion, pgv_over_pga, pga_g, overturned_specimen_1 and _2, published
        verdicts as specimen_K_NAME) and accelerations.npz (float32, g, one array a test, key "011"), which is fetched
        where it is missing. Raises RecordError when there is no such folder or a row has a defect.
        """
        tried = [] if mirror is None else [mirror, mirror / "shake_table", mirror.parent / "shake_table"]
        folder = next((folder for folder in tried if (folder / TESTS).is_file()), None)
        if folder is None:
            places = ", ".join(map(str, tried)) or "the setting mirror, which is null"
            raise RecordError(
                f"no {TESTS} of the shake-table campaign in {places}; name its folder, or one beside it, as mirror."
            )
        tests = []
        reader = csv.DictReader(io.StringIO((folder / TESTS).read_text(encoding="utf-8")))
        for line, cells in enumerate(reader, 2):
            try:
                tests.append(_test(cells))
            except (KeyError, ValueError) as error:
                raise RecordError(
                    f"{folder / TESTS}, line {line}: {error} is missing or no number; mend the row."
                ) from None
        listed = {motion.test: motion for motion in read_rows(TableMotion, catalogue)}
        return cls(tuple(sorted(tests, key=lambda test: test.number)), folder, listed)

    def table_motion(self, test: TableTest) -> Accelerogram:
        """Return the unfiltered acceleration of the table, its numbers checked against the catalogue."""
        name, listed = f"{test.number:03d}", self.catalogue.get(test.number)
        if self._arrays is not None and name in self._arrays:
            samples = self._arrays[name]
        elif listed is not None:
            samples = _fetched(listed)
        else:
            raise RecordError(
                f"test {test.number}: no samples in {self.folder / MOTIONS} nor in the catalogue."
            )
        if listed is not None and not listed.holds(samples):
            raise RecordError(
                f"test {test.number}: the samples have another sha256 than {listed.samples_sha256} of the catalogue; "
                "it is another version."
            )
        return Accelerogram(
            samples.astype(np.float64) * acceleration_factor("g"),
            test.time_step,
            component="table",
            event=test.motion,
            source=Source(path=f"Test{name}", unit="g", format="shake table"),
        )

    @cached_property
    def _arrays(self) -> Mapping[str, np.ndarray] | None:
        path = self.folder / MOTIONS
        return np.load(path, allow_pickle=False) if path.is_file() else None


def _fetched(listed: TableMotion) -> np.ndarray:
    """The samples of a test from the source; a file that does not hold those of the catalogue is not kept."""
    path, held = download(listed.source_path, REPOSITORY, COMMIT, listed.source_path), False
    try:
        samples = converted(path.read_bytes(), path.name)
        held = listed.holds(samples)
        return samples
    finally:
        if not held:
            path.unlink()


def converted(content: bytes, name: str) -> np.ndarray:
    """Return the acceleration of the table, float32 (n,), g, from a file TestNNN.txt of the source.

    One header line, then eight columns: the second is the acceleration in the direction of shaking.
    """
    try:
        text = content.decode("ascii").splitlines()[1:]
        return np.array([float(line.split()[1]) for line in text if line.strip()], dtype="<f4")
    except (UnicodeDecodeError, IndexError, ValueError) as error:
        raise RecordError(f"{name}: the file is no table of a test, {error}; fetch it again.") from None


def _test(cells: Mapping[str, str]) -> TableTest:
    step, peak, ratio = (float(cells[name]) for name in ("dt", "pga_g", "pgv_over_pga"))
    published: dict[int, dict[str, bool]] = {specimen: {} for specimen in SPECIMENS}
    for specimen in SPECIMENS:
        start = f"specimen_{specimen}_"
        for name, value in cells.items():
            if name.startswith(start) and value != "":
                published[specimen][name.removeprefix(start)] = _flag(value)
    return TableTest(
        number=int(cells["test"]),
        motion=cells["motion"],
        time_step=step,
        peak_velocity=peak * ratio * acceleration_factor("g"),
        overturned={specimen: _flag(cells[f"overturned_specimen_{specimen}"]) for specimen in SPECIMENS},
        published=published,
    )


def _flag(text: str) -> bool:
    if text not in ("0", "1"):
        raise ValueError(f"verdict {text!r}, which must be 0 or 1,")
    return text == "1"
