"""How the cost of a study grows with its records: python bench_growth.py [10 100 1000 ...] [KEY=VALUE ...].

Studies of so many records of 40 s at 100 Hz, made by the seeded generator, with the shipped structures and settings, on
two cores: CPU per record, its share in the stages, the largest process, and the time of a second run that has nothing
to do. KEY=VALUE changes a setting: reports=True sets the PDFs too, structures=FILE takes another list.
"""

import csv
import resource
import shlex
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]


def run(folder: Path, *options: str) -> str:
    """Run the workflow on the study in `folder`; return what it printed."""
    profile = ROOT / "workflow" / "profiles" / "default"
    command = (
        f"{sys.executable} -m snakemake --snakefile {ROOT / 'Snakefile'} --cores 2 --quiet --directory {folder} "
        f"--workflow-profile {profile} --config"
    )
    return subprocess.run(
        [*shlex.split(command), *options],
        check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    ).stdout  # fmt: skip


def cpu_of_children() -> float:
    """CPU time of all finished children and of theirs, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(folder: Path, records: int, *changed: str) -> None:
    """Run a study of so many records twice, and print what it took."""
    script = ROOT / "tests" / "workflow" / "write_study.py"
    subprocess.run([sys.executable, script, folder, str(records), "40"], check=True)
    started, before = time.perf_counter(), cpu_of_children()
    run(folder, "reports=False", *changed)
    wall, cpu = time.perf_counter() - started, cpu_of_children() - before
    started = time.perf_counter()
    if "Nothing to be done" not in run(folder, "reports=False", *changed):
        raise SystemExit("the second run did something")
    again = time.perf_counter() - started
    stages: Counter[str] = Counter()
    with (folder / "results" / "summary" / "timings.csv").open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            stages[row["stage"]] += 1000 * float(row["duration_s"]) / records
    # The largest child so far: growing studies make it that of this one.
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{records} records: {wall:.1f} s, CPU {cpu:.1f} s = {1000 * cpu / records:.1f} ms each, of which")
    print("  " + ", ".join(f"{stage} {spent:.1f} ms" for stage, spent in stages.items()))
    print(f"  largest process {memory:.0f} MB; run again with nothing to do {again:.1f} s", flush=True)


def main(arguments: list[str]) -> None:
    """Measure studies in rising order."""
    changed = [word for word in arguments if "=" in word]
    with tempfile.TemporaryDirectory() as folder:
        measure(Path(folder) / "warm", 2, *changed)  # compiles, so that the first number does not pay for it
        for number in sorted(int(word) for word in arguments if "=" not in word) or [10, 100, 1000]:
            measure(Path(folder) / str(number), number, *changed)


if __name__ == "__main__":
    main(sys.argv[1:])
