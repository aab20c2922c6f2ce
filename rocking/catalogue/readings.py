"""Readings: what the files of a folder gave when they were read, cached by their content."""

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.catalogue.listing import Reading, read_for_listing
from rocking.errors import RecordError, RockingError, fault_in_words, log_fault
from rocking.hashes import sha256_of_bytes, sha256_of_sources
from rocking.records.formats.layouts import Layouts
from rocking.records.formats.tables import COLUMNS
from rocking.records.kinds import RecordKind
from rocking.records.read import bytes_of, printable, signature_in
from rocking.tables import read_whole, write_whole
from rocking.warnings import RockingWarning

if TYPE_CHECKING:
    from pydantic import TypeAdapter

STORE = ".rocking_readings.json"
"""In the folder of the records; it may be removed at any time."""
FAULTS = ".rocking_faults.log"
"""In that folder as well: the tracebacks of errors that no file may cause."""
_LARGEST = 2**27  # bytes: a hundred thousand readings


class Readings:
    """The readings of the files under `folder`, each made once for its content, its name and what is declared.

    layouts: the answers next to the catalogue. is_cached: whether readings are looked for, and stored, in that folder.
    warning: where a store lies there that cannot be used, else None.
    """

    def __init__(self, folder: Path, layouts: Layouts, is_cached: bool = True) -> None:
        self._folder = folder
        self._layouts = layouts
        self._store = folder / STORE
        self._log = folder / FAULTS
        self._is_cached = is_cached
        self._before: dict[str, Reading] = {}
        self._now: dict[str, Reading] = {}
        self._inventory_hashes: dict[Path, str] = {}
        self.warning: RockingWarning | None = None
        if is_cached and self._store.exists():
            try:
                self._before = _stored(self._store)
            except RecordError as error:
                why = str(error).rstrip(".")
                self.warning = RockingWarning.of(RecordKind.READINGS_UNUSABLE, str(self._store), why=why)

    def of(self, path: Path, declared: Mapping[str, Any]) -> Reading:
        """Return the reading of the file at `path`; declared: as read_for_listing takes it."""
        try:
            raw = bytes_of(path)
        except RecordError as error:
            return Reading("", refusal=printable(error.without_place(printable(path.name))))
        sha256 = sha256_of_bytes(raw)
        unit = declared["unit"]
        time_step = declared["time_step"]
        key = json.dumps([sha256, printable(path.name), unit, time_step, self._inventory_hash(path.parent)])
        layouts = self._layouts.at(path.parent.relative_to(self._folder).as_posix())
        reading = self._before.get(key)
        if (
            reading is None
            or reading.sha256 != sha256
            or reading.answer != layouts.text_of(reading.signature)
        ):
            try:
                reading = read_for_listing(raw, sha256, path, declared, layouts)
            except MemoryError:
                raise
            except Exception as fault:  # a file must cost no other file its row, whatever it holds
                log_fault(fault, self._log)
                return Reading(sha256, refusal=printable(fault_in_words(fault, self._log)))
            if not reading.channels or reading.channels[0].format == COLUMNS.name:
                signature = signature_in(raw, path.name, layouts.place)
                reading = replace(reading, signature=signature, answer=layouts.text_of(signature))
        self._now[key] = reading
        return reading

    def cached_of(self, path: Path) -> list[Reading]:
        """Return what is cached of the file at `path` as it is now answered, by whatever was declared of it."""
        sha256 = sha256_of_bytes(bytes_of(path))
        own = (printable(path.name), self._inventory_hash(path.parent))
        layouts = self._layouts.at(path.parent.relative_to(self._folder).as_posix())
        found = []
        for key, reading in self._before.items():
            if reading.sha256 == sha256 and reading.answer == layouts.text_of(reading.signature):
                _, name, _, _, metadata = json.loads(key)
                found += [reading] if (name, metadata) == own else []
        return found

    def _inventory_hash(self, folder: Path) -> str:
        """Return a hash of the StationXML files of a folder, by which counts of the other files are read."""
        if folder not in self._inventory_hashes:
            hashes = []
            for path in sorted(folder.glob("*.xml")):
                with suppress(RecordError):  # of one that cannot be read
                    hashes.append(sha256_of_bytes(bytes_of(path, _LARGEST)).encode())
            self._inventory_hashes[folder] = sha256_of_bytes(*hashes)
        return self._inventory_hashes[folder]

    def save(self) -> None:
        """Keep the readings that were asked for, where the folder can be written in."""
        if not self._is_cached or self._now == self._before:
            return
        content = _adapter().dump_json(self._now).decode()
        store = {"version": _version(), "sha256": sha256_of_bytes(content.encode()), "readings": content}
        with suppress(RockingError):
            write_whole(self._store, json.dumps(store).encode())


def _stored(path: Path) -> dict[str, Reading]:
    """Return the readings in a store. Raises RecordError unless every value of it is what it must be."""
    content = read_whole(path, _LARGEST, RecordError, "the store of readings")
    with suppress(ValueError, KeyError, TypeError, AttributeError, RecursionError):
        store = json.loads(content)
        readings = store["readings"]
        if (store["version"], store["sha256"]) == (_version(), sha256_of_bytes(readings.encode())):
            return _adapter().validate_json(readings, strict=True)
    raise RecordError("another version of the package made these readings, or they are damaged")


@cache
def _adapter() -> "TypeAdapter[dict[str, Reading]]":
    """Return what writes readings as JSON, and reads them by the types of their fields."""
    from pydantic import TypeAdapter  # which takes a quarter of a second to import

    return TypeAdapter(dict[str, Reading])


@cache
def _version() -> str:
    """Return a hash of the sources by which files are read: another reader may read them otherwise."""
    package = Path(__file__).parents[1]
    sources = [
        package / "quantities.py",
        package / "warnings.py",
        package / "tables" / "files.py",
        package / "tables" / "edited.py",
    ]
    for part in ("signal", "records", "catalogue"):
        sources += sorted(path for path in (package / part).rglob("*") if path.suffix in (".py", ".csv"))
    return sha256_of_sources(package, sources)
