"""How the closed form stands to the integration, and the warnings that stand above everything in a report."""

import math
from collections.abc import Mapping, Sequence

from rocking.assessment.method import Method
from rocking.assessment.rows.of_case import ComparisonRow, MaximumRow
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import RecordRow
from rocking.assessment.verdict import Agreement, rests
from rocking.reports import printing
from rocking.reports.printing import ratio, short, strong, table_of, words
from rocking.structures.outcome import Outcome


def verdict_table(tables: RecordTables, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return how the simple predictions of one component stand to the integration: one row per structure."""
    blocks = tables.by_method(Method.BLOCK_ON_RECORD)
    return table_of(
        tables.comparison,
        ("No.", "auto", "r", lambda row: numbers[row.structure]),
        ("Structure", "1", "l", lambda row: short(row.structure)),
        ("Closed form, one pulse", "0.68", "r", lambda row: _ratio(row.predicted_rotation_ratio)),
        ("Block, whole record", "0.68", "r", lambda row: _ratio(_of(blocks.get(row.case)))),
        (
            "Mecha\u00adnism, whole record",
            "0.68",
            "r",
            lambda row: strong(
                _ratio(row.integrated_rotation_ratio) + (f" ({row.answer_method})" if row.spared else "")
            ),
        ),
        (
            "The closed form is",
            "1",
            "l",
            lambda row: strong(words(row.prediction_in_words), row.agreement is Agreement.TOO_LOW),
        ),
    )


def _of(row: MaximumRow | None) -> float:
    return row.rotation_ratio if row else math.nan


def _ratio(value: float) -> str:
    """A rotation ratio, in words where it is too small to be more than rest."""
    return "rests" if value > 0 and rests(value) else ratio(value)


def doubts(rows: Sequence[ComparisonRow]) -> list[str]:
    """Return what the closed form misses, as a sentence or nothing."""
    missed = [row for row in rows if row.agreement is Agreement.TOO_LOW]
    unsafe = [row.structure for row in sorted(missed, key=lambda row: -row.integrated_rotation_ratio)]
    return [f"The closed form misses what happens to {printing.listed(unsafe)}."] if unsafe else []


def notices(tables: RecordTables) -> list[dict[str, object]]:
    """Return the warnings that stand above everything: scale factor, nothing moves, what failed."""
    rows, scale = tables.comparison, scale_sentence(tables.record)
    found = [(True, scale)] if scale else []
    if not rows:
        found.append((True, "No structure could be assessed under this record."))
    elif all(row.answer_outcome is Outcome.NO_UPLIFT for row in rows):
        found.append(
            (False, "No structure uplifts: the ground acceleration never reaches an uplift acceleration.")
        )
    whole = tables.by_method(Method.MECHANISM_ON_RECORD).values()
    said = dict.fromkeys(f"{row.structure} ({failing})" for row in whole if (failing := contact_failure(row)))
    if said:
        found.append(
            (True, f"The model does not hold, because a contact fails, for {printing.listed(list(said))}.")
        )
    if not tables.pulses:
        found.append(
            (True, "No pulse could be sought in this record, so there is no closed-form prediction.")
        )
    found += [(True, f"{row.structure or row.component}: {row.message}") for row in tables.failures]
    return [{"strong": loud, "text": text} for loud, text in found]


def scale_sentence(rows: Sequence[RecordRow]) -> str:
    """Return the sentence that declares the scale factors, or nothing when every factor is 1."""
    named = "; ".join(
        f"component {words(row.component)}: ×\u00a0{printing.given(row.scale_factor)}"
        for row in rows
        if row.scale_factor != 1
    )
    if not named:
        return ""
    return f"Not the recorded amplitude. The accelerations of the file were multiplied by a declared factor ({named})."


def scale_note(rows: Sequence[RecordRow]) -> str:
    """Return the short form of the scale sentence for captions and the running head."""
    factors = dict.fromkeys(printing.given(row.scale_factor) for row in rows if row.scale_factor != 1)
    return f" Accelerations ×\u00a0{', '.join(factors)}, declared." if factors else ""


def contact_failure(response: MaximumRow) -> str:
    """Return how the contacts of a response fail: "slides", "bounces", both, or nothing."""
    return " and ".join(name for name in ("slides", "bounces") if getattr(response, name))
