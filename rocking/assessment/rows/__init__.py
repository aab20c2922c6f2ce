"""The rows of the result tables: each class says what its columns are, and a function beside it fills them."""

from rocking.assessment.rows.of_case import (
    ComparisonRow,
    MaximumRow,
    ResponseRow,
    comparison_row,
    maximum_row,
)
from rocking.assessment.rows.of_ensemble import (
    BOTH_COMPONENTS,
    EnsembleRow,
    ensemble_row,
    governing_ensembles,
)
from rocking.assessment.rows.of_folder import PER_RECORD, RECORD_TABLES, RecordTables
from rocking.assessment.rows.of_prediction import (
    PredictionRow,
)
from rocking.assessment.rows.of_record import FailureRow, PulseRow, RecordRow, TimingRow, failure_row
from rocking.assessment.rows.of_study import (
    AgreementRow,
    CapacityRow,
    EquivalenceRow,
    SpectrumRow,
    StructureRow,
    agreement_rows,
    capacity_rows,
    equivalence_rows,
    spectrum_rows,
    structure_rows,
)
from rocking.assessment.rows.of_variation import (
    CandidateRow,
    ProcessingRow,
    candidate_rows,
    processing_rows,
)
from rocking.assessment.rows.shared import CaseRow, ComponentRow, Identity
from rocking.tables import Row

SUMMARY_TABLES: tuple[type[Row], ...] = (
    RecordRow,
    PulseRow,
    ComparisonRow,
    EnsembleRow,
    AgreementRow,
    MaximumRow,
    StructureRow,
    EquivalenceRow,
    CapacityRow,
    FailureRow,
    TimingRow,
)
"""The rows of the tables of the summary folder."""

__all__ = [
    "BOTH_COMPONENTS",
    "PER_RECORD",
    "RECORD_TABLES",
    "SUMMARY_TABLES",
    "AgreementRow",
    "CandidateRow",
    "CapacityRow",
    "CaseRow",
    "ComparisonRow",
    "ComponentRow",
    "EnsembleRow",
    "EquivalenceRow",
    "FailureRow",
    "Identity",
    "MaximumRow",
    "PredictionRow",
    "ProcessingRow",
    "PulseRow",
    "RecordRow",
    "RecordTables",
    "ResponseRow",
    "SpectrumRow",
    "StructureRow",
    "TimingRow",
    "agreement_rows",
    "candidate_rows",
    "capacity_rows",
    "comparison_row",
    "ensemble_row",
    "equivalence_rows",
    "failure_row",
    "governing_ensembles",
    "maximum_row",
    "processing_rows",
    "spectrum_rows",
    "structure_rows",
]
