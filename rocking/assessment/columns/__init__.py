"""The columns of every result table, described once."""

from rocking.assessment.columns.of_case import (
    CANDIDATES,
    COMPARISON,
    MAXIMA,
    PREDICTIONS,
    PROCESSING,
    RESPONSES,
)
from rocking.assessment.columns.of_component import PULSES, RECORD
from rocking.assessment.columns.of_study import (
    AGREEMENT,
    EQUIVALENCE,
    FAILURES,
    SPECTRUM,
    STRUCTURES,
    TIMINGS,
)

RECORD_TABLES = (RECORD, PULSES, PREDICTIONS, RESPONSES, COMPARISON, CANDIDATES, PROCESSING)
"""The tables of one record's folder that hold results."""
PER_RECORD = (*RECORD_TABLES, FAILURES, TIMINGS)
"""Every table of one record's folder."""
SUMMARY_TABLES = (RECORD, PULSES, COMPARISON, AGREEMENT, MAXIMA, STRUCTURES, EQUIVALENCE, FAILURES, TIMINGS)
"""The tables of the summary folder."""

__all__ = [
    "AGREEMENT",
    "CANDIDATES",
    "COMPARISON",
    "EQUIVALENCE",
    "FAILURES",
    "MAXIMA",
    "PER_RECORD",
    "PREDICTIONS",
    "PROCESSING",
    "PULSES",
    "RECORD",
    "RECORD_TABLES",
    "RESPONSES",
    "SPECTRUM",
    "STRUCTURES",
    "SUMMARY_TABLES",
    "TIMINGS",
]
