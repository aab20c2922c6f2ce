"""Where the workflow lies, so that the Snakefile of a study can name it.

It imports nothing: what lies in the folder of a study is looked at before the libraries that read it are imported.
"""

from pathlib import Path


def workflow_folder() -> Path:
    """Return the folder that holds Snakefile, workflow/ and config/: inside an installed package, or the clone."""
    package = Path(__file__).parents[1]
    return package / "shipped" if (package / "shipped" / "Snakefile").is_file() else package.parent


SNAKEFILE = str(workflow_folder() / "workflow" / "Snakefile")
"""The workflow, for `module` in the Snakefile of a study."""
PROFILE = workflow_folder() / "workflow" / "profiles" / "default" / "config.yaml"
"""The options of snakemake on one machine, which it takes unasked from profiles/default in the folder of a study."""
OWN_SNAKEFILE = """\
from rocking.study.flow import SNAKEFILE

configfile: "config.yaml"

module rocking:
    snakefile: SNAKEFILE
    config: config

use rule * from rocking
"""
"""The Snakefile of a study of one's own: its settings, and the rules of the workflow."""
