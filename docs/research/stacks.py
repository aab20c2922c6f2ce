"""Who stands where contacts open and courses are thrown: verdicts with and without contact dynamics beside stacks.

Structures are drawn as a user describes them and meet real motions. The truth of a trial is a stack of as many courses
as were drawn, six to thirteen, on the friction of the study, followed with a finer step than `fidelity: contact` takes.
Sites are parted into halves by their names, and each kind is judged on the half that nothing about it was chosen on:
that a contact opens was looked at on the even half, and that tapering members need a stack of many courses on the odd
one.
"""

import warnings
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from time import process_time
from typing import Literal

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.cracks import MARGIN, STRONG, Member, straight
from docs.research.report import Target
from docs.research.sites import (
    SiteRecord,
    Trial,
    draw_of,
    independent,
    lifting_factor,
    one_of_each,
    sample_of,
)
from rocking import Accelerogram, Facade, LoadedWall, Spire, Verdict, assess
from rocking.assessment.decide import Facts, Limit, decide
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.settings import AssessmentSettings
from rocking.contacts.dynamics import follow_stack
from rocking.errors import StructureWarning
from rocking.quantities import GRAVITY
from rocking.signal.measures import peak_velocity
from rocking.structures import Structure
from rocking.structures.building_parts import building_part
from rocking.structures.crackable import Crackable
from rocking.structures.stack import Stack
from rocking.tables import column, row

COURSES = (6, 8, 10, 13)
"""Numbers of courses of which the true stack has one."""
TRUE_STEP = 2e-4
"""Its time step, s: a rotation is then within 1.5 % of its limit."""
UPLIFTS = (1.05, 3.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
TRIALS = {
    "spire": 2,
    "pinnacle": 3,
    "free wall": 3,
    "loaded wall": 2,
    "gable": 3,
    "façade with ties": 1,
    "façade tied within": 1,
}
"""Under each component."""
CAMPAIGN = 3
"""Members, scales and courses are drawn anew for each campaign."""
LIFTED = 1e-4
"""Turn of a course beyond which the true stack has lifted, rad."""
UNIT_WEIGHT = 18e3
"""Of the masonry, N/m³."""
SETTINGS = AssessmentSettings(fidelity="contact")


@dataclass(frozen=True, eq=False)
class Case:
    """A structure as a user describes it, and the courses that it truly consists of.

    stack_of: the true stack of so many courses, on joints of any friction.
    """

    structure: Structure
    stack_of: Callable[[int], Stack]

    @property
    def multiplier(self) -> float:
        """Uplift multiplier of statics, the least over its cracks: ground acceleration over g."""
        return self.structure.static_multiplier

    def facts(self, motion: Accelerogram) -> tuple[Facts, tuple[Limit, ...]]:
        """Return what a study with `fidelity: contact` decides by, contact dynamics included where it is asked."""
        station = assess(motion, self.structure, settings=SETTINGS)
        (case,) = station.cases.values()
        return case.facts(self.structure), case.limits

    def stack(self, courses: int) -> Stack:
        """Return the true stack, on the friction of the study or less."""
        stack = self.stack_of(courses)
        return replace(stack, friction=min(stack.friction, self.structure.joints.friction))

    def begins_storey(self, height: float) -> bool | None:
        """Return whether a storey begins at `height` [m] above the foot; None of what has no storeys."""
        if not isinstance(self.structure, Facade):
            return None
        return bool(np.isclose(self.structure.levels[:-1], height).any())


def words_of(facts: Facts, limits: Sequence[Limit] = ()) -> tuple[Verdict, Verdict, Verdict]:
    """Return the word by mechanisms alone whatever their contacts do, that without contact dynamics, and that with."""
    without = replace(facts, stacks=None)
    of_contacts = AssessmentKind.FRICTION_SHORT
    alone = [limit for limit in limits if not limit.is_untold and limit.warning.kind is not of_contacts]
    return decide(without, alone).verdict, decide(without, limits).verdict, decide(facts, limits).verdict


def laid(structure: Structure) -> Case:
    """Return the case of a structure that lays its own courses; one whose crack is known keeps its bodies."""
    is_known = isinstance(structure, Crackable) and structure.crack == "known"
    return Case(structure, lambda courses: structure.stack(None if is_known else courses))


def free_wall(draw: np.random.Generator) -> Case:
    """Held by nothing at its top."""
    height = float(draw.uniform(0.8, 4.0))
    thickness = height / float(draw.uniform(4.0, 10.0))
    return laid(building_part("free_wall").construct(height=height, thickness=thickness))


def gable(draw: np.random.Generator) -> Case:
    """A triangle that falls out of its plane, known to the package as one body; its courses grow shorter upwards."""
    height = float(draw.uniform(1.5, 5.0))
    thickness = height / float(draw.uniform(5.0, 12.0))
    structure = building_part("gable").construct(height=height, thickness=thickness)

    def stack(courses: int) -> Stack:
        lengths = 2 * height * (1 - (np.arange(courses) + 0.5) / courses)
        return Member("gable", straight(thickness, thickness, courses), height, lengths).stack

    return Case(structure, stack)


def pinnacle(draw: np.random.Generator) -> Case:
    """A solid pyramid of a slope of 1 in 4 to 1 in 10."""
    thickness = float(draw.uniform(0.3, 1.0))
    height = thickness * float(draw.uniform(2.0, 5.0))
    return laid(building_part("pinnacle").construct(height=height, thickness=thickness))


def spire(draw: np.random.Generator) -> Case:
    """Solid or hollow, round or square, of a slope of 1 in 6 to 1 in 12."""
    width = float(draw.uniform(1.0, 4.0))
    wall = None if draw.random() < 0.3 else float(draw.uniform(0.1, 0.25) * width / 2)
    plan: Literal["circular", "square"] = "circular" if draw.random() < 0.5 else "square"
    height = float(width * draw.uniform(3.0, 6.0))
    return laid(Spire(width, height, wall, plan))


def loaded_wall(draw: np.random.Generator) -> Case:
    """With a hinge that exists, below a slab of 5 to 150 % of its weight."""
    height, thickness = float(draw.uniform(2.4, 4.0)), float(draw.uniform(0.2, 0.5))
    hinge = height * float(draw.uniform(0.3, 0.85))
    load = UNIT_WEIGHT * height * thickness * float(np.exp(draw.uniform(*np.log([0.05, 1.5]))))
    with warnings.catch_warnings():
        # A wall that keeps nothing of an impact is meant here.
        warnings.simplefilter("ignore", StructureWarning)
        size = height, thickness, UNIT_WEIGHT, hinge
        wall = LoadedWall.of_size(*size, top_load=load, top_slab="flat", crack="known")
    return laid(wall)


def tied_facade(draw: np.random.Generator) -> Case:
    """Of two or three storeys, with floors that bear on its middle and a tie at the top that yields and breaks."""
    storeys = int(draw.integers(2, 4))
    heights = tuple(draw.uniform(2.8, 4.0, storeys).tolist())
    thicknesses = tuple(np.linspace(draw.uniform(0.5, 0.8), draw.uniform(0.35, 0.5), storeys).tolist())
    facade = Facade(
        heights,
        thicknesses,
        UNIT_WEIGHT,
        floor_loads=tuple(draw.uniform(0.0, 12e3, storeys).tolist()),
        tie_heights=(sum(heights),),
        tie_stiffness=float(np.exp(draw.uniform(*np.log([50e3, 1e6])))),
        tie_strength=float(draw.uniform(2e3, 10e3)),
        tie_plastic_elongation=float(draw.uniform(0.0, 0.03)),
    )
    return laid(facade)


def tied_within(draw: np.random.Generator) -> Case:
    """Of one or two storeys of one thickness, held by a tie between the feet of storeys, above which it may crack."""
    storeys = int(draw.integers(1, 3))
    heights = tuple(draw.uniform(2.8, 4.5, storeys).tolist())
    facade = Facade(
        heights,
        (float(draw.uniform(0.3, 0.6)),) * storeys,
        UNIT_WEIGHT,
        floor_loads=tuple(draw.uniform(0.0, 8e3, storeys).tolist()),
        tie_heights=(sum(heights) * float(draw.uniform(0.35, 0.75)),),
        tie_stiffness=float(np.exp(draw.uniform(*np.log([200e3, 1e6])))),
        tie_strength=float(draw.uniform(20e3, 60e3)),
        tie_plastic_elongation=0.03,
    )
    return laid(facade)


DRAWN: Mapping[str, Callable[[np.random.Generator], Case]] = {
    "spire": spire,
    "pinnacle": pinnacle,
    "free wall": free_wall,
    "loaded wall": loaded_wall,
    "gable": gable,
    "façade with ties": tied_facade,
    "façade tied within": tied_within,
}
KINDS = tuple(DRAWN)


@row(
    "stacks",
    "One row per member, component and scale: verdicts with and without contact dynamics, and the stack",
)
class StackRow(Trial):
    """One trial."""

    courses: int = column("Number of courses of the true stack")
    velocity_ratio_s: float = column("PGV/PGA of the motion, s")
    mechanism: Verdict = column("Verdict by mechanisms alone")
    warning: str = column("Why that is not enough; empty where it is")
    without: Verdict = column("Verdict without contact dynamics")
    verdict: Verdict = column("Verdict with contact dynamics, where there is a doubt")
    stack_falls: int | None = column("Stacks that fall in contact dynamics; empty: not asked")
    stack_runs: int | None = column("Stacks that contact dynamics followed")
    falls: bool = column("Whether the true stack falls")
    turn_rad: float = column("Largest turn of a course of the true stack, as far as it was followed, rad")
    opened: int = column("Courses beneath the joint of the true stack that had opened most")
    opened_height_m: float = column("Height of that joint above the foot of the true stack, m")
    opened_at_storey: bool | None = column("Whether a storey begins there; empty: it has none")
    contact_s: float = column("CPU time of the verdict with contact dynamics, s")


TAPERING = ("spire", "pinnacle")
"""Kinds that are judged on the even half of the sites."""


def judged_kinds(site: str) -> list[str]:
    """Return the kinds of members that are judged on a site."""
    odd = bool(zlib.crc32(site.encode()) % 2)
    return [kind for kind in KINDS if (kind in TAPERING) != odd]


def stand(target: Target) -> None:
    """Hold the verdicts against stacks under one component of each site, whose rows are written as they come."""
    rows: list[StackRow] = []
    for component in one_of_each(independent(target.records)):
        kinds = judged_kinds(component.site)
        trials = (stack_row(component, kind, k) for kind in kinds for k in range(TRIALS[kind]))
        rows += target.kept(StackRow, component.identifier, trials)
        target.tell(f"{component.identifier}: {len(rows)} trials")
    subtitle = "Members in courses and walls whose contacts open, on sites that took no part in the rule."
    target.publish("Who stands", subtitle, {StackRow: rows, scores.Score: list(stack_scores(rows))})


def stack_row(component: SiteRecord, kind: str, place: int) -> StackRow:
    """Return one trial: member, scale and courses drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, CAMPAIGN, KINDS.index(kind), place)
    case = DRAWN[kind](draw)
    factor = lifting_factor(record, case.multiplier, UPLIFTS, draw)
    motion = strong_part(record.scaled(factor), case.multiplier)
    courses = int(draw.choice(COURSES))
    started = process_time()
    facts, limits = case.facts(motion)
    spent = process_time() - started
    mechanism, without, verdict = words_of(facts, limits)
    stack_falls, stack_runs = facts.stacks or (None, None)
    stack = case.stack(courses)
    response = follow_stack(stack, motion, TRUE_STEP)
    height = stack.courses[response.opened].base
    return StackRow(
        **component.named,
        structure=kind,
        scale_factor=factor,
        courses=courses,
        velocity_ratio_s=peak_velocity(motion) / motion.peak_acceleration,
        mechanism=mechanism,
        warning="; ".join(str(limit.warning) for limit in limits if limit.is_untold),
        without=without,
        verdict=verdict,
        stack_falls=stack_falls,
        stack_runs=stack_runs,
        falls=response.falls,
        turn_rad=float(response.largest_turns.max()),
        opened=response.opened,
        opened_height_m=height,
        opened_at_storey=case.begins_storey(height),
        contact_s=spent,
    )


def strong_part(motion: Accelerogram, multiplier: float) -> Accelerogram:
    """Return the motion where it exceeds STRONG of what lifts, with MARGIN before and after."""
    strong = np.flatnonzero(np.abs(motion.acceleration) >= STRONG * multiplier * GRAVITY)
    beside = round(MARGIN / motion.time_step)
    span = slice(max(strong[0] - beside, 0), strong[-1] + beside + 1)
    return replace(motion, acceleration=motion.acceleration[span])


def stack_scores(rows: Sequence[StackRow]) -> Iterator[scores.Score]:
    """Yield errors and open cases by kind of member and of all, with intervals by earthquake."""
    every = pd.DataFrame(rows)
    for kind, own in [("all", every), *every.groupby("structure", sort=False)]:
        open_without, open_with = (
            ~own[name].map(lambda word: word.is_sure) for name in ("without", "verdict")
        )
        settled = open_without & ~open_with
        right = (own.verdict == Verdict.OVERTURNS) == own.falls
        lifts = own.turn_rad > LIFTED
        stands, overturns = own.verdict == Verdict.STANDS, own.verdict == Verdict.OVERTURNS
        between = own.opened_at_storey.eq(False) & lifts
        for measure, part, values in (
            ('falls among "stands" by mechanisms', own.mechanism == Verdict.STANDS, own.falls),
            ('falls among "stands" without contact dynamics', own.without == Verdict.STANDS, own.falls),
            ('falls among "stands" with it', stands, own.falls),
            ('falls among "stands" with it whose stack lifts', stands & lifts, own.falls),
            ("trials whose stack lifts", own.falls.notna(), lifts),
            (
                "stacks of storeys that open most between two feet",
                own.opened_at_storey.notna() & lifts,
                between,
            ),
            ('falls among "stands" with it that open most between two feet', stands & between, own.falls),
            ('survivals among "overturns" with it that open so', overturns & between, ~own.falls),
            ('survivals among "overturns" with it', overturns, ~own.falls),
            ("open without contact dynamics", own.falls.notna(), open_without),
            ("open with it", own.falls.notna(), open_with),
            ("open that contact dynamics settles", open_without, settled),
            ("right among those that it settles", settled, right),
        ):
            if part.any():
                yield from scores.scored(
                    "contact dynamics",
                    str(kind),
                    {measure: values[part].astype(float).tolist()},
                    sample_of(own.site[part], own.earthquake[part]),
                )
