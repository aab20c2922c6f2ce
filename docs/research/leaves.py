"""Walls whose leaves may part: does what is said to stand fall, leaf by leaf, as stacks of courses?

Walls between supports, fronts with floors and ties, and free walls of two leaves are drawn, half of them with bonders,
half of them thrown back by the leaf beside. Each stands under real motions; what is said to stand is followed leaf by
leaf in courses, with a finer step than `fidelity: contact` takes, each bonder a stop and a tie as stiff. Nothing was
chosen on these walls; that a held wall only probably stands beyond 0.4 φ_cr was read off others, on stations of FEMA
P-695, so that the stations outside of it are a part of their own.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from time import process_time
from typing import Any

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
    sample_of,
    trials_under,
)
from docs.research.stacks import strong_part
from rocking import Facade, LoadedWall, Verdict, Wall, assess
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import StructureWarning
from rocking.structures.building_parts import FreeWall
from rocking.structures.joints import USUAL
from rocking.structures.leaves import Leaved, parts_of
from rocking.tables import column, row

TRIALS = {"wall": 1, "loaded wall": 1, "front": 1, "free wall": 1}
"""Walls drawn under each component."""
UPLIFTS = (0.95, 1.8)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
COURSES = 6
"""In which a leaf is laid that is one body."""


@row("leaves", "One row per wall and component: what the package says, and the stacks of its leaves")
class LeavesTrial(Trial):
    """One trial."""

    catalogue: str = column("The catalogue that the station is of: fema_p695, or another one")
    bonders: int = column("Number of rows of bonders")
    thrown_back: bool = column("Whether leaves are thrown back by each other")
    verdict: Verdict = column("Verdict of the package")
    as_one: Verdict = column("Verdict of the wall taken as one leaf")
    governs: str = column("What governs the verdict")
    farthest: float = column("Largest rotation over critical rotation of its members; INF: one overturns")
    true_falls: int | None = column(
        "True stacks that fall, of the leaf of which most do; empty: not said to stand"
    )
    true_runs: int | None = column("True stacks of each leaf that were followed")
    turn_rad: float = column("Largest turn of a course of a true stack, as far as it was followed, rad")
    verdict_s: float = column("CPU time of the verdict, s")
    as_one_s: float = column("CPU time of the verdict of the wall taken as one leaf, s")


def leaves_of(draw: np.random.Generator, thickness: float, height: float) -> dict[str, Any]:
    """Return the options of a wall of two leaves: half with bonders, half thrown back."""
    outer = thickness * float(draw.uniform(0.25, 0.5))
    options: dict[str, Any] = {"leaves": (outer, thickness - outer)}
    if draw.random() < 0.5:
        options["bonders"] = float(draw.uniform(0.3, 0.6)) * height
    if draw.random() < 0.5:
        options["thrown_back"] = float(draw.uniform(0.3, 0.7))
    return options


def drawn(kind: str, draw: np.random.Generator) -> Leaved:
    """Return a wall of two leaves."""
    thickness = float(draw.uniform(0.35, 0.7))
    if kind == "free wall":
        height = float(draw.uniform(1.0, 3.0))
        return FreeWall.of_size(thickness, height, **leaves_of(draw, thickness, height))
    if kind == "front":
        storeys = int(draw.integers(1, 3))
        heights = tuple(draw.uniform(2.6, 3.8, storeys).tolist())
        top = float(np.sum(heights))
        return Facade(
            heights,
            (thickness,) * storeys,
            UNIT_WEIGHT,
            floor_loads=tuple(draw.uniform(5e3, 20e3, storeys).tolist()),
            restitution=float(draw.uniform(0.3, 0.7)),
            behind="cross_walls" if draw.random() < 0.5 else "floors",
            tie_heights=(top,),
            tie_stiffness=float(np.exp(draw.uniform(*np.log([2e6, 3e7])))),
            **leaves_of(draw, thickness, heights[-1]),
        )
    height = float(draw.uniform(2.6, 4.0))
    options = leaves_of(draw, thickness, height)
    if kind == "wall":
        return Wall.of_size(height, thickness, **options)
    load = UNIT_WEIGHT * height * thickness * float(draw.uniform(0.05, 0.6))
    return LoadedWall.of_size(
        height, thickness, UNIT_WEIGHT, top_load=load, top_friction=USUAL.friction, **options
    )


def leaves(target: Target) -> None:
    """Hold what is said of walls of two leaves against stacks of each leaf."""
    places = [(kind, place) for kind, number in TRIALS.items() for place in range(number)]
    trials = trials_under(independent(target.records), leaves_trial, places, target.tell, _standing)
    subtitle = "Walls of two leaves, with bonders and without, beside stacks of each leaf."
    target.publish(
        "Leaves that part", subtitle, {LeavesTrial: trials, scores.Score: list(leaves_scores(trials))}
    )


def _standing(trials: Sequence[LeavesTrial]) -> str:
    stand = sum(trial.true_runs is not None for trial in trials)
    return f", {stand} stand, {sum(bool(trial.true_falls) for trial in trials)} of these fall"


def leaves_trial(component: SiteRecord, kind: str, place: int) -> LeavesTrial:
    """Return one trial: wall and scale drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, 13, list(TRIALS).index(kind), place)
    settings = AssessmentSettings(fidelity="quick")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StructureWarning)
        wall = drawn(kind, draw)
        multiplier = wall.static_multiplier
        motion = record.scaled(lifting_factor(record, multiplier, UPLIFTS, draw))
        motion = strong_part(motion, multiplier)
        started = process_time()
        together = assess(motion, replace(wall, **wall._as_one_leaf), settings=settings)
        between = process_time()
        station = assess(motion, wall, settings=settings)
        spent = process_time() - between
        counts: list[int] = []
        turns = [0.0]
        if station.verdict is Verdict.STANDS:
            for _, leaf in parts_of(wall)[1:]:
                stack = leaf.stack(COURSES if len(leaf.stack().courses) == 1 else None)
                runs = list(true_runs(replace(stack, friction=min(stack.friction, USUAL.friction)), motion))
                counts.append(sum(falls for falls, _ in runs))
                turns += [turn for _, turn in runs]
    (case,) = station.cases.values()
    return LeavesTrial(
        **component.named,
        structure=kind,
        scale_factor=float(motion.peak_acceleration / record.peak_acceleration),
        catalogue=component.catalogue,
        bonders=len(wall.bonder_heights),
        thrown_back=wall.thrown_back is not None,
        verdict=station.verdict,
        as_one=together.verdict,
        governs=station.crack,
        farthest=case.largest_of_part(None),
        true_falls=max(counts) if counts else None,
        true_runs=8 if counts else None,
        turn_rad=max(turns),
        verdict_s=spent,
        as_one_s=between - started,
    )


def leaves_scores(trials: Sequence[LeavesTrial]) -> Iterator[scores.Score]:
    """Yield the shares of what falls among what is said to stand, by kind, with intervals by earthquake."""
    every = pd.DataFrame(trials)
    for kind, of_kind in [("all", every), *every.groupby("structure", sort=False)]:
        for stations, own in (
            ("all stations", of_kind),
            ("stations outside of FEMA P-695", of_kind[of_kind.catalogue != "fema_p695"]),
        ):
            stands = own.verdict == Verdict.STANDS
            of_one = own.as_one.isin((Verdict.STANDS, Verdict.CANNOT_OVERTURN))
            measures: dict[str, scores.Measured] = {
                'some true stack falls among "stands"': np.where(stands, own.true_falls > 0, np.nan),
                'is said to stand among what "stands" as one leaf': np.where(of_one, stands, np.nan),
                '"stands"': stands.astype(float).to_numpy(),
            }
            yield from scores.scored(str(kind), stations, measures, sample_of(own.site, own.earthquake))
