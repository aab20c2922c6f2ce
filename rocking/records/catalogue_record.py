"""CatalogueRecord: one row of a catalogue, checked at birth."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

from rocking.errors import CatalogueError, RockingError
from rocking.quantities import acceleration_factor, finite, positive, within

COLUMNS = (
    "id", "file", "source_repository", "source_path", "source_commit", "component", "vertical_component",
    "vertical_file", "vertical_sha256", "unit",
    "time_step_s", "scale_factor", "event", "magnitude", "epicentral_distance_km", "station", "licence", "sha256",
    "inventory", "high_pass_hz", "note",
)  # fmt: skip
"""Columns of a catalogue. Required: id and file; sha256 and the source columns for files that are fetched."""

_OBSPY = "obspy:"
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,79}")
_RESERVED = {
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{i}" for port in ("com", "lpt") for i in range(10)),
    *(
        "summary",
        "datapackage",
        "paper",
        "calibration",
        "documentation",
        "fragility",
        "validation",
        "comparison",
    ),
}
_HASH = re.compile(r"[0-9a-f]{64}")
_REPOSITORY = re.compile(r"[\w.-]+/[\w.-]+", re.ASCII)


@dataclass(frozen=True)
class CatalogueRecord:
    """One row: where a record is, what its file does not say, and what must be true of it.

    file: path inside `folder` or a mirror, or "obspy:NAME" for an example file that obspy installs. component: which
    channels to use, separated by ";" (empty: every horizontal one at the surface). vertical_component: the channel that
    is vertical where the file's own name for it does not say so. vertical_file, vertical_sha256: another file, beside
    the catalogue or in a mirror, that holds it. unit, time_step [s]: where the file is silent.
    scale_factor: multiplies the acceleration. magnitude, epicentral_distance [m]: where the file is silent or errs.
    inventory: StationXML, a path like `file`. high_pass_frequency: Hz. sha256: of the file as it lies on disk; blank in
    a row added by hand, until it is filled in. folder: of the catalogue. Raises CatalogueError naming the field.
    """

    id: str
    file: str
    sha256: str = ""
    source_repository: str = ""
    source_path: str = ""
    source_commit: str = ""
    component: str = ""
    vertical_component: str = ""
    vertical_file: str = ""
    vertical_sha256: str = ""
    unit: str = ""
    time_step: float | None = None
    scale_factor: float = 1.0
    event: str = ""
    station: str = ""
    licence: str = ""
    inventory: str = ""
    high_pass_frequency: float | None = None
    magnitude: float | None = None
    epicentral_distance: float | None = None
    note: str = ""
    folder: Path = Path()

    def __post_init__(self) -> None:
        if defects := list(_defects(self)):
            raise CatalogueError(" ".join(defects))

    @property
    def is_remote(self) -> bool:
        """Whether the file can be fetched from its source repository."""
        return bool(self.source_repository)

    @property
    def example_name(self) -> str | None:
        """NAME of "obspy:NAME", else None."""
        return self.file.removeprefix(_OBSPY) if self.file.startswith(_OBSPY) else None

    @property
    def of_vertical(self) -> "CatalogueRecord":
        """The row of its vertical_file, which is never fetched; itself where it has none."""
        if not self.vertical_file:
            return self
        return replace(
            self, file=self.vertical_file, sha256=self.vertical_sha256, source_repository="", source_path="",
            source_commit="", vertical_file="", vertical_sha256="",
        )  # fmt: skip

    @property
    def components(self) -> tuple[str, ...]:
        """The channels asked for by name."""
        return tuple(part.strip() for part in self.component.split(";") if part.strip())


def _defects(record: CatalogueRecord) -> Iterable[str]:
    if not is_safe_id(record.id):
        allowed = "a safe file name: letters, digits, . _ -, at most 80, not a reserved name"
        yield f"id is {record.id!r}, but must be {allowed}."
    for name in ("file", "inventory", "vertical_file"):
        if (value := getattr(record, name)) and not stays_inside(value.removeprefix(_OBSPY)):
            yield f"{name} is {value!r}, but must be a relative path without '..'."
    if not record.file:
        yield "file is missing; give a path beside the catalogue or obspy:NAME."
    for name in ("sha256", "vertical_sha256"):
        if (value := getattr(record, name)) and not _HASH.fullmatch(value):
            yield f"{name} is {value!r}, but must be 64 hexadecimal digits in lower case, or blank to be filled in."
    if record.is_remote and not record.sha256:
        yield "sha256 is missing; a file that is fetched needs it."
    yield from _source_defects(record)
    yield from _number_defects(record)


def is_safe_id(text: str) -> bool:
    """Whether `text` can name a record: a file name that every system allows, and no name of a file of results."""
    return (
        bool(_ID.fullmatch(text)) and not text.endswith(".") and text.split(".")[0].lower() not in _RESERVED
    )


def _source_defects(record: CatalogueRecord) -> Iterable[str]:
    source = (record.source_repository, record.source_path, record.source_commit)
    if not any(source):
        return
    if not _REPOSITORY.fullmatch(record.source_repository):
        yield f"source_repository is {record.source_repository!r}, but must be owner/name."
    if not record.source_path or not stays_inside(record.source_path):
        yield f"source_path is {record.source_path!r}, but must be a relative path without '..'."
    if not re.fullmatch(r"[0-9a-f]{40}", record.source_commit):
        yield f"source_commit is {record.source_commit!r}, but must be 40 hexadecimal digits."


def _number_defects(record: CatalogueRecord) -> Iterable[str]:
    yield from _defect(_scale, record.scale_factor)
    if record.unit:
        yield from _defect(acceleration_factor, record.unit)
    if record.time_step is not None:
        yield from _defect(positive, CatalogueError, "time_step_s", record.time_step, "s")
    if record.high_pass_frequency is not None:
        yield from _defect(positive, CatalogueError, "high_pass_hz", record.high_pass_frequency, "Hz")
    if record.magnitude is not None:
        yield from _defect(within, CatalogueError, "magnitude", record.magnitude, -2, 10)
    if record.epicentral_distance is not None:
        distance = record.epicentral_distance / 1000
        yield from _defect(within, CatalogueError, "epicentral_distance_km", distance, 0, 20_100, "km")


def _defect(check: Callable[..., object], *arguments: object) -> Iterable[str]:
    try:
        check(*arguments)
    except RockingError as error:
        yield str(error)


def _scale(value: float) -> None:
    if finite(CatalogueError, "scale_factor", value) == 0:
        raise CatalogueError("scale_factor is 0, but must not be; leave the row out instead.")


def stays_inside(path: str) -> bool:
    """Whether `path` is relative, plain, and never leads out of the folder it starts from."""
    parts = PurePosixPath(path).parts
    plain = not re.search(r"[\\:\0]|[\x00-\x1f]", path)
    return bool(parts) and plain and not path.startswith("/") and ".." not in parts
