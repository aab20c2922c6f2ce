"""The fragility of every structure of a study: its tables, document and curves for OpenQuake, and what is shown."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path

from rocking.assessment.cracks import never_overturns_because
from rocking.assessment.rows import FailureRow
from rocking.catalogue import CatalogueRecord
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import ConfigurationError, RockingError
from rocking.fragility.curves import Fragility, fragility
from rocking.fragility.exchange import nrml, nrml_without
from rocking.fragility.hazard import Hazard
from rocking.fragility.measures import intensity_measure
from rocking.products.fragility.report import fragility_panel, write_fragility_report
from rocking.products.fragility.rows import (
    FRAGILITY_TABLES,
    FragilityRow,
    FragilitySummaryRow,
    IdaRow,
    IntensityMeasureRow,
    curve_rows,
    intensity_measure_rows,
)
from rocking.quantities import counted
from rocking.records import Accelerogram
from rocking.reports.pages import Panel
from rocking.reports.printing import faults_in_words
from rocking.structures import Mechanism
from rocking.study.documents import made_or_failed, write_reason
from rocking.study.job import Job, Study, costs_no_other
from rocking.study.kept import Kept, Rows
from rocking.study.work import Work
from rocking.tables import Row, write_tables, write_whole

OPENQUAKE = "fragility.xml"
"""Next to the fragility tables: the curves of all structures as one model of OpenQuake."""


class Fragilities(Work):
    """The fragility of every structure under all records."""

    shown = (FragilitySummaryRow, IdaRow)

    def make(self, job: Job) -> Kept:
        """Scale the records until the structures overturn."""
        folder = job.folder
        rows, reasons = write_fragility(job.records, job.study, folder, job.show_line, job.log)
        pdf, image, figures = folder / "fragility.pdf", folder / "fragility.svg", job.study.settings.figures
        if rows[FragilityRow]:
            make = partial(write_fragility_report, rows, pdf, image, figures)
            rows[FailureRow] += made_or_failed(pdf, make, job.log, figures, image=image)
        else:
            for path in (pdf, image):
                write_reason(path, faults_in_words(rows), figures)
        job.show_line("\n".join([*reasons, *faults_in_words(rows)]) or "All records were used.")
        return Kept(rows)

    def panel(self, rows: Rows) -> Panel | None:
        """Return what the curves of each structure come down to."""
        return fragility_panel(rows) if rows[FragilitySummaryRow] else None


def write_fragility(
    records: Iterable[CatalogueRecord],
    study: Study,
    folder: Path,
    show_progress: Callable[..., None] = lambda *_: None,
    log: Path | str = "the log",
) -> tuple[dict[type[Row], list[Row]], list[str]]:
    """Write the fragility tables of `study` and their description into `folder`, and its curves for OpenQuake.

    Returned are their rows, with those of faults, and what could not be used. The fragility.xml of a measure that
    OpenQuake lacks holds no function, and says why.

    A record that cannot be read, or lacks the intensity measure, costs no other, and a fault of a record or a structure
    neither. show_progress: takes a line for each structure, how many are done, and of how many. log: where faults are
    written.
    Raises ConfigurationError, before anything is written, where the records that are left come from fewer than two
    stations, the hazard curve is none, or no structure can overturn; one that cannot is left out, and said.
    """
    settings = study.settings.fragility
    hazard = Hazard.read(settings.hazard) if settings.hazard else None
    if hazard:
        hazard.check_measure(settings.intensity_measure)
    faults: list[Row] = []
    net = partial(costs_no_other, faults, log)
    never_because: dict[str, str] = {}
    for name, scene in study.scenes.items():
        with net("its fragility", name):
            never_because[name] = never_overturns_because(scene.structure)
    if all(never_because.values()) and not faults:
        raise ConfigurationError(
            "no structure of the list can overturn, so that none has a fragility; give ties a tie_strength at which "
            "they fail, or leave the fragility out.",
            structures=list(never_because),
        )
    opened, reasons = _opened(records, study, net)
    if not (opened or faults):
        raise ConfigurationError(
            "no record of the catalogue can be used, but a fragility needs two stations; the log says why."
        )
    curves: dict[tuple[str, float | None], Fragility] = {}
    tables: dict[type[Row], list[Row]] = {row_class: [] for row_class in FRAGILITY_TABLES.values()}
    for count, (name, never) in enumerate(never_because.items(), start=1):
        if never:
            reasons.append(f"{name}: it cannot overturn, and has no fragility: it {never}.")
            continue
        with net("its fragility", name):
            if study.scenes[name].structure.joints.as_stones and study.settings.fidelity != "quick":
                of_all = counted(sum(map(len, opened.values())), "component")
                show_progress(
                    f"{name}: its stones take some ten seconds of processor time under each of {of_all}"
                )
            of_scene, its_rows, its_reasons = _curves_of(name, study, opened, hazard, net)
            curves |= of_scene
            reasons += its_reasons
            for row in its_rows:
                tables[type(row)].append(row)
        show_progress(f"{count} of {len(study.scenes)}: {name}", count, len(study.scenes))
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
    hazard: Hazard | None,
    net: Callable[..., AbstractContextManager[None]],
) -> tuple[dict[tuple[str, float | None], Fragility], list[Row], list[str]]:
    """The curves of one structure by the period of its support, their rows, and what could not be used or computed."""
    settings = study.settings.fragility
    scene = study.scenes[name]
    mechanism = scene.structure.mechanism()
    of_records, accelerograms, reasons = _measured(opened, settings.intensity_measure, mechanism, net)
    names = [
        f"{record} {component.component}".strip()
        for record, component in zip(of_records, accelerograms, strict=True)
    ]
    sample = ClusterSample.of(
        accelerograms, rows=of_records, each_unnamed=study.settings.unnamed_events == "each"
    )
    reasons += map(str, sample.warnings)
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
                contacts=study.settings.fidelity != "quick",
            )
        # Periods of one structure may be such that few records have the measure.
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
        # The curves are finished, and no other table may take them along.
        with net(f"its rows of {IntensityMeasureRow.table.file_name}", name):
            rows += list(intensity_measure_rows(name, mechanism, accelerograms, analysis, period))
    return curves, rows, reasons


def _for_openquake(curves: Mapping[tuple[str, float | None], Fragility], path: Path) -> list[str]:
    """Write the curves, by structure and period of its support, as one model of OpenQuake; or say why it cannot be.

    The file always stands, since a rule declares it: without curves it says why it holds none.
    """
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
            reasons.append(f"{record.id}: {error.without_place(record.id)}")
    return opened, reasons


def _measured(
    opened: Mapping[str, Sequence[Accelerogram]],
    measure: str,
    mechanism: Mechanism,
    net: Callable[..., AbstractContextManager[None]],
) -> tuple[list[str], list[Accelerogram], list[str]]:
    """The components of the records that have the intensity measure, the record of each, and why others are out."""
    of_mechanism = intensity_measure(measure, mechanism)
    names: list[str] = []
    accelerograms: list[Accelerogram] = []
    reasons: list[str] = []
    for record, components in opened.items():
        try:
            with net(f"its {measure}", record=record):
                for component in components:
                    of_mechanism.of(component, mechanism)
                names += [record] * len(components)
                accelerograms += components
        except RockingError as error:
            reasons.append(f"{record}: {error}")
    return names, accelerograms, reasons
