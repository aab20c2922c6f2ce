"""The first page of the summary: what becomes of each structure by its worst record, and of each under each record."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from rocking.assessment.verdict import Verdict
from rocking.reports import printing
from rocking.reports.printing import NOTHING, Cell, strong, table

if TYPE_CHECKING:
    from pandas import DataFrame

MOST_MATRIX_RECORDS = 40
"""Records of the matrix, those under which most overturns; verdicts.csv holds all."""
MOST_MATRIX_STRUCTURES = 20
"""Structures of the matrix, in the order of the list."""
_CASE = ["record", "structure"]
_SEVERITY = ["overturning_share", "rotation_ratio_high", "rotation_ratio"]
_BAND = ("rotation_ratio_low", "rotation_ratio_median", "rotation_ratio_high")
_COUNTED = (Verdict.OVERTURNS, Verdict.UNDECIDED, Verdict.STANDS)


def headlines(found: "DataFrame") -> list[dict[str, str]]:
    """Return the first lines: what overturns under some record, what is undecided at worst, what always stands."""
    counts = _counts(found)
    groups: dict[str, list[str]] = {verdict: [] for verdict in _COUNTED}
    for name, of_it in counts.items():
        worst = next((verdict for verdict in _COUNTED if of_it[verdict]), None)
        if worst is None:
            continue
        total = sum(of_it.values())
        told = "" if worst is Verdict.STANDS or total == 1 else f" ({of_it[worst]} of {total} records)"
        groups[worst].append(name + told)
    heads: dict[str, str] = {
        Verdict.OVERTURNS: "Overturns",
        Verdict.UNDECIDED: "Undecided at worst",
        Verdict.STANDS: "Stands under every record that could be assessed",
    }
    return printing.headlines({heads[verdict]: names for verdict, names in groups.items()})


def structure_table(found: "DataFrame") -> dict[str, object]:
    """Return one row per structure: under how many records it overturns, and the record that is worst for it."""
    columns = [
        ("No.", "auto", "r"),
        ("Structure", "1.4", "l"),
        *((printing.sentence(verdict), "auto", "r") for verdict in _COUNTED),
        ("Worst record", "1.4", "l"),
        ("Overturns there in", "auto", "l"),
        ("5–95 % there, of the critical rotation", "1.3", "c"),
    ]
    counts = _counts(found)
    rows = []
    for number, (name, of_it) in enumerate(counts.items(), start=1):
        worst = _worst(found[found["structure"] == name])
        shown: list[Cell] = [str(number), strong(name), *(str(of_it[verdict]) for verdict in _COUNTED)]
        several = printing.of(worst["overturning_members"], worst["members"])
        band = printing.strip([worst[name] for name in _BAND], worst["overturning_share"])
        rows.append([*shown, str(worst["record"]), several, band])
    return table(columns, rows)


def matrix(found: "DataFrame") -> dict[str, object]:
    """Return the shares that overturn by record (the worst first) and structure (by number)."""
    numbers = {name: str(place) for place, name in enumerate(found["structure"].unique(), start=1)}
    shown = list(numbers)[:MOST_MATRIX_STRUCTURES]
    weight = found.groupby("record", sort=False, observed=True)["overturning_share"].sum()
    records = weight.sort_values(ascending=False, kind="stable").index[:MOST_MATRIX_RECORDS]
    cells = found[found["record"].isin(records)].set_index(_CASE)["overturning_share"].to_dict()
    left = [
        (weight.size - len(records), "record"),
        (len(numbers) - len(shown), "structure"),
    ]
    rest = " and ".join(printing.counted(many, noun) for many, noun in left if many)
    return {
        "heads": [numbers[name] for name in shown],
        "rows": [
            {"record": str(record), "cells": [_cell(cells.get((record, name))) for name in shown]}
            for record in records
        ],
        "note": f" Not shown, but in verdicts.csv: {rest}." if rest else "",
    }


def _counts(found: "DataFrame") -> dict[str, dict[str, int]]:
    counts: dict[str, dict[str, int]] = {
        str(name): dict.fromkeys(map(str, _COUNTED), 0) for name in found["structure"].unique()
    }
    for (name, verdict), many in found.groupby(["structure", "verdict"], observed=True).size().items():
        if verdict in _COUNTED:
            counts[str(name)][Verdict(verdict)] = int(many)
    return counts


def _worst(of_it: "DataFrame") -> Mapping[str, Any]:
    ordered = of_it.sort_values(
        ["overturning_share", "rotation_ratio_high", "rotation_ratio"],
        ascending=False,
        na_position="last",
        kind="stable",
    )
    return dict(ordered.iloc[0])


def _cell(share: float | None) -> dict[str, object]:
    if share is None or np.isnan(share):
        return {"text": NOTHING, "share": 0.0}
    digits = 3 if share > 0.99 else 2
    return {"text": printing.given(float(f"{share:.{digits}g}")), "share": float(share)}
