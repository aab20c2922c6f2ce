"""Rocking of structures under recorded earthquakes: from a catalogue of accelerograms to reports and tables."""

import sys

from snakemake.utils import min_version

min_version("9.27")


report: "workflow/report/study.rst"


include: "workflow/rules/study.smk"


rule all:
    default_target: True
    input:
        TARGETS,


# The five steps of every record, then what stands over all of them.
include: "workflow/rules/record.smk"
include: "workflow/rules/batch.smk"
include: "workflow/rules/products.smk"
include: "workflow/rules/summary.smk"


# What follows takes its work from docs/, which lies beside workflow/.
sys.path.append(str(HOME))


include: "workflow/rules/paper.smk"
include: "workflow/rules/documentation.smk"


# The installed package carries of the research what reads its scores alone.
if (HOME / "docs" / "research" / "research.smk").is_file():

    include: "docs/research/research.smk"


# Not before: a dry run leaves the catalogue as it is.
onstart:
    begin(PLAN, anew=workflow.dag_settings.forceall and not workflow.touch)


onsuccess:
    if not workflow.touch:
        end(PLAN)
