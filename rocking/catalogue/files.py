"""The files of a record: where they lie on this machine, fetched if need be, and their hashes in the catalogue."""

import time
import urllib.request
from contextlib import suppress
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import quote

from rocking.catalogue.catalogue import CatalogueRecord, RecordFile
from rocking.errors import RecordError
from rocking.hashes import sha256_of_bytes
from rocking.records.archive import archive_of, ending_of
from rocking.records.formats.by_obspy import may_be_counts
from rocking.records.formats.layouts import NAME, Layouts
from rocking.records.obspy.traces import first_line
from rocking.records.read import LARGEST_FILE, bytes_of, signature_in
from rocking.tables import read_start

_RETRIES = 3
_PIECE = 2**16
LONGEST_DOWNLOAD = 300.0
"""s; of one file with all its tries."""
_SILENCE = 30.0
"""s; without a byte."""
_RAW = "https://raw.githubusercontent.com/{repository}/{commit}/{path}"


def path_of(record: CatalogueRecord, file: RecordFile, mirror: str | Path | None = None) -> Path:
    """Return where `file` of the record lies, downloaded into the user's cache folder if need be.

    mirror: a folder that is looked into first. Raises RecordError naming the file when it cannot be had.
    """
    if record.example_name is not None:
        from obspy.core.util.base import get_example_file  # which takes a second to import

        try:
            return Path(get_example_file(record.example_name))
        except (OSError, ValueError):
            raise RecordError(
                f"obspy installs no example file {record.example_name!r}.", file=record.example_name
            ) from None
    if path := in_catalogue_folder(record, file.name, mirror):
        return path
    if record.is_remote:
        source = record.source_repository, record.source_commit, file.source_path
        return download(file.name, *source, sha256=file.sha256)
    places = " or ".join(str(folder) for folder in (mirror, record.folder) if folder)
    raise RecordError(
        f"file {file.name!r} is not in {places}; correct the catalogue or add the file.", file=file.name
    )


def local_files(record: CatalogueRecord, mirror: str | Path | None = None) -> list[Path]:
    """Return the files on this machine that opening `record` would read; none that leads out of its folder.

    Its own files, or the archives that hold them, and the StationXML it names; for a miniSEED or SAC file, packed or
    not, that names none and declares no unit, every XML file next to it, among which the reader looks.
    """
    own = [] if record.example_name else [file.name for file in record.files]
    paths: list[Path] = []
    inventories: list[Path] = []
    for name in filter(None, [*own, record.inventory]):
        with suppress(RecordError):
            paths += filter(None, [in_catalogue_folder(record, name, mirror)])
    paths = list(dict.fromkeys(archive_of(path) or path for path in paths))
    for path in () if record.inventory or record.unit else paths:
        head = read_start(path, 1024)
        if head.startswith(b"\x1f\x8b") or may_be_counts(head):
            inventories += sorted(path.parent.glob("*.xml"))
    return paths + inventories


def files_by_name(record: CatalogueRecord) -> dict[str, str]:
    """Return the files from which `record` is read as the catalogue names them, with the sha256 that it states.

    Nothing is looked at: the files may lie on another machine. Those that obspy brings or that are downloaded are left
    out. A member of an archive is counted as the archive.
    """
    if record.example_name or record.is_remote:
        return {}
    named: dict[str, str] = {}
    for file in record.files:
        within = Path(file.name)
        outermost = [parent for parent in within.parents if ending_of(parent.name)][-1:]
        path = str(record.folder / (outermost[0] if outermost else within))
        named[path] = named.get(path, "") + file.sha256
    return named


def answers_of(record: CatalogueRecord, mirror: str | Path | None = None) -> dict[str, str]:
    """Return the answer of layouts.csv by which each table of `record` is read, in words with its hash.

    It is part of the content of the record; that of another layout is not.
    """
    layouts = Layouts(record.folder)
    answers = {}
    for file in record.files if layouts.rows else ():
        with suppress(RecordError):
            if path := in_catalogue_folder(record, file.name, mirror):
                own = layouts.at(PurePosixPath(file.name).parent.as_posix())
                answers[file.name] = own.text_of(signature_in(bytes_of(path), path.name, own.place))
    return {f"{NAME} of {name}": sha256_of_bytes(text.encode()) for name, text in answers.items() if text}


def in_catalogue_folder(record: CatalogueRecord, file: str, mirror: str | Path | None) -> Path | None:
    """Return `file` in the mirror or the catalogue's folder, None where neither holds it.

    Raises RecordError for a link that leads out of them.
    """
    for folder in (mirror, record.folder):
        if folder is None:
            continue
        path = Path(folder) / file
        archive = archive_of(path)
        if not (archive or path).is_file():
            continue
        if not path.resolve().is_relative_to(Path(folder).resolve()):
            raise RecordError(f"file {file!r} leads out of {folder}; keep it inside.", file=file)
        return path
    return None


def download(file: str, repository: str, commit: str, path: str, *, sha256: str = "") -> Path:
    """Return where the user's cache keeps `path` of a GitHub repository, downloaded if need be.

    sha256: checked if given. Raises RecordError naming `file` when it cannot be had.
    """
    import pooch  # which only a download needs

    name = f"{(sha256 or commit)[:16]}-{Path(path).name}"
    address = _RAW.format(repository=repository, commit=commit, path=quote(path, safe="/"))
    store = pooch.create(
        path=pooch.os_cache("rocking"),
        base_url="",
        registry={name: f"sha256:{sha256}" if sha256 else None},
        urls={name: address},
        retry_if_failed=_RETRIES,
    )
    pooch.get_logger().setLevel("WARNING")
    try:
        return Path(store.fetch(name, downloader=_Downloader()))
    except Exception as error:
        why = first_line(getattr(error, "reason", None) or error)
        failed = f"file {file!r} cannot be fetched from {address}, {why}"
        raise RecordError(f"{failed}; try again or give a mirror folder.", file=file) from error


class _Direct(urllib.request.HTTPRedirectHandler):
    """Follow a redirect to https only: what comes over http may have been changed on the way."""

    def redirect_request(self, *request: Any) -> urllib.request.Request | None:
        address = str(request[-1])
        if not address.startswith("https://"):
            raise RecordError(f"the server redirects to {address[:100]}, which is not https", newurl=address)
        return super().redirect_request(*request)


class _Downloader:
    """Download for pooch, within a size that a record can have and a time, both for all tries together."""

    def __init__(self) -> None:
        self.ends = time.monotonic() + LONGEST_DOWNLOAD

    def __call__(self, address: str, target: str, _: object) -> None:
        request = urllib.request.Request(address, headers={"User-Agent": "rocking"})
        opener = urllib.request.build_opener(_Direct)
        with (
            opener.open(request, timeout=self._remaining_time()) as answer,
            Path(target).open("wb") as stream,
        ):
            size = 0
            while piece := answer.read1(_PIECE):
                size += len(piece)
                if size > LARGEST_FILE:
                    raise RecordError(f"the file is larger than {LARGEST_FILE} bytes, which no record is")
                stream.write(piece)
                self._remaining_time()

    def _remaining_time(self) -> float:
        remaining = self.ends - time.monotonic()
        if remaining <= 0:
            raise RecordError(f"the download took more than {LONGEST_DOWNLOAD:g} s")
        return min(remaining, _SILENCE)


def with_hashes(record: CatalogueRecord, mirror: str | Path | None = None) -> CatalogueRecord:
    """Return `record` with the sha256 of its files, also of those for which the catalogue states none."""
    hashes = [file.sha256 for file in record.files]
    for i, file in enumerate(record.files):
        with suppress(RecordError):
            hashes[i] = file.sha256 or sha256_of_bytes(bytes_of(path_of(record, file, mirror)))
    return replace(record, sha256=";".join(hashes)) if any(hashes) else record
