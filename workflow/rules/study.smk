"""What is studied: settings, records and structures, checked before the first job starts."""

from pathlib import Path  # for the rules

from rocking.assessment.rows.of_study import SUMMARY_TABLES
from rocking.study.outcome import check_any_read
from rocking.study.parts import IN_PARTS, part
from rocking.study.plan import make_plan, package_sha256

# What the user writes (catalogue, records, StationXML, structures) is watched by its content, in params, not as input:
# snakemake goes by dates, and behind a file that is dated in the future it removes what a job wrote.
PLAN = make_plan(config)
SETTINGS = PLAN.settings
PACKAGE = package_sha256()
RESULTS = SETTINGS.results
SUMMARY = f"{RESULTS}/summary"
SUMMARIES = [each.table.name for each in SUMMARY_TABLES]
FRAGILITY = f"{RESULTS}/fragility/fragility.csv"


def tables_of(*jobs):
    """The tables of jobs, each of which holds the rows of all its records."""
    return [f"{part(Path(RESULTS), job)}/{each.table.file_name}" for job in jobs for each in IN_PARTS]


TARGETS = [f"{SUMMARY}/{table}.csv" for table in SUMMARIES]
TARGETS += [f"{SUMMARY}/provenance.json", f"{SUMMARY}/datapackage.json"]
if SETTINGS.reports:
    TARGETS += [f"{RESULTS}/{record}/report.pdf" for record in PLAN.records] + [f"{SUMMARY}/summary.pdf"]
    TARGETS += [f"{SUMMARY}/prediction_against_integration.svg", f"{SUMMARY}/study.html"]
if SETTINGS.histories:
    TARGETS += [f"{RESULTS}/{record}/histories.csv" for record in PLAN.records]
if SETTINGS.fragility.in_every_run:
    TARGETS += [f"{RESULTS}/fragility/fragility.pdf"]
