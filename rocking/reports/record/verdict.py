"""The first page of a record's report: the verdicts, what they amount to, and the warnings above them."""

from collections.abc import Mapping, Sequence

from rocking.reports import printing
from rocking.reports.printing import Cell, Row, number, ratio, strong, table, words

Rows = Sequence[Row]
Tables = Mapping[str, Rows]

_VERDICTS = {
    "agree": "in agreement",
    "unsafe": "UNSAFE: too low",
    "safe": "safe: too high",
    "unknown": "unknown",
}


def verdict_table(rows: Rows, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the first table that a reader sees: one row per structure of one component."""
    columns = [
        ("No.", "auto", "r"),
        ("Structure", "1.2", "l"),
        ("Light", "auto", "l"),
        ("Closed form", "0.65", "r"),
        ("Full inte\u00adgration", "0.65", "r"),
        ("The closed form is", "1.05", "l"),
        ("Regime of the closed form", "1.5", "l"),
        ("Sensi\u00adtivity", "0.45", "r"),
        ("Fragile", "auto", "l"),
    ]
    return table(columns, [_verdict_row(row, numbers) for row in rows])


def _verdict_row(row: Row, numbers: Mapping[str, str]) -> list[Cell]:
    verdict = _VERDICTS.get(row["verdict"], words(row["verdict"]))
    return [
        numbers[row["structure"]],
        row["structure"],
        printing.lamp(row["light"]),
        ratio(row["predicted_rotation_ratio"]),
        strong(_answer(row)),
        strong(verdict) if row["verdict"] == "unsafe" else verdict,
        words(row["regime"]),
        number(row["sensitivity"]),
        strong("YES") if row["fragile"] == "true" else {"false": "no"}.get(row["fragile"], printing.NOTHING),
    ]


def verdict_sentences(rows: Rows) -> list[str]:
    """Return what the verdict table amounts to, in sentences."""
    integrated = [ratio(_found(row)) for row in rows]
    falling = integrated.count("overturns")
    still = integrated.count("no uplift")
    failed = integrated.count(printing.NOTHING)
    rocking = len(rows) - falling - still - failed
    parts = [
        (falling, "overturns", "overturn"),
        (rocking, "rocks and stays up", "rock and stay up"),
        (still, "is not lifted", "are not lifted"),
        (failed, "gave no result", "gave no result"),
    ]
    said = [f"{printing.count(many)} {one if many == 1 else more}" for many, one, more in parts if many]
    total = printing.counted(len(rows), "structure")
    spared = sum(_spared(row) for row in rows)
    how = "by the cheapest trusted method" if spared else "in the full integration"
    sentences = [printing.sentence(f"of {total} {how}: {', '.join(said)}.")] if rows else []
    return sentences + _doubts(rows)


def _spared(row: Row) -> bool:
    """Whether a cheaper method than the full integration answered."""
    return not row["integrated_rotation_ratio"] and bool(row.get("answer_rotation_ratio"))


def _found(row: Row) -> str:
    return row["integrated_rotation_ratio"] or row.get("answer_rotation_ratio", "")


def _answer(row: Row) -> str:
    return ratio(_found(row)) + (f" ({row['answer_method']})" if _spared(row) else "")


def _doubts(rows: Rows) -> list[str]:
    missed = [row for row in rows if row["verdict"] == "unsafe"]
    unsafe = [
        row["structure"] for row in sorted(missed, key=lambda row: -float(row["integrated_rotation_ratio"]))
    ]
    fragile = [row["structure"] for row in rows if row["fragile"] == "true"]
    sentences = []
    if unsafe:
        sentences.append(f"The closed form misses what happens to {printing.listed(unsafe)}.")
    if fragile:
        sentences.append(f"Close to a change of verdict, so not decided: {printing.listed(fragile)}.")
    return sentences


def notices(tables: Tables, failures: Rows) -> list[dict[str, object]]:
    """Return the warnings that stand above everything: scale factor, red light, nothing moves, what failed."""
    rows = tables["comparison"]
    red = [row for row in rows if row["light"] == "red"]
    found = [(True, scale) for scale in [scale_sentence(tables["record"])] if scale]
    if not rows:
        found.append((True, "No structure could be assessed under this record."))
    elif all(ratio(_found(row)) == "no uplift" for row in rows):
        found.append(
            (False, "No structure uplifts: the ground acceleration never reaches an uplift acceleration.")
        )
    if red:
        found.append((True, _red_sentence(red, rows)))
    failing = [
        row for row in tables["responses"] if contact_failure(row) and row["method"] == "mechanism on record"
    ]
    if failing:
        said = dict.fromkeys(f"{row['structure']} ({contact_failure(row)})" for row in failing)
        found.append(
            (True, f"The model does not hold, because a contact fails, for {printing.listed(list(said))}.")
        )
    if not tables["pulses"]:
        found.append(
            (True, "No pulse could be sought in this record, so there is no closed-form prediction.")
        )
    found += [(True, f"{row['structure'] or row['component']}: {row['message']}") for row in failures]
    return [{"strong": loud, "text": text} for loud, text in found]


def _red_sentence(red: Rows, rows: Rows) -> str:
    share = "all" if len(red) == len(rows) else printing.count(len(red))
    of_all = printing.counted(len(rows), "prediction")
    return (
        f"Red light for {share} of {of_all}: one pulse does not stand for this record there, and the closed form then "
        "mostly predicts too little. Use the full integration."
    )


def scale_sentence(rows: Rows) -> str:
    """Return the sentence that declares the scale factors, or nothing when every factor is 1."""
    scaled = [row for row in rows if float(row["scale_factor"] or 1) != 1]
    if not scaled:
        return ""
    named = "; ".join(
        f"component {words(row['component'])}: ×\u00a0{printing.given(row['scale_factor'])}" for row in scaled
    )
    return f"Not the recorded amplitude. The accelerations of the file were multiplied by a declared factor ({named})."


def scale_note(rows: Rows) -> str:
    """Return the short form of the scale sentence for captions and the running head."""
    factors = dict.fromkeys(
        printing.given(row["scale_factor"]) for row in rows if float(row["scale_factor"] or 1) != 1
    )
    return f" Accelerations ×\u00a0{', '.join(factors)}, declared." if factors else ""


def contact_failure(response: Row) -> str:
    """Return how the contacts of a response fail: "slides", "bounces", both, or nothing."""
    return " and ".join(name for name in ("slides", "bounces") if response.get(name) == "true")
