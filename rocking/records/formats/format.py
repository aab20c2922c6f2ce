"""Format: how one kind of file is recognised and read, and the options a caller may declare."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import acceleration_factor, acceleration_unit, positive
from rocking.records.accelerogram import LARGEST_PEAK, Accelerogram, Source
from rocking.records.dates import iso_date
from rocking.records.direction import directed
from rocking.records.formats.layouts import Layouts

Response = Literal["sensitivity", "full"]

_STEPS = (1e-6, 10.0)  # s; a step outside is a misplaced number, not a recorder
_UNDECLARED = (
    "{0} is not declared, neither in the file nor by the caller; declare it: the column {1} of the catalogue, --{2} on "
    "the command line, {0}= in Python."
)


@dataclass(frozen=True)
class Options:
    """The facts that a caller declares beside the file: used where the file is silent, refused where it says otherwise.

    unit: of the numbers. time_step: s. inventory: a StationXML file; folder: where to look for one. response: whether
    counts are divided by the overall sensitivity or the full response is removed. file: its name, whose ending may
    speak of another quantity. layouts: the answers to what tables hold. Raises RecordError for an unknown unit or
    response, or a time step that is not positive.
    """

    unit: str | None = None
    time_step: float | None = None
    inventory: Path | None = None
    folder: Path | None = None
    response: Response = "sensitivity"
    file: str = ""
    layouts: Layouts = field(default_factory=Layouts, compare=False)

    def __post_init__(self) -> None:
        if self.unit is not None:
            acceleration_factor(self.unit)
        if self.time_step is not None:
            positive(RecordError, "time_step", self.time_step, "s")
        if self.response not in ("sensitivity", "full"):
            raise RecordError(f"response is {self.response!r}, but must be 'sensitivity' or 'full'.")

    def unit_of(self, in_file: str | None) -> str:
        """Return the unit the file declares, however spelt, else the caller's.

        Raises RecordError when none or two are declared, or one that is not known.
        """
        unit = in_file or self.unit
        if unit is None:
            raise UndeclaredError(_UNDECLARED.format("unit", "unit", "unit"), "unit")
        factor = acceleration_factor(unit)
        if self.unit is not None and acceleration_factor(self.unit) != factor:
            raise RecordError(f"unit is {unit!r} in the file, but {self.unit!r} was declared; omit it.")
        return acceleration_unit(unit) or unit

    def time_step_of(self, in_file: float | None) -> float:
        """Return the time step [s] the file declares, else the caller's; the two may differ by 0.1 %."""
        step = in_file if in_file is not None else self.time_step
        if step is None:
            raise UndeclaredError(_UNDECLARED.format("time_step", "time_step_s", "time-step"), "time_step")
        step = positive(RecordError, "time_step", float(step), "s")
        if not _STEPS[0] <= step <= _STEPS[1]:
            raise RecordError(f"time_step is {step!r} s, but must be from {_STEPS[0]:g} to {_STEPS[1]:g} s.")
        if self.time_step is not None and abs(self.time_step - step) > 1e-3 * step:
            raise RecordError(f"time_step is {step!r} s in the file, but {self.time_step!r} s was declared.")
        return step

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


@dataclass(frozen=True)
class Format:
    """One kind of file.

    origin: who publishes records in it. signature: what the recogniser looks for, as the end of "no ...".
    first: a pattern that the first lines match, after up to four empty ones; or a function of the whole content that
    never raises.
    read: (content, options) to accelerograms; raises RecordError only, whose message need not name the file; or the
    sentence by which every such file is refused.
    plugin: its name among obspy's formats, where it is offered to obspy.
    yields: whether another format that recognises a file as well has it: bare numbers below any text.
    binary: whether its files hold zero bytes, so that of a text nobody asks.
    """

    name: str
    origin: str
    signature: str
    first: Callable[[bytes], bool] | re.Pattern[str]
    read: Callable[[bytes, Options], list[Accelerogram]] | str
    plugin: str = ""
    yields: bool = False
    binary: bool = False

    def recognise(self, content: bytes) -> bool:
        """Whether `content` is of this format."""
        if self.binary and b"\0" not in content:
            return False
        if not isinstance(self.first, re.Pattern):
            return self.first(content)
        return self.first.match(_EMPTY_LINES.sub("", content[:_OPENING].decode("latin-1"))) is not None


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
            "above the 5 g that no recorder is off by; declare the true unit, or the calibration of counts "
            "(inventory= of miniSEED and SAC)"
        )
        raise RecordError(f"the mean of the record is {offset:.6g} {unit}, {limit}.")
    sentence = f"Mean of the whole record removed, {offset:.6g} {unit}: the offset of the recorder."
    return values - offset, sentence
