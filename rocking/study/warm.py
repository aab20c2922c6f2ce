"""What a job needs, imported, loaded and prepared once, in the process that jobs are forked from.

It is imported for what its import does: multiprocessing's fork server takes the names of modules, and no more.
"""

import contextlib
import gc
import os
import sys
import time
from pathlib import Path

import yaml

import rocking.reports.explore
import rocking.reports.printing
import rocking.reports.record
import rocking.study.jobs  # noqa: F401
from rocking.assessment.compilation import compile_all, load_all
from rocking.assessment.store import computation_version
from rocking.errors import RockingError
from rocking.study.apart import PREPARED
from rocking.study.job import prepare
from rocking.study.miniseed import look_for_readers
from rocking.study.products import PRODUCTS
from rocking.study.settings import package_sha256, read_settings
from rocking.study.work import work_of

_SCHEDULER = os.getppid()
package_sha256()
computation_version()
look_for_readers()  # as each step of a record would
with contextlib.suppress(RockingError):  # each job would compile by itself
    compile_all()
    load_all()
with contextlib.suppress(Exception):  # what is wrong with a study its jobs report
    settings = read_settings(yaml.safe_load(os.environ.pop(PREPARED)))
    for product in PRODUCTS:
        if product.in_every_run(settings):
            with contextlib.suppress(ImportError):  # the other jobs run without its folder
                work_of(product)
    now = time.time()
    # Where a clock was set back, snakemake would never be content.
    for path in Path(settings.results).rglob("*"):
        if path.lstat().st_mtime > now:
            os.utime(path, (now, now), follow_symlinks=False)
    for _ in prepare(settings):
        if os.getppid() != _SCHEDULER:
            sys.exit()  # it had nothing to do
gc.freeze()  # what is loaded stays: to look for garbage in it takes a twelfth of a job
