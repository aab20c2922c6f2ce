"""One assessed record for the tests of the reports: synthetic motion, real computation, rows as CSV files hold."""

from dataclasses import dataclass

import numpy as np
import pytest

from rocking.assessment import columns
from rocking.assessment.assess import Assessment, AssessmentSettings, assess
from rocking.assessment.rows import Identity, all_rows, candidate_rows, processing_rows
from rocking.assessment.variations import candidates, processed, processed_variants
from rocking.pulses import Pulse
from rocking.records.accelerogram import Accelerogram, Source
from rocking.structures import Arch, Block, Wall
from rocking.study.summary import structure_rows
from rocking.tables import csv_cells

TABLES = {table.name: table for table in (*columns.RECORD_TABLES, columns.FAILURES)}
ASSESSMENT = AssessmentSettings()
SETTINGS = {
    name: getattr(ASSESSMENT, name) for name in ("tolerance", "acceleration_scale", "fragility_change")
}
HOSTILE = ("$x^$", "#panic(1)", "<b>bold</b>", "W" * 80, "Жёлтый Ω 中文")
"""Names that a template or a figure might take for markup, that no column holds, or that not every font has."""


@dataclass(frozen=True)
class Assessed:
    """What a report is made from."""

    record: str
    accelerograms: list[Accelerogram]
    structures: dict[str, object]
    tables: dict[str, list[dict[str, str]]]

    @property
    def arguments(self) -> tuple:
        """The arguments of record_report."""
        return self.record, self.accelerograms, self.structures, self.tables, SETTINGS


def shaken(component: str = "EW", scale_factor: float = 1.0, **identity) -> Accelerogram:
    """One sine pulse of 0.5 g in noise that dies away; 20 s at 100 Hz."""
    times = np.arange(2000) * 0.01
    noise = np.random.default_rng(len(component)).normal(size=times.size) * np.exp(-(((times - 5) / 3) ** 2))
    samples = Pulse(5.0, 2 * np.pi / 0.9, 3.0).acceleration(times) + np.convolve(
        noise, np.ones(5) / 5, "same"
    )
    source = Source(identity.pop("path", "one.at2"), "peer", "ab" * 32, "g")
    return Accelerogram(samples, 0.01, component, source=source, scale_factor=scale_factor, **identity)


def assessed(record: str, accelerograms: list[Accelerogram], structures: dict[str, object]) -> Assessed:
    """Compute every table of `record` and return its rows as text."""
    tables: dict[str, list] = {name: [] for name in TABLES}
    for accelerogram in accelerograms:
        computed = assess(accelerogram, structures, ASSESSMENT)
        identity = Identity(record, accelerogram, "cd" * 32)
        rows = all_rows(identity, computed, ASSESSMENT, "CC0-1.0")
        rows |= varied(identity, computed, structures)
        for name, table in TABLES.items():
            tables[name] += [csv_cells(table, row) for row in rows[name]]
    tables["structures"] = [csv_cells(columns.STRUCTURES, row) for row in structure_rows(structures)]
    return Assessed(record, accelerograms, structures, tables)


def varied(identity: Identity, computed: Assessment, structures: dict[str, object]) -> dict[str, list]:
    """Return the rows of candidates and processing."""
    made: dict[str, list] = {"candidates": [], "processing": []}
    records = processed(identity.accelerogram)
    pulse = computed.analysis.dominant if computed.analysis else None
    for name, structure in structures.items():
        found = candidates(structure, identity.accelerogram, pulse, 7, ASSESSMENT)
        made["candidates"] += candidate_rows(identity, name, found)
        made["processing"] += processing_rows(
            identity, name, processed_variants(structure, records, ASSESSMENT)
        )
    return made


@pytest.fixture(scope="package")
def example() -> Assessed:
    """Four structures under one component: two rock, one overturns, one is not lifted."""
    structures = {
        "block 4 m": Block.of_size(1.0, 4.0),
        "block 1 m": Block.of_size(0.2, 1.0),
        "wall 3 m": Wall(1.6, 1.4, 0.4),
        "arch 20 m": Arch(10.0, 1.5, np.radians(157.5)),
        "squat block": Block.of_size(2.0, 2.5),
    }
    return assessed("one", [shaken(station="STA", event="An event")], structures)


@pytest.fixture(scope="package")
def hostile() -> Assessed:
    """Hostile names everywhere, two components, a declared scale factor."""
    structures = {name: Block.of_size(0.6 + 0.1 * place, 3.0) for place, name in enumerate(HOSTILE)}
    names = {"station": HOSTILE[0], "event": HOSTILE[1], "path": HOSTILE[2], "scale_factor": 12.5}
    records = [shaken(HOSTILE[0], **names), shaken(HOSTILE[4], **names)]
    return assessed(HOSTILE[1], records, structures)
