"""Rows are filled from what they are named after: nothing stands in the column of something else."""

import ast
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from rocking.assessment import rows
from rocking.assessment.assess import assess_record
from rocking.assessment.scene import on_the_ground
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Block

PATHS = sorted(Path(rows.__file__).parent.glob("of_*.py"))


def within(name: str, longer: str) -> bool:
    """Whether the words of `name` stand in `longer`, one after another."""
    return f"_{name}_" in f"_{longer}_"


def names_in(value: ast.expr) -> set[str]:
    """The names of what a value is made from: `high` of `reserve.high`, `p_value` of `explained.get("p_value")`."""
    match value:
        case ast.Attribute(attr=name) | ast.Name(id=name) | ast.Constant(value=str(name)):
            return {name}
        case ast.IfExp(body=one, orelse=other) | ast.BinOp(left=one, right=other):
            return names_in(one) | names_in(other)
        case ast.Subscript(value=whole, slice=ast.Constant(value=str(name))):
            return {name}
        case ast.Subscript(value=whole):
            return names_in(whole)
        case ast.Call(func=function, args=arguments):
            return names_in(function) | {name for each in arguments for name in names_in(each)}
    return set()


def misplaced(source: str) -> Iterator[str]:
    """Yield the columns that are filled from what another column of the same row is named after."""
    for call in ast.walk(ast.parse(source)):
        if not isinstance(call, ast.Call):
            continue
        columns = {each.arg for each in call.keywords if each.arg}
        for each in call.keywords:
            if not each.arg:
                continue
            names = names_in(each.value)
            if any(within(name, each.arg) for name in names):
                continue
            is_named_otherwise = any(within(name, column) for name in names for column in columns)
            # As "crack" of `structure.crack_name`.
            begins_otherwise = any(within(column, name) for name in names for column in columns)
            begins_so = any(within(each.arg, name) for name in names)
            if is_named_otherwise or (begins_otherwise and not begins_so):
                yield each.arg


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_column_is_filled_from_what_it_is_named_after(path):
    assert list(misplaced(path.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize(
    "arguments",
    [
        "members=ensemble.overturning_members, overturning_members=ensemble.members",
        "reserve_low=reserve.high, reserve_high=reserve.low",
        "critical_rotation_rad=side.uplift_multiplier, uplift_multiplier=side.critical_rotation",
        "low=some.high if some else None, high=some.low if some else None",
        "low=float(some.high[0]), high=float(some.low[0])",
        "low=made(high), high=made(low)",
        "slope=explained.get('p_value', nan), p_value=explained['slope']",
    ],
)
def test_two_columns_that_change_places_are_seen(arguments):
    assert list(misplaced(f"Row({arguments})"))


def test_the_counts_and_quantiles_of_rows_are_those_of_the_members():
    """A block that a part of its members overturns; the members are counted anew."""
    motion = Pulse(3.5, 2 * np.pi / 0.8, 2.0).acceleration(np.arange(1000) * 0.01)
    record = Accelerogram(motion, 0.01, component="H1")
    result = assess_record("made", [record], on_the_ground({"block": Block(2.0, 0.2)}))
    (case,) = result.stations[0].cases.values()
    ratios = case.ensembles.governing.ensemble.rotation_ratios
    falls = int(np.isposinf(ratios).sum())
    assert 0 < falls < ratios.size / 2

    tables = rows.rows_of_record(result)
    for row in (*tables.ensemble, *tables.verdicts):
        assert (row.overturning_members, row.members) == (falls, ratios.size)
        assert row.overturning_share == falls / ratios.size
        ordered = np.sort(ratios)
        assert ordered[0] <= row.rotation_ratio_low < ordered[ratios.size // 8]
        assert ordered[ratios.size // 2 - 1] <= row.rotation_ratio_median
        assert row.rotation_ratio_median <= ordered[ratios.size // 2]
        assert row.rotation_ratio_high == np.inf  # more than a twentieth of the members overturn
    (verdict,) = tables.verdicts
    assert 0 < verdict.reserve_low < verdict.reserve_median < verdict.reserve_high <= verdict.reserve_limit
