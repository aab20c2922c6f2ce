"""How far the level that overturns scatters by each intensity measure, on sites that took no part in a choice.

The records of the first catalogue are those on which a rule may be chosen; what is stated is of the sites of the second
that the first does not hold. Periods follow from each structure alone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from docs.research import scores, sites
from docs.research.fragilities import ALL_LEVELS, responses_behind
from docs.research.report import Target
from rocking import Accelerogram
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import RecordError
from rocking.fragility.curves import explanation, fragility
from rocking.fragility.measures import IntensityMeasure, compared, intensity_measure
from rocking.structures import Arch, Block, Spire, Structure, Wall

REPLICATES = 100
"""Draws of the sites behind an interval: each fits every measure."""
RESTITUTIONS = (0.5, 0.7, 0.8, 0.9)
"""Of the blocks and façades on which the rule for what loses much was chosen."""
FIRST = "pgv"
"""The measure that the others are held against."""
FIXED = ("AvgSA(0.2,2.0)",)
"""Tried beside the measures that a study compares."""


def structures_tried() -> dict[str, Structure]:
    """Return seven kinds of structure, and others that are one-sided or lose much of their speed at an impact."""
    made: dict[str, Structure] = {
        "parapet": Block.of_size(0.3, 1.2),
        "block of 3 m": Block.of_size(0.75, 3.0),
        "pier": Block.of_size(0.6, 3.0),
        "storey wall": Wall(1.5, 1.5, 0.4),
        "tall wall": Wall(3.0, 3.0, 0.6),
        "arch of 10 m": Arch(10.0, 1.5, np.radians(157.5)),
        "spire": Spire(1.5, 8.0),
        "low block, λ 0.1, η 0.5": Block.of_size(0.2, 2.0, restitution=0.5),
    }
    for restitution in RESTITUTIONS:
        made[f"block of 3 m, η {restitution:g}"] = Block.of_size(0.75, 3.0, restitution=restitution)
        for breadth in (0.6, 1.2):
            made[f"façade, λ {breadth / 6:g}, η {restitution:g}"] = Block.of_size(
                breadth, 6.0, one_sided=True, restitution=restitution
            )
    return made


@dataclass(frozen=True, eq=False)
class Scatter:
    """Outcomes of one structure: levels (r, k) of each measure as logarithms, and whether each overturns (r, k).

    found: scatters that were asked for before.
    """

    logs: dict[str, np.ndarray]
    falls: np.ndarray
    found: dict[tuple[str, bytes], float] = field(default_factory=dict)

    def efficiency(self, name: str, rows: np.ndarray) -> float:
        """Return the standard deviation of the logarithm of the level that overturns the records `rows`."""
        drawn = name, rows.tobytes()
        if drawn not in self.found:
            labels = [f"{place}" for place, _ in enumerate(rows)]
            fit = explanation(
                self.logs[name][rows], self.falls[rows], np.zeros(rows.size), ClusterSample.scattered(labels)
            )
            self.found[drawn] = fit.efficiency
        return self.found[drawn]

    def ratio(self, name: str, rows: np.ndarray) -> float:
        """Return the scatter of a measure over that of FIRST."""
        return self.efficiency(name, rows) / self.efficiency(FIRST, rows)


def measure_scatter(target: Target) -> None:
    """Score every measure by structure: where a rule may be chosen, and on the sites that are left."""
    catalogues = [list(catalogue) for catalogue in target.catalogues]
    names = {identifier for identifier, _ in catalogues[0]}
    every = list(sites.independent(record for records in catalogues for record in records))
    parts = {
        "sites for choices": [record for record in every if record.identifier in names],
        "sites left out": [record for record in every if record.identifier not in names],
    }
    rows: list[scores.Score] = []
    for name, structure in structures_tried().items():
        for part, records in parts.items():
            rows += scatter_scores(f"{name}, {part}", structure, records)
        target.tell(name)
    subtitle = "Scatter: standard deviation of the logarithm of the level that overturns."
    target.publish("What scatters least", subtitle, {scores.Score: rows})


def scatter_scores(
    part: str, structure: Structure, records: Sequence[sites.SiteRecord]
) -> list[scores.Score]:
    """Return the scatter of each measure of one structure, and its ratio to that of FIRST."""
    motions = [record.accelerogram for record in records]
    sample = sites.sample_of([record.site for record in records], [record.earthquake for record in records])
    tried = scatter_of(structure, motions, sample.stations)
    rows: list[scores.Score] = []
    for name in tried.logs:
        measured = {
            "scatter": partial(tried.efficiency, name),
            f"scatter over that of {FIRST}": partial(tried.ratio, name),
        }
        rows += scores.scored(name, part, measured, sample, REPLICATES)
    return rows


def scatter_of(structure: Structure, motions: Sequence[Accelerogram], stations: Sequence[str]) -> Scatter:
    """Return the outcomes of every record at 40 levels of FIRST, and what they are in every measure."""
    curve = fragility(
        motions, structure, intensity_measure=FIRST, stations=stations, contacts=False, **ALL_LEVELS
    )
    analysis = responses_behind(curve)
    mechanism = structure.mechanism()
    factors = np.log(analysis.levels) - np.log(analysis.intensities)[:, None]
    measures = [*compared(mechanism), *map(intensity_measure, FIXED)]
    logs = {
        _kind(measure): np.log(np.array([_figure(measure, motion) for motion in motions])[:, None])
        / measure.power
        + factors
        for measure in measures
    }
    return Scatter(logs, np.isinf(analysis.rotation_ratios).mean(axis=2))


def _kind(measure: IntensityMeasure) -> str:
    """The name of a measure, without periods that differ by structure."""
    return measure.name if measure.name in FIXED else measure.name.partition("(")[0]


def _figure(measure: IntensityMeasure, motion: Accelerogram) -> float:
    """The figure of a motion, also beyond its usable band, so that all measures are held on the same records."""
    try:
        return measure.remembered(motion)
    except RecordError:
        return float("nan")
