"""The fragility of every structure of a study under all of its records."""

from collections.abc import Callable, Iterable
from pathlib import Path

from rocking.assessment.fragility import incremental_dynamic_analysis
from rocking.assessment.fragility.hazard import read_hazard
from rocking.assessment.rows.of_fragility import (
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
from rocking.errors import ConfigurationError, RockingError
from rocking.records import Accelerogram
from rocking.records.catalogue import CatalogueRecord
from rocking.study.run import Study
from rocking.tables import Row, data_package, write_rows, write_whole


def write_fragility(
    records: Iterable[CatalogueRecord],
    study: Study,
    folder: Path,
    tell: Callable[[str], None] = lambda _: None,
) -> list[str]:
    """Write the fragility tables of `study` and their description into `folder`; return what could not be used.

    tell: is told of each structure as it is finished.

    Raises ConfigurationError, before anything is written, where the records that can be read come from fewer than two
    stations, or the hazard curve is none.
    """
    settings = study.settings.fragility_analysis
    hazard = read_hazard(Path(settings.hazard)) if settings.hazard else None
    names, accelerograms, unused = _opened(records, study)
    tables: dict[str, list[Row]] = {name: [] for name in FRAGILITY_TABLES}
    for count, (name, structure) in enumerate(study.structures.items(), start=1):
        found = incremental_dynamic_analysis(
            accelerograms,
            structure,
            intensity_measure=settings.intensity_measure,
            ensemble=study.assessment.ensemble if settings.members else None,
            tolerance=study.assessment.tolerance,
        )
        tables[IdaRow.table.name] += ida_rows(name, names, found)
        for threshold in ROTATION_RATIOS:
            curve = found.fragility(threshold)
            tables[FragilityRow.table.name] += fragility_rows(name, curve)
            tables[FragilitySummaryRow.table.name].append(fragility_summary_row(name, curve, hazard))
        tables[IntensityMeasureRow.table.name] += intensity_measure_rows(
            name, structure.mechanism(), accelerograms, found
        )
        tell(f"{count} of {len(study.structures)}: {name}")
    for name, row_class in FRAGILITY_TABLES.items():
        write_rows(row_class, tables[name], folder / row_class.table.file_name)  # type: ignore[type-var]
    described = {
        name: (row_class.table, row_class.table.file_name) for name, row_class in FRAGILITY_TABLES.items()
    }
    write_whole(folder / "datapackage.json", data_package("rocking-fragility", described))
    return unused


def _opened(
    records: Iterable[CatalogueRecord], study: Study
) -> tuple[list[str], list[Accelerogram], list[str]]:
    names, accelerograms, unused = [], [], []
    for record in records:
        try:
            opened, _ = study.open(record)
        except RockingError as error:
            unused.append(f"{record.id}: {error}")
            continue
        for accelerogram in opened:
            names.append(f"{record.id} {accelerogram.component}".strip())
            accelerograms.append(accelerogram)
    if not accelerograms:
        raise ConfigurationError(
            "no record of the catalogue can be read, but a fragility needs two stations."
        )
    return names, accelerograms, unused
