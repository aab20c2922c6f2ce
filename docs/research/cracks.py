"""Which crack governs: stacks of separate courses by contact dynamics beside one mechanism per joint, real records.

The rule on trial has no number to tune: a member stands where it stands cracked at any of its joints, and overturns
where it where it does cracked at the joint of least λ, the choice of statics; between them lie the words of shares.

The contact dynamics is Moreau's, of first order, with steps of 0.2 ms: under a pulse, one block or one hinged wall
rotates 0.2 to 1.5 % less than its mechanism. With steps of 1 ms, 17 of 252 trials ended differently, 15 of which are
neither "stands" nor "overturns". LMGC90 took steps of 2 ms.

On 23 November 2026, before the words were seven, 1 of 35 gables that "overturn" stood as a stack, and 2 of 267 of all;
on 27 November, without LMGC90, 7 of 39 and 8 of 278. Whether the words or the stacks changed that was not sought.
"""

import json
import sys
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import pairwise

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.comparison.bodies import BASE_DEPTH, RigidBodies, rectangle
from docs.research.comparison.codes import Question, ask
from docs.research.comparison.lmgc90 import FALLEN, follow
from docs.research.report import Tables, Target
from docs.research.sites import (
    SiteRecord,
    Trial,
    draw_of,
    independent,
    lifting_factor,
    one_of_each,
    sample_of,
)
from rocking import Accelerogram, LoadedWall, Mechanism, RigidBody, Verdict
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack
from rocking.assessment.decide import Decision, Limit, decide
from rocking.assessment.ensemble import ensemble
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import GroundMotions
from rocking.contacts.dynamics import follow_stack
from rocking.errors import StructureWarning
from rocking.quantities import GRAVITY
from rocking.structures.stack import Course, Stack
from rocking.tables import column, row
from rocking.warnings import RockingWarning

COURSES = (6, 12, 20)
CHANCES = (0.7, 0.2, 0.1)
"""Of each number of courses: the time of LMGC90 grows faster than their number."""
UPLIFTS = (1.1, 6.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
SCALES = 2
"""Trials of each kind of member under each record."""
UNIT_WEIGHT = 18e3
"""Of the masonry, N/m³."""
RISK = 0.05
"""Share of an ensemble up to which a mechanism stands, as in a study."""
STEP = 2e-4
"""Time step of the stacks, s: a rotation is then within 1.5 % of its limit, from below."""
LMGC90_STEP = 2e-3
CHECKED = 5
"""Records of which the first trial of each kind of member is followed by LMGC90 too."""
STRONG = 0.5
"""Rule and stack are given the motion where it exceeds this share of the least uplift acceleration."""
MARGIN = 0.5
"""Before and after that, s."""
TURN = 0.6
"""Turn of a course, rad, from which nothing comes back: twice the largest critical rotation of any member."""
TIMEOUT = 3600.0
"""Seconds that one run of LMGC90 may take."""


@dataclass(frozen=True, eq=False)
class Member:
    """A stack of courses. sections: (n + 1, 2) left and right face at each joint, from the base up, m. height: m.

    depths: (n,) of the courses, m; None: 1 m each. slab: weight of a floor on top over that of the member, which then
    stands between supports; None: its top is free. tapers: whether its courses grow smaller upwards, so that it never
    stands by its mechanisms alone once it has lifted.
    """

    kind: str
    sections: np.ndarray
    height: float
    depths: np.ndarray | None = None
    slab: float | None = None
    tapers: bool = False

    @property
    def courses(self) -> int:
        """Their number."""
        return len(self.sections) - 1

    @cached_property
    def bodies(self) -> RigidBodies:
        """The courses on what moves with the ground, and the slab.

        Corners (4, 2) of each, counterclockwise, m; a course that ends in a point keeps a millimetre.
        """
        levels = np.linspace(0, self.height, self.courses + 1)
        lines = [np.column_stack([faces, [z, z]]) for faces, z in zip(self.sections, levels, strict=True)]
        left, right = self.sections[0]
        ground = rectangle(left - 3.0, right + 3.0, -BASE_DEPTH, 0.0)
        polygons = [ground, *(np.vstack([lower, upper[::-1]]) for lower, upper in pairwise(lines))]
        depths = [1.0, *(np.ones(self.courses) if self.depths is None else self.depths)]
        if self.slab is None:
            return RigidBodies(polygons, (0,), depths=depths)
        wide, top = right - left, self.height * (1 + self.slab / 3)
        polygons.append(rectangle(left - wide, right + wide, self.height, top))
        return RigidBodies(polygons, (0,), guided=(self.courses + 1,), depths=[*depths, 1.0])

    @cached_property
    def stack(self) -> Stack:
        """The courses and the slab as the package follows them."""
        masses, centres, gyrations = self.bodies.properties
        courses = []
        for place, polygon in enumerate(self.bodies.polygons[1:], start=1):
            left, right, right_above, left_above = polygon[:, 0].tolist()
            low, high = polygon[[0, 3], 1].tolist()
            mass = float(masses[place])
            centre = (float(centres[place].real), float(centres[place].imag))
            guided = place in self.bodies.guided
            inertia = mass * float(gyrations[place])
            bottom, top = (left, right), (left_above, right_above)
            courses.append(
                Course(
                    bottom=bottom,
                    top=top,
                    base=low,
                    height=high - low,
                    mass=mass,
                    centre=centre,
                    inertia=inertia,
                    guided=guided,
                )
            )
        return Stack(tuple(courses))

    @cached_property
    def mechanisms(self) -> dict[int, Mechanism]:
        """The mechanism of each joint that may open, by the number of courses beneath it."""
        joints = range(0 if self.slab is None else 1, self.courses)
        with warnings.catch_warnings():
            # A course wider than high keeps nothing of an impact, which is meant here.
            warnings.simplefilter("ignore", StructureWarning)
            return {joint: self._cracked_at(joint).mechanism() for joint in joints}

    def _cracked_at(self, joint: int) -> LoadedWall | RigidBody:
        """The wall under its slab with a hinge at a joint; or all courses above the joint as one body."""
        base = self.height * joint / self.courses
        left, right = self.sections[joint]
        if self.slab is not None:
            load = self.slab * UNIT_WEIGHT * self.height * (right - left)
            return LoadedWall.of_size(
                self.height, right - left, UNIT_WEIGHT, base, top_load=load, top_slab="flat"
            )
        masses, centres, gyrations = (values[1 + joint :] for values in self.bodies.properties)
        centre = complex(masses @ centres / masses.sum())
        inertia = masses @ (gyrations + np.abs(centres - centre) ** 2) / masses.sum()
        return RigidBody(centre.real - left, right - centre.real, centre.imag - base, float(inertia))


def straight(base: float, top: float, courses: int) -> np.ndarray:
    """Return the faces (courses + 1, 2) of a member whose thickness goes from one to the other, m."""
    half = np.linspace(base, top, courses + 1) / 2
    return np.column_stack([-half, half])


@cache
def members(courses: int) -> dict[str, Member]:
    """Return walls between floors, a column, a façade with a ledge, a gable, a pinnacle and a spire, by kind."""
    joints = np.linspace(0, 1, courses + 1)
    middles = (np.arange(courses) + 0.5) / courses
    wall = straight(0.25, 0.25, courses)
    # The façade is flush outside: 0.5 m thick below half of its height, 0.35 m above.
    ledge = np.where(joints[:, None] < 0.5, [0.0, 0.5], [0.15, 0.5])
    # The gable is a triangle seen along its own plane: 0.3 m thick all the way, its width falls to nothing.
    gable = straight(0.3, 0.3, courses)
    # The pinnacle has a shaft of 0.5 m over its lower 40 %, and a wedge on it.
    half = 0.25 * np.clip((1 - joints) / 0.6, 2e-3, 1)
    pinnacle = np.column_stack([-half, half])
    made = (
        Member("wall with a slab only", wall, 3.2, slab=0.05),
        Member("wall with a floor load", wall, 3.2, slab=0.6),
        Member("column", straight(0.6, 0.6, courses), 4.8),
        Member("façade with a ledge", ledge, 6.0),
        Member("gable", gable, 3.0, 6.0 * (1 - middles)),
        Member("pinnacle", pinnacle, 2.5, half[:-1] + half[1:], tapers=True),
        Member("spire", straight(3.0, 0.01, courses), 15.0, 3.0 * (1 - middles), tapers=True),
    )
    return {row.kind: row for row in made}


KINDS = tuple(members(COURSES[0]))


@row("cracks", "One row per member, record and scale: the stack beside the mechanism of every joint")
class CrackRow(Trial):
    """One trial."""

    courses: int = column("Number of courses of the member")
    falls: bool = column("Whether the stack falls")
    opened: int = column("Courses beneath the joint that had opened most when the stack turned most")
    falls_in_lmgc90: bool | None = column("Whether it falls in LMGC90; empty: not tried, or no answer")
    static_joint: int = column("Courses beneath the joint of least uplift multiplier")
    static_share: float = column("Share of the ensemble that overturns cracked there")
    largest_share: float = column("Largest share over all joints")
    verdict: Verdict = column("What the rule says")


def govern(target: Target) -> None:
    """Hold the rule against stacks under one component of each site, none of which took part in the rule.

    The rows of each record are written as they come; a long run goes on where it was stopped.
    """
    rows: list[CrackRow] = []
    for count, component in enumerate(one_of_each(independent(target.records))):
        checked = len(KINDS) if count < CHECKED else 0
        trials = (crack_row(component, k, k < checked) for k in range(SCALES * len(KINDS)))
        rows += target.kept(CrackRow, component.identifier, trials)
        target.tell(f"{component.identifier}: {len(rows)} trials")
    subtitle = "Stacks of courses beside the mechanism of every joint, one component of each site."
    tables: Tables = {CrackRow: rows, scores.Score: list(crack_scores(rows))}
    target.publish("Which crack governs", subtitle, tables)


def crack_row(component: SiteRecord, place: int, checked: bool) -> CrackRow:
    """Return one trial: the kind of member by its place, its number of courses and the scale of the record drawn.

    checked: LMGC90 follows the stack too.
    """
    record = component.accelerogram
    draw = draw_of(component.identifier, place)
    member = members(int(draw.choice(COURSES, p=CHANCES)))[KINDS[place % len(KINDS)]]
    mechanisms = member.mechanisms
    static = min(mechanisms, key=lambda joint: mechanisms[joint].uplift_multiplier)
    multiplier = mechanisms[static].uplift_multiplier
    factor = lifting_factor(record, multiplier, UPLIFTS, draw)
    motion = record.scaled(factor)
    strong = np.flatnonzero(np.abs(motion.acceleration) >= STRONG * multiplier * GRAVITY)
    beside = round(MARGIN / motion.time_step)
    span = slice(max(strong[0] - beside, 0), strong[-1] + beside + 1)
    motion = replace(motion, acceleration=motion.acceleration[span])
    decision, shares = ruled(mechanisms, static, motion, member.tapers)
    turns = stack(member, motion)
    return CrackRow(
        courses=member.courses,
        **component.named,
        structure=member.kind,
        scale_factor=factor,
        falls=bool(np.abs(turns).max() > TURN),
        opened=int(np.abs(np.diff(turns, prepend=0.0)).argmax()),
        falls_in_lmgc90=falls_in_lmgc90(member, motion) if checked else None,
        static_joint=static,
        static_share=shares[static],
        largest_share=max(shares.values()),
        verdict=decision.verdict,
    )


def ruled(
    mechanisms: Mapping[int, Mechanism], static: int, motion: Accelerogram, tapers: bool = False
) -> tuple[Decision, Mapping[int, float]]:
    """Return the decision, and the share of the ensemble that overturns at each joint.

    tapers: whether the courses of a member that lifts at all may be thrown.
    """
    motions = GroundMotions.of(motion)
    of_each = {joint: ensemble(mechanism, motions) for joint, mechanism in mechanisms.items()}
    statics_first = sorted(of_each, key=lambda joint: joint != static)
    followed = (FollowedCrack(f"joint {joint}", joint, of_each[joint]) for joint in statics_first)
    lifts = any(np.any(ensemble.rotation_ratios > 0) for ensemble in of_each.values())
    thrown = [Limit.untold(RockingWarning(AssessmentKind.COURSES_THROWN))] if tapers and lifts else []
    decision = decide(CrackEnsembles(tuple(followed)).facts, thrown)
    return decision, {joint: ensemble.overturning_share for joint, ensemble in of_each.items()}


def stack(member: Member, motion: Accelerogram, step: float = STEP) -> np.ndarray:
    """Return the turns (courses,) where they were largest, clockwise positive, rad."""
    return follow_stack(member.stack, motion, step).turns[: member.courses]


def falls_in_lmgc90(member: Member, motion: Accelerogram) -> bool | None:
    """Return whether LMGC90, in a process of its own, sees the stack fall; None: no answer."""
    turn, _ = ask("docs.research.cracks", _case(member, motion), TIMEOUT)
    return None if turn is None else turn > TURN


class MemberQuestion(Question):
    """A question on a member by its kind and its number of courses."""

    member: tuple[str, int]


def _case(member: Member, motion: Accelerogram) -> MemberQuestion:
    """The stack as the codes take it."""
    mechanisms = member.mechanisms.values()
    return {
        "member": (member.kind, member.courses),
        "acceleration": motion.acceleration.tolist(),
        "time_step": motion.time_step,
        "critical_rotation": TURN / FALLEN,
        "frequency_parameter": min(mechanism.positive.frequency_parameter for mechanism in mechanisms),
        "settled": min(mechanism.critical_rotation for mechanism in mechanisms) / 3,
    }


def crack_scores(rows: Sequence[CrackRow]) -> Iterator[scores.Score]:
    """Yield the errors of the rule by kind of member and of all, with intervals by earthquake."""
    every = pd.DataFrame(rows)
    for kind, own in [("all", every), *every.groupby("structure", sort=False)]:
        as_lmgc90 = (own.falls == own.falls_in_lmgc90).where(own.falls_in_lmgc90.notna())
        measures = {
            'falls among "stands"': own.falls.where(own.verdict == Verdict.STANDS),
            'survivals among "overturns"': (~own.falls).where(own.verdict == Verdict.OVERTURNS),
            "open": ~own.verdict.map(lambda word: word.is_sure),
            "falls at the joint of least λ": (own.opened == own.static_joint).where(own.falls),
            f"falls where at most {RISK:.0%} overturn at any joint": own.falls.where(
                own.largest_share <= RISK
            ),
            "falls or stands as in LMGC90": as_lmgc90,
        }
        yield from scores.scored("governing crack", kind, measures, sample_of(own.site, own.earthquake))


def main() -> None:
    """Follow one member, named on standard input, in LMGC90 and print the largest turn of a course, rad."""
    case = json.load(sys.stdin)
    kind, courses = case["member"]
    _, turns, _ = follow(case, members(courses)[kind].bodies, LMGC90_STEP)
    print("\n" + json.dumps(float(np.abs(turns[:, : courses + 1]).max())))


if __name__ == "__main__":
    main()
