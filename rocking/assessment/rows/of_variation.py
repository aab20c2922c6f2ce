"""Rows about a structure that cracks elsewhere, and about a record that is processed otherwise."""

from collections.abc import Iterable, Iterator, Sequence
from typing import final

from rocking.assessment.rows import meanings
from rocking.assessment.rows.shared import CaseRow, Identity
from rocking.assessment.variations import Candidate, Variant, governing
from rocking.structures.outcome import Outcome
from rocking.tables import column, row


@row(
    "candidates",
    "One row per height at which a wall may be hinged or a spire cracked: the governing height is marked",
)
@final
class CandidateRow(CaseRow):
    """One height at which a structure may crack."""

    position_m: float = column("Height of the hinge or of the crack above the base")
    predicted_rotation_ratio: float = column("Exact maximum of its equivalent block under the dominant pulse")
    integrated_rotation_ratio: float = column("Its mechanism under the whole record")
    governs_pulse: bool = column("Whether it rotates most under the pulse; the lowest of those that overturn")
    governs_record: bool = column(
        "Whether it rotates most under the record; the lowest of those that overturn"
    )


@row(
    "processing",
    "One row per structure and processing of the record: what the answer owes to baseline and corner frequency",
)
class ProcessingRow(CaseRow):
    """One case under the record processed otherwise."""

    processing: str = column("What was done to the record besides what the record table says")
    peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration then")
    rotation_ratio: float = column(meanings.ROTATION_RATIO)
    outcome: Outcome = column(meanings.OUTCOME)


def candidate_rows(identity: Identity, structure: str, found: Sequence[Candidate]) -> Iterator[CandidateRow]:
    """Yield the row of each height at which one structure may crack."""
    on_pulse = governing([candidate.predicted for candidate in found])
    on_record = governing([candidate.integrated for candidate in found])
    for place, candidate in enumerate(found):
        yield CandidateRow(
            **identity.columns,
            structure=structure,
            position_m=candidate.position,
            predicted_rotation_ratio=candidate.predicted,
            integrated_rotation_ratio=candidate.integrated,
            governs_pulse=place == on_pulse,
            governs_record=place == on_record,
        )


def processing_rows(identity: Identity, structure: str, found: Iterable[Variant]) -> Iterator[ProcessingRow]:
    """Yield the row of each processing of the record for one structure."""
    for variant in found:
        yield ProcessingRow(
            **identity.columns,
            structure=structure,
            processing=variant.processing,
            peak_acceleration_m_s2=variant.peak_acceleration,
            rotation_ratio=variant.rotation_ratio,
            outcome=variant.outcome,
        )
