"""How the cost of a study grows: python bench_growth.py [10 100 1000 ...] [KEY=VALUE ...].

First the cost of one record, with and without the ensemble, what of it is the compiled integration of the ensemble
alone, and what the first record of a job costs more; then its cost against samples, structures and members, with the
exponents.
Then whole studies of so many records of 40 s at 100 Hz, made by the seeded generator, with the shipped structures and
settings, on two cores: CPU per record by stage, the share of snakemake's own process, that of everything that is
neither, the largest process, and the time of a second run that has nothing to do. KEY=VALUE changes a setting:
reports=True sets the PDFs too, structures=FILE takes another list.
"""

import csv
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
import psutil

from rocking.motion import nonlinear_kernel
from rocking.records.catalogue import load_catalogue
from rocking.structures import load_structures
from rocking.study.config_file import read_settings
from rocking.study.run import Study, assess_record

ROOT = Path(__file__).parents[2]
DURATION = 40.0
SOME, REPEATS = 6, 2
"""Records whose cost is added up, as they differ, and how often each is assessed; the least counts."""


@dataclass(frozen=True)
class Measured:
    """One study: its records, wall and CPU time [s], CPU by stage [s], largest process [MB], time of a re-run [s].

    scheduler: CPU time of snakemake's own process, without its jobs, s.
    """

    records: int
    wall: float
    cpu: float
    scheduler: float
    stages: dict[str, float]
    memory: float
    again: float

    @property
    def rest(self) -> float:
        """Share of the CPU time that goes neither into the stages nor into the scheduler."""
        return 1 - (sum(self.stages.values()) + self.scheduler) / self.cpu


def snakemake(folder: Path, *options: str) -> tuple[str, float]:
    """Run the workflow on the study in `folder`; return what it printed and the CPU time of its own process, s."""
    command = [
        *(sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile")),
        *("--directory", str(folder), "--configfile", str(folder / "config.yaml"), "--cores", "2", "--quiet"),
        *("--workflow-profile", str(ROOT / "workflow" / "profiles" / "default"), *options),
    ]
    own = 0.0
    with tempfile.TemporaryFile("w+") as output:
        process = psutil.Popen(command, stdout=output, stderr=subprocess.STDOUT)
        while process.poll() is None:
            with suppress(psutil.Error):
                own = sum(process.cpu_times()[:2])
            time.sleep(0.05)
        output.seek(0)
        told = output.read()
    if process.returncode:
        raise SystemExit(told)
    return told, own


def cpu_of_children() -> float:
    """CPU time of all finished children and of theirs, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(folder: Path, records: int, changed: Sequence[str]) -> Measured:
    """Run a study of `records` records in `folder`, twice, with the settings `changed` ("KEY=VALUE")."""
    write_study(folder, records, DURATION)
    options = ["--config", "reports=False", *changed]
    started, before = time.perf_counter(), cpu_of_children()
    _, scheduler = snakemake(folder, *options)
    wall, cpu = time.perf_counter() - started, cpu_of_children() - before
    started = time.perf_counter()
    told, _ = snakemake(folder, *options)
    if "Nothing to be done" not in told:
        raise SystemExit("the second run did something")
    again = time.perf_counter() - started
    stages: Counter[str] = Counter()
    for row in rows(folder / "results" / "summary" / "timings.csv"):
        stages[row["stage"]] += float(row["duration_s"])
    # The largest child so far: growing studies make it that of this one.
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return Measured(records, wall, cpu, scheduler, dict(stages), memory, again)


def write_study(folder: Path, records: int, duration: float, time_step: float = 0.01) -> None:
    """Write a study of synthetic records."""
    script = ROOT / "tests" / "workflow" / "write_study.py"
    subprocess.run([sys.executable, script, folder, str(records), str(duration), str(time_step)], check=True)


def rows(path: Path) -> Iterator[dict[str, str]]:
    """The rows of a table."""
    with path.open(encoding="utf-8", newline="") as stream:
        yield from csv.DictReader(stream)


def of_a_record(
    folder: Path,
    duration: float = DURATION,
    structures: int = 10,
    members: int = 64,
    time_step: float = 0.01,
) -> float:
    """CPU time of one record, s, on average over some, against so many structures: the shipped ones, repeated."""
    study_folder = folder / f"{duration:g}_{time_step:g}"
    if not study_folder.exists():
        write_study(study_folder, SOME, duration, time_step)
    catalogue = study_folder / "records" / "catalogue.csv"
    settings = {"catalogue": str(catalogue), "reports": False, "ensemble": {"members": members}}
    shipped = list(load_structures(study_folder / "structures.yaml").values())
    listed = {f"structure {k}": shipped[k % len(shipped)] for k in range(structures)}
    study, spent = Study(listed, read_settings(settings)), []
    for record in load_catalogue(catalogue):
        times = []
        for _ in range(REPEATS):
            started = process_time()
            assess_record(record, study)
            times.append(process_time() - started)
        spent.append(min(times))
    return float(np.mean(spent))


def whole_records(folder: Path) -> None:
    """Print what records of two kinds cost against the shipped structures, and the kernel of the ensemble alone."""
    for duration, time_step in ((20.0, 0.01), (40.0, 0.005)):
        with clocked(nonlinear_kernel, "rock_members") as spent_without:  # on candidates and variants
            without = of_a_record(folder, duration, members=0, time_step=time_step)
        with clocked(nonlinear_kernel, "rock_members") as spent:
            whole = of_a_record(folder, duration, time_step=time_step)
        kernel = (sum(spent) - sum(spent_without)) / (SOME * REPEATS)
        print(
            f"{duration:g} s at {1 / time_step:g} Hz, 10 structures: {1000 * without:.0f} ms, with the ensemble "
            f"{1000 * whole:.0f} ms, of which its kernel takes {1000 * kernel:.0f} ms",
            flush=True,
        )


JOB = """
import sys
from pathlib import Path
from time import process_time
from rocking.records.catalogue import load_catalogue
from rocking.structures import load_structures
from rocking.study.config_file import read_settings
from rocking.study.run import Study, assess_record
folder = Path(sys.argv[1])
catalogue = str(folder / "records" / "catalogue.csv")
(record, *_), listed = load_catalogue(catalogue), load_structures(folder / "structures.yaml")
study = Study(listed, read_settings({"catalogue": catalogue, "reports": False, "ensemble": {"members": 0}}))
for _ in range(3):
    print(process_time())
    assess_record(record, study)
"""
"""What a job does, as a process of its own: prints the time before the first, second and third record."""


def first_record(folder: Path) -> None:
    """Print what a job spends on its imports and on its first record beyond another one, all compiled."""
    spent = []
    for _ in range(3):
        command = [sys.executable, "-c", JOB, str(folder / f"{DURATION:g}_0.01")]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        imported, first, second = map(float, done.stdout.split())
        spent.append((imported, 2 * first - imported - second))
    imports, beyond = np.min(spent, axis=0)
    print(
        f"first record of a job: {beyond:.2f} s beyond another, after {imports:.2f} s of imports", flush=True
    )


@contextmanager
def clocked(module: Any, name: str) -> Iterator[list[float]]:
    """Note the CPU time of each call of a function."""
    run, spent = getattr(module, name), []

    def noted(*arguments: Any) -> Any:
        started = process_time()
        found = run(*arguments)
        spent.append(process_time() - started)
        return found

    setattr(module, name, noted)
    yield spent
    setattr(module, name, run)


def growth(folder: Path) -> None:
    """Print what one record costs against each thing it grows with, and the exponent over the larger half."""
    for name, numbers, without in (
        ("duration", (20.0, 40.0, 80.0, 160.0, 320.0), False),
        ("duration", (20.0, 40.0, 80.0, 160.0, 320.0), True),
        ("structures", (5, 10, 20, 40, 80), False),
        ("members", (16, 64, 256, 1024), False),
    ):
        fixed = {"members": 0} if without else {}
        spent = [of_a_record(folder, **fixed | {name: number}) for number in numbers]
        half = len(numbers) // 2
        exponent = np.polyfit(np.log(numbers[half:]), np.log(spent[half:]), 1)[0]
        shown = ", ".join(
            f"{number:g}: {1000 * each:.0f} ms" for number, each in zip(numbers, spent, strict=True)
        )
        print(
            f"{name}{' without ensemble' if without else ''} ^ {exponent:.2f} in the end; {shown}", flush=True
        )


def report(now: Measured, before: Measured | None) -> None:
    """Print what one study took, and how its cost per record compares with that of the study before."""
    stages = ", ".join(f"{stage} {1000 * spent / now.records:.1f} ms" for stage, spent in now.stages.items())
    each = 1000 * now.cpu / now.records
    print(f"{now.records} records: {now.wall:.1f} s, CPU {now.cpu:.1f} s = {each:.1f} ms each")
    shares = f"snakemake {now.scheduler:.1f} s = {now.scheduler / now.cpu:.0%}, the rest {now.rest:.0%}"
    print(f"  stages, CPU each: {stages}; {shares}")
    print(
        f"  largest process {now.memory:.0f} MB; run again with nothing to do {now.again:.1f} s", flush=True
    )
    if before is not None:
        exponent = np.log(now.cpu / before.cpu) / np.log(now.records / before.records)
        print(f"  records ^ {exponent:.2f} since {before.records} records", flush=True)


def main(arguments: Sequence[str]) -> None:
    """Measure one record, then each number of records in rising order, and print a line for each."""
    changed = [word for word in arguments if "=" in word]
    numbers = sorted(int(word) for word in arguments if "=" not in word) or [10, 100, 1000]
    print(f"load of the machine before: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as folder:
        of_a_record(Path(folder) / "growth")  # imports, tables and what is compiled
        whole_records(Path(folder) / "growth")
        first_record(Path(folder) / "growth")
        growth(Path(folder) / "growth")
        measure(Path(folder) / "warm", 2, changed)  # compiles, so that the first number does not pay for it
        previous = None
        for number in numbers:
            now = measure(Path(folder) / str(number), number, changed)
            report(now, previous)
            previous = now
    print(f"load of the machine after: {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main(sys.argv[1:])
