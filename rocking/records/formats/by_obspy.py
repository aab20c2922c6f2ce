"""The formats that obspy reads, from bytes we have recognised, by the format we name, never by its own guess.

K-NET, Kinemetrics EVT, SAC, and files of counts: miniSEED, GSE, SLIST, TSPAIR, WIN, SEISAN, REFTEK.
"""

import io
import re
import struct
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import positive
from rocking.records.formats import text
from rocking.records.formats.format import Format, Layout, Options, required
from rocking.records.formats.text import LARGEST_SERIES
from rocking.records.kinds import RecordKind
from rocking.records.obspy import workspace
from rocking.records.obspy.inventories import inventory_for
from rocking.records.obspy.one_trace import as_stated, from_traces, header, stated_by_sac
from rocking.records.obspy.traces import first_line, joined, printed
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

_DAMAGE = re.compile(r"integrity|not a SEED record|unexpected end|will not be read|corrupt|mismatch", re.I)
"""The warnings of libmseed when the numbers are not those that were written."""


def _stream(content: bytes, form: str, **options: Any) -> Any:
    """Return obspy's Stream of `content` in its format `form`, joined, and warnings; RecordError for an error."""
    import obspy  # which takes a second to import

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            notes = _check_blocks(content) if form == "MSEED" else []
            with printed() as lines:
                result = obspy.read(io.BytesIO(content), format=form, check_compression=False, **options)
        except RecordError:
            raise
        except Exception as error:
            reason, _, _ = first_line(error).partition(": <_io")  # what an address in memory follows
            reason = re.sub(r" '/[^']*'", "", reason)  # nor a name of our own
            raise RecordError(f"damaged {form} file, {reason}; fetch it again.", format=form) from error
    messages = [first_line(warning.message) for warning in caught] + [first_line(line) for line in lines]
    if form == "MSEED" and (damage := [text for text in messages if _DAMAGE.search(text)]):
        raise RecordError(f"damaged {form} file, {damage[0]}; fetch it again.", format=form)
    _check_size(result)
    notes += [RockingWarning.of(RecordKind.WARNING_OF_OBSPY, text=text) for text in messages]
    for _, station, _, channel, _, begin, length, _ in result.get_gaps():
        if length < 0:
            of = f"{station} {channel}"
            notes.append(
                RockingWarning.of(RecordKind.BLOCKS_OVERLAP, of, overlap_s=float(-length), time=str(begin))
            )
    whole = joined(result)
    if not any(trace.stats.npts for trace in whole):
        raise RecordError(f"the {form} file holds no samples.", samples=0)
    return whole, tuple(sorted(set(notes), key=str))


def _check_size(stream: Any) -> None:
    """Raise RecordError for more samples of all channels than a record has."""
    samples = sum(trace.stats.npts for trace in stream)
    if samples > LARGEST_SERIES:
        raise RecordError(
            f"the file unpacks to {samples} samples, more than {LARGEST_SERIES}; cut it first.",
            samples=samples,
        )


def _check_blocks(content: bytes) -> list[RockingWarning]:
    """Check by the heads of its blocks that a miniSEED file is whole and not too large; a warning of a leap."""
    import obspy  # which takes a second to import
    from obspy.io.mseed.util import get_record_information

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        notes = get_record_information(io.BytesIO(content))
        heads = obspy.read(io.BytesIO(content), format="MSEED", check_compression=False, headonly=True)
    at = 0 if notes.get("excess_bytes") else len(content)
    with suppress(Exception):  # the records may differ in length, and yet end where the file does
        while at < len(content):
            at += get_record_information(io.BytesIO(content), offset=at)["record_length"]
    if at != len(content):
        record = f"the last record of {notes['record_length']} bytes"
        raise RecordError(
            f"{record} is cut after {notes['excess_bytes']}; fetch the whole file.",
            record=notes["excess_bytes"],
        )
    _check_size(heads)
    marks = (content[place : place + 6] for place in range(0, len(content), notes["record_length"]))
    numbers = np.array([int(mark) for mark in marks if mark.isdigit()])
    leaps = np.flatnonzero((np.diff(numbers) != 1) & (numbers[1:] != 1))
    if not 0 < 2 * leaps.size < numbers.size - 1:
        return []
    before = int(numbers[leaps[0]])
    after = int(numbers[leaps[0] + 1])
    return [RockingWarning.of(RecordKind.BLOCKS_LEAP, before=before, after=after)]


_KNET_KEYS = (
    "Origin Time", "Lat.", "Long.", "Depth. (km)", "Mag.", "Station Code", "Station Lat.", "Station Long.",
    "Station Height(m)", "Record Time", "Sampling Freq(Hz)", "Duration Time(s)", "Dir.", "Scale Factor",
    "Max. Acc. (gal)", "Last Correction", "Memo.",
)  # fmt: skip
_KNET = Layout("gal", {
    "rate": r"^Sampling Freq\(Hz\)\s*(.*?)(?:Hz)?$", "duration": r"^Duration Time\(s\)\s*(.*)",
    "component": r"^Dir\.\s*(.*)", "station": r"^Station Code\s*(.*)", "event_time": r"^Origin Time\s*(.*)",
    "magnitude": r"^Mag\.\s*(.*)", "latitude": r"^Station Lat\.\s*(.*)", "longitude": r"^Station Long\.\s*(.*)",
    "elevation": r"^Station Height\(m\)\s*(.*)", "peak": r"^Max\. Acc\. \(gal\)\s*(.*)",
}, mandatory=("duration", "peak"), duration_steps=0.501, duration_digits=0.0, code="BO")  # fmt: skip
"""What the header states about the samples, which are compared with it."""
_KNET_FIRST = re.compile("".join(f"{re.escape(name)}.*\n" for name in _KNET_KEYS[:10]))


def _read_knet(content: bytes, options: Options) -> list[Accelerogram]:
    rows = text.lines(content, len(_KNET_KEYS))
    if missing := [name for name in _KNET_KEYS if not any(row.startswith(name) for row in rows)]:
        raise RecordError(
            f"the header has no line {missing[0]!r}; K-NET's has {len(_KNET_KEYS)} lines.", header=missing[0]
        )
    head = "\n".join(rows)
    # Of "3920.5(gal)" obspy would take the whole part, and "1_0" for a number.
    scale = r"^Scale Factor\s*(\d+)\(gal\)/(\d+)\s*$"
    parts = required("a Scale Factor like 3920(gal)/6182761", scale, head)
    for part in parts.groups():
        positive(RecordError, "Scale Factor", text.number("Scale Factor", part))
    text.check_plain(text.after_lines(content, len(_KNET_KEYS)))
    ((trace,), notes) = _stream(content.decode("latin-1").encode("ascii", "replace"), "KNET")
    stated = as_stated(trace, options.unit_of("gal"), is_due=True)
    facts = header(trace) | {"processing": stated.processing, "warnings": notes}
    facts["event"] = facts["event_time"] = f"{_KNET.text('event_time', head)} JST".strip()
    return [_KNET.channel(head, stated.samples, options, **facts)]


_SAC_HEADER = 632
_VERSION = 304
"""Byte of the header's version (SAC manual, word 76)."""
_SAMPLES = 316
"""Byte of its number of samples (word 79)."""


def _is_sac(content: bytes) -> bool:
    if len(content) <= _SAC_HEADER:
        return False
    for order in "<>":
        version, samples = (struct.unpack_from(order + "i", content, at)[0] for at in (_VERSION, _SAMPLES))
        if version in (6, 7) and samples > 0 and 0 <= len(content) - _SAC_HEADER - 4 * samples <= 176:
            return True
    return False


def _read_sac(content: bytes, options: Options) -> list[Accelerogram]:
    """A unit that is declared wins; without one the samples are counts, which a StationXML turns into acceleration."""
    traces, warnings = _stream(content, "SAC", checksize=True)
    records = []
    for trace in traces:
        _check_extremes(stated_by_sac(trace.stats), trace.data)
        try:
            inventory = inventory_for(trace.stats, options)
        except UndeclaredError as error:
            silent = "unit is not declared, for a SAC file declares none, and"
            raise UndeclaredError(f"{silent} {error}", unit=None) from None
        unit = None if inventory else options.unit_of(None)
        records += _taken([trace], inventory, unit, options, warnings)
    return records


def _taken(
    traces: Any, inventory: Any, unit: str | None, options: Options, warnings: tuple[RockingWarning, ...]
) -> list[Accelerogram]:
    """Return the accelerograms of traces as the file holds them, with what obspy warned of."""
    if inventory is not None:
        options.unit_of("m/s2")  # the name of the file may say something else
    records = []
    for record in from_traces(traces, inventory, unit, options.response, "apply"):
        step = options.time_step_of(record.time_step)
        records.append(replace(record, time_step=step, warnings=(*warnings, *record.warnings)))
    return records


def _check_extremes(header: dict[str, float], data: np.ndarray) -> None:
    """Compare the extremes that a SAC header states with the samples, before any mean is removed."""
    measured = {"depmin": data.min(), "depmax": data.max(), "depmen": data.mean(dtype=float)}
    allowed = 1e-4 * max(abs(header.get(key, 0.0)) for key in ("depmin", "depmax"))
    for key, value in measured.items():
        if allowed and key in header and not abs(header[key] - value) <= allowed:
            stated = f"the header states {key.upper()} = {header[key]:g}, but the samples reach {value:g}"
            raise RecordError(
                f"{stated}; the file is damaged or its header another's; fetch it again.",
                **{key: header[key]},
            )


_TAG = struct.Struct(">cBBBLHHHH")
_FRAME = struct.Struct(">6xL6xH")  # time of a frame's first sample: whole seconds and milliseconds
_FRAME_LENGTH = 100  # ms


def _read_evt(content: bytes, options: Options) -> list[Accelerogram]:
    options.unit_of("m/s2")
    _check_frames(content)
    traces, warnings = _stream(content, "KINEMETRICS_EVT", apply_calib=False)
    return _taken(traces, None, None, options, warnings)


def _check_frames(content: bytes) -> None:
    """Check the sum of each frame, and that one follows another by a tenth of a second."""
    at = 0
    before = None
    while content[at : at + 1] == b"K" and at + _TAG.size <= len(content):
        _, _, _, _, kind, head, body, _, checksum = _TAG.unpack_from(content, at)
        frame = content[at + _TAG.size : at + _TAG.size + head + body]
        if len(frame) < head + body or checksum not in (0, sum(frame) & 0xFFFF) or (kind == 1) != (at == 0):
            raise RecordError(
                f"the frame at byte {at} is cut or damaged: its sum differs; fetch it again.", frame=at
            )
        if kind == 2 and head >= _FRAME.size:
            seconds, milliseconds = _FRAME.unpack_from(frame)
            now = 1000 * seconds + milliseconds
            if before is not None and now - before != _FRAME_LENGTH:
                late = f"the frame at byte {at} begins {now - before} ms after the one before, not {_FRAME_LENGTH} ms"
                raise RecordError(f"{late}: frames are missing, repeated or out of order.", frame=at)
            before = now
        at += _TAG.size + head + body
    if content[at:].strip(b"\0"):
        raise RecordError(
            f"the bytes from {at} on are no frame; the file is damaged, fetch it again.", frame=at
        )


_FIXED_HEADER = re.compile(rb"[0-9 \0]{6}[DRQM][ \0]")


def _read_counts(form: str, content: bytes, options: Options) -> list[Accelerogram]:
    """The samples are counts, turned into acceleration by the StationXML that describes the instrument.

    form: obspy's name of the format. Of a text that states their unit, they may be acceleration already.
    """
    seconds = _seconds_of_win(content) if form == "WIN" else 0
    traces, warnings = _stream(content, form)
    for trace in traces if seconds else ():
        if trace.stats.npts != round(seconds * trace.stats.sampling_rate):
            raise RecordError(
                f"channel {trace.stats.channel} holds {trace.stats.npts} samples in {seconds} s at "
                f"{trace.stats.sampling_rate:g} Hz: seconds of it are missing; fetch the file again.",
                samples=trace.stats.npts,
            )
    heads = (str(trace.stats.ascii.unit) for trace in traces if "ascii" in trace.stats)
    unit = options.unit_in(heads, "the file")
    inventory = None if unit else inventory_for(traces[0].stats, options)
    unit = options.unit_of(unit) if inventory is None else None
    return _taken(traces, inventory, unit, options, warnings)


_GSE_LINE = 81
"""Characters of the longest line of compressed samples (GSE 2.0: 80), with its end."""
_GSE_HEADS = b"WID", b"STA"
"""With which the lines of a header begin, which may be longer."""


def _read_gse(content: bytes, options: Options) -> list[Accelerogram]:
    """The decoder that obspy calls copies each line into a place of 83 characters: a longer one ends the process."""
    is_compressed = re.search(rb"(?m)^WID[12].*CMP?6", content) is not None
    lines = content.split(b"\n") if is_compressed else []
    bodies = (line for line in lines if not line.startswith(_GSE_HEADS))
    if longest := next((line for line in bodies if len(line) > _GSE_LINE), b""):
        raise RecordError(
            f"a line of the samples has {len(longest)} characters, but must have at most 80: the file is damaged; "
            "fetch it again.",
            line=len(longest),
        )
    return _read_counts("GSE2" if content.lstrip().startswith(b"WID2") else "GSE1", content, options)


def _read_lists(content: bytes, options: Options) -> list[Accelerogram]:
    is_of_pairs = b", TSPAIR," in content.partition(b"\n")[0]
    _check_lists(content, is_of_pairs)
    return _read_counts("TSPAIR" if is_of_pairs else "SLIST", content, options)


_LIST_HEAD = re.compile(rb"(?m)^TIMESERIES \S+, *(\d+) samples,.*\n")


def _check_lists(content: bytes, is_of_pairs: bool) -> None:
    """Refuse lists of samples that hold another number of lines or samples than their heads declare: obspy does not."""
    heads = [int(match[1]) for match in _LIST_HEAD.finditer(content)]
    bodies = _LIST_HEAD.split(content)[2::2]
    for declared, body in zip(heads, bodies, strict=True):
        numbers = re.sub(rb"(?m)^[ \t]*\S+", b"", body) if is_of_pairs else body
        text.check_plain(numbers)
        found = len(numbers.split())
        if found != declared:
            raise RecordError(
                f"a head declares {declared} samples, but {found} follow: the file is cut or damaged; fetch "
                "the whole file.",
                samples=found,
            )


def may_be_counts(head: bytes) -> bool:
    """Whether a file that begins with `head`, its first 1024 bytes, may hold counts, which need a StationXML."""
    if any(form.recognise(head) for form in (MINISEED, GSE, LISTS_OF_SAMPLES, WIN, SEISAN, REFTEK)):
        return True
    versions = (struct.unpack_from(order + "i", head.ljust(_SAC_HEADER), _VERSION)[0] for order in "<>")
    return any(version in (6, 7) for version in versions)


def _blocks_of_win(content: bytes) -> Iterator[tuple[int, datetime | None]]:
    """Yield where each block of a second ends, and its time in packed decimals, None where it is none."""
    at = 0
    while at + _WIN_HEAD <= len(content):
        length = int.from_bytes(content[at : at + 4], "big")
        if length <= _WIN_HEAD:
            return
        time = None
        with suppress(ValueError):
            time = datetime.strptime(content[at + 4 : at + _WIN_HEAD].hex(), "%y%m%d%H%M%S")
        at += length
        yield at, time


def _is_win(content: bytes) -> bool:
    """Whether blocks of a second follow one another, each with its length and a time."""
    blocks = list(islice(_blocks_of_win(content), 2))
    ends = len(content) == 1024 or [end for end, _ in blocks] == [len(content)]  # 1024: the start of a file
    is_alone = len(blocks) == 1 and blocks[0][0] + _WIN_HEAD > len(content)
    return (len(blocks) == 2 or (is_alone and ends)) and all(time for _, time in blocks)


def _seconds_of_win(content: bytes) -> int:
    """Return how many seconds a file holds. Raises RecordError where it leaves some out: obspy joins what is left."""
    blocks = list(_blocks_of_win(content))
    times = [time.timestamp() for _, time in blocks if time]
    end = blocks[-1][0] if blocks else 0
    is_whole = len(times) == len(blocks) and end <= len(content) and not content[end:].strip(b"\0")
    if not is_whole or (np.diff(times) != 1).any():
        raise RecordError(
            "the seconds of the file do not follow one another, have no time, or the last is cut; fetch it again.",
            seconds=len(times),
        )
    return len(times)


_WIN_HEAD = 10
"""Bytes of the length of a block and of its time."""
_SEISAN_FIRST = (
    (0, b"KP", 82, b"P"),
    (0, b"\0\0\0P", 84, b"\0\0\0P"),
    (0, b"P\0\0\0", 84, b"P\0\0\0"),
)
"""The marks of a first line of 80 characters and of the second, as compilers of Fortran write them (SEISAN manual)."""


def _is_seisan(content: bytes) -> bool:
    return len(content) >= 12 * 80 and any(
        content.startswith(first, at) and content.startswith(second, then)
        for at, first, then, second in _SEISAN_FIRST
    )


SAC = Format(
    "SAC",
    "SAC (IRIS, and many networks)",
    "SAC header of version 6 or 7 whose number of samples fits the size of the file",
    _is_sac,
    _read_sac,
    binary=True,
)
EVT = Format(
    "Kinemetrics EVT",
    "Kinemetrics recorders",
    "KMI mark at the start of the file",
    lambda content: content[:1] == b"K" and content[:32].count(b"KMI") == 1,
    _read_evt,
    binary=True,
)
MINISEED = Format(
    "miniSEED",
    "FDSN data centres",
    "miniSEED fixed header (six digits, then D, R, Q or M)",
    lambda content: len(content) >= 128 and bool(_FIXED_HEADER.match(content)),
    partial(_read_counts, "MSEED"),
    binary=True,
)
GSE = Format(
    "GSE",
    "CTBTO, ISC and older networks",
    "line WID2, WID1 or XW01 at the start",
    re.compile(r"WID2 \d{4}/|WID1 +\d{7} |XW01 *\n"),
    _read_gse,
)
LISTS_OF_SAMPLES = Format(
    "SLIST or TSPAIR",
    "FDSN data centres",
    "first line TIMESERIES with SLIST or TSPAIR",
    re.compile(r"TIMESERIES \S+,.*, (SLIST|TSPAIR),"),
    _read_lists,
)
WIN = Format(
    "WIN",
    "networks of universities, Japan",
    "two blocks with their length and time in packed decimals",
    _is_win,
    partial(_read_counts, "WIN"),
    binary=True,
)
SEISAN = Format(
    "SEISAN",
    "SEISAN, University of Bergen",
    "marks of two lines of 80 characters as Fortran writes them",
    _is_seisan,
    partial(_read_counts, "SEISAN"),
    binary=True,
)
REFTEK = Format(
    "REFTEK 130",
    "Refraction Technology recorders",
    "packets of 1024 bytes, of which the first is EH, DT or AD",
    lambda content: (
        len(content) % 1024 == 0 and content[:2] in (b"EH", b"DT", b"AD") and b"\0" in content[:16]
    ),
    partial(_read_counts, "REFTEK130"),
    binary=True,
)
KNET = Format(
    "K-NET/KiK-net",
    "NIED, Japan",
    "header that starts with Origin Time, Lat., Long., Depth. (km)",
    _KNET_FIRST,
    _read_knet,
)
ASDF = Format(
    "ASDF station",
    "gmprocess (USGS)",
    "station of an ASDF workspace",
    lambda content: content.startswith(workspace.STATION),
    workspace.read_station,
    binary=True,
)
