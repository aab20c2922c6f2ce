"""Files on the command line: joined as a catalogue joins them, wherever they come from, and a structure beside them."""

import csv
import io
import tarfile
import zipfile
from pathlib import Path

import numpy as np
import obspy
import pytest
from made_files import TRUE, by_obspy, knet, peer

from rocking.assessment.rows import WarningRow
from rocking.errors import ConfigurationError, RecordError
from rocking.structures.kinds import StructureKind
from rocking.study.cli import main
from rocking.study.kinds import StudyKind
from rocking.study.own_files import Declared, read_files, scenes_of, stations_of
from tests.folders import list_folder

FILES = {
    "RSN1_MADE_ST000.AT2": peer().replace(", 45", ", 000"),
    "RSN1_MADE_ST090.AT2": peer(0.9).replace(", 45", ", 090"),
    "RSN1_MADE_ST-UP.AT2": peer(0.6).replace(", 45", ", UP"),
}
WALL = "{type: free_wall, height_m: 2.2, thickness_m: 0.3}"
NOTHING = Declared()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, content in FILES.items():
        (tmp_path / name).write_text(content)
    return tmp_path


def paths(folder: Path) -> list[Path]:
    return [folder / name for name in FILES]


def test_the_components_of_a_station_are_one_record_as_in_a_catalogue(folder: Path) -> None:
    (own,) = stations_of(paths(folder), NOTHING).stations
    (row,) = list_folder(folder)[1]
    assert sorted(own.record.file.split(";")) == sorted(row["file"].split(";"))
    assert own.record.id == row["id"] and own.record.sha256.count(";") == 2
    assert [channel.component for channel in own.channels] == ["000", "090", "UP"]


@pytest.mark.parametrize("kind", ["folder", "zip", "tar.gz"])
def test_a_folder_and_an_archive_give_the_record_that_their_files_give(folder: Path, kind: str) -> None:
    if kind == "folder":
        given = folder
    elif kind == "zip":
        given = folder / "a.zip"
        with zipfile.ZipFile(given, "w") as archive:
            for path in paths(folder):
                archive.write(path, path.name)
    else:
        given = folder / "a.tar.gz"
        with tarfile.open(given, "w:gz") as packed:
            for path in paths(folder):
                packed.add(path, path.name)
    (own,) = stations_of([given], NOTHING).stations
    (direct,) = stations_of(paths(folder), NOTHING).stations
    assert sorted(c.sha256 for c in own.channels) == sorted(c.sha256 for c in direct.channels)
    assert len(own.record.files) == 3


def test_a_component_beside_a_file_that_is_not_given_is_named(folder: Path) -> None:
    (folder / "RSN2_OTHER_XX000.AT2").write_text(FILES["RSN1_MADE_ST000.AT2"].replace("Made", "Elsewhere"))
    own = stations_of(paths(folder)[:1], NOTHING)
    assert {(warning.kind, warning["other"]) for warning in own.warnings} == {
        (StudyKind.SIBLING_NOT_USED, "RSN1_MADE_ST090.AT2"),
        (StudyKind.SIBLING_NOT_USED, "RSN1_MADE_ST-UP.AT2"),
    }
    assert not stations_of(paths(folder), NOTHING).warnings
    (folder / "RSN1_MADE_ST180.AT2").write_text("PEER\n")
    assert stations_of(paths(folder)[:1], NOTHING).warnings == own.warnings


def test_a_vertical_file_alone_is_no_record_and_one_of_another_step_is_its_own(folder: Path) -> None:
    east, north, up = paths(folder)
    with pytest.raises(RecordError, match=f"^{up.name}: it holds no horizontal component"):
        stations_of([up], NOTHING)
    north.write_text(FILES[north.name].replace("DT= 0.01", "DT= 0.02"))
    own = stations_of([east, north], NOTHING)
    apart = {(StudyKind.FILE_APART, east.name), (StudyKind.FILE_APART, north.name)}
    assert apart <= {(warning.kind, warning.about) for warning in own.warnings}
    up.write_text(FILES[up.name].replace("1/2/1999", "3/4/1998"))
    (warning,) = stations_of([east, up], NOTHING).warnings
    assert (warning.kind, warning.about) == (StudyKind.FILE_WITHOUT_RECORD, up.name)


def test_a_k_net_triple_is_one_record(tmp_path: Path) -> None:
    for end, name in (("NS", "N-S"), ("EW", "E-W"), ("UD", "U-D")):
        (tmp_path / f"AOM001.{end}").write_text(knet().replace("E-W", name))
    (own,) = stations_of([tmp_path / f"AOM001.{end}" for end in ("NS", "EW", "UD")], NOTHING).stations
    assert len(own.record.files) == 3


def test_a_stationxml_among_the_files_describes_the_others(tmp_path: Path) -> None:
    """Wherever it lies: here in a folder of its own."""
    (tmp_path / "of").mkdir()
    inventory = obspy.read_inventory("records/CI.CCC.xml")
    network = inventory[0]
    station = network[0]
    channel = station[0]
    counts = np.round(1e5 * TRUE).astype(np.int32)
    trace = obspy.read(io.BytesIO(by_obspy("MSEED", counts)))[0]
    trace.stats.network, trace.stats.station = network.code, station.code
    trace.stats.channel, trace.stats.location = channel.code, channel.location_code
    trace.stats.starttime = (channel.start_date or station.start_date) + 86400
    trace.write(str(tmp_path / "a.mseed"), format="MSEED")
    inventory.write(str(tmp_path / "of" / "x.xml"), format="STATIONXML")
    with pytest.raises(RecordError, match="StationXML"):
        stations_of([tmp_path / "a.mseed"], NOTHING)
    (own,) = stations_of([tmp_path / "of" / "x.xml", tmp_path / "a.mseed"], NOTHING).stations
    gain = channel.response.instrument_sensitivity.value
    assert own.channels[0].acceleration == pytest.approx((counts - counts.mean()) / gain, rel=1e-9, abs=1e-12)


def test_a_damaged_archive_is_named_and_costs_the_others_nothing(folder: Path) -> None:
    damaged = folder / "damaged.zip"
    damaged.write_bytes(b"PK\x03\x04 and no more")
    whole = next(path for path in sorted(folder.iterdir()) if path != damaged)
    own = read_files([damaged, whole], Declared())
    assert list(own.channels) == [whole]
    assert [str(error).partition(":")[0] for error in own.refused] == ["damaged.zip"]


def test_a_file_that_fails_costs_the_others_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "letter.txt").write_text("Dear Sir or Madam\n")
    arguments = [*map(str, paths(folder)), str(folder / "letter.txt")]
    assert main(["read", *arguments]) == 1
    told = capsys.readouterr()
    assert told.out.count("PEER AT2") == 3 and told.err.count("\n") == 1 and "letter.txt" in told.err
    assert main(["pulse", *arguments]) == 1
    assert capsys.readouterr().out.count("amplitude") == 2
    own = read_files([folder / "letter.txt", *paths(folder)], NOTHING)
    assert len(own.refused) == 1 and len(own.channels) == 3


@pytest.mark.parametrize(("text", "words"), [
    ("{type: free_wall, heigth_m: 2.2, thickness_m: 0.3}", "heigth_m is not a key of a free wall"),
    ("{type: wal, height_m: 2.2}", "type"), ("{type: free_wall, height_m: 2.2", "not valid YAML"),
    ("{}", "type"), ("{height_m: 2.2, thickness_m: .3}", "type"), ("[]", "the list is empty"),
])  # fmt: skip
def test_a_wrong_structure_on_the_line_is_told_in_one_sentence(text: str, words: str) -> None:
    with pytest.raises(ConfigurationError) as told:
        scenes_of(text)
    assert words in str(told.value) and "\n" not in str(told.value)


def test_a_structure_on_the_line_is_that_of_a_list(tmp_path: Path) -> None:
    named = WALL.replace("{", "{name: free wall, ")
    (tmp_path / "list.yaml").write_text(f"- {named}\n")
    (listed,) = scenes_of(str(tmp_path / "list.yaml")).values()
    for text, stdin in ((WALL, None), (f"[{named}]", None), ("-", f"- {named}".encode())):
        (scene,) = scenes_of(text, stdin).values()
        assert scene == listed
    assert list(scenes_of(WALL.replace("{", "{name: mine, "))) == ["mine"]


@pytest.mark.process
def test_one_line_writes_one_report(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = folder / "out.pdf"
    files = [str(path) for path in paths(folder)]
    assert main(["assess", *files, "--structures", WALL, "--pdf", str(target)]) == 0
    assert target.read_bytes().startswith(b"%PDF") and str(target) in capsys.readouterr().out
    before = sorted(folder.iterdir())
    for wrong in (["--output", "x.pdf"], ["--structures", "{type: free_wall}"]):
        assert main(["assess", *files, "--structures", WALL, *wrong]) == 2
        assert capsys.readouterr().err.count("\n") == 1
    (folder / "B.AT2").write_text(FILES["RSN1_MADE_ST000.AT2"].replace("Made", "Elsewhere"))
    assert main(["assess", files[0], str(folder / "B.AT2"), "--structures", WALL, "--pdf", "x.pdf"]) == 2
    assert "give --output FOLDER" in capsys.readouterr().err
    (folder / "B.AT2").unlink()
    assert sorted(folder.iterdir()) == before


@pytest.mark.filterwarnings("ignore:restitution by momentum balance")
def test_a_size_in_another_unit_is_told_beside_the_verdict(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = list(map(str, paths(folder)))
    wrong = WALL.replace("2.2", "2200").replace("0.3", "300")
    for wall, unusual in ((wrong, True), (WALL, False)):
        out = folder / f"out of {unusual}"
        assert main(["assess", *given, "--structures", wall, "--output", str(out)]) == 0
        told = capsys.readouterr().out.splitlines()
        with (out / "summary" / WarningRow.table.file_name).open(newline="") as table:
            rows = [row for row in csv.DictReader(table) if row["kind"] == StructureKind.SIZE_UNUSUAL]
        assert bool(rows) is unusual
        assert [row["sentence"] for row in rows] == [line for line in told if "usually" in line]
