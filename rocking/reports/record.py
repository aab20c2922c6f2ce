"""The report of one record: what an engineer hands to a client. Page one is looked at, the tables stand at the end."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from importlib.metadata import version
from typing import Any

import numpy as np

from rocking.assessment.fate import Fate
from rocking.assessment.method import Method
from rocking.assessment.rows.of_case import ComparisonRow, MaximumRow
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import PulseRow, RecordRow
from rocking.assessment.rows.of_study import StructureRow, structure_rows
from rocking.assessment.verdict import NEGLIGIBLE, Agreement, Verdict, agreement, rests
from rocking.motion.batch import rocking_spectrum
from rocking.motion.integration import integrate
from rocking.motion.response import Response
from rocking.pulses import Flag
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.rotation import aligned
from rocking.reports import printing
from rocking.reports import record_figures as figures
from rocking.reports.document import compile_document
from rocking.reports.panels import Placed
from rocking.reports.printing import Cell, number, ratio, short, strong, table, table_of, with_unit, words
from rocking.reports.style import picture
from rocking.structures import Structure

MOST_DRAWN = 10
"""Structures of page one, the worst first; the tables hold all."""
MOST_HISTORIES = 10
MOST_PULSES = 3
"""Ranks of pulses that are shown."""
MOST_COMPARED = 24
"""Cases whose comparison is drawn, those with the largest rotations."""
_LETTERS = 24
"""Of a line below a drawing."""
SPECTRUM_POINTS = 36
NO_BLOCK = 1.0
"""Defect from which on the block means nothing: it is as large as what is described."""
METHODS = {
    Method.PRINTED: "Eq. 15 as printed",
    Method.CLOSED_FORM: "Closed form",
    Method.MECHANISM_ON_PULSE: "Mechanism, pulse",
    Method.BLOCK_ON_RECORD: "Block, record",
    Method.MECHANISM_ON_RECORD: "Mechanism, record",
}
"""Headings of the methods, from the plainest to the full integration."""
Picture = dict[str, str]
Case = tuple[str, str]
"""Component and structure."""


def record_report(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: RecordTables,
    settings: Mapping[str, Any],
    vertical: Accelerogram | None = None,
    responses: Mapping[Case, Response] | None = None,
) -> bytes:
    """Return the PDF of one record. The arguments are those of `record_data`."""
    data = record_data(record, accelerograms, structures, tables, settings, vertical, responses)
    return compile_document("record.typ", data)


def failure_report(record: str, message: str) -> bytes:
    """Return a one-page PDF that says why `record` gave no result."""
    told = (
        "Nothing was computed for this record, so no structure was assessed under it. The other records of the run are "
        "not affected. The sentence above also stands in summary/failures.csv."
    )
    parts = [{"notice": message or "No reason was given."}, {"text": told}]
    data = {
        "title": f"Rocking assessment: {record}",
        "subtitle": "This record gave no result.",
        "parts": parts,
    }
    return compile_document("plain.typ", data)


def record_data(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: RecordTables,
    settings: Mapping[str, Any],
    vertical: Accelerogram | None = None,
    responses: Mapping[Case, Response] | None = None,
) -> dict[str, object]:
    """Return what the template of the record report is given: texts, tables and figures.

    Every number of a table is a cell of `tables` or of the structures table, rounded. structures: by name. settings: at
    least tolerance and acceleration_scale; study, client, author and date where they are given. vertical: the vertical
    component, if it acted on the responses of the tables. responses: those of the mechanism under the record with
    their histories, by component and structure; one that is not there is integrated again.
    """
    told = _Told(record, accelerograms, structures, tables, settings, vertical, responses or {})
    return {
        "title": f"Rocking assessment: {record}",
        "running": f"{record}.{told.scale_note}",
        "scale-note": told.scale_note,
        **_page_one(told),
        **_page_two(told),
        **_page_three(told),
        **_appendix(told),
    }


@dataclass(frozen=True, eq=False)
class _Told:
    """What a report is made from, and what several of its pages ask for."""

    record: str
    accelerograms: Sequence[Accelerogram]
    structures: Mapping[str, Structure]
    tables: RecordTables
    settings: Mapping[str, Any]
    vertical: Accelerogram | None
    responses: Mapping[Case, Response]

    @cached_property
    def fates(self) -> list[Fate]:
        """What became of each structure, the worst first."""
        return sorted(self.tables.verdicts, key=lambda fate: fate.severity, reverse=True)

    @cached_property
    def numbers(self) -> dict[str, str]:
        """The number by which each structure is called, from 1, by name."""
        names = dict.fromkeys([*self.structures, *(row.structure for row in self.tables.verdicts)])
        return {name: str(place) for place, name in enumerate(names, start=1)}

    @cached_property
    def motions(self) -> list[figures.Motion]:
        """The components that were assessed, with their ranked pulses."""
        known = {row.component for row in self.tables.record}
        ranked = sorted((row for row in self.tables.pulses if row.ranked), key=lambda row: row.rank)
        return [
            figures.Motion(each, [row.pulse for row in ranked if row.component == each.component])
            for each in self.accelerograms
            if each.component in known
        ]

    @cached_property
    def methods(self) -> dict[Case, dict[Method, MaximumRow]]:
        """The row of each method under the record as it is used, by case."""
        by_case: dict[Case, dict[Method, MaximumRow]] = {}
        for row in self.tables.maxima:
            if not row.processing:
                by_case.setdefault(row.case, {})[row.method] = row
        return by_case

    @cached_property
    def placed(self) -> list[Placed]:
        """Number, p and λ of the equivalent block of each structure."""
        return [
            (self.numbers[row.structure], row.frequency_parameter_rad_s, row.uplift_multiplier)
            for row in self.structure_rows
        ]

    @cached_property
    def structure_rows(self) -> list[StructureRow]:
        """The rows of the structures table."""
        return list(structure_rows(self.structures))

    @cached_property
    def scale_note(self) -> str:
        """The declared scale factors for captions and the running head, or nothing."""
        factors = dict.fromkeys(
            printing.given(row.scale_factor) for row in self.tables.record if row.scale_factor != 1
        )
        return f" Accelerations ×\u00a0{', '.join(factors)}, declared." if factors else ""

    def of(self, case: Case, method: Method, column: str) -> Any:
        """A column of the row of one method, None where the method gave none."""
        row = self.methods.get(case, {}).get(method)
        return None if row is None else getattr(row, column)

    def worst(self, name: str) -> ComparisonRow | None:
        """The component that turns a structure farthest."""
        rows = [row for row in self.tables.comparison if row.structure == name]
        return max(rows, key=lambda row: np.nan_to_num(row.integrated_rotation_ratio, nan=-1.0), default=None)


# Page one --------------------------------------------------------------------------------------------------


def _page_one(told: _Told) -> dict[str, object]:
    shown = [fate for fate in told.fates if fate.structure in told.structures][:MOST_DRAWN]
    states = tuple(_state(told, fate) for fate in shown)
    names = printing.listed([fate.structure for fate in shown])
    return {
        "about": {name: str(told.settings.get(name) or "") for name in ("study", "client", "author", "date")},
        "subtitle": _subtitle(told.tables.record),
        "key": _key_numbers(told),
        "ground": [
            picture(figures.ground_figure(told.motions), "Acceleration of the ground and its dominant pulse.")
        ]
        if told.motions
        else [],
        "strip": [
            picture(figures.strip_figure(states), f"Drawings of the structures in their state: {names}.")
        ]
        if states
        else [],
        "strip-note": _left_out(len(told.fates) - len(shown), "other structure", "verdicts"),
        "headlines": headlines(told.fates),
        "sentences": [*_remarks(told), *_warnings(told)],
        "notices": _notices(told),
    }


def _left_out(many: int, noun: str, table: str) -> str:
    place = {"methods": "of every method", "verdicts": "of verdicts"}[table]
    return f" {printing.sentence(printing.counted(many, noun))} in the table {place}." if many else ""


def _state(told: _Told, fate: Fate) -> figures.State:
    structure = told.structures[fate.structure]
    for row in told.tables.candidates:
        if (
            row.structure == fate.structure
            and row.description == fate.crack
            and math.isfinite(row.position_m)
        ):
            structure = structure.cracked_at(row.position_m)
            break
    multiplier = told.structures[fate.structure].mechanism().uplift_multiplier
    peak = max((row.peak_acceleration_m_s2 for row in told.tables.record), default=math.nan) / GRAVITY
    lines = [
        f"{fate.count} overturn" if fate.members else "one run",
        f"as given {_printed(fate.rotation_ratio, fate)}",
    ]
    if fate.members and not rests(fate.rotation_ratio_high) and fate.rotation_ratio_low < math.inf:
        low, high = (_printed(each, fate) for each in (fate.rotation_ratio_low, fate.rotation_ratio_high))
        lines.append(f"5–95 %: {low} to {'falling' if high == 'overturns' else high}")
    lines.append(f"static {number(multiplier, 2)} g, PGA {number(peak / multiplier, 2)} ×")
    lines += [short(fate.crack, _LETTERS)] if fate.crack else []
    if fate.elsewhere_crack:
        lines.append(short(fate.elsewhere_crack, _LETTERS))
        if fate.elsewhere_members:
            lines.append(f"there {fate.elsewhere_overturning_members} of {fate.elsewhere_members} overturn")
    return figures.State(f"{told.numbers[fate.structure]} {fate.structure}", structure, fate, tuple(lines))


def _printed(value: float, fate: Fate) -> str:
    """A rotation ratio with no more digits than the spread of the ensemble leaves a meaning."""
    if math.isnan(value) or math.isinf(value):
        return ratio(value)
    if rests(value):
        return "0"
    spread = fate.rotation_ratio_high - fate.rotation_ratio_low
    return printing.to_spread(value, spread) if spread > 0 else number(value, 2)


def headlines(fates: Sequence[Fate]) -> list[dict[str, str]]:
    """Return the first lines of a report: each verdict with the structures that it is of, the worst first."""
    groups: dict[str, list[str]] = {}
    for fate in fates:
        said = fate.leaning or (fate.count if fate.verdict is Verdict.OVERTURNS else "")
        if fate.verdict is Verdict.UNKNOWN:
            said = fate.why
        groups.setdefault(fate.verdict, []).append(fate.structure + (f" ({said})" if said else ""))
    return printing.headlines(groups)


def _remarks(told: _Told) -> list[str]:
    """Return what the verdicts leave out and a reader has to know beside them, in sentences."""
    depends = []
    for fate in told.fates:
        done = [row.rotation_ratio for row in told.tables.processing if row.structure == fate.structure]
        if any(map(math.isinf, done)) and any(map(math.isfinite, done)):
            depends.append(fate.structure)
    if not depends:
        return []
    return [f"Whether it overturns depends on the processing of the record: {printing.listed(depends)}."]


def _warnings(told: _Told) -> list[str]:
    """Return what the reader of the file and the integrations noticed, each once."""
    noticed = [each for row in told.tables.record for each in row.warnings]
    noticed += [response.warning for response in told.responses.values() if response.warning]
    return list(dict.fromkeys(noticed))


def _notices(told: _Told) -> list[dict[str, object]]:
    """Return the warnings that stand above everything: scale factor, nothing moves, what failed."""
    rows = told.tables.comparison
    said = [(True, text) for text in (scale_sentence(told.tables.record),) if text]
    if not rows:
        said.append((True, "No structure could be assessed under this record."))
    elif all(fate.rotation_ratio == 0 for fate in told.fates):
        said.append(
            (False, "No structure uplifts: the ground acceleration never reaches an uplift acceleration.")
        )
    failing = dict.fromkeys(
        f"{name} ({failure})"
        for (_, name), rows_of in told.methods.items()
        if (failure := _contact_failure(rows_of.get(Method.MECHANISM_ON_RECORD)))
    )
    if failing:
        said.append(
            (True, f"The model does not hold, because a contact fails, for {printing.listed(list(failing))}.")
        )
    if not told.tables.pulses:
        said.append((True, "No pulse could be sought in this record, so there is no closed-form prediction."))
    said += [(True, f"{row.structure or row.component}: {row.message}") for row in told.tables.failures]
    return [{"strong": loud, "text": text} for loud, text in said]


def scale_sentence(rows: Sequence[RecordRow]) -> str:
    """Return the sentence that declares the scale factors, or nothing when every factor is 1."""
    named = "; ".join(
        f"component {words(row.component)}: ×\u00a0{printing.given(row.scale_factor)}"
        for row in rows
        if row.scale_factor != 1
    )
    if not named:
        return ""
    return f"Not the recorded amplitude. The accelerations of the file were multiplied by a declared factor ({named})."


def _contact_failure(row: Any) -> str:
    """Return how the contacts of a response fail: "slides", "bounces", both, or nothing."""
    return " and ".join(name for name in ("slides", "bounces") if row is not None and getattr(row, name))


def _subtitle(rows: Sequence[RecordRow]) -> str:
    parts: list[str] = []
    for show in (
        lambda row: row.event,
        lambda row: f"station {row.station}" if row.station else "",
        lambda row: f"magnitude {printing.given(row.magnitude)}" if row.magnitude is not None else "",
        lambda row: (
            f"{printing.given(row.epicentral_distance_m / 1000)} km from the epicentre"
            if row.epicentral_distance_m is not None
            else ""
        ),
    ):
        parts += [text for text in dict.fromkeys(map(show, rows)) if text]
    return " · ".join(parts) or "The file names no event and no station."


def _key_numbers(told: _Told) -> list[str]:
    """PGA, PGV, D5–95 and T_p of each component in a line."""
    lines = []
    for row in told.tables.record:
        velocity_pulse = row.velocity_pulse_period_s
        period = f"Tp {number(velocity_pulse)} s" if math.isfinite(velocity_pulse) else "no Tp"
        if row.velocity_pulse_like is not None:
            period += " (pulse-like)" if row.velocity_pulse_like else " (not pulse-like)"
        numbers = (
            f"PGA {number(row.peak_acceleration_m_s2 / GRAVITY, 3)} g",
            f"PGV {number(row.peak_velocity_m_s, 3)} m/s",
            f"D5–95 {number(row.significant_duration_s, 3)} s",
            period,
        )
        lines.append(f"{words(row.component)}: {', '.join(numbers)}")
    return lines


def _origin(rows: Sequence[RecordRow]) -> str:
    """Say which version made the report of which file of which time. The time of the run is left out."""
    files = dict.fromkeys(
        f"{words(row.file)}, SHA-256 {row.record_sha256}" for row in rows if row.record_sha256
    )
    times = dict.fromkeys(row.start_time for row in rows if row.start_time)
    settings = dict.fromkeys(row.settings_sha256[:16] for row in rows if row.settings_sha256)
    parts = [
        f"First sample at {', '.join(times)}." if times else "",
        f"File: {'; '.join(files)}." if files else "",
        f"rocking {version('rocking')}"
        + (f", settings and structures {', '.join(settings)}…." if settings else "."),
    ]
    return " ".join(part for part in parts if part)


# Page two --------------------------------------------------------------------------------------------------


def _page_two(told: _Told) -> dict[str, object]:
    histories = [history for fate in told.fates if (history := _history(told, fate)) is not None]
    left = len(told.fates) - len(histories[:MOST_HISTORIES])
    note = (
        f" {printing.sentence(printing.counted(left, 'structure'))} not drawn: at rest, or less demanding."
        if left
        else ""
    )
    shown = histories[:MOST_HISTORIES]
    alt = f"Rotation histories of {printing.counted(len(shown), 'structure')} above the acceleration of the ground."
    return {
        "histories": [picture(figures.histories_figure(shown, told.motions), alt)] if shown else [],
        "histories-note": note,
    }


def _history(told: _Told, fate: Fate) -> figures.History | None:
    """The history of a structure under the component that turns it farthest; None where it rests."""
    rows = [row for row in told.tables.comparison if row.structure == fate.structure]
    worst = max(rows, key=lambda row: np.nan_to_num(row.integrated_rotation_ratio, nan=-1.0), default=None)
    if (
        worst is None
        or not worst.integrated_rotation_ratio > NEGLIGIBLE
        or fate.structure not in told.structures
    ):
        return None
    response = _response(told, worst)
    if response.times is None or response.rotation is None or response.times.size < 2:
        return None
    sides = told.structures[fate.structure].mechanism().sides
    critical = np.where(response.rotation < 0, sides[-1].critical_rotation, sides[0].critical_rotation)
    said = (
        "overturns"
        if math.isinf(worst.integrated_rotation_ratio)
        else number(worst.integrated_rotation_ratio, 2)
    )
    if len(told.motions) > 1:
        said += f", {elided_component(worst.component)}"
    predicted = worst.predicted_rotation_ratio
    closed = {math.inf: "overturns", 0.0: "no uplift"}.get(predicted, number(predicted, 2))
    impacts = f"{response.impacts} impact{'' if response.impacts == 1 else 's'}"
    remark = f"{said}, {impacts}\nclosed form: {closed}"
    band = (fate.rotation_ratio_low, fate.rotation_ratio_high) if fate.members else None
    label = f"{told.numbers[fate.structure]} {fate.structure}"
    return figures.History(label, response.times, response.rotation / critical, predicted, band, remark)


def elided_component(name: str) -> str:
    """Return a component's name as a figure has room for it."""
    return short(words(name), 10)


def _response(told: _Told, row: ComparisonRow) -> Response:
    known = told.responses.get(row.case)
    if known is not None and known.times is not None:
        return known
    accelerogram = next(each for each in told.accelerograms if each.component == row.component)
    beside = None if told.vertical is None else aligned(told.vertical, accelerogram)
    mechanism = told.structures[row.structure].mechanism()
    return integrate(
        mechanism, accelerogram, float(told.settings["tolerance"]), history=True, vertical=beside
    )


# Page three ------------------------------------------------------------------------------------------------


def _page_three(told: _Told) -> dict[str, object]:
    rows = [row for row in told.tables.comparison if row.agreement is not Agreement.UNKNOWN]
    demanding = sorted(
        rows, key=lambda row: (row.agreement is Agreement.TOO_LOW, row.integrated_rotation_ratio)
    )
    drawn = [row for row in rows if row in demanding[-MOST_COMPARED:]]
    compared = [_compared(told, row) for row in drawn]
    with_pulse = [motion for motion in told.motions if motion.pulses]
    alt = f"Closed form beside integration of {printing.counted(len(compared), 'case')}."
    return {
        "pulse-figures": [picture(figures.pulses_figure(with_pulse), "The dominant pulse and its evidence.")]
        if with_pulse
        else [],
        "comparison": [picture(figures.comparison_figure(compared), alt)] if compared else [],
        "comparison-note": _left_out(len(rows) - len(drawn), "other case", "methods"),
        "pulse-sentences": [sentence for motion in with_pulse for sentence in _pulse_sentences(told, motion)],
        "doubts": _doubts(told, rows),
    }


def _compared(told: _Told, row: ComparisonRow) -> figures.Compared:
    name = f"{told.numbers[row.structure]} {row.structure}"
    if len(told.motions) > 1:
        name = f"{short(name, 20)}, {elided_component(row.component)}"
    return figures.Compared(
        name,
        (
            row.predicted_rotation_ratio,
            _known(told.of(row.case, Method.BLOCK_ON_RECORD, "rotation_ratio")),
            row.integrated_rotation_ratio,
        ),
        row.agreement,
        row.prediction_in_words,
    )


def _known(value: float | None) -> float:
    return math.nan if value is None else value


def _pulse_sentences(told: _Told, motion: figures.Motion) -> list[str]:
    """Say what the dominant pulse of a component is, and what makes it doubtful."""
    component = motion.accelerogram.component
    row = next(
        row for row in told.tables.pulses if row.component == component and row.ranked and row.rank == 1
    )
    known = {flag.value: flag.sentence for flag in Flag}
    doubts = [known.get(flag, printing.sentence(f"{flag}.")) for flag in row.flags]
    unlike = next(
        (each.pulse_periods_unlike for each in told.tables.record if each.component == component), False
    )
    if unlike:
        doubts.append(
            "Its period differs by more than a factor of two from that of the velocity pulse: they are two features."
        )
    said = (
        f"Component {words(component)}: amplitude {number(abs(row.amplitude_m_s2))} m/s², "
        f"period {number(row.period_s)} s, from {number(row.start_time_s)} s on; it "
        f"explains {printing.percent(row.explained_energy)}\u00a0% of the "
        "acceleration energy."
    )
    return [" ".join([said, *doubts])]


def _doubts(told: _Told, rows: Sequence[ComparisonRow]) -> list[str]:
    """Say where the closed form says less than happens, and which of its two simplifications is the reason."""
    reasons: dict[str, list[str]] = {}
    for row in sorted(rows, key=lambda row: -row.integrated_rotation_ratio):
        if row.agreement is Agreement.TOO_LOW:
            block = agreement(
                _known(told.of(row.case, Method.BLOCK_ON_RECORD, "rotation_ratio")),
                row.integrated_rotation_ratio,
            )
            pulse = agreement(
                _known(told.of(row.case, Method.MECHANISM_ON_PULSE, "rotation_ratio")),
                row.integrated_rotation_ratio,
            )
            why = _BLAME.get((block is Agreement.SAME, pulse is Agreement.SAME), "")
            name = row.structure + (f" ({words(row.component)})" if len(told.motions) > 1 else "")
            reasons.setdefault(why, []).append(name)
    if not reasons:
        return ["The closed form says of no structure less than happens."] if rows else []
    return [
        f"The closed form misses what happens to {printing.listed(names, 8)}: {why}."
        for why, names in reasons.items()
    ]


_BLAME = {
    (True, True): "either simplification alone would have kept the outcome, both together do not",
    (True, False): "the equivalent block under the whole record has it, so the single pulse is the reason",
    (False, True): "the mechanism under the pulse has it, so the equivalent block is the reason",
    (False, False): "neither the block under the whole record nor the mechanism under the pulse has it",
}
"""By whether the block under the record, and the mechanism under the pulse, have the outcome of the integration."""


# Appendix --------------------------------------------------------------------------------------------------


def _appendix(told: _Told) -> dict[str, object]:
    tables, record = told.tables, told.tables.record
    measured = (
        [picture(figures.measures_figure(told.motions, told.placed), _MEASURES)] if told.motions else []
    )
    return {
        "measures": measured,
        "spectra": _spectra(told),
        "facts": facts_table(record),
        "verdicts": _verdict_table(told),
        "structures": structure_table(told.structure_rows, told.numbers),
        "pulses": pulse_table(tables.pulses),
        "methods": _method_table(told),
        "variations": _variation_table(told),
        "tolerance": printing.given(float(told.settings["tolerance"])),
        "acceleration-scale": str(told.settings["acceleration_scale"]),
        "friction": _friction(told.settings),
        "vertical": _vertical(record),
        "arch": any("arch" in row.type for row in told.structure_rows),
        "origin": _origin(record),
    }


_MEASURES = "Response spectrum with the structures on it, velocity and displacement of the ground."


def _spectra(told: _Told) -> list[Picture]:
    if not told.placed or not told.motions:
        return []
    across = _around([p for _, p, _ in told.placed])
    up = _around([multiplier for _, _, multiplier in told.placed])
    restitution = sorted(row.restitution for row in told.structure_rows)[len(told.structure_rows) // 2]
    spectra = {
        motion.name: (across, up, np.asarray(rocking_spectrum(motion.accelerogram, across, up, restitution)))
        for motion in told.motions[:2]
    }
    if not any(levels[2].any() for levels in spectra.values()):
        return []
    shown = picture(
        figures.spectra_figure(spectra, told.placed), "Rocking spectra with the structures on them."
    )
    return [shown | {"restitution": number(restitution, 2)}]


def _around(values: Sequence[float]) -> np.ndarray:
    """A grid that holds every value with room to both sides."""
    return np.geomspace(min(values) / 1.8, max(values) * 1.8, SPECTRUM_POINTS)


def facts_table(rows: Sequence[RecordRow]) -> dict[str, object]:
    """Return what was read, done and measured: one column per component, or two columns of facts for a single one."""
    facts = [[label, *[show(row) for row in rows]] for label, show in _FACTS.items()]
    facts = [fact for fact in facts if set(fact[1:]) != {printing.NOTHING}]
    if len(rows) == 1:
        facts += [["", ""]] * (len(facts) % 2)
        half = len(facts) // 2
        columns = [("", "auto", "l"), ("", "1", "l"), ("", "auto", "l"), ("", "1", "l")]
        return table(columns, [left + right for left, right in zip(facts[:half], facts[half:], strict=True)])
    return table(
        [("", "auto", "l"), *[(f"Component {words(row.component)}", "1", "l") for row in rows]], facts
    )


def _axis(row: RecordRow) -> str:
    if math.isfinite(row.velocity_pulse_azimuth_deg):
        return f"{row.velocity_pulse_azimuth_deg:.0f}° from north"
    if math.isfinite(row.velocity_pulse_orientation_rad):
        return f"{printing.given(round(math.degrees(row.velocity_pulse_orientation_rad)))}° from the first component"
    return printing.NOTHING


_FACTS: dict[str, Callable[[RecordRow], str]] = {
    "Event": lambda row: words(row.event),
    "Station": lambda row: words(row.station),
    "File": lambda row: words(row.file),
    "Format, unit": lambda row: f"{words(row.format)}, {words(row.unit)}",
    "Licence": lambda row: words(row.licence),
    "Declared scale factor": lambda row: printing.given(row.scale_factor),
    "Samples": lambda row: printing.whole(row.samples),
    "Time step": lambda row: with_unit(printing.given(row.time_step_s), "s"),
    "Duration": lambda row: with_unit(printing.given(row.duration_s), "s"),
    "High-pass corner": lambda row: with_unit(printing.given(row.high_pass_frequency_hz), "Hz"),
    "Processing": lambda row: words(row.processing or "none"),
    "Peak acceleration": lambda row: with_unit(number(row.peak_acceleration_m_s2), "m/s²"),
    "Pair, RotD50, RotD100": lambda row: (
        printing.NOTHING
        if math.isnan(row.rotd50_peak_acceleration_m_s2)
        else f"{number(row.rotd50_peak_acceleration_m_s2)}, {number(row.rotd100_peak_acceleration_m_s2)} m/s²"
    ),
    "Peak velocity": lambda row: with_unit(number(row.peak_velocity_m_s), "m/s"),
    "Peak displacement": lambda row: with_unit(number(row.peak_displacement_m), "m"),
    "Arias intensity": lambda row: with_unit(number(row.arias_intensity_m_s), "m/s"),
    "Significant duration": lambda row: with_unit(number(row.significant_duration_s), "s"),
    "Velocity pulse, period": lambda row: with_unit(number(row.velocity_pulse_period_s), "s"),
    "Velocity pulse, axis": _axis,
    "Velocity pulse, peak": lambda row: with_unit(number(row.velocity_pulse_peak_velocity_m_s), "m/s"),
    "Velocity pulse, indicator": lambda row: number(row.velocity_pulse_indicator, 2),
    "Sine over velocity pulse": lambda row: number(row.pulse_period_ratio, 2),
    "Vertical component, peak": lambda row: (
        printing.NOTHING
        if not row.vertical_component
        else f"{row.vertical_component}, {number(row.vertical_peak_acceleration_m_s2)} m/s²"
    ),
}


def _verdict_table(told: _Told) -> dict[str, object]:
    """What becomes of every structure, the worst first."""
    return table_of(
        told.fates,
        ("No.", "auto", "r", lambda fate: told.numbers[fate.structure]),
        ("Structure", "1.6", "l", lambda fate: short(fate.structure)),
        ("Verdict", "0.7", "l", lambda fate: strong(str(fate.verdict), fate.verdict is not Verdict.STANDS)),
        ("Members that overturn", "0.8", "l", lambda fate: fate.count or printing.NOTHING),
        ("As given", "0.7", "l", lambda fate: _printed(fate.rotation_ratio, fate)),
        ("5 %", "0.5", "r", lambda fate: _printed(fate.rotation_ratio_low, fate)),
        ("50 %", "0.5", "r", lambda fate: _printed(fate.rotation_ratio_median, fate)),
        ("95 %", "0.7", "r", lambda fate: _printed(fate.rotation_ratio_high, fate)),
        (
            "Worst direction, sign",
            "1",
            "l",
            lambda fate: words(", ".join(filter(None, (fate.direction, fate.polarity)))),
        ),
    )


def structure_table(rows: Iterable[StructureRow], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the structures with their equivalent blocks, and how far they are from the block exact at rest."""
    return table_of(
        rows,
        ("No.", "auto", "r", lambda row: numbers[row.structure]),
        ("Structure, type and geometry", "3.6", "l", _geometry),
        ("p [rad/s]", "0.55", "r", lambda row: number(row.frequency_parameter_rad_s)),
        ("Critical rotation [rad]", "0.75", "r", lambda row: number(row.critical_rotation_rad)),
        ("Uplift λ [g]", "0.6", "r", lambda row: number(row.uplift_multiplier)),
        ("Scale, linear\u00adised [-]", "0.65", "r", lambda row: number(row.acceleration_scale_linearised)),
        ("Scale, uplift [-]", "0.6", "r", lambda row: number(row.acceleration_scale_uplift)),
        ("Resti\u00adtution [-]", "0.65", "r", lambda row: number(row.restitution)),
        ("Block misses [%]", "0.85", "r", _defects),
    )


def _geometry(row: StructureRow) -> Cell:
    return {"text": short(row.structure), "strong": True, "below": f"{words(row.type)}: {row.geometry}"}


def _defects(row: StructureRow) -> str:
    """By how much the block exact at rest misses restoring and forcing; in words where it is no block at all."""
    if row.restoring_defect >= NO_BLOCK:
        return "no block"
    if math.isnan(row.restoring_defect + row.forcing_defect):
        return printing.NOTHING
    return f"{printing.percent(row.restoring_defect)}, {printing.percent(row.forcing_defect)}"


def pulse_table(rows: Sequence[PulseRow]) -> dict[str, object]:
    """Return the first pulses of every component."""
    return table_of(
        [row for row in rows if row.rank <= MOST_PULSES],
        ("Comp.", "0.6", "l", lambda row: words(row.component)),
        ("Kind", "auto", "l", lambda row: row.kind),
        ("Rank", "auto", "r", lambda row: printing.whole(row.rank)),
        ("Amplitude [m/s²]", "0.9", "r", lambda row: number(row.amplitude_m_s2)),
        ("Period [s]", "0.7", "r", lambda row: number(row.period_s)),
        ("Start [s]", "0.7", "r", lambda row: number(row.start_time_s)),
        ("Gain ratio [-]", "0.8", "r", lambda row: number(row.gain_ratio, 2)),
        ("Explained energy [-]", "0.9", "r", lambda row: number(row.explained_energy, 2)),
        ("Effective length [m]", "0.9", "r", lambda row: number(row.effective_length_m)),
    )


def _method_table(told: _Told) -> dict[str, object]:
    """Every method beside the others, and what stands behind them, one row per structure and component."""
    form, whole = Method.CLOSED_FORM, Method.MECHANISM_ON_RECORD
    shown = [method for method in METHODS if any(method in rows for rows in told.methods.values())]
    columns: list[tuple[str, str, str, Callable[[Case], Cell]]] = [
        ("No.", "auto", "r", lambda case: told.numbers[case[1]]),
        ("Comp.", "0.6", "l", lambda case: words(case[0])),
        ("a [-]", "0.5", "r", lambda case: number(told.of(case, form, "amplitude_ratio"))),
        ("ω/p [-]", "0.5", "r", lambda case: number(told.of(case, form, "frequency_ratio"))),
        *((METHODS[method], "0.8", "r", partial(_shown_ratio, told, method)) for method in shown),
        ("Peak [s]", "0.5", "r", lambda case: number(told.of(case, whole, "peak_time_s"))),
        ("Im\u00adpacts", "0.5", "r", lambda case: printing.whole(told.of(case, whole, "impacts"))),
        ("Friction [-]", "0.6", "r", lambda case: number(told.of(case, whole, "friction_needed"), 2)),
        ("Contacts", "0.7", "l", lambda case: _contacts(told.methods.get(case, {}).get(whole))),
    ]
    return table_of([row.case for row in told.tables.comparison], *columns)


def _shown_ratio(told: _Told, method: Method, case: Case) -> Cell:
    """A rotation ratio to three digits, in words where it is too small to be more than rest."""
    value = told.of(case, method, "rotation_ratio")
    text = "rests" if value is not None and value > 0 and rests(value) else ratio(value)
    return strong(text, method is Method.MECHANISM_ON_RECORD)


def _contacts(response: Any) -> Cell:
    failing = _contact_failure(response)
    holding = "hold" if response is not None and response.slides is False else printing.NOTHING
    return strong(failing or holding, bool(failing))


def _variation_table(told: _Told) -> dict[str, object]:
    """The governing height of hinge or crack, and the largest rotation under each processing, component by component.

    Of each structure the component that turns it farthest.
    """
    processings = list(dict.fromkeys(row.processing for row in told.tables.processing))
    by_processing = {(*row.case, row.processing): ratio(row.rotation_ratio) for row in told.tables.processing}
    cases = {row.case for row in (*told.tables.candidates, *told.tables.processing)}
    worst = [row.case for name in told.numbers if (row := told.worst(name)) is not None and row.case in cases]
    heights = {row.case: row for row in told.tables.candidates if row.governs_record}
    columns = [
        ("No.", "auto", "r"),
        ("Comp.", "0.7", "l"),
        ("Governing height [m]", "0.9", "r"),
        ("there", "0.8", "r"),
    ]
    rows: list[list[Cell]] = []
    for case in worst:
        height = heights.get(case)
        place = (number(height.position_m), ratio(height.integrated_rotation_ratio)) if height else ("–", "–")
        rest = [by_processing.get((*case, name), printing.NOTHING) for name in processings]
        rows.append([told.numbers[case[1]], words(case[0]), *place, *rest])
    return table([*columns, *((name, "1", "r") for name in processings)], rows)


def _vertical(rows: Sequence[RecordRow]) -> str:
    component = ", ".join(dict.fromkeys(row.vertical_component for row in rows if row.vertical_component))
    if not component:
        return "The vertical ground acceleration is left out."
    return f"The vertical component {component} acts on the integrations, not on the closed form and the spectrum."


def _friction(settings: Mapping[str, Any]) -> str:
    if "friction_coefficient" not in settings:
        return "Sliding is not checked."
    coefficient = printing.given(float(settings["friction_coefficient"]))
    return f"A contact slides where it needs a friction coefficient above {coefficient}."
