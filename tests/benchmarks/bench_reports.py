"""What a report costs: CPU of one record with ten structures, its parts, the first of a process, and memory.

Run: python tests/benchmarks/bench_reports.py [reports]
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "unit" / "reports"))

from conftest import Assessed, assessed, shaken, summarised

from rocking.assessment.rows.of_record import FailureRow
from rocking.reports.document import compile_document
from rocking.reports.record.report import record_data, record_report
from rocking.reports.summary.report import summary_report
from rocking.structures import Arch, Block, Wall
from rocking.tables import frame


def ten_structures() -> Assessed:
    """Blocks, walls and arches under one component."""
    structures = {f"block {height} m": Block.of_size(0.22 * height, height) for height in (2, 3, 5, 8)}
    structures |= {
        f"wall {height} m": Wall(0.5 * height, 0.45 * height, 0.1 * height) for height in (2.5, 3.5, 5)
    }
    structures |= {
        f"arch {radius} m": Arch(radius, 0.15 * radius, np.radians(157.5)) for radius in (5, 10, 15)
    }
    return assessed("ten", [shaken(station="STA")], structures)


def median_cpu(function, repeats: int = 7) -> float:
    """Median CPU time of function(place) after one call that warms up, s.

    Every call gets another place, for another name and motion: the typesetter remembers what it has set before.
    """
    function(0)
    spent = []
    for place in range(1, repeats + 1):
        started = time.process_time()
        function(place)
        spent.append(time.process_time() - started)
    return statistics.median(spent)


def another(case: Assessed, place: int) -> tuple:
    """The arguments of a report that shares no figure but the drawings with those before."""
    moved = [accelerogram.scaled(1 + 1e-3 * place) for accelerogram in case.accelerograms]
    return (f"report {place}", moved, *case.arguments[2:])


def first_report() -> float:
    """CPU of a new process that sets its first report, on a machine that has compiled but never drawn, s."""
    text = (
        "import bench_reports as b, time\ncase = b.ten_structures()\nstarted = time.process_time()\n"
        "b.record_report(b.record_data(*case.arguments))\nprint(time.process_time() - started)"
    )
    with tempfile.TemporaryDirectory() as empty:
        run = subprocess.run(
            [sys.executable, "-c", text],
            cwd=Path(__file__).parent,
            env={**os.environ, "MPLCONFIGDIR": empty},
            capture_output=True,
            text=True,
            check=True,
        )
    return float(run.stdout)


def _failure(name: str) -> FailureRow:
    return FailureRow(record=name, component="", structure="", stage="read", message="is empty.")


def resident() -> float:
    """Largest resident memory so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main(reports: int) -> None:
    """Print CPU times, their shares and the growth of memory."""
    case = ten_structures()
    tables = summarised(case.tables, case.structures)
    data = record_data(*case.arguments)
    whole = median_cpu(lambda place: record_report(record_data(*another(case, place))))
    parts = {
        "tables and figures": median_cpu(lambda place: record_data(*another(case, place))),
        "document, its figures known": median_cpu(
            lambda place: compile_document("record/record.typ", data | {"title": f"report {place}"})
        ),
    }
    print(f"record report, 10 structures: {whole:.3f} s CPU (asked for: 0.5 s)")
    for name, spent in parts.items():
        print(f"  {name}: {spent:.3f} s, {spent / whole:.0%}")
    first = first_report()
    print(f"first report of a process: {first:.2f} s CPU, {first / whole:.1f} × a later one (asked for: 5 s)")
    summary = median_cpu(
        lambda place: summary_report(
            tables | {"failures": frame(FailureRow, [_failure(str(place))])}, case.arguments[-1]
        )
    )
    print(f"summary report: {summary:.3f} s CPU, {summary / whole:.0%} of a record report")
    before = resident()
    for place in range(reports):
        record_report(record_data(*another(case, place)))
    print(f"memory after {reports} more reports: {resident() / before:.3f} of {before:.0f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
