"""CPU of each part of the work on one record, and of the integration beside scipy's with its error. Run it as a script.

Each time is the least of several turns in one run; nothing is asserted.
"""

import dataclasses
import sys
import tempfile
import time
from itertools import count
from pathlib import Path

import numpy as np
from clock import least_cpu, shaking
from scipy.constants import g

sys.path.append(str(Path(__file__).parents[1] / "unit" / "reports"))
sys.path.append(str(Path(__file__).parents[1] / "unit" / "motion"))

from conftest import assessed, shaken
from oracle import Oracle

from rocking import (
    Accelerogram,
    Arch,
    Block,
    DesignSpectrum,
    Facade,
    Mode,
    Pulse,
    Spire,
    Support,
    Wall,
    follow_stack,
    integrate,
)
from rocking.assessment.ensemble import ensemble
from rocking.assessment.methods import Method
from rocking.assessment.motions import GroundMotions
from rocking.assessment.scene import load_scenes
from rocking.catalogue import load_catalogue
from rocking.codes.static_check import kinematic_check
from rocking.pulses import extract_pulses
from rocking.records import read
from rocking.reports.record import RecordReport
from rocking.sine_pulse import predict_maxima, pulse_spectrum
from rocking.structures.mechanism import Mechanism
from rocking.study.job import Study, assess_catalogued, rows_of
from tests.synthetic import SyntheticRecord, at2_text

RATIOS = np.linspace(0.2, 12, 200)
STRUCTURES = Path(__file__).parents[2] / "config" / "structures.yaml"
RECORDS = Path(__file__).parents[2] / "records"
BLOCK = Block(3.0, 0.2, restitution=0.9)


def parts(folder: Path) -> dict[str, object]:
    """Each part by what it does."""
    path = folder / "bench.AT2"
    path.write_text(
        at2_text(
            SyntheticRecord(
                name="bench",
                seed=1,
                pulse_period=1.0,
                pulse_start=8.0,
                noise_peak=2.0,
                duration=40.0,
                time_step=0.005,
            )
        )
    )
    record = shaking(40, 3.0)
    blocks = [Block(height, 0.2).mechanism().equivalent_block() for height in np.linspace(1, 5, 100)]
    spire, strong = Spire(width=3.0, height=15.0, wall_thickness=0.25).stack(), shaking(20, 3.5)
    draw = np.random.default_rng(1)
    floor = Support((Mode(period=0.3, damping_ratio=0.05, participation=1.3),))
    pulses = [
        Pulse(amplitude=float(a), circular_frequency=float(w))
        for a, w in draw.uniform((0.5, 1), (12, 30), (10_000, 2))
    ]
    front = Facade((3.5, 3.0), (0.6, 0.5), 20e3, floor_loads=(12e3, 6e3))
    front.candidates()
    level = DesignSpectrum.ntc(1.2, 2.45, 0.33, "B")
    return {
        "kinematic checks of a façade of 24 mechanisms that are there": lambda: kinematic_check(front, level),
        "read a file of 40 s at 200 Hz": lambda: read(path),
        "numpy.loadtxt of the same file": lambda: np.loadtxt(path, skiprows=4),
        "dominant pulses of 40 s at 200 Hz": lambda: extract_pulses(record),
        "motion of a floor under 40 s at 200 Hz, with its finer samples": lambda: floor.motion(record),
        "mechanism of an arch of seven voussoirs": lambda: Arch(10.0, 1.5, 2.75, 7).mechanism(),
        "a million predictions under one sine pulse": lambda: predict_maxima(blocks, pulses),
        "a stack of six courses through 20 s": lambda: follow_stack(spire, strong),
        "spectrum of one sine pulse, 200 x 200 cells": lambda: pulse_spectrum(RATIOS, RATIOS, 0.9),
    }


def report_of_ten_structures():
    """Return what sets another report at each call: the typesetter remembers what it has set before."""
    structures = {f"block {height} m": Block.of_size(0.22 * height, height) for height in (2, 3, 5, 8)}
    structures |= {f"wall {h} m": Wall(0.5 * h, 0.45 * h, 0.1 * h) for h in (2.5, 3.5, 5)}
    structures |= {f"arch {r} m": Arch(r, 0.15 * r, np.radians(157.5)) for r in (5, 10, 15)}
    case = assessed("ten", [shaken(station="STA")], structures)
    places = count()

    def another() -> bytes:
        moved = [accelerogram.scaled(1 + 1e-3 * next(places)) for accelerogram in case.accelerograms]
        return dataclasses.replace(case, accelerograms=moved).pdf()

    return another


def print_parts() -> None:
    with tempfile.TemporaryDirectory() as folder:
        calls = parts(Path(folder)) | {"report of a record with ten structures": report_of_ten_structures()}
        for name, seconds in zip(calls, least_cpu(*calls.values(), repeats=5), strict=True):
            print(f"{1e3 * seconds:10.3f} ms  {name}")


def lively(mechanism: Mechanism, seconds: float) -> Accelerogram:
    """The strongest of some records under which the structure stands; then still ground."""
    for strength in (3.0, 2.5, 2.2, 2.0, 1.8, 1.6, 1.5, 1.4, 1.3, 1.2, 1.1):
        motion = shaking(seconds, strength * g * mechanism.uplift_multiplier, period=0.3)
        samples = np.append(motion.acceleration, np.zeros(2000))
        if integrate(mechanism, played := Accelerogram(samples, motion.time_step)).outcome == "rocks":
            return played
    raise RuntimeError("the structure stands under none of the records")


def beside_scipy() -> None:
    """One response with its error against a run at 1e-13, and the same by the oracle of the tests with its own."""
    for name, structure in (("block", BLOCK), ("arch", Arch(20.0, 2.4, np.pi))):
        mechanism = structure.mechanism()
        motion = lively(mechanism, 4)
        truth = integrate(mechanism, motion, 1e-13).rotation_ratio
        response = integrate(mechanism, motion)
        (here,) = least_cpu(lambda m=mechanism, r=motion: integrate(m, r))
        error = abs(response.rotation_ratio / truth - 1)
        print(f"{name}, 4 s at 200 Hz: {here * 1e3:.3f} ms, {response.impacts} impacts, error {error:.0e}")
        started = time.process_time()
        peak, _ = Oracle(mechanism, 1e-6, steps=1).run(motion.acceleration, motion.time_step)
        times = (time.process_time() - started) / here
        print(f"  DOP853 at 1e-6: error {abs(peak / truth - 1):.0e}, {times:,.0f} times as long")


def ensembles() -> None:
    """The ensemble of each shipped structure over one integration of it under the same record."""
    listed = load_scenes(STRUCTURES)
    for name, scene in listed.items():
        if scene.place.supports:
            continue
        mechanism = scene.structure.mechanism()
        motion = shaking(20, 2.5 * g * mechanism.uplift_multiplier, step=0.01)
        motions = GroundMotions.of(motion)
        whole, one = least_cpu(
            lambda m=mechanism, of=motions: ensemble(m, of), lambda m=mechanism, r=motion: integrate(m, r)
        )
        members = ensemble(mechanism, motions).members
        print(f"{name}: ensemble of {members} in {whole * 1e3:.2f} ms = {whole / one:.0f} integrations")


def stages() -> None:
    """The share of each stage in the time of the shipped records under the shipped structures, all of it loaded."""
    study = Study(load_scenes(STRUCTURES))
    methods = {str(method) for method in Method}
    for record in load_catalogue(RECORDS / "catalogue.csv"):
        for _ in range(2):  # the first loads what it needs
            started = time.process_time()
            result = assess_catalogued(record, study)
            assessed_at = time.process_time()
            rows = rows_of(result, record, study)
            RecordReport(result, rows, study.structures, study.settings.for_pages).pdf()
            reported_at = time.process_time()
        whole = reported_at - started
        spent = {
            str(stage): other_stage for stage, other_stage in result.durations.items() if stage not in methods
        }
        spent["rest of the assessment"] = assessed_at - started - sum(spent.values())
        spent["tables and report"] = reported_at - assessed_at
        shares = ", ".join(f"{stage} {one_stage / whole:.0%}" for stage, one_stage in spent.items())
        print(f"{record.id}: {whole:.2f} s: {shares}")


if __name__ == "__main__":
    print_parts()
    beside_scipy()
    ensembles()
    stages()
