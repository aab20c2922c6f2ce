"""CPU time of 42 records of FEMA P-695 and the ten shipped structures with ensembles: without PDFs, then with them.

Needs the records in the folder named by ROCKING_RECORDS. Asked, once compiled: 25 s and 70 s; the shipped example 12 s.
"""

import csv
import os
import shutil
import sys
import tempfile
from pathlib import Path

import yaml
from bench_growth import ROOT, cpu_of_children, run

RECORDS = 42


def measure(folder: Path, name: str, *changed: str) -> None:
    """Run the study in `folder` from the start and print what it took."""
    shutil.rmtree(folder / "results", ignore_errors=True)
    before = cpu_of_children()
    run(folder, *changed)
    print(f"{name}: CPU {cpu_of_children() - before:.1f} s", flush=True)


def main() -> None:
    """Measure the shipped example and the suite."""
    if not (mirror := os.environ.get("ROCKING_RECORDS")):
        sys.exit("bench_suite.py: ROCKING_RECORDS names no folder of records; nothing is measured")
    with tempfile.TemporaryDirectory() as temporary:
        example, suite = Path(temporary) / "example", Path(temporary) / "suite"
        for folder in (example, suite):
            shutil.copytree(ROOT / "records", folder / "records")
            shutil.copytree(ROOT / "workflow", folder / "workflow")
        run(example, "reports=true")  # compiles
        measure(example, "shipped example", "reports=true")
        with (ROOT / "records" / "fema_p695.csv").open(encoding="utf-8", newline="") as stream:
            head, *rows = csv.reader(stream)
        with (suite / "records" / "suite.csv").open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream).writerows([head, *rows[:RECORDS]])
        settings = {
            "catalogue": "records/suite.csv",
            "structures": "workflow/structures.yaml",
            "mirror": mirror,
        }
        (suite / "config.yaml").write_text(yaml.safe_dump(settings), encoding="utf-8")
        measure(suite, f"{RECORDS} records without PDFs", "reports=false")
        measure(suite, f"{RECORDS} records with PDFs", "reports=true")


if __name__ == "__main__":
    main()
