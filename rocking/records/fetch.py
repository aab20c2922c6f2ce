"""Fetch: the file of a catalogue row, from mirror, catalogue folder, obspy or network, its hash checked."""

import time
import urllib.request
from contextlib import suppress
from pathlib import Path
from urllib.parse import quote

from rocking.errors import RecordError, about
from rocking.records.catalogue_record import CatalogueRecord
from rocking.records.read import LARGEST_FILE, hash_of

_RETRIES = 3
_PIECE = 2**16
LONGEST_DOWNLOAD, _SILENCE = 300.0, 30.0
"""s; of one file with all its tries, and without a byte."""
_RAW = "https://raw.githubusercontent.com/{repository}/{commit}/{path}"


def fetch(record: CatalogueRecord, mirror: str | Path | None = None, cache: str | Path | None = None) -> Path:
    """Return the path of the record's file after checking its sha256.

    mirror: a folder that is looked into first. cache: where downloads are kept (default: the user's cache folder).
    Raises RecordError naming the record and the file when it cannot be had or its hash differs.
    """
    with about(record.id):
        named = record.example_name is not None
        path = _example(record) if named else _beside(record, record.file, mirror)
        if path is None and record.is_remote:
            source = record.source_repository, record.source_commit, record.source_path
            path = download(record.file, *source, sha256=record.sha256, cache=cache)
        if path is None:
            places = " or ".join(str(folder) for folder in (mirror, record.folder) if folder)
            raise RecordError(f"file {record.file!r} is not in {places}; mend the catalogue or add the file.")
        if record.sha256 and (found := hash_of(path)) != record.sha256:
            raise RecordError(
                f"file {path} has sha256 {found}, but the catalogue says {record.sha256}; it is another version."
            )
        return path


def inventory_of(record: CatalogueRecord, mirror: str | Path | None = None) -> Path | None:
    """Return the path of the record's StationXML, or None when the row names none."""
    if not record.inventory:
        return None
    with about(record.id):
        if path := _beside(record, record.inventory, mirror):
            return path
        raise RecordError(f"inventory {record.inventory!r} is not there; mend the catalogue or add the file.")


def local_files(
    record: CatalogueRecord, mirror: str | Path | None = None, vertical: bool = False
) -> list[Path]:
    """Return the files on this machine that opening `record` would read; none that leads out of its folder.

    Its own file, that of its vertical component where `vertical`, and the StationXML it names; for a miniSEED file that
    names none and declares no unit, every XML file beside it, among which the reader looks.
    """
    own = [] if record.example_name else [record.file]
    named = [*own, record.inventory, *([record.vertical_file] if vertical else [])]
    found = []
    for file in filter(None, named):
        with suppress(RecordError):
            found += [path] if (path := _beside(record, file, mirror)) else []
    sought = [] if record.inventory or record.unit else [path for path in found if _may_hold_counts(path)]
    return [*found, *(xml for path in sought for xml in sorted(path.parent.glob("*.xml")))]


def _may_hold_counts(path: Path) -> bool:
    """Whether a file is miniSEED, or packed so that it may be."""
    from rocking.records.formats.miniseed import MINISEED

    with suppress(OSError), path.open("rb") as stream:
        head = stream.read(256)
        return head.startswith(b"\x1f\x8b") or MINISEED.recognise(head)
    return False


def _beside(record: CatalogueRecord, file: str, mirror: str | Path | None) -> Path | None:
    """Return `file` in the mirror or the catalogue's folder, refusing links that lead out of it."""
    for folder in (mirror, record.folder):
        if folder is None or not (path := Path(folder) / file).is_file():
            continue
        if not path.resolve().is_relative_to(Path(folder).resolve()):
            raise RecordError(f"file {file!r} leads out of {folder}; keep it inside.")
        return path
    return None


def _example(record: CatalogueRecord) -> Path:
    from obspy.core.util.base import get_example_file

    try:
        return Path(get_example_file(record.example_name))
    except (OSError, ValueError):
        raise RecordError(f"obspy installs no example file {record.example_name!r}.") from None


def download(
    file: str, repository: str, commit: str, path: str, *, sha256: str = "", cache: str | Path | None = None
) -> Path:
    """Return where the cache keeps `path` of a GitHub repository, downloaded if need be, its sha256 checked if given.

    Raises RecordError naming `file` when it cannot be had.
    """
    import pooch

    name = f"{(sha256 or commit)[:16]}-{Path(path).name}"
    address = _RAW.format(repository=repository, commit=commit, path=quote(path, safe="/"))
    store = pooch.create(
        path=Path(cache) if cache else pooch.os_cache("rocking"), base_url="",
        registry={name: f"sha256:{sha256}" if sha256 else None}, urls={name: address}, retry_if_failed=_RETRIES,
    )  # fmt: skip
    pooch.get_logger().setLevel("WARNING")
    try:
        return Path(store.fetch(name, downloader=_Downloader()))
    except Exception as error:
        reason = str(error).splitlines()[0][:200] if str(error) else type(error).__name__
        raise RecordError(
            f"file {file!r} cannot be fetched from {address}, {reason}; try again or give a mirror folder."
        ) from error


class _Downloader:
    """Download for pooch, within a size that a record can have and a time, both for all tries together."""

    def __init__(self) -> None:
        self.ends = time.monotonic() + LONGEST_DOWNLOAD

    def __call__(self, address: str, target: str, _: object) -> None:
        request = urllib.request.Request(address, headers={"User-Agent": "rocking"})
        with (
            urllib.request.urlopen(request, timeout=self._left()) as answer,
            Path(target).open("wb") as stream,
        ):
            size = 0
            while piece := answer.read1(_PIECE):
                size += len(piece)
                if size > LARGEST_FILE:
                    raise RecordError(
                        f"the file is larger than {LARGEST_FILE} bytes, which no accelerogram is"
                    )
                stream.write(piece)
                self._left()

    def _left(self) -> float:
        left = self.ends - time.monotonic()
        if left <= 0:
            raise RecordError(f"the download took more than {LONGEST_DOWNLOAD:g} s")
        return min(left, _SILENCE)
