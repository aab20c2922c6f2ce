"""Read: open the bytes, recognise the format, refuse what is not known, dispatch to one reader."""

import gzip
import os
import re
import zlib
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from io import BytesIO
from itertools import combinations, islice
from pathlib import Path
from pickletools import genops

import numpy as np

from rocking.earthquakes.sample import MADE
from rocking.errors import RecordError, UndeclaredError, UnknownFormatError, about
from rocking.hashes import sha256_of_bytes
from rocking.quantities import listed, shown
from rocking.records.archive import archive_of, is_archive, member_bytes, members
from rocking.records.claims import (
    direction_in_name,
    point_apart,
    refuse_spectrum,
    says_made,
    vertical_in_name,
    without_end,
)
from rocking.records.direction import (
    contradiction,
    names_no_direction,
    vertical_warning,
    warnings_of_channel,
)
from rocking.records.formats import FORMATS, Format, Options
from rocking.records.formats.format import Response, plain
from rocking.records.formats.layouts import Signature
from rocking.records.formats.tables import signature_of
from rocking.records.formats.text import lines
from rocking.records.kinds import RecordKind
from rocking.records.obspy.inventories import DATALESS, RESP, SACPZ
from rocking.records.plausibility import (
    channel_warnings,
    damage_warnings,
    pass_limits,
    repeated_rows,
    same_motion,
    site_warnings,
)
from rocking.records.sheet import table_of_workbook
from rocking.signal.accelerogram import Accelerogram, Source
from rocking.tables import read_whole
from rocking.tables.sheets import is_workbook
from rocking.warnings import RockingWarning

LARGEST_FILE = 8 * 2**20
"""Bytes, unpacked: three channels of ten minutes at 100 Hz as text; the worst content of that size reads in seconds."""


def read(
    path: str | Path,
    *,
    unit: str | None = None,
    time_step: float | None = None,
    inventory: str | Path | None = None,
    response: Response = "sensitivity",
) -> list[Accelerogram]:
    """Return every channel of acceleration in the file at `path`, in the file's order, in m/s².

    Of an archive (zip, tar, a workspace of gmprocess), those of every file in it; "archive.zip/member" names one.

    What a table leaves open is answered in the layouts.csv next to it, as `rocking catalogue` writes it.

    Parameters
    ----------
    path : str or Path
        File, archive, or member of an archive.
    unit : str or None, optional
        Unit of the samples, needed where the file does not declare it; refused where it declares otherwise.
    time_step : float or None, optional
        Time between two samples, s, needed where the file does not declare it; refused where it declares
        otherwise.
    inventory : str, Path or None, optional
        StationXML, dataless SEED or RESP of a miniSEED or SAC file; None: the StationXML next to it that names the same
        station.
    response : {'sensitivity', 'full'}, default 'sensitivity'
        "sensitivity" divides counts by the overall sensitivity; "full" removes the whole instrument response.

    Returns
    -------
    list of Accelerogram
        One accelerogram a channel, in the file's order, in m/s².

    Raises
    ------
    UnknownFormatError
        When no reader recognises the file.
    UndeclaredError
        When a unit or a time step is declared nowhere.
    RecordError
        For every other defect.

    Examples
    --------
    >>> [record.component for record in rocking.read("records/20161113_110259_WTMC_20.V2A")]
    ['N28W', 'S62W', 'Up']
    """
    if not isinstance(path, str | os.PathLike):
        raise RecordError(
            f"path is {shown(path)}, but must be the path of a file, as a text or a Path.", path=path
        )
    path = Path(path)
    stationxml = Path(inventory) if inventory else None
    options = Options(unit, time_step, stationxml, path.parent, response)
    if is_archive(path):
        return _read_archive(path, options)
    return read_raw(bytes_of(path), path, options)


def _read_archive(path: Path, options: Options) -> list[Accelerogram]:
    """Return the channels of every file in an archive that can be read; the first says which ones cannot.

    Raises RecordError where none can: UndeclaredError if a unit or a time step is missing, else that of the first.
    """
    records: list[Accelerogram] = []
    refused: list[tuple[str, RecordError]] = []
    with about(printable(path.name)):
        for name in members(path):
            try:
                records += read_raw(bytes_of(path / name), path / name, options)
            except RecordError as error:
                refused.append((name, error))
        if not records:
            reasons = [error for _, error in refused] or [
                RecordError("the archive holds no file; fetch it again.", files=0)
            ]
            raise next((error for error in reasons if isinstance(error, UndeclaredError)), reasons[0])
    if refused:
        names = listed([printable(name) for name, _ in refused])
        records[0] = records[0].warned(RockingWarning.of(RecordKind.FILES_NOT_READ, names=names))
    return records


def read_raw(raw: bytes, path: Path, options: Options) -> list[Accelerogram]:
    """Return the channels in `raw`, the bytes of the file at `path`, as read() does."""
    name = printable(path.name)
    source = Source(printable(str(path)), sha256=sha256_of_bytes(raw))
    return read_content(unpack(raw, name), name, options, source)


def read_content(
    content: bytes, name: str, options: Options, source: Source | None = None, reader: Format | None = None
) -> list[Accelerogram]:
    """Return the channels in `content`, as read() does of a file called `name`; `reader` if the format is known.

    source: path and hash of the file, where `content` is not all there is to it.
    """
    source = source or Source(name, sha256=sha256_of_bytes(content))
    with about(name[:120]):
        text = bare_text(content)
        reader = reader or recognise(text)
        try:
            read_by = reader.read(text, replace(options, file=name))
        except RecordError:
            refuse_spectrum(lines(text, _HEAD))
            raise
        records = [
            replace(
                record,
                source=replace(record.source, path=source.path, sha256=source.sha256, format=reader.name),
            )
            for record in _named_by_file(read_by, name)
        ]
        if says_made(lines(text, _HEAD) if b"\0" not in text[:512] else ()):
            records = [replace(record, event=MADE) for record in records]
        if not records:
            raise RecordError(
                "the file holds no channel of acceleration; use the acceleration file.", channels=0
            )
        is_doubled = b"\r\r\n" in content[:2000] and text is not content
        notes = (RockingWarning(RecordKind.LINE_ENDS_DOUBLED),) if is_doubled else ()
        return checked_channels(records, notes, options.scale_factor)


_HEAD = 30
"""Lines in which a header says that it is one of a spectrum, or of a motion that was made."""


def signature_in(raw: bytes, name: str, folder: str) -> Signature | None:
    """Return the signature of the content of a file called `name`, packed or not, as a table of `folder`.

    None where it is none.
    """
    with suppress(RecordError):
        return signature_of(bare_text(unpack(raw, "")), name, folder)
    return None


def checked_channels(
    records: Sequence[Accelerogram], notes: tuple[RockingWarning, ...] = (), scale_factor: float = 1.0
) -> list[Accelerogram]:
    """Return the channels of a file or a stream, with names of their own and all that is doubtful of their samples.

    notes: on all of them. scale_factor: by which the caller will multiply them. Raises RecordError beyond any ground.
    """
    channels = distinct_channels(records)
    of_rows = repeated_rows(channels)
    checked = []
    for record in channels:
        limited = record if abs(scale_factor) >= 1 else record.scaled(scale_factor)
        limits = pass_limits(limited, record.source.format)
        warnings = (*record.warnings, *notes, *limits, *damage_warnings(record), *of_rows)
        checked.append(replace(record, warnings=tuple(dict.fromkeys(warnings))))
    return checked


_BYTES_PER_ZERO = 1000
"""Bytes to each zero byte below which a content is no text: SEISAN on a PC begins with a kilobyte of characters."""


def bare_text(content: bytes) -> bytes:
    """Return a text without a byte order mark and the blanks, zeros and ^Z that pad its end; lines end in \\n.

    UTF-16, as spreadsheets write it, becomes UTF-8. Other content that holds a zero byte among its first, or many
    anywhere, is no text and is returned as it is.
    """
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        with suppress(UnicodeDecodeError):
            content = content.decode("utf-16").encode()
    text = content.removeprefix(b"\xef\xbb\xbf")
    body = text.rstrip(b"\x1a\0 \t\r\n")
    if b"\0" in body[:512] or body.count(b"\0") * _BYTES_PER_ZERO > len(body):
        return content
    ended = any(end in text[len(body) :] for end in (b"\r", b"\n"))
    if b"\r" in body:
        body = body.replace(b"\r\r\n", b"\n").replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    body = without_end(body)
    return body + b"\n" if ended else body


_OTHER_KINDS = tuple((re.compile(pattern, re.I), sentence) for pattern, sentence in (
    (rb"PK\x03\x04", "this is a zip archive; call it .zip, or unpack it."),
    (rb"(.|\n){257}ustar", "this is a tar archive; call it .tar, or unpack it."),
    (rb"BZh|\xfd7zXZ\0", "this is a packed file of bzip2 or xz; unpack it."),
    (DATALESS, "this is a SEED volume: a dataless one holds responses alone, and goes with its record, "
     "rocking.read(record, inventory=path); the samples that a full one holds obspy reads: "
     "rocking.from_obspy(obspy.read(path), inventory=obspy.read_inventory(path))."),
    (RESP, "this is a RESP file, which holds a response and no motion, and goes with its record: "
     "rocking.read(record, inventory=path)."),
    (rb"\x93NUMPY", "this is an array of numpy, which says neither unit nor time step; give it as "
     "rocking.Accelerogram(numpy.load(path), time_step)."),
    (rb"MATLAB 5\.0", "this is a file of MATLAB; export time and acceleration as text, with their units as names."),
    (rb"\xd0\xcf\x11\xe0", "this is a workbook of a spreadsheet of before 2007; save the sheet as CSV."),
    (rb"\s*[{\[]\s*[\"{\[]", "this is JSON; export time and acceleration as text, with their units as names."),
    (rb"\s*(raw|uncorrected)\s+(acceleration\s+)?(counts|data)\b.*format v|\s*raw acceleration",
     "this is a COSMOS V0 file of raw counts of a recorder; use the V1 or V2 file of the same record."),
    (rb"\s*(FILE\s+\d+\s+OF\s+)?CORRECTED ACCELEROGRAM\b", "this is a Volume II file without the component (COMP or "
     "CHAN) in its first line, by which that of USC and CSMIP is read; use the file of the same record from PEER, from "
     "the USGS (SMC), or of Volume I."),
    (rb"\s*((Response and )?Fourier amplitude spectr|Response (and|spectr))",
     "this is a Volume 3 file of spectra, not a time history; use the V1 or V2 file."),
    (rb"\s*\S{1,6} +\S{1,8} +\d{9,10}\.\d+ +-?\d+ +-?\d+ +[\d-]+ +\d{9,10}\.\d+ +\d+ +[\d.]+ +[\d.-]+ ",
     "a CSS table (wfdisc) holds no samples, but names the files that do; read them together: "
     "rocking.from_obspy(obspy.read(path, format='CSS'), inventory=...)."),
    (rb"BEGIN (GSE|IMS)|DATA_TYPE WAVEFORM", "this is a message of GSE or IMS; cut off the lines above its line "
     "WID2, and it is read."),
    (SACPZ, "this is a SAC file of poles and zeros, which holds a response and no motion: read the file "
     "of the samples, with the StationXML of its station as the inventory, which the same data centre serves."),
    (rb"(?s)\s*<.{,350}<FDSNStationXML|\s*<FDSNStationXML",
     "a StationXML holds no samples, but describes an instrument; read the miniSEED."),
    (rb"\s*<\?xml|\s*<q:quakeml", "this is an XML file, which holds no motion; read the record."),
    (rb"(?s)\s*<(!doctype html|html|table|meta)(?=.{0,350}<(table|tr|td)\b|.{0,350}(excel|spreadsheet))",
     "this is a web page with a table, as some programs call .xls; open it in a spreadsheet, and save it as CSV."),
    (rb"\s*<(!doctype html|html|table)", "this is a web page, and no record: the download failed; fetch it again."),
    (rb"\x89HDF", "this is an HDF5 file; call it .h5, by which a workspace of gmprocess (ASDF) is read as an archive "
     "of its stations."),
    (rb"%PDF|7z\xbc\xaf|Rar!", "this is a PDF or an archive; export the record as text, or unpack it."),
))  # fmt: skip
"""Kinds of file that no reader takes, and what to do with each."""


def recognise(content: bytes) -> Format:
    """Return the one format that recognises `content`. Raises UnknownFormatError when none or several do."""
    if not content.strip(b"\0 \n"):
        raise RecordError("the file is empty; fetch it again.", size=0)
    if _is_pickle(content):
        raise UnknownFormatError(
            "this is a pickled Python object, which could run code; it is never opened.", format="pickle"
        )
    forms = [form for form in FORMATS if not form.yields and form.recognise(content)]
    for pattern, sentence in _OTHER_KINDS if not forms else ():
        if pattern.match(content[:400]):
            raise UnknownFormatError(sentence, format=content[:8])
    # Bare numbers last: the text above them takes longer than all the other first lines together.
    forms = forms or [form for form in FORMATS if form.yields and form.recognise(content)]
    if len(forms) == 1:
        return forms[0]
    if forms:
        names = ", ".join(form.name for form in forms)
        raise UnknownFormatError(
            f"several readers recognise this file ({names}); none is preferred.", format=names
        )
    head = content.lstrip()[:40] or b" "
    words = head.decode("latin-1").splitlines()[0].strip()
    raise UnknownFormatError(
        f"no reader recognises this file, which begins with {(words if words.isprintable() else head[:8])!r}; "
        "rocking read --details says why. Or: rocking.from_obspy(obspy.read(path), unit=...).",
        tuple(f"{form.name}: no {form.signature}" for form in FORMATS),
        format=words,
    )


def _is_pickle(content: bytes) -> bool:
    """Whether `content` begins with the opcodes of a pickle of any protocol, of which none is run, and ends as one."""
    if not content.endswith((b".", b".\n")):
        return False
    try:
        first = [opcode.name for opcode, _, _ in islice(genops(content), _OPCODES)]
    except ValueError:
        return False
    return len(first) == _OPCODES or (first[-1] == "STOP" and len(first) > 2)


_OPCODES = 12
"""Opcodes by which a pickle is known; no text begins with so many by chance."""


def unpack(raw: bytes, name: str) -> bytes:
    """Return `raw`, all of it unpacked if it is gzip, and the table of a workbook as text.

    Raises RecordError when it is damaged or unpacks to too much.
    """
    if is_workbook(raw):
        with about(name):
            return table_of_workbook(raw)
    if not raw.startswith(b"\x1f\x8b"):
        return raw
    try:
        content = gzip.GzipFile(fileobj=BytesIO(raw)).read(LARGEST_FILE + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise RecordError(f"{name}: damaged gzip file, {error}; fetch it again.", format="gzip") from None
    if len(content) > LARGEST_FILE:
        raise RecordError(
            f"{name}: the gzip file unpacks to more than {LARGEST_FILE} bytes; cut it first.",
            size=len(content),
        )
    return content


def bytes_of(path: Path, largest: int = LARGEST_FILE) -> bytes:
    """Return the bytes of a regular file, or of a member of an archive.

    Raises RecordError when it is missing, larger than any accelerogram, or an archive itself.
    """
    if archive := archive_of(path):
        return member_bytes(path, archive, largest)
    if is_archive(path):
        with about(printable(path.name)):
            count = len(members(path))
        raise RecordError(
            f"{printable(path.name)}: this is an archive of {count} files; name each of them, as "
            f"{printable(path.name)}/member, or list the folder with rocking catalogue.",
            file=path.name,
        )
    return read_whole(path, largest, RecordError, printable(str(path)))


def printable(text: str) -> str:
    """Return `text`, a name or a message, as it can be printed and written: on one line, without foreign bytes."""
    return plain(text.encode("utf-8", "backslashreplace").decode()) if not text.isprintable() else text


def _named_by_file(records: list[Accelerogram], name: str) -> list[Accelerogram]:
    """Return the channels of a file; a lone one that names no direction is vertical if the file's name is."""
    upwards = vertical_in_name(name)
    word = upwards or direction_in_name(name)[1]
    if not word or word.isdigit() or len(records) != 1:  # digits may count files
        return records
    (record,) = records
    is_open = record.azimuth is None and names_no_direction(record.component)
    if (upwards and not record.vertical and not is_open) or point_apart(word, record.component):
        return [record.warned(RockingWarning.of(RecordKind.DIRECTION_IN_NAME, record.component, word=word))]
    if not upwards or record.vertical or record.borehole:
        return records
    return [replace(record, vertical=True).warned(RockingWarning.of(RecordKind.VERTICAL_BY_NAME, word=word))]


def distinct_channels(records: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return the channels of a file, each with a component of its own and what is doubtful of it as warnings.

    One without a name is called after its place, "channel 1"; those that share a name get their place as well.
    Raises RecordError when one channel is in the file twice: it was appended to itself.
    """
    copies: dict[int, RockingWarning] = {}
    for (i, a), (k, b) in combinations(enumerate(records, 1), 2):
        same = a.component == b.component and a.peak_acceleration > 0
        if same and np.array_equal(a.acceleration, b.acceleration):
            name = f"channel {k} ({a.component or 'not named'})"
            raise RecordError(
                f"{name} repeats channel {i}: the file is appended to itself; fetch it again.", channel=k
            )
        if a.peak_acceleration > 0 and same_motion(a, b):
            other = a.component or f"channel {i}"
            copies[k] = RockingWarning.of(RecordKind.SAME_MOTION, b.component or f"channel {k}", other=other)
    shared = Counter(record.component for record in records if record.component)
    names = [record.component or f"channel {place}" for place, record in enumerate(records, 1)]
    upwards = vertical_warning(
        [replace(record, component=name) for record, name in zip(records, names, strict=True)]
    )
    channels = []
    for place, (record, name) in enumerate(zip(records, names, strict=True), 1):
        own_name = f"{name} (channel {place})" if shared[name] > 1 else name
        warnings = (
            *record.warnings,
            *channel_warnings(record.component),
            *contradiction(record),
            *([copies[place]] if place in copies else []),
            *site_warnings(record.station),
            *site_warnings(record.component),
            *([upwards] if upwards else warnings_of_channel(record)),
        )
        channels.append(replace(record, component=own_name, warnings=tuple(dict.fromkeys(warnings))))
    return channels
