"""How often the closed form was right, by light: counted from the rows of the comparison table, one at a time."""

import math
import statistics
from array import array
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from rocking.tables import Row

LIGHTS = ("green", "amber", "red")


@dataclass
class _Count:
    """What has been counted so far under one light. ratios: predicted over integrated rotation where both rock."""

    records: set[str] = field(default_factory=set)
    cases: int = 0
    ratios: array = field(default_factory=lambda: array("d"))
    within_factor_two: int = 0
    found: int = 0
    missed: int = 0
    false: int = 0
    fragile: int = 0

    def add(self, row: Mapping[str, str]) -> None:
        predicted = math.isinf(float(row["predicted_rotation_ratio"]))
        integrated = math.isinf(float(row["integrated_rotation_ratio"]))
        self.records.add(row["record"])
        self.cases += 1
        if row["prediction_over_integration"]:
            self.ratios.append(float(row["prediction_over_integration"]))
        self.within_factor_two += row["within_factor_two"] == "true"
        self.found += predicted and integrated
        self.missed += integrated and not predicted
        self.false += predicted and not integrated
        self.fragile += row["fragile"] == "true"

    def row(self, light: str) -> Row:
        return {
            "light": light,
            "records": len(self.records),
            "cases": self.cases,
            "both_rock": len(self.ratios),
            "within_factor_two": self.within_factor_two,
            "median_ratio": statistics.median(self.ratios) if self.ratios else None,
            "overturning": self.found + self.missed,
            "overturning_found": self.found,
            "overturning_missed": self.missed,
            "overturning_false": self.false,
            "fragile": self.fragile,
        }


def agreement_rows(comparison: Iterable[Mapping[str, str]]) -> list[Row]:
    """Return the rows of the agreement table from the rows of text of the comparison table."""
    counts = {light: _Count() for light in (*LIGHTS, "all")}
    for row in comparison:
        if row["predicted_rotation_ratio"] and row["integrated_rotation_ratio"]:
            counts[row["light"]].add(row)
            counts["all"].add(row)
    return [count.row(light) for light, count in counts.items()]
