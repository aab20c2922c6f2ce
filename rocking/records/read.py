"""Read: open the bytes, recognise the format, refuse what is not known, dispatch to one reader."""

import hashlib
import zlib
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from errno import EINVAL
from itertools import combinations
from os import fstat
from pathlib import Path

import numpy as np

from rocking.errors import RecordError, UnknownFormatError, about
from rocking.records.accelerogram import Accelerogram, Source
from rocking.records.formats import FORMATS, Format, Options
from rocking.records.formats.format import Response, plain
from rocking.records.formats.site import channel_warnings
from rocking.records.plausibility import pass_limits

LARGEST_FILE = 8 * 2**20
"""Bytes, unpacked: three channels of ten minutes at 100 Hz as text; the worst content of that size reads in seconds."""

_PICKLE = (
    b"\x80\x02",
    b"\x80\x03",
    b"\x80\x04",
    b"\x80\x05",
    b"ccopy_reg",
    b"(iobspy",
    b"cobspy",
    b"c__builtin__",
)


def read(
    path: str | Path,
    *,
    unit: str | None = None,
    time_step: float | None = None,
    inventory: str | Path | None = None,
    response: Response = "sensitivity",
) -> list[Accelerogram]:
    """Return every channel of acceleration in the file at `path`, in the file's order, in m/s².

    unit, time_step [s]: needed where the file does not declare them; refused where it declares otherwise.
    inventory: StationXML of a miniSEED file; by default the one beside it that names the same station.
    response: "sensitivity" divides counts by the overall sensitivity; "full" removes the whole instrument response.
    Raises UnknownFormatError when no reader recognises the file, UndeclaredError when a unit or a time step is declared
    nowhere, RecordError for every other defect.
    """
    path = Path(path)
    name, raw = printable(path.name), bytes_of(path)
    options = Options(unit, time_step, Path(inventory) if inventory else None, path.parent, response)
    source = Source(printable(str(path)), sha256=hashlib.sha256(raw).hexdigest())
    return read_content(unpacked(raw, name), name, options, source)


def read_content(
    content: bytes,
    name: str,
    options: Options,
    source: Source | None = None,
    reader: Format | None = None,
) -> list[Accelerogram]:
    """Return the channels in `content`, as read() does of a file called `name`; `reader` if the format is known.

    source: path and hash of the file, where `content` is not all there is to it.
    """
    source = source or Source(name, sha256=hashlib.sha256(content).hexdigest())
    with about(name[:120]):
        reader = reader or recognise(content)
        records = told_apart(reader.read(content, replace(options, file=name)))
        if not records:
            raise RecordError("the file holds no channel of acceleration.")
        return [_signed(record, replace(source, format=reader.name)) for record in records]


def recognise(content: bytes) -> Format:
    """Return the one format that recognises `content`. Raises UnknownFormatError when none or several do."""
    if not content.strip(b" \t\r\n\0"):
        raise RecordError("the file is empty; fetch it again.")
    if content.startswith(_PICKLE):
        raise UnknownFormatError("this is a pickled Python object, which could run code; it is never opened.")
    found = [form for form in FORMATS if form.recognise(content)]
    if len(found) == 1:
        return found[0]
    if found:
        names = ", ".join(form.name for form in found)
        raise UnknownFormatError(f"several readers recognise this file ({names}); none is preferred.")
    raise UnknownFormatError(
        f"no reader recognises this file, which begins with {_beginning(content)}; "
        "rocking read --details says what each of them looked for.",
        details=tuple(f"{form.name}: no {form.sought}" for form in FORMATS),
    )


def _beginning(content: bytes) -> str:
    """Return the first words of a text, or the first bytes of what is none, in quotation marks."""
    head = content.lstrip()[:40]
    text = head.decode("latin-1").splitlines()[0].strip() if head else ""
    return repr(text if text.isprintable() else head[:8])


def unpacked(raw: bytes, name: str) -> bytes:
    """Return `raw`, all of it unpacked if it is gzip. Raises RecordError when it is damaged or unpacks to too much."""
    if not raw.startswith(b"\x1f\x8b"):
        return raw
    content = b""
    while raw.strip(b"\0"):  # a gzip file may hold several members, and zeros that fill up a block of tape
        unpacker = zlib.decompressobj(wbits=31)
        try:
            content += unpacker.decompress(raw, LARGEST_FILE + 1 - len(content))
        except zlib.error as error:
            raise RecordError(f"{name}: damaged gzip file, {error}; fetch it again.") from None
        if not unpacker.eof or len(content) > LARGEST_FILE:
            raise RecordError(
                f"{name}: the gzip file is truncated or unpacks to more than {LARGEST_FILE} bytes."
            )
        raw = unpacker.unused_data
    return content


def bytes_of(path: Path) -> bytes:
    """Return the bytes of a regular file. Raises RecordError when it is missing or larger than any accelerogram."""
    try:
        if path.exists() and not path.is_file():
            raise OSError(EINVAL, "it is no regular file")
        with path.open("rb") as stream:
            size = fstat(stream.fileno()).st_size
            raw = stream.read(size + 1) if size <= LARGEST_FILE else b""
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise RecordError(
            f"{printable(str(path))}: the file cannot be opened, {reason}; give the path of a record."
        ) from None
    if max(size, len(raw)) > LARGEST_FILE:
        raise RecordError(
            f"{printable(path.name)}: the file is larger than {LARGEST_FILE} bytes, which no accelerogram is."
        )
    return raw


def hash_of(path: Path) -> str:
    """Return the sha256 of a file as it lies on disk. Raises RecordError as bytes_of."""
    return hashlib.sha256(bytes_of(path)).hexdigest()


def printable(text: str) -> str:
    """Return `text`, a name or a message, as it can be printed and written: on one line, without foreign bytes."""
    return plain(text.encode("utf-8", "backslashreplace").decode()) if not text.isprintable() else text


def _signed(record: Accelerogram, source: Source) -> Accelerogram:
    warnings = record.warnings + pass_limits(record)
    return replace(record, source=replace(source, unit=record.source.unit), warnings=warnings)


def told_apart(records: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return the channels of a file, each with a component of its own and what is doubtful of it as warnings.

    One without a name is called after its place, "channel 1"; those that share a name get their place as well.
    Raises RecordError when one channel stands in the file twice: it was appended to itself.
    """
    for (i, a), (k, b) in combinations(enumerate(records, 1), 2):
        if a.component == b.component and _same(a, b):
            raise RecordError(
                f"channel {k} ({a.component or 'not named'}) repeats channel {i} number by number: the file is "
                "appended to itself; fetch it again."
            )
    shared = Counter(record.component for record in records)
    return [
        replace(
            record,
            component=_component(record.component, place, shared[record.component] > 1),
            warnings=(*record.warnings, *channel_warnings(record.component)),
        )
        for place, record in enumerate(records, 1)
    ]


def is_unnamed(record: Accelerogram) -> bool:
    """Whether the component is no more than the place of the channel in its file."""
    return not record.component or record.component.removeprefix("channel ").isdecimal()


def _component(name: str, place: int, shared: bool) -> str:
    if not name:
        return f"channel {place}"
    return f"{name} (channel {place})" if shared else name


def _same(a: Accelerogram, b: Accelerogram) -> bool:
    return a.peak_acceleration > 0 and np.array_equal(a.acceleration, b.acceleration)
