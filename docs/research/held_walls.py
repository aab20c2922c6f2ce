"""Walls that something holds, and light roofs: does what is said to stand fall as a stack of courses?

Walls with ties, floors or cross walls, of one to three storeys, walls under light roofs whose top friction holds, walls
that keep little of an impact, and free ones whose restitution is typed too low are drawn anew. Each stands under real
motions beside a stack of the whole wall with its ties, what stands behind it and its friction, in six courses a storey
and with a finer step than `fidelity: contact` takes. Nothing was chosen on these walls; that a held wall only probably
stands beyond 0.4 φ_cr was read off others, on stations of FEMA P-695, so that the stations outside of it are a part of
their own.

The first campaign drew ties of 2 to 30 MN/m² per metre, roofs of 3 to 30 % of the wall's weight on a friction of 0.4
to 0.7, and stacks on joints of friction 5. Of the walls that stand 5 of 119 fell outside FEMA P-695, 4.2 % (1.1 to
7.2), on 16 stations that took no part in the choice of 0.4 φ_cr, and 1 of 108 within, 10 of 1 816 runs in all. The
rule on ties (a damping of 10 % under the motion that stretching ties let through) was read off them: with 5 and 20 %
40 and 16 of the 149 tied walls only probably stand, with all six that fall, in either half of the sites, and none of
the others falls. The 78 walls with something else behind of that campaign and the 95 of the second one make 0 of 173,
below 1.7 %, which is not independent of the rule.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from time import process_time
from typing import Literal

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.report import Target
from docs.research.sites import (
    SiteRecord,
    Trial,
    draw_of,
    independent,
    lifting_factor,
    sample_of,
    trials_under,
)
from docs.research.stacks import TRUE_STEP, strong_part
from rocking import Accelerogram, Facade, LoadedWall, Verdict, assess
from rocking.assessment.decide import decide
from rocking.contacts.dynamics import follow_stack
from rocking.errors import StructureWarning
from rocking.structures.joints import USUAL, Joints
from rocking.structures.stack import Stack
from rocking.structures.tied import Tied
from rocking.tables import column, row

TRIALS = {
    "tied wall": 4,
    "wall with something behind": 2,
    "light roof": 3,
    "wall that keeps little": 2,
    "typed restitution": 3,
}
"""Walls drawn under each component."""
UPLIFTS = (1.05, 3.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
AMPLITUDES = (0.95, 0.98, 1.02, 1.05)
"""At which the true stack is followed, with either sign."""
UNIT_WEIGHT = 18e3
"""Of the masonry, N/m³."""
LITTLE = 0.3
"""Restitution by balance below which a wall keeps little."""


@row("held_walls", "One row per wall and component: what the package says, and the stacks of the whole wall")
class HeldTrial(Trial):
    """One trial."""

    catalogue: str = column("The catalogue that the station is of: fema_p695, or another one")
    storeys: int = column("Number of storeys")
    slenderness: float = column("Largest free height between what holds it over the thickness")
    friction: float = column("Friction coefficient")
    restitution: float = column("Restitution of the mechanism")
    mechanism: Verdict = column("Verdict by mechanisms alone")
    warnings: str = column("Kinds of doubt, parted by ;")
    verdict: Verdict = column("Verdict of the package, contact dynamics asked where it cannot be told else")
    farthest: float = column("Largest rotation over critical rotation of its members; INF: one overturns")
    stack_falls: int | None = column("Stacks that fall in contact dynamics; empty: not asked")
    stack_runs: int | None = column("Stacks that contact dynamics followed")
    true_falls: int = column("True stacks that fall")
    true_runs: int = column("True stacks that were followed")
    turn_rad: float = column("Largest turn of a course of a true stack, as far as it was followed, rad")
    verdict_s: float = column("CPU time of the verdict, s")


def tied_wall(draw: np.random.Generator) -> LoadedWall | Facade:
    """Of one to three storeys, held by a row or two of ties that stretch and do not break."""
    storeys = int(draw.integers(1, 4))
    heights = tuple(draw.uniform(2.8, 4.2, storeys).tolist())
    levels = np.cumsum(heights)
    held = sorted({storeys - 1, int(draw.integers(0, storeys))})
    behind: Literal["floors", "cross_walls"] = "cross_walls" if draw.random() < 0.5 else "floors"
    return Facade(
        heights,
        (float(draw.uniform(0.3, 0.6)),) * storeys,
        UNIT_WEIGHT,
        floor_loads=tuple(draw.uniform(5e3, 20e3, storeys).tolist()),
        restitution=float(draw.uniform(0.3, 0.7)),
        behind=behind,
        tie_heights=tuple(levels[held].tolist()),
        tie_stiffness=float(np.exp(draw.uniform(*np.log([2e6, 3e7])))),
    )


def backed_wall(draw: np.random.Generator) -> LoadedWall | Facade:
    """Of two or three storeys, with floors or cross walls behind and no tie."""
    storeys = int(draw.integers(2, 4))
    behind: Literal["floors", "cross_walls"] = "cross_walls" if draw.random() < 0.5 else "floors"
    return Facade(
        tuple(draw.uniform(2.8, 4.2, storeys).tolist()),
        tuple(np.linspace(draw.uniform(0.5, 0.8), draw.uniform(0.35, 0.5), storeys).tolist()),
        UNIT_WEIGHT,
        floor_loads=tuple(draw.uniform(5e3, 20e3, storeys).tolist()),
        restitution=float(draw.uniform(0.3, 0.7)),
        behind=behind,
    )


def under_roof(draw: np.random.Generator) -> LoadedWall | Facade:
    """Below a roof of 3 to 30 % of its weight, whose friction of 0.4 to 0.7 holds its top."""
    height, thickness = float(draw.uniform(2.4, 4.0)), float(draw.uniform(0.2, 0.5))
    load = UNIT_WEIGHT * height * thickness * float(np.exp(draw.uniform(*np.log([0.03, 0.3]))))
    friction = float(draw.uniform(0.4, 0.7))
    slab: Literal["hinged", "flat"] = "flat" if draw.random() < 0.5 else "hinged"
    return LoadedWall.of_size(
        height, thickness, UNIT_WEIGHT, top_load=load, top_slab=slab, top_friction=friction
    )


def keeping_little(draw: np.random.Generator) -> LoadedWall | Facade:
    """With a hinge that exists, below a slab, of a restitution by balance below LITTLE."""
    while True:
        height, thickness = float(draw.uniform(2.4, 4.0)), float(draw.uniform(0.2, 0.5))
        hinge = height * float(draw.uniform(0.3, 0.85))
        load = UNIT_WEIGHT * height * thickness * float(np.exp(draw.uniform(*np.log([0.05, 1.5]))))
        wall = LoadedWall.of_size(
            height, thickness, UNIT_WEIGHT, hinge, top_load=load, top_slab="flat", crack="known"
        )
        wall = replace(wall, top_friction=10.0)
        if 0 < wall.mechanism().restitution < LITTLE:
            return wall


def typed_too_low(draw: np.random.Generator) -> LoadedWall | Facade:
    """Of one to three storeys that nothing holds, of a restitution 0.05 to 0.25 below that of the geometry."""
    storeys = int(draw.integers(1, 4))
    heights = tuple(draw.uniform(2.8, 4.2, storeys).tolist())
    thicknesses = (float(draw.uniform(0.3, 0.6)),) * storeys
    loads = tuple(draw.uniform(0, 20e3, storeys).tolist())
    wall = Facade(heights, thicknesses, UNIT_WEIGHT, floor_loads=loads)
    return replace(wall, restitution=wall.mechanism().restitution - float(draw.uniform(0.05, 0.25)))


DRAWN = {
    "tied wall": tied_wall,
    "wall with something behind": backed_wall,
    "light roof": under_roof,
    "wall that keeps little": keeping_little,
    "typed restitution": typed_too_low,
}


def hold(target: Target) -> None:
    """Hold what is said of walls that something holds against stacks of the whole wall."""
    places = [(kind, place) for kind, number in TRIALS.items() for place in range(number)]
    trials = trials_under(independent(target.records), held_trial, places, target.tell)
    subtitle = "Walls with ties, floors or cross walls, and walls under light roofs, beside stacks of the whole wall."
    target.publish("Who holds", subtitle, {HeldTrial: trials, scores.Score: list(held_scores(trials))})


def held_trial(component: SiteRecord, kind: str, place: int) -> HeldTrial:
    """Return one trial: wall and scale drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, 1, list(TRIALS).index(kind), place)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StructureWarning)
        wall = DRAWN[kind](draw)
        multiplier = wall.static_multiplier
        factor = lifting_factor(record, multiplier, UPLIFTS, draw)
        motion = strong_part(record.scaled(factor), multiplier)
        friction = wall.top_friction if isinstance(wall, LoadedWall) else None
        started = process_time()
        station = assess(motion, wall.on_joints(Joints(friction or USUAL.friction)))
        spent = process_time() - started
    (case,) = station.cases.values()
    told = [limit for limit in case.limits if not limit.is_untold]
    stack = wall.stack()
    runs = list(true_runs(replace(stack, friction=min(stack.friction, friction or USUAL.friction)), motion))
    free = [0.0, *sorted(hold.height for hold in wall.held_wall.holds), wall.height]
    return HeldTrial(
        **component.named,
        structure=kind,
        scale_factor=factor,
        catalogue=component.catalogue,
        storeys=len(wall.held_wall.storeys),
        slenderness=float(np.diff(free).max() / thickness_of(wall)),
        friction=friction or np.nan,
        restitution=wall.mechanism().restitution,
        mechanism=decide(replace(case.facts(wall), stacks=None), told).verdict,
        warnings=";".join(str(warning.kind) for warning in station.decision.warnings),
        verdict=station.verdict,
        farthest=case.largest_of_part(None),
        stack_falls=case.contact.falls if case.contact else None,
        stack_runs=case.contact.runs if case.contact else None,
        true_falls=sum(falls for falls, _ in runs),
        true_runs=len(runs),
        turn_rad=max(turn for _, turn in runs),
        verdict_s=spent,
    )


def thickness_of(wall: Tied) -> float:
    """Return the least thickness of a wall, m."""
    return min(storey.right - storey.left for storey in wall.held_wall.storeys)


def true_runs(stack: Stack, motion: Accelerogram) -> Iterator[tuple[bool, float]]:
    """Yield whether the stack falls, and its largest turn [rad], at each of AMPLITUDES with either sign."""
    for amplitude in AMPLITUDES:
        for sign in (1.0, -1.0):
            response = follow_stack(
                stack, motion.scaled(sign * amplitude), min(TRUE_STEP, stack.longest_step)
            )
            yield response.falls, float(response.largest_turns.max())


def held_scores(trials: Sequence[HeldTrial]) -> Iterator[scores.Score]:
    """Yield the shares of what falls among what is said to stand, by kind, with intervals by earthquake."""
    every = pd.DataFrame(trials)
    for kind, of_kind in [("all", every), *every.groupby("structure", sort=False)]:
        for stations, own in (
            ("all stations", of_kind),
            ("stations outside of FEMA P-695", of_kind[of_kind.catalogue != "fema_p695"]),
        ):
            some = own.true_falls > 0
            measures: dict[str, scores.Measured] = {}
            for word in (Verdict.STANDS, Verdict.PROBABLY_STANDS, Verdict.CANNOT_BE_TOLD, Verdict.OVERTURNS):
                said = own.verdict == word
                measures[f'some true stack falls among "{word}"'] = np.where(said, some, np.nan)
                measures[f'most true stacks fall among "{word}"'] = np.where(
                    said, own.true_falls > own.true_runs / 2, np.nan
                )
            by_mechanism = own.mechanism == Verdict.STANDS
            measures['some true stack falls among "stands" by mechanisms'] = np.where(
                by_mechanism, some, np.nan
            )
            yield from scores.scored(str(kind), stations, measures, sample_of(own.site, own.earthquake))
