"""What a run says while it goes on: a line for each record as it finishes, read from the logs of the jobs."""

import re
import shutil
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

_FINISHED = re.compile(r"Finished jobid: \d+ \(Rule: (\w+)\)")
_PLANNED = re.compile(r"(\w+) +(\d+)")
_COUNTED = re.compile(r"(\d+) of (\d+): .+")


def line_writer(log: Path) -> Callable[[str], None]:
    """Return what adds a line to `log`, begun anew: "3 of 12: ..." is shown to the one who waits."""
    log.write_text("", encoding="utf-8")

    def add(line: str) -> None:
        with log.open("a", encoding="utf-8") as stream:
            print(line, file=stream)

    return add


class NewLines:
    """The lines that are added, from now on, to the logs that match a pattern below a folder."""

    def __init__(self, folder: Path, *patterns: str) -> None:
        self._folder, self._patterns = folder, patterns
        self._old = {path: path.stat().st_mtime_ns for path in self._paths()}
        self._told: dict[Path, int] = {}

    def __iter__(self) -> Iterator[tuple[str, str]]:
        """Yield the name of the log and each of its lines that was not there before."""
        for path in self._paths():
            if self._old.get(path) == path.stat().st_mtime_ns:
                continue
            whole, _, _ = path.read_text(encoding="utf-8", errors="replace").rpartition("\n")
            lines = whole.splitlines()
            told = self._told.get(path, 0)
            told = told if told <= len(lines) else 0
            self._told[path] = len(lines)
            yield from ((path.stem, line) for line in lines[told:])

    def _paths(self) -> list[Path]:
        return sorted(path for pattern in self._patterns for path in self._folder.glob(pattern))


class Progress:
    """Turns what logs say into lines for a person, and counts what is done.

    records: how many each job takes, by the name of its rule. On a terminal lines are cut to its width and a bar stands
    below them; elsewhere there are plain lines only.
    """

    def __init__(self, records: Mapping[str, int], width: int) -> None:
        from tqdm import tqdm  # only for those who look

        self._records, self._width = records, width
        self._terminal = sys.stdout.isatty()
        self._done: dict[str, int] = {}
        form = "{desc}{percentage:3.0f} %|{bar}| {n_fmt} of {total_fmt} [{elapsed}<{remaining}]"
        self._bar = tqdm(
            total=1,
            disable=not self._terminal,
            file=sys.stdout,
            dynamic_ncols=True,
            leave=False,
            bar_format=form,
        )

    def plan(self, jobs: Mapping[str, int]) -> None:
        """Take over which jobs will run, by the name of the rule."""
        self._bar.total = sum(self._records.get(rule, number) for rule, number in jobs.items())
        self._bar.refresh()

    def told(self, job: str, line: str) -> None:
        """Show a line of the log of one job."""
        if job not in self._records:
            if _COUNTED.fullmatch(line):
                self._show_count(job, line)
        elif self._done.get(job, 0) < self._records[job]:
            self._advance(job, 1)
            if job.startswith("assess_"):
                self.say(self._of_record(line))

    def finished(self, job: str) -> None:
        """Count a job that ended."""
        self._advance(job, self._records.get(job, 1) - self._done.get(job, 0))

    def say(self, line: str) -> None:
        """Show a line above the bar."""
        self._bar.write(fitting(line), file=sys.stdout)
        sys.stdout.flush()

    def close(self) -> None:
        """Take the bar away."""
        self._bar.close()

    def _of_record(self, line: str) -> str:
        record, _, text = line.partition(": ")
        return f"{record:<{self._width}}  {text}"

    def _show_count(self, job: str, line: str) -> None:
        if self._terminal:
            self._bar.set_description_str(f"{job} {line.partition(':')[0]} ")
        else:
            self.say(f"{job}: {line}")

    def _advance(self, job: str, steps: int) -> None:
        self._done[job] = self._done.get(job, 0) + steps
        self._bar.update(steps)


def fitting(line: str) -> str:
    """Return `line`, cut to the width of the terminal if it is shown on one."""
    columns = shutil.get_terminal_size().columns
    return line[: columns - 1] + "…" if sys.stdout.isatty() and len(line) > columns else line


def planned_jobs(log: str) -> dict[str, int]:
    """Return how many jobs of each rule snakemake lists in its log, {} before it did."""
    table = log.partition("Job stats:")[2].partition("\ntotal ")
    rows = (_PLANNED.fullmatch(line.strip()) for line in table[0].splitlines()) if table[1] else ()
    return {row[1]: int(row[2]) for row in rows if row}


def finished_rule(line: str) -> str | None:
    """Return the rule of which a line in snakemake's log says that a job finished."""
    found = _FINISHED.search(line)
    return found[1] if found else None
