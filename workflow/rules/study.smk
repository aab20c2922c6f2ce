"""What is studied: settings, records and structures, checked before the first job starts; and when a job runs again."""

import re
import sys
from pathlib import Path

from rocking.study import close_doors

close_doors()  # before the imports that open them

from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES
from rocking.hashes import sha256_of
from rocking.study.fork_server import leave as leave_fork_server
from rocking.study.fork_server import start as start_fork_server
from rocking.study.plan import check_config_file, config_file, make_plan
from rocking.study.results import kept_of, outcome_of
from rocking.study.run import begin
from rocking.study.settings import package_sha256, structure_hashes
from rocking.study.terminal import check_any_read
from snakemake.utils import update_config

# What the user writes (catalogue, records, StationXML, structures) is watched by its content, not as input: snakemake goes
# by dates, and behind a file that is dated in the future it removes what a job wrote.
for FILE in workflow.overwrite_configfiles:
    check_config_file(Path(FILE))
if not workflow.overwrite_configfiles:
    # Not by `configfile:`, which an alias bomb or a pipe of that name would keep for ever. Else the shipped example.
    FILE = config_file(Path()) or Path(workflow.basedir, "workflow", "config.yaml")
    CONFIG = check_config_file(FILE)
    update_config(CONFIG, config)  # what --config says
    config.update(CONFIG)
PLAN = make_plan(config)
SEALS = PLAN.seals
SETTINGS = PLAN.settings
if not workflow.is_main_process:  # on another machine, or within limits of its own
    leave_fork_server()
    start_fork_server(SETTINGS)
RESULTS = SETTINGS.results
SUMMARY = f"{RESULTS}/summary"
DRAWS = SETTINGS.figures != "none"
CHECKS = SETTINGS.design_spectrum.ag or SETTINGS.design_spectrum.points


wildcard_constraints:
    record="|".join(map(re.escape, PLAN.records)),
    batch="|".join(PLAN.batches),


def product_of(name):
    """The product that a job makes, by the wildcards of its rule."""
    return lambda wildcards: name.format(**wildcards)


def unless_sealed(name):
    """No input, but a job runs again where the seal of what it makes does not hold (rocking.study.made_from)."""

    def force(wildcards):
        product = name.format(**wildcards)
        if workflow.is_main_process and (why := SEALS.why_again(product)):
            # As --forcerun does: the one trigger that snakemake does not remember, and that needs no file to be written.
            workflow.dag.forcefiles.add(str(SEALS.path(product)))
            if SEALS.path(product).exists():  # else nothing stands, which snakemake tells
                print(f"{product}: {why}.", file=sys.stderr)
        return []

    return force


def key_of(name):
    """One hash for what a product is made from: --report prints params, so that no text of a study may be in them."""
    return lambda wildcards: SEALS.key(name.format(**wildcards))


def seal_of(name):
    return str(SEALS.path(name))


def in_report(name, caption, category, **labels):
    """A file of the summary, with its place in the page that snakemake --report makes."""
    return report(f"{SUMMARY}/{name}", caption=f"../report/{caption}.rst", category=category, labels=labels)


if PLAN.makes_reports:
    OF_RECORDS = [str(outcome_of(Path(RESULTS), record)) for record in PLAN.records]
else:
    OF_RECORDS = [seal_of(f"batches/{batch}") for batch in PLAN.batches]
TARGETS = [seal_of("summary")]
if PLAN.makes_reports:
    TARGETS += [f"{RESULTS}/{record}/report.pdf" for record in PLAN.records if SETTINGS.reports]
if CHECKS:
    TARGETS += [seal_of("checks")]
if SETTINGS.fragility.in_every_run:
    TARGETS += [seal_of("fragility")]
