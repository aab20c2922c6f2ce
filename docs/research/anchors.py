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

Ties at a spacing are a part of their own: what an anchor grips along the wall (`anchor_width`) is compared there with
what the tie holds over its spacing. All that stand or probably stand are followed there, with `fidelity: contact`, as
stacks of other courses than those of the verdict. The figure `anchors_spaced` is of stations that took part in no
choice and are in no catalogue of the repository: sample files of the formats that are read, often weak motions, whose
factors go from 0.6 to 14 000 (below 20 for 50 of the 94 fronts).
"""

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
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
from rocking.assessment.evidence.walls import held_all_along
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import StructureWarning
from rocking.quantities import GRAVITY
from rocking.structures.joints import USUAL
from rocking.structures.stack import Stack
from rocking.tables import column, row

WALLS = 14
"""Drawn under each component."""
UPLIFTS = (0.95, 1.8)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
SPACINGS = (1.0, 2.0, 3.0)
"""Distances between the ties of a row, m."""
ANCHORS: Mapping[str, dict[str, Any]] = {
    "anchors of 1 m": {"anchor_width": 1.0},
    "anchors of one unit": {"unit_length": 0.4, "held_between": None},
    "anchors of 0.2 m": {"anchor_width": 0.2},
}
"""What an anchor grips along the wall: much, what it is taken to where nothing is stated, and a plate alone."""
LIFTING = (1.2, 2.0)
"""Range of the peak acceleration of walls with ties at a spacing."""
SPACED_WALLS = 3
"""Drawn of each spacing and anchor under each component."""
TRUE_COURSES = 8
"""Courses a storey of the stacks of these, where those of the verdict have 6."""
ROCKED = 2e-3
"""Turn of a course beyond which a wall has rocked, rad."""


@row("anchors", "One row per wall and component: what the package says, and stacks whose anchors slide out")
class AnchorTrial(Trial):
    """One trial."""

    catalogue: str = column("The catalogue that the station is of: fema_p695, or another one")
    spacing_m: float | None = column(
        "Distance between the ties of a row; empty: they hold the wall all along", unit="m"
    )
    slides: bool = column("Whether the motion reaches the load at which an anchor slides out")
    storeys: int = column("Number of storeys")
    yields: bool = column("Whether its ties have a strength")
    grip: float = column(
        "Least friction around an anchor over what the tie may get; below 1 it may slide out"
    )
    needed: float = column("Largest force of a tie at rest over the friction around its anchor")
    verdict: Verdict = column("Verdict of the package")
    stack_runs: int | None = column("Stacks of the verdict that contact dynamics followed; empty: not asked")
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


def on_usual_joints(wall: Facade, courses: int | None = None) -> Stack:
    """Return the stack of a wall, in which each tie gives what the wall around its anchor does, and no more."""
    stack = wall.stack(courses)
    return replace(stack, friction=min(stack.friction, USUAL.friction))


def anchors(target: Target) -> None:
    """Hold what is said of walls with light anchors against stacks whose anchors slide out."""
    components = one_of_each(independent(target.records))
    kinds = list(product(SPACINGS, ANCHORS))
    spaced = [
        (1000 + 100 * wall + number, *kind)
        for wall in range(SPACED_WALLS)
        for number, kind in enumerate(kinds)
    ]
    places = [*((place,) for place in range(WALLS)), *spaced]
    trials = trials_under(components, anchor_trial, places, target.tell, _followed)
    subtitle = "Walls with ties that may get more than the wall around their anchors gives, beside stacks."
    target.publish(
        "What anchors grip", subtitle, {AnchorTrial: trials, scores.Score: list(anchor_scores(trials))}
    )


def _followed(trials: Sequence[AnchorTrial]) -> str:
    followed = [trial for trial in trials if trial.falls is not None]
    return f", {len(followed)} followed, {sum(bool(trial.falls) for trial in followed)} of these fall"


def anchor_trial(
    component: SiteRecord, place: int, spacing: float | None = None, anchor: str = "all along"
) -> AnchorTrial:
    """Return one trial: wall and scale drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, 68, place)
    settings = AssessmentSettings(fidelity="standard" if spacing is None else "contact")
    uplifts = UPLIFTS if spacing is None else LIFTING
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StructureWarning)
        wall = anchored_wall(draw)
        if spacing is not None:
            wall = replace(wall, tie_spacing=spacing, **ANCHORS[anchor])
        multiplier = wall.static_multiplier
        factor = lifting_factor(record, multiplier, uplifts, draw)
        motion = strong_part(record.scaled(factor), multiplier)
        station = assess(motion, wall, settings=settings)
    (case,) = station.cases.values()
    ties = [restraint for restraint in wall.restraints if restraint.kind == "tie"]
    is_light = any(tie.slides_out for tie in ties)
    runs: list[tuple[bool, float]] = []
    kept: list[tuple[bool, float]] = []
    said = {Verdict.STANDS} if spacing is None else {Verdict.STANDS, Verdict.PROBABLY_STANDS}
    if (is_light or spacing is not None) and station.verdict in said:
        courses = None if spacing is None else TRUE_COURSES * len(wall.storey_heights)
        plane = held_all_along(wall)
        assert isinstance(plane, Facade)
        runs = list(true_runs(on_usual_joints(plane, courses), motion))
        if any(falls for falls, _ in runs):
            gripped = replace(plane, anchor_height=wall.height, anchor_width=None, held_between="floor")
            kept = list(true_runs(on_usual_joints(gripped, courses), motion))
    return AnchorTrial(
        **component.named,
        structure="front with light anchors" if spacing is None else f"front with {anchor}",
        scale_factor=factor,
        catalogue=component.catalogue,
        spacing_m=spacing,
        slides=motion.peak_acceleration > wall.anchors_slide_at * GRAVITY,
        storeys=len(wall.storey_heights),
        yields=wall.tie_strength is not None,
        grip=min((tie.grip / tie.most for tie in ties), default=np.inf),
        needed=max((tie.needed / tie.grip for tie in ties), default=0.0),
        verdict=station.verdict,
        stack_runs=case.contact.runs if case.contact else None,
        farthest=case.largest_of_part(None),
        falls=sum(falls for falls, _ in runs) if runs else None,
        runs=len(runs) or None,
        turn_rad=max(turn for _, turn in runs) if runs else None,
        kept_falls=sum(falls for falls, _ in kept) if kept else None,
    )


def anchor_scores(trials: Sequence[AnchorTrial]) -> Iterator[scores.Score]:
    """Yield the shares of what falls among what is said to stand, with intervals by earthquake."""
    every = pd.DataFrame(trials)
    spaced = every[every.spacing_m.notna()]
    subjects = {"light anchors": every[every.spacing_m.isna()], "ties at a spacing": spaced}
    subjects |= {f"ties every {spacing:g} m": own for spacing, own in spaced.groupby("spacing_m")}
    subjects |= {str(kind): own for kind, own in spaced.groupby("structure")}
    for subject, of_subject in subjects.items():
        for stations, own in (
            ("all stations", of_subject),
            ("stations outside of FEMA P-695", of_subject[of_subject.catalogue != "fema_p695"]),
        ):
            measures = _measures(own) if subject == "light anchors" else _measures_at_a_spacing(own)
            if len(own):
                yield from scores.scored(subject, stations, measures, sample_of(own.site, own.earthquake))


def _measures(own: pd.DataFrame) -> dict[str, scores.Measured]:
    falls, kept, turn = (own[name].astype(float) for name in ("falls", "kept_falls", "turn_rad"))
    followed = falls.notna().to_numpy()
    less = (own.needed > 1).to_numpy()
    rocks = (turn > ROCKED).to_numpy()
    return {
        'some stack falls among "stands"': np.where(followed, falls > 0, np.nan),
        'some stack falls among "stands" that rock': np.where(followed & rocks, falls > 0, np.nan),
        'some stack falls among "stands" whose anchor is gripped by less than R': np.where(
            followed & less, falls > 0, np.nan
        ),
        'some stack falls with the ties as described, too, among "stands"': np.where(
            followed, kept > 0, np.nan
        ),
    }


def _measures_at_a_spacing(own: pd.DataFrame) -> dict[str, scores.Measured]:
    falls = own.falls.astype(float).to_numpy()
    rocks = (own.turn_rad.astype(float) > ROCKED).to_numpy()
    slides = own.slides.to_numpy(dtype=bool)
    measures: dict[str, scores.Measured] = {}
    for said in (Verdict.STANDS, Verdict.PROBABLY_STANDS):
        rocked = (own.verdict == said).to_numpy() & rocks
        measures[f'some stack falls among "{said}" that rock'] = np.where(rocked, falls > 0, np.nan)
        measures[f'most stacks fall among "{said}" that rock'] = np.where(
            rocked, falls > own.runs.astype(float) / 2, np.nan
        )
        measures[f'some stack falls among "{said}" that rock, an anchor sliding'] = np.where(
            rocked & slides, falls > 0, np.nan
        )
    return measures
