"""What holds a structure of a study: one size of it varied under the records of the study, as a table and a figure."""

import math
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import chdir
from pathlib import Path

from rocking.assessment.scene import Scene
from rocking.assessment.store import RecordStore
from rocking.catalogue import load_catalogue
from rocking.codes.check import CodeTerms
from rocking.codes.selection import scaled_pool
from rocking.earthquakes.sample import FEWEST, ClusterSample
from rocking.errors import ConfigurationError
from rocking.quantities import counted, shown
from rocking.records import Accelerogram
from rocking.reports.panels import svg_of
from rocking.reports.style import PICTURE
from rocking.strengthening import Strengthening, size_named, sizes, strengthen_scene
from rocking.structures.fields import Field
from rocking.study.job import Study
from rocking.study.plan import check_config_file, config_file, make_plan
from rocking.study.selection import joined_by_station, opened, pool_of
from rocking.tables import (
    Document,
    Row,
    check_target,
    column,
    document_of,
    row,
    write_rows,
    write_whole,
    written_together,
)

_RANGE = re.compile(r"\s*([^.\s][^\s]*?)\s*\.\.\s*(\S+)\s*")


@row("strengthening")
class StrengtheningRow(Row):
    """One row per value that was tried, below the structure as it is given; written by rocking strengthen."""

    structure: str = column("Name of the structure")
    key: str = column("Key of the list of structures that is varied")
    value: float = column(
        "Value, in the unit at the end of its key; empty where the structure states none",
        unit="that of the key",
    )
    is_given: bool = column("Whether this is the structure as it is given")
    holds: bool = column("Whether this value and all larger ones can be shown to hold")
    overturning_share: float = column(
        "Share that overturns, the mean over the stations; what cannot be told counts as 1"
    )
    share_low: float = column(f"Its lower one-sided bound, by earthquakes: 90 % from {FEWEST} on")
    share_high: float = column("Its upper one-sided bound, likewise")
    target_share: float = column("Share that may overturn")
    stations: int = column(
        "Number of stations under which this value was followed; one that cannot be shown to hold any more is given up"
    )
    earthquakes: int = column("Number of earthquakes of all stations that count")
    still_stations: int = column(
        "Number of further stations at which nothing lifts it with any value, which do not count"
    )
    slides: bool = column(
        "Whether the value is left out because it slides before it lifts and nothing can be shown"
    )
    undecided: int = column("Number of components under which it cannot be told")
    governing: str = column("The crack that overturns most often")
    static_tie: float = column("Least strength of a tie by the linear check of the code", unit="kN/m")


_CASES = Document(
    "store of cases", ".cases", lambda content: re.match(rb"\w+ [0-9a-f]{64}\n", content) is not None
)


def write_strengthening(
    folder: Path,
    structure: str,
    key: str,
    between: str,
    target: float,
    output: Path | None = None,
    show_line: Callable[[str], object] = lambda _line: None,
) -> list[str]:
    """Write table and figure of what holds a structure of the study in `folder`, and return the lines for the terminal.

    What was followed is stored with them, so that another target follows nothing again. structure: its name. key: of
    the list. between: its range, as "2..40". output: folder of both files, by default that of the results. show_line:
    takes what it will cost, before it is spent. At the design level of the study each record of the pool has the factor
    that brings it nearest to the spectrum, and one that no factor within the limits brings there is left out; without a
    level the records of the study act as the catalogue scales them. Raises ConfigurationError before anything is
    followed, and writes nothing.
    """
    target_folder = None if output is None else output.absolute()
    with chdir(folder):
        path = config_file(Path())
        plan = make_plan(check_config_file(path) if path else {})
        study = Study(plan.scenes, plan.settings)
        scene = _scene(study.scenes, structure, plan.settings.structures)
        size, ends = _size(scene, key, between)
        place = target_folder or (Path(plan.settings.results) / "strengthening").absolute()
        name = re.sub(r"[^A-Za-z0-9._-]+", "_", f"{structure}_{size.key}").strip("._-")[:150]
        table = place / f"{name}.csv"
        image = place / f"{name}.svg"
        cases = place / f"{name}.cases"
        if target_folder is not None:
            for file, document in ((table, document_of(StrengtheningRow)), (image, PICTURE), (cases, _CASES)):
                check_target(file, document)
        records, sample, notes = _records(study)
        checks = plan.settings.checks
        store = RecordStore(cases, show_line)
        found = strengthen_scene(
            records,
            scene,
            size,
            ends,
            target,
            sample,
            study.assessment,
            plan.settings.design_spectrum.spectrum(),
            CodeTerms(confidence_factor=checks.confidence_factor, behaviour_factor=checks.behaviour_factor),
            store=store,
            show_line=show_line,
        )
        with written_together():
            write_rows(StrengtheningRow, _rows(structure, found), table)
            write_whole(image, svg_of(found))
            store.save()
    return [*notes, f"{structure}: {found.words}", str(table), str(image)]


def _rows(structure: str, found: Strengthening) -> Iterator[StrengtheningRow]:
    for tried in (found.given, *found.tried):
        is_given = tried is found.given
        share_low, share_high = tried.interval
        yield StrengtheningRow(
            structure=structure,
            key=found.field.key,
            value=float(found.field.outward(tried.value)),
            is_given=is_given,
            holds=found.holds(tried),
            overturning_share=tried.share,
            share_low=share_low,
            share_high=share_high,
            target_share=found.target,
            stations=int(tried.followed.sum()),
            earthquakes=found.sample.earthquakes,
            still_stations=found.still,
            slides=not is_given and tried not in found.decided,
            undecided=tried.undecided,
            governing=tried.governing,
            static_tie=found.static_tie / 1e3,
        )


def _scene(scenes: Mapping[str, Scene], name: str, path: str) -> Scene:
    """The scene of that name. Raises ConfigurationError naming those there are."""
    if name not in scenes:
        raise ConfigurationError(
            f"structure is {shown(name)}, but must be one of those in {path}: {', '.join(scenes)}."
        )
    return scenes[name]


def _size(scene: Scene, key: str, between: str) -> tuple[Field, tuple[float, float]]:
    """The size of that key, and the ends of the range in SI. Raises ConfigurationError."""
    size = size_named(scene.structure, key, {size.key: size for size in sizes(scene.structure)})
    ends = _RANGE.fullmatch(between)
    try:
        low, high = map(float, ends.groups() if ends else ())
    except ValueError:
        raise ConfigurationError(
            f"the range of {key} is {shown(between)}, but must be two numbers with two points between them, as 2..40."
        ) from None
    if not 0 < low < high < math.inf:
        raise ConfigurationError(
            f"the range of {key} is {shown(between)}, but must go from above 0 to a larger value."
        )
    factor = float(size.inward(1.0))  # type: ignore[arg-type]
    return size, (factor * low, factor * high)


def _records(study: Study) -> tuple[list[Accelerogram], ClusterSample, list[str]]:
    """The components at the design level, or as the catalogue scales them; their sample, and what there is to say."""
    checks = study.settings.checks
    spectrum = study.settings.design_spectrum.spectrum()
    each_unnamed = study.settings.unnamed_events == "each"
    catalogue = load_catalogue(study.settings.catalogue if spectrum is None else pool_of(study.settings))
    pool, reasons = opened(study, catalogue)
    notes = [f"{name}: not used, {reason}" for name, reason in reasons.items()]
    if study.settings.vertical:
        notes.append("Vertical components do not act here, though the settings say vertical: true.")
    if spectrum is None:
        of_pool = [(name, component) for name, pair in pool.items() for component in pair]
        records = [component for _, component in of_pool]
        rows = [name for name, _ in of_pool]
        return records, ClusterSample.of(records, rows=rows, each_unnamed=each_unnamed), notes
    limits = (checks.least_factor, checks.largest_factor)
    scaled = scaled_pool(
        joined_by_station(pool), spectrum, (checks.shortest_period, checks.longest_period), limits
    )
    within = [place for place, factor in enumerate(scaled.factors.tolist()) if limits[0] < factor < limits[1]]
    if beyond := len(scaled.names) - len(within):
        notes.append(
            f"{counted(beyond, 'record')} left out, which no factor from {limits[0]:g} to {limits[1]:g} brings to the "
            "design level."
        )
    records = [component for place in within for component in scaled.scaled(place)]
    stations = [scaled.stations[place] for place in within for _ in scaled.pairs[place]]
    return records, ClusterSample.of(records, stations, each_unnamed=each_unnamed), notes
