"""Figures that campaigns measured and that reports print: each with its source, and the page that explains it."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Measured:
    """A figure as it is printed. page: of the documents, that explains it. source: the campaign that measured it."""

    figure: str
    page: str
    source: str


def _read() -> Mapping[str, Measured]:
    with Path(__file__).with_name("measured.csv").open(encoding="utf-8", newline="") as stream:
        return {row.pop("name"): Measured(**row) for row in csv.DictReader(stream)}


MEASURED = _read()
"""The figures of measured.csv, by name."""
