"""Small studies that are run by snakemake itself, each in a folder of its own."""

import csv
import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
import yaml

from rocking.study.outputs import STEPS
from tests.synthetic import SyntheticRecord, at2_text
from tests.workflow.forked import run_snakemake

ROOT = Path(__file__).parents[2]
MEASURED = {"timings.csv", "trade.csv", "SHA256SUMS"}
"""The tables whose bytes may differ between two runs of the same input."""

STRUCTURES = [
    {"name": "block", "type": "block", "breadth_m": 0.5, "height_m": 3.0},
    {"name": "wall", "type": "wall", "height_m": 3.2, "hinge_height_m": 1.6, "thickness_m": 0.25},
]


@dataclass(frozen=True)
class SmallStudy:
    """A study in `folder`: config.yaml, structures.yaml, records/ and what a run makes of them.

    tree: a copy of this project, whose workflow and package make it.
    """

    folder: Path
    tree: Path

    @property
    def results(self) -> Path:
        return self.folder / "results"

    def add(self, identifier: str, content: bytes, **cells: str) -> None:
        """Add a file of `content` and its row of the catalogue, of which `cells` change what is not as usual."""
        file = f"{identifier}.txt"
        (self.folder / "records" / file).write_bytes(content)
        row = {"id": identifier, "file": file, "sha256": hashlib.sha256(content).hexdigest(), "unit": "g"}
        self.write_catalogue([*self.rows(), row | cells])

    def add_synthetic(self, identifier: str, seed: int) -> None:
        """Add a short synthetic record."""
        recipe = SyntheticRecord(name=f"made_{seed}", seed=seed, pulse_period=0.5 + 0.1 * seed)
        self.add(identifier, at2_text(recipe).encode())

    def rows(self) -> list[dict[str, str]]:
        path = self.folder / "records" / "catalogue.csv"
        if not path.exists():
            return []
        with path.open(encoding="utf-8", newline="") as stream:
            return list(csv.DictReader(stream))

    def write_catalogue(self, rows: Sequence[dict[str, str]]) -> None:
        names = ["id", "file", "sha256", "unit", "component", "time_step_s", "inventory"]
        with (self.folder / "records" / "catalogue.csv").open("w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, names, restval="")
            writer.writeheader()
            writer.writerows(rows)

    def command(self, *options: str) -> list[str]:
        return [
            *(sys.executable, "-m", "snakemake", "--snakefile", str(self.tree / "workflow" / "Snakefile")),
            *("--directory", str(self.folder), "--cores", "2"),
            *("--workflow-profile", str(self.tree / "workflow/profiles/default"), "--nocolor", *options),
        ]

    @property
    def surroundings(self) -> dict[str, Any]:
        """How a process is started: python -m looks for the package in the folder it stands in, then in PYTHONPATH."""
        # A worker of pytest-xdist names the width of a terminal that is not the process's.
        inherited = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "LINES")}
        return {"cwd": self.folder, "env": inherited | {"PYTHONPATH": str(self.tree)}}

    def run(self, *options: str, status: int = 0) -> str:
        """Run snakemake on this study, which must end with `status`; its output and errors as one text."""
        with TemporaryDirectory() as folder:
            arguments = self.command(*options)[3:]  # after python -m snakemake
            ended, told = run_snakemake(arguments, Path(folder) / "output", **self.surroundings)
        assert ended == status, told
        return told

    def planned(self, *options: str) -> list[str]:
        """The kinds of jobs that a run would make, without the target."""
        return kinds_of_jobs(self.run("--dry-run", *options))

    def rocking(
        self, *arguments: str, before: Sequence[str] = (), status: int = 0
    ) -> subprocess.CompletedProcess[str]:
        """Run the command rocking of this tree, from a folder that is not the study's; it must end with `status`.

        before: what starts it.
        """
        command = [*before, sys.executable, "-m", "rocking.study.cli", *arguments]
        surroundings = self.surroundings | {"cwd": self.tree}
        done = subprocess.run(
            command, timeout=900, check=False, capture_output=True, text=True, **surroundings
        )
        assert done.returncode == status, done.stdout + done.stderr
        return done

    def tables(self) -> dict[str, bytes]:
        """The bytes of every file of the results that must not differ between runs, by path."""
        return {
            path.relative_to(self.results).as_posix(): path.read_bytes()
            for path in sorted(self.results.rglob("*"))
            if path.is_file() and path.suffix in {".csv", ".json"} and path.name not in MEASURED
            if not {".kept", "benchmarks"} & set(path.relative_to(self.results).parts)
        }

    def rows_of(self, record: str) -> dict[str, list[bytes]]:
        """The lines of one record in the tables of the summary, by table, but for what may differ between runs."""
        tables = [path for path in (self.results / "summary").glob("*.csv") if path.name not in MEASURED]
        start = f"{record},".encode()
        return {
            path.name: [line for line in path.read_bytes().splitlines() if line.startswith(start)]
            for path in sorted(tables)
        }

    def unfinished(self) -> list[Path]:
        """Temporary files that somebody left behind."""
        return list(self.results.rglob("*.part"))

    def copy_to(self, folder: Path) -> "SmallStudy":
        shutil.copytree(self.folder, folder)
        return SmallStudy(folder, self.tree)


def kinds_of_jobs(told: str) -> list[str]:
    """The kinds of jobs in the table that snakemake prints before a run and a dry run, without the target."""
    table = told.partition("Job stats:")[2].partition("\ntotal ")[0]
    rules = "|".join((*STEPS, "summary", "checks", "trade", "fragility"))
    return sorted(re.findall(rf"(?m)^({rules}) +\d+ *$", table))


def new_study(folder: Path, tree: Path) -> SmallStudy:
    """A study without records: two structures, no reports, few members and no reserve."""
    (folder / "records").mkdir(parents=True)
    settings = {"reports": False, "ensemble": {"members": 16, "reserve": 0}}
    (folder / "config.yaml").write_text(yaml.safe_dump(settings), encoding="utf-8")
    (folder / "structures.yaml").write_text(yaml.safe_dump(STRUCTURES), encoding="utf-8")
    return SmallStudy(folder, tree)


@pytest.fixture(scope="session")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the workflow and the package, with what is compiled already, which a test may edit."""
    folder = tmp_path_factory.mktemp("tree")
    shutil.copy2(ROOT / "Snakefile", folder)
    for name in ("workflow", "config", "rocking", "docs"):
        shutil.copytree(ROOT / name, folder / name)
    return folder


@pytest.fixture(scope="session")
def start(tree: Path, tmp_path_factory: pytest.TempPathFactory) -> SmallStudy:
    """A study of three good records that has not been run; copy it before use."""
    study = new_study(tmp_path_factory.mktemp("start") / "study", tree)
    for number in (1, 2, 3):
        study.add_synthetic(f"good_{number}", number)
    return study


@contextmanager
def _one_at_a_time(path: Path) -> Iterator[None]:
    with path.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


@pytest.fixture(scope="session")
def finished(start: SmallStudy, tmp_path_factory: pytest.TempPathFactory) -> SmallStudy:
    """The same study after an undisturbed run; copy it before changing anything.

    One worker of pytest-xdist runs it, and each has a copy: what is finished tells nothing of the tree that made it.
    """
    own = tmp_path_factory.getbasetemp()
    of_all_workers = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    made = SmallStudy(of_all_workers / "finished_once" / "study", start.tree)
    with _one_at_a_time(of_all_workers / "finished_once.lock"):
        if not made.folder.exists():
            under_way = start.copy_to(tmp_path_factory.mktemp("under_way") / "study")
            under_way.run()
            under_way.copy_to(made.folder)
    return made.copy_to(tmp_path_factory.mktemp("finished") / "study")
