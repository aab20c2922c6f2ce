"""The fragility of every structure of a study under all of its records."""

from collections.abc import Callable, Iterable
from pathlib import Path

from rocking.assessment.fragility import incremental_dynamic_analysis
from rocking.assessment.fragility.hazard import read_hazard
from rocking.assessment.fragility.rows import (
    FRAGILITY_TABLES,
    ROTATION_RATIOS,
    FragilityRow,
    FragilitySummaryRow,
    IdaRow,
    IntensityMeasureRow,
    fragility_rows,
    fragility_summary_row,
    ida_rows,
    intensity_measure_rows,
)
from rocking.assessment.intensity import IntensityMeasure, intensity_measure
from rocking.errors import ConfigurationError, RockingError
from rocking.records import Accelerogram
from rocking.records.catalogue import CatalogueRecord
from rocking.study.job import Study
from rocking.tables import Row, write_tables


def write_fragility(
    records: Iterable[CatalogueRecord],
    study: Study,
    folder: Path,
    tell: Callable[[str], None] = lambda _: None,
) -> list[str]:
    """Write the fragility tables of `study` and their description into `folder`; return what could not be used.

    A record that cannot be read, or lacks the intensity measure, costs no other. tell: is told of each structure as it
    is finished.

    Raises ConfigurationError, before anything is written, where the records that are left come from fewer than two
    stations, or the hazard curve is none.
    """
    settings = study.settings.fragility
    hazard = read_hazard(Path(settings.hazard)) if settings.hazard else None
    measure = intensity_measure(settings.intensity_measure)
    names, accelerograms, unused = _opened(records, study, measure)
    tables: dict[type[Row], list[Row]] = {each: [] for each in FRAGILITY_TABLES.values()}
    for count, (name, structure) in enumerate(study.structures.items(), start=1):
        analysis = incremental_dynamic_analysis(
            accelerograms,
            structure,
            intensity_measure=settings.intensity_measure,
            ensemble=study.assessment.ensemble if settings.members else None,
            tolerance=study.assessment.tolerance,
        )
        tables[IdaRow] += ida_rows(name, names, analysis)
        for threshold in ROTATION_RATIOS:
            curve = analysis.fragility(threshold)
            tables[FragilityRow] += fragility_rows(name, curve)
            tables[FragilitySummaryRow].append(fragility_summary_row(name, curve, hazard))
        tables[IntensityMeasureRow] += intensity_measure_rows(
            name, structure.mechanism(), accelerograms, analysis
        )
        tell(f"{count} of {len(study.structures)}: {name}")
    write_tables(tables, folder, "rocking-fragility")
    return unused


def _opened(
    records: Iterable[CatalogueRecord], study: Study, measure: IntensityMeasure
) -> tuple[list[str], list[Accelerogram], list[str]]:
    """Names and records that can be used, and a sentence for each that cannot."""
    mechanism = next(iter(study.structures.values())).mechanism()
    names, accelerograms, unused = [], [], []
    for record in records:
        try:
            opened, _ = study.open(record)
            for accelerogram in opened:
                measure.of(accelerogram, mechanism)
        except RockingError as error:
            unused.append(f"{record.id}: {error}")
            continue
        names += [f"{record.id} {accelerogram.component}".strip() for accelerogram in opened]
        accelerograms += opened
    if not accelerograms:
        raise ConfigurationError(
            "no record of the catalogue can be used, but a fragility needs two stations; the log says why."
        )
    return names, accelerograms, unused
