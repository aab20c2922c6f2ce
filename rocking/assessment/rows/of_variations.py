"""Rows about what the answer depends on: where a structure cracks, how the record was processed."""

from collections.abc import Iterable, Sequence

from rocking.assessment.rows.identity import Identity
from rocking.assessment.variations import Candidate, Variant, governing
from rocking.tables import Row


def candidate_rows(identity: Identity, structure: str, found: Sequence[Candidate]) -> list[Row]:
    """The rows of the candidates table of one structure."""
    on_pulse = governing([candidate.predicted for candidate in found])
    on_record = governing([candidate.integrated for candidate in found])
    return [
        identity.head
        | {
            "structure": structure,
            "position_m": candidate.position,
            "predicted_rotation_ratio": candidate.predicted,
            "integrated_rotation_ratio": candidate.integrated,
            "governs_pulse": place == on_pulse,
            "governs_record": place == on_record,
        }
        | identity.provenance
        for place, candidate in enumerate(found)
    ]


def processing_rows(identity: Identity, structure: str, found: Iterable[Variant]) -> list[Row]:
    """The rows of the processing table of one structure."""
    return [
        identity.head
        | {
            "structure": structure,
            "processing": variant.processing,
            "peak_acceleration_m_s2": variant.peak_acceleration,
            "rotation_ratio": variant.rotation_ratio,
            "outcome": variant.outcome,
        }
        | identity.provenance
        for variant in found
    ]
