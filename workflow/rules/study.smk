"""What is studied: settings, records and structures, checked before the first job starts."""

import os
from pathlib import Path  # for the rules

from rocking.study import close_doors

close_doors()  # before the imports that open them

from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES
from rocking.hashes import sha256_of
from rocking.study.plan import check_config_file, config_file, make_plan
from rocking.study.results import PAGE, part
from rocking.study.run import begin
from rocking.study.seal import SEAL, TRADE_SEAL, remove_broken_seals
from rocking.study.sharing import shared_by_work
from rocking.study.terminal import check_any_read, tell
from snakemake.utils import update_config

# What the user writes (catalogue, records, StationXML, structures) is watched by its content, in params, not as input:
# snakemake goes by dates, and behind a file that is dated in the future it removes what a job wrote.
for FILE in workflow.overwrite_configfiles:
    check_config_file(Path(FILE))
if not workflow.overwrite_configfiles:
    # Not by `configfile:`, which an alias bomb or a pipe of that name would keep for ever. Else the shipped example.
    FILE = config_file(Path()) or Path(workflow.basedir, "workflow", "config.yaml")
    CONFIG = check_config_file(FILE)
    update_config(CONFIG, config)  # what --config says
    config.update(CONFIG)
PLAN = shared_by_work(make_plan(config))
if workflow.is_main_process:
    for SENTENCE in remove_broken_seals(PLAN):
        tell("results", SENTENCE)
# The page that snakemake --report makes shows captions and params as they stand: no text of a study may be in them, only its
# hashes.
SETTINGS = PLAN.settings
PACKAGE = PLAN.package_sha256
RESULTS = SETTINGS.results
SUMMARY = f"{RESULTS}/summary"
FRAGILITY = f"{RESULTS}/fragility/fragility.csv"


def part_of(job):
    """The files of a job over all its records."""
    return [
        f"{part(Path(RESULTS), job)}/{name}"
        for name in (*(each.table.file_name for each in RECORD_TABLES), PAGE, SEAL)
    ]


def own_of(job):
    """The files of each record of a job, where the settings ask for them."""
    names = ["report.pdf"] * SETTINGS.reports + ["histories.csv"] * SETTINGS.histories
    return [f"{RESULTS}/{record}/{name}" for record in PLAN.jobs[job] for name in names]


def in_report(name, caption, category, **labels):
    """A file of the summary, with its place in the page that snakemake --report makes."""
    return report(f"{SUMMARY}/{name}", caption=f"../report/{caption}.rst", category=category, labels=labels)


TARGETS = [f"{SUMMARY}/{each.table.file_name}" for each in SUMMARY_TABLES]
TARGETS += [f"{SUMMARY}/{name}" for name in ("provenance.json", "datapackage.json", SEAL)]
TARGETS += [path for job in PLAN.jobs for path in (*part_of(job), *own_of(job))]
if SETTINGS.reports:
    TARGETS += [
        f"{SUMMARY}/{name}" for name in ("summary.pdf", "prediction_against_integration.svg", "study.html")
    ]
    TARGETS += [f"{SUMMARY}/study.xlsx"]
if SETTINGS.design_spectrum.ag or SETTINGS.design_spectrum.points:
    TARGETS += [f"{SUMMARY}/code_checks.csv", f"{SUMMARY}/structures.pdf"]
if SETTINGS.fragility.in_every_run:
    TARGETS += [f"{RESULTS}/fragility/fragility.pdf", f"{RESULTS}/fragility/{SEAL}"]
