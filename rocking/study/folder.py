"""The folder of the results of a study, which lies inside it: a study may come from somebody else."""

import os
import re
from pathlib import Path

from rocking.errors import ConfigurationError

_PLAIN = re.compile(r"\w[\w .,+@=()~-]*(/\w[\w .,+@=()~-]*)*")
"""A path of plain characters on one line; snakemake takes braces for wildcards, and scripts hold paths as text."""
_LONGEST = 200
"""Characters of the folder of the results; with the names below it a path stays under what systems allow, 4096."""


def results_folder(name: str, *inputs: str) -> Path:
    """Return the folder of the results that the setting `results` names, seen from the folder of the study.

    inputs: files that the user wrote, which may not lie within it. Raises ConfigurationError where it is not inside the
    study after links are resolved, or where its name is more than one line of plain characters.
    """
    given = Path(name)
    path = given.relative_to(Path.cwd()) if given.is_relative_to(Path.cwd()) else given
    if not path.is_absolute() and not (_PLAIN.fullmatch(path.as_posix()) and len(name) <= _LONGEST):
        raise ConfigurationError(
            f"setting results is {name[:_LONGEST]!r}, but must be a folder inside the study, in letters, digits, "
            f"spaces and . , + - _ @ = ( ) ~ on one line of at most {_LONGEST} characters; give it another name.",
            results=name,
        )
    resolved = real(path)
    if not stands_inside(path):
        raise ConfigurationError(
            f"setting results is {name!r}, which leads to {resolved}, but must be a folder inside the study, "
            f"{Path.cwd()}; name one there.",
            results=name,
        )
    for file in inputs:
        if resolved in real(Path(file)).parents:
            raise ConfigurationError(
                f"setting results is {name!r}, but {file} lies within it; name a folder of its own for the results.",
                results=name,
            )
    return path


def real(path: Path) -> Path:
    """Return `path` once links are resolved; a link that leads to itself stays one, where `Path.resolve` raises."""
    return Path(os.path.realpath(path))


def stands_inside(path: Path) -> bool:
    """Return whether `path`, seen from the folder of the study, lies inside it once links are resolved."""
    return real(Path.cwd()) in real(path).parents


def check_links(*folders: Path) -> None:
    """Raise ConfigurationError where a link in a folder that a run writes, or it itself, leads out of the study."""
    for folder in folders:
        for path in (folder, *folder.rglob("*")):
            if path.is_symlink() and not stands_inside(path):
                raise ConfigurationError(
                    f"{path}: it is a link, through which a run would write or delete elsewhere; remove it.",
                    path=str(path),
                )
