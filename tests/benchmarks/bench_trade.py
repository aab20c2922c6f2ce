"""Error and time of every method on shipped synthetic records, as ratios inside one run. Run it as a script.

Prints; nothing is asserted. The reference takes seconds for each case.
"""

import tempfile
from pathlib import Path

from rocking.assessment.rows.of_trade import TradeMethod, TradeMethodRow
from rocking.calibration.settings import TradeSettings
from rocking.calibration.trade import write_trade
from rocking.records import load_catalogue, open_record
from rocking.structures import Block, Wall
from rocking.tables import read_rows

CATALOGUE = Path(__file__).parents[2] / "records" / "catalogue.csv"
STRUCTURES = {"block": Block(2.0, 0.15), "wall": Wall(1.6, 1.6, 0.25)}
SETTINGS = TradeSettings(cases=4, samples=300)


def main() -> None:
    """Print, for each method: its median error and wrong verdicts, and its time over that of the mechanism."""
    listed = [record for record in load_catalogue(CATALOGUE) if record.id.startswith("synthetic")]
    records = {record.id: lambda record=record: open_record(record) for record in listed}
    with tempfile.TemporaryDirectory() as folder:
        write_trade(records, STRUCTURES, SETTINGS, Path(folder), print)
        rows = list(read_rows(TradeMethodRow, Path(folder) / TradeMethodRow.table.file_name))
    dear = next(row for row in rows if row.method == TradeMethod.MECHANISM)
    print(f"{'method':22} {'median error':>13} {'wrong':>8} {'CPU':>10} {'over the mechanism':>19}")
    for row in rows:
        print(
            f"{row.method:22} {row.error:13.2e} {row.wrong_verdicts:4d}/{row.cases:<3d} {row.cpu_s * 1e6:7.1f} us "
            f"{row.cpu_s / dear.cpu_s:19.2f}"
        )


if __name__ == "__main__":
    main()
