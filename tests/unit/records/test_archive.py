"""Zip archives: their members are read as the files of a folder are, and nothing leads out of them or swells."""

import io
import shutil
import tarfile
import zipfile
from pathlib import Path

import numpy as np
import pytest

from rocking.catalogue import load_catalogue
from rocking.catalogue.catalogue import catalogue_text
from rocking.catalogue.files import local_files, with_hashes
from rocking.catalogue.folder import catalogue_of_folder
from rocking.catalogue.station import open_station
from rocking.errors import RecordError
from rocking.records import read
from rocking.records.archive import members
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.contracts.made_files import TRUE, knet, peer
from tests.folders import list_folder
from tests.refusals import refused

FILES = {"quake/RSN1_MADE_ST000.AT2": peer(), "quake/RSN1_MADE_ST090.AT2": peer(0.9).replace(", 45", ", 135")}


def packed(path: Path, files: dict[str, str | bytes] = FILES, how: int = zipfile.ZIP_DEFLATED) -> Path:
    with zipfile.ZipFile(path, "w", how) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def test_every_member_is_read_as_the_file_is(tmp_path):
    archive = packed(tmp_path / "peer.zip", FILES | {"__MACOSX/._x": "junk", "readme.pdf": "%PDF"})
    first, second = read(archive)
    assert np.allclose(first.acceleration, TRUE, atol=1e-6) and (first.component, second.component) == (
        "45",
        "135",
    )
    assert first.warnings == (RockingWarning.of(RecordKind.FILES_NOT_READ, names="readme.pdf"),)
    (alone,) = read(archive / "quake/RSN1_MADE_ST090.AT2")
    assert alone.source.sha256 == second.source.sha256 and alone.source.path.endswith(
        ".zip/quake/RSN1_MADE_ST090.AT2"
    )


def test_a_catalogue_names_the_members_and_a_study_opens_them(tmp_path):
    packed(tmp_path / "peer.zip")
    listed, rows = list_folder(tmp_path)
    names = [f"peer.zip/{name}" for name in FILES]
    assert [file.file for file in listed] == names and rows[0]["file"] == ";".join(names)
    catalogue = tmp_path / "catalogue.csv"
    catalogue.write_text(catalogue_text([row | {"sha256": ""} for row in rows]), encoding="utf-8")
    record = with_hashes(load_catalogue(catalogue)[0])
    assert record.sha256 == rows[0]["sha256"]
    assert len(open_station(record).horizontal) == 2
    assert local_files(record) == [tmp_path / "peer.zip"]
    packed(
        tmp_path / "peer.zip", {name: content.replace("Quake", "Other") for name, content in FILES.items()}
    )
    with refused(RecordError, "sha256"):
        open_station(record)


def test_members_that_were_unpacked_are_followed_by_their_content(tmp_path):
    archive = packed(tmp_path / "peer.zip")
    rows = list_folder(tmp_path)[1]
    shutil.unpack_archive(archive, tmp_path)
    archive.unlink()
    followed = catalogue_of_folder(tmp_path, existing=rows)
    assert followed.existing[0]["file"] == ";".join(FILES) and not followed.new


@pytest.mark.parametrize(
    ("files", "named"),
    [
        ({"../out.AT2": peer()}, ("file",)),
        ({"/etc/passwd": "x"}, ("file",)),
        ({"a\\b.AT2": peer()}, ("file",)),
        ({"C:x.AT2": peer()}, ("file",)),
        ({f"{n}.AT2": "x" for n in range(10_001)}, ("files", 10001)),
        ({"[Content_Types].xml": "x", "xl/sheet.xml": "x"}, ("format", "workbook")),
        ({"empty/": ""}, ("files", 0)),
        ({"big.txt": b"1 2\n" * (3 * 2**20)}, ("size", 8388609)),
    ],
)
def test_archives_that_are_refused(tmp_path, files, named):
    archive = packed(tmp_path / "bad.zip", files)
    with refused(RecordError, *named):
        read(archive)
    if "empty/" not in files:
        files = list_folder(tmp_path)[0]
        assert files and all(file.refusal for file in files)


def tarred(path: Path, files: dict[str, bytes], how: str = "w") -> Path:
    with tarfile.open(path, how) as archive:
        for name, content in files.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return path


PLAIN = {name: content.encode() for name, content in FILES.items()}


@pytest.mark.parametrize(("name", "how"), [("a.tar", "w"), ("a.tar.gz", "w:gz"), ("A.TGZ", "w:gz")])
def test_a_tar_file_is_read_as_a_zip_file_is(tmp_path, name, how):
    archive = tarred(tmp_path / name, PLAIN | {"./readme.pdf": b"%PDF"}, how)
    first, second = read(archive)
    assert np.allclose(first.acceleration, TRUE, atol=1e-6) and second.component == "135"
    assert first.warnings == (RockingWarning.of(RecordKind.FILES_NOT_READ, names="readme.pdf"),)
    rows = list_folder(tmp_path)[1]
    assert rows[0]["file"] == ";".join(f"{name}/{member}" for member in FILES)
    (tmp_path / "c.csv").write_text(catalogue_text(rows), encoding="utf-8")
    (record,) = load_catalogue(tmp_path / "c.csv")
    assert len(open_station(record).horizontal) == 2 and local_files(record) == [archive]


def test_what_k_net_serves_is_a_tar_file_of_packed_tar_files(tmp_path):
    """Those of K-NET and of KiK-net, each with a file a component."""
    parts = {}
    for network, station in (("knt", "AOM001"), ("kik", "AOMH01")):
        of_station = {f"{station}.{end}": knet().replace("MADE01", station).encode() for end in ("EW", "NS")}
        parts[f"{network}.tar.gz"] = tarred(tmp_path / "part", of_station, "w:gz").read_bytes()
    (tmp_path / "part").unlink()
    archive = tarred(tmp_path / "20240101161000.tar", parts)
    assert members(archive) == (
        "kik.tar.gz/AOMH01.EW", "kik.tar.gz/AOMH01.NS", "knt.tar.gz/AOM001.EW", "knt.tar.gz/AOM001.NS",
    )  # fmt: skip
    assert len(read(archive)) == 4
    (alone,) = read(archive / "knt.tar.gz" / "AOM001.NS")
    assert alone.peak_acceleration == pytest.approx(np.abs(TRUE - TRUE.mean()).max(), rel=1e-2)


def test_a_zip_file_in_a_zip_file_is_a_folder_of_it(tmp_path):
    inner = packed(tmp_path / "inner.zip").read_bytes()
    (tmp_path / "inner.zip").unlink()
    archive = packed(tmp_path / "outer.zip", {"a/inner.zip": inner, "b.AT2": peer()})
    assert members(archive) == (*(f"a/inner.zip/{name}" for name in FILES), "b.AT2")
    assert len(read(archive)) == 3
    with refused(RecordError, "file", "a/inner.zip/quake"):
        read(archive / "a" / "inner.zip" / "quake")
    assert read(archive / "a" / "inner.zip" / "quake" / "RSN1_MADE_ST090.AT2")[0].component == "135"


def test_archives_too_deep_in_others_are_refused(tmp_path):
    content = packed(tmp_path / "x.zip").read_bytes()
    for _ in range(4):
        content = packed(tmp_path / "x.zip", {"x.zip": content}).read_bytes()
    (name,) = members(tmp_path / "x.zip")
    assert name == "x.zip/x.zip/x.zip"
    with refused(RecordError, "file", "x.zip/x.zip/x.zip"):
        read(tmp_path / "x.zip")


@pytest.mark.parametrize("name", ["x.tar", "x.tar.gz", "x.zip"])
def test_a_damaged_archive_is_refused_in_a_sentence(tmp_path, name):
    content = tarred(tmp_path / name, PLAIN, "w:gz" if name.endswith("gz") else "w").read_bytes()
    if name.endswith("zip"):
        content = packed(tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(content[: len(content) // 3])
    with refused(RecordError, "format"):
        read(tmp_path / name)
    assert all(file.refusal for file in list_folder(tmp_path)[0])


def test_links_and_ways_out_of_a_tar_file_are_not_followed(tmp_path):
    with refused(RecordError, "file", "../out.AT2"):
        read(tarred(tmp_path / "bad.tar", {"../out.AT2": b"x"}))
    with tarfile.open(tmp_path / "link.tar", "w") as archive:
        link = tarfile.TarInfo("a.AT2")
        link.type, link.linkname = tarfile.SYMTYPE, "/etc/passwd"
        archive.addfile(link)
    with refused(RecordError, "files", 0):
        read(tmp_path / "link.tar")


def test_what_swells_or_is_damaged_is_refused_member_by_member(tmp_path):
    archive = packed(tmp_path / "peer.zip", how=zipfile.ZIP_STORED)
    content = bytearray(archive.read_bytes())
    content[content.find(b"ACCELERATION TIME")] ^= 1
    archive.write_bytes(content)
    (record,) = read(archive)
    assert record.warnings[0].kind is RecordKind.FILES_NOT_READ
    assert "ST000.AT2" in record.warnings[0]["names"]
    with refused(RecordError, "file", "quake/RSN1_MADE_ST000.AT2"):
        read(archive / "quake/RSN1_MADE_ST000.AT2")
    with refused(RecordError, "file", "quake/RSN1_MADE_ST180.AT2"):
        read(archive / "quake/RSN1_MADE_ST180.AT2")


@pytest.mark.parametrize(("limit", "name"), [("_LARGEST_WHOLE", "a.zip"), ("_LARGEST_TAR", "a.tar.gz")])
def test_an_archive_that_unpacks_to_too_much_is_refused(tmp_path, monkeypatch, limit, name):
    path = packed(tmp_path / name) if name.endswith("zip") else tarred(tmp_path / name, PLAIN, "w:gz")
    monkeypatch.setattr(f"rocking.records.archive.{limit}", 500)
    with refused(RecordError, "size"):
        members(path)


def test_a_row_that_names_the_archive_alone_is_told_what_to_write(tmp_path):
    packed(tmp_path / "peer.zip")
    (tmp_path / "c.csv").write_text("id,file\nA,peer.zip\n", encoding="utf-8")
    with refused(RecordError, "file", "peer.zip"):
        open_station(load_catalogue(tmp_path / "c.csv")[0])


def test_an_encrypted_member_is_refused(tmp_path):
    archive = packed(tmp_path / "peer.zip")
    content = bytearray(archive.read_bytes())
    at = content.find(b"PK\x01\x02")
    content[at + 8] |= 1
    archive.write_bytes(content)
    with refused(RecordError, "file", "quake/RSN1_MADE_ST000.AT2"):
        read(archive / members(archive)[0])
