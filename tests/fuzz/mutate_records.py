"""Mutated records: which damage a reader lets pass without a word, by format and kind.

    python tests/fuzz/mutate_records.py [--mutants 30000] [--seed 1] [--blocks]

Each mutant is a whole file with one thing done to it, as disks, editors and transfers do: a line repeated, dropped or
swapped with its neighbour, a digit changed, bytes cut, the end missing, the file appended to itself; with --blocks,
many lines zeroed, or copied over others. It is silent when it is read with no warning that the whole file does not
give, and yet the time step, the number of channels or more than three samples differ. Files are the made ones of the
contract tests, of 403 samples, and with ROCKING_RECORDS set real ones.
"""

import argparse
import csv
import os
import random
import re
import sys
import warnings
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

import numpy as np

sys.path.append(str(Path(__file__).parents[1] / "contracts"))

import made_files

from rocking.errors import RecordError
from rocking.records import Accelerogram
from rocking.records.formats import Options
from rocking.records.read import read_content

SAMPLES = 403
"""Not a multiple of what any format puts on a line."""
NOTICED = 3
"""Samples that may differ: what one flipped byte reaches."""


@dataclass(frozen=True)
class Whole:
    """A file as it should be: its content, what the caller declares, and what is read from it."""

    name: str
    content: bytes
    options: Options

    def read(self, content: bytes) -> list[Accelerogram]:
        """Return the channels of `content` read as this file is."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read_content(content, self.name, self.options)


def made() -> list[Whole]:
    """Return a file of each format, made with more samples than the contract tests take."""
    times = np.arange(SAMPLES) * made_files.STEP
    values = 0.9 * np.sin(7 * times) * np.exp(-((times - 2) ** 2)) + 0.01 * np.sin(61 * times)
    every = made_files.MADE | made_files.MADE_BINARY
    with patch.multiple(made_files, N=SAMPLES, TRUE=values):
        return [Whole(label, made_files.content_of(label), every[label][2]) for label in every]


def real(folder: Path) -> list[Whole]:
    """Return the smallest real file of each format in the manifest of `folder`, of those that can be read."""
    from test_formats import REFUSED, TRUNCATED, declared

    with (folder / "manifest.tsv").open(encoding="utf-8") as stream:
        rows = sorted(csv.DictReader(stream, delimiter="\t"), key=lambda row: -int(row["size"]))
    small = {row["format"]: row for row in rows if not row["file"].endswith((*REFUSED, *TRUNCATED))}
    paths = {folder / row["file"]: declared(row) for row in small.values()}
    return [Whole(at.name, at.read_bytes(), Options(folder=at.parent, **more)) for at, more in paths.items()]


def _line(content: bytes, dice: random.Random) -> tuple[int, int]:
    at = dice.randrange(len(content))
    return content.rfind(b"\n", 0, at) + 1, content.find(b"\n", at) + 1 or len(content)


def repeat_line(content: bytes, dice: random.Random) -> bytes:
    start, end = _line(content, dice)
    return content[:end] + content[start:end] + content[end:]


def drop_line(content: bytes, dice: random.Random) -> bytes:
    start, end = _line(content, dice)
    return content[:start] + content[end:]


def swap_lines(content: bytes, dice: random.Random) -> bytes:
    start, end = _line(content, dice)
    after = content.find(b"\n", end) + 1 or len(content)
    return content[:start] + content[end:after] + content[start:end] + content[after:]


def flip_digit(content: bytes, dice: random.Random) -> bytes:
    digits = [m.start() for m in re.finditer(rb"\d", content[:4000] if dice.random() < 0.6 else content)]
    at = dice.choice(digits or [0])
    return content[:at] + bytes([48 + (content[at] - 48 + dice.randint(1, 9)) % 10]) + content[at + 1 :]


def cut_bytes(content: bytes, dice: random.Random) -> bytes:
    at = dice.randrange(len(content))
    return content[:at] + content[at + dice.randint(1, 200) :]


KINDS: Mapping[str, Callable[[bytes, random.Random], bytes]] = {
    **{kind.__name__: kind for kind in (repeat_line, drop_line, swap_lines, flip_digit, cut_bytes)},
    "truncate": lambda content, dice: content[: dice.randrange(1, len(content))],
    "append": lambda content, dice: 2 * content,
}


def _block(content: bytes, dice: random.Random) -> tuple[list[bytes], int, int]:
    """Return the lines of a text, and the first and the end of a block of ten to forty in its second half."""
    rows = content.split(b"\n")
    size = min(dice.randint(10, 40), len(rows) // 4)
    start = dice.randrange(len(rows) // 2, len(rows) - size)
    return rows, start, start + size


def zero_lines(content: bytes, dice: random.Random) -> bytes:
    rows, start, end = _block(content, dice)
    rows[start:end] = [re.sub(rb"\d", b"0", row) for row in rows[start:end]]
    return b"\n".join(rows)


def copy_lines(content: bytes, dice: random.Random) -> bytes:
    rows, start, end = _block(content, dice)
    size = end - start
    target = dice.randrange(len(rows) // 2, len(rows) - size)
    rows[target : target + size] = rows[start:end]
    return b"\n".join(rows)


BLOCKS: Mapping[str, Callable[[bytes, random.Random], bytes]] = {
    kind.__name__: kind for kind in (zero_lines, copy_lines)
}
"""Of texts only: what an editor does to many lines at once."""


def silent_difference(whole: Whole, content: bytes, expected: list[Accelerogram]) -> str | None:
    """Return what differs when `content` is read without a word; None when nothing, or when it is said or refused."""
    try:
        records = whole.read(content)
    except RecordError:
        return None
    known = {warning for record in expected for warning in record.warnings}
    if {warning for record in records for warning in record.warnings} - known:
        return None
    if len(records) != len(expected):
        return "channels"
    for record, true in zip(records, expected, strict=True):
        if abs(record.time_step / true.time_step - 1) > 1e-6:
            return "time step"
        if record.acceleration.size != true.acceleration.size:
            return "samples"
        apart = record.acceleration - true.acceleration
        apart -= np.median(apart)  # a mean over the record, moved by one of its samples
        if (np.abs(apart) > 1e-9 * max(1e-12, true.peak_acceleration)).sum() > NOTICED:
            return "samples"
    return None


def run(wholes: list[Whole], mutants: int, seed: int, kinds: Mapping = KINDS) -> Counter:
    """Return how often damage passed in silence, by (file, kind, what differs); ("", kind, "made") counts mutants."""
    dice = random.Random(seed)
    found: Counter[tuple[str, str, str]] = Counter()
    expected = {whole.name: whole.read(whole.content) for whole in wholes}
    for _ in range(mutants):
        whole = dice.choice(wholes)
        kind = dice.choice(list(kinds))
        content = kinds[kind](whole.content, dice)
        found["", kind, "made"] += 1
        if content != whole.content and (what := silent_difference(whole, content, expected[whole.name])):
            found[whole.name, kind, what] += 1
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mutants", type=int, default=30_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--blocks", action="store_true")
    options = parser.parse_args()
    folder = os.environ.get("ROCKING_RECORDS")
    kinds = BLOCKS if options.blocks else KINDS
    found = run(made() + (real(Path(folder)) if folder else []), options.mutants, options.seed, kinds)
    for (name, kind, what), count in sorted(found.items(), key=lambda item: (item[0][1], -item[1])):
        print(f"{kind:12} {count:6} {what:10} {name}")


if __name__ == "__main__":
    main()
