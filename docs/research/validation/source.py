"""The public source of the shake-table campaign: files by commit, numbers by sha256, and their conversion."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rocking.errors import RecordError
from rocking.records.catalogue_record import CatalogueRecord
from rocking.records.fetch import download
from rocking.tables import Row, column, read_rows, row

REPOSITORY = "ZhiangChen/virtual_shake_robot_pybullet"
COMMIT = "9f239e7e21280702be9ba7a40ed9b47a35868a52"
LICENCE = "GPL-3.0"
SPECIMENS = (
    CatalogueRecord(
        "specimen_1",
        "SP1.obj",
        "49a4156c6329efba8ca91e8e649a4b8647fd2359f372049c0ee5f2fb8db6757d",
        source_repository=REPOSITORY,
        source_path="data/ASU_ Shared_ Scans/SP1_PBRmodel/SP1.obj",
        source_commit="f24e12eee519bd987e6315bbe9cbccf4d5a81145",
        licence=LICENCE,
    ),
    CatalogueRecord(
        "specimen_2",
        "SP2.obj",
        "e7350ad0f03fdc2883eae75c04df197fd962d3ed14a5b9c66b46be8a322f5ee6",
        source_repository=REPOSITORY,
        source_path="data/ASU_Shared_Scans/SP2_PBRmodel/SP2.obj",
        source_commit="8f897f56b9006a16b961daa96968962998c61db1",
        licence=LICENCE,
    ),
)
"""The meshes, with the sha256 of their text."""


@row("shake_table", "One row per test: where its table motion is, and what must be true of it")
class TableMotion(Row):
    """A row of the catalogue of table motions."""

    test: int = column("Number of the test")
    source_path: str = column("Path in the repository of the source")
    samples: int = column("Number of samples")
    samples_sha256: str = column("SHA-256 of the acceleration as little-endian float32, g")

    def check(self, samples: np.ndarray) -> None:
        """Raise RecordError when `samples` (n,) are not those of the catalogue."""
        found = hashlib.sha256(np.ascontiguousarray(samples, dtype="<f4").tobytes()).hexdigest()
        if found != self.samples_sha256:
            raise RecordError(
                f"test {self.test}: the samples have sha256 {found}, but the catalogue says {self.samples_sha256}; "
                "it is another version."
            )


def load_table_motions(path: Path) -> Mapping[int, TableMotion]:
    """Return the rows of records/shake_table.csv by number of the test. Raises RockingError where it cannot be read."""
    return {motion.test: motion for motion in read_rows(TableMotion, path)}


def converted(content: bytes, name: str) -> np.ndarray:
    """Return the acceleration of the table, float32 (n,), g, from a file TestNNN.txt of the source.

    One header line, then eight columns: the second is the acceleration in the direction of shaking.
    """
    try:
        text = content.decode("ascii").splitlines()[1:]
        return np.array([float(line.split()[1]) for line in text if line.strip()], dtype="<f4")
    except (UnicodeDecodeError, IndexError, ValueError) as error:
        raise RecordError(f"{name}: the file is no table of a test, {error}; fetch it again.") from None


def fetch_table_motion(motion: TableMotion) -> np.ndarray:
    """Return the samples of a test from the source; the download is kept only if its numbers are the catalogue's.

    Raises RecordError when it cannot be had or is another version.
    """
    path = download(motion.source_path, REPOSITORY, COMMIT, motion.source_path)
    samples = converted(path.read_bytes(), path.name)
    try:
        motion.check(samples)
    except RecordError:
        path.unlink()
        raise
    return samples
