"""How often the closed form was right, by light: counted from the rows of the comparison table."""

import math
import statistics
from collections.abc import Iterable, Mapping, Sequence

from rocking.tables import Column, Row, Table

LIGHTS = ("green", "amber", "red")

RELIABILITY = Table(
    "reliability",
    "One row per light and one for all: the closed form under the dominant pulse against the full integration",
    (
        Column("light", "string", "green, amber or red; all for their sum"),
        Column("records", "integer", "Records behind the row"),
        Column("cases", "integer", "Component and structure pairs with both a prediction and an integration"),
        Column("both_rock", "integer", "Cases in which both rock and stay up"),
        Column(
            "within_factor_two", "integer", "Those whose predicted over integrated rotation lies in [1/2, 2]"
        ),
        Column("median_ratio", "number", "Median of predicted over integrated rotation where both rock"),
        Column("overturning", "integer", "Cases that overturn in the integration"),
        Column("overturning_found", "integer", "Those in which the closed form overturns too"),
        Column("overturning_missed", "integer", "Those in which it does not"),
        Column("overturning_false", "integer", "Cases in which the closed form alone overturns"),
        Column("fragile", "integer", "Cases whose verdict the stated change of amplitude flips"),
    ),
)


def reliability_rows(comparison: Iterable[Mapping[str, str]]) -> list[Row]:
    """Return the rows of RELIABILITY from the rows of text of the comparison table."""
    rows = [row for row in comparison if row["predicted_rotation_ratio"] and row["integrated_rotation_ratio"]]
    by_light = [_counted(light, [row for row in rows if row["light"] == light]) for light in LIGHTS]
    return [*by_light, _counted("all", rows)]


def _counted(light: str, rows: Sequence[Mapping[str, str]]) -> Row:
    predicted = [math.isinf(float(row["predicted_rotation_ratio"])) for row in rows]
    integrated = [math.isinf(float(row["integrated_rotation_ratio"])) for row in rows]
    ratios = [float(row["prediction_over_integration"]) for row in rows if row["prediction_over_integration"]]
    found = sum(both for both in map(all, zip(predicted, integrated, strict=True)))
    return {
        "light": light,
        "records": len({row["record"] for row in rows}),
        "cases": len(rows),
        "both_rock": len(ratios),
        "within_factor_two": sum(row["within_factor_two"] == "true" for row in rows),
        "median_ratio": statistics.median(ratios) if ratios else None,
        "overturning": sum(integrated),
        "overturning_found": found,
        "overturning_missed": sum(integrated) - found,
        "overturning_false": sum(predicted) - found,
        "fragile": sum(row["fragile"] == "true" for row in rows),
    }
