"""The rows of the result tables: each column says what it means, and is filled by name.

Rows about a record and about a study are imported from here; those of a product over all records stand in its folder.
"""

from rocking.assessment.rows.of_inputs import RECORD as RECORD
from rocking.assessment.rows.of_inputs import CapacityRow as CapacityRow
from rocking.assessment.rows.of_inputs import Identity as Identity
from rocking.assessment.rows.of_inputs import PlacedRow as PlacedRow
from rocking.assessment.rows.of_inputs import PulseRow as PulseRow
from rocking.assessment.rows.of_inputs import RecordRow as RecordRow
from rocking.assessment.rows.of_inputs import StructureRow as StructureRow
from rocking.assessment.rows.of_inputs import capacity_rows as capacity_rows
from rocking.assessment.rows.of_inputs import pulse_rows as pulse_rows
from rocking.assessment.rows.of_inputs import record_row as record_row
from rocking.assessment.rows.of_inputs import structure_rows as structure_rows
from rocking.assessment.rows.of_record import RATIO_COLUMNS as RATIO_COLUMNS
from rocking.assessment.rows.of_record import RECORD_TABLES as RECORD_TABLES
from rocking.assessment.rows.of_record import ComparisonRow as ComparisonRow
from rocking.assessment.rows.of_record import FailureRow as FailureRow
from rocking.assessment.rows.of_record import HistoryRow as HistoryRow
from rocking.assessment.rows.of_record import MechanismRow as MechanismRow
from rocking.assessment.rows.of_record import PredictionRow as PredictionRow
from rocking.assessment.rows.of_record import RecordRows as RecordRows
from rocking.assessment.rows.of_record import SupportRow as SupportRow
from rocking.assessment.rows.of_record import TimingRow as TimingRow
from rocking.assessment.rows.of_record import VariationRow as VariationRow
from rocking.assessment.rows.of_record import VerdictRow as VerdictRow
from rocking.assessment.rows.of_record import WarningRow as WarningRow
from rocking.assessment.rows.of_record import comparison_row as comparison_row
from rocking.assessment.rows.of_record import counted_cases as counted_cases
from rocking.assessment.rows.of_record import history_rows as history_rows
from rocking.assessment.rows.of_record import identities_of as identities_of
from rocking.assessment.rows.of_record import prediction_row as prediction_row
from rocking.assessment.rows.of_record import rows_of_record as rows_of_record
from rocking.assessment.rows.of_record import verdict_row as verdict_row
from rocking.assessment.rows.of_record import worst_period_each as worst_period_each
from rocking.assessment.rows.of_study import SUMMARY_TABLES as SUMMARY_TABLES
from rocking.assessment.rows.of_study import AgreementRow as AgreementRow
from rocking.assessment.rows.of_study import ExpectedFallsRow as ExpectedFallsRow
from rocking.assessment.rows.of_study import SpectrumRow as SpectrumRow
from rocking.assessment.rows.of_study import agreement_rows as agreement_rows
from rocking.assessment.rows.of_study import counted_apart as counted_apart
from rocking.assessment.rows.of_study import falls_over as falls_over
from rocking.assessment.rows.of_study import falls_recorded as falls_recorded
from rocking.assessment.rows.of_study import falls_under as falls_under
from rocking.assessment.rows.of_study import hardly_spread as hardly_spread
from rocking.assessment.rows.of_study import interval_of_mean as interval_of_mean
from rocking.assessment.rows.of_study import made_records as made_records
from rocking.assessment.rows.of_study import named_records as named_records
from rocking.assessment.rows.of_study import sample_of_records as sample_of_records
from rocking.assessment.rows.of_study import spectrum_rows as spectrum_rows
