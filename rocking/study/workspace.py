"""A folder or a file of the user's own, apart from this package: start a study, catalogue records, assess one file."""

import math
import re
from itertools import chain
from pathlib import Path

from rocking.assessment.rows.of_record import ComparisonRow
from rocking.assessment.rows.of_study import CapacityRow, StructureRow, capacity_rows, structure_rows
from rocking.assessment.verdict import Method
from rocking.errors import ConfigurationError, RecordError
from rocking.quantities import counted
from rocking.records import Accelerogram
from rocking.records.catalogue import COLUMNS, CatalogueRecord, catalogue_text, read_rows
from rocking.records.folder import list_folder, listing_text
from rocking.records.read import read
from rocking.structures import Outcome, load_structures
from rocking.study.job import Study, assess_record, write_report
from rocking.study.plan import settings_sha256, workflow_folder
from rocking.study.settings import Settings, commented_yaml
from rocking.tables import write_tables, write_whole


def start(folder: Path) -> list[Path]:
    """Write config.yaml, structures.yaml and an empty records/ into `folder` and return what was written.

    Raises ConfigurationError, before anything is written, when one of the files stands there already.
    """
    contents = {
        folder / "config.yaml": commented_yaml(Settings()).encode(),
        folder / "structures.yaml": (workflow_folder() / "workflow" / "structures.yaml").read_bytes(),
    }
    for path in contents:
        if path.exists():
            raise ConfigurationError(f"{path} exists already; choose another folder or remove it first.")
    for path, content in contents.items():
        write_whole(path, content)
    (folder / "records").mkdir(exist_ok=True)
    return list(contents)


def write_catalogue(folder: Path, target: Path, unit: str | None, time_step: float | None) -> str:
    """Write a catalogue of the accelerograms in `folder` to `target`, or add to the one that stands there; say what.

    Its rows stay as they are, to the letter; files that none of them names get rows below them. unit and time_step [s]
    are for the files that do not declare them. Raises RecordError, and writes nothing, when no file could be read, and
    CatalogueError when `target` is no catalogue.
    """
    standing = [row for _, row in read_rows(target)] if target.exists() else []
    files, rows = list_folder(folder, unit=unit, time_step=time_step, catalogue=standing)
    if not rows and not standing:
        reasons = "; ".join(f"{file.file}: {file.refusal}" for file in files) or "it holds no file"
        raise RecordError(f"{folder}: no accelerogram was read ({reasons}).")
    if rows:
        columns = dict.fromkeys(chain(standing[0] if standing else COLUMNS, *rows))
        write_whole(target, catalogue_text([*standing, *rows], list(columns)).encode())
    records = {file.record for file in files}
    of_folder = (each for each in standing if not (each.get("source_repository") or "obspy:" in each["file"]))
    note = "{}: its row stays in the catalogue, but its file is not there; remove the row or add the file.\n"
    lines = "".join(note.format(each["id"]) for each in of_folder if each["id"] not in records)
    count = counted(len(standing) + len(rows), "record")
    return f"{listing_text(files)}{lines}{target}: {count}, {len(rows)} of them new"


def read_own(
    path: Path, unit: str | None, time_step: float | None, scale_factor: float, component: str
) -> tuple[CatalogueRecord, list[Accelerogram]]:
    """Return the row that a catalogue would hold for a single file, and every channel of it; component: to use.

    unit and time_step [s]: where the file does not say them. Raises RecordError.
    """
    channels = read(path, unit=unit, time_step=time_step)
    name = re.sub(r"[^A-Za-z0-9._-]+", "_", path.stem).strip("._-")[:70]
    record = CatalogueRecord(
        id=f"{name}_record" if name.lower() in ("", "summary") else name,
        file=path.resolve().name,
        sha256=channels[0].source.sha256,
        component=component,
        unit=unit or "",
        time_step=time_step,
        scale_factor=scale_factor,
        folder=path.resolve().parent,
    )
    return record, channels


def assess_file(
    record: CatalogueRecord,
    channels: list[Accelerogram],
    structures: Path,
    name: str | None,
    output: Path | None,
) -> list[str]:
    """Assess the structure `name` (None: all) of a list under one record and return lines of text.

    output: a folder for report.pdf and the tables, laid out like the results of a study. Raises RecordError or
    ConfigurationError before anything is written.
    """
    all_structures = load_structures(structures)
    if name not in (None, *all_structures):
        names = ", ".join(all_structures)
        raise ConfigurationError(f"structure is {name!r}, but must be one of those in {structures}: {names}.")
    chosen = {each: all_structures[each] for each in all_structures if name in (None, each)}
    study = Study(chosen, Settings(), settings_sha256(Settings(), all_structures))
    assessed = assess_record(record, study, study.open(record, channels))
    if output is not None:
        write_report(assessed, output / record.id)
        rows = {StructureRow: structure_rows(chosen), CapacityRow: capacity_rows(chosen)}
        write_tables(rows, output / "summary")
    lines = [_told(row) for row in assessed.tables.comparison]
    failures = assessed.tables.failures
    return lines + [f"not assessed: {each.structure or each.stage}: {each.message}" for each in failures]


def _told(row: ComparisonRow) -> str:
    """What became of a structure under a component, and what one pulse predicts."""
    outcome = str(row.answer_outcome)
    if row.answer_method is not Method.MECHANISM_ON_RECORD:
        settled = "overturns" if row.answer_outcome is Outcome.OVERTURNS else "does not overturn"
        outcome = f"{settled} ({row.answer_reason})"
    facts = [f"{row.component or 'component not named'}, {row.structure}: {outcome}"]
    if math.isfinite(row.integrated_rotation_ratio):  # overturning stands in the outcome
        facts += [f"largest rotation {row.integrated_rotation_ratio:.4g} of the critical one"]
    if not math.isnan(predicted := row.predicted_rotation_ratio):
        words = "overturning" if math.isinf(predicted) else f"{predicted:.4g}"
        facts += [f"one pulse predicts {words} ({row.regime})"]
    if row.scale_factor != 1:
        facts += [f"the accelerations of the file were multiplied by {row.scale_factor:g}"]
    return "; ".join(facts)
