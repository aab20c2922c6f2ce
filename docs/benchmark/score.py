"""Score the answers of programs to the benchmark: `python score.py answers/*.csv`; each a CSV of case and value.

A program answers what it can: a case that is left out is not counted. inf is an answer: it overturns. Prints for every
case what is expected and how far each answer is from it; ends with status 1 where one lies beyond its tolerance.
"""

import csv
import math
import sys
from pathlib import Path


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def error(value: float, expected: float) -> float:
    """Return the relative error of an answer; inf where one overturns and the other does not."""
    if math.isinf(value) or math.isinf(expected):
        return 0.0 if value == expected else math.inf
    return abs(value - expected) / abs(expected)


def main(paths: list[Path]) -> int:
    cases = rows(Path(__file__).parent / "cases.csv")
    answers = {path.stem: {each["case"]: float(each["value"]) for each in rows(path)} for path in paths}
    known = {each["case"] for each in cases}
    for program, own in answers.items():
        if strange := sorted(own.keys() - known):
            print(
                f"{program} answers {', '.join(strange)}, which the benchmark does not ask.", file=sys.stderr
            )
            return 2
    missed = 0
    print(f"{'case':30}{'expected':>14} {'unit':6}{'tolerance':>10}", *(f"{each:>16}" for each in answers))
    for case in cases:
        expected, tolerance = float(case["expected"]), float(case["tolerance"])
        cells = []
        for own in answers.values():
            if case["case"] not in own:
                cells.append(f"{'':>16}")
                continue
            off = error(own[case["case"]], expected)
            missed += not off <= tolerance
            cells.append(f"{off:>14.1e} {'✓' if off <= tolerance else '✗'}")
        print(f"{case['case']:30}{expected:>14.6g} {case['unit']:6}{tolerance:>10.0e}", *cells)
    print(f"{missed} answers beyond their tolerance.")
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main([Path(each) for each in sys.argv[1:]]))
