"""A folder or a file of the user's own, apart from this package: start a study, catalogue records, assess one file."""

from functools import partial
from itertools import chain
from pathlib import Path

from rocking.catalogue.catalogue import COLUMNS, catalogue_text, read_rows
from rocking.catalogue.folder import catalogue_of_folder
from rocking.catalogue.listing import listing_text
from rocking.errors import ConfigurationError, RecordError
from rocking.progress import bar
from rocking.quantities import counted
from rocking.records.formats.layouts import NAME
from rocking.study.flow import OWN_SNAKEFILE, PROFILE, workflow_folder
from rocking.study.plan import check_config_file, config_file
from rocking.study.settings import Settings, first_yaml, named_files
from rocking.tables import Document, check_target, write_whole


def start(folder: Path) -> list[Path]:
    """Write config.yaml, structures.yaml, Snakefile, its profile and an empty records/ into `folder`; return what was
    written.

    Raises ConfigurationError, before anything is written, when one of the files exists already.
    """
    contents = {
        folder / "config.yaml": _with_schema("config", first_yaml(Settings()).encode()),
        folder / "structures.yaml": _with_schema(
            "structures", (workflow_folder() / "config" / "structures.yaml").read_bytes()
        ),
        folder / "Snakefile": OWN_SNAKEFILE.encode(),
        folder / "profiles" / "default" / "config.yaml": PROFILE.read_bytes(),
    }
    for path in contents:
        if path.exists():
            raise ConfigurationError(f"{path} exists already; choose another folder or remove it first.")
    for path, content in contents.items():
        write_whole(path, content)
    (folder / "records").mkdir(exist_ok=True)
    return list(contents)


def _with_schema(name: str, content: bytes) -> bytes:
    """Return a file of YAML below the line by which an editor finds the schema that completes and checks it."""
    schema = (workflow_folder() / "workflow" / "schemas" / f"{name}.schema.yaml").resolve()
    note = (
        "The line above is for editors on this machine alone; remove it where the study is moved to another."
    )
    return f"# yaml-language-server: $schema={schema.as_uri()}\n# {note}\n".encode() + content


CATALOGUE = Document("catalogue", ".csv", lambda _: True)
"""What exists there is read before rows are added: `read_rows` refuses what is no catalogue, and names its columns."""


def records_of(folder: Path) -> tuple[Path, Path]:
    """Return the folder of the records that `folder` means, and the catalogue there: of a study those of its settings.

    Raises ConfigurationError for a study whose settings cannot be read.
    """
    config = config_file(folder)
    catalogue = (
        folder / named_files(check_config_file(config)).catalogue if config else folder / "catalogue.csv"
    )
    return catalogue.parent, catalogue


def write_catalogue(folder: Path, target: Path, unit: str | None, time_step: float | None) -> str:
    """Write a catalogue of the accelerograms in `folder` to `target`, or add to the one that exists; say what.

    Its rows stay as they are, to the letter, but for the new name of a file that was renamed and for the request to
    fill in a cell that was filled; files that none of them names get rows below them. unit and time_step [s] are for
    the files that do not declare them. What tables leave open is asked in layouts.csv next to it, a line for each
    layout. Raises RecordError, and writes nothing, when no file could be read, and
    CatalogueError when `target` is no catalogue.
    """
    check_target(target, CATALOGUE)
    existing = [row for _, row in read_rows(target)] if target.exists() else []
    found = catalogue_of_folder(
        folder,
        declared={"unit": unit, "time_step": time_step},
        existing=existing,
        keeps_readings=True,
        answers=target.parent,
        watched=partial(bar, what="file"),
    )
    files = found.files
    rows = found.new
    asked = (
        []
        if found.layouts is None
        else [f"Answer the questions in {target.with_name(NAME)}, and run this again."]
    )
    if found.layouts is not None:
        write_whole(target.with_name(NAME), found.layouts.encode())
    if not rows and not existing and asked:
        return listing_text(files) + "\n".join(["", *asked])
    if not rows and not existing:
        reasons = "; ".join(f"{file.file}: {file.refusal}" for file in files) or "it holds no file"
        raise RecordError(f"{folder}: no accelerogram was read ({reasons}).")
    if rows or found.existing != existing:
        columns = dict.fromkeys(chain(existing[0] if existing else COLUMNS, *rows))
        write_whole(target, catalogue_text([*found.existing, *rows], list(columns), target).encode())
    records = {file.record for file in files}
    of_folder = (
        path for path in found.existing if not (path.get("source_repository") or "obspy:" in path["file"])
    )
    note = "{}: its row stays in the catalogue, but its file is not there; remove the row or add the file."
    lost = [note.format(path["id"]) for path in of_folder if path["id"] not in records]
    count = f"{target}: {counted(len(existing) + len(rows), 'record')}, {len(rows)} of them new"
    return listing_text(files) + "\n".join(["", *map(str, found.warnings), *lost, *asked, count])
