"""One assessed record for the tests of the reports: synthetic motion, real computation, rows as CSV files hold."""

import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import replace
from html import unescape

import numpy as np
import pytest

from rocking.assessment.assessor import Assessor
from rocking.assessment.case import PeriodResult, SceneResult
from rocking.assessment.decide import Verdict
from rocking.assessment.rows import (
    AgreementRow,
    RecordRows,
    StructureRow,
    agreement_rows,
    counted_cases,
    rows_of_record,
    structure_rows,
)
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings
from rocking.pulses import Pulse
from rocking.reports.pages import PageSettings
from rocking.reports.printing import compile_document
from rocking.reports.record import RecordReport
from rocking.reports.summary import summary_data
from rocking.signal.accelerogram import Accelerogram, Source
from rocking.structures import Arch, Block, Wall
from rocking.study.settings import Settings
from rocking.tables import Row
from tests.unit.assessment.made_rows import case, station

ASSESSMENT = AssessmentSettings()
SETTINGS = Settings(
    tolerance=ASSESSMENT.tolerance, acceleration_scale=ASSESSMENT.acceleration_scale
).for_pages
HOSTILE = ("$x^$", "#panic(1)", "<b>bold</b>", "W" * 80, "Жёлтый Ω 中文")
"""Names that a template or a figure might take for markup, that no column holds, or that not every font has."""


Word = tuple[float, float, float, float, str]
"""Left, upper, right and lower edge [points] from the upper left corner of the page, and text."""


def pages(document: bytes) -> list[list[Word]]:
    """The words of each page of a PDF."""
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext (poppler-utils) is not installed; it says for this test where the words stand")
    run = subprocess.run(["pdftotext", "-bbox", "-", "-"], input=document, capture_output=True, check=True)
    word = re.compile(r'<word xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">(.*?)</word>')
    return [
        [(*map(float, edges), unescape(text)) for *edges, text in word.findall(page)]
        for page in run.stdout.decode().split("<page ")[1:]
    ]


def judged(verdict: Verdict, rotation_ratio: float, structure: str = "", peak_side: int = 1) -> PeriodResult:
    """What became of a structure, by its verdict and the rotation ratio as given."""
    falls = {Verdict.STANDS: 0, Verdict.OVERTURNS: 64, Verdict.UNCERTAIN: 32}[verdict]
    return station(case("EW", rotation_ratio, structure, peak_side, falls=falls))


def shaken(component: str = "EW", scale_factor: float = 1.0, **identity) -> Accelerogram:
    """One sine pulse of 0.5 g in noise that dies away; 20 s at 100 Hz."""
    times = np.arange(2000) * 0.01
    noise = np.random.default_rng(len(component)).normal(size=times.size) * np.exp(-(((times - 5) / 3) ** 2))
    samples = Pulse(amplitude=5.0, circular_frequency=2 * np.pi / 0.9, start_time=3.0).acceleration(
        times
    ) + np.convolve(noise, np.ones(5) / 5, "same")
    source = Source(identity.pop("path", "one.at2"), "peer", "ab" * 32, "g")
    return Accelerogram(samples, 0.01, component, source=source, scale_factor=scale_factor, **identity)


def assessed(
    record: str, accelerograms: list[Accelerogram], structures: dict[str, object], fidelity: str = "standard"
) -> RecordReport:
    """Compute every table of `record`, each component for itself, and return its report."""
    assessor = Assessor(
        replace(ASSESSMENT, fidelity=fidelity),
        crack_heights=7,
        processing_variants=True,
        motion_measures=True,
    )
    result = assessor.assess(record, accelerograms, on_the_ground(structures))
    rows = rows_of_record(result, "cd" * 32, "CC0-1.0")
    return RecordReport(result, rows, structures, SETTINGS)


def of_structures(report: RecordReport, kinds: dict[str, str], record: str = "one") -> RecordReport:
    """The report with other structures: by name the one of the report whose results it has."""
    scenes = {}
    for name, kind in kinds.items():
        (source,) = report.result.scenes[kind].periods
        cases = {component: replace(case, structure=name) for component, case in source.cases.items()}
        scene = replace(source.scene, name=name)
        scenes[name] = SceneResult(scene, (replace(source, scene=scene, cases=cases),))
    result = replace(report.result, record=record, scenes=scenes)
    rows = rows_of_record(result, "cd" * 32, "CC0-1.0")
    return RecordReport(
        result, rows, {name: report.structures[kind] for name, kind in kinds.items()}, SETTINGS
    )


def summary_report(tables: dict[type[Row], Sequence[Row]], settings: PageSettings) -> bytes:
    """The summary as a PDF."""
    return compile_document(summary_data(tables, settings))


def summarised(tables: RecordRows, structures: dict[str, object]) -> dict[type[Row], Sequence[Row]]:
    """Return the rows of the summary of one record."""
    return tables.tables | {
        StructureRow: list(structure_rows(structures)),
        AgreementRow: list(agreement_rows(counted_cases(tables.comparison, tables.verdicts), {})),
    }


@pytest.fixture(scope="package")
def example() -> RecordReport:
    """Four structures under one component: two rock, one overturns, one is not lifted."""
    structures = {
        "block 4 m": Block.of_size(1.0, 4.0),
        "block 1 m": Block.of_size(0.2, 1.0),
        "wall 3 m": Wall(1.6, 1.4, 0.4, crack="known"),
        "arch 20 m": Arch(10.0, 1.5, np.radians(157.5)),
        "squat block": Block.of_size(2.0, 2.5),
    }
    return assessed("one", [shaken(station="STA", event="An event")], structures)


@pytest.fixture(scope="package")
def hostile() -> RecordReport:
    """Hostile names everywhere, two components, a declared scale factor."""
    structures = {name: Block.of_size(0.6 + 0.1 * place, 3.0) for place, name in enumerate(HOSTILE)}
    names = {"station": HOSTILE[0], "event": HOSTILE[1], "path": HOSTILE[2], "scale_factor": 12.5}
    records = [shaken(HOSTILE[0], **names), shaken(HOSTILE[4], **names)]
    return assessed(HOSTILE[1], records, structures)
