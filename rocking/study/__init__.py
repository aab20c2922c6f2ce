"""Study: many records against one list of structures, from the settings to the finished folder."""

import os
from pathlib import Path

from rocking.errors import ConfigurationError

_READ_BY = {
    ".numba_config.yaml": "numba takes its settings, and compiled code to run,",
    "matplotlibrc": "matplotlib takes its settings",
}
"""Configuration that a library takes from the current folder, before any variable of the environment."""


def close_doors(folder: Path = Path()) -> None:
    """Keep what lies in the folder of a study, which somebody else may have sent, from changing what runs.

    PYTHONSAFEPATH lets Python, in children of this process, import no module from the folder that it stands in. A file
    from which a library would take its configuration as it is imported is refused, so that this comes before these
    imports: ConfigurationError.
    """
    os.environ["PYTHONSAFEPATH"] = "1"
    for name, takes in _READ_BY.items():
        if os.path.lexists(folder / name):
            raise ConfigurationError(
                f"{folder / name}: from a file of this name {takes} which a study may not bring; remove it."
            )
