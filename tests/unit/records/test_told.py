"""What no reader takes is told how to get there, in the words of the way in that its user came through."""

import gzip
import re
from pathlib import Path

import numpy as np
import obspy
import pytest
from made_files import TRUE, by_obspy, peer, smc

from rocking.errors import RecordError, UnknownFormatError
from rocking.records import read
from rocking.records.doors import Door, advice, through
from tests.folders import list_folder
from tests.refusals import refused

OBSPY = Path(obspy.__file__).parent / "io"
LINE = re.compile(r"rocking\.from_obspy\(obspy\.read\(\w+\), (unit=|inventory=obspy\.read_inventory\()")


@pytest.mark.parametrize("place", [
    "xseed/tests/data/G.SPB.dataless", "gcf/tests/data/20160603_1910n.gcf",
    "mseed/tests/data/fullseed.mseed", "xseed/tests/data/arclink_full.seed",
])  # fmt: skip
def test_what_obspy_alone_reads_is_led_there_in_one_line(place: str) -> None:
    with pytest.raises(RecordError) as told:
        read(OBSPY / place)
    assert LINE.search(str(told.value)) or "rocking.from_obspy(obspy.read(path), inventory=" in str(
        told.value
    )
    assert "\n" not in str(told.value)


def test_a_resp_file_is_led_to_the_record_that_it_describes() -> None:
    with pytest.raises(RecordError, match=r"rocking\.read\(record, inventory=path\)"):
        read(OBSPY / "xseed/tests/data/RESP.BW.FURT..EHZ")


@pytest.mark.parametrize(("name", "content", "word"), [
    ("a.xls", b"<html><head></head><body><table><tr><td>0.01</td></tr></table>", "save it as CSV"),
    ("a.xls", b"<html xmlns:x=\"urn:schemas-microsoft-com:office:excel\">", "save it as CSV"),
    ("a.at2", b"<!DOCTYPE html><html><body>404</body></html>", "download failed"),
    ("workspace", b"\x89HDF\r\n\x1a\n" + bytes(200), "call it .h5"),
    ("a.dat", b"BZh91AY&SY" + bytes(200), "unpack it"),
])  # fmt: skip
def test_files_of_other_kinds_are_told_what_to_do(
    tmp_path: Path, name: str, content: bytes, word: str
) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(RecordError, match=word):
        read(tmp_path / name)


HEADS = [
    "PEER DATABASE\nACCELERATION RESPONSE SPECTRUM, 5 % DAMPED\nACCELERATION IN G\nNPTS= 900, DT= .01 SEC\n",
    "# Pseudo-spectral acceleration\n# acc (g)\n# number of points: 900\n# dt = 0.01\n",
    "Espectro de respuesta de aceleración\nunits: gal\n# npts = 900\n# dt: 0.02\n",
    "Fourier amplitude spectrum of acceleration (g)\n900 points, dt = 0.01 s\n",
]


@pytest.mark.parametrize("head", HEADS)
def test_a_spectrum_whose_header_says_so_is_told_so_first(tmp_path: Path, head: str) -> None:
    """Its number of ordinates is not that of samples, which was told instead, with the advice to mend the header."""
    (tmp_path / "a.txt").write_text(head + "\n".join(f"{value:.6f}" for value in np.abs(TRUE)) + "\n")
    with pytest.raises(RecordError) as caught:
        read(tmp_path / "a.txt")
    assert caught.value.field in {"quantity", "format"} and "spectr" in str(caught.value)


def test_a_motion_made_to_a_spectrum_is_told_what_is_wrong_with_it(tmp_path: Path) -> None:
    (tmp_path / "a.AT2").write_text(peer().replace("ACCELEROGRAM", "MATCHED TO THE DESIGN SPECTRUM")[:-400])
    with pytest.raises(RecordError) as told:
        read(tmp_path / "a.AT2")
    assert "this is a spectrum" not in str(told.value)
    assert smc()  # the header of another format holds a line of its type


DOORS: dict[Door, str] = {
    "python": "inventory=",
    "command": "among the files",
    "catalogue": "in the folder of the file",
}


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("form", ["SAC", "MSEED"])
def test_advice_is_in_the_words_of_the_door(tmp_path: Path, door: Door, form: str) -> None:
    (tmp_path / "a").write_bytes(by_obspy(form, np.round(1e4 * TRUE).astype(np.float32)))
    (tmp_path / "b.txt").write_text(
        "t NS\n" + "".join(f"{i / 100} {value:.6f}\n" for i, value in enumerate(TRUE))
    )
    for name, words in (("a", DOORS[door]), ("b.txt", advice_in(door))):
        with through(door), pytest.raises(RecordError) as told:
            read(tmp_path / name)
        assert words in str(told.value)
        others = [one_door for other, one_door in DOORS.items() if other != door]
        assert not any(one_other in str(told.value) for one_other in others)
    refused = {file.file: file.refusal for file in list_folder(tmp_path)[0]}
    assert DOORS["catalogue"] in refused["a"] or not refused["a"]


def advice_in(door: Door) -> str:
    with through(door):
        return advice("unit")


def test_the_door_is_closed_behind_an_error() -> None:
    with pytest.raises(ValueError, match="x"), through("command"):
        raise ValueError("x")
    assert advice("unit") == "give unit="


def test_a_packed_web_page_is_told_so(tmp_path: Path) -> None:
    (tmp_path / "a.gz").write_bytes(gzip.compress(b"<html><body>404</body></html>"))
    with refused(UnknownFormatError, "format", b"<html><b"):
        read(tmp_path / "a.gz")
