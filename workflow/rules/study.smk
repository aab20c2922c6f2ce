"""What is studied: settings, records and structures, checked before the first job starts; and what rules are made of."""

import os
import time
from functools import cache
from pathlib import Path

from rocking.study import close_doors

close_doors()  # before the imports that open them

from rocking.hashes import sha256_of
from rocking.catalogue.catalogue import NAME_OF_RECORD
from rocking.study.apart import run_apart
from rocking.study.flow import workflow_folder
from rocking.study.made_from import OF_RECORDS, inputs_of, of_kind, of_records
from rocking.study.outputs import log_of, outputs_of
from rocking.study.plan import check_config_file, config_file, make_plan
from rocking.study.run import begin, end
from rocking.study.settings import package_sha256, structure_hashes
from rocking.study.task import Task, folder_of
from snakemake.utils import update_config

HOME = workflow_folder()
for FILE in workflow.overwrite_configfiles:
    check_config_file(Path(FILE))
if not workflow.configfiles:
    # Not by `configfile:`, which an alias bomb or a pipe of that name would keep for ever. Else the shipped example.
    FILE = config_file(Path()) or HOME / "config" / "config.yaml"
    CONFIG = check_config_file(FILE)
    update_config(CONFIG, config)  # what --config says
    config.update(CONFIG)
# Jobs that share no folder with this process are handed copies of the files that their rules declare.
BY_NAME = workflow.storage_settings.default_storage_provider is not None
PLAN = make_plan(config, BY_NAME)
SETTINGS = PLAN.settings
RESULTS = SETTINGS.results


wildcard_constraints:
    # Not the names themselves: snakemake goes through the text of a pattern for each file of each job.
    record=NAME_OF_RECORD,
    batch=r"\d+_of_\d+",


RECORDS_OF = cache(lambda product: of_records(product, PLAN))


def lists_of(product):
    """The inputs of a product, such as "record/{record}", by what they are: ancient, since their contents are params."""

    def of(name):
        return lambda wildcards: declared(*inputs_of(product.format(**wildcards), PLAN)[name])

    return {name: of(name) for name in ("catalogue", "structures", "files")}


def declared(*paths):
    """The files that can be inputs; one that cannot counts by its content all the same, which is a param.

    Behind a file that is dated in the future snakemake would remove what a job wrote, and in a name it takes braces and
    <> for variables.
    """
    now = time.time()
    plain = (path for path in paths if not set(path) & set("{}<>"))
    return [ancient(path) for path in plain if not os.path.exists(path) or os.stat(path).st_mtime <= now]


def params_of(product):
    """What a product is made from, each thing by itself: snakemake reports those that changed."""

    def thing(number):
        return lambda wildcards: RECORDS_OF(product.format(**wildcards))[number]

    return [*of_kind(product.partition("/")[0], PLAN), *map(thing, range(OF_RECORDS))]


def files_of(product):
    """The outputs of a product, with the place of each in the page that snakemake --report makes."""
    return [in_report(output, str(path)) for output, path in outputs_of(product, SETTINGS).items()]


def in_report(output, path):
    if output.is_store and not BY_NAME:
        return update(path)  # there again when the job starts the next time
    if not output.label:
        return path
    labels = {"document": output.label}
    if output.category == "Records":
        labels = {"record": "{record}", **labels}
    elif output.category == "Tables":
        labels = {"table": Path(path).name, "content": output.label}
    return report(path, caption=f"../report/{output.caption}.rst", category=output.category, labels=labels)


def cores_of_record(wildcards):
    """The cores over the records under way. A job on another machine has one."""
    if workflow.remote_exec or not workflow.local_exec:
        return 1
    cores = min(workflow.resource_settings.cores or 1, os.cpu_count() or 1)
    return max(1, cores // records_of_run())


@cache
def records_of_run():
    """How many records this run makes; where snakemake has begun a process for each, those of the study."""
    if not workflow.is_main_process:
        return len(PLAN.records)
    return sum(job.rule.name == "record" for job in workflow.dag.needrun_jobs()) or 1


def memory_of_record(wildcards, input, attempt):
    """MB for records one after another: by the largest file, and more at each further attempt.

    A pair of 150 s at 100 Hz takes 310 MB, of 600 s, which is 0.9 MB a file as text, 370 MB; packed files hold up to ten
    times as many samples a byte.
    """
    size_of = dict(zip(input, input.size_files_mb))
    return attempt * round(500 + 1000 * max((size_of[file] for file in input.files), default=0))


def work(rule, wildcards, input, params, log, threads=1, job=""):
    """Do the job of a rule in a process of its own, which knows what it is handed here.

    job: the name of its function where it is not that of the rule.
    """
    product = "/".join([rule, *wildcards])
    products = [product for product in PLAN.products_of_summary if input.get(product)]
    folder = folder_of(*input.catalogue, SETTINGS.catalogue) if BY_NAME else ""
    task = Task(product, dict(config), list(params), folder, log[0], products, BY_NAME, threads)
    run_apart(f"rocking.study.jobs:{job or rule}", product, task)


def log_file(product):
    return f"{RESULTS}/{log_of(product)}"


def shown_files(product):
    """The files of a product over all records, where the summary shows it."""
    return (
        [str(path) for path in outputs_of(product, SETTINGS).values()]
        if product in PLAN.products_of_summary
        else []
    )


OUTCOMES = list(dict.fromkeys(map(str, PLAN.outcomes().values())))
TARGETS = [
    str(path)
    for product in PLAN.products
    for output, path in outputs_of(product, SETTINGS).items()
    if not output.is_store
]
