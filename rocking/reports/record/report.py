"""The report of one record: what an engineer hands to a client."""

from collections.abc import Mapping, Sequence
from typing import Any

from rocking.records.accelerogram import Accelerogram
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.printing import Row, of_component
from rocking.reports.record import curves as record_curves
from rocking.reports.record import tables as record_tables
from rocking.reports.record import variations as record_variations
from rocking.reports.record import verdict as record_verdict
from rocking.reports.style import TEXT_WIDTH
from rocking.structures.structure import Structure

Tables = Mapping[str, Sequence[Row]]


def record_report(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: Tables,
    settings: Mapping[str, Any],
    vertical: Accelerogram | None = None,
) -> bytes:
    """Return the PDF of one record.

    tables: rows of text as read from the CSV files "record", "pulses", "predictions", "responses", "comparison",
    "structures" and, where they exist, "candidates", "processing" and "failures"; every number printed is one of
    their cells, rounded. Only curves are computed here, from `accelerograms` and the mechanisms of `structures` (by
    name). settings: at least tolerance, acceleration_scale and fragility_change. vertical: the vertical component, if
    it acted on the responses of the tables.
    """
    return compile_document(
        "record/record.typ", record_data(record, accelerograms, structures, tables, settings, vertical)
    )


def failure_report(record: str, message: str) -> bytes:
    """Return a one-page PDF that says why `record` gave no result."""
    data = {"title": f"Rocking assessment: {record}", "message": message or "No reason was given."}
    return compile_document("record/failure.typ", data)


def record_data(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: Tables,
    settings: Mapping[str, Any],
    vertical: Accelerogram | None = None,
) -> dict[str, object]:
    """Return what the template of the record report is given: texts, tables and figures."""
    numbers = record_tables.structure_numbers(tables)
    scale_note = record_verdict.scale_note(tables["record"])
    return {
        "title": f"Rocking assessment: {record}",
        "subtitle": _subtitle(tables["record"]),
        "running": f"{record}.{scale_note}" if scale_note else record,
        "scale-note": scale_note,
        "notices": record_verdict.notices(tables, tables.get("failures", ())),
        "verdicts": _verdicts(tables, numbers),
        "identity": record_tables.identity_table(tables["record"]),
        "pulses": _pulse_parts(tables),
        "structures": record_tables.structure_table(tables["structures"], numbers),
        "methods": record_tables.method_table(tables, numbers),
        "trust": record_tables.trust_table(tables, numbers),
        **_variations(tables, numbers),
        **_pictures(accelerograms, structures, tables, numbers, float(settings["tolerance"]), vertical),
        **_assumptions(tables, settings),
    }


def _subtitle(rows: Sequence[Row]) -> str:
    events = [text for text in printing.distinct(rows, "event") if text]
    stations = [text for text in printing.distinct(rows, "station") if text]
    parts = [", ".join(events), ", ".join(f"station {text}" for text in stations)]
    return " · ".join(part for part in parts if part) or "The file names no event and no station."


def _verdicts(tables: Tables, numbers: Mapping[str, str]) -> list[dict[str, object]]:
    rows = tables["comparison"]
    note = record_verdict.scale_note(tables["record"])
    return [
        {
            "caption": f"Component {printing.words(component)}: largest rotation over critical rotation by the closed "
            f"form under the dominant pulse and by full integration under the whole record.{note}",
            "table": record_verdict.verdict_table(of_component(rows, component), numbers),
            "sentences": record_verdict.verdict_sentences(of_component(rows, component))
            + record_variations.processing_sentences(of_component(tables.get("processing", ()), component)),
        }
        for component in printing.distinct(rows, "component")
    ]


def _pulse_parts(tables: Tables) -> list[dict[str, object]]:
    rows = tables["pulses"]
    return [
        {
            "component": printing.words(component),
            "table": record_tables.pulse_table(of_component(rows, component)),
            "sentences": record_tables.pulse_sentences(of_component(rows, component)),
        }
        for component in printing.distinct(rows, "component")
    ]


def _variations(tables: Tables, numbers: Mapping[str, str]) -> dict[str, object]:
    candidates, processing = tables.get("candidates", ()), tables.get("processing", ())
    return {
        "candidates": record_variations.candidate_table(candidates, numbers),
        "processing": record_variations.processing_table(processing, numbers),
    }


def _pictures(
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: Tables,
    numbers: Mapping[str, str],
    tolerance: float,
    vertical: Accelerogram | None,
) -> dict[str, list[dict[str, str]]]:
    known = set(printing.distinct(tables["record"], "component"))
    used = [accelerogram for accelerogram in accelerograms if accelerogram.component in known]
    alone = len(used) == 1
    map_width = TEXT_WIDTH if alone else record_curves.MAP_WIDTH
    width = TEXT_WIDTH if alone else record_curves.PAIRED_WIDTH
    height = record_curves.MOTION_HEIGHTS[0 if alone else 1]
    pictures: dict[str, list[dict[str, str]]] = {"motions": [], "maps": [], "histories": [], "spectra": []}
    for accelerogram in used:
        pulses, predictions, cases = (
            of_component(tables[name], accelerogram.component)
            for name in ("pulses", "predictions", "comparison")
        )
        new = {
            "motions": record_curves.motion_picture(accelerogram, pulses, tables["structures"], height),
            "maps": record_curves.map_picture(accelerogram, pulses, map_width) if pulses else None,
            "histories": record_curves.history_picture(
                accelerogram, structures, cases, numbers, tolerance, vertical
            ),
            "spectra": record_curves.spectrum_picture(accelerogram, predictions, numbers, width),
        }
        for name, picture in new.items():
            pictures[name] += [picture] if picture else []
    oriented = record_curves.orientation_picture(used)
    pictures["orientations"] = [oriented] if oriented else []
    return pictures | {"drawings": record_curves.drawing_pictures(structures, numbers)}


def _assumptions(tables: Tables, settings: Mapping[str, Any]) -> dict[str, object]:
    hashes = printing.distinct(tables["record"], "record_sha256")
    change = 100 * float(settings["fragility_change"])
    return {
        "tolerance": printing.given(str(settings["tolerance"])),
        "fragility-change": f"{printing.given(str(change))} %",
        "acceleration-scale": str(settings["acceleration_scale"]),
        "friction": _friction(settings),
        "vertical": _vertical(tables["record"]),
        "warnings": [text for text in printing.distinct(tables["record"], "warnings") if text],
        "hashes": "; ".join(f"SHA-256 {text}" for text in hashes if text) or "the file's hash is not known.",
    }


def _vertical(rows: Sequence[Row]) -> str:
    named = printing.distinct((row for row in rows if row.get("vertical_component")), "vertical_component")
    if not named:
        return "The vertical ground acceleration is left out."
    component = ", ".join(named)
    return f"The vertical component {component} acts on the integrations, not on the closed form and the spectrum."


def _friction(settings: Mapping[str, Any]) -> str:
    if "friction_coefficient" not in settings:
        return "Sliding is not checked."
    coefficient = printing.given(str(settings["friction_coefficient"]))
    return f"A contact is said to slide where it needs a friction coefficient above {coefficient}."
