"""Ties whose anchors may get more than the wall around them gives: does what is said to stand fall as they slide out?

Fronts of one or two storeys are drawn, with ties at their floors that stretch, some of which yield, and floors whose
mass the building holds or which ride on the wall. What stands, and of which a tie may get more than the wall around its
anchor gives by friction (its strength, or without one 2.8 times what it needs at rest), is followed as stacks of the
whole wall in which each tie gives that friction alone, until what it grips has slid out by half the thickness. Nothing
was chosen on these walls; that a held wall only probably stands beyond 0.4 φ_cr was read off others, on stations of
FEMA P-695, so that the stations outside of it are a part of their own.

The first campaign, on floors that ride, had no rule on anchors: of 42 walls that stood 13 fell, and none of these with
its ties as described. All 13 are among the 37 in which the wall around an anchor gives less than the bulge asks of the
tie at rest, under motions that reach the load at which it then slides out by limit analysis (`anchors_slide_at`). Such
walls then only probably stood, by statics and not by a threshold that was chosen; now the package follows such stacks.
The rule was found on the first six walls of some of these stations: what is stated of it counts the walls after these,
and no station is new.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.held_walls import UNIT_WEIGHT, true_runs
from docs.research.report import Target
from docs.research.sites import (
    SiteRecord,
    Trial,
    draw_of,
    independent,
    lifting_factor,
    one_of_each,
    sample_of,
    trials_under,
)
from docs.research.stacks import strong_part
from rocking import Facade, Verdict, assess
from rocking.errors import StructureWarning
from rocking.structures.joints import USUAL
from rocking.structures.stack import Stack
from rocking.tables import column, row

WALLS = 14
"""Drawn under each component."""
UPLIFTS = (0.95, 1.8)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
ROCKED = 2e-3
"""Turn of a course beyond which a wall has rocked, rad."""


@row("anchors", "One row per wall and component: what the package says, and stacks whose anchors slide out")
class AnchorTrial(Trial):
    """One trial."""

    catalogue: str = column("The catalogue that the station is of: fema_p695, or another one")
    storeys: int = column("Number of storeys")
    yields: bool = column("Whether its ties have a strength")
    grip: float = column(
        "Least friction around an anchor over what the tie may get; below 1 it may slide out"
    )
    needed: float = column("Largest force of a tie at rest over the friction around its anchor")
    verdict: Verdict = column("Verdict of the package")
    farthest: float = column("Largest rotation over critical rotation of its members; INF: one overturns")
    falls: int | None = column(
        "Stacks that fall whose anchors slide out; empty: not said to stand, or grip 1 or more"
    )
    runs: int | None = column("Stacks that were followed")
    turn_rad: float | None = column("Largest turn of a course of these, rad")
    kept_falls: int | None = column(
        "Stacks that fall with the ties as described; empty: none of the others falls"
    )


def anchored_wall(draw: np.random.Generator) -> Facade:
    """Return a front of one or two storeys with a row or two of ties."""
    storeys = int(draw.integers(1, 3))
    heights = tuple(draw.uniform(2.6, 4.0, storeys).tolist())
    levels = np.cumsum(heights)
    held = sorted({storeys - 1, int(draw.integers(0, storeys))})
    behind: Literal["floors", "cross_walls"] = "cross_walls" if draw.random() < 0.5 else "floors"
    options: dict[str, Any] = {}
    if draw.random() < 0.5:
        options["tie_strength"] = float(np.exp(draw.uniform(*np.log([5e3, 60e3]))))
        options["tie_plastic_elongation"] = float(draw.uniform(0.01, 0.05))
    return Facade(
        heights,
        (float(draw.uniform(0.3, 0.6)),) * storeys,
        UNIT_WEIGHT,
        floor_loads=tuple(np.exp(draw.uniform(np.log(1e3), np.log(20e3), storeys)).tolist()),
        loads_held=bool(draw.random() < 0.7),
        restitution=float(draw.uniform(0.3, 0.7)),
        behind=behind,
        tie_heights=tuple(levels[held].tolist()),
        tie_stiffness=float(np.exp(draw.uniform(*np.log([2e6, 3e7])))),
        held_between="floor",
        **options,
    )


def on_usual_joints(wall: Facade) -> Stack:
    """Return the stack of a wall, in which each tie gives what the wall around its anchor does, and no more."""
    stack = wall.stack()
    return replace(stack, friction=min(stack.friction, USUAL.friction))


def anchors(target: Target) -> None:
    """Hold what is said of walls with light anchors against stacks whose anchors slide out."""
    components = one_of_each(independent(target.records))
    trials = trials_under(
        components, anchor_trial, [(place,) for place in range(WALLS)], target.tell, _followed
    )
    subtitle = "Walls with ties that may get more than the wall around their anchors gives, beside stacks."
    target.publish(
        "What anchors grip", subtitle, {AnchorTrial: trials, scores.Score: list(anchor_scores(trials))}
    )


def _followed(trials: Sequence[AnchorTrial]) -> str:
    followed = [trial for trial in trials if trial.falls is not None]
    return f", {len(followed)} followed, {sum(bool(trial.falls) for trial in followed)} of these fall"


def anchor_trial(component: SiteRecord, place: int) -> AnchorTrial:
    """Return one trial: wall and scale drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, 68, place)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StructureWarning)
        wall = anchored_wall(draw)
        multiplier = wall.static_multiplier
        factor = lifting_factor(record, multiplier, UPLIFTS, draw)
        motion = strong_part(record.scaled(factor), multiplier)
        station = assess(motion, wall)
    (case,) = station.cases.values()
    ties = [restraint for restraint in wall.restraints if restraint.kind == "tie"]
    is_light = any(tie.slides_out for tie in ties)
    runs: list[tuple[bool, float]] = []
    kept: list[tuple[bool, float]] = []
    if is_light and station.verdict is Verdict.STANDS:
        runs = list(true_runs(on_usual_joints(wall), motion))
        if any(falls for falls, _ in runs):
            gripped = replace(wall, anchor_height=wall.height)
            kept = list(true_runs(on_usual_joints(gripped), motion))
    return AnchorTrial(
        **component.named,
        structure="front with light anchors",
        scale_factor=factor,
        catalogue=component.catalogue,
        storeys=len(wall.storey_heights),
        yields=wall.tie_strength is not None,
        grip=min((tie.grip / tie.most for tie in ties), default=np.inf),
        needed=max((tie.needed / tie.grip for tie in ties), default=0.0),
        verdict=station.verdict,
        farthest=case.largest_of_part(None),
        falls=sum(falls for falls, _ in runs) if runs else None,
        runs=len(runs) or None,
        turn_rad=max(turn for _, turn in runs) if runs else None,
        kept_falls=sum(falls for falls, _ in kept) if kept else None,
    )


def anchor_scores(trials: Sequence[AnchorTrial]) -> Iterator[scores.Score]:
    """Yield the shares of what falls among what is said to stand, with intervals by earthquake."""
    every = pd.DataFrame(trials)
    for stations, own in (
        ("all stations", every),
        ("stations outside of FEMA P-695", every[every.catalogue != "fema_p695"]),
    ):
        falls, kept, turn = (own[name].astype(float) for name in ("falls", "kept_falls", "turn_rad"))
        followed = falls.notna().to_numpy()
        less = (own.needed > 1).to_numpy()
        rocks = (turn > ROCKED).to_numpy()
        measures: dict[str, scores.Measured] = {
            'some stack falls among "stands"': np.where(followed, falls > 0, np.nan),
            'some stack falls among "stands" that rock': np.where(followed & rocks, falls > 0, np.nan),
            'some stack falls among "stands" whose anchor is gripped by less than R': np.where(
                followed & less, falls > 0, np.nan
            ),
            'some stack falls with the ties as described, too, among "stands"': np.where(
                followed, kept > 0, np.nan
            ),
        }
        yield from scores.scored("light anchors", stations, measures, sample_of(own.site, own.earthquake))
