"""A study in a folder of the user's own, apart from this package: start it, and catalogue its records."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rocking.errors import ConfigurationError, RecordError
from rocking.records.catalogue import COLUMNS, catalogue_text, read_rows
from rocking.records.folder import ListedFile, list_folder
from rocking.study.settings import Settings, commented_yaml
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


@dataclass(frozen=True)
class WrittenCatalogue:
    """A catalogue as it was written: the files as they were read, its rows, the new ones, ids whose file is gone."""

    files: list[ListedFile]
    records: int
    new: int
    gone: tuple[str, ...]


def write_catalogue(
    folder: Path, target: Path, *, unit: str | None = None, time_step: float | None = None
) -> WrittenCatalogue:
    """Write a catalogue of the accelerograms in `folder` to `target`, or add to the one that stands there.

    Its rows stay as they are, to the letter; files that none of them names get rows below them. unit and time_step [s]
    are for the files that do not declare them. Raises RecordError, and writes nothing, when no file could be read, and
    CatalogueError when `target` is no catalogue.
    """
    standing = [row for _, row in read_rows(target)] if target.exists() else []
    listed, rows = list_folder(folder, unit=unit, time_step=time_step, known=standing)
    if not rows and not standing:
        reasons = "; ".join(f"{found.file}: {found.unread}" for found in listed) or "it holds no file"
        raise RecordError(f"{folder}: no accelerogram was read ({reasons}).")
    if rows:
        used = (name for row in rows for name in row)
        columns = dict.fromkeys([*(standing[0] if standing else COLUMNS), *used])
        write_whole(target, catalogue_text([*standing, *rows], list(columns)).encode())
    there = {found.record for found in listed}
    remote = {
        row["id"] for row in standing if row.get("source_repository") or row["file"].startswith("obspy:")
    }
    gone = tuple(row["id"] for row in standing if row["id"] not in there | remote)
    return WrittenCatalogue(listed, len(standing) + len(rows), len(rows), gone)
