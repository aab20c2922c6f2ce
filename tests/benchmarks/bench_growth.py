"""How the cost of a study grows with its records: python bench_growth.py [10 100 1000 ...] [KEY=VALUE ...].

Records of 40 s at 100 Hz made by the seeded generator, with the shipped structures and settings, on two cores. For each
number of records: CPU per record by stage, the share of everything that is not a stage, the largest process, and the
time of a second run that has nothing to do. KEY=VALUE changes a setting: reports=True sets the PDFs too, and with
records_per_job=64 the jobs of few records are as large as those of many.
"""

import csv
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
DURATION = 40.0


@dataclass(frozen=True)
class Measured:
    """One study: its records, wall and CPU time [s], CPU by stage [s], largest process [MB], time of a re-run [s]."""

    records: int
    wall: float
    cpu: float
    stages: dict[str, float]
    memory: float
    again: float

    @property
    def overhead(self) -> float:
        """Share of the CPU time that is spent outside the stages."""
        return 1 - sum(self.stages.values()) / self.cpu


def snakemake(folder: Path, *options: str) -> str:
    """Run the workflow on the study in `folder` and return what it printed."""
    command = [
        sys.executable,
        "-m",
        "snakemake",
        "--snakefile",
        str(ROOT / "Snakefile"),
        "--directory",
        str(folder),
    ]
    command += ["--configfile", str(folder / "config.yaml"), "--cores", "2", "--quiet", *options]
    command += ["--workflow-profile", str(ROOT / "workflow" / "profiles" / "default")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    return done.stdout + done.stderr


def cpu_of_children() -> float:
    """CPU time of all finished children and of theirs, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(folder: Path, records: int, changed: list[str]) -> Measured:
    """Run a study of `records` records in `folder`, twice, with the settings `changed` ("KEY=VALUE")."""
    subprocess.run(
        [sys.executable, ROOT / "tests" / "workflow" / "write_study.py", folder, str(records), str(DURATION)],
        check=True,
    )
    options = ["--config", "reports=False", *changed]
    started, before = time.perf_counter(), cpu_of_children()
    snakemake(folder, *options)
    wall, cpu = time.perf_counter() - started, cpu_of_children() - before
    started = time.perf_counter()
    if "Nothing to be done" not in snakemake(folder, *options):
        raise SystemExit("the second run did something")
    again = time.perf_counter() - started
    summary = folder / "results" / "summary"
    stages: Counter[str] = Counter()
    for row in rows(summary / "timings.csv", ","):
        stages[row["stage"]] += float(row["duration_s"])
    # The largest child so far: growing studies make it that of this one.
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return Measured(records, wall, cpu, dict(stages), memory, again)


def rows(path: Path, delimiter: str) -> list[dict[str, str]]:
    """The rows of a table."""
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream, delimiter=delimiter))


def main(arguments: list[str]) -> None:
    """Measure each number of records and print one line for it, in rising order."""
    changed = [word for word in arguments if "=" in word]
    numbers = sorted(int(word) for word in arguments if "=" not in word) or [10, 100, 1000]
    with tempfile.TemporaryDirectory() as folder:
        measure(Path(folder) / "warm", 2, changed)  # compiles, so that the first number does not pay for it
        print(f"load of the machine before: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        previous = None
        for number in numbers:
            now = measure(Path(folder) / str(number), number, changed)
            report(now, previous)
            previous = now
        print(f"load of the machine after: {os.getloadavg()[0]:.1f}")


def report(now: Measured, before: Measured | None) -> None:
    """Print what one study took, and how its cost per record compares with that of the study before."""
    stages = ", ".join(f"{stage} {1000 * spent / now.records:.1f} ms" for stage, spent in now.stages.items())
    print(
        f"{now.records} records: {now.wall:.1f} s, CPU {now.cpu:.1f} s = {1000 * now.cpu / now.records:.1f} ms each"
    )
    print(f"  stages, CPU each: {stages}; overhead {now.overhead:.0%}")
    print(f"  largest process {now.memory:.0f} MB; run again with nothing to do {now.again:.1f} s")
    if before is not None:
        work, whole = (
            (measured(now) / now.records) / (measured(before) / before.records)
            for measured in (lambda m: sum(m.stages.values()), lambda m: m.cpu)
        )
        print(
            f"  cost per record over that of {before.records} records: stages {work:.2f}, all {whole:.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
