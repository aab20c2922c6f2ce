"""Walls with ties at a spacing: does what is said to stand fall between its ties, unit by unit in three dimensions?

Walls of one storey with a row of ties farther apart than three lengths of a unit are drawn, with floors or cross walls
behind, under a floor that rides on them or that the building holds. Each stands under real motions, scaled to 1.3 to 4
times what lifts it. What is said to stand is followed as a wall of two bays in running bond, which ends free half a
spacing beyond its ties, and the first of each component as one of a bay that ends at ties and can spread there. Nothing
was chosen on these walls; that a held wall only probably stands beyond 0.4 φ_cr was read off others, on stations of
FEMA P-695, so that the stations outside of it are a part of their own.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from time import process_time
from typing import Literal

import numpy as np
import pandas as pd
from numba import njit

from docs.research import scores
from docs.research.bonded_units import BondedUnits, UnitsResponse, follow_units
from docs.research.held_walls import UNIT_WEIGHT
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
from rocking import Accelerogram, Facade, Verdict, assess
from rocking.errors import StructureWarning
from rocking.quantities import GRAVITY
from rocking.structures.joints import USUAL
from rocking.tables import column, row

WALLS = 9
"""Drawn under each component."""
UPLIFTS = (1.3, 4.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
SIGNS = (1.0, -1.0)
"""Of the motion."""
ROCKED = 0.01
"""Of the thickness: a wall of which a unit moves farther has rocked."""


@row("between_ties", "One row per wall and component: what the package says, and the walls of units")
class BetweenTrial(Trial):
    """One trial."""

    catalogue: str = column("The catalogue that the station is of: fema_p695, or another one")
    height_m: float = column("Height, m")
    thickness_m: float = column("Thickness, m")
    unit_m: float = column("Length of a unit, twice its height, m")
    spacing_m: float = column("Distance between ties, m")
    multiplier: float = column("Least multiplier of its mechanisms, g")
    peak: float = column("Peak acceleration over that which lifts")
    verdict: Verdict = column("Verdict of the package")
    governs: str = column("What governs the verdict")
    farthest: float = column("Largest rotation over critical rotation of its members; INF: one overturns")
    falls: int | None = column("Walls of two bays that fall, of two; empty: not said to stand")
    moved: float | None = column("Farthest that a unit of theirs moves outwards, over the thickness")
    ending_falls: int | None = column("Walls that end at ties and can spread there, that fall, of two")
    ending_moved: float | None = column("Farthest that a unit of theirs moves outwards, over the thickness")
    triangle_falls: int | None = column("Triangles alone that fall, by their own equation of motion, of two")
    units_s: float = column("CPU time of the walls of units, s")


@dataclass(frozen=True)
class DrawnWall:
    """A wall as it is described, and the length of its units, m."""

    described: Facade
    unit: float

    def units(self, *, ends_at_ties: bool) -> BondedUnits:
        """Return two bays that end half a spacing beyond their ties, or one that ends at its ties."""
        wall = self.described
        assert wall.tie_spacing is not None
        spacing = wall.tie_spacing
        at = (0.0, spacing) if ends_at_ties else (spacing / 2, 3 * spacing / 2)
        # A tie at the end holds half a spacing.
        share = 0.5 if ends_at_ties else 1.0
        return BondedUnits(
            spacing if ends_at_ties else 2 * spacing,
            wall.height,
            wall.thicknesses[0],
            (self.unit, self.unit / 2),
            wall.unit_weight / GRAVITY,
            wall.floor_loads[0],
            not wall.loads_held,
            tuple((along, wall.tie_heights[0]) for along in at),
            wall.tie_stiffness * spacing * share,
            str(wall.behind),
            wall.mechanism().positive.restitution,
            USUAL.friction,
        )


def drawn(draw: np.random.Generator) -> DrawnWall:
    """Return a wall of one storey with ties farther apart than three lengths of a unit."""
    unit = float(draw.uniform(0.7, 1.2))
    courses = round(float(draw.uniform(2.6, 4.0)) / (unit / 2))
    height = courses * unit / 2
    behind: Literal["floors", "cross_walls"] = "cross_walls" if draw.random() < 0.5 else "floors"
    wall = Facade(
        (height,),
        (float(draw.uniform(0.3, 0.6)),),
        UNIT_WEIGHT,
        floor_loads=(float(draw.uniform(1e3, 15e3)),),
        loads_held=bool(draw.random() < 0.5),
        restitution=float(draw.uniform(0.3, 0.7)),
        behind=behind,
        tie_heights=(height,),
        tie_stiffness=float(np.exp(draw.uniform(*np.log([2e6, 3e7])))),
        tie_spacing=unit * int(draw.integers(4, 8)),
        unit_length=unit,
    )
    return DrawnWall(wall, unit)


def between_ties(target: Target) -> None:
    """Hold what is said of walls with ties at a spacing against walls of units."""
    components = one_of_each(independent(target.records))
    trials = trials_under(
        components, between_trial, [(place,) for place in range(WALLS)], target.tell, _standing
    )
    subtitle = "Walls with ties at a spacing, beside walls of units in running bond in three dimensions."
    target.publish(
        "Between two ties", subtitle, {BetweenTrial: trials, scores.Score: list(between_scores(trials))}
    )


def _standing(trials: Sequence[BetweenTrial]) -> str:
    stand = [trial for trial in trials if trial.falls is not None]
    return f", {len(stand)} stand, {sum(bool(trial.falls) for trial in stand)} of these fall"


def between_trial(component: SiteRecord, place: int) -> BetweenTrial:
    """Return one trial: wall and scale drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, 66, place)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StructureWarning)
        wall = drawn(draw)
        multiplier = wall.described.static_multiplier
        factor = lifting_factor(record, multiplier, UPLIFTS, draw)
        motion = strong_part(record.scaled(factor), multiplier)
        station = assess(motion, wall.described)
    (case,) = station.cases.values()
    stands = station.verdict is Verdict.STANDS
    started = process_time()
    bays = unit_runs(wall.units(ends_at_ties=False), motion) if stands else []
    ending = unit_runs(wall.units(ends_at_ties=True), motion) if stands and place == 0 else []
    thickness = wall.described.thicknesses[0]
    return BetweenTrial(
        **component.named,
        structure="wall between ties",
        scale_factor=factor,
        catalogue=component.catalogue,
        height_m=wall.described.height,
        thickness_m=thickness,
        unit_m=wall.unit,
        spacing_m=wall.described.tie_spacing or np.nan,
        multiplier=multiplier,
        peak=float(motion.peak_acceleration / (multiplier * GRAVITY)),
        verdict=station.verdict,
        governs=station.crack,
        farthest=case.largest_of_part(None),
        falls=sum(bay.falls for bay in bays) if bays else None,
        moved=max(bay.farthest for bay in bays) / thickness if bays else None,
        ending_falls=sum(response.falls for response in ending) if ending else None,
        ending_moved=max(response.farthest for response in ending) / thickness if ending else None,
        triangle_falls=sum(
            triangle_falls(wall.described, sign * motion.acceleration, motion.time_step) for sign in SIGNS
        )
        if stands
        else None,
        units_s=process_time() - started,
    )


def unit_runs(wall: BondedUnits, motion: Accelerogram) -> list[UnitsResponse]:
    """Return how a wall of units responds to a motion and to its reverse."""
    return [follow_units(wall, sign * motion.acceleration, motion.time_step) for sign in SIGNS]


def triangle_falls(wall: Facade, acceleration: np.ndarray, time_step: float) -> bool:
    """Whether half a triangle alone falls that turns as a rigid body about its hypotenuse on the outer face.

    One degree of freedom, but no code of the package: it is set up from where the points of the prism are, in three
    dimensions, and what the halves press on each other is left out. What stands behind throws it back.
    """
    assert wall.tie_spacing is not None
    half, top, thickness = wall.tie_spacing / 2, wall.height, wall.thicknesses[0]
    axis = np.array([half, 0.0, top]) / np.hypot(half, top)
    shares = (np.arange(60) + 0.5) / 60
    # Points of half the triangle, from its foot at mid-span: its strips, and through the thickness.
    along, up, inwards = np.meshgrid(shares, shares, (np.arange(10) + 0.5) / 10, indexing="ij")
    points = np.stack(
        [along * half, -inwards * thickness, (along + (1 - along) * up) * top], axis=-1
    ).reshape(-1, 3)
    weights = np.broadcast_to(1 - along, along.shape).ravel()
    weights = weights / weights.sum() * wall.unit_weight * thickness * half * top / 2
    line = np.stack([shares * half, np.full(60, -thickness / 2), np.full(60, top)], axis=-1)
    load = np.full(60, wall.floor_loads[0] * half / 60)
    pushed = load * (not wall.loads_held)

    def moving(places: np.ndarray) -> np.ndarray:
        """(k, 3, 2) what cos ψ and sin ψ carry; outwards at the top for ψ > 0."""
        across = places - np.outer(places @ axis, axis)
        return np.stack([across, -np.cross(axis, across)], axis=-1)

    body, bears = moving(points), moving(line)
    inertia = (
        weights @ (body[:, :, 0] ** 2).sum(axis=1) + pushed @ (bears[:, :, 0] ** 2).sum(axis=1)
    ) / GRAVITY
    lifted = weights @ body[:, 2] + load @ bears[:, 2]
    drawn_out = (weights @ body[:, 1] + pushed @ bears[:, 1]) / GRAVITY
    return bool(
        _turns_over(
            lifted / inertia,
            drawn_out / inertia,
            np.asarray(acceleration),
            time_step,
            float(wall.restitution or 0.0),
        )
    )


@njit(cache=True)
def _turns_over(lifted, drawn_out, ground, spacing, restitution):  # type: ignore[no-untyped-def]
    angle = 0.0
    speed = 0.0
    fine = 2e-4
    for number in range(int(((ground.size - 1) * spacing + 6.0) / fine)):
        place = int(number * fine / spacing)
        pushed = 0.0
        if place < ground.size - 1:
            part = number * fine / spacing - place
            pushed = ground[place] * (1 - part) + ground[place + 1] * part
        # d/dψ of (cos ψ, sin ψ): gravity against the lift, and the ground against what it carries outwards.
        rate = -np.sin(angle), np.cos(angle)
        turning = -(lifted[0] * rate[0] + lifted[1] * rate[1]) - pushed * (
            drawn_out[0] * rate[0] + drawn_out[1] * rate[1]
        )
        speed += fine * turning
        angle += fine * speed
        if angle < 0.0:
            angle = 0.0
            speed = -restitution * min(speed, 0.0)
        if angle > 1.5:
            return True
    return False


def between_scores(trials: Sequence[BetweenTrial]) -> Iterator[scores.Score]:
    """Yield the shares of what falls among what is said to stand, with intervals by earthquake."""
    every = pd.DataFrame(trials)
    for stations, own in (
        ("all stations", every),
        ("stations outside of FEMA P-695", every[every.catalogue != "fema_p695"]),
    ):
        stands = (own.verdict == Verdict.STANDS).to_numpy()
        falls, ends, moved = (own[name].astype(float) for name in ("falls", "ending_falls", "moved"))
        rocks = (moved > ROCKED).to_numpy()
        measures: dict[str, scores.Measured] = {
            'two bays fall among "stands"': np.where(stands, falls > 0, np.nan),
            'two bays fall among "stands" that rock': np.where(stands & rocks, falls > 0, np.nan),
            'one bay that ends at ties falls among "stands"': np.where(ends.notna(), ends > 0, np.nan),
            'the triangle alone falls among "stands"': np.where(stands, own.triangle_falls > 0, np.nan),
            'two bays rock among "stands"': np.where(stands, rocks, np.nan),
            '"stands"': stands.astype(float),
        }
        yield from scores.scored(
            "walls between ties", stations, measures, sample_of(own.site, own.earthquake)
        )
