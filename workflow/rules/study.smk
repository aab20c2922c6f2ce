"""What is studied: settings, records and structures, checked before the first job starts."""

from pathlib import Path  # for the rules

from rocking.assessment import columns
from rocking.study.plan import make_plan, package_sha256

PLAN = make_plan(config)
SETTINGS = PLAN.settings
PACKAGE = package_sha256()
RESULTS = SETTINGS.results
SUMMARY = f"{RESULTS}/summary"
TABLES = [table.name for table in columns.PER_RECORD]
SUMMARIES = [table.name for table in columns.SUMMARY_TABLES]


def record_files(records, *names):
    return [f"{RESULTS}/{record}/{name}" for record in records for name in names]


CSV = [f"{table}.csv" for table in TABLES]
TARGETS = [f"{SUMMARY}/{table}.csv" for table in SUMMARIES]
TARGETS += [f"{SUMMARY}/provenance.json", f"{SUMMARY}/datapackage.json"]
if SETTINGS.reports:
    TARGETS += record_files(PLAN.records, "report.pdf") + [f"{SUMMARY}/summary.pdf"]
    TARGETS += [f"{SUMMARY}/prediction_against_integration.svg"]
