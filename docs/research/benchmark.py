"""The cases of docs/benchmark that LMGC90 and OpenSees can follow: `python -m docs.research.benchmark lmgc90`.

Both need `pip install -e ".[compare]"`. They follow the block from rest under a horizontal motion, in a process of
their own, at three steps that are extrapolated; the answers go to standard output.
"""

import csv
import sys
from pathlib import Path

import numpy as np

from docs.research.comparison.codes import CodeCase, outer_codes, structures
from rocking.records import Accelerogram

BENCHMARK = Path(__file__).parents[1] / "benchmark"
FOLLOWED = {"pulse_two_sided": "pulse", "record_two_sided": "record"}
"""The motion of each case that both programs can follow."""


def main(program: str) -> None:
    """Write the answers of the program to standard output."""
    codes = {name.split()[0].lower(): code for name, code in outer_codes().items()}
    if program not in codes:
        sys.exit(f"the program is {program!r}, but must be one of {', '.join(codes)}.")
    mechanism = structures()["block"].mechanism()
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["case", "value"])
    for case, motion in FOLLOWED.items():
        samples = np.loadtxt(BENCHMARK / "motions" / f"{motion}.csv", delimiter=",", skiprows=1)[:, 1]
        asked = CodeCase(case, "block", motion, mechanism, Accelerogram(samples, 0.005))
        answer = codes[program](asked)
        if answer.reason:
            print(f"{case}: {answer.reason}", file=sys.stderr)
        else:
            table.writerow([case, f"{answer.rotation_ratio:.6g}"])


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")
