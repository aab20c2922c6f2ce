"""A study in a folder of the user's own, apart from this package: start it, and catalogue its records."""

from collections.abc import Mapping
from pathlib import Path

from rocking.errors import ConfigurationError, RecordError
from rocking.records.folder import ListedFile, list_folder, write_catalogue_rows
from rocking.study.config_file import commented_yaml
from rocking.study.settings import Settings
from rocking.tables import write_whole


def workflow_folder() -> Path:
    """Return the folder that holds Snakefile and workflow/: inside an installed package, or the clone."""
    package = Path(__file__).parents[1]
    return package / "shipped" if (package / "shipped" / "Snakefile").is_file() else package.parent


def start(folder: Path) -> list[Path]:
    """Write config.yaml, structures.yaml and an empty records/ into `folder` and return what was written.

    Raises ConfigurationError, before anything is written, when one of the files stands there already.
    """
    contents = _starting_files()
    for name in contents:
        if (folder / name).exists():
            raise ConfigurationError(
                f"{folder / name} exists already; choose another folder or remove it first."
            )
    for name, content in contents.items():
        write_whole(folder / name, content)
    (folder / "records").mkdir(exist_ok=True)
    return [folder / name for name in contents]


def _starting_files() -> Mapping[str, bytes]:
    return {
        "config.yaml": commented_yaml(Settings()).encode(),
        "structures.yaml": (workflow_folder() / "workflow" / "structures.yaml").read_bytes(),
    }


def write_catalogue(
    folder: Path,
    target: Path,
    *,
    unit: str | None = None,
    time_step: float | None = None,
    replace: bool = False,
) -> list[ListedFile]:
    """Write a catalogue of the accelerograms in `folder` to `target`; return every file as it was read.

    unit and time_step [s] are for the files that do not declare them. Raises RecordError, and writes nothing, when
    `target` exists and `replace` is false, or when no file could be read.
    """
    if target.exists() and not replace:
        raise RecordError(
            f"{target} exists already and may hold your own edits; say --replace to write it anew."
        )
    listed = list_folder(folder, unit=unit, time_step=time_step)
    rows = [found.row for found in listed if found.row]
    if not rows:
        reasons = "; ".join(f"{found.file}: {found.unread}" for found in listed) or "it holds no file"
        raise RecordError(f"{folder}: no accelerogram was read ({reasons}).")
    write_whole(target, write_catalogue_rows(rows).encode())
    return listed
