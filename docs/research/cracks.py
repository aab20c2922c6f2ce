"""Which crack governs: stacks of separate courses by contact dynamics beside one mechanism per joint, real records.

The rule on trial has no number to tune: a member stands where it stands cracked at any of its joints, and overturns
where it does cracked at the joint of least λ, the choice of statics; between them it is undecided.
"""

import json
import sys
import warnings
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.comparison.bodies import BASE_DEPTH, RigidBodies, properties, rectangle
from docs.research.comparison.codes import ask, still_from
from docs.research.comparison.lmgc90 import FALLEN, base_speed, follow
from docs.research.report import publish
from docs.research.sites import Records, Tell, independent, lifting_factor, one_of_each
from docs.research.stacks import largest_turns
from rocking.assessment.ensemble import Ensemble, GroundMotions, ensemble
from rocking.assessment.verdict import Verdict
from rocking.errors import StructureWarning
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import LoadedWall, Mechanism, RigidBody, Spire
from rocking.tables import Row, column, read_rows, row, write_rows

COURSES = (6, 12, 20)
CHANCES = (0.7, 0.2, 0.1)
"""Of each number of courses: the time of LMGC90 grows faster than their number."""
UPLIFTS = (1.1, 6.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
SCALES = 2
"""Trials of each kind of member under each record."""
UNIT_WEIGHT = 18e3
"""Of the masonry, N/m³."""
STEP = 2e-4
"""Time step of the stacks, s: a rotation is then within 1.5 % of its limit, from below."""
LMGC90_STEP = 2e-3
CHECKED = 5
"""Records of which the first trial of each kind of member is followed by LMGC90 too."""
STRONG = 0.5
"""Rule and stack are given the motion where it exceeds this share of the least uplift acceleration."""
MARGIN = 0.5
"""Before and after that, s."""
TAPER = Spire.crack_margin
TURN = 0.6
"""Turn of a course, rad, from which nothing comes back: twice the largest critical rotation of any member."""
TIMEOUT = 3600.0
"""Seconds that one run of LMGC90 may take."""


@dataclass(frozen=True, eq=False)
class Member:
    """A stack of courses. sections: (n + 1, 2) left and right face at each joint, from the base up, m. height: m.

    depths: (n,) of the courses, m. slab: weight of a floor on top over that of the member, which then stands between
    supports; None: its top is free. margin: factor on the motion under which it must stand whatever cracks.
    """

    kind: str
    sections: np.ndarray
    height: float
    depths: np.ndarray
    slab: float | None = None
    margin: float = 1.0

    @property
    def courses(self) -> int:
        """Their number."""
        return len(self.depths)

    @cached_property
    def polygons(self) -> list[np.ndarray]:
        """The corners (4, 2) of each course, counterclockwise, m; a course that ends in a point keeps a millimetre."""
        levels = np.linspace(0, self.height, self.courses + 1)
        lines = [np.column_stack([faces, [z, z]]) for faces, z in zip(self.sections, levels, strict=True)]
        return [np.vstack([lower, upper[::-1]]) for lower, upper in pairwise(lines)]

    @cached_property
    def mechanisms(self) -> dict[int, Mechanism]:
        """The mechanism of each joint that may open, by the number of courses beneath it."""
        with warnings.catch_warnings():
            # A course wider than high keeps nothing of an impact, which is meant here.
            warnings.simplefilter("ignore", StructureWarning)
            if self.slab is None:
                return {joint: self._above(joint).mechanism() for joint in range(self.courses)}
            return {joint: self._hinged(joint, self.slab).mechanism() for joint in range(1, self.courses)}

    def _hinged(self, joint: int, slab: float) -> LoadedWall:
        """The wall under its slab, hinged at a joint."""
        height, thickness = self.height, float(np.ptp(self.sections[0]))
        load = slab * UNIT_WEIGHT * height * thickness
        hinge = height * joint / self.courses
        return LoadedWall.hinged_at(height, hinge, thickness, UNIT_WEIGHT, top_load=load, top_slab="flat")

    def _above(self, joint: int) -> RigidBody:
        """All courses above a joint as one body."""
        areas, centres, gyrations = (
            np.array(each) for each in zip(*map(properties, self.polygons[joint:]), strict=True)
        )
        masses = areas * self.depths[joint:]
        centre = complex(masses @ centres / masses.sum())
        inertia = masses @ (gyrations + np.abs(centres - centre) ** 2) / masses.sum()
        (left, right), base = self.sections[joint], self.height * joint / self.courses
        return RigidBody(centre.real - left, right - centre.real, centre.imag - base, float(inertia))

    def bodies(self) -> RigidBodies:
        """Return the courses on what moves with the ground, and the slab."""
        left, right = self.sections[0]
        stack = (rectangle(left - 3.0, right + 3.0, -BASE_DEPTH, 0.0), *self.polygons)
        if self.slab is None:
            return RigidBodies(stack, (0,), depths=(1.0, *self.depths))
        wide, top = right - left, self.height * (1 + self.slab / 3)
        slab = rectangle(left - wide, right + wide, self.height, top)
        depths = (1.0, *self.depths, 1.0)
        return RigidBodies((*stack, slab), (0,), guided=(self.courses + 1,), depths=depths)


@cache
def members() -> tuple[Member, ...]:
    """Return walls between floors, columns, façades with a ledge, gables, pinnacles and spires, each of COURSES."""
    return tuple(make(courses) for courses in COURSES for make in KINDS.values())


def _wall(slab: float) -> Callable[[int], Member]:
    kind = "wall with a floor load" if slab > 0.1 else "wall with a slab only"
    return lambda n: Member(kind, straight(0.25, 0.25, n), 3.2, np.ones(n), slab)


def _ledge(courses: int) -> Member:
    """Two thicknesses, flush outside: .5 m below half of the height, .35 m above."""
    faces = np.where(np.arange(courses + 1)[:, None] < courses / 2, [0.0, 0.5], [0.15, 0.5])
    return Member("façade with a ledge", faces, 6.0, np.ones(courses))


def _pinnacle(courses: int) -> Member:
    """A shaft of .5 m over the lower 40 %, and a wedge on it."""
    half = 0.25 * np.clip((1 - np.linspace(0, 1, courses + 1)) / 0.6, 2e-3, 1)
    return Member(
        "pinnacle", np.column_stack([-half, half]), 2.5, 2 * (half[:-1] + half[1:]) / 2, margin=TAPER
    )


def _gable(courses: int) -> Member:
    """A triangle seen along its own plane: .3 m thick all the way, its width falls to nothing."""
    return Member("gable", straight(0.3, 0.3, courses), 3.0, 6.0 * (1 - (np.arange(courses) + 0.5) / courses))


KINDS: Mapping[str, Callable[[int], Member]] = {
    "slab only": _wall(0.05),
    "floor load": _wall(0.6),
    "column": lambda n: Member("column", straight(0.6, 0.6, n), 4.8, np.ones(n)),
    "ledge": _ledge,
    "gable": _gable,
    "pinnacle": _pinnacle,
    "spire": lambda n: Member(
        "spire", straight(3.0, 0.01, n), 15.0, 3.0 * (1 - (np.arange(n) + 0.5) / n), margin=TAPER
    ),
}


@row("cracks", "One row per member, record and scale: the stack beside the mechanism of every joint")
class CrackRow(Row):
    """One trial."""

    kind: str = column("Kind of member")
    courses: int = column("Number of its courses")
    record: str = column("Identifier of the record")
    site: str = column("Event and station")
    scale_factor: float = column("What the record was multiplied by")
    falls: bool = column("Whether the stack falls")
    opened: int = column("Courses beneath the joint that had opened most when the stack turned most")
    falls_in_lmgc90: bool | None = column("Whether it falls in LMGC90; empty: not tried, or no answer")
    static_joint: int = column("Courses beneath the joint of least uplift multiplier")
    static_share: float = column("Share of the ensemble that overturns cracked there")
    largest_share: float = column("Largest share over all joints")
    verdict: Verdict = column("What the rule says")


def write_cracks(records: Records, folder: Path, tell: Tell, most: int | None = None) -> None:
    """Write cracks.csv, its scores and report into `folder`, and the rows of each record as they come.

    records: their sites took no part in the rule; most: of them. Rows that `folder` holds are not made again.
    """
    rows: list[CrackRow] = []
    for count, (name, site, record) in enumerate(one_of_each(independent(records))[:most]):
        path = folder / "trials" / f"{name}.csv"
        if not path.is_file():  # a long run goes on where it was stopped
            checked = len(KINDS) if count < CHECKED else 0
            trials = (crack_row(name, site, record, k, k < checked) for k in range(SCALES * len(KINDS)))
            write_rows(CrackRow, trials, path)
        rows += read_rows(CrackRow, path)
        tell(f"{name}: {len(rows)} trials")
    subtitle = "Stacks of courses beside the mechanism of every joint, one component of each site."
    tables = {CrackRow: rows, scores.Score: list(crack_scores(rows))}
    publish(folder, "Which crack governs", subtitle, tables)


def crack_row(name: str, site: str, record: Accelerogram, place: int, checked: bool = False) -> CrackRow:
    """Return one trial: the kind of member by its place, its number of courses and the scale of the record drawn.

    checked: LMGC90 follows the stack too.
    """
    draw = np.random.default_rng([zlib.crc32(name.encode()), place])
    member = members()[len(KINDS) * draw.choice(len(COURSES), p=CHANCES) + place % len(KINDS)]
    mechanisms = member.mechanisms
    static = min(mechanisms, key=lambda joint: mechanisms[joint].uplift_multiplier)
    multiplier = mechanisms[static].uplift_multiplier
    factor = lifting_factor(record, multiplier, UPLIFTS, draw)
    motion = _strong(record.scaled(factor), multiplier * GRAVITY)
    verdict, shares = ruled(mechanisms, static, motion, member.margin)
    turns = stack(member, motion)
    return CrackRow(
        kind=member.kind,
        courses=member.courses,
        record=name,
        site=site,
        scale_factor=factor,
        falls=bool(np.abs(turns).max() > TURN),
        opened=int(np.abs(np.diff(turns)).argmax()),
        falls_in_lmgc90=falls_in_lmgc90(member, motion) if checked else None,
        static_joint=static,
        static_share=shares[static],
        largest_share=max(shares.values()),
        verdict=verdict,
    )


def _strong(motion: Accelerogram, lift: float) -> Accelerogram:
    """Cut the motion to where its acceleration exceeds a share of what lifts the member."""
    strong = np.flatnonzero(np.abs(motion.acceleration) >= STRONG * lift)
    beside = round(MARGIN / motion.time_step)
    return replace(
        motion, acceleration=motion.acceleration[max(strong[0] - beside, 0) : strong[-1] + beside + 1]
    )


def ruled(
    mechanisms: Mapping[int, Mechanism], static: int, motion: Accelerogram, margin: float = 1.0
) -> tuple[Verdict, Mapping[int, float]]:
    """Return what the rule says, and the share of the ensemble that overturns at each joint.

    margin: factor on the motion under which a member must stand whatever cracks.
    """
    all_of = _followed(mechanisms, motion)
    shares = {joint: each.overturning_share for joint, each in all_of.items()}
    verdicts = {each.verdict for each in all_of.values()}
    if verdicts == {Verdict.STANDS} and margin > 1:
        verdicts = {each.verdict for each in _followed(mechanisms, motion.scaled(margin)).values()}
    if verdicts == {Verdict.STANDS}:
        return Verdict.STANDS, shares
    overturns = all_of[static].verdict is Verdict.OVERTURNS
    return (Verdict.OVERTURNS if overturns else Verdict.UNDECIDED), shares


def _followed(mechanisms: Mapping[int, Mechanism], motion: Accelerogram) -> Mapping[int, Ensemble]:
    motions = GroundMotions.of(motion)
    return {joint: ensemble(mechanism, motions) for joint, mechanism in mechanisms.items()}


def stack(member: Member, motion: Accelerogram, step: float = STEP) -> np.ndarray:
    """Return the turns (courses + 1,) of the ground and the courses where they were largest, rad."""
    case = _case(member, motion)
    _, speed = base_speed(case, step)
    still = int(still_from(case) / step)
    turns = largest_turns(member.bodies(), speed[1:], step, TURN, still, case["settled"])
    return turns[: member.courses + 1]


def falls_in_lmgc90(member: Member, motion: Accelerogram) -> bool | None:
    """Return whether LMGC90, in a process of its own, sees the stack fall; None: no answer."""
    turn, _ = ask("docs.research.cracks", _case(member, motion), TIMEOUT)
    return None if turn is None else turn > TURN


def _case(member: Member, motion: Accelerogram) -> dict[str, Any]:
    """The stack as the codes take it."""
    mechanisms = member.mechanisms.values()
    return {
        "member": [member.kind, member.courses],
        "acceleration": motion.acceleration.tolist(),
        "time_step": motion.time_step,
        "critical_rotation": TURN / FALLEN,
        "frequency_parameter": min(each.positive.frequency_parameter for each in mechanisms),
        "settled": min(each.critical_rotation for each in mechanisms) / 3,
    }


def crack_scores(rows: Sequence[CrackRow]) -> Iterator[scores.Score]:
    """Yield the errors of the rule by kind of member and of all, with intervals by site."""
    every = pd.DataFrame(rows)
    for kind, own in [("all", every), *every.groupby("kind", sort=False)]:
        as_lmgc90 = (own.falls == own.falls_in_lmgc90).where(own.falls_in_lmgc90.notna())
        measures = {
            'falls among "stands"': own.falls.where(own.verdict == Verdict.STANDS),
            'survivals among "overturns"': (~own.falls).where(own.verdict == Verdict.OVERTURNS),
            "undecided": own.verdict == Verdict.UNDECIDED,
            "falls at the joint of least λ": (own.opened == own.static_joint).where(own.falls),
            "falls or stands as in LMGC90": as_lmgc90,
        }
        yield from scores.scored("governing crack", kind, measures, own.site.tolist())


def straight(base: float, top: float, courses: int) -> np.ndarray:
    """Return the faces (courses + 1, 2) of a member whose thickness goes from one to the other, m."""
    half = np.linspace(base, top, courses + 1) / 2
    return np.column_stack([-half, half])


def main() -> None:
    """Follow one member, named on standard input, in LMGC90 and print the largest turn of a course, rad."""
    given = json.load(sys.stdin)
    member = next(each for each in members() if [each.kind, each.courses] == given["member"])
    _, turns, _ = follow(given, member.bodies(), LMGC90_STEP)
    print("\n" + json.dumps(float(np.abs(turns[:, : member.courses + 1]).max())))


if __name__ == "__main__":
    main()
