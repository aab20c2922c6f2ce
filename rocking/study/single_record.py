"""One file of the user's own, apart from any study, through the same functions as the workflow."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from rocking.assessment import columns
from rocking.errors import ConfigurationError
from rocking.motion.spectrum import rocking_spectrum
from rocking.records import Accelerogram
from rocking.records.catalogue import CatalogueRecord
from rocking.records.read import read
from rocking.structures import load_structures
from rocking.study.plan import package_sha256, settings_sha256
from rocking.study.run import Opened, Study, write_tables
from rocking.study.settings import Settings
from rocking.study.summary import structure_rows
from rocking.tables import Row, read_rows, write_table

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
    sha256 = settings_sha256(settings, structures.read_bytes(), package_sha256())
    study = _narrowed(Study(load_structures(structures), settings, sha256), name, structures)
    opened = study.opened(own.channels, own.record)
    with TemporaryDirectory() as temporary:
        folder = (output or Path(temporary)) / own.record.id
        write_tables(own.record, opened, study, folder)
        if output is not None:
            _write_report(own.record, opened, study, output)
        return list(_lines(folder))


def write_spectrum(accelerograms: Sequence[Accelerogram], restitution: float, target: Path) -> None:
    """Write the rocking spectrum of each component to `target` as rows of p, λ and rotation ratio."""
    write_table(columns.SPECTRUM, list(_spectrum_rows(accelerograms, restitution)), target)


def _narrowed(study: Study, name: str | None, structures: Path) -> Study:
    if name is None:
        return study
    if name not in study.structures:
        names = ", ".join(study.structures)
        raise ConfigurationError(f"structure is {name!r}, but must be one of those in {structures}: {names}.")
    return replace(study, structures={name: study.structures[name]})


def _write_report(record: CatalogueRecord, opened: Opened, study: Study, output: Path) -> None:
    # Matplotlib and typst take a second to import: only for those who ask for a report.
    from rocking.study.record_reports import write_report

    write_report(record, lambda: opened, study, output / record.id)
    write_table(
        columns.STRUCTURES,
        structure_rows(study.structures),
        output / "summary" / columns.STRUCTURES.file_name,
    )


def _lines(folder: Path) -> Iterator[str]:
    tables = {
        t.name: read_rows(folder / t.file_name)
        for t in (columns.COMPARISON, columns.RESPONSES, columns.FAILURES)
    }
    responses = {
        (row["component"], row["structure"]): row
        for row in tables["responses"]
        if row["method"] == "mechanism on record"
    }
    for row in tables["comparison"]:
        yield _line(row, responses[row["component"], row["structure"]]["outcome"])
    for row in tables["failures"]:
        yield f"not assessed: {row['structure'] or row['stage']}: {row['message']}"


def _line(row: dict[str, str], outcome: str) -> str:
    factor, regime = float(row["scale_factor"]), row["regime"]
    parts = [
        f"{row['component'] or 'component not named'}, {row['structure']}: {outcome}",
        *_sentence("largest rotation {} of the critical one", row["integrated_rotation_ratio"]),
        *_sentence(f"one pulse predicts {{}} ({regime})", row["predicted_rotation_ratio"]),
        *([f"light {row['light']}"] if row["light"] else []),
        *([f"the accelerations of the file were multiplied by {factor:g}"] if factor != 1 else []),
        *(["FRAGILE: a small change of the ground motion flips this"] if row["fragile"] == "true" else []),
    ]
    return "; ".join(parts)


def _sentence(text: str, ratio: str) -> list[str]:
    """The text with a rotation ratio in it; nothing where there is none or the outcome says it all."""
    if not ratio or (ratio == "INF" and "predicts" not in text):
        return []
    return [text.format("overturning" if ratio == "INF" else f"{float(ratio):.4g}")]


def _spectrum_rows(accelerograms: Sequence[Accelerogram], restitution: float) -> Iterator[Row]:
    for accelerogram in accelerograms:
        ratios = rocking_spectrum(accelerogram, FREQUENCY_PARAMETERS, UPLIFT_MULTIPLIERS, restitution)
        for p, row in zip(FREQUENCY_PARAMETERS.tolist(), ratios.tolist(), strict=True):
            for multiplier, value in zip(UPLIFT_MULTIPLIERS.tolist(), row, strict=True):
                yield {
                    "component": accelerogram.component,
                    "frequency_parameter_rad_s": p,
                    "uplift_multiplier": multiplier,
                    "restitution": restitution,
                    "rotation_ratio": value,
                    "scale_factor": accelerogram.scale_factor,
                    "record_sha256": accelerogram.source.sha256,
                }
