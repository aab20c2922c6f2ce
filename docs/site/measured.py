"""Measured figures that know their age: each with what made it, and whether the code that it measures has changed
since.

`docs/measured/figures.csv` holds a row for each. A page prints one by `<!-- measured: NAME -->`, and by
`<!-- measured by: NAME -->` what made it and how old it is, at a table or a sentence that gives it. Run as a script
it lists the figures whose code has changed since in meaning, or whose list of records; `--first-screen` fails where one
that a reader meets first is older, `--renew` writes the hashes of the code as it is, for figures that were just
measured again, and `--keep` keeps the scores of a target, which pages print cell by cell (`kept`).
"""

import argparse
import ast
import csv
import sys
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

from docs.site.kept import SCORES
from rocking.errors import ConfigurationError
from rocking.hashes import sha256_of_bytes
from rocking.tables import write_whole

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
    it again, as it is called. commit: at which it was measured. files: what of the code it measures, apart by blanks.
    code_sha256: the meaning of these then, "" where it was not kept, which counts as older. first_screen: "yes" of one
    that the first screen of the README or of a page shows.
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
    files: str
    code_sha256: str
    first_screen: str

    @property
    def is_older(self) -> bool:
        """Whether the code that it measures has changed since in meaning, or its list of records."""
        if self.records_sha256 and self.records_sha256 not in map(records_sha256, LISTS):
            return True
        return self.code_sha256 != code_sha256(self.files.split())

    @property
    def words(self) -> str:
        """The figure as a page prints it: value, interval and numbers."""
        details = "; ".join(filter(None, (self.interval, self._of)))
        return f"{self.value} ({details})" if details else self.value

    @property
    def origin(self) -> str:
        """What made it, on what and when: "`snakemake stand` at 1a2b3c4d, 50 sites of 20 earthquakes"."""
        return ", ".join(filter(None, (f"`{self.script}` at {self.commit}", self._of)))

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


def code_sha256(files: Iterable[str]) -> str:
    """Return one hash of what the statements of some files of the repository mean.

    Docstrings, comments, layout, types and what an error says mean nothing; names do. A file that is not Python counts
    as it is, one that is missing as nothing.
    """
    parts = []
    for name in files:
        path = ROOT / name
        content = path.read_bytes() if path.is_file() else b""
        parts.append(meaning(content.decode("utf-8")).encode() if path.suffix == ".py" else content)
    return sha256_of_bytes(*parts)


def meaning(source: str) -> str:
    """Return the statements of a Python source without what changes none of its results."""
    return ast.dump(_Plain().visit(ast.parse(source)))


class _Plain(ast.NodeTransformer):
    """Takes docstrings and types away, and what an error says: where it is raised no figure comes of it."""

    def visit(self, node: ast.AST) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            node.body = [statement for statement in node.body if not _says_nothing(statement)] or [ast.Pass()]
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            node.returns = None
        if isinstance(node, ast.Raise):
            node.exc = node.cause = None
        if isinstance(node, ast.arg):
            node.annotation = None
        if isinstance(node, ast.AnnAssign) and node.value is not None:
            return ast.Assign(targets=[node.target], value=node.value)
        if isinstance(node, ast.AnnAssign):  # a field of a class, whose order counts
            node.annotation = ast.Constant(None)
        return node


def _says_nothing(statement: ast.stmt) -> bool:
    """Whether it is a text by itself, as a docstring is."""
    is_text = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
    return is_text and isinstance(statement.value.value, str)  # type: ignore[attr-defined]


def main(arguments: Sequence[str] | None = None) -> int:
    """List the figures that are older than their code; return 1 where one of the first screen is, and that is asked."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument(
        "--first-screen", action="store_true", help="fail where one of the first screen is older"
    )
    parser.add_argument(
        "--renew", nargs="*", metavar="NAME", help="figures that were measured again at --commit"
    )
    parser.add_argument("--commit", default="", help="at which they were")
    parser.add_argument("--records", choices=LISTS, help="the catalogues that they were measured on")
    parser.add_argument(
        "--keep", nargs="*", default=[], metavar="FOLDER", help="results of targets whose scores are kept"
    )
    options = parser.parse_args(arguments)
    for folder in map(Path, options.keep):
        write_whole(SCORES / f"{folder.name}.csv", (folder / "scores.csv").read_bytes())
    known = figures()
    if options.renew is not None:
        for name in options.renew or list(known):
            figure = known[name]
            known[name] = replace(
                figure,
                commit=options.commit or figure.commit,
                code_sha256=code_sha256(figure.files.split()),
                records_sha256=records_sha256(options.records) if options.records else figure.records_sha256,
            )
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
