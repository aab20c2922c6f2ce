"""Catalogue: the list of records a study uses, one row for each station, checked before the first file is opened."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from rocking.catalogue.place import Coordinates, place_of
from rocking.described import described, described_values, number_hint
from rocking.earthquakes.sample import MADE
from rocking.errors import CatalogueError, RockingError
from rocking.quantities import acceleration_factor, is_number, listed, shown
from rocking.records.formats.format import plain
from rocking.records.kinds import RecordKind
from rocking.signal.scaling import ScalingTarget
from rocking.tables import edited_text, read_edited
from rocking.warnings import RockingWarning

_OBSPY = "obspy:"
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,79}")
_RESERVED = re.compile(
    r"(con|prn|aux|nul|(com|lpt)\d|summary|datapackage|paper|calibration|documentation|fragility|checks|code_check|"
    r"code_sets|hold|stability|validation|comparison|cracks|calibrate_ensemble|cover|cover_rate|"
    r"cover_earthquakes|govern|stand|floors|fronts|measure_scatter|pulse_shapes|screen|leaves|"
    r"tie_forces|voussoirs|worth|validate|compare|halves|between_ties|anchors|diaphragms|strengthening)(\..*)?",
    re.I,
)
NAME_OF_RECORD = rf"(?!(?i:{_RESERVED.pattern})/)[A-Za-z0-9][A-Za-z0-9._-]*"
"""The form of what may name the folder of a record, for patterns of paths."""
_HASH = re.compile(r"[0-9a-f]{64}")
_COMMIT = re.compile(r"[0-9a-f]{40}")
_REPOSITORY = re.compile(r"(?!\.+/)[\w.-]+/(?!\.+$)[\w.-]+", re.ASCII)
_PROSE = ("event", "station", "licence", "note")
NAMED = 3
"""Names that are given of those that share a sentence."""
_MOST_NAMED = 40
"""Defects of a catalogue that are named; the others are counted."""


@dataclass(frozen=True)
class RecordFile:
    """One file of a record: its name in the catalogue, its sha256 and its path in the source, "" if unknown."""

    name: str
    sha256: str = ""
    source_path: str = ""


@dataclass(frozen=True)
class CatalogueRecord:
    """One row: what a station recorded, where it is, what its files do not say, and what must be true of them.

    Each field but `folder`, that of the catalogue, is a column. Raises CatalogueError with every defect of the row.

    >>> CatalogueRecord("KOBE_TAK", "TAK000.AT2;TAK090.AT2").files[1].name
    'TAK090.AT2'
    """

    id: str = described(
        MISSING, "name of the record in every result: letters, digits, `.`, `_`, `-`; at most 80"
    )
    file: str = described(
        MISSING,
        "path relative to the catalogue or in the mirror, `archive.zip/member` for a file in a zip or tar archive, or "
        "`obspy:NAME` for one that obspy installs; the files of one station, the vertical component among them, are "
        "separated by `;`",
    )
    sha256: str = described(
        "",
        "of each file as it lies on disk, in the order of `file`; a blank one is filled in when a study first "
        "reads the file, and checked from then on",
    )
    source_repository: str = described("", "where on GitHub the files are fetched from, as owner/name")
    source_path: str = described("", "path of each file in that repository, in the order of `file`")
    source_commit: str = described("", "commit of that repository, 40 hexadecimal digits")
    component: str = described(
        "",
        "channels to use, separated by `;` (empty: every horizontal one at the surface); names the channels of "
        "files that leave them unnamed, in the order of `file`",
    )
    vertical_component: str = described(
        "", "the vertical channel, where the file's own name for it does not say so"
    )
    unit: str = described(
        "", "unit of the samples, where the file is silent; a contradiction with the file is an error"
    )
    time_step: float | None = described(None, "time step, where the file is silent", "s", gt=0)
    scale_factor: float = described(1.0, "factor on the acceleration")
    scale_to: str = described(
        "",
        "what the larger peak of the horizontal components is scaled to, by one factor on all components, in place "
        "of scale_factor: `pga 0.35 g` or `pgv 50 cm/s`",
    )
    event: str = described(
        "",
        "the earthquake, for the reader; a day in it overrides that of the file. Cases of a record of which it says "
        f"`{MADE}` are counted apart",
    )
    station: str = described("", "the station, for the reader")
    licence: str = described("", "licence of the files, for the reader")
    inventory: str = described("", "StationXML of a miniSEED or SAC file, a path like `file`")
    high_pass: float | None = described(
        None, "corner of the high-pass filter, where the file does not state it", "Hz", gt=0
    )
    magnitude: float | None = described(None, "magnitude, where the file is silent or errs", ge=-2, le=10)
    epicentral_distance: float | None = described(
        None, "distance from the epicentre, where the file is silent or errs", "km", ge=0, le=20_100
    )
    station_latitude: float | None = described(
        None, "latitude of the station, north, where the file is silent or errs", "deg"
    )
    station_longitude: float | None = described(None, "its longitude, east", "deg")
    epicentre_latitude: float | None = described(None, "latitude of the epicentre, north, for the map", "deg")
    epicentre_longitude: float | None = described(None, "its longitude, east", "deg")
    note: str = described("", "anything else, for the reader")
    folder: Path = Path()

    def __post_init__(self) -> None:
        """Turn the cells of numbers into numbers, and report all that is wrong at once."""
        defects = []
        for name, column in described_values(CatalogueRecord).items():
            if column.kind is str and isinstance(getattr(self, name), str):
                continue
            try:
                object.__setattr__(self, name, column.checked(getattr(self, name)))
            except ValueError as error:
                defects.append(f"{column.key} is {error}")
        checks = (*_checks_of_files(self), *_checks_of_source(self))
        defects += [sentence for is_right, sentence in checks if not is_right]
        if self.scale_factor == 0:
            defects.append("scale_factor is 0, but must not be; leave the row out instead.")
        if self.scale_factor != 1 and self.scale_to:
            given = f"scale_factor is {self.scale_factor:g} together with scale_to {shown(self.scale_to)}"
            defects.append(f"{given}; give one of the two.")
        for cell, check in ((self.unit, acceleration_factor), (self.scale_to, ScalingTarget.parse)):
            if cell:
                try:
                    check(cell)
                except RockingError as error:
                    defects.append(str(error))
        if defects:
            raise CatalogueError(" ".join(defects), record=defects)

    @property
    def is_remote(self) -> bool:
        """Whether the files can be fetched from their source repository."""
        return bool(self.source_repository)

    @property
    def station_place(self) -> Coordinates | RockingWarning | None:
        """Where the station is, or what is wrong with its coordinates; None without them."""
        return place_of(latitude=self.station_latitude, longitude=self.station_longitude)

    @property
    def epicentre(self) -> Coordinates | RockingWarning | None:
        """Where the earthquake began, or what is wrong with its coordinates; None without them."""
        return place_of(latitude=self.epicentre_latitude, longitude=self.epicentre_longitude, of="epicentre")

    @property
    def example_name(self) -> str | None:
        """NAME of "obspy:NAME", else None."""
        return self.file.removeprefix(_OBSPY) if self.file.startswith(_OBSPY) else None

    @property
    def files(self) -> tuple[RecordFile, ...]:
        """The files of the station."""
        names = _parts(self.file)
        blank = ("",) * len(names)
        paths = _parts(self.source_path) or blank
        return tuple(map(RecordFile, names, _parts(self.sha256) or blank, paths))

    @property
    def components(self) -> tuple[str, ...]:
        """The channels asked for by name."""
        return tuple(filter(None, _parts(self.component)))


COLUMNS = tuple(column.key for column in described_values(CatalogueRecord).values())
"""Columns of a catalogue. Required: id and file; sha256 and the source columns for files that are fetched."""


def _parts(cell: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in cell.split(";")) if cell.strip(" ;") else ()


_Check = tuple[object, str]
"""Something that is true where a row is right, and the sentence that is said where it is not."""


def _checks_of_files(record: CatalogueRecord) -> Iterator[_Check]:
    """Yield the checks of the row's name, its files and their hashes."""
    yield (
        is_safe_id(record.id),
        f"id is {shown(record.id)}, but must be a safe file name: letters, digits, . _ -, at most 80, not reserved.",
    )
    names = _parts(record.file)
    hashes = _parts(record.sha256)
    yield names, "file is missing; give a path relative to the catalogue or obspy:NAME."
    paths = [("file", name) for name in names if not stays_inside(name.removeprefix(_OBSPY))]
    if record.inventory and not stays_inside(record.inventory):
        paths.append(("inventory", record.inventory))
    for cell, path in paths:
        yield False, f"{cell} is {shown(path)}, but must be a relative path without '..'."
    for value in filter(None, hashes):
        yield (
            _HASH.fullmatch(value),
            f"sha256 is {shown(value)}, but must be 64 hexadecimal digits in lower case, or blank to be filled in.",
        )
    yield (
        len(hashes) in (0, len(names)),
        f"sha256 holds {len(hashes)} hashes for {len(names)} files; give one for each, separated by ';'.",
    )
    are_hashed = bool(hashes) and all(hashes)
    yield not record.is_remote or are_hashed, "sha256 is missing; a file that is fetched needs it."


def _checks_of_source(record: CatalogueRecord) -> Iterator[_Check]:
    """Yield the checks of where the files are fetched from; none where the row names nothing of it."""
    repository = record.source_repository
    source_path = record.source_path
    commit = record.source_commit
    if not (repository or source_path or commit):
        return
    paths = _parts(source_path)
    yield (
        _REPOSITORY.fullmatch(repository),
        f"source_repository is {shown(repository)}, but must be owner/name.",
    )
    yield (
        len(paths) == len(_parts(record.file)) and all(map(stays_inside, paths)),
        f"source_path is {shown(source_path)}, but must be a relative path without '..' for each file.",
    )
    yield _COMMIT.fullmatch(commit), f"source_commit is {shown(commit)}, but must be 40 hexadecimal digits."


def is_safe_id(text: str) -> bool:
    """Whether `text` can name a record: a file name that every system allows, and no name of a file of results."""
    return bool(_ID.fullmatch(text)) and not text.endswith(".") and not _RESERVED.fullmatch(text)


def stays_inside(path: str) -> bool:
    """Whether `path` is relative, plain, and never leads out of the folder it starts from."""
    parts = PurePosixPath(path).parts
    is_plain = not re.search(r"[\\:;\x00-\x1f]", path)
    return bool(parts) and is_plain and not path.startswith("/") and ".." not in parts


def load_catalogue(path: str | Path) -> tuple[CatalogueRecord, ...]:
    """Return the rows of the CSV file at `path`; raises CatalogueError with every defect of it in one message."""
    path = Path(path)
    rows = read_rows(path)
    records = []
    lines_of: dict[str, list[str]] = {}
    for line, row in rows:
        try:
            records.append(record_of_row(row, path.parent))
        except RockingError as error:
            lines_of.setdefault(str(error), []).append(f"line {line} ({row.get('id') or 'no id'})")
    defects = [f"{listed(places, NAMED)}: {defect}" for defect, places in lines_of.items()]
    counts = Counter(row["id"].strip().lower() for _, row in rows if row["id"].strip())
    twice = [(name, n) for name, n in counts.items() if n > 1]
    defects += [f"id {shown(name)} occurs {n} times (upper and lower case count as one)" for name, n in twice]
    if defects:
        number = "a defect" if len(defects) == 1 else f"{len(defects)} defects"
        rest = len(defects) - _MOST_NAMED
        more = [f"and {rest} more"] if rest > 0 else []
        raise CatalogueError(
            f"{path.name} has {number}: " + " | ".join([*defects[:_MOST_NAMED], *more]), catalogue=defects
        )
    return tuple(records)


def read_rows(path: Path) -> list[tuple[int, dict[str, str]]]:
    """Return line and cells of each row of the catalogue at `path`. Raises CatalogueError for what is no catalogue."""
    rows = read_edited(path, CatalogueError, COLUMNS, ("id", "file"), _NUMBERS)
    if not rows:
        raise CatalogueError(
            f"{path.name}: the catalogue has no rows; give at least one record.", catalogue=rows
        )
    return rows


_NUMBERS = (
    *(column.key for column in described_values(CatalogueRecord).values() if column.kind is not str),
    "scale_to",
)
"""Columns in which a comma can only be a decimal sign."""


def record_of_row(row: Mapping[str, str], folder: Path) -> CatalogueRecord:
    """Return the record of a row of a catalogue in `folder`. Raises CatalogueError at its first defect."""
    values: dict[str, Any] = {"id": "", "file": "", "folder": folder}
    for name, column in described_values(CatalogueRecord).items():
        if cell := (row.get(column.key) or "").strip():
            if column.kind is not str and not is_number(cell):
                raise CatalogueError(
                    f"{column.key} is {shown(cell)}, but must be a number{number_hint(cell)}.",
                    **{column.key: cell},
                )
            values[name] = float(cell) if column.kind is not str else plain(cell) if name in _PROSE else cell
    return CatalogueRecord(**values)


def catalogue_text(
    rows: Iterable[Mapping[str, str]], columns: Sequence[str] = COLUMNS, like: Path | None = None
) -> str:
    """Return `rows` as the text of a catalogue, parted as the one at `like` is, if there is one."""
    return edited_text(rows, columns, like, _NUMBERS)


def repeated(records: Iterable[CatalogueRecord]) -> tuple[RockingWarning, ...]:
    """Return a warning on each record that is an earlier one again: one content and scale, a component in common."""
    warnings = []
    earlier: dict[tuple[str, float, str], list[CatalogueRecord]] = {}
    for record, file in [(row, file) for row in records for file in row.files if file.sha256]:
        same = earlier.setdefault((file.sha256, record.scale_factor, record.scale_to), [])
        chosen = set(record.components)  # none names all
        both = (twin for twin in same if not (chosen and twin.components) or chosen & set(twin.components))
        if other := next(both, None):
            warnings.append(
                RockingWarning.of(
                    RecordKind.RECORD_REPEATED,
                    record.id,
                    file=file.name,
                    other=other.id,
                    other_file=other.file,
                )
            )
        same.append(record)
    return tuple(warnings)
