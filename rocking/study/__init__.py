"""Study: many records against one list of structures, from the settings to the finished folder.

Here stand the doors by which a file of such a folder could change what runs: they are closed before the libraries
behind them are imported.
"""

import os
from pathlib import Path

from rocking.errors import ConfigurationError

_READ_BY = {
    ".numba_config.yaml": "numba takes its settings, and compiled code to run,",
    "matplotlibrc": "matplotlib takes its settings",
    "profiles/default": "snakemake takes options, and expressions to evaluate,",
}
"""Configuration that a library takes from the folder it stands in, before any variable of the environment."""


def close_doors(folder: Path = Path()) -> None:
    """Let Python import nothing from the folder that it stands in, in this process's children, and check `folder`.

    Raises ConfigurationError where a file stands in it from which a library would take its own configuration.
    """
    os.environ["PYTHONSAFEPATH"] = "1"
    for name, takes in _READ_BY.items():
        if os.path.lexists(folder / name):
            raise ConfigurationError(
                f"{folder / name}: from a file of this name {takes} which a study may not bring; remove it."
            )
