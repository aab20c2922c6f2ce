"""The report of one record: what an engineer hands to a client."""

from collections.abc import Mapping, Sequence
from typing import Any

from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import RecordRow
from rocking.assessment.rows.of_study import StructureRow, structure_rows
from rocking.records.accelerogram import Accelerogram
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.paper.canvas import TEXT_WIDTH
from rocking.reports.record import curves as record_curves
from rocking.reports.record import page_one
from rocking.reports.record import sheet as record_sheet
from rocking.reports.record import tables as record_tables
from rocking.reports.record import verdict as record_verdict
from rocking.reports.record.sheet_figures import SHEET_HEIGHTS
from rocking.structures.structure import Structure


def record_report(data: Mapping[str, object]) -> bytes:
    """Return the PDF of one record from its `record_data`."""
    return compile_document("record/record.typ", data)


def failure_report(record: str, message: str) -> bytes:
    """Return a one-page PDF that says why `record` gave no result."""
    data = {"title": f"Rocking assessment: {record}", "message": message or "No reason was given."}
    return compile_document("record/failure.typ", data)


def record_data(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: RecordTables,
    settings: Mapping[str, Any],
    vertical: Accelerogram | None = None,
) -> dict[str, object]:
    """Return what the template of the record report is given: texts, tables and figures.

    Every number printed is a cell of `tables` or of the structures table, rounded. Only curves are computed here, from
    `accelerograms` and the mechanisms of `structures` (by name). settings: at least tolerance and acceleration_scale.
    vertical: the vertical component, if it acted on the responses of the tables.
    """
    numbers = record_tables.structure_numbers(structures, tables.comparison)
    scale_note = record_verdict.scale_note(tables.record)
    by_component = {row.component: tables.of_component(row.component) for row in tables.record}
    rows = list(structure_rows(structures))
    return {
        "title": f"Rocking assessment: {record}",
        "subtitle": _subtitle(tables.record),
        "running": f"{record}.{scale_note}" if scale_note else record,
        "scale-note": scale_note,
        **page_one.page_one_data(tables, rows, numbers),
        "notices": record_verdict.notices(tables),
        "verdicts": [
            _verdicts(component, of_it, numbers, scale_note)
            for component, of_it in by_component.items()
            if of_it.comparison
        ],
        "pulses": [_pulses(component, of_it) for component, of_it in by_component.items() if of_it.pulses],
        **_tables(tables, rows, numbers),
        **_pictures(accelerograms, structures, by_component, numbers, float(settings["tolerance"]), vertical),
        **_assumptions(tables, settings),
        "arch": any("arch" in row.type for row in rows),
    }


def _pulses(component: str, tables: RecordTables) -> dict[str, object]:
    return {
        "component": printing.words(component),
        "table": record_tables.pulse_table(tables.pulses),
        "sentences": record_tables.pulse_sentences(tables.pulses),
    }


def _tables(
    tables: RecordTables, rows: Sequence[StructureRow], numbers: Mapping[str, str]
) -> dict[str, object]:
    return {
        "identity": record_tables.identity_table(tables.record),
        "sheet": record_sheet.sheet_table(tables.record),
        "sheet-sentences": record_sheet.sheet_sentences(tables.record),
        "structures": record_tables.structure_table(rows, numbers),
        "methods": record_tables.method_table(tables, numbers),
        "trust": record_tables.trust_table(tables, numbers),
        "candidates": record_tables.candidate_table(tables.candidates, numbers),
        "processing": record_tables.processing_table(tables.processing, numbers),
    }


def _subtitle(rows: Sequence[RecordRow]) -> str:
    events = dict.fromkeys(row.event for row in rows if row.event)
    stations = dict.fromkeys(f"station {row.station}" for row in rows if row.station)
    parts = [", ".join(events), ", ".join(stations)]
    return " · ".join(part for part in parts if part) or "The file names no event and no station."


def _verdicts(
    component: str, tables: RecordTables, numbers: Mapping[str, str], scale_note: str
) -> dict[str, object]:
    return {
        "caption": f"Component {printing.words(component)}: the simple predictions beside the full integration, as "
        "largest rotation over critical rotation: closed form of the equivalent block under one sine pulse, that block "
        "under the whole record, the mechanism under the whole record. Last column: what becomes "
        f"of structures alike in closed form and peak values, with the 90 % interval.{scale_note}",
        "table": record_verdict.verdict_table(tables, numbers),
        "sentences": record_verdict.doubts(tables.comparison),
    }


def _pictures(
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    by_component: Mapping[str, RecordTables],
    numbers: Mapping[str, str],
    tolerance: float,
    vertical: Accelerogram | None,
) -> dict[str, list[dict[str, str]]]:
    used = [accelerogram for accelerogram in accelerograms if accelerogram.component in by_component]
    alone = len(used) == 1
    width = TEXT_WIDTH if alone else record_curves.PAIRED_WIDTH
    height = record_curves.MOTION_HEIGHTS[0 if alone else 1]
    sheet_height = SHEET_HEIGHTS[0 if alone else 1]
    pictures: dict[str, list[dict[str, str]]] = {
        name: [] for name in ("motions", "sheets", "maps", "histories", "spectra")
    }
    for accelerogram in used:
        tables = by_component[accelerogram.component]
        pulses = tables.pulses
        new = {
            "motions": record_curves.motion_picture(accelerogram, pulses, structures, height),
            "sheets": record_sheet.sheet_picture(
                accelerogram, tables.record[0], pulses, structures, numbers, sheet_height
            ),
            "maps": record_curves.map_picture(accelerogram, pulses, width) if pulses else None,
            "histories": record_curves.history_picture(
                accelerogram, structures, tables.comparison, numbers, tolerance, vertical
            ),
            "spectra": record_curves.spectrum_picture(accelerogram, structures, numbers, width),
        }
        for name, picture in new.items():
            pictures[name] += [picture] if picture else []
    return pictures | {"drawings": record_curves.drawing_pictures(structures, numbers)}


def _assumptions(tables: RecordTables, settings: Mapping[str, Any]) -> dict[str, object]:
    hashes = dict.fromkeys(f"SHA-256 {row.record_sha256}" for row in tables.record if row.record_sha256)
    warnings = dict.fromkeys(printing.words(row.warnings) for row in tables.record if row.warnings)
    return {
        "tolerance": printing.given(float(settings["tolerance"])),
        "acceleration-scale": str(settings["acceleration_scale"]),
        "friction": _friction(settings),
        "vertical": _vertical(tables.record),
        "warnings": list(warnings),
        "hashes": "; ".join(hashes) or "the file's hash is not known.",
    }


def _vertical(rows: Sequence[RecordRow]) -> str:
    component = ", ".join(dict.fromkeys(row.vertical_component for row in rows if row.vertical_component))
    if not component:
        return "The vertical ground acceleration is left out."
    return f"The vertical component {component} acts on the integrations, not on the closed form and the spectrum."


def _friction(settings: Mapping[str, Any]) -> str:
    if "friction_coefficient" not in settings:
        return "Sliding is not checked."
    coefficient = printing.given(float(settings["friction_coefficient"]))
    return f"A contact is said to slide where it needs a friction coefficient above {coefficient}."
