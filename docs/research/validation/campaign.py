"""The shake-table campaign: measured table motions of each test, how it ended, and the meshes of the specimens.

384 tests of two granite specimens (repository ZhiangChen/virtual_shake_robot_pybullet, GPL-3.0). Nothing of them is
part of this package: a folder in the form of `Campaign.open` is read as it stands, and table motions and meshes that
are not in it are fetched from the source and checked against the catalogue.
"""

import csv
import hashlib
import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from docs.research.validation.source import (
    SPECIMENS,
    TableMotion,
    fetch_table_motion,
    load_table_motions,
)
from rocking.errors import RecordError
from rocking.quantities import acceleration_factor
from rocking.records.accelerogram import Accelerogram, Source
from rocking.records.fetch import fetch
from rocking.records.read import unpacked

TESTS, MOTIONS = "tests.csv", "accelerations.npz"
_NUMBERS = ("dt", "pga_g", "pgv_over_pga")


@dataclass(frozen=True)
class TableTest:
    """One test. motion: the input that the table played, scaled. overturned: by specimen. published: verdicts of
    other codes by specimen and name. peak_velocity: m/s, as published with the test.
    """

    number: int
    motion: str
    time_step: float
    peak_velocity: float
    overturned: tuple[bool, ...]
    published: tuple[Mapping[str, bool], ...]


@dataclass(frozen=True, eq=False)
class Campaign:
    """The tests in the order of their numbers, and where their files are."""

    tests: tuple[TableTest, ...]
    folder: Path
    catalogue: Mapping[int, TableMotion]
    unlisted: tuple[int, ...] = field(default=())

    @classmethod
    def open(cls, catalogue: Path, mirror: Path | None) -> "Campaign":
        """Open the campaign in `mirror`, or in `shake_table` inside it or beside it.

        The folder holds tests.csv (test, dt, motion, pgv_over_pga, pga_g, overturned_specimen_1 and _2, published
        verdicts as specimen_K_NAME), accelerations.npz (float32, g, one array a test, key "011") and
        specimen_K.obj.gz; the last two are fetched where they are missing. Raises RecordError when there is no such
        folder or a row has a defect.
        """
        folder = _folder_of(mirror)
        listed = load_table_motions(catalogue)
        tests = tuple(sorted(_tests(folder / TESTS), key=lambda test: test.number))
        unlisted = tuple(test.number for test in tests if test.number not in listed)
        return cls(tests, folder, listed, unlisted)

    def table_motion(self, test: TableTest) -> Accelerogram:
        """Return the unfiltered acceleration of the table, its numbers checked against the catalogue."""
        name, known = f"{test.number:03d}", self.catalogue.get(test.number)
        if self._arrays is not None and name in self._arrays:
            samples = self._arrays[name]
        elif known is not None:
            samples = fetch_table_motion(known)
        else:
            raise RecordError(
                f"test {test.number}: no samples in {self.folder / MOTIONS} nor in the catalogue."
            )
        if known is not None:
            known.check(samples)
        return Accelerogram(
            samples.astype(np.float64) * acceleration_factor("g"),
            test.time_step,
            component="table",
            event=test.motion,
            source=Source(path=f"Test{name}", unit="g", format="shake table"),
        )

    def mesh_text(self, specimen: int) -> str:
        """Return the Wavefront text of the mesh of a specimen, 1 or 2, its hash checked."""
        record = SPECIMENS[specimen - 1]
        path = self.folder / f"specimen_{specimen}.obj.gz"
        content = unpacked(path.read_bytes(), path.name) if path.is_file() else fetch(record).read_bytes()
        if hashlib.sha256(content).hexdigest() != record.sha256:
            raise RecordError(f"{path}: the mesh is another version than the catalogue's; fetch it again.")
        return content.decode("utf-8")

    @cached_property
    def _arrays(self) -> Mapping[str, np.ndarray] | None:
        path = self.folder / MOTIONS
        return np.load(path, allow_pickle=False) if path.is_file() else None


def _folder_of(mirror: Path | None) -> Path:
    tried = [] if mirror is None else [mirror, mirror / "shake_table", mirror.parent / "shake_table"]
    found = next((folder for folder in tried if (folder / TESTS).is_file()), None)
    if found is None:
        places = ", ".join(str(folder) for folder in tried) or "the setting mirror, which is null"
        raise RecordError(
            f"no {TESTS} of the shake-table campaign in {places}; name its folder, or one beside it, as mirror."
        )
    return found


def _tests(path: Path) -> Iterator[TableTest]:
    reader = csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")))
    for line, row in enumerate(reader, 2):
        try:
            yield _test(row)
        except (KeyError, ValueError) as error:
            raise RecordError(
                f"{path}, line {line}: {error} is missing or no number; mend the row."
            ) from None


def _test(row: Mapping[str, str]) -> TableTest:
    step, peak, ratio = (float(row[name]) for name in _NUMBERS)
    specimens = range(1, len(SPECIMENS) + 1)
    return TableTest(
        number=int(row["test"]),
        motion=row["motion"],
        time_step=step,
        peak_velocity=peak * ratio * acceleration_factor("g"),
        overturned=tuple(_flag(row[f"overturned_specimen_{k}"]) for k in specimens),
        published=tuple(_published(row, f"specimen_{k}_") for k in specimens),
    )


def _published(row: Mapping[str, str], start: str) -> dict[str, bool]:
    return {
        name.removeprefix(start): _flag(value)
        for name, value in row.items()
        if name.startswith(start) and value != ""
    }


def _flag(text: str) -> bool:
    if text not in ("0", "1"):
        raise ValueError(f"verdict {text!r}, which must be 0 or 1,")
    return text == "1"
