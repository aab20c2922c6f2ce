"""Measured figures that know their age: each with what made it, and whether the code that it measures has changed
since.

`docs/measured/figures.csv` holds a row for each. A page prints one by `<!-- measured: NAME -->`, and by
`<!-- measured by: NAME -->` what made it and how old it is, at a table or a sentence that gives it. Run as a script
it lists the figures whose code has changed since, or whose list of records. Their code is what their files
import, and what that imports. `--first-screen` fails where one that a reader meets first is older, `--renew` writes
the commit of figures that were just measured again, `--read` that at which somebody has read that what changed since
changes no figure, and `--keep` keeps the scores of a target, which pages print cell by cell (`kept`).
"""

import argparse
import csv
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields, replace
from functools import cache
from pathlib import Path

from docs.site.kept import SCORES
from rocking.errors import ConfigurationError
from rocking.hashes import sha256_of_bytes
from rocking.tables import write_whole
from tests.contracts.test_imports import HOMES, MODULES, PACKAGE, downwards, names_in, owner

ROOT = Path(__file__).parents[2]
FIGURES = ROOT / "docs" / "measured" / "figures.csv"
LISTS = (
    "near_fault fema_p695",
    "fema_p695",
    "near_fault",
    "fema_p695 near_fault catalogue",
    "catalogue",
    "shake_table",
)
"""The lists of records that something is measured on, by the names of the catalogues."""


@dataclass(frozen=True)
class Figure:
    """One measured figure.

    name: by which a page prints it. value, interval: in words. sites, earthquakes: how many; 0 of made data, "" where
    it was not kept. seed: of the draws. records_sha256: of the lists of the records, "" of none. script: what measures
    it again, as it is called. commit: at which it was measured. read: a later one, at which its code was read as
    unchanged in what it gives; "" of none. files: where the code begins that it measures, apart by blanks.
    first_screen: "yes" of one that the first screen of the README or of a page shows.
    """

    name: str
    value: str
    interval: str
    sites: str
    earthquakes: str
    seed: str
    records_sha256: str
    script: str
    commit: str
    read: str
    files: str
    first_screen: str

    @property
    def is_older(self) -> bool:
        """Whether the code that it measures has changed since, or its list of records."""
        if self.records_sha256 and self.records_sha256 not in map(records_sha256, LISTS):
            return True
        return bool(code_of(self.files) & _differing(self.read or self.commit))

    @property
    def words(self) -> str:
        """The figure as a page prints it: value, interval and numbers."""
        details = "; ".join(filter(None, (self.interval, self._of)))
        return f"{self.value} ({details})" if details else self.value

    @property
    def origin(self) -> str:
        """What made it, on what and when: "`snakemake stand` at 1a2b3c4d, 50 sites of 20 earthquakes"."""
        read = f"code read at {self.read}" if self.read else ""
        return ", ".join(filter(None, (f"`{self.script}` at {self.commit}", read, self._of)))

    @property
    def _of(self) -> str:
        """On what: "50 sites of 20 earthquakes", "" of made data."""
        if self.sites in ("", "0"):
            return ""
        of_earthquakes = f" of {self.earthquakes} earthquakes" if self.earthquakes else ""
        return f"{self.sites} sites{of_earthquakes}"


def figures(path: Path = FIGURES) -> dict[str, Figure]:
    """Return all figures by name. Raises ConfigurationError for a table that is none, or a name that comes twice."""
    with path.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    found: dict[str, Figure] = {}
    for line, row in enumerate(rows, start=2):
        if list(row) != [field.name for field in fields(Figure)] or None in row.values():
            raise ConfigurationError(f"{path}, line {line}, must hold the columns of a Figure; mend the row.")
        if row["name"] in found:
            raise ConfigurationError(f"{path}, line {line}, names {row['name']!r} again; leave one out.")
        found[row["name"]] = Figure(**row)
    return found


def measured(name: str) -> Figure:
    """Return a figure by its name. Raises ConfigurationError for one that the table does not hold."""
    known = figures()
    if name not in known:
        raise ConfigurationError(f"measured figure is {name!r}, but must be one of {', '.join(known)}.")
    return known[name]


def records_sha256(lists: str) -> str:
    """Return the hash of some catalogues of the repository, by their names apart by blanks, as a row has it."""
    contents = ((ROOT / "records" / f"{name}.csv").read_bytes() for name in lists.split())
    return sha256_of_bytes(*contents)[:16]


@cache
def code_of(files: str) -> frozenset[Path]:
    """Return some files of the repository, apart by blanks, with what they import, and so on, of package and docs."""
    found: set[Path] = set()
    left = [ROOT / name for name in files.split()]
    while left:
        path = left.pop()
        if path in found or not path.is_file():
            continue
        found.add(path)
        if path.is_relative_to(PACKAGE):
            module = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
            left += [MODULES[other] for other in downwards(module.removesuffix(".__init__"))]
        elif path.suffix == ".py":
            public = re.findall(r"\brocking\.\w+", path.read_text(encoding="utf-8"))
            for name in names_in(path) | {name for name in public if name in HOMES}:
                within = name.split(".")
                left += [ROOT.joinpath(*within[:end]).with_suffix(".py") for end in range(1, len(within) + 1)]
                left += [MODULES[owner(name)]] if owner(name) in MODULES else []
    return frozenset(found)


@cache
def _differing(commit: str) -> frozenset[Path]:
    """The files that differ from a commit. Raises ConfigurationError for one that the repository does not hold."""
    names = _git("diff", "--name-only", "--no-renames", commit, "--", ".")
    if names is None:
        raise ConfigurationError(f"commit {commit} is not in this repository; fetch its whole history.")
    return frozenset(ROOT / name for name in names.splitlines())


def _git(*arguments: str) -> str | None:
    """What git says; None where it fails."""
    done = subprocess.run(("git", *arguments), cwd=ROOT, capture_output=True, text=True, check=False)
    return None if done.returncode else done.stdout


def main(arguments: Sequence[str] | None = None) -> int:
    """List the figures that are older than their code; return 1 where one of the first screen is, and that is asked."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument(
        "--first-screen", action="store_true", help="fail where one of the first screen is older"
    )
    parser.add_argument(
        "--renew", nargs="+", default=[], metavar="NAME", help="figures that were measured again at --commit"
    )
    parser.add_argument(
        "--read",
        nargs="+",
        default=[],
        metavar="NAME",
        help="figures whose code was read as unchanged at --commit",
    )
    parser.add_argument("--commit", help="at which they were")
    parser.add_argument("--records", choices=LISTS, help="the catalogues that they were measured on")
    parser.add_argument(
        "--keep", nargs="*", default=[], metavar="FOLDER", help="results of targets whose scores are kept"
    )
    options = parser.parse_args(arguments)
    if bool(options.renew or options.read) != bool(options.commit):
        parser.error("--renew and --read need --commit")
    for folder in map(Path, options.keep):
        write_whole(SCORES / f"{folder.name}.csv", (folder / "scores.csv").read_bytes())
    known = figures()
    for name in options.read:
        known[name] = replace(known[name], read=options.commit)
    for name in options.renew:
        sha256 = records_sha256(options.records) if options.records else known[name].records_sha256
        known[name] = replace(known[name], commit=options.commit, read="", records_sha256=sha256)
    if options.commit:
        lines = [",".join(field.name for field in fields(Figure))]
        lines += [",".join(_cell(cell) for cell in asdict(figure).values()) for figure in known.values()]
        write_whole(FIGURES, ("\n".join(lines) + "\n").encode())
    older = [figure for figure in known.values() if figure.is_older]
    for figure in older:
        print(
            f"{figure.name}: measured at {figure.commit}, code changed since; measure it again: {figure.script}"
        )
    print(f"{len(known) - len(older)} of {len(known)} figures are of the code as it is.")
    first = [figure.name for figure in older if figure.first_screen == "yes"]
    if options.first_screen and first:
        print(f"Of the first screen are older: {', '.join(first)}.", file=sys.stderr)
        return 1
    return 0


def _cell(text: str) -> str:
    return f'"{text}"' if "," in text else text


if __name__ == "__main__":
    sys.exit(main())
