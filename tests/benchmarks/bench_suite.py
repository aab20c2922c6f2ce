"""Processor time of whole studies: python bench_suite.py [10 100 1000 ...] [KEY=VALUE ...], which changes a setting.

With ROCKING_RECORDS, the shipped example (asked, once compiled: 12 s) and 42 records of FEMA P-695 with the shipped
structures and ensembles, without PDFs (25 s) and with them (70 s). Then how the cost grows with the records: studies of
so many of 40 s at 100 Hz, made by the seeded generator, each run twice; the second run has nothing to do.
"""

import csv
import os
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
RECORDS = 42


def run(folder: Path, *changed: str) -> str:
    """Run the workflow on the study in `folder`, on two cores; return what it printed."""
    profile = ROOT / "workflow" / "profiles" / "default"
    command = (
        f"{sys.executable} -m snakemake --snakefile {ROOT / 'Snakefile'} --cores 2 --quiet --directory {folder} "
        f"--workflow-profile {profile} --config"
    )
    words = [*shlex.split(command), *changed]
    return subprocess.run(
        words, check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ).stdout


def measure(name: str, folder: Path, *changed: str) -> None:
    """Run the study in `folder` from the start; print its processor time, by stage too, and its largest process."""
    shutil.rmtree(folder / "results", ignore_errors=True)
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    run(folder, *changed)
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - started
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    stages: Counter[str] = Counter()
    with (folder / "results" / "summary" / "timings.csv").open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            stages[row["stage"]] += float(row["duration_s"])
    print(f"{name}: {wall:.1f} s, CPU {cpu:.1f} s, largest process so far {after.ru_maxrss / 1024:.0f} MB")
    told = (f"{stage} {spent:.2f} s ({spent / cpu:.0%})" for stage, spent in stages.most_common())
    print("  " + ", ".join(told), flush=True)


def measure_suite(temporary: Path, mirror: str) -> None:
    """The shipped example and the suite."""
    example, suite = temporary / "example", temporary / "suite"
    for folder in (example, suite):
        shutil.copytree(ROOT / "records", folder / "records")
        shutil.copytree(ROOT / "config", folder / "config")
    run(example, "reports=true")  # compiles
    measure("shipped example", example, "reports=true")
    with (ROOT / "records" / "fema_p695.csv").open(encoding="utf-8", newline="") as stream:
        lines = list(csv.reader(stream))
    with (suite / "records" / "suite.csv").open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream).writerows(lines[: RECORDS + 1])
    settings = {"catalogue": "records/suite.csv", "structures": "config/structures.yaml", "mirror": mirror}
    (suite / "config.yaml").write_text(yaml.safe_dump(settings), encoding="utf-8")
    measure(f"{RECORDS} records without PDFs", suite, "reports=false")
    measure(f"{RECORDS} records with PDFs", suite, "reports=true")


def measure_growth(temporary: Path, numbers: list[int], changed: list[str]) -> None:
    """Studies in rising order, so that the largest process is that of the last one."""
    for number in (2, *sorted(numbers)):  # the first compiles
        folder = temporary / str(number)
        script = ROOT / "tests" / "workflow" / "write_study.py"
        subprocess.run([sys.executable, script, folder, str(number), "40"], check=True)
        measure(f"{number} records", folder, "reports=False", *changed)
        started = time.perf_counter()
        if "Nothing to be done" not in run(folder, "reports=False", *changed):
            raise SystemExit("the second run did something")
        print(f"  run again with nothing to do: {time.perf_counter() - started:.1f} s", flush=True)


if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:] if "=" not in word]
    with tempfile.TemporaryDirectory() as folder:
        if (mirror := os.environ.get("ROCKING_RECORDS")) and not numbers:
            measure_suite(Path(folder), mirror)
        measure_growth(
            Path(folder), numbers or [10, 100, 1000], [word for word in sys.argv[1:] if "=" in word]
        )
