"""The results over all records of a study: tables, report, figure and page, from its jobs; and their fragility."""

import json
import platform
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.assessment.cracks import cracks
from rocking.assessment.rows import (
    AGREEMENT_COLUMNS,
    RECORD_TABLES,
    SUMMARY_TABLES,
    AgreementRow,
    CapacityRow,
    ComparisonRow,
    StructureRow,
    TimingRow,
    agreement_rows,
    capacity_rows,
    structure_rows,
)
from rocking.errors import ConfigurationError, RockingError
from rocking.records import Accelerogram, CatalogueRecord
from rocking.structures import Mechanism, Structure
from rocking.study.job import Study
from rocking.study.plan import structure_hashes
from rocking.study.results import (
    PROVENANCE,
    SPECTRA,
    page_contents,
    part,
    remove_other_cases,
    remove_other_parts,
    table_lines,
)
from rocking.study.seal import SEAL
from rocking.study.terminal import log_error
from rocking.tables import Row, data_package, frame, write_tables, write_whole
from rocking.tables.workbook import workbook

if TYPE_CHECKING:
    from rocking.fragility.measures import IntensityMeasure

WORKBOOK = "study.xlsx"
"""The tables of the summary in one file, but for the times, which differ from run to run."""
_GOVERNING = (
    "structure",
    "support_period_s",
    "record",
    "level",
    "overturning_share",
    "governing_overturning_share",
)
_SHOWN = (
    "record",
    "pulses",
    "comparison",
    "verdicts",
    "supports",
    "structures",
    "agreement",
    "failures",
)
_LIBRARIES = ("rocking", "obspy", "numpy", "scipy", "pandas", "matplotlib", "numba", "snakemake", "typst")


def summarise(study: Study, records: Iterable[CatalogueRecord], jobs: Sequence[str], params: Any) -> None:
    """Write everything that stands over all records, in their order, into the folder of the results.

    params: what `Plan.params` planned; its hashes name the settings and the package.
    """
    results = Path(study.settings.results)
    target = results / "summary"
    parts = [part(results, job) for job in jobs]
    hashes = {record.id: record.sha256 for record in records}
    write_summary(parts, list(hashes), study.structures, target)
    # Two descriptions of every column, because a data package may not name files outside its own folder.
    of_summary = {each: each.table.file_name for each in SUMMARY_TABLES}
    folders = [each.relative_to(results).as_posix() for each in parts]
    of_jobs = {each: [f"{folder}/{each.table.file_name}" for folder in folders] for each in RECORD_TABLES}
    write_whole(target / "datapackage.json", data_package("rocking-study-summary", of_summary))
    write_whole(results / "datapackage.json", data_package("rocking-study", of_jobs))
    versions = {"python": platform.python_version()}
    for library in _LIBRARIES:
        with suppress(PackageNotFoundError):
            versions[library] = version(library)
    provenance = {
        "versions": versions,
        "settings": study.settings.mapping(),
        "hashes": {"settings": params.settings_sha256, "package": params.package_sha256},
        "structures": structure_hashes(study.scenes),
        "records": hashes,
    }
    text = json.dumps(provenance, indent=1, sort_keys=True, default=str)
    write_whole(target / PROVENANCE, (text + "\n").encode())
    if study.settings.reports:
        from rocking.reports.explore import explore_page  # matplotlib takes half a second to import

        contents = page_contents(parts, hashes)
        spectra = [each for content in contents for each in content.pop(SPECTRA, {}).values()]
        _report(target, study, results / "fragility", spectra)
        page = explore_page(contents, study.structures, study.settings.study or "")
        write_whole(target / "study.html", page)
        paths = {each: target / each.table.file_name for each in SUMMARY_TABLES if each is not TimingRow}
        write_whole(target / WORKBOOK, workbook(paths, study.settings.study or ""))
    remove_other_parts(results, jobs)
    remove_other_cases(results, hashes)


def write_summary(
    parts: Sequence[Path], records: Sequence[str], structures: Mapping[str, Structure], target: Path
) -> None:
    """Write the tables of the summary into `target`: of `records`, in their order, from their jobs in `parts`."""
    for each in SUMMARY_TABLES:
        if each in RECORD_TABLES:
            write_whole(target / each.table.file_name, table_lines(each, parts, records))
    cases = frame(ComparisonRow, target / ComparisonRow.table.file_name, AGREEMENT_COLUMNS)
    tables: dict[type[Row], Iterable[Row]] = {
        StructureRow: structure_rows(structures),
        CapacityRow: capacity_rows(structures),
        AgreementRow: agreement_rows(cases),
    }
    write_tables(tables, target)


def _report(folder: Path, study: Study, fragility: Path, spectra: Sequence[Sequence[float]]) -> None:
    """Write summary.pdf and its figure beside the summary tables in `folder`, with fragility and trade if measured.

    spectra: of the components, where there is a design level.
    """
    from rocking.reports.style import svg  # as above
    from rocking.reports.summary import prediction_scatter, summary_report
    from rocking.reports.trade import trade_picture

    tables = {
        each.table.name: frame(each, folder / each.table.file_name)
        for each in SUMMARY_TABLES
        if each.table.name in _SHOWN
    }
    if (fragility / SEAL).exists():  # which a table that was cut or edited has lost
        from rocking.fragility.rows import FragilitySummaryRow, IdaRow  # a quarter of a second

        tables["fragility_summary"] = frame(FragilitySummaryRow, fragility / "fragility_summary.csv")
        tables["ida"] = frame(IdaRow, fragility / "ida.csv", _GOVERNING)
    trade = trade_picture(folder) if study.settings.trade.in_summary else []
    level = study.settings.design_spectrum.spectrum()
    design = (level, spectra) if level is not None and spectra else None
    write_whole(folder / "summary.pdf", summary_report(tables, study.settings.mapping(), trade, design))
    scatter = svg(prediction_scatter(tables["comparison"])).encode()
    write_whole(folder / "prediction_against_integration.svg", scatter)


# Whole on purpose: one loop fills the tables, of which a structure costs no other.
def write_fragility(
    records: Iterable[CatalogueRecord],
    study: Study,
    folder: Path,
    tell: Callable[[str], None] = lambda _: None,
) -> list[str]:
    """Write the fragility tables of `study` and their description into `folder`; return what could not be used.

    A record that cannot be read, or lacks the intensity measure, costs no other. tell: takes a line for each structure.
    Raises ConfigurationError, before anything is written, where the records that are left come from fewer than two
    stations, the hazard curve is none, or no structure can overturn; one that cannot is left out, and said.
    """
    # A quarter of a second that a summary has no need of.
    from rocking.fragility import rows
    from rocking.fragility.curves import fragility
    from rocking.fragility.measures import intensity_measure

    settings = study.settings.fragility
    hazard = rows.read_hazard(Path(settings.hazard)) if settings.hazard else None
    measure = intensity_measure(settings.intensity_measure)
    if all(cracks(each.structure)[0].mechanism.never_lets_go for each in study.scenes.values()):
        raise ConfigurationError(
            "no structure of the list can overturn, so that none has a fragility; give ties a tie_strength at which "
            "they let go, or leave the fragility out."
        )
    mechanism = next(iter(study.structures.values())).mechanism()
    names, accelerograms, reasons = _usable(records, study, measure, mechanism)
    tables: dict[type[Row], list[Row]] = {each: [] for each in rows.FRAGILITY_TABLES.values()}
    for count, (name, scene) in enumerate(study.scenes.items(), start=1):
        structure = scene.structure
        mechanism = structure.mechanism()
        if never := cracks(structure)[0].mechanism.never_lets_go:
            reasons.append(f"{name}: it cannot overturn, and has no fragility: it {never}.")
            continue
        for support in scene.place.axis:
            period = scene.place.period_of(support)
            analysis = fragility(
                accelerograms,
                structure,
                intensity_measure=settings.intensity_measure,
                largest_factor=settings.largest_factor,
                ensemble=study.assessment.ensemble if settings.members else None,
                tolerance=study.assessment.tolerance,
                support=support,
            ).analysis
            assert analysis is not None
            tables[rows.IdaRow] += rows.ida_rows(name, names, analysis, period)
            for threshold in rows.ROTATION_RATIOS:
                for governing in (True, False) if analysis.governing_ratios is not None else (False,):
                    curve = analysis.fragility(threshold, governing=governing)
                    summarised = rows.SummarisedCurve(name, curve, governing, hazard, support_period=period)
                    tables[rows.FragilityRow] += rows.fragility_rows(name, curve, governing, period)
                    tables[rows.FragilitySummaryRow].append(rows.FragilitySummaryRow.of(summarised))
            try:
                of_measures = rows.intensity_measure_rows(name, mechanism, accelerograms, analysis, period)
                tables[rows.IntensityMeasureRow] += list(of_measures)
            except (
                Exception
            ) as error:  # the curves are finished, and no table beside them may take them along
                log_error(error)
                reasons.append(
                    f"{name}: {rows.IntensityMeasureRow.table.file_name} has no row of it, because of a fault of "
                    f"rocking ({type(error).__name__}: {error}); the log holds its traceback; please report it."
                )
        tell(f"{count} of {len(study.scenes)}: {name}")
    write_tables(tables, folder, "rocking-fragility")
    return reasons


def _usable(
    records: Iterable[CatalogueRecord], study: Study, measure: "IntensityMeasure", mechanism: Mechanism
) -> tuple[list[str], list[Accelerogram], list[str]]:
    """The components that can be read and have the intensity measure, with their names; and why others are left out.

    Raises ConfigurationError where none is left.
    """
    names: list[str] = []
    accelerograms: list[Accelerogram] = []
    reasons: list[str] = []
    for record in records:
        try:
            components, _ = study.open(record)
            for accelerogram in components:
                measure.of(accelerogram, mechanism)
        except RockingError as error:
            reasons.append(f"{record.id}: {error}")
            continue
        names += [f"{record.id} {accelerogram.component}".strip() for accelerogram in components]
        accelerograms += components
    if not accelerograms:
        raise ConfigurationError(
            "no record of the catalogue can be used, but a fragility needs two stations; the log says why."
        )
    return names, accelerograms, reasons
