"""Mutated files: whatever is done to a file, reading it ends in accelerograms or in our own error, and soon."""

import random
import re
import resource
import time
from pathlib import Path

import mutate_records
import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.records.formats import Options
from rocking.records.read import read_content

SMALL = (
    "northridge1994_rinaldi/RSN1063_NORTHR_RRS228.AT2",
    "formats_peer_at2/NIS090.AT2",
    "kobe1995_takatori/TAK000.AT2",
    "formats_cosmos/Cosmos12TimeSeriesTest.v1",
    "formats_cosmos/CE23837.V1C",
    "formats_csmip/RioDell_CHAN001.V2",
    "formats_csmip/CE89146.V1",
    "formats_smc/A-CAT090.AT2.smc",
    "formats_smc/0111a.smc",
    "formats_usc/017m30cc.y0a",
    "formats_knet/AOM0011801241951.EW",
    "formats_esm_dyna/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC",
    "formats_afad/20101114230825_3104_ap_RawAcc_E.asc",
    "formats_afad/20170720223109_0921.txt",
    "formats_resorce/16833_H1.cor.acc",
    "formats_geonet/20161113_110259_WTMC_20.V2A",
    "formats_unam/ACAC1709.191",
    "formats_bhrc/5529-1.V1",
    "formats_renadic/altohospicio0911131.v1",
    "formats_cwb/1-EAS.dat",
    "formats_csmnc/ua0001.dat",
    "formats_evt/BI008_MEMA-04823.evt",
    "formats_sac/20190706031952.CJ.T001230.HNE.sac",
    "formats_mseed_stationxml/CI.CLC..HNE.mseed",
    "formats_csv/sample_acc_3ch.csv",
    "formats_csv/test_motion_dt0p01.txt",
    "formats_peer_at2/120111.th",
)
"""One or two files of each format."""

LONGEST = 2.0  # s of CPU time
"""Seconds one file may take: the limit asked for, a hundred times what the slowest whole file takes."""

_MEMORY = 500 * 2**20
_TOKENS = (
    b"nan", b"inf", b"-", b"1_0", b"1e999", b"0", b"-1", b"99999999999999999999", b"1e9", b"\0", b"\xff", b"\r\r\n",
    b"", b"9" * 400, b".", b"1.2.3", b"1-2", b" ", b",", b":", b"/", b"(", b"-999", b"0.0", b"NaN",
)  # fmt: skip


def insert_token(content: bytes, dice: random.Random) -> bytes:
    """Put in what a program that fails may print, in the place of a number or of nothing."""
    reach = len(content) if dice.random() < 0.3 else min(len(content), 3000)
    at = dice.randrange(max(1, reach))
    number = re.compile(rb"[-+]?[\d.]+").search(content, at) if dice.random() < 0.5 else None
    start, end = number.span() if number else (at, at)
    return content[:start] + dice.choice(_TOKENS) + content[end:]


def mutated(content: bytes, dice: random.Random) -> bytes:
    """Return `content` with one to four things done to it."""
    for _ in range(dice.randint(1, 4)):
        damage = dice.choice([*mutate_records.KINDS.values(), insert_token, insert_token])
        content = damage(content, dice) or b"0"
    return content


def assert_reads_or_refuses(content: bytes, name: str, folder: Path) -> bool:
    """Read `content`; return whether it was read. Anything but accelerograms or RecordError fails."""
    started = time.process_time()
    try:
        records = read_content(content, name, Options(unit=None, time_step=None, folder=folder))
    except RecordError as error:
        records = []
        assert str(error)
    assert time.process_time() - started < LONGEST
    assert all(np.isfinite(record.acceleration).all() and record.time_step > 0 for record in records)
    return bool(records)


def _run(folder: Path, mutations: int, seed: int) -> None:
    dice = random.Random(seed)
    files = {name: (folder / name).read_bytes() for name in SMALL}
    # Small files more often: a mutation of a header costs the same thought, and a tenth of the time.
    names = dice.choices(SMALL, [1 / (20_000 + len(files[name])) for name in SMALL], k=mutations)
    for name, content in files.items():  # what is imported on first use is not the reader's memory
        assert_reads_or_refuses(content, name, (folder / name).parent)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    read = 0
    for i, name in enumerate(names):
        try:
            read += assert_reads_or_refuses(mutated(files[name], dice), name, (folder / name).parent)
        except Exception as error:
            raise AssertionError(f"mutation {i} with seed {seed} of {name} escaped: {error!r}") from error
    assert 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) < _MEMORY
    assert 0 < read < mutations


CANNOT_TELL = {
    *(("columns of numbers", kind) for kind in ("truncate", "drop_line", "cut_bytes")),
    *(("JMA CSV", kind) for kind in ("truncate", "drop_line", "cut_bytes", "repeat_line")),
    ("UNAM/CICESE: repeated last line", "cut_bytes"),
    ("AFAD/NSMN text", "flip_digit"),
}
"""A table without a count of its rows that loses its first or last ones, or has neither count nor times; a file with
two lines too many that loses two others; a time step that stands in one place only."""


def test_damage_does_not_pass_in_silence() -> None:
    """What tests/fuzz/mutate_records.py does at length: two lines exchanged leave no trace, all else is told."""
    kinds = {name: kind for name, kind in mutate_records.KINDS.items() if name != "swap_lines"}
    found = mutate_records.run(mutate_records.made(), 1200, seed=5, kinds=kinds)
    silent = {(name, kind) for name, kind, _ in found if name}
    assert silent <= CANNOT_TELL and found["", "drop_line", "made"] > 100


@pytest.mark.real_records
def test_mutations(real_records: Path) -> None:
    _run(real_records, 700, seed=1)


@pytest.mark.slow
@pytest.mark.real_records
def test_ten_thousand_more(real_records: Path) -> None:
    _run(real_records, 10_000, seed=2)
