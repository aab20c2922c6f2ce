"""The checks of every structure of a study at its design level: their table, the page of each, and what is shown."""

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from rocking.assessment.conclusion import conclusions, worst_of_each
from rocking.assessment.cracks import mechanisms_of
from rocking.assessment.decide import Verdict, worse
from rocking.assessment.rows import FailureRow, MechanismRow, RecordRow, VerdictRow, named_records
from rocking.assessment.scene import Scene, placed
from rocking.catalogue import load_catalogue
from rocking.codes.check import CodeTerms, StructureCheck
from rocking.codes.dynamic_check import check
from rocking.codes.selection import Selection
from rocking.earthquakes.sample import INTERVAL, ClusterSample
from rocking.errors import ConfigurationError, RockingError, one_structure
from rocking.floors.support import Support
from rocking.products.checks.conclusion import CodeConclusion, code_conclusion_in_words, code_conclusions
from rocking.products.checks.report import CheckedStructure, structures_data
from rocking.products.checks.rows import KINDS, CodeCheckRow, code_check_rows
from rocking.reports.pages import Panel, Section
from rocking.reports.printing import sentence, strong, table_of, words, write_document
from rocking.structures.structure import Candidate
from rocking.structures.tied import held
from rocking.study.documents import made_or_failed
from rocking.study.job import Job, Study
from rocking.study.kept import Kept, Rows
from rocking.study.products import CHECKS
from rocking.study.selection import pool_of, select_for
from rocking.study.work import Work
from rocking.tables import rows_of, write_tables
from rocking.warnings import RockingWarning


class Checks(Work):
    """The checks at the design level: their table, and the page of each structure to sign."""

    shown = (CodeCheckRow,)
    sheets = (CodeCheckRow,)

    def make(self, job: Job) -> Kept:
        """Check every structure, and set against it what became of it under the records of the study."""
        rows = [outcome.rows for outcome in job.outcomes()]
        checked, faults = write_checks(
            job.study,
            job.folder,
            [row for table_rows in rows for row in rows_of(VerdictRow, table_rows)],
            [row for table_rows in rows for row in rows_of(RecordRow, table_rows)],
            job.show_line,
            [row for table_rows in rows for row in rows_of(MechanismRow, table_rows)],
        )
        return Kept(
            {CodeCheckRow: checked, FailureRow: faults}, code_conclusion_in_words(code_conclusions(checked))
        )

    def panel(self, rows: Rows) -> Panel | None:
        """Return the ratios of the checks, and what follows from them."""
        concluded = code_conclusions(rows_of(CodeCheckRow, rows))
        return checks_panel(concluded) if concluded else None

    def notes(self, rows: Rows) -> Mapping[str, str]:
        """Return the conclusion on each structure."""
        concluded = code_conclusions(rows_of(CodeCheckRow, rows))
        return {
            conclusion.structure: f"By the code, at the design level: {conclusion}."
            for conclusion in concluded
        }


def checks_panel(concluded: Sequence[CodeConclusion]) -> Panel:
    """Return the table of the ratios of each structure, and what follows from them."""
    kinds = [
        kind
        for kind in dict.fromkeys(KINDS.values())
        if any(kind in conclusion.ratios for conclusion in concluded)
    ]
    table = table_of(
        concluded,
        ("Structure", "1.4", "l", lambda conclusion: strong(conclusion.name)),
        *(
            (sentence(kind), "0.7", "r", lambda conclusion, kind=kind: conclusion.ratios.get(kind, "–"))
            for kind in kinds
        ),
        ("Conclusion", "1.5", "l", lambda conclusion: str(conclusion.warning)),
        (
            "Met by sets of other stations",
            "1.2",
            "l",
            lambda conclusion: words(conclusion.other_share_in_words),
        ),
    )
    caption = (
        "The checks of the Italian code (Circolare 7/2019) at the design level: capacity over demand, 1 or more where "
        "a check is met; the conclusion by the most detailed check that has an answer; and how many sets of other "
        f"stations would meet the dynamic one ({INTERVAL}). On a support at the worst period; structures.pdf has a "
        "page of each to sign."
    )
    part = Section(table=table, caption=caption)
    return Panel("Checks at the design level", (part,), "These records are not the demand of the code.")


def write_checks(
    study: Study,
    folder: Path,
    verdicts: Sequence[VerdictRow],
    records: Iterable[RecordRow],
    tell: Callable[[str], None] = lambda _: None,
    mechanisms: Sequence[MechanismRow] = (),
) -> tuple[list[CodeCheckRow], list[FailureRow]]:
    """Write code_checks.csv and structures.pdf of `study` into `folder`; return the rows of the first, and of faults.

    verdicts, records, mechanisms: the rows of all records of the study. tell: takes a line for each structure. A
    structure that cannot be checked costs no other, and without sets of records the dynamic check alone is left out;
    both are said. Raises ConfigurationError where there is no design level.
    """
    design = study.settings.design_spectrum
    asked = study.settings.checks
    spectrum = design.spectrum()
    if spectrum is None:
        raise ConfigurationError(CHECKS.refusal(study.settings), design_spectrum=None)
    worst = {conclusion.row.structure: conclusion for conclusion in worst_of_each(conclusions(verdicts, []))}
    selection, without_sets, unread = _sets(study)
    of_records = list(records)
    names = named_records(of_records, study.settings.unnamed_events == "each")
    station_of = {record: station for record, (station, _) in names.items()}
    strongest: dict[str, float] = {}
    for record_row in of_records:
        strongest[record_row.record] = max(
            strongest.get(record_row.record, 0.0), record_row.peak_acceleration_m_s2
        )
    peaks = min(strongest.values(), default=math.nan), max(strongest.values(), default=math.nan)
    check_at = partial(
        check,
        spectrum=spectrum,
        limit_state=asked.limit_state,
        confidence_factor=asked.confidence_factor,
        behaviour_factor=asked.behaviour_factor,
        least_others=asked.least_others,
        records=selection,
    )
    pages = []
    level = [warning for warning in (design.warning,) if warning]
    for name, scene in study.scenes.items():
        own = [row for row in verdicts if row.structure == name]
        for support in scene.place.axis:
            period = scene.place.period_of(support)
            there = [row for row in own if row.support_period_s == period]
            page = replace(
                _checked(scene, support, check_at, there, names),
                worst=worst.get(name),
                peaks=peaks,
                warnings=(*level, *scene.warnings),
            )
            of_scene = [
                mechanism
                for mechanism in mechanisms
                if (mechanism.structure, mechanism.support_period_s) == (name, period)
            ]
            try:
                with one_structure(name):
                    if page.checked:
                        page = _with_mechanisms(page, of_scene, station_of)
            except RockingError as error:
                page = replace(page, checked=None, refusal=error.warning or str(error))
            pages.append(page)
            tell(f"{placed(name, period)}: {page.refusal or _checks_in_words(page.checked)}")
    rows = [
        row
        for page in pages
        if page.checked
        for row in code_check_rows(page.name, page.checked, page.place.period_of(page.support))
    ]
    write_tables({CodeCheckRow: rows}, folder, "rocking-code-checks", "code_checks.json")
    pdf = folder / "structures.pdf"
    figures = study.settings.figures
    of_pages: list[RockingWarning] = []

    def write() -> None:
        terms = CodeTerms(limit_state=asked.limit_state, confidence_factor=asked.confidence_factor)
        settings = study.settings.for_pages_to_sign
        page = structures_data(pages, spectrum, settings, terms, selection, without_sets, unread, of_pages)
        write_document(pdf, page, figures)

    faults = made_or_failed(pdf, write, "the log", figures)
    faults += [
        FailureRow(structure=warning.about, stage="document", message=str(warning)) for warning in of_pages
    ]
    for fault in faults:
        tell(fault.message)
    return rows, faults


def _checked(
    scene: Scene,
    support: Support | None,
    check_at: Callable[..., StructureCheck],
    verdicts: Sequence[VerdictRow],
    names: Mapping[str, tuple[str, str]],
) -> CheckedStructure:
    """The checks of one scene with its verdicts in the study; where it cannot be checked, why.

    support: one along the axis of its place. check_at: `check` at the design level of the study. names: station and
    earthquake of each record, by its identifier.
    """
    checked: StructureCheck | None = None
    untied: StructureCheck | None = None
    refusal: str | RockingWarning = ""
    check_here = partial(
        check_at,
        support=support,
        elastic_period=scene.terms.elastic_period,
        support_loss=scene.terms.support_loss,
    )
    try:
        with one_structure(scene.name):
            checked = check_here(scene.structure)
            with suppress(RockingError):  # without its ties it may not stand
                wall = held(scene.structure)
                alone = wall and wall.without_ties()
                untied = None if alone is None else check_here(alone)
    except RockingError as error:
        checked = None
        refusal = error.warning or str(error)
    known = [row for row in verdicts if not math.isnan(row.overturning_share)]
    sample = ClusterSample.named(names[row.record] for row in known)
    shares = sample.by_station(np.array([row.overturning_share for row in known]))
    lifts = sample.by_station(np.array([float(row.rotation_ratio > 0) for row in known]))
    low, high = sample.share_bounds(shares) if known else (math.nan, math.nan)
    return CheckedStructure(
        name=scene.name,
        structure=scene.structure,
        checked=checked,
        place=scene.place,
        support=support,
        refusal=refusal,
        untied=untied,
        variant_of=scene.variant_of,
        overturning_share=float(shares.mean()) if known else math.nan,
        share_interval=(float(low), float(high)),
        records=len(known),
        stations=sample.count,
        earthquakes=sample.earthquakes if known else 0,
        still=int((lifts == 0).sum()),
        verdicts=verdicts_by_station(verdicts, {record: station for record, (station, _) in names.items()}),
        verdict_warnings=sorted({kind for row in verdicts for kind in row.warnings}),
        reserves=[row.reserve for row in verdicts if row.reserve is not None],
        reserve_warnings=sorted({kind for row in verdicts for kind in row.reserve_warnings}),
    )


def _with_mechanisms(
    page: CheckedStructure, rows: Sequence[MechanismRow], station_of: Mapping[str, str]
) -> CheckedStructure:
    """The page with every mechanism, and what the rows of its scene say: mean shares over stations, largest forces."""
    found: dict[str, list[MechanismRow]] = {}
    for row in rows:
        found.setdefault(row.crack, []).append(row)
    mechanisms = mechanisms_of(page.structure)
    mean_shares: dict[Candidate, float] = {}
    largest_forces: dict[Candidate, list[float]] = {}
    for candidate in mechanisms:
        shares: dict[str, dict[str, float]] = {}
        forces: dict[float, float] = {}
        for row in found.get(candidate.description, ()):
            if row.members and row.overturning_members is not None:
                share = row.overturning_members / row.members
                shares.setdefault(station_of[row.record], {})[row.record] = share
            so_far = forces.get(row.hold_height_m, math.nan)
            forces[row.hold_height_m] = float(np.fmax(so_far, row.largest_hold_force_n_per_m))
        of_stations = [sum(of_records.values()) / len(of_records) for of_records in shares.values()]
        if of_stations:
            mean_shares[candidate] = sum(of_stations) / len(of_stations)
        largest_forces[candidate] = [forces.get(hold.height, math.nan) for hold in candidate.reactions]
    return replace(page, mechanisms=mechanisms, mechanism_shares=mean_shares, largest_forces=largest_forces)


def verdicts_by_station(verdicts: Iterable[VerdictRow], station_of: Mapping[str, str]) -> Counter[Verdict]:
    """Return under how many stations each verdict is the worst one of its records."""
    worst: dict[str, Verdict] = {}
    for row in verdicts:
        station = station_of[row.record]
        worst[station] = worse(row.verdict, worst.get(station, row.verdict))
    return Counter(worst.values())


def _checks_in_words(checked: StructureCheck | None) -> str:
    """The checks in a line."""
    checks = checked.checks if checked else ()
    words = ", ".join(f"{KINDS[check.clause]} {check.outcome} ({check.ratio_in_words})" for check in checks)
    return f"{words}. {checked.warning}" if checked and checked.warning else words


def _sets(study: Study) -> tuple[Selection | None, str | RockingWarning, list[str]]:
    """The sets of records for the dynamic check, or why there are none; and the records that could not be read."""
    try:
        selection, reasons = select_for(study, load_catalogue(pool_of(study.settings)))
    except RockingError as error:
        return None, error.warning or str(error), []
    return selection, "", list(reasons)
