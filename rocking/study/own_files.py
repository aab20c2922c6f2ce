"""Files of a user's own, apart from any study: the stations that they hold, and what is asked of each."""

import math
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from rocking.assessment.conclusion import to_check
from rocking.assessment.rows import (
    RECORD_TABLES,
    CapacityRow,
    StructureRow,
    WarningRow,
    capacity_rows,
    structure_rows,
)
from rocking.assessment.scene import Scene, load_scenes, placed
from rocking.catalogue.catalogue import CatalogueRecord, record_of_row
from rocking.catalogue.folder import files_in, rows_of_files
from rocking.catalogue.grouping import stations
from rocking.catalogue.listing import ListedFile, listed_file, reading_of
from rocking.errors import ConfigurationError, RecordError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.archive import archive_of, is_archive, members
from rocking.records.formats import Options
from rocking.records.read import bytes_of, read_raw
from rocking.study.kinds import StudyKind
from rocking.study.settings import Settings, settings_sha256
from rocking.tables import (
    Document,
    Row,
    check_tables,
    check_target,
    read_whole,
    write_tables,
    write_whole,
    written_together,
)
from rocking.warnings import RockingWarning

if TYPE_CHECKING:  # as in `assess_stations`
    from rocking.assessment.case import PeriodResult


@dataclass(frozen=True)
class Declared:
    """The facts that the caller of a command declares of all its files.

    unit: of their numbers; time_step: s; scale_factor: on the accelerations; component: to use, "" for every one.
    """

    unit: str | None = None
    time_step: float | None = None
    scale_factor: float = 1.0
    component: str = ""

    def __post_init__(self) -> None:
        """Refuse a factor of 0, which leaves no motion. Raises ConfigurationError."""
        if not abs(self.scale_factor) > 0 or math.isinf(self.scale_factor):
            raise ConfigurationError(
                f"scale is {self.scale_factor:g}, but must be a number other than 0.", scale=self.scale_factor
            )


@dataclass(frozen=True)
class OwnStation:
    """One record of the files that were given: the row that a catalogue would hold, and every channel of its files."""

    record: CatalogueRecord
    channels: tuple[Accelerogram, ...]


@dataclass(frozen=True)
class OwnFiles:
    """What the files of a command hold, in their order.

    channels: of each file that was read, by its path. refused: the errors of those that were not. warnings: what there
    is to say of how they were joined.
    """

    channels: dict[Path, list[Accelerogram]]
    refused: tuple[RecordError, ...]
    stations: tuple[OwnStation, ...] = ()
    warnings: tuple[RockingWarning, ...] = ()


def read_files(paths: Sequence[Path], declared: Declared) -> OwnFiles:
    """Return the channels of the files at `paths`, of those in a folder or an archive among them.

    A StationXML among them describes the instruments of the others. Raises RecordError where none can be read.
    """
    named, described = _named(paths)
    channels: dict[Path, list[Accelerogram]] = {}
    refused: list[RecordError] = []
    for path in named:
        options = Options(
            declared.unit,
            declared.time_step,
            None,
            path.parent,
            described=described,
            scale_factor=declared.scale_factor,
        )
        try:
            channels[path] = read_raw(bytes_of(path), path, options)
        except RecordError as error:
            refused.append(error)
    if not channels:
        raise (
            refused[0] if refused else RecordError(f"{paths[0]}: it holds no record; give the files of one.")
        )
    return OwnFiles(channels, tuple(refused))


def stations_of(paths: Sequence[Path], declared: Declared) -> OwnFiles:
    """Return the stations that the files at `paths` hold: the components of one are one record, as in a catalogue.

    Raises RecordError where no file holds a horizontal component.
    """
    own = read_files(paths, declared)
    folder = Path(os.path.commonpath([path.resolve().parent for path in own.channels]))
    listed = [_listed(path, channels, folder) for path, channels in own.channels.items()]
    rows = rows_of_files(listed)
    by_name = {file.file: path for file, path in zip(listed, own.channels, strict=True)}
    found = []
    for row in rows:
        record = replace(
            record_of_row(row, folder),
            unit=declared.unit or "",
            time_step=declared.time_step,
            scale_factor=declared.scale_factor,
        )
        if declared.component:
            record = replace(record, component=declared.component)
        channels = [
            replace(channel, source=replace(channel.source, path=file.name))
            for file in record.files
            for channel in own.channels[by_name[file.name.removeprefix("./")]]
        ]
        found.append(OwnStation(record, tuple(channels)))
    if not found:
        raise RecordError("; ".join(f"{file.file}: {file.refusal}" for file in listed))
    warnings = [*_apart(listed), *_siblings(listed, own.channels, folder, declared)]
    return OwnFiles(own.channels, own.refused, tuple(found), tuple(warnings))


def _named(paths: Sequence[Path]) -> tuple[list[Path], tuple[Path, ...]]:
    """Return the files of records that paths name, those of folders and archives too, and the StationXML files."""
    files: list[Path] = []
    for path in paths:
        if path.is_dir():
            files += files_in(path)
        elif is_archive(path):
            try:
                files += [path / name for name in members(path)]
            except RecordError:
                files.append(path)  # refused, with its name, where it is read
        else:
            files.append(path)
    described = [path for path in files if path.suffix.lower() == ".xml" and archive_of(path) is None]
    records = [path for path in dict.fromkeys(files) if path not in described]
    return records or files, tuple(described)


def _listed(path: Path, channels: Sequence[Accelerogram], folder: Path) -> ListedFile:
    where = path.parent.resolve() / path.name
    return listed_file(reading_of(channels), where, folder, {})


def _apart(listed: Sequence[ListedFile]) -> Iterator[RockingWarning]:
    """Yield why files of one station are records of their own, and which files are none."""
    for file in listed:
        if file.separated:
            yield RockingWarning.of(StudyKind.FILE_APART, file.file, why=file.separated)
        if file.refusal:
            yield RockingWarning.of(StudyKind.FILE_WITHOUT_RECORD, file.file, why=file.refusal)


_LIKE = 0.7
"""Likeness of the names of two files from which on both may be of one station."""
_LOOKED_AT = 8
"""Neighbours of a file that are opened, at most, to see whether they are of its station."""


def _siblings(
    listed: Sequence[ListedFile], given: Iterable[Path], folder: Path, declared: Declared
) -> Iterator[RockingWarning]:
    """Yield a warning on each file next to those given that is a component of the same station, and is not used."""
    known = {path.resolve() for path in given}
    for file, path in zip(listed, given, strict=True):
        if len(file.channels) != 1 or not file.record or archive_of(path) is not None:
            continue
        alike = sorted(
            (SequenceMatcher(None, path.name, other.name).ratio(), other.name, other)
            for other in path.parent.iterdir()
            if other.is_file() and not other.name.startswith(".") and other.resolve() not in known
        )
        for likeness, _, other in reversed(alike[-_LOOKED_AT:]):
            if likeness < _LIKE:
                break
            try:
                options = Options(declared.unit, declared.time_step, None, other.parent)
                channels = read_raw(bytes_of(other), other, options)
            except RecordError:
                continue
            sibling = _listed(other, channels, folder)
            together = next((group for group in stations([replace(file), sibling]) if len(group) == 2), None)
            if together:
                known.add(other.resolve())
                yield RockingWarning.of(StudyKind.SIBLING_NOT_USED, file.file, other=other.name)


REPORT = Document(
    "report",
    ".pdf",
    lambda content: content.startswith(b"%PDF-") and b"<pdf:Keywords>rocking</pdf:Keywords>" in content,
)
"""The keyword is set by `reports/layout.typ`."""

STDIN = "-"


def scenes_of(structures: str, stdin: bytes | None = None) -> dict[str, Scene]:
    """Return the scenes of a list: a file, "-" for the list that comes in, or a structure in braces on the line.

    stdin: what comes in. Raises ConfigurationError with every defect.
    """
    if structures == STDIN:
        return load_scenes("the list that comes in", stdin or b"")
    text = structures.strip()
    if text.startswith("["):
        return load_scenes("--structures", text.encode())
    if not text.startswith("{"):
        return load_scenes(structures)
    if not re.search(r"[{,]\s*[\"']?name[\"']?\s*:", text):
        kind = re.search(r"[{,]\s*type:\s*(\w+)", text)
        text = f"{{name: {kind[1].replace('_', ' ') if kind else 'structure'}, {text[1:]}"
    return load_scenes("--structures", f"- {text}".encode())


def assess_stations(
    found: Sequence[OwnStation],
    scenes: dict[str, Scene],
    name: str | None,
    output: Path | None,
    pdf: Path | None,
) -> Iterator[str]:
    """Assess the structure `name` (None: all) of a list under each record, and yield lines of text.

    output: a folder for report.pdf and the tables, laid out like the results of a study; pdf: a file for the report of
    the one record alone; both are checked before any work. Raises RecordError or ConfigurationError before anything is
    written.
    """
    # It loads numba, for which who only reads a file would wait as well.
    from rocking.study.job import Study, assess_catalogued, rows_of, write_report

    if name not in (None, *scenes):
        names = ", ".join(scenes)
        raise ConfigurationError(f"structure is {name!r}, but must be one of those in the list: {names}.")
    if output is not None and output.suffix.lower() == ".pdf":
        raise ConfigurationError(
            f"output is {str(output)!r}, but is a folder; give the file as --pdf {output}."
        )
    if pdf is not None:
        check_target(pdf, REPORT)
    if output is not None:
        for own in found:
            check_target(output / own.record.id / "report.pdf", REPORT)
            check_tables(RECORD_TABLES, output / own.record.id)
        check_tables((WarningRow, StructureRow, CapacityRow), output / "summary")
    if pdf is not None and len(found) != 1:
        ids = ", ".join(own.record.id for own in found)
        raise ConfigurationError(
            f"pdf is {str(pdf)!r}, the report of one record, but there are {len(found)}: {ids}; give --output FOLDER."
        )
    chosen = {structure: scene for structure, scene in scenes.items() if name in (None, structure)}
    study = Study(chosen, Settings(), settings_sha256(Settings(), scenes))
    warnings = list(study.warnings)
    for own in found:
        result = assess_catalogued(own.record, study, study.open(own.record, list(own.channels)))
        rows = rows_of(result, own.record, study)
        warnings += rows.warnings
        if output is not None:
            with written_together():
                write_tables(rows.tables, output / own.record.id)
                write_report(result, rows, study, output / own.record.id)
        if pdf is not None:
            with TemporaryDirectory() as folder:
                write_report(result, rows, study, Path(folder))
                write_whole(pdf, read_whole(Path(folder) / "report.pdf", _LARGEST_REPORT, ConfigurationError))
        peaks = (
            f"{channel.component or 'component not named'} {channel.peak_acceleration / GRAVITY:.3g} g"
            for channel in own.channels
        )
        yield f"{own.record.id} ({own.record.file}): PGA as read {', '.join(peaks)}"
        for station in result.worst_first:
            yield from _lines_of(station, own.record.scale_factor)
        for failure in rows.failures:
            yield f"not assessed: {failure.structure or failure.stage}: {failure.message}"
    yield from to_check(warnings)
    if output is not None:
        of_structures: dict[type[Row], Iterable[Row]] = {
            WarningRow: warnings,
            StructureRow: structure_rows(study.structures, study.settings.acceleration_scale),
            CapacityRow: capacity_rows(study.structures),
        }
        write_tables(of_structures, output / "summary")


_LARGEST_REPORT = 2**28
"""Bytes of a report."""


def _lines_of(station: "PeriodResult", scale_factor: float) -> Iterator[str]:
    """Yield the verdict on a structure with its count and reason, then what each component does by itself."""
    decision = station.decision
    share = f" ({decision.share_in_words})" if decision.share_in_words else ""
    yield f"{placed(station.structure, station.support_period_s)}: {decision.verdict}{share}; {decision.why}"
    for component, case in station.cases.items():
        if case.response is None:
            continue
        facts = [f"  {component or 'component not named'}: {case.response.outcome}"]
        if math.isfinite(case.integrated_rotation_ratio):  # overturning is in the outcome
            facts.append(f"largest rotation {case.integrated_rotation_ratio:.4g} of the critical one")
        predicted = case.predicted_rotation_ratio
        if case.prediction is not None:
            words = "overturning" if math.isinf(predicted) else f"{predicted:.4g}"
            facts.append(f"one pulse predicts {words} ({case.prediction.maximum.regime})")
        if scale_factor != 1:
            facts.append(f"the accelerations of the file were multiplied by {scale_factor:g}")
        yield "; ".join(facts)
