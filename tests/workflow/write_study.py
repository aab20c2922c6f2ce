"""Write a study of synthetic records: python -m tests.workflow.write_study FOLDER RECORDS [SECONDS [TIME_STEP_S]]."""

import csv
import hashlib
import sys
from pathlib import Path

import numpy as np
import yaml

from rocking.quantities import GRAVITY
from tests.synthetic import SyntheticRecord, at2_text

ROOT = Path(__file__).parents[2]


def write_study(folder: Path, records: int, duration: float = 20.0, time_step: float = 0.01) -> None:
    """Write a study of synthetic records with the shipped settings and structures, without reports.

    Each holds a pulse of 0.1 to 0.6 g and 0.4 to 2 s, drawn by its number, in noise of 0.2 g. duration and time_step:
    of each record, s.
    """
    (folder / "records").mkdir(parents=True)
    rows = []
    for number in range(records):
        name = f"synthetic_{number:05d}"
        amplitude, period = np.random.RandomState(number).uniform((0.1, 0.4), (0.6, 2.0))
        strengths = {"pulse_amplitude": amplitude * GRAVITY, "noise_peak": 0.2 * GRAVITY}
        times = {"pulse_start": 0.2 * duration, "duration": duration, "time_step": time_step}
        recipe = SyntheticRecord(name=name, seed=number, pulse_period=period, **strengths, **times)
        content = at2_text(recipe).encode()
        (folder / "records" / f"{name}.AT2").write_bytes(content)
        rows.append((name, f"{name}.AT2", "g", hashlib.sha256(content).hexdigest()))
    with (folder / "records" / "catalogue.csv").open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream).writerows([("id", "file", "unit", "sha256"), *rows])
    shipped = yaml.safe_load((ROOT / "config" / "config.yaml").read_text(encoding="utf-8"))
    changed = {"structures": "structures.yaml", "reports": False, "trade": {"in_summary": False}}
    (folder / "config.yaml").write_text(yaml.safe_dump(shipped | changed), encoding="utf-8")
    (folder / "structures.yaml").write_bytes((ROOT / "config" / "structures.yaml").read_bytes())


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 5:
        raise SystemExit(
            "usage: python -m tests.workflow.write_study FOLDER RECORDS [DURATION_S [TIME_STEP_S]]"
        )
    write_study(Path(sys.argv[1]), int(sys.argv[2]), *map(float, sys.argv[3:]))
