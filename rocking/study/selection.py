"""The records of a study that represent its design level: the pool, the sets, and a catalogue with their factors."""

import os
from collections.abc import Mapping, Sequence
from contextlib import chdir
from pathlib import Path

from rocking.catalogue import CatalogueRecord, load_catalogue
from rocking.catalogue.catalogue import COLUMNS, catalogue_text, read_rows
from rocking.codes.selection import Selection, select
from rocking.errors import ConfigurationError, RecordError, RockingError
from rocking.progress import bar
from rocking.quantities import four_digits
from rocking.records import Accelerogram
from rocking.reports.panels import svg_of
from rocking.reports.style import PICTURE
from rocking.study.job import Study
from rocking.study.plan import check_config_file, config_file
from rocking.study.settings import Settings, read_settings
from rocking.tables import Document, check_target, write_whole


def pool_of(settings: Settings) -> Path:
    """Return the catalogue from which the sets of a study are drawn."""
    return Path(settings.checks.pool or settings.catalogue)


def select_for(study: Study, records: tuple[CatalogueRecord, ...]) -> tuple[Selection, dict[str, str]]:
    """Return sets of `records` for the design level of `study`, and by record why it could not be used.

    They are processed as the study says; a record that cannot be read costs no other. Two rows of a catalogue that hold
    a component each of one station in one earthquake are one pair, by both names (`rows_of_pair`).
    Raises ConfigurationError where there is no design level, or no set meets the limits.
    """
    spectrum = study.settings.design_spectrum.spectrum()
    if spectrum is None:
        raise ConfigurationError(
            "setting design_spectrum.ag_g is null, and so is points, but records are selected for a design level; give "
            "one."
        )
    checks = study.settings.checks
    pool, reasons = opened(study, records)
    selection = select(
        joined_by_station(pool),
        spectrum,
        checks.stations,
        periods=(checks.shortest_period, checks.longest_period),
        factors=(checks.least_factor, checks.largest_factor),
        seed=checks.seed,
        each_unnamed=study.settings.unnamed_events == "each",
    )
    return selection, reasons


def opened(
    study: Study, records: Sequence[CatalogueRecord]
) -> tuple[dict[str, list[Accelerogram]], dict[str, str]]:
    """Return the horizontal components of `records`, processed as the study says, and why some could not be used.

    Both by the name of the record. Raises RecordError where none could be read.
    """
    pool: dict[str, list[Accelerogram]] = {}
    reasons: dict[str, str] = {}
    for record in bar(records, "record"):
        try:
            pool[record.id] = study.open(record)[0]
        except RockingError as error:
            reasons[record.id] = str(error)
    if records and not pool:
        raise RecordError(
            f"none of {len(records)} records could be read; the first: {next(iter(reasons.values()))}"
        )
    return pool, reasons


_BETWEEN = " + "
"""Between the two rows of a catalogue of which a pair was joined; no identifier of a record holds it."""


def rows_of_pair(name: str) -> list[str]:
    """Return the rows of the catalogue that a name of the pool means: one, or those of two components."""
    return name.split(_BETWEEN)


def joined_by_station(pool: Mapping[str, Sequence[Accelerogram]]) -> dict[str, list[Accelerogram]]:
    """Return the records, of which two with one component each of the same station and earthquake are one.

    What does not name its station and its earthquake, and what is not two unlike components, stays as it is.
    """
    alone: dict[tuple[str, str, str], list[str]] = {}
    for name, components in pool.items():
        first = components[0]
        if len(components) == 1 and first.station and first.event:
            alone.setdefault((first.network, first.station, first.event), []).append(name)
    other: dict[str, str] = {}
    for names in alone.values():
        directions = {pool[name][0].component for name in names}
        if len(names) == len(directions) == 2:
            other[names[0]] = names[1]
    joined: dict[str, list[Accelerogram]] = {}
    for name, components in pool.items():
        if name in other:
            joined[f"{name}{_BETWEEN}{other[name]}"] = [*components, *pool[other[name]]]
        elif name not in other.values():
            joined[name] = list(components)
    return joined


_CHOSEN = "factor set by rocking select"
"""Ends the note of each row of a selection, by which the file is known as one."""
SELECTION = Document(
    "selection",
    ".csv",
    lambda content: all(_CHOSEN.encode() in line for line in content.splitlines()[1:]) and bool(content),
)


def write_selection(folder: Path, output: Path | None = None) -> list[str]:
    """Select records for the study in `folder`, write them as a catalogue with factors, and return lines to print.

    output: where it goes, in the folder of the pool, whose paths it takes over. A figure of the set against its target
    lies next to it. Raises as `select_for`; ConfigurationError before any work where
    another file exists at either path.
    """
    target = None if output is None else output.absolute()
    with chdir(folder):
        path = config_file(Path())
        settings = read_settings(check_config_file(path) if path else {})
        catalogue = pool_of(settings)
        target = target or catalogue.absolute().with_name("selected.csv")
        if not os.path.samefile(target.parent, catalogue.parent):
            raise ConfigurationError(
                f"--output is {output}, but must lie in {catalogue.parent}, as the paths of the catalogue start there."
            )
        if target.name == catalogue.name:
            raise ConfigurationError(
                f"--output is {output}, but must be another file than the catalogue itself."
            )
        image = target.with_suffix(".svg")
        check_target(target, SELECTION)
        check_target(image, PICTURE)
        selection, reasons = select_for(Study({}, settings), load_catalogue(catalogue))
        write_whole(target, _catalogue_of(selection, catalogue).encode())
        write_whole(image, svg_of(selection))
    lines = [f"{name}: not used, {reason}" for name, reason in reasons.items()]
    factors = selection.factors[selection.chosen]
    lines += [
        f"{name}: factor {four_digits(float(factor))}"
        for name, factor in zip(selection.chosen_names, factors, strict=True)
    ]
    return [*lines, selection.words, str(target), str(image)]


def _catalogue_of(selection: Selection, catalogue: Path) -> str:
    """The rows of the chosen set, each with its factor on top of its own, and a note that says where it comes from."""
    rows = {row["id"].strip(): row for _, row in read_rows(catalogue)}
    chosen = []
    for place in selection.chosen:
        for name in rows_of_pair(selection.names[place]):
            row = rows[name]
            own = float((row.get("scale_factor") or "").strip() or 1)
            factor = repr(float(own * selection.factors[place]))
            note = (row.get("note") or "").removesuffix(_CHOSEN)
            chosen.append(row | {"scale_factor": factor, "note": f"{note.strip()} {_CHOSEN}".strip()})
    columns = [name for name in COLUMNS if name in chosen[0]]
    return catalogue_text(chosen, columns)
