"""A folder or a file of the user's own, apart from this package: start a study, catalogue records, assess one file."""

import math
import re
from collections.abc import Iterable, Iterator
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from rocking.assessment.rows import CapacityRow, StructureRow, capacity_rows, structure_rows
from rocking.assessment.scene import load_scenes, placed
from rocking.errors import ConfigurationError, RecordError
from rocking.quantities import counted
from rocking.records import Accelerogram
from rocking.records.catalogue import COLUMNS, CatalogueRecord, catalogue_text, read_rows
from rocking.records.folder import catalogue_of_folder
from rocking.records.formats.layouts import NAME
from rocking.records.listing import listing_text
from rocking.records.read import read
from rocking.study.plan import workflow_folder
from rocking.study.settings import Settings, first_yaml, settings_sha256
from rocking.study.terminal import bar
from rocking.tables import Row, write_tables, write_whole, written_together

if TYPE_CHECKING:  # as in `assess_file`
    from rocking.assessment.case import StationResult


def start(folder: Path) -> list[Path]:
    """Write config.yaml, structures.yaml and an empty records/ into `folder` and return what was written.

    Raises ConfigurationError, before anything is written, when one of the files stands there already.
    """
    contents = {
        folder / "config.yaml": first_yaml(Settings()).encode(),
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

    Its rows stay as they are, to the letter, but for the new name of a file that was renamed and for the request to
    fill in a cell that was filled; files that none of them names get rows below them. unit and time_step [s] are for
    the files that do not declare them. What tables leave open is asked in layouts.csv beside it, a line for each
    layout. Raises RecordError, and writes nothing, when no file could be read, and
    CatalogueError when `target` is no catalogue.
    """
    standing = [row for _, row in read_rows(target)] if target.exists() else []
    found = catalogue_of_folder(
        folder,
        declared={"unit": unit, "time_step": time_step},
        standing=standing,
        keeps_readings=True,
        answers=target.parent,
        watched=partial(bar, what="file"),
    )
    files = found.files
    rows = found.new
    asked = (
        []
        if found.layouts is None
        else [f"Answer what stands in {target.with_name(NAME)}, and run this again."]
    )
    if found.layouts is not None:
        write_whole(target.with_name(NAME), found.layouts.encode())
    if not rows and not standing and asked:
        return listing_text(files) + "\n".join(["", *asked])
    if not rows and not standing:
        reasons = "; ".join(f"{file.file}: {file.refusal}" for file in files) or "it holds no file"
        raise RecordError(f"{folder}: no accelerogram was read ({reasons}).")
    if rows or found.standing != standing:
        columns = dict.fromkeys(chain(standing[0] if standing else COLUMNS, *rows))
        write_whole(target, catalogue_text([*found.standing, *rows], list(columns), target).encode())
    records = {file.record for file in files}
    of_folder = (
        each for each in found.standing if not (each.get("source_repository") or "obspy:" in each["file"])
    )
    note = "{}: its row stays in the catalogue, but its file is not there; remove the row or add the file."
    lost = [note.format(each["id"]) for each in of_folder if each["id"] not in records]
    count = f"{target}: {counted(len(standing) + len(rows), 'record')}, {len(rows)} of them new"
    return listing_text(files) + "\n".join(["", *map(str, found.remarks), *lost, *asked, count])


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
    # It loads numba, for which who starts a study or catalogues a folder would wait as well.
    from rocking.study.job import Study, assess_catalogued, rows_of, write_report

    all_scenes = load_scenes(structures)
    if name not in (None, *all_scenes):
        names = ", ".join(all_scenes)
        raise ConfigurationError(f"structure is {name!r}, but must be one of those in {structures}: {names}.")
    chosen = {each: scene for each, scene in all_scenes.items() if name in (None, each)}
    study = Study(chosen, Settings(), settings_sha256(Settings(), all_scenes))
    result = assess_catalogued(record, study, study.open(record, channels))
    rows = rows_of(result, record, study)
    if output is not None:
        of_structures: dict[type[Row], Iterable[Row]] = {
            StructureRow: structure_rows(study.structures),
            CapacityRow: capacity_rows(study.structures),
        }
        with written_together():
            write_tables(rows.tables, output / record.id)
            write_report(result, rows, study, output / record.id)
            write_tables(of_structures, output / "summary")
    lines = [line for station in result.worst_first for line in _told(station, record.scale_factor)]
    return lines + [f"not assessed: {each.structure or each.stage}: {each.message}" for each in rows.failures]


def _told(station: "StationResult", scale_factor: float) -> Iterator[str]:
    """Yield the verdict on a structure with its count and reason, then what each component does by itself."""
    decision = station.decision
    share = f" ({decision.share_in_words})" if decision.share_in_words else ""
    yield f"{placed(station.structure, station.support_period_s)}: {decision.word}{share}; {decision.why}"
    for component, case in station.cases.items():
        if case.answer is None:
            continue
        facts = [f"  {component or 'component not named'}: {case.answer.outcome}"]
        if case.answer.reason:
            facts.append(case.answer.reason)
        if math.isfinite(case.integrated_rotation_ratio):  # overturning stands in the outcome
            facts.append(f"largest rotation {case.integrated_rotation_ratio:.4g} of the critical one")
        predicted = case.predicted_rotation_ratio
        if case.prediction is not None:
            words = "overturning" if math.isinf(predicted) else f"{predicted:.4g}"
            facts.append(f"one pulse predicts {words} ({case.prediction.maximum.regime})")
        if scale_factor != 1:
            facts.append(f"the accelerations of the file were multiplied by {scale_factor:g}")
        yield "; ".join(facts)
