"""Listing: what the files of a folder hold, without their samples, so that many fit into memory."""

import re
import shutil
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from rocking.catalogue.catalogue import NAMED, stays_inside
from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import GRAVITY, counted, listed
from rocking.records.doors import through
from rocking.records.formats import Options
from rocking.records.formats.layouts import NAME, AskedError, Layouts, Question, Signature, Trial, families
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import OF_COUNTS
from rocking.records.read import printable, read_raw
from rocking.signal.accelerogram import WEAK_PEAK, Accelerogram
from rocking.signal.kinds import SignalKind
from rocking.signal.measures import end_of_shaking
from rocking.signal.processing import process, velocity
from rocking.warnings import Kind, RockingWarning

CELLS = {"unit": "unit", "time_step": "time_step_s"}
"""The column of a catalogue that declares what a file leaves out."""
_STAND_INS: dict[str, Any] = {"unit": "nm/s2", "time_step": 0.01}
"""With which a file that declares none is looked at; in so small a unit no counts are beyond what ground does."""
_BAD_NAME = "its name holds a character that a catalogue does not allow, or a blank at its end; rename it."
_LEADS_OUT = "it is a link that leads out of the folder; copy the file instead."
_OF_UNIT = (
    SignalKind.PEAK_IMPOSSIBLE,
    RecordKind.PEAK_RARE,
    RecordKind.PEAK_TINY,
    RecordKind.PEAK_TINY_BY_UNIT,
    RecordKind.SAMPLE_ALONE,
    RecordKind.PEAK_UNLIKE_HEADER,
    RecordKind.MEAN_SQUARE_UNLIKE_HEADER,
)
"""What says nothing where the unit is a stand-in."""
_OF_DIRECTION = (RecordKind.DIRECTION_UNKNOWN, RecordKind.VERTICAL_BY_NAME, RecordKind.DIRECTION_IN_NAME)
"""What is no longer in doubt where a row says the direction."""


@dataclass(frozen=True)
class ListedChannel:
    """One channel of a listed file, as the fields of an Accelerogram say it, without its samples.

    samples: their number; shaking: those up to the end of its D5–95. peak_acceleration, peak_velocity:
    as they are listed, in g and m/s; "" where the unit or the time step is not known; PGV as a study clears the record
    by default, "" where it is too short for that.
    """

    component: str
    format: str
    answer: str
    time_step: float
    samples: int
    shaking: int
    peak_acceleration: str
    peak_velocity: str
    network: str
    station: str
    location: str
    event: str
    event_time: str
    start_time: str
    azimuth: float | None
    vertical: bool
    borehole: bool
    processed: bool | None

    @property
    def is_horizontal(self) -> bool:
        """Whether it is a horizontal component at the surface."""
        return not self.vertical and not self.borehole


@dataclass(frozen=True)
class Reading:
    """The findings of reading one file, whatever else lies in its folder.

    warnings: what is plausibly wrong, about the components where not all are concerned. refusal: why it cannot be read,
    or "". missing: what it does not declare, of the keys of CELLS. question: what layouts.csv asks of a table;
    signature: of a table, and the answer by which it was read, "" where there was none.
    """

    sha256: str
    channels: tuple[ListedChannel, ...] = ()
    warnings: tuple[RockingWarning, ...] = ()
    refusal: str = ""
    missing: tuple[str, ...] = ()
    question: Question | None = None
    signature: Signature | None = None
    answer: str = ""


@dataclass
class ListedFile:
    """One file of a folder as it was read, and the id of its catalogue row, "" if it cannot be used.

    warnings: what is plausibly wrong. refusal: why it gets no row, or "". separation: why it does not share the row of
    other files of its station; None where it does, or there are none. blanks: the cells that its row leaves blank and
    that must be filled; declarations: those that hold what its header does not say. direction: of its component, where
    only the file's name or its row says it. companions: number of other files in its row. is_repeat: whether it has the
    content of an earlier file. question: what layouts.csv asks of it.
    """

    file: str
    sha256: str = ""
    channels: tuple[ListedChannel, ...] = ()
    refusal: str = ""
    warnings: tuple[RockingWarning, ...] = ()
    declarations: dict[str, str] = field(default_factory=dict)
    blanks: tuple[str, ...] = ()
    direction: str = ""
    separation: RockingWarning | None = None
    record: str = ""
    companions: int = 0
    is_repeat: bool = False
    question: Question | None = None

    @property
    def separated(self) -> str:
        """Why it does not share the row of other files, in words; "" where it does, or there are none."""
        return (
            f"Not joined with the other files of its station: {self.separation}." if self.separation else ""
        )


# Whole on purpose: a file is read, asked what it leaves open, and read again with that.
@through("catalogue")
def read_for_listing(
    raw: bytes, sha256: str, path: Path, declared: Mapping[str, Any], layouts: Layouts
) -> Reading:
    """Return what the content `raw` of the file at `path` gives.

    declared: unit and time_step [s], None where the caller knows none; each is used only where the file is silent.
    """
    missing: tuple[str, ...] = ()
    question: Question | None = None
    asked: UndeclaredError | None = None
    while True:
        values = {name: declared[name] or _STAND_INS[name] for name in missing}
        try:
            is_stand_in = not all(declared[name] for name in missing)
            options = Options(folder=path.parent, layouts=layouts, is_stand_in=is_stand_in, **values)
            channels = read_raw(raw, path, options)
            break
        except UndeclaredError as error:
            question = question or (error.question if isinstance(error, AskedError) else None)
            if error.field in missing or error.field not in CELLS:
                refusal = printable(error.without_place(printable(path.name)))
                return Reading(sha256, refusal=refusal, question=question)
            missing = (*missing, error.field)
            asked = asked or error
        except RecordError as error:
            # A unit that stood in for one that nobody declared is no reason to refuse: what is missing is.
            stood_in = asked is not None and not all(declared[name] for name in missing)
            reason = asked if asked is not None and stood_in else error
            return Reading(sha256, refusal=printable(reason.without_place(printable(path.name))))
    is_known = all(declared[name] for name in missing)
    is_unit_known = "unit" not in missing or bool(declared["unit"])
    warnings = list(_warnings_of(channels, () if is_unit_known else _OF_UNIT))
    if not is_unit_known and channels[0].source.format in OF_COUNTS:
        warnings.append(RockingWarning(RecordKind.COUNTS_WITHOUT_UNIT))
    listed = tuple(without_samples(channel, is_known) for channel in channels)
    return Reading(sha256, listed, tuple(warnings), missing=missing, question=None if is_known else question)


def reading_of(channels: Sequence[Accelerogram]) -> Reading:
    """Return what the channels of one file give, which were read with all that it leaves open."""
    listed = tuple(without_samples(channel, is_known=True) for channel in channels)
    return Reading(channels[0].source.sha256, listed, _warnings_of(channels))


def _warnings_of(
    channels: Sequence[Accelerogram], passed_over: Collection[Kind] = ()
) -> tuple[RockingWarning, ...]:
    """Return what is doubtful of the channels of a file, about the components where not all are concerned."""
    warnings: dict[RockingWarning, list[str]] = {}
    for channel in channels:
        for warning in channel.warnings:
            if warning.kind not in passed_over:
                warnings.setdefault(warning, []).append(channel.component)
    return tuple(
        warning if len(of) == len(channels) or warning.about else replace(warning, about=", ".join(of))
        for warning, of in warnings.items()
    )


def without_samples(record: Accelerogram, is_known: bool) -> ListedChannel:
    """Return what is listed of a channel, with its peaks where unit and time step are known."""
    of_record: dict[str, Any] = {fact.name: getattr(record, fact.name, "") for fact in fields(ListedChannel)}
    speed = ""  # of a record that is too short to be processed
    with suppress(RecordError):
        speed = f"{abs(velocity(process(record))).max():.3g}" if is_known else ""
    of_record |= {
        "format": record.source.format,
        "answer": record.source.answer,
        "samples": record.acceleration.size,
        "shaking": end_of_shaking(record.acceleration),
        "peak_acceleration": f"{record.peak_acceleration / GRAVITY:.3g}" if is_known else "",
        "peak_velocity": speed,
    }
    return ListedChannel(**of_record)


def listed_file(reading: Reading, path: Path, folder: Path, declared: Mapping[str, Any]) -> ListedFile:
    """Return the file at `path` as it is listed, with what its name adds to its `reading`."""
    file = printable(path.relative_to(folder).as_posix())
    return ListedFile(
        file=file,
        sha256=reading.sha256,
        channels=reading.channels,
        refusal=reading.refusal or _why_not_listed(path, folder),
        warnings=reading.warnings,
        declarations={CELLS[name]: f"{declared[name]}" for name in reading.missing if declared[name]},
        blanks=tuple(CELLS[name] for name in CELLS if name in reading.missing and not declared[name]),
        question=reading.question,
    )


def _why_not_listed(path: Path, folder: Path) -> str:
    """Return why a catalogue in `folder` cannot name the file at `path`, or ""."""
    name = path.relative_to(folder).as_posix()
    if not stays_inside(name) or name != name.strip() or name != printable(name):
        return _BAD_NAME
    if not path.resolve().is_relative_to(folder.resolve()):
        return _LEADS_OUT
    return ""


def warnings_of(file: ListedFile) -> list[RockingWarning]:
    """Return the warnings about a file that hold whatever its row calls it."""
    return [warning for warning in file.warnings if not (file.direction and warning.kind in _OF_DIRECTION)]


_FEWEST_TRIED = 2
"""Files of an answer whose peaks together are not those of a folder of records."""
_STRONG_SHARE = 1 / 3
"""The share of files above 1 g that no folder of records has: of NGA-West2 less than one in a hundred is."""


def trials(
    listed: Sequence[ListedFile], lines: Mapping[str, tuple[int, float]], layouts: Layouts
) -> dict[int, Trial]:
    """Return what comes of each answer of layouts.csv on all its files, by its line.

    lines: of each file, 0 where none answers for it, and its peak by that, m/s², which counts where it is refused as
    too strong. Read by an answer with another unit, its files together are stronger or weaker than those of any folder.
    """
    peaks: dict[int, list[float]] = {}
    for file in listed:
        line, by_answer = lines[file.file]
        known = [float(channel.peak_acceleration) for channel in file.channels if channel.peak_acceleration]
        if file.refusal:
            known = [by_answer / GRAVITY] if by_answer > GRAVITY else []
        if known and line:
            peaks.setdefault(line, []).append(max(known))
    found = {}
    for line, of_line in peaks.items():
        is_weak = max(of_line) * GRAVITY < WEAK_PEAK
        unusual = of_line if is_weak else [peak for peak in of_line if peak > 1.0]
        words = f"{counted(len(of_line), 'file')}, {min(of_line):.3g}–{max(of_line):.3g} g"
        if len(unusual) < _FEWEST_TRIED or len(unusual) <= _STRONG_SHARE * len(of_line):
            found[line] = Trial(words, may_hold=True)
            continue
        where = f"below {WEAK_PEAK / GRAVITY:g}" if is_weak else "above 1"
        why = (
            f"so {len(unusual)} of its {len(of_line)} files would be {where} g, as no folder of records is; leave the "
            "unit out of the answer, and fill in the column unit of the catalogue for each, or take the ? away again "
            "to insist."
        )
        found[line] = Trial(why, may_hold=layouts.insists(line, why))
    return found


_HEAD = ("file", "component", "format", "step s", "samples", "PGA g", "PGV m/s")
_ALIGNED = "<<<>>>>"
_NARROWEST = {0: 16, 2: 8, 1: 6}
"""Columns that are narrowed where the table is wider than the terminal, in that order, and how far, in characters."""
_GAP = "  "
_FALLBACK = 100
"""Characters of a line where there is no terminal."""


def listing_text(listed: Sequence[ListedFile], width: int | None = None) -> str:
    """Return a table with a line for each channel that was read, no wider than `width`, and below it what to know.

    width: characters, None: of the terminal. Below are the cells to fill in, what was joined, warnings and refusals.
    """
    width = width or shutil.get_terminal_size((_FALLBACK, 24)).columns
    return "".join(f"{line}\n" for line in (*_table(listed, width), *_sentences(listed)))


def _table(listed: Sequence[ListedFile], width: int) -> Iterator[str]:
    """Yield the lines of the table."""
    rows = [_HEAD]
    for file in listed:
        for place, channel in enumerate(file.channels):
            step = "" if "time_step_s" in file.blanks else f"{channel.time_step:g}"
            peaks = channel.peak_acceleration, channel.peak_velocity
            name = "" if place else file.file
            rows.append((name, channel.component, channel.format, step, str(channel.samples), *peaks))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for column, narrowest in _NARROWEST.items():
        surplus = sum(widths) + len(_GAP) * (len(widths) - 1) - width
        if surplus > 0:
            widths[column] = max(min(narrowest, widths[column]), widths[column] - surplus)
    for row in rows:
        cells = zip(row, _ALIGNED, widths, strict=True)
        yield _GAP.join(f"{_shortened(cell, size):{side}{size}}" for cell, side, size in cells).rstrip()


def _shortened(text: str, size: int) -> str:
    """Return `text` with at most `size` characters: its beginning and its end, which tell names apart."""
    if len(text) <= size:
        return text
    end = size // 2
    return f"{text[: size - end - 1]}…{text[-end:]}"


def _sentences(files: Sequence[ListedFile]) -> Iterator[str]:
    """Yield what there is to say of the files below the table, by kind."""
    joined: dict[str, list[str]] = {}
    for file in files:
        if file.companions:
            joined.setdefault(file.record, []).append(file.file)
    read = [file for file in files if not file.refusal]
    asked = families((file.file, file.question) for file in files if file.question)
    first = {_family(file): file.refusal for file in reversed(files) if file.refusal}
    sections = {
        f"Answer once, in {NAME}:": [
            (file, family.question.holds) for family in asked for file in family.files
        ],
        "Fill in, in the catalogue:": [
            (file.file, " and ".join(file.blanks)) for file in read if file.blanks and not file.question
        ],
        "Joined:": [(record, ", ".join(of_record)) for record, of_record in joined.items()],
        "To know:": [
            (file.file, text)
            for file in read
            if (text := " ".join(filter(None, (*map(str, warnings_of(file)), file.separated))))
        ],
        "Not read:": [
            (file.file, first[_family(file)]) for file in files if file.refusal and not file.question
        ],
    }
    for heading, lines in sections.items():
        if lines:
            alike: dict[str, list[str]] = {}
            for name, text in lines:
                alike.setdefault(text, []).append(name)
            yield from ("", heading, *(f"  {listed(names, NAMED)}: {text}" for text, names in alike.items()))


def _family(file: ListedFile) -> str:
    """Return what files that are refused alike share: each names its own numbers in the sentence, and its own name."""
    return re.sub(r"\d+", "", file.refusal.replace(Path(file.file).name, ""))
