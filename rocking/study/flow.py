"""Where the workflow stands, so that the Snakefile of a study can name it.

It imports nothing: what stands in the folder of a study is looked at before the libraries that read it are imported.
"""

from pathlib import Path


def workflow_folder() -> Path:
    """Return the folder that holds Snakefile, workflow/ and config/: inside an installed package, or the clone."""
    package = Path(__file__).parents[1]
    return package / "shipped" if (package / "shipped" / "Snakefile").is_file() else package.parent


SNAKEFILE = str(workflow_folder() / "Snakefile")
"""The workflow, for `module` in the Snakefile of a study."""
OWN_SNAKEFILE = """\
from rocking.study.flow import SNAKEFILE

module rocking:
    snakefile: SNAKEFILE
    config: config

use rule * from rocking

onstart:
    rocking.onstart()

onsuccess:
    rocking.onsuccess()
"""
"""The Snakefile of a study of one's own: the rules of the workflow, and what it does at either end of a run.

No `configfile:`, by which snakemake reads a file before anybody can check it, and runs Python that stands in it; the
rules find config.yaml themselves.
"""
