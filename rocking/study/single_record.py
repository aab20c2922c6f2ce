"""One file of the user's own, apart from any study, through the same functions as the workflow."""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import ComparisonRow
from rocking.assessment.rows.of_study import (
    CapacityRow,
    SpectrumRow,
    StructureRow,
    capacity_rows,
    spectrum_rows,
    structure_rows,
)
from rocking.errors import ConfigurationError
from rocking.records import Accelerogram
from rocking.records.catalogue import CatalogueRecord
from rocking.records.read import read
from rocking.structures import Outcome, load_structures
from rocking.study.job import Study, assess_components, write_report
from rocking.study.plan import settings_sha256
from rocking.study.settings import Settings
from rocking.tables import write_rows, write_tables

FREQUENCY_PARAMETERS = np.geomspace(0.5, 10, 40)
"""p of the spectrum that is written, rad/s."""
UPLIFT_MULTIPLIERS = np.geomspace(0.02, 1, 40)
"""λ of the spectrum that is written."""


@dataclass(frozen=True)
class Declared:
    """What the user says about a file: unit, time step [s], a factor, and the components to use (";" between)."""

    unit: str | None = None
    time_step: float | None = None
    scale_factor: float = 1.0
    component: str = ""


@dataclass(frozen=True)
class OwnFile:
    """A file that was read once: the row that a catalogue would hold for it, and every channel of it."""

    record: CatalogueRecord
    channels: list[Accelerogram]


def read_own(path: Path, declared: Declared) -> OwnFile:
    """Read the file at `path`. Raises RecordError."""
    channels = read(path, unit=declared.unit, time_step=declared.time_step)
    real = path.resolve()
    name = re.sub(r"[^A-Za-z0-9._-]+", "_", path.stem).strip("._-")[:70]
    record = CatalogueRecord(
        id=f"{name}_record" if name.lower() in ("", "summary") else name,
        file=real.name,
        sha256=channels[0].source.sha256,
        component=declared.component,
        unit=declared.unit or "",
        time_step=declared.time_step,
        scale_factor=declared.scale_factor,
        folder=real.parent,
    )
    return OwnFile(record, channels)


def assess_file(
    own: OwnFile, structures: Path, name: str | None, settings: Settings, output: Path | None
) -> list[str]:
    """Assess the structure `name` (None: all) of a list under one record and return lines of text.

    output: a folder for the tables and report.pdf of the record, laid out like the results of a study.
    Raises RecordError or ConfigurationError, before anything is written, when the list cannot be read or the
    record does not hold what is asked of it.
    """
    listed = load_structures(structures)
    sha256 = settings_sha256(settings, listed)
    study = _narrowed(Study(listed, settings, sha256), name, structures)
    opened = study.opened(own.channels, own.record)
    assessed = assess_components(own.record, opened, study)
    if output is not None:
        write_report(assessed, study, output / own.record.id)
        described = {
            StructureRow: structure_rows(study.structures),
            CapacityRow: capacity_rows(study.structures),
        }
        write_tables(described, output / "summary")
    return list(_lines(assessed.tables))


def write_spectrum(accelerograms: Sequence[Accelerogram], restitution: float, target: Path) -> None:
    """Write the rocking spectrum of each component to `target` as rows of p, λ and rotation ratio."""
    rows = spectrum_rows(accelerograms, FREQUENCY_PARAMETERS, UPLIFT_MULTIPLIERS, restitution)
    write_rows(SpectrumRow, rows, target)


def _narrowed(study: Study, name: str | None, structures: Path) -> Study:
    if name is None:
        return study
    if name not in study.structures:
        names = ", ".join(study.structures)
        raise ConfigurationError(f"structure is {name!r}, but must be one of those in {structures}: {names}.")
    return replace(study, structures={name: study.structures[name]})


def _lines(tables: RecordTables) -> Iterator[str]:
    for row in tables.comparison:
        yield _line(row, f"{_settled(row)} ({row.answer_reason})" if row.spared else str(row.answer_outcome))
    for failure in tables.failures:
        yield f"not assessed: {failure.structure or failure.stage}: {failure.message}"


def _settled(row: ComparisonRow) -> str:
    """Of a case whose mechanism was not integrated."""
    return "overturns" if row.answer_outcome is Outcome.OVERTURNS else "does not overturn"


def _line(row: ComparisonRow, outcome: str) -> str:
    integrated, predicted = row.integrated_rotation_ratio, row.predicted_rotation_ratio
    parts = [f"{row.component or 'component not named'}, {row.structure}: {outcome}"]
    if math.isfinite(integrated):  # overturning stands in the outcome
        parts.append(f"largest rotation {integrated:.4g} of the critical one")
    if not math.isnan(predicted):
        said = "overturning" if math.isinf(predicted) else f"{predicted:.4g}"
        parts.append(f"one pulse predicts {said} ({row.regime})")
    if row.scale_factor != 1:
        parts.append(f"the accelerations of the file were multiplied by {row.scale_factor:g}")
    return "; ".join(parts)
