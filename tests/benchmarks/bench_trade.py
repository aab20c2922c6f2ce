"""Error and time of every method on shipped synthetic records, as ratios inside one run. Run it as a script.

Prints; nothing is asserted. The reference takes seconds for each case.
"""

import math
from pathlib import Path
from statistics import median

from rocking.calibration.accuracy import TradeSettings, choose_cases, trade_rows
from rocking.records import load_catalogue, open_record
from rocking.structures import Block, Wall

CATALOGUE = Path(__file__).parents[2] / "records" / "catalogue.csv"
STRUCTURES = {"block": Block(2.0, 0.15), "wall": Wall(1.6, 1.6, 0.25)}
SETTINGS = TradeSettings(cases=4, samples=400)


def main() -> None:
    """Print, for each method and tolerance: median error, median time, and scipy DOP853's time at 1e-6 over it."""
    records = [record for record in load_catalogue(CATALOGUE) if record.id.startswith("synthetic")]
    motions = [(record.id, accelerogram) for record in records for accelerogram in open_record(record)]
    cases = choose_cases(motions, STRUCTURES, SETTINGS.cases, SETTINGS.samples)
    rows = [row for case in cases for row in trade_rows(case, SETTINGS)]
    print(f"{len(cases)} cases: " + "; ".join(f"{case.record}, {case.structure}" for case in cases))
    groups: dict[tuple[str, float | None], list] = {}
    for row in rows:
        tolerance = None if math.isnan(row.tolerance) else row.tolerance
        groups.setdefault((row.method, tolerance), []).append(row)
    scipy = median(row.duration_s for row in groups["scipy DOP853", 1e-6])
    print(
        f"{'method':22} {'tolerance':>9} {'median error':>13} {'median time':>12} {'scipy over it':>14} {'wrong':>6}"
    )
    for (method, tolerance), found in groups.items():
        errors = [row.error for row in found if not math.isnan(row.error)]
        duration = median(row.duration_s for row in found)
        wrong = sum(row.verdict_agrees is False for row in found)
        print(
            f"{method:22} {tolerance or '':>9} {median(errors) if errors else math.nan:13.2e} "
            f"{duration * 1e6:9.1f} us {scipy / duration:14.1f} {wrong:3d}/{len(found)}"
        )


if __name__ == "__main__":
    main()
