"""What the rules are made of: the files that a job reads and gives, and how it is done in a process of its own."""

import os
from functools import cache
from itertools import islice
from pathlib import Path

# The files by which every job knows the study.
LISTED = [ancient(path) for path in not_ahead(PLAN.listed)]


def files(rule):
    """The further files that a job reads."""
    return lambda wildcards: [ancient(path) for path in not_ahead(PLAN.files(rule, *wildcards))]


def made_from(rule):
    """What the jobs of a rule are made from, as params, with the hash of what each reads."""
    return PLAN.params(rule) | {"contents": lambda wildcards: CONTENTS(rule, *wildcards)}


CONTENTS = cache(PLAN.contents)


def gives(rule, record="{record}"):
    """The files of a rule."""
    return [in_report(output, str(path)) for output, path in outputs_of(rule, SETTINGS, record).items()]


def in_report(output, path):
    """A file, with its place in the page that snakemake --report makes."""
    if output.is_store and not ELSEWHERE:
        return update(path)  # there again when the job starts the next time
    if not output.label:
        return path
    labels = {"document": output.label}
    if output.category == "Records":
        labels = {"record": "{record}", **labels}
    elif output.category == "Tables":
        labels = {"table": Path(path).name, "content": output.label}
    return report(path, category=output.category, labels=labels)


def targets(rule, record=""):
    """The files of a rule that a study is asked for."""
    return [str(path) for output, path in outputs_of(rule, SETTINGS, record).items() if not output.is_store]


def smaller_first(wildcards, input):
    """The priority of a record, which is larger where its files are smaller."""
    return 1 / (1 + sum(sizes(input.files)))


def sizes(files):
    """MB of each file that lies here."""
    return [os.path.getsize(file) / 1e6 for file in files if os.path.exists(file)]


def cores_of_record(wildcards):
    """The cores over the records that this run makes. A job on another machine has one."""
    if workflow.remote_exec or not workflow.local_exec:
        return 1
    cores = min(workflow.resource_settings.cores or 1, os.cpu_count() or 1)
    if not workflow.is_main_process:
        return max(1, cores // len(PLAN.records))
    integrated = (job for job in workflow.dag.needrun_jobs() if job.rule.name == "integrate")
    return max(1, cores // (len([*islice(integrated, cores)]) or 1))  # no more are counted than matter


def memory_of_record(wildcards, input, attempt):
    """MB of a step of a record: by its largest file, and more at each further attempt.

    A pair of 150 s at 100 Hz takes 310 MB, of 600 s, which is 0.9 MB a file as text, 370 MB; packed files hold up to ten
    times as many samples a byte.
    """
    return attempt * round(500 + 1000 * max(sizes(input), default=0))


def work(rule, plan, input, log, cores=1):
    """Do the job of a rule in a process of its own."""
    folder = folder_of(input.listed[0], SETTINGS.catalogue) if ELSEWHERE else ""
    alone = not workflow.is_main_process
    run_apart(SETTINGS, log[0], "rocking.study.jobs:run", rule, plan, log[0], cores, folder, alone=alone)


def research(rule, catalogues, output, log):
    """Do the job of a target of the research, into the folder of its output."""
    folder = os.path.dirname(output)
    run_apart(SETTINGS, log, "docs.research.run:run", rule, list(catalogues), dict(config), folder)
