"""Mutated files: whatever is done to a file, reading it ends in accelerograms or in our own error, and soon."""

import math
import random
import re
import resource
import time
from pathlib import Path

import mutate_records
import numpy as np
import pytest

from rocking.errors import RecordError

LONGEST = 2.0
"""Seconds of CPU time one file may take: the limit asked for, a hundred times what the slowest whole file takes."""

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


def assert_reads_or_refuses(whole: mutate_records.Whole, content: bytes) -> bool:
    """Read `content`; return whether it was read. Anything but accelerograms or RecordError fails."""
    started = time.process_time()
    try:
        records = whole.read(content)
    except RecordError as error:
        records = []
        assert str(error)
    assert time.process_time() - started < LONGEST
    assert all(np.isfinite(record.acceleration).all() and record.time_step > 0 for record in records)
    return bool(records)


CANNOT_TELL = {
    *(("columns of numbers", kind) for kind in ("truncate", "drop_line", "cut_bytes")),
    *(("JMA CSV", kind) for kind in ("truncate", "drop_line", "cut_bytes", "repeat_line")),
    ("UNAM/CICESE: repeated last line", "cut_bytes"),
    ("AFAD/NSMN text", "flip_digit"),
    ("GSE", "flip_digit"),
}
"""A table without a count of its rows that loses its first or last ones, or has neither count nor times; a file with
two lines too many that loses two others; a time step that stands in one place only."""


@pytest.mark.parametrize("mutations", [300, pytest.param(1200, marks=pytest.mark.slow)])
def test_damage_does_not_pass_in_silence(mutations: int) -> None:
    """What tests/fuzz/mutate_records.py does at length: two lines exchanged leave no trace, all else is told."""
    kinds = dict(mutate_records.KINDS)
    del kinds["swap_lines"]
    found = mutate_records.run(mutate_records.made(), mutations, seed=5, kinds=kinds)
    silent = {(name, kind) for name, kind, _ in found if name}
    assert silent <= CANNOT_TELL and found["", "drop_line", "made"] > mutations / 12


@pytest.mark.real_records
@pytest.mark.parametrize(
    ("mutations", "seed", "largest"),
    [(200, 1, 200_000), pytest.param(10_000, 2, math.inf, marks=pytest.mark.slow)],
)
def test_a_mutated_file_is_read_or_refused(
    real_records: Path, mutations: int, seed: int, largest: float
) -> None:
    dice = random.Random(seed)
    wholes = [whole for whole in mutate_records.real(real_records) if len(whole.content) <= largest]
    for whole in wholes:  # what is imported on first use is not the reader's memory
        assert_reads_or_refuses(whole, whole.content)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    read = 0
    # Small files more often: a mutation of a header costs the same thought, and a tenth of the time.
    weights = [1 / (20_000 + len(whole.content)) for whole in wholes]
    kinds = [*mutate_records.KINDS.values(), insert_token, insert_token]
    for i, whole in enumerate(dice.choices(wholes, weights, k=mutations)):
        content = whole.content
        for damage in dice.choices(kinds, k=dice.randint(1, 4)):
            content = damage(content, dice) or b"0"
        try:
            read += assert_reads_or_refuses(whole, content)
        except Exception as error:
            raise AssertionError(f"mutation {i}, seed {seed}, of {whole.name} escaped: {error!r}") from error
    assert 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) < _MEMORY
    assert 0 < read < mutations
