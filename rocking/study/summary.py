"""The results over all records of a study: tables, report, figure and page, from its jobs; and their fragility."""

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.assessment.case import Failure
from rocking.assessment.conclusion import conclusions, worst_of_each
from rocking.assessment.cracks import never_lets_go
from rocking.assessment.rows import (
    RECORD_TABLES,
    SUMMARY_TABLES,
    AgreementRow,
    CapacityRow,
    ComparisonRow,
    ExpectedFallsRow,
    FailedCase,
    FailureRow,
    PulseRow,
    RecordRow,
    RemarkRow,
    StructureRow,
    TimingRow,
    TradeRow,
    VariationRow,
    VerdictRow,
    agreement_rows,
    capacity_rows,
    counted_cases,
    falls_over,
    falls_under,
    named_records,
    structure_rows,
)
from rocking.assessment.scene import variants_of
from rocking.assessment.variants import VariantRow, variants
from rocking.errors import ConfigurationError, RockingError, one_structure
from rocking.quantities import counted, listed
from rocking.records import Accelerogram, CatalogueRecord
from rocking.records.sample import Sample
from rocking.reports.printing import Figures, faults_in_words, write_document
from rocking.reports.style import new_figure, svg
from rocking.structures import Mechanism, Structure
from rocking.structures.equivalent_block import Scale
from rocking.study.documents import made_or_told, write_reason
from rocking.study.job import Job, Study, costs_no_other
from rocking.study.kept import kept_rows
from rocking.study.made_from import versions
from rocking.study.outcomes import RecordOutcome, read_outcomes
from rocking.study.outputs import PROVENANCE, SUMS, former_files, kept_of, remove, sums_of
from rocking.study.settings import package_sha256, structure_hashes
from rocking.tables import (
    Row,
    data_package,
    rows_of,
    rows_written,
    write_tables,
    write_whole,
    written_together,
)
from rocking.tables.workbook import workbook

if TYPE_CHECKING:
    from rocking.codes.conclusion import CodeConclusion
    from rocking.fragility.curves import Fragility
    from rocking.fragility.hazard import Hazard
    from rocking.reports.pages import Strip

SCATTER = "prediction_against_integration.svg"
"""The figure of every case of the tables."""
_NAMED = 4
"""Files that are removed which a line names."""
WORKBOOK = "study.xlsx"
"""The tables of the summary in one file."""
OPENQUAKE = "fragility.xml"
"""Beside the fragility tables: the curves of all structures as one model of OpenQuake."""
_NOT_IN_THE_WORKBOOK = (TimingRow, VariationRow)
"""The times differ from run to run; the variations of each case are ten times as many as the cases."""


# Whole on purpose: the list of what stands over all records, in the order in which one comes from the other.
def summarise(job: Job) -> None:
    """Write everything that stands over all records, in their order, and remove what no product owns any more."""
    study = job.study
    target = job.results / "summary"
    outcomes = read_outcomes(job.plan.outcomes())
    instead = [name for name, scene in study.scenes.items() if scene.variant_of]
    beside = _beside(job)
    faults = beside.pop(FailureRow, [])
    shown, pages, spectra, sums = write_summary(
        outcomes,
        study.structures,
        target,
        study.settings.reports,
        instead,
        faults,
        study.settings.unnamed_events == "each",
        study.remarks,
        study.settings.acceleration_scale,
    )
    paths: dict[type[Row], str | list[str]] = {each: each.table.file_name for each in SUMMARY_TABLES}
    write_whole(target / "datapackage.json", data_package("rocking-study", paths))
    provenance = {
        "versions": versions(),
        "settings": study.settings.mapping(),
        "hashes": {"settings": study.settings_sha256, "package": package_sha256()},
        "structures": structure_hashes(study.scenes),
        "records": {record.id: record.sha256 for record in job.records},
    }
    text = json.dumps(provenance, indent=1, sort_keys=True, default=str)
    write_whole(target / PROVENANCE, (text + "\n").encode())
    if study.settings.reports:
        _documents(job, target, shown, beside, pages, spectra)
    for product in (*job.task.beside, "summary"):
        sums |= sums_of(product, job.plan.settings)
    lines = (f"{sha256}  {path}\n".encode() for path, sha256 in sorted(sums.items()))
    write_whole(job.results / SUMS, lines)
    if not job.task.by_name:  # else the results of other jobs lie elsewhere
        _remove_former(job)


def _remove_former(job: Job) -> None:
    """Remove what no product of the study owns any more, and say so: it would stand for what the tables do not say."""
    products = (*job.plan.products, *job.task.beside)
    former = former_files(job.plan.settings, products, [record.id for record in job.records])
    remove(job.results, former)
    if former:
        job.tell(
            f"removed {counted(len(former), 'file')} of former runs, which this study does not make: "
            f"{listed(list(map(str, former)), _NAMED)}"
        )


def _documents(
    job: Job,
    target: Path,
    shown: Mapping[type[Row], list[Row]],
    beside: Mapping[type[Row], list[Row]],
    pages: Sequence[dict[str, Any]],
    spectra: Sequence[Sequence[float]],
) -> None:
    """Write report, figure, page to explore and workbook over all records.

    shown, beside: the rows of the summary and of the other products. pages: of each record. spectra: of the components.
    """
    from rocking.reports.explore import explore_page  # matplotlib takes half a second to import

    study = job.study
    sheets = {each: rows for each, rows in shown.items() if each not in _NOT_IN_THE_WORKBOOK}
    checked: list[CodeConclusion] = []
    drawn: list[Strip] = []
    # The main job runs without the folder of the codes.
    if study.settings.design_spectrum.spectrum() is not None:
        from rocking.codes.conclusion import code_conclusions
        from rocking.codes.rows import CodeCheckRow

        checks = rows_of(CodeCheckRow, beside)
        checked = code_conclusions(checks)
        sheets |= {CodeCheckRow: beside[CodeCheckRow]} if checks else {}
    if groups := variants_of(study.scenes):
        from rocking.reports.variants import strips  # matplotlib, as above

        notes = {each.structure: (f"By the code, at the design level: {each}.",) for each in checked}
        compared = variants(groups, worst_of_each(conclusions(rows_of(VerdictRow, shown), [])))
        drawn = strips(compared, study.structures, notes=notes)
        sheets[VariantRow] = [VariantRow.of(each) for row in compared.values() for each in row]
    title = study.settings.study or ""
    figures = study.settings.figures
    pdf, scatter = target / "summary.pdf", target / SCATTER
    parts = {**shown, **beside}
    untold = made_or_told(pdf, lambda: _report(pdf, study, parts, spectra, drawn), job.log, figures)
    untold += made_or_told(scatter, lambda: _scatter(scatter, parts), job.log)
    page, book = target / "study.html", target / WORKBOOK
    untold += made_or_told(
        page,
        lambda: write_whole(
            page, explore_page(pages, study.structures, title, checked, drawn, study.remarks)
        ),
        job.log,
    )
    untold += made_or_told(
        book, lambda: write_whole(book, workbook(sheets, title, opens_on=VerdictRow)), job.log
    )
    if untold:
        write_tables({FailureRow: [*parts.get(FailureRow, []), *untold]}, target)


def write_summary(
    outcomes: Iterable[RecordOutcome],
    structures: Mapping[str, Structure],
    target: Path,
    reports: bool,
    variants: Collection[str] = (),
    faults: Collection[Row] = (),
    each_unnamed: bool = False,
    remarks: Collection[Row] = (),
    scale: Scale = "rest",
) -> tuple[dict[type[Row], list[Row]], list[dict[str, Any]], list[Sequence[float]], dict[str, str]]:
    """Write the tables of the summary into `target`, record by record.

    reports: whether the rows, and what the page to explore and the spectra show of each record, are returned as well:
    of thousands of records, which have no reports, they would fill the memory. variants: names of structures that
    stand for another one. faults: of what else stands over all records. each_unnamed: whether records that name no
    earthquake are of one each. remarks: on the study itself. scale: the block that predicts. Returned as the last are
    the hashes of the files of the records.
    """
    kept: dict[type[Row], list[Row]] = {each: [] for each in SUMMARY_TABLES}
    pages: list[dict[str, Any]] = []
    spectra: list[Sequence[float]] = []
    sums: dict[str, str] = {}
    falls_of_records: list[ExpectedFallsRow] = []
    cases: list[ComparisonRow] = []
    read: list[RecordRow] = []
    of_records = [each for each in SUMMARY_TABLES if each in RECORD_TABLES]
    with written_together(), ExitStack() as stack:
        write = {
            each: stack.enter_context(rows_written(each, target / each.table.file_name))
            for each in of_records
        }
        write[RemarkRow](remarks)  # what was typed, before what records say
        kept[RemarkRow] += remarks if reports else ()
        for outcome in outcomes:
            for each in of_records:
                write[each](outcome.rows[each])
                if reports:
                    kept[each] += outcome.rows[each]
            read += rows_of(RecordRow, outcome.rows)[:1]
            verdicts = rows_of(VerdictRow, outcome.rows)
            cases += counted_cases(rows_of(ComparisonRow, outcome.rows), verdicts)
            sums |= outcome.sums
            if falls := falls_under(verdicts, variants):
                falls_of_records.append(falls)
            if reports:
                pages.append(outcome.page)
                spectra += outcome.spectra.values()
        told = [*faults]
        for name, structure in structures.items():
            with told_of_structure(told, name):
                kept[StructureRow] += structure_rows({name: structure}, scale)
            with told_of_structure(told, name):
                kept[CapacityRow] += capacity_rows({name: structure})
        write[FailureRow](told)
        kept[FailureRow] += told if reports else ()
        names = named_records(read, each_unnamed)
        of_all = falls_over(falls_of_records, Sample.named(names[each.record] for each in falls_of_records))
        kept[ExpectedFallsRow] = [*falls_of_records, *([of_all] if of_all else [])]
        kept[AgreementRow] = list(agreement_rows(cases, names))
        write_tables({each: rows for each, rows in kept.items() if each not in write}, target)
    return kept, pages, spectra, sums


@contextmanager
def told_of_structure(faults: list[Row], name: str) -> Iterator[None]:
    """Add a row to `faults` for what goes wrong within with one structure, and go on behind it."""
    try:
        with one_structure(name):
            yield
    except RockingError as error:
        faults.append(FailureRow.of(FailedCase("", "", name, Failure("summary", str(error)))))


def _beside(job: Job) -> dict[type[Row], list[Row]]:
    """The rows of the other products over all records that the summary is handed, and their faults."""
    tables: dict[str, tuple[type[Row], ...]] = {"trade": (TradeRow, FailureRow)}
    # The main job runs without the folder of the codes.
    if "checks" in job.task.beside:
        from rocking.codes.rows import CodeCheckRow

        tables["checks"] = (CodeCheckRow,)
    if "fragility" in job.task.beside:
        from rocking.fragility.rows import FragilitySummaryRow, IdaRow  # a quarter of a second

        tables["fragility"] = (FragilitySummaryRow, IdaRow, FailureRow)
    rows: dict[type[Row], list[Row]] = {}
    for product in job.task.beside:
        for each, of_it in kept_rows(kept_of(job.results, product), tables[product]).items():
            rows.setdefault(each, []).extend(of_it)
    return {each: of_it for each, of_it in rows.items() if of_it}


def _report(
    pdf: Path,
    study: Study,
    rows: Mapping[type[Row], Sequence[Row]],
    spectra: Sequence[Sequence[float]],
    strips: Sequence["Strip"],
) -> None:
    """Write summary.pdf and, where asked for, its figures beside it.

    spectra: of the components, where there is a design level. strips: of the variants.
    """
    from rocking.reports.summary import summary_data
    from rocking.reports.trade import trade_picture

    pictures = trade_picture(rows_of(TradeRow, rows))
    level = study.settings.design_spectrum.spectrum()
    design = (level, spectra) if level is not None and spectra else None
    page = summary_data(rows, study.settings.for_pages, pictures, design, strips)
    write_document(pdf, page, study.settings.figures)


def _scatter(path: Path, rows: Mapping[type[Row], Sequence[Row]]) -> None:
    """Write the figure of every case of the tables."""
    from rocking.reports.scatter import prediction_scatter  # it loads the kernels and scipy

    scatter = prediction_scatter(rows_of(ComparisonRow, rows), rows_of(PulseRow, rows))
    write_whole(path, svg(scatter).encode())


def write_fragility(
    records: Iterable[CatalogueRecord],
    study: Study,
    folder: Path,
    tell: Callable[..., None] = lambda *_: None,
    log: Path | str = "the log",
) -> tuple[dict[type[Row], list[Row]], list[str]]:
    """Write the fragility tables of `study` and their description into `folder`, and its curves for OpenQuake.

    Returned are their rows, with those of faults, and what could not be used. The fragility.xml of a measure that
    OpenQuake lacks holds no function, and says why.

    A record that cannot be read, or lacks the intensity measure, costs no other, and a fault of a record or a structure
    neither. tell: takes a line for each structure, how many are done, and of how many. log: where faults are written.
    Raises ConfigurationError, before anything is written, where the records that are left come from fewer than two
    stations, the hazard curve is none, or no structure can overturn; one that cannot is left out, and said.
    """
    # A quarter of a second that a summary has no need of.
    from rocking.fragility import rows
    from rocking.fragility.hazard import Hazard

    settings = study.settings.fragility
    hazard = Hazard.read(settings.hazard) if settings.hazard else None
    if hazard:
        hazard.check_measure(settings.intensity_measure)
    faults: list[Row] = []
    net = partial(costs_no_other, faults, log)
    held: dict[str, str] = {}
    for name, scene in study.scenes.items():
        with net("its fragility", name):
            held[name] = never_lets_go(scene.structure)
    if all(held.values()) and not faults:
        raise ConfigurationError(
            "no structure of the list can overturn, so that none has a fragility; give ties a tie_strength at which "
            "they let go, or leave the fragility out."
        )
    opened, reasons = _opened(records, study, net)
    if not (opened or faults):
        raise ConfigurationError(
            "no record of the catalogue can be used, but a fragility needs two stations; the log says why."
        )
    curves: dict[tuple[str, float | None], Fragility] = {}
    tables: dict[type[Row], list[Row]] = {each: [] for each in rows.FRAGILITY_TABLES.values()}
    for count, (name, never) in enumerate(held.items(), start=1):
        if never:
            reasons.append(f"{name}: it cannot overturn, and has no fragility: it {never}.")
            continue
        with net("its fragility", name):
            of_scene, its_rows, its_reasons = _curves_of(name, study, opened, hazard, net)
            curves |= of_scene
            reasons += its_reasons
            for each in its_rows:
                tables[type(each)].append(each)
        tell(f"{count} of {len(study.scenes)}: {name}", count, len(study.scenes))
    if not (curves or faults):
        raise ConfigurationError(reasons[-1])
    write_tables(tables, folder, "rocking-fragility")
    with net(OPENQUAKE):
        reasons += _for_openquake(curves, folder / OPENQUAKE)
    return {**tables, FailureRow: faults}, list(dict.fromkeys(reasons))


def _curves_of(
    name: str,
    study: Study,
    opened: Mapping[str, Sequence[Accelerogram]],
    hazard: "Hazard | None",
    net: Callable[..., AbstractContextManager[None]],
) -> tuple[dict[tuple[str, float | None], "Fragility"], list[Row], list[str]]:
    """The curves of one structure by the period of its support, their rows, and what could not be used or told."""
    from rocking.fragility.curves import fragility
    from rocking.fragility.rows import IntensityMeasureRow, curve_rows, intensity_measure_rows

    settings = study.settings.fragility
    scene = study.scenes[name]
    mechanism = scene.structure.mechanism()
    of_records, accelerograms, reasons = _measured(opened, settings.intensity_measure, mechanism, net)
    names = [
        f"{record} {component.component}".strip()
        for record, component in zip(of_records, accelerograms, strict=True)
    ]
    sample = Sample.of(accelerograms, rows=of_records, each_unnamed=study.settings.unnamed_events == "each")
    reasons += map(str, sample.remarks)
    curves: dict[tuple[str, float | None], Fragility] = {}
    rows: list[Row] = []
    for support in scene.place.axis:
        period = scene.place.period_of(support)
        try:
            curves[name, period] = fragility(
                accelerograms,
                scene.structure,
                stations=sample.stations,
                events=sample.events,
                intensity_measure=settings.intensity_measure,
                largest_factor=settings.largest_factor,
                ensemble=study.settings.ensemble if settings.members else None,
                tolerance=study.settings.tolerance,
                support=support,
            )
        # Periods of one structure may be such that few records can tell the measure.
        except RockingError as error:
            reasons.append(f"{name}: {error}")
            break
        analysis = curves[name, period].analysis
        assert analysis is not None
        if hazard and not hazard.is_of(analysis.measure.name):
            reasons.append(
                f"{name}: it has no annual rate, since its levels are of {analysis.measure.name}, but the hazard "
                f"curve is {f'of {hazard.measure}' if hazard.measure else f'in {hazard.unit}'}."
            )
        rows += curve_rows(name, names, analysis, hazard, period)
        # The curves are finished, and no table beside them may take them along.
        with net(f"its rows of {IntensityMeasureRow.table.file_name}", name):
            rows += list(intensity_measure_rows(name, mechanism, accelerograms, analysis, period))
    return curves, rows, reasons


def write_beside(
    write: Callable[[Path, Path, Figures], None] | None, pdf: Path, image: Path, job: Job, faults: list[Row]
) -> None:
    """Let `write` set a document over all records as the files `pdf` and `image` (SVG).

    None has nothing to show. In both that case and that of a fault, of which `faults` gets a row, the page says why.
    """
    figures = job.study.settings.figures
    if write:
        with costs_no_other(faults, job.log, pdf.name):
            write(pdf, image, figures)
            return
    write_reason(pdf, faults_in_words({FailureRow: faults}), figures)
    write_whole(image, svg(new_figure(20)).encode())


def _for_openquake(curves: Mapping[tuple[str, float | None], "Fragility"], path: Path) -> list[str]:
    """Write the curves, by structure and period of its support, as one model of OpenQuake; or say why it cannot be.

    The file always stands, since a rule declares it: without curves it says why it holds none.
    """
    from rocking.fragility.exchange import nrml, nrml_without  # as above

    if not curves:
        write_whole(path, nrml_without("no structure has a curve."))
        return []
    named = {f"{name} at {period:g} s" if period else name: curve for (name, period), curve in curves.items()}
    try:
        write_whole(path, nrml(named, lognormal=False))
    except ConfigurationError as error:
        write_whole(path, nrml_without(str(error)))
        return [str(error)]
    return []


def _opened(
    records: Iterable[CatalogueRecord], study: Study, net: Callable[..., AbstractContextManager[None]]
) -> tuple[dict[str, list[Accelerogram]], list[str]]:
    """The components of the records that can be read, by record; and why others are left out."""
    opened: dict[str, list[Accelerogram]] = {}
    reasons: list[str] = []
    for record in records:
        try:
            with net("the fragility", record=record.id):
                opened[record.id] = list(study.open(record)[0])
        except RockingError as error:
            reasons.append(f"{record.id}: {error}")
    return opened, reasons


def _measured(
    opened: Mapping[str, Sequence[Accelerogram]],
    measure: str,
    mechanism: Mechanism,
    net: Callable[..., AbstractContextManager[None]],
) -> tuple[list[str], list[Accelerogram], list[str]]:
    """The components of the records that have the intensity measure, the record of each, and why others are out."""
    from rocking.fragility.measures import intensity_measure

    of_mechanism = intensity_measure(measure, mechanism)
    names: list[str] = []
    accelerograms: list[Accelerogram] = []
    reasons: list[str] = []
    for record, components in opened.items():
        try:
            with net(f"its {measure}", record=record):
                for each in components:
                    of_mechanism.of(each, mechanism)
                names += [record] * len(components)
                accelerograms += components
        except RockingError as error:
            reasons.append(f"{record}: {error}")
    return names, accelerograms, reasons
