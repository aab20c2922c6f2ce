"""What holds, chosen on one half of the earthquakes and stated once on the other, beside the least value that seems to.

The stations have no part in any fit of the package; each is scaled to one design spectrum. One half is drawn, once; the
400 further halves show the spread alone, as they share their stations.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from docs.research.report import Target
from docs.research.scores import Score, scored
from docs.research.sites import independent
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.selection import scaled_pool
from rocking.earthquakes.sample import ClusterSample
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.strengthening import Strengthening, Tried, strengthen
from rocking.structures import Block, Facade, Structure, Wall

LEVEL = 0.26
"""a_g of the design level on rock [g], by NTC 2018 with F0 = 2.5 and T_C* = 0.45 s."""
TARGETS = (0.1, 0.2, 0.3)
HALVES = 400
"""Drawn for the spread."""
_FRONT = Facade(
    (6.0,),
    (0.5,),
    unit_weight=18e3,
    restitution=0.8,
    behind="cross_walls",
    tie_heights=(5.8,),
    tie_stiffness=5e6,
    tie_strength=5e3,
)
TRIED: Mapping[str, tuple[Structure, str, tuple[float, float]]] = {
    "parapet of 1.5 m, breadth": (Block.of_size(breadth=0.2, height=1.5), "breadth", (0.1, 0.8)),
    "wall of 3.2 m, thickness": (Wall.of_size(3.2, 0.2), "thickness", (0.06, 0.4)),
    "chimney of 4 m, breadth": (Block.of_size(breadth=0.6, height=4.0), "breadth", (0.4, 2.5)),
    "pier of 3 m, breadth": (Block.of_size(breadth=0.4, height=3.0), "breadth", (0.25, 1.6)),
    "front of 6 m, brittle tie": (_FRONT, "tie_strength", (1e3, 6e4)),
    "front of 6 m, tie that yields by 20 mm": (
        replace(_FRONT, tie_plastic_elongation=0.02),
        "tie_strength",
        (1e3, 6e4),
    ),
}


def halves(target: Target) -> None:
    """Score what each rule chooses on one half of the stations by the shares of the other."""
    pool: dict[str, list[Accelerogram]] = {}
    for record in independent(target.records):
        pool.setdefault(record.site, []).append(record.accelerogram)
    scaled = scaled_pool(
        pool, DesignSpectrum.ntc(ag=LEVEL * GRAVITY, f0=2.5, tc_star=0.45), (0.15, 2.0), (0.1, 10.0)
    )
    places = range(len(scaled.names))
    records = [accelerogram for place in places for accelerogram in scaled.scaled(place)]
    stations = [scaled.names[place] for place in places for _ in scaled.pairs[place]]
    rows: list[Score] = []
    for name, (structure, key, between) in TRIED.items():
        found = strengthen(records, structure, key, between=between, stations=stations, early=False)
        rows += scores_of_halves(name, found)
        target.tell(f"{name}: {found.words}")
    subtitle = f"{len(pool)} stations, scaled to a spectrum of a_g = {LEVEL:g} g; the half that chooses is drawn once."
    target.publish("What holds on stations that were not asked", subtitle, {Score: rows})


def scores_of_halves(name: str, found: Strengthening) -> Iterator[Score]:
    """Yield for each target and rule the value chosen, the share of the other half, and of further halves those right.

    A half that chooses nothing is right, and has neither value nor share.
    """
    rng = np.random.default_rng(55)
    once, *further = (split(found.sample, rng) for _ in range(1 + HALVES))
    for limit in TARGETS:
        for rule, choose in (("shown", shown), ("seems", seems)):
            part = f"{rule} to hold, target {limit:g}"
            here, elsewhere = once
            chosen = choose(found, here, limit)
            if chosen is not None:
                share = {"share of the other half": chosen.shares[elsewhere]}
                yield from scored(name, part, share, found.sample.part(elsewhere))
                yield _told(name, part, "value chosen (SI)", chosen.value, found.sample.part(here))
            right = []
            for own, other in further:
                again = choose(found, own, limit)
                if again is not None:
                    right.append(float(again.shares[other].mean()) <= limit)
            if right:
                measure = f"of {len(right)} further halves that choose, those that hold"
                yield _told(name, part, measure, float(np.mean(right)), found.sample)


def split(sample: ClusterSample, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return the places of the stations of one half of the earthquakes, and those of the other."""
    chosen = rng.permutation(sample.earthquakes)[: sample.earthquakes // 2]
    here = np.isin(sample.of_station, chosen)
    return np.flatnonzero(here), np.flatnonzero(~here)


def shown(found: Strengthening, stations: np.ndarray, limit: float) -> Tried | None:
    """Return what the rule of the package chooses on some of the stations, by their places."""
    sample = found.sample.part(stations)
    tried = tuple(
        replace(
            trial,
            shares=trial.shares[stations],
            sample=sample,
            slid=None if trial.slid is None else trial.slid[stations],
        )
        for trial in found.tried
    )
    value = replace(found, target=limit, sample=sample, tried=tried).value
    return next((trial for trial in found.tried if trial.value == value), None)


def seems(found: Strengthening, stations: np.ndarray, limit: float) -> Tried | None:
    """Return the least value at which the share of some of the stations is below the target."""
    return next((trial for trial in found.tried if trial.shares[stations].mean() < limit), None)


def _told(name: str, part: str, measure: str, value: float, sample: ClusterSample) -> Score:
    """A number without an interval: halves share their stations, and are no independent trials."""
    return Score(
        subject=name,
        part=part,
        measure=measure,
        value=value,
        value_low=math.nan,
        value_high=math.nan,
        sites=sample.count,
        earthquakes=sample.earthquakes,
        cases=sample.count,
    )
