"""Format: how one kind of file is recognised and read, and the options a caller may declare.

A format says where in its header each fact is, as a Layout; one reader finds the facts and checks them.
"""

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import NUMBER, acceleration_factor, acceleration_unit, counted, positive
from rocking.records.claims import Claim, Where, agreed, claims_of_name, of_another, refuse_other_quantity
from rocking.records.direction import directed
from rocking.records.doors import advice
from rocking.records.formats.layouts import Layouts
from rocking.records.formats.text import (
    count,
    even_step,
    fields,
    iso_date,
    lines,
    number,
    through_points,
    whole,
)
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import (
    agree_with_header,
    agree_with_mean_square,
    is_down_hole,
    site_warnings,
)
from rocking.signal.accelerogram import LARGEST_PEAK, Accelerogram, Source
from rocking.warnings import RockingWarning

Response = Literal["sensitivity", "full"]

_STEPS = (1e-6, 10.0)  # s; a step outside is a misplaced number, not a recorder
_NO_UNIT = "", "COUNTS", "COUNT", "RAW COUNTS", "INTEGER", "FLOAT"
"""Words in place of a unit: of counts, or the type of a list of samples."""
_UNDECLARED = "{} is not declared, neither in the file nor by the caller; {}."


@dataclass(frozen=True)
class Options:
    """The facts that a caller declares for the file: used where the file is silent, refused where it says otherwise.

    unit: of the numbers. time_step: s. inventory: what describes the instrument; folder: where to look for its
    StationXML. response: whether counts are divided by the overall sensitivity or the full response is removed. file:
    its name, whose ending may speak of another quantity. layouts: the answers to what tables hold; None: those in the
    folder. described: files of StationXML that are looked into before those of the folder. scale_factor: by which the
    caller will multiply the samples, which one below 1 may bring within the limits of a ground motion. is_stand_in:
    whether unit or time step only replace what nobody declares, so that a name that says otherwise is right.
    Raises RecordError for an unknown unit or response, or a time step that is not positive.
    """

    unit: str | None = None
    time_step: float | None = None
    inventory: Path | None = None
    folder: Path | None = None
    response: Response = "sensitivity"
    file: str = ""
    layouts: Layouts | None = field(default=None, compare=False)
    described: tuple[Path, ...] = ()
    scale_factor: float = 1.0
    is_stand_in: bool = False

    def __post_init__(self) -> None:
        if self.unit is not None:
            acceleration_factor(self.unit)
        if self.time_step is not None:
            positive(RecordError, "time_step", self.time_step, "s")
        if self.response not in ("sensitivity", "full"):
            raise RecordError(
                f"response is {self.response!r}, but must be 'sensitivity' or 'full'.", response=self.response
            )

    @property
    def said(self) -> tuple[Claim, ...]:
        """What the caller and the name of the file say."""
        own = Claim("unit", self.unit, Where.OPTION), Claim("time_step", self.time_step, Where.OPTION)
        return own if self.is_stand_in else (*own, *claims_of_name(self.file))

    def unit_in(self, words: Iterable[str], place: str) -> str | None:
        """Return the unit of acceleration that words in the file are, None of counts and of none.

        Raises RecordError for one of velocity or displacement, UndeclaredError for another that no caller settles, and
        for two that differ.
        """
        units = []
        for word in dict.fromkeys(word for word in words if word.upper() not in _NO_UNIT):
            refuse_other_quantity(word)
            units.append(acceleration_unit(word))
            if units[-1] is None and self.unit is None:
                raise UndeclaredError(
                    f"unit is {word!r} in {place}, which is none of acceleration; {advice('unit')} if it is one.",
                    unit=word,
                )
        found: str | None = agreed("unit", [Claim("unit", unit, Where.HEAD) for unit in units])
        return found

    def unit_of(self, in_file: str | None) -> str:
        """Return the unit the file declares, however spelt, else the caller's.

        Raises RecordError when none or two are declared, or one that is not known.
        """
        unit = agreed("unit", (Claim("unit", in_file, Where.HEAD), *self.said))
        if unit is None:
            raise UndeclaredError(_UNDECLARED.format("unit", advice("unit")), unit=None)
        acceleration_factor(unit)
        return acceleration_unit(unit) or unit

    def time_step_of(self, in_file: float | None) -> float:
        """Return the time step [s] the file declares, else the caller's; the two may differ by 0.1 %."""
        if in_file is not None:
            _check_step(in_file)
        step = agreed("time_step", (Claim("time_step", in_file, Where.HEAD), *self.said))
        if step is None:
            raise UndeclaredError(_UNDECLARED.format("time_step", advice("time_step")), time_step=None)
        return _check_step(step)

    def accelerogram(
        self, unit: str | None, values: np.ndarray, time_step: float | None, **fields: Any
    ) -> Accelerogram:
        """Return an Accelerogram from `values` (n,) of a file; unit and time step [s] as the file declares them.

        fields: of Accelerogram, directed by the component's name; text is cleared of control characters,
        and a date is written in ISO 8601.
        """
        fields = {key: plain(value) if isinstance(value, str) else value for key, value in fields.items()}
        fields |= {key: iso_date(fields[key]) for key in ("event", "event_time") if key in fields}
        source = Source(unit=self.unit_of(unit))
        step = self.time_step_of(time_step)
        samples = values * acceleration_factor(source.unit)
        return Accelerogram(samples, step, source=source, **directed(fields))


def _check_step(step: float) -> float:
    """Return a time step, s. Raises RecordError for one that no recorder has."""
    step = positive(RecordError, "time_step", float(step), "s")
    if not _STEPS[0] <= step <= _STEPS[1]:
        raise RecordError(
            f"time_step is {step!r} s, but must be from {_STEPS[0]:g} to {_STEPS[1]:g} s.", time_step=step
        )
    return step


@dataclass(frozen=True)
class Format:
    """One kind of file.

    origin: who publishes records in it. signature: what the recogniser looks for, as the end of "no ...".
    first: a pattern that the first lines match, after up to four empty ones; or a function of the whole content that
    never raises.
    read: (content, options) to accelerograms; raises RecordError only, whose message need not name the file.
    plugin: its name among obspy's formats, where it is offered to obspy.
    yields: whether another format that recognises a file as well has it: bare numbers below any text.
    binary: whether its files hold zero bytes, so that of a text nobody asks.
    """

    name: str
    origin: str
    signature: str
    first: Callable[[bytes], bool] | re.Pattern[str]
    read: Callable[[bytes, Options], list[Accelerogram]]
    plugin: str = ""
    yields: bool = False
    binary: bool = False

    def recognise(self, content: bytes) -> bool:
        """Whether `content` is of this format."""
        if self.binary and b"\0" not in content:
            return False
        if not isinstance(self.first, re.Pattern):
            return self.first(content)
        opening = _EMPTY_LINES.sub("", content[:_OPENING].decode("latin-1"), count=1)
        return self.first.match(opening) is not None


_OPENING = 40_000  # bytes: a hundred lines of the longest header
_EMPTY_LINES = re.compile(r"\A(?:[^\S\n]*\n){0,4}")


def plain(text: str) -> str:
    """Return `text` on one line: control characters and runs of blanks become one blank each."""
    return " ".join(re.sub(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]", " ", text).split())


def without_offset(values: np.ndarray, unit: str) -> tuple[np.ndarray, str]:
    """Return raw `values` less their mean, which is the offset of the recorder, and the sentence that says so.

    Raises RecordError for an offset beyond any recorder's: the peak would hide in it.
    """
    offset = values.mean() if values.size else 0.0
    if abs(offset) * acceleration_factor(unit) > LARGEST_PEAK:
        limit = (
            f"above the 5 g that no recorder is off by; {advice('unit')} as it truly is, or, of counts of miniSEED and "
            f"SAC, {advice('inventory')}"
        )
        raise RecordError(f"the mean of the record is {offset:.6g} {unit}, {limit}.", mean=float(offset))
    sentence = f"Mean of the whole record removed, {offset:.6g} {unit}: the offset of the recorder."
    return values - offset, sentence


Fact = Literal[
    "component", "station", "event", "event_time", "network", "magnitude", "place", "latitude", "longitude",
    "elevation", "distance", "location", "orientation", "channels", "quantity", "unit", "samples", "step", "rate",
    "duration", "start", "high_pass", "corrected", "peak", "peak_time", "rms",
]  # fmt: skip
"""What a header may state; see Layout."""
_NAMES: tuple[Fact, ...] = ("component", "station", "event", "event_time")


WORD = r"([\w/^*]*)"
"""The pattern of a value that is one word, as a unit is."""


def key(name: str, value: str = "(.*)") -> str:
    """Return the pattern of a line like "NAME : value", whose value is like the pattern `value`."""
    return rf"^[ \t]*{re.escape(name)}[ \t]*:[ \t]*{value}"


def keyed(**keys: str) -> dict[str, str]:
    """Return the patterns of a Layout for a header of such lines, from the key of each fact."""
    return {fact: key(name) for fact, name in keys.items()}


@dataclass(frozen=True)
class Layout:
    """The places of the facts in the header of a format, and the layout of its numbers.

    patterns: of each fact, its last group the value. quantity: what the numbers are, which must be acceleration;
    unit: of the numbers; samples: their number; step: s; rate: Hz; duration: s, right within that many steps and that
    share of its last digit (some agencies count n steps for n samples, others n - 1); magnitude: like "6.5 Mw";
    place: like "40.941N, 123.633W"; latitude, longitude: degrees north and east; elevation: m; distance: from the
    epicentre, km; high_pass: Hz; corrected: what says that the numbers are processed, without which a high-pass does;
    start: time of the first sample, hours ahead of universal time; location: of the instrument in a structure; peak,
    rms: in peak_unit, the peak within half a unit of its last digit; peak_time: s after the first sample; orientation,
    channels: of all channels of a file. Raises ValueError for a pattern of a fact that is none of these.
    unit: of the numbers in every file of the format. mandatory: facts without which a file is refused. code: of the
    network, where it is not read. per_line, width: numbers on a line, characters of each, 0 where none touch,
    and of the margin before the first.
    """

    unit: str
    patterns: Mapping[str, str]
    mandatory: tuple[Fact, ...] = ()
    duration_steps: float = 1.001
    duration_digits: float = 0.5
    peak_unit: str = ""
    half_digit: float = 0.0
    ahead: float = 0.0
    code: str = ""
    per_line: int = 1
    width: int = 0
    margin: int = 0

    def __post_init__(self) -> None:
        if unknown := sorted(set(self.patterns) - set(get_args(Fact))):
            raise ValueError(
                f"a header states no {', '.join(unknown)}, but one of {', '.join(get_args(Fact))}."
            )

    def text(self, name: Fact, head: str) -> str:
        """Return what `head` says of the fact `name`, "" where it does not."""
        return optional(self.patterns.get(name, ""), head)

    def number(self, name: Fact, head: str) -> float | None:
        """Return the number that what is said of `name` begins with, None where it begins with none."""
        return optional_number(rf"^\s*({NUMBER})", self.text(name, head))

    def required(self, name: Fact, head: str) -> str:
        """Return what `head` says of `name`. Raises RecordError when it says nothing."""
        return required(name, self.patterns.get(name, ""), head)[1].strip()

    def count(self, head: str) -> int:
        """Return the number of samples. Raises RecordError when it is missing or no whole number."""
        return count("the number of samples", self.required("samples", head))

    def series(self, head: str, rows: list[str], options: Options, **facts: Any) -> list[Accelerogram]:
        """Return channel() of the numbers in `rows`, as many as the header declares, or up to a line more."""
        values, warnings = whole(fields(rows, self.width, self.margin), self.count(head), self.per_line)
        return [self.channel(head, values, options, warnings=warnings, **facts)]

    def channel(
        self,
        head: str,
        values: np.ndarray,
        options: Options,
        *,
        unit: str = "",
        step: float | None = None,
        peak: float | None = None,
        peak_time: float | None = None,
        peak_digit: float | None = None,
        file_samples: np.ndarray | None = None,
        file_times: np.ndarray | None = None,
        total: int = 10**9,
        **fields: Any,
    ) -> Accelerogram:
        """Return the accelerogram of a header and its samples (n,), after holding duration and peak against them.

        unit, step [s], peak and its time where they follow from something else than the patterns; fields: more of an
        Accelerogram, before what the header says. file_samples: (n,) m/s² and file_times: (n,) s as agree_with_header
        takes them. peak_digit: by which the stated peak may be off, by default the layout's. total: number of channels
        in the file. Raises RecordError when something is missing or contradicts the samples.
        """
        unit = unit or self._unit(head)
        for name in self.mandatory:
            number(f"the {name}", self.required(name, head))
        if rate := self.text("rate", head):
            interval = 1 / positive(RecordError, "the rate", number("the rate", rate), "Hz")
            step = step or interval
            check_equal("the step", interval, step)
        elif step is None:
            step = number("the step", self.required("step", head))
        facts = self._facts(head) | fields
        if is_down_hole(self.text("location", head)) or is_down_hole(str(facts.get("station", ""))):
            facts = {"borehole": True} | facts
        record = options.accelerogram(unit, values, step, **facts)
        announced = optional_number(r"\(\s*(\d+)\s+Chns\s+of", head) or 0.0
        if total < announced < 1e4:
            record = record.warned(
                RockingWarning.of(RecordKind.CHANNELS_UNLIKE_HEADER, announced=announced, held=total)
            )
        record = record.warned(*site_warnings(self.text("location", head)))
        if duration := self.text("duration", head):
            rounding = self.duration_digits * 10.0 ** -len(duration.partition(".")[2])
            seconds = number("the duration", duration)
            check_duration(seconds, values.size, record.time_step, self.duration_steps, rounding)
        in_unit = self.peak_unit or unit
        if (rms := self.number("rms", head)) is not None:
            digit = 10.0 ** -len(self.text("rms", head).partition(".")[2])
            record = agree_with_mean_square(record, rms, in_unit, digit)
        if peak is None and (peak := self.number("peak", head)) is not None and peak_digit is None:
            decimals = re.search(r"\.(\d*)(?:[eEdD]([-+]?\d+))?", self.text("peak", head))
            peak_digit = 0.5 * 10.0 ** (int(decimals[2] or 0) - len(decimals[1])) if decimals else 0.5
        at = self.number("peak_time", head) if peak_time is None else peak_time
        digit = self.half_digit if peak_digit is None else peak_digit
        return agree_with_header(record, peak, in_unit, digit, at, file_samples, file_times)

    def channels(
        self,
        head: str,
        table: np.ndarray,
        labels: Sequence[str],
        options: Options,
        *,
        peaks: Sequence[float | None] | None = None,
        **fields: Any,
    ) -> list[Accelerogram]:
        """Return channel() of each column of `table` (n, channels), named by `labels`; peaks: stated of each.

        Raises RecordError where it has fewer rows than the header declares, as series() does.
        """
        if "samples" in self.patterns:
            fields["warnings"] = (
                *fields.get("warnings", ()),
                *whole(table[:, 0], self.count(head), per_line=1)[1],
            )
        rows = zip(labels, table.T, peaks or [None] * len(labels), strict=True)
        facts = (({"component": label, "peak": peak} | fields, values) for label, values, peak in rows)
        return [self.channel(head, values, options, **of_one) for of_one, values in facts]

    def through(
        self, head: str, times: np.ndarray, values: np.ndarray, options: Options, **facts: Any
    ) -> Accelerogram:
        """Return channel() of `values` (n,) at `times` (n,) s; points of film, which are uneven, are joined by lines.

        They lie where the trace bends, a dozen to a hundred a second.
        """
        step = even_step(times)
        if step is None:
            step, even, note = through_points(times)
            facts["warnings"] = (*facts.get("warnings", ()), note)
            facts |= {"processing": (str(note),), "file_times": times}
            facts["file_samples"] = values * acceleration_factor(self.unit)
            values = np.interp(even, times, values)
        return self.channel(head, values, options, step=step, **facts)

    def _unit(self, head: str) -> str:
        """Return the unit of the numbers. Raises RecordError where they are not acceleration in the format's unit."""
        if "quantity" in self.patterns:
            quantity = self.required("quantity", head)
            if quantity.lower() not in ("acceleration", "accelaration"):  # as RESORCE spells it
                raise of_another(quantity)
        if "unit" not in self.patterns:
            return self.unit
        unit = self.required("unit", head)
        refuse_other_quantity(unit)
        if acceleration_factor(unit) != acceleration_factor(self.unit or unit):
            raise RecordError(f"unit is {unit!r}, but must be {self.unit!r} in this format.", unit=unit)
        return self.unit or unit

    def _facts(self, head: str) -> dict[str, Any]:
        north = self.number("latitude", head)
        east = self.number("longitude", head)
        height = self.number("elevation", head)
        stated = self.number("high_pass", head) or 0.0
        high_pass = stated if 0 < stated < 100 else None  # no -999
        return {
            **{name: self.text(name, head) for name in _NAMES},
            "network": self.code or self.text("network", head),
            **typed_magnitude(self.text("magnitude", head)),
            **coordinates(self.text("place", head)),
            **site(north, east, height),
            "start_time": universal(self.text("start", head), self.ahead),
            "epicentral_distance": distance(self.number("distance", head)),
            "high_pass_frequency": high_pass,
            "processed": bool(self.text("corrected", head) if "corrected" in self.patterns else high_pass),
        }


LONGEST_HEADER = 200
"""Lines of the header of a format, at most; real ones have up to 160."""


def parted(content: bytes, end: int | Callable[[str], object], what: str = "") -> tuple[str, list[str]]:
    """Return the header of a text and the lines below, as a number of lines or up to the first that is its `end`.

    Raises RecordError when the longest header has no such line, described by `what`.
    """
    text = lines(content)
    at = (
        next((i for i, line in enumerate(text[:LONGEST_HEADER]) if end(line)), None) if callable(end) else end
    )
    if at is None:
        raise RecordError(f"no line {what}; the file is cut.", header=what)
    return "\n".join(text[:at]), text[at:]


def in_blocks(
    first_line: re.Pattern[str], read: Callable[[list[str], Options, int], Accelerogram | None]
) -> Callable[[bytes, Options], list[Accelerogram]]:
    """Return the reader of a format whose channels are blocks that start at a line that matches `first_line`.

    read: makes an accelerogram of the lines of a block, the options and the number of blocks, or None of another
    quantity.
    """

    def read_blocks(content: bytes, options: Options) -> list[Accelerogram]:
        text = lines(content)
        starts = [i for i, line in enumerate(text) if first_line.match(line)]
        ends = [*starts[1:], len(text)]
        records = (read(text[a:b], options, len(starts)) for a, b in zip(starts, ends, strict=False))
        return [record for record in records if record is not None]

    return read_blocks


def required(what: str, pattern: str, text: str) -> re.Match[str]:
    """Return the first match of `pattern` in `text`. Raises RecordError saying `what` the header lacks."""
    match = re.search(pattern, text, re.I | re.M) if pattern else None
    if not match or not match[1].strip():
        raise RecordError(
            f"the header does not declare {what}; the file is damaged or another; fetch it again.",
            header=what,
        )
    return match


def optional(pattern: str, text: str) -> str:
    """Return the last group of the first match of `pattern` in `text`, stripped, or ""."""
    match = re.search(pattern, text, re.I | re.M) if pattern else None
    return (match[match.lastindex or 0] or "").strip() if match else ""


def optional_number(pattern: str, text: str) -> float | None:
    """Return the first group of the first match as a float, or None when there is none or it is no number."""
    try:
        return float(optional(pattern, text).replace("_", "?"))
    except ValueError:
        return None


_TIME = re.compile(r"(\d{4})\D?(\d\d)\D?(\d\d)\D?(\d\d)\D?(\d\d)\D?(\d\d(?:\.\d{1,6})?)\d*")


def universal(text: str, ahead: float) -> str:
    """Return a printed time, `ahead` h of universal time, as ISO 8601 of universal time; "" where it is none."""
    match = _TIME.fullmatch(text)
    try:
        printed = datetime.fromisoformat("{}-{}-{}T{}:{}:{}".format(*match.groups())) if match else None
        return f"{(printed - timedelta(hours=ahead)).isoformat()}Z" if printed else ""
    except (ValueError, OverflowError):
        return ""


def distance(kilometres: float | None) -> float | None:
    """Return the distance in m that a header gives in km, or None where it says none (-999, 32767, nothing)."""
    return 1000 * kilometres if kilometres is not None and 0 <= kilometres <= 20_100 else None


_SCALES = {scale.lower(): scale for scale in ("Mw", "Ms", "M", "ML", "mb")}
"""The scales of magnitude, the preferred one first."""
_TYPED = re.compile(r"(?i)\b(M[wslb]?)(?![a-z])\W{0,3}(\d\d?(?:\.\d+)?)|(\d\d?(?:\.\d+)?)\s*\(?(M[wslb]?)\b")


def typed_magnitude(text: str) -> dict[str, Any]:
    """Return magnitude and magnitude_type of a text like "6.5 Mw", "4.0(Ms)" or "/mb=6.1/Mw=7.1", by preference.

    A number without a scale counts where none has one; 0 and below mean none.
    """
    spaced = " ".join(text.split())
    values = {}
    for match in _TYPED.finditer(spaced):
        scale = match[1] or match[4]
        value = match[2] or match[3]
        values[scale.lower()] = float(value)
    values[""] = optional_number(r"(-?\d+(?:\.\d+)?)", spaced) or 0.0

    plausible = {scale: value for scale, value in values.items() if 0 < value <= 10}
    preferred = next((scale for scale in _SCALES if scale in plausible), "")
    return {"magnitude": plausible.get(preferred), "magnitude_type": _SCALES.get(preferred, "")}


_ANGLE = r"(\d{1,3}(?:\.\d+)?)(?:[ °]+(\d\d?)[ ']+(\d\d?))?[ °\"]*(?:LAT\.? *|LONG?\.? *)?"
_POLE = r"([NS])(?:orth|orte|outh|ur)?\b"
_SIDE = r"([EWO])(?:ast|est|este|ste)?\b"
_COORDINATES = re.compile(rf"{_ANGLE}{_POLE}[\s.,;:/-]*{_ANGLE}{_SIDE}", re.I)


def coordinates(text: str) -> Mapping[str, float]:
    """Return latitude and longitude, degrees, of a text like "40.941N, 123.633W" or "42 37 10S 173 03 13E".

    O is west (oeste), as Spanish headers write it.
    """
    if not (match := _COORDINATES.search(text)):
        return {}
    angles = []
    for degrees, minutes, seconds, side in (match.groups()[:4], match.groups()[4:]):
        angle = float(degrees) + float(minutes or 0) / 60 + float(seconds or 0) / 3600
        angles.append(-angle if side.upper() in "SWO" else angle)
    return site(*angles)


def site(north: float | None, east: float | None, elevation: float | None = None) -> dict[str, float]:
    """Return latitude and longitude [degrees] and elevation [m], each where it can be: no -999, and not 0, 0."""
    places = [math.nan if value is None else value for value in (north, east)]
    is_place = (north, east) != (0, 0) and abs(places[0]) <= 90 and abs(places[1]) <= 180
    facts = {"latitude": places[0], "longitude": places[1]} if is_place else {}
    return facts | ({"elevation": elevation} if elevation is not None and -500 < elevation < 9000 else {})


def check_duration(declared: float, samples: int, time_step: float, steps: float, rounding: float) -> None:
    """Check `samples` against a duration, s, within `steps` and `rounding`, s. Raises RecordError for another."""
    lasts = samples * time_step
    if abs(lasts - declared) > steps * time_step + rounding:
        stated = f"the header declares a duration of {declared:g} s, but {samples} samples last {lasts:g} s"
        raise RecordError(
            f"{stated}: the file is truncated or its header another's; fetch it again.", duration=declared
        )


def check_equal(field: str, first: float, second: float, relative: float = 1e-3) -> None:
    """Check that two places of a header give the same number. Raises RecordError when they do not."""
    if abs(first - second) > relative * abs(first):
        raise RecordError(
            f"the header gives {field} as {first:g} and {second:g}; fetch the file again.",
            **{field: (first, second)},
        )


def check_end(rows: list[str]) -> None:
    """Check that nothing but blanks follows the last channel. Raises RecordError: a channel is cut."""
    if more := sum(bool(row.strip()) for row in rows):
        raise RecordError(
            f"below the last whole channel the file holds {counted(more, 'line')}: another is cut; fetch it again.",
            lines=more,
        )
