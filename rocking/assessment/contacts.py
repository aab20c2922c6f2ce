"""Contacts: where one degree of freedom does not tell whether a structure stands, and what contact dynamics then says.

A mechanism keeps its contacts closed and lets all of them land at once. Where a contact would have to pull, bodies
bounce; and courses that stand on a rocking body are thrown by its impacts, which no multiple of the ground's motion
bounds (theory: section 11). "Stands" is then not said.
"""

import math
from collections.abc import Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rocking.assessment.cores import in_order
from rocking.assessment.decide import UNANIMOUS, Verdict
from rocking.assessment.decide import step as step_of
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.contacts.dynamics import follow_stack
from rocking.errors import RockingError
from rocking.records import Accelerogram
from rocking.signal.measures import peak_velocity
from rocking.structures import Structure
from rocking.structures.leaves import parts_of
from rocking.structures.stack import COURSES, STEP, Stack
from rocking.structures.stones import Stones

AMPLITUDES = (0.9, 1.1)
"""Least and largest factor on the motion at which contact dynamics follows a case: its steps are of first order, so
that near a limit its outcome is a draw, which several amplitudes show."""
RUNS = 24
"""Runs of contact dynamics of a case that cannot be told otherwise: none may fall of so few, and it probably stands."""
MOST_RUNS = UNANIMOUS
"""Runs with fidelity: contact, none of which falls where the verdict is "stands"."""
STEPS = (*7 * (STEP,), STEP / 2)
"""Time steps of contact dynamics, s, which its runs take in turn: every eighth one at a finer step."""
GOLDEN = (math.sqrt(5) - 1) / 2
"""Multiples of it, modulo 1, put the runs in an order of which every beginning lies evenly among all."""


def directions(motions: GroundMotions) -> list[tuple[str, str]]:
    """Return the key of the motion of each direction, in the first of its processings."""
    first: dict[str, tuple[str, str]] = {}
    for direction, processing in motions.horizontal:
        first.setdefault(direction, (direction, processing))
    return list(first.values())


def signs(structure: Structure, settings: AssessmentSettings) -> tuple[float, ...]:
    """Return both signs of the motion where the sides differ and the sign varies."""
    return (1.0,) if structure.symmetric or not settings.ensemble.polarity else (1.0, -1.0)


MANY_COURSES = 12
"""Courses of the second stack of a tapering member that does not say how many it has."""


@dataclass(frozen=True, kw_only=True)
class ContactShare:
    """The number of stacks of courses, or of chains of stones, that fall, of those that contact dynamics followed.

    falls, runs: over amplitudes, time steps, directions and signs, as far as they were followed; 0 of one rigid body
    and of what cannot be laid.
    """

    falls: int = 0
    runs: int = 0


@lru_cache(maxsize=256)
def stackable(structure: Structure) -> bool:
    """Whether contact dynamics can follow a structure: between several courses or stones joints open.

    Of a wall whose leaves may part, all of them together and each of them.
    """
    numbers = [_courses_of(part) for _, part in parts_of(structure)]
    return all(numbers) and max(numbers) > 1


def _courses_of(structure: Structure) -> int:
    """In how many courses or stones it is laid; 0 of what is none."""
    try:
        return _laid(structure)[0].count
    except RockingError:
        return 0


@dataclass(frozen=True, eq=False)
class Draw:
    """One run of contact dynamics: a stack or stones, a signed amplitude of one motion, and a time step, s."""

    stack: Stack | Stones
    motion: Accelerogram
    vertical: Accelerogram | None
    amplitude: float
    step: float

    @property
    def strength(self) -> float:
        """The peak velocity of its motion, by which it is expected to fall, m/s."""
        return abs(self.amplitude) * peak_velocity(self.motion)

    def falls(self, factor: float = 1.0) -> bool:
        """Return whether it falls under the motion times a factor, the vertical one with it."""
        vertical = None if self.vertical is None else self.vertical.scaled(factor)
        return _falls(self.stack, self.motion.scaled(factor).scaled(self.amplitude), self.step, vertical)


def contact_share(
    structure: Structure,
    motions: GroundMotions,
    settings: AssessmentSettings | None = None,
    runs: int = RUNS,
    *,
    until_sure: bool = True,
) -> ContactShare:
    """Return how many stacks of the structure fall, of a wall whose leaves may part those of the part that falls most.

    Of a part that is one body its mechanism says more. until_sure: whether runs end once the rest cannot change the
    verdict; the share of all is asked else.
    """
    settings = settings or AssessmentSettings()
    worst = ContactShare()
    with suppress(RockingError):
        for draws in draws_of_parts(structure, motions, settings, runs):
            own = _share_of(draws, settings, until_sure)
            if not worst.runs or own.falls * worst.runs > worst.falls * own.runs:
                worst = own
    return worst


def _share_of(draws: Sequence[Draw], settings: AssessmentSettings, until_sure: bool) -> ContactShare:
    """Return how many draws of one part fall, as far as they are followed."""
    falls = followed = 0

    def verdict_of(count: int) -> Verdict:
        return step_of(falls=count, members=len(draws), risk=settings.ensemble.risk)

    with closing(in_order(Draw.falls, draws)) as runs_in_order:
        for followed, it_falls in enumerate(runs_in_order, start=1):
            falls += it_falls
            if until_sure and verdict_of(falls) == verdict_of(falls + len(draws) - followed):
                break
    return ContactShare(falls=falls, runs=followed)


def draws_of_parts(
    structure: Structure, motions: GroundMotions, settings: AssessmentSettings, runs: int
) -> list[list[Draw]]:
    """Return the draws of each part that is more than one body. Raises RockingError for one that cannot be laid."""
    laid = [(part, _laid(part)) for _, part in parts_of(structure)]
    return [_draws(part, stacks, motions, settings, runs) for part, stacks in laid if stacks[0].count > 1]


def _draws(
    structure: Structure,
    stacks: Sequence[Stack | Stones],
    motions: GroundMotions,
    settings: AssessmentSettings,
    runs: int,
) -> list[Draw]:
    """Return the draws of one part, between AMPLITUDES and at STEPS.

    Every direction of a pair, of unlike sides every other one with both signs of the motion, is followed at as many
    amplitudes, at which steps and stacks take turns: so that there are `runs` in all. The bodies are those of the
    mechanism where the crack is known and nothing holds it, else the courses that `Structure.stack` gives; a tapering
    member that does not state its courses is followed with COURSES and MANY_COURSES in turn. An arch or a portal is
    followed as its stones.
    """
    both = signs(structure, settings)
    every = [motions.horizontal[direction] for direction in directions(motions)[:: len(both)]]
    ways = [(motion, sign) for motion in sorted(every, key=peak_velocity, reverse=True) for sign in both]
    amplitudes = np.linspace(*AMPLITUDES, max(math.ceil(runs / len(ways)), 2))[::-1]
    strongest_first = []
    for turn, amplitude in enumerate(amplitudes.tolist()):
        for way, (motion, sign) in enumerate(ways):
            # Each stack meets every step in turn.
            number, place = divmod(turn + way, len(stacks))
            stack, step = stacks[place], STEPS[number % len(STEPS)]
            short_enough = min(step, stack.longest_step * step / STEP)
            strongest_first.append(Draw(stack, motion, motions.vertical, sign * amplitude, short_enough))
    # As many of them as are followed lie evenly among all: the share of the strongest alone would be too large.
    order = sorted(range(len(strongest_first)), key=lambda place: place * GOLDEN % 1.0)
    return [strongest_first[place] for place in order[:runs]]


def _laid(structure: Structure) -> Sequence[Stack | Stones]:
    """What is to be followed: the stones of an arch, and else stacks.

    Where a member tapers and does not say how many courses it has, these are of a few and of many: the more courses,
    the smaller is the topmost one, which is thrown first. All are on its joints; where a top states a lower friction,
    they keep that.
    """
    friction = structure.joints.friction
    if structure.joints.as_stones:
        return [replace(structure.stones(), friction=friction)]
    by_size = structure.joints.courses_taper and not structure.joints.courses_are_given
    stacks = [structure.stack(courses) for courses in ((COURSES, MANY_COURSES) if by_size else (None,))]
    return [replace(stack, friction=min(stack.friction, friction)) for stack in stacks]


def _falls(stack: Stack | Stones, motion: Accelerogram, step: float, vertical: Accelerogram | None) -> bool:
    return follow_stack(stack, motion, step, vertical=vertical).falls
