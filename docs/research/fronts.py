"""Fronts with floors: what becomes of them where they rock freely both ways, and where floors throw them back.

A front that rests against its floors turns outwards alone, and what it loses at each impact nobody has measured. Each
front is followed as it stands by default, free to rock both ways, and one-sided with several restitutions.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from docs.research import scores
from docs.research.report import Tables, Target
from docs.research.sites import SiteRecord, Trial, draw_of, independent, lifting_factor, sample_of
from rocking import Facade, integrate
from rocking.structures import Outcome
from rocking.tables import column, row

FRONTS = 8
"""Under each component."""
UPLIFTS = (1.5, 12.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
RESTITUTIONS = (0.5, 0.7, 0.9)
"""Of the impact on the floors: what tests on leaning walls found, and up to nearly none lost."""
UNIT_WEIGHT = 18e3
"""Of the masonry, N/m³."""


@row(
    "fronts",
    "One row per front and component: falls where it rocks both ways, and where floors throw it back",
)
class FrontTrial(Trial):
    """One trial."""

    is_tied: bool = column("Whether an elastic tie holds the front at a floor")
    falls: bool = column("Whether the front falls that rocks both ways")
    falls_inwards: bool = column("Whether it falls inwards, through its floors")
    falls_half: bool = column("Whether the one-sided front falls, with a restitution of 0.5")
    falls_seven_tenths: bool = column("Whether the one-sided front falls, with a restitution of 0.7")
    falls_nine_tenths: bool = column("Whether the one-sided front falls, with a restitution of 0.9")


def fronts(target: Target) -> None:
    """Write how often one side loses falls of both, and how often it adds some."""
    trials = [
        front_trial(component, place) for component in independent(target.records) for place in range(FRONTS)
    ]
    target.tell(f"{len(trials)} trials")
    count = len({trial.site for trial in trials})
    subtitle = (
        f"{len(trials)} fronts with floors under components of {count} sites, free both ways and one-sided."
    )
    tables: Tables = {scores.Score: list(front_scores(trials)), FrontTrial: trials}
    target.publish("Fronts with floors", subtitle, tables)


def front(draw: np.random.Generator, is_tied: bool) -> Facade:
    """Return a front of two or three storeys with floors that bear on it, cracked where statics says."""
    storeys = int(draw.integers(2, 4))
    heights = tuple(draw.uniform(2.8, 4.0, storeys).tolist())
    thicknesses = tuple(np.linspace(draw.uniform(0.5, 0.8), draw.uniform(0.35, 0.5), storeys).tolist())
    stiffness = float(np.exp(draw.uniform(*np.log([5e3, 5e4]))))
    loads = tuple(draw.uniform(2e3, 15e3, storeys).tolist())
    if not is_tied:
        return Facade(heights, thicknesses, UNIT_WEIGHT, floor_loads=loads)
    return Facade(
        heights,
        thicknesses,
        UNIT_WEIGHT,
        floor_loads=loads,
        tie_heights=(heights[0],),
        tie_stiffness=stiffness,
    )


def front_trial(component: SiteRecord, place: int) -> FrontTrial:
    """Return one trial: every other front is tied, and the sign of the motion is drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, place)
    is_tied = place % 2 == 1
    both = front(draw, is_tied)
    factor = lifting_factor(record, both.mechanism().uplift_multiplier, UPLIFTS, draw)
    factor *= float(draw.choice([-1.0, 1.0]))
    motion = record.scaled(factor)
    free = integrate(both, motion)
    falls = free.outcome is Outcome.OVERTURNS
    half, seven_tenths, nine_tenths = (
        integrate(replace(both, behind="cross_walls", restitution=restitution), motion).outcome
        is Outcome.OVERTURNS
        for restitution in RESTITUTIONS
    )
    return FrontTrial(
        **component.named,
        structure="front with a tie" if is_tied else "front",
        scale_factor=factor,
        is_tied=is_tied,
        falls=falls,
        falls_inwards=falls and free.peak_side < 0,
        falls_half=half,
        falls_seven_tenths=seven_tenths,
        falls_nine_tenths=nine_tenths,
    )


def front_scores(trials: Sequence[FrontTrial]) -> Iterator[scores.Score]:
    """Yield the shares of falls that one side loses, and of fronts that stand both ways and fall on one side."""
    for kind in dict.fromkeys(trial.structure for trial in trials):
        own = [trial for trial in trials if trial.structure == kind]
        falls = np.array([trial.falls for trial in own])
        inwards = np.array([trial.falls_inwards for trial in own])
        of_one_side = zip(
            RESTITUTIONS,
            np.array([[t.falls_half, t.falls_seven_tenths, t.falls_nine_tenths] for t in own]).T,
            strict=True,
        )
        measures: dict[str, scores.Measured] = {
            "falls where it rocks both ways": falls.astype(float),
            "of these, inwards": np.where(falls, inwards, np.nan),
        }
        for restitution, one_side in of_one_side:
            outwards = np.where(falls & ~inwards, ~one_side, np.nan)
            measures |= {
                f"falls on one side, η {restitution:g}": one_side.astype(float),
                f"falls outwards both ways and not on one side, η {restitution:g}": outwards,
                f"stands both ways and falls on one side, η {restitution:g}": np.where(
                    falls, np.nan, one_side
                ),
            }
        sample = sample_of([trial.site for trial in own], [trial.earthquake for trial in own])
        yield from scores.scored(kind, f"{kind}, both ways and one", measures, sample)
