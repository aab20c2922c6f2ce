"""What is read is told by its content: the hash follows every edit, and nothing but an edit."""

import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from rocking.errors import ConfigurationError
from rocking.records import CatalogueRecord
from rocking.study import inputs
from rocking.study.inputs import (
    ContentHashes,
    check_files,
    files_sha256,
    planned_structures,
    structures_sha256,
)
from rocking.study.settings import Settings

PIER = "- {name: pier, type: block, breadth_m: 1, height_m: 6}\n"
COUNTS = b"000001D " + bytes(504)
"""What a miniSEED file begins with."""


def _record(folder: Path, content: bytes = b"samples", **cells: object) -> CatalogueRecord:
    (folder / "a.dat").write_bytes(content)
    return CatalogueRecord(**{"id": "a", "file": "a.dat", "sha256": "0" * 64} | cells, folder=folder)


def _hash(record: CatalogueRecord, hashes: ContentHashes | None = None, **settings: object) -> str:
    return files_sha256([record], Settings(**settings), hashes or ContentHashes())


@pytest.mark.parametrize("when", [1e9, time.time() + 3e8], ids=["long ago", "in ten years"])
def test_a_new_date_changes_no_hash_and_a_new_content_with_the_old_date_does(
    tmp_path: Path, when: float
) -> None:
    record = _record(tmp_path)
    before, file = _hash(record), tmp_path / "a.dat"
    os.utime(file, (when, when))
    assert _hash(record) == before
    file.write_bytes(b"Samples")
    os.utime(file, (when, when))
    assert _hash(record) != before


@pytest.mark.parametrize(
    ("cells", "content", "file", "counts"),
    [
        ({"inventory": "x.xml"}, COUNTS, "x.xml", True),
        ({}, COUNTS, "x.xml", True),
        ({}, b"\x1f\x8b packed", "x.xml", True),
        ({"unit": "m/s2"}, COUNTS, "x.xml", False),
        ({}, b"text", "x.xml", False),
        ({"file": "a.dat;v.dat", "sha256": ""}, b"text", "v.dat", True),
    ],
    ids=["named StationXML", "StationXML beside", "packed", "declared unit", "no miniSEED", "second file"],
)
def test_every_file_that_is_read_counts_and_no_other(
    tmp_path: Path, cells: dict[str, str], content: bytes, file: str, counts: bool
) -> None:
    record = _record(tmp_path, content, **cells)
    (tmp_path / file).write_text("sensitivity 1000")
    before = _hash(record)
    (tmp_path / file).write_text("sensitivity 2000")
    assert (_hash(record) != before) == counts


def test_a_file_in_the_mirror_counts_before_the_one_beside_the_catalogue(tmp_path: Path) -> None:
    mirror, beside = tmp_path / "mirror", tmp_path / "beside"
    mirror.mkdir()
    beside.mkdir()
    record = _record(beside)
    without = _hash(record, mirror=str(mirror))
    (mirror / "a.dat").write_bytes(b"samples of the mirror")
    assert _hash(record, mirror=str(mirror)) != without


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> Callable[[], int]:
    """How many files were read whole since the last call."""
    read: list[Path] = []
    real = inputs._sha256
    monkeypatch.setattr(inputs, "_sha256", lambda path: (read.append(path), real(path))[1])

    def since() -> int:
        number = len(read)
        read.clear()
        return number

    return since


def test_a_file_that_stayed_is_not_read_again(
    tmp_path: Path, counted, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inputs, "_SETTLED", -1.0)
    record, store = _record(tmp_path), tmp_path / "hashes.json"
    for reads in (1, 0):
        hashes = ContentHashes(store)
        _hash(record, hashes)
        hashes.save()
        assert counted() == reads
    status = (tmp_path / "a.dat").stat()
    (tmp_path / "a.dat").write_bytes(b"Samples")
    os.utime(tmp_path / "a.dat", ns=(status.st_atime_ns, status.st_mtime_ns))
    assert _hash(record, ContentHashes(store)) == _hash(record)
    store.write_text('{"damaged": 1}')
    assert _hash(record, ContentHashes(store)) == _hash(record)


def test_the_hash_of_a_file_that_changed_a_moment_ago_is_not_kept(tmp_path: Path) -> None:
    hashes = ContentHashes(tmp_path / "hashes.json")
    _hash(_record(tmp_path), hashes)
    hashes.save()
    assert not (tmp_path / "hashes.json").exists()


def test_structures_are_told_by_what_they_say(tmp_path: Path) -> None:
    path = tmp_path / "structures.yaml"
    path.write_text(PIER)
    known = structures_sha256(path)
    path.write_text(
        "# the old pier\n- name: pier\n  height_m: 6\n  type: block\n  breadth_m: 1   # measured\n"
    )
    assert list(planned_structures(path, known)) == ["pier"]
    path.write_text(PIER.replace("6", "7"))
    with pytest.raises(ConfigurationError, match="changed while the study ran"):
        planned_structures(path, known)


def test_a_file_that_changed_since_the_plan_stops_the_job(tmp_path: Path) -> None:
    record = _record(tmp_path)
    known = _hash(record)
    check_files([record], Settings(), known)
    (tmp_path / "a.dat").write_bytes(b"others")
    with pytest.raises(ConfigurationError, match="changed while the study ran"):
        check_files([record], Settings(), known)
