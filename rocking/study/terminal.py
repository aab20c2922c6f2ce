"""The words of a run: its progress, which jobs send as JSON lines, and the outcome of the records."""

import json
import math
import os
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from textwrap import wrap
from threading import Thread
from types import TracebackType
from typing import TYPE_CHECKING, BinaryIO, TextIO, TypeVar

from tqdm import tqdm

from rocking.assessment.conclusion import (
    conclusion_in_words,
    conclusions,
    falls_in_words,
    to_check,
    worst_of_each,
)
from rocking.assessment.decide import ORDER, Verdict, worst_first
from rocking.assessment.methods import rocks
from rocking.assessment.rows import (
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    RemarkRow,
    VerdictRow,
    counted_cases,
    worst_period_each,
)
from rocking.errors import LOGS, RecordError, RockingError, log_fault
from rocking.quantities import counted, escaped, listed
from rocking.study.folder import new_log
from rocking.tables import read_table

if TYPE_CHECKING:  # else planning a study would load numba
    from rocking.assessment.case import SceneResult

T = TypeVar("T")

_WORST = 5
"""Structures of the table at the end."""
COUNTED = ", a structure on a support at the period of its verdict"
"""Which cases of it are counted; see `counted_cases`."""
_NAMED = 8
"""Names of a list; a line is to be read at a glance."""
NO_BREAK = "\u00a0"
WIDTH = 104
"""Characters of a line at the end."""
_PIPE = "ROCKING_PROGRESS"
"""The variable of the environment that names the pipe from the jobs to the one who waits."""
"""The log that this process has begun, to which the error that ends it is added."""
_LONGEST = 1000
"""Characters of a line: what the system writes to a pipe at once, by whatever process, is at least 4096 bytes."""


def record_line(scenes: Iterable["SceneResult"], failures: Iterable[FailureRow]) -> str:
    """Say in one line what came of a record: "overturns: pier (100 %); uncertain: wall (19 %); stands: arch 0.31".

    The numbers are the shares that overturn, or of what stands the largest rotation over the critical one of the worst
    component. What could not be assessed comes first. Structures on supports stand at the end in a sentence each. At
    most _NAMED are named, the worst first.
    """
    reasons = ((f"{each.structure}: " if each.structure else "") + each.message for each in failures)
    parts: dict[Verdict, list[str]] = {word: [] for word in ORDER}
    scenes = sorted(scenes, key=lambda scene: scene.worst.severity, reverse=True)
    on_the_ground = [scene.worst for scene in scenes if not scene.scene.place.supports]
    for each in on_the_ground:
        decision = each.decision
        share = decision.share_in_words
        number = f" ({share})" if share else ""
        if decision.word.stays_up:
            number = f" {each.rotation_ratio:.2g}" if rocks(each.rotation_ratio) else ""
        divided = "," in each.structure or ";" in each.structure
        name = f'"{each.structure}"' if divided else each.structure
        parts[decision.word].append(name + number)
    told = {"failed": " ".join(reasons)} | _named(parts, _NAMED)
    lines = [f"{word}: {text}" for word, text in told.items() if text]
    left = max(0, _NAMED - len(on_the_ground))
    carried = [scene.sentence for scene in scenes if scene.scene.place.supports]
    if len(carried) > left:
        more = counted(len(carried) - left, "structure")
        carried[left:] = [f"{more}{' more' if left else ''} on supports, in {VerdictRow.table.file_name}"]
    return "; ".join([*lines, *carried])


def closing_lines(
    verdicts: Sequence[VerdictRow],
    comparison: Iterable[ComparisonRow],
    failures: Sequence[FailureRow],
    expected: Sequence[ExpectedFallsRow] = (),
    remarks: Iterable[RemarkRow] = (),
) -> Iterator[str]:
    """Yield the conclusion on all structures, the worst with closed form, block and integration, and the others' words.

    Below them stand what the closed form saw of the falls among `counted_cases`, the records that failed, and what has
    to be checked of what was typed. comparison: is gone through once, and not kept. expected: how many fall, by record
    and of all. remarks: on the study and on its records, which are gone through once as well. At most _NAMED structures
    are named.
    """
    worst = worst_of_each(conclusions(verdicts, []))
    records = len({each.record for each in verdicts})  # one that failed gives none
    shown = {(each.verdict.record, each.verdict.structure): each for each in worst[:_WORST]}
    taken = worst_period_each(verdicts)
    carried = any(each.support_period_s is not None for each in taken)
    of_shown: list[ComparisonRow] = []
    seen = false = 0
    missed = Counter[str]()
    for row in counted_cases(comparison, taken):
        if (row.record, row.structure) in shown:
            of_shown.append(row)
        predicted = row.predicted_rotation_ratio
        integrated = row.integrated_rotation_ratio
        if not (math.isnan(predicted) or math.isnan(integrated)):
            seen += predicted == integrated == math.inf
            missed[row.record] += predicted < integrated == math.inf
            false += integrated < predicted == math.inf
    if worst:
        count = f"{counted(records, 'record')}, {counted(len(worst), 'structure')}. "
        words = {each.verdict.structure: each.verdict.decision.word for each in worst}
        for said in (count + conclusion_in_words(words, records), falls_in_words(expected)):
            yield from wrap(said, WIDTH)
        yield "Rotation over critical rotation of the worst structures, each under its worst record; the first by"
        yield "verdict, share, then reserve (5 and 50 % overturn at × the record):"
        yield f"{'':<16}  {'record':<18}  closed  block  integrated     reserve  verdict, share"
    own = (row for row in taken if (row.record, row.structure) in shown)
    for each in conclusions(own, of_shown):
        ratios = map(_rotation, each.ratios)
        marks = "  ".join(f"{text:>{width}}" for text, width in zip(ratios, (6, 5, 10), strict=True))
        reserve = each.verdict.reserve.in_figures if each.verdict.reserve else "–"
        line = f"{_cut(each.verdict.structure, 16):<16}  {_cut(each.verdict.record, 18):<18}  {marks}  {reserve:>10}  "
        yield f"{line}{each.verdict.decision.word} {each.verdict.decision.share_in_words}".rstrip()
    if any("–" in each.verdict.decision.share_in_words for each in worst[:_WORST]):
        yield "A range: two cracks, or the mechanism and contact dynamics, disagree."
    others = [(each.verdict.decision.word, _cut(each.verdict.structure, 30)) for each in worst[_WORST:]]
    if names := {word: [name for its, name in others if its is word] for word, _ in others}:
        text = "; ".join(map(": ".join, _named(names, _NAMED - _WORST).items()))
        yield from wrap(text, WIDTH, initial_indent="Others  ", subsequent_indent=" " * 8)
    of_what = COUNTED if carried else ""
    yield from _closed_form_lines(seen, missed if records > 1 else missed.total(), false, of_what)
    yield from _failing_lines(failures)
    for sentence in to_check(remarks):
        yield from wrap(sentence, WIDTH, subsequent_indent=" " * 8)


def _closed_form_lines(seen: int, missed: Counter[str] | int, false: int, of_what: str) -> Iterator[str]:
    """What the closed form saw of the falls, where there is one. missed: by record, where there are several."""
    where = ""
    if isinstance(missed, Counter):
        most, count_of_most = (missed.most_common(1) or [("", 0)])[0]
        where = f" ({count_of_most} of them in {_cut(most, 24)})" if count_of_most else ""
        missed = missed.total()
    if falls := seen + missed:
        text = (
            f"Closed form against integration{of_what}: {seen} of {counted(falls, 'fall')} seen, "
            f"{missed} missed{where}, {counted(false, 'false alarm').replace(' ', NO_BREAK)}"
        )
        yield from (line.replace(NO_BREAK, " ") for line in wrap(text, WIDTH, subsequent_indent=" " * 8))


def _failing_lines(failures: Sequence[FailureRow]) -> Iterator[str]:
    """The records that failed, and the sentences on structures that did over all records."""
    sentences = dict.fromkeys(f"{each.structure}: {each.message}" for each in failures if not each.record)
    for sentence in list(sentences)[:_NAMED]:
        yield from wrap(sentence.removeprefix(": "), WIDTH, subsequent_indent=" " * 8)
    if failed := sorted({each.record for each in failures} - {""}):
        text = f"{counted(len(failed), 'record')} failed, wholly or in part: {listed(failed, _NAMED)}"
        yield from wrap(text, WIDTH, subsequent_indent=" " * 8)


def conclusion_lines(sentence: str) -> list[str]:
    """Return the lines of what a product over all records comes down to; none where it says nothing."""
    return wrap(sentence, WIDTH, subsequent_indent=" " * 8)


def _rotation(ratio: float) -> str:
    """A rotation ratio in a column: "0.44", "falls", or a dash."""
    return "–" if math.isnan(ratio) else "falls" if ratio == math.inf else f"{ratio:.2f}"


def _cut(name: str, width: int) -> str:
    """The name, with an ellipsis where it is longer than `width`."""
    return name if len(name) <= width else f"{name[: width - 1]}…"


def _named(by_word: Mapping[Verdict, Sequence[str]], left: int) -> dict[str, str]:
    """By word the names, `left` of all together, and of each word how many more there are."""
    texts: dict[str, str] = {}
    for word, names in by_word.items():
        more = len(names) - left
        texts[word] = ", ".join([*names[:left], f"{more} more" if left else str(more)] if more > 0 else names)
        left = max(0, -more)
    return texts


def check_any_read(summary: Path, records: Collection[str]) -> None:
    """Raise RecordError when a summary, where one was asked for, says of each record that it could not be read."""
    if not (summary / FailureRow.table.file_name).is_file():
        return
    unread = {row.record: row.message for row in read_table(FailureRow, summary) if row.stage == "read"}
    if set(unread) >= set(records):
        number = counted(len(records), "record")
        record, message = next(iter(unread.items()))
        raise RecordError(f"none of {number} could be read; the first: {record}: {message}")


def paths_to_read(
    results: Path, verdicts: Iterable[VerdictRow], reports: bool, opened: Mapping[Path, str]
) -> Iterator[str]:
    """Yield a line for each of the files that come next for a reader, the report of the worst record among them.

    reports: whether the study makes reports. opened: files of the products over all records, and what each is. A file
    that lies there of a former run, and that this one does not make, is not named: it would not say what the tables
    say.
    """
    summary = results / "summary"
    records = worst_first((each.record, each.severity) for each in worst_period_each(verdicts))
    first = summary / "summary.pdf" if reports else summary
    files = {first: "all records"}
    if records and reports:
        files[results / records[0] / "report.pdf"] = "every structure under the worst record"
    files |= opened
    if reports:
        files[summary / "study.html"] = "to explore"
    width = max(len(str(path)) for path in files)
    for path, what in files.items():
        yield f"{'Open' if path == first else '':<8}{path!s:<{width}}  {what}"


def bar(things: Iterable[T], what: str, total: int | None = None) -> "tqdm[T]":
    """Return `things`, which show a bar with the time that remains while they are gone through, on a terminal alone.

    what: one of them, "file". total: how many there are; None asks `things`. The bar is gone at the end.
    """
    tqdm.monitor_interval = 0  # no thread of its own
    shape = f"{{n:.0f}} of {{total:.0f}} {what}s {{bar}} {{remaining}} left"
    # None: not where nobody looks. The stream itself, for that of the command writes no control characters.
    return tqdm(
        things,
        total=total,
        disable=None,
        leave=False,
        file=sys.__stderr__,
        bar_format=shape,
        dynamic_ncols=True,
        smoothing=0,
    )


class Progress:
    """Turns what jobs and scheduler tell into lines for a person, and counts what is done.

    records: of the study. On a terminal, lines are cut to its width, and below them stands a bar with the time that
    remains. It alone writes there, whatever number of jobs tell something.
    """

    in_this_process: "Progress | None" = None

    def __init__(self, records: int, batches: int, stream: TextIO) -> None:
        self._of_a_job = {"record": 1.0, "batch": records / max(1, batches)}
        self._stream = stream
        self._back = "\r\x1b[K" if stream.isatty() else ""  # to the begin of the line, and the line empty
        self._what = "record"
        self._total = 0
        self._done = 0
        self._began = time.monotonic()
        self._moving = ""
        self.errors: list[str] = []
        self.reasons: list[str] = []

    @contextmanager
    def followed(self) -> Iterator[None]:
        """Show what is told meanwhile, all of it before the end."""
        Progress.in_this_process = self
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.environ[_PIPE] = str(Path(folder) / "progress")
            os.mkfifo(pipe)
            with os.fdopen(os.open(pipe, os.O_RDWR), "rb") as lines:
                reader = Thread(target=self._follow, args=(lines,))
                reader.start()
                try:
                    yield
                finally:
                    os.write(lines.fileno(), b"\n")
                    reader.join()
                    del os.environ[_PIPE]
                    Progress.in_this_process = None
        print(self._back, end="", file=self._stream, flush=True)

    def _follow(self, lines: BinaryIO) -> None:
        for line in iter(lines.readline, b"\n"):
            self.tell_line(*json.loads(line))

    def tell_plan(self, jobs: Mapping[str, int]) -> None:
        """Take up how many jobs of each rule will run."""
        self._total = round(sum(self._of_a_job.get(rule, 0) * number for rule, number in jobs.items()))
        self._show()

    def tell_line(self, rule: str, line: str, done: int = 0, total: int = 0) -> None:
        """Show a line of a job; those that assess tell one for each record. Keep the reason why one failed.

        done, total: what a job that is waited for counts itself; 0 where it counts nothing.
        """
        if rule == "error":
            self.reasons.append(line)
            return
        if rule == _COMPILATION:
            self._move(line, is_last=done == total)
            return
        of_a_record = rule in ("record", "batch")
        self._done += of_a_record
        if total and not self._total:
            self._what = "part"
        if total and self._what == "part":
            self._done, self._total = done, total
        self._show(line if of_a_record else f"{rule}: {line}")

    def _move(self, line: str, is_last: bool) -> None:
        """Show a line in place of the one before it, in that of the bar; without a terminal the first and the last."""
        began, self._moving = self._moving, "" if is_last else line
        if is_last or not (began or self._back):
            self._show(line)
        elif self._back:
            print(self._back + fitting(line, self._stream), end="", file=self._stream, flush=True)

    def _show(self, *lines: str) -> None:
        for line in lines:
            text = fitting(escaped(line), self._stream)
            print(self._back + text, file=self._stream, flush=True)
        if self._back and self._done < self._total:
            shown = tqdm.format_meter(
                self._done,
                self._total,
                time.monotonic() - self._began,
                ncols=max(columns_of(self._stream) - 1, 0) or None,
                bar_format=f"{{n}} of {{total}} {self._what}s {{bar}} {{remaining}} left",
            )
            print(self._back + shown, end="", file=self._stream, flush=True)


def tell(job: str, line: str, done: int = 0, total: int = 0) -> None:
    """Tell the one who waits for a job, another process, or else the terminal."""
    try:
        pipe = os.open(os.environ[_PIPE], os.O_WRONLY | os.O_NONBLOCK)  # who waited may be gone
    except (KeyError, OSError):
        print(line, file=sys.stderr, flush=True)
        return
    with os.fdopen(pipe, "wb", buffering=0) as stream:
        stream.write(json.dumps([job, line[:_LONGEST], done, total], ensure_ascii=False).encode() + b"\n")


_COMPILATION = "compile"
"""What a job is called that compiles before it begins."""


def tell_compilation(line: str, is_last: bool) -> None:
    """Tell how long a job has been compiling, in a line that stands for the one before it, or that it has done so."""
    tell(_COMPILATION, line, int(is_last), 1)


def line_writer(log: Path, rule: str) -> Callable[..., None]:
    """Return what adds a line to a new `log`, and tells it as one of a job of this `rule`, with what it counts."""
    new_log(log).close()
    LOGS[:] = [log]

    def add(line: str, done: int = 0, total: int = 0) -> None:
        with log.open("a", encoding="utf-8") as stream:
            print(line, file=stream)
        tell(rule, line, done, total)

    return add


def tell_error(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """Tell why this process fails, before Python does: in place of sys.excepthook."""
    if isinstance(error, RockingError | OSError):
        place = f"{getattr(error, 'filename', None) or 'a file'}: " * isinstance(error, OSError)
        tell("error", place + (getattr(error, "strerror", None) or str(error)))
    elif isinstance(error, MemoryError):
        tell("error", "a job had not enough memory; give more, or run fewer jobs at once: -- --cores 1")
    elif isinstance(error, Exception):
        tell(
            "error", f"a job ended with {kind.__name__}: {' '.join(str(error).split())}; its log tells where"
        )
    log_error(error)
    sys.__excepthook__(kind, error, trace)


def log_error(error: BaseException) -> None:
    """Add the traceback of an error to the log that this process has begun, if any."""
    for log in LOGS:
        log_fault(error, log)


def columns_of(stream: TextIO) -> int:
    """Return the width of the terminal, if `stream` is one, else 0."""
    return os.get_terminal_size(stream.fileno()).columns if stream.isatty() else 0


def fitting(line: str, stream: TextIO) -> str:
    """Return `line`, cut to the width of the terminal if `stream` is one."""
    columns = columns_of(stream)
    return line[: columns - 1] + "…" if 0 < columns < len(line) else line
