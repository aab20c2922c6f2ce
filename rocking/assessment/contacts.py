"""Contacts: where one degree of freedom does not tell whether a structure stands, and what contact dynamics then says.

A mechanism keeps its contacts closed and lets all of them land at once. Where a contact would have to pull, bodies
bounce; and courses that stand on a rocking body are thrown by its impacts, which no multiple of the ground's motion
bounds (theory: section 11). "Stands" is then not said.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from typing import Protocol

import numpy as np

from rocking.assessment.cores import in_order
from rocking.assessment.cracks import weakest_not_followed
from rocking.assessment.decide import BEYOND, UNANIMOUS
from rocking.assessment.decide import step as step_of
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.contacts.dynamics import STEP, follow_stack
from rocking.contacts.dynamics import expected_seconds as seconds_of_run
from rocking.errors import RockingError
from rocking.floors.place import swinging
from rocking.motion.integration import Members, integrate, integrate_members, strict
from rocking.motion.response import check_model
from rocking.records import Accelerogram
from rocking.remarks import Remark
from rocking.signal.measures import peak_velocity
from rocking.structures import Structure
from rocking.structures.joints import Joints
from rocking.structures.linkage import Turning
from rocking.structures.stack import COURSES, Stack
from rocking.structures.stones import Stones
from rocking.structures.tied import Tied

AMPLITUDES = (0.9, 1.1)
"""Least and largest factor on the motion at which contact dynamics follows a case: its steps are of first order, so
that near a limit its outcome is a draw, which several amplitudes show."""
RUNS = 24
"""Runs of contact dynamics of a case that cannot be told otherwise: none may fall of so few, and it probably stands."""
MOST_RUNS = UNANIMOUS
"""Runs with fidelity: contact, none of which falls where the word is "stands"."""
LEAST_KEPT = 0.3
"""Restitution by the balance of momentum below which joints close one after the other (theory: section 11)."""
STEPS = (*7 * (STEP,), STEP / 2)
"""Time steps of contact dynamics, s, which its runs take in turn: every eighth one at a finer step."""


class Laid(Protocol):
    """A member that can be laid in rigid courses; see `Structure` for each of these."""

    @property
    def joints(self) -> Joints:
        """Its joints."""

    @property
    def symmetric(self) -> bool:
        """Whether both sides are alike."""

    @property
    def tapers(self) -> bool:
        """Whether its courses grow smaller upwards."""

    @property
    def courses_are_given(self) -> bool:
        """Whether it says how many courses it has."""

    def stack(self, courses: int | None = None) -> Stack:
        """Return it as rigid courses."""


def doubt(
    structure: Structure,
    motions: GroundMotions,
    rotation_ratio: float,
    settings: AssessmentSettings | None = None,
    bounces: bool | None = None,
    of_leaves: Mapping[str, float] | None = None,
) -> Remark | None:
    """Return why a structure may be worse off than as a mechanism; None where nothing speaks for it.

    rotation_ratio: the largest of its runs. bounces: whether a contact opens in the run as recorded, where that is
    known. First where the mechanism of least λ cannot be followed, and the motion at its largest amplitude reaches that
    λ; the doubts that follow are of what rocks. Of the members those are asked that land fastest: with the crack that
    statics chooses, in every direction and sign, at the largest amplitude; what cannot be followed there is in doubt,
    too. Where the balance of momentum keeps less than LEAST_KEPT of the velocity, the impact itself opens contacts.
    What rests has no contact to open; a single body on the ground lands too slowly below a fall of more than a radian;
    and the bulge of a wall that is held has row 8b of the decision instead, with `ties_give`: what they let stand did
    not fall as a stack (docs, validation). Of a wall whose leaves may part each of these is asked, too; of_leaves: the
    largest rotation ratio of each.
    """
    own = _doubt_of_part(structure, motions, rotation_ratio, settings or AssessmentSettings(), bounces)
    ratios = of_leaves or {}
    of_each = (
        doubt(leaf, motions, ratios.get(name, rotation_ratio), settings)
        for name, leaf in structure.leaves_alone
    )
    return own or next((reason for reason in of_each if reason is not None), None)


def _doubt_of_part(
    structure: Structure,
    motions: GroundMotions,
    rotation_ratio: float,
    settings: AssessmentSettings,
    bounces: bool | None,
) -> Remark | None:
    """Return why one part may be worse off than as a mechanism; None where nothing speaks for it."""
    unknown = weakest_not_followed(structure)
    reached = motions.excitation * (1 + settings.ensemble.amplitude_range)
    if unknown is not None and reached > unknown.uplift_multiplier:
        return Remark(AssessmentKind.NOT_FOLLOWED)
    if not rotation_ratio > 0:
        return None
    if structure.tapers:
        return Remark(AssessmentKind.COURSES_THROWN)
    if rotation_ratio <= NEGLIGIBLE:
        return None
    if bounces:
        return Remark(AssessmentKind.CONTACTS_OPEN)
    candidates = [candidate.structure for candidate in structure.candidates() if not candidate.part]
    bulges = [wall for wall in candidates if isinstance(wall, Tied) and wall.opening]
    first = [body for body in candidates if body not in bulges][:1]
    asked = [body for body in first if not all(isinstance(part, Turning) for part in body.linkages)]
    for body, sign, direction in product(asked, _signs(structure, settings), _directions(motions)):
        strongest = motions.horizontal[direction].scaled(sign * (1 + settings.ensemble.amplitude_range))
        if _opens(body, strongest, motions.vertical, strict(settings.tolerance)):
            return Remark(AssessmentKind.CONTACTS_OPEN)
    return Remark(AssessmentKind.IMPACT_OPENS) if any(map(_keeps_little, [*asked, *bulges])) else None


def _keeps_little(structure: Structure) -> bool:
    """Whether its balance of momentum keeps less than LEAST_KEPT of the velocity at an impact."""
    if structure.restitution_is_typed:
        return False
    return any(side.restitution < LEAST_KEPT for side in structure.mechanism().sides)


def ties_give(structure: Structure, motions: GroundMotions, settings: AssessmentSettings) -> bool:
    """Whether a wall turns beyond BEYOND under the motion that its ties let through.

    Its mechanisms stand on ties and lean on them as if these did not stretch. Until it cracks, such a wall swings on
    them as one body, and its bulge is shaken by the absolute acceleration of that oscillator: the bulge of least λ that
    a tie holds or bears is followed under it, with both signs of every direction. What cannot be followed counts. So is
    each leaf that may part.
    """
    if any(ties_give(leaf, motions, settings) for _, leaf in structure.leaves_alone):
        return True
    if not isinstance(structure, Tied) or not structure.tie_period:
        return False
    bulge = next(
        (candidate.structure for candidate in structure.mechanisms() if structure.hangs_on_ties(candidate)),
        None,
    )
    if bulge is None:
        return False
    both = Members(1 + settings.ensemble.amplitude_range, polarity=[1.0, -1.0])
    for motion in (motions.horizontal[direction] for direction in _directions(motions)):
        # Below two samples of the record it cannot be distinguished from one that moves with the ground.
        period = structure.tie_period if structure.tie_period >= 2 * motion.time_step else 0.0
        through_ties = swinging(period).motion(motion)
        try:
            followed = integrate_members(bulge, through_ties, both, strict(settings.tolerance))
        except RockingError:
            return True
        if not (followed.rotation_ratio <= BEYOND).all():
            return True
    return False


def friction_needed(
    bodies: Iterable[Structure], motions: GroundMotions, settings: AssessmentSettings
) -> float:
    """Return the friction coefficient that a contact of the mechanisms needs where it has less; nan where none does.

    bodies: the structure with each crack that is asked. Followed as recorded in every direction and sign, at every
    sample at which they rock below the critical rotation; inf where nothing presses a contact there. What cannot be
    followed, or has contacts of which nothing is known, says nothing.
    """
    largest = math.nan
    for body, direction in product(bodies, _directions(motions)):
        motion = motions.horizontal[direction]
        for sign in _signs(body, settings):
            acting = motion.scaled(sign)
            with suppress(RockingError):
                response = integrate(
                    body, acting, settings.tolerance, history=True, vertical=motions.vertical
                )
                check = check_model(body, response, acting, motions.vertical)
                if check.slides(body.joints.friction):
                    largest = float(np.fmax(largest, check.required_friction))
    return largest


def _directions(motions: GroundMotions) -> list[tuple[str, str]]:
    """The key of the motion of each direction, in the first of its processings."""
    first: dict[str, tuple[str, str]] = {}
    for direction, processing in motions.horizontal:
        first.setdefault(direction, (direction, processing))
    return list(first.values())


def _signs(structure: Laid, settings: AssessmentSettings) -> tuple[float, ...]:
    """Both signs of the motion where the sides differ and the sign varies."""
    return (1.0,) if structure.symmetric or not settings.ensemble.polarity else (1.0, -1.0)


def _opens(
    structure: Structure, motion: Accelerogram, vertical: Accelerogram | None, tolerance: float
) -> bool:
    """Whether a contact would have to pull, or the motion cannot be followed, so that nobody knows."""
    try:
        response = integrate(structure, motion, tolerance, history=True, vertical=vertical)
    except RockingError:
        return True
    return check_model(structure, response, motion, vertical).bounces is True


MANY_COURSES = 12
"""Courses of the second stack of a tapering member that does not say how many it has."""


@dataclass(frozen=True, kw_only=True)
class ContactShare:
    """The number of stacks of courses, or of chains of stones, that fall, of those that contact dynamics followed.

    falls, runs: over amplitudes, time steps, directions and signs, the strongest motions first, as far as they were
    followed. reason: why none was; "" where they were.
    """

    falls: int = 0
    runs: int = 0
    reason: str = ""

    @property
    def words(self) -> str:
        """Their count in words."""
        return f"{self.falls} of {self.runs} runs of contact dynamics fall" if self.runs else self.reason


@lru_cache(maxsize=256)
def stackable(structure: Laid) -> bool:
    """Whether contact dynamics can follow a structure: between several courses or stones joints open.

    Of a wall whose leaves may part, all of them together and each of them.
    """
    numbers = [_courses_of(part) for part in _parts(structure)]
    return all(numbers) and max(numbers) > 1


def _courses_of(structure: Laid) -> int:
    """In how many courses or stones it is laid; 0 of what is none."""
    try:
        return _laid(structure)[0].count
    except RockingError:
        return 0


def _parts(structure: Laid) -> list[Laid]:
    """What falls by itself."""
    return [structure, *(leaf for _, leaf in getattr(structure, "leaves_alone", ()))]


def contact_share(
    structure: Laid, motions: GroundMotions, settings: AssessmentSettings | None = None, runs: int = RUNS
) -> ContactShare:
    """Return how many stacks of the structure fall, of a wall whose leaves may part those of the part that falls most.

    Of a part that is one body its mechanism says more.
    """
    parts = _parts(structure)
    laid = [part for part in parts if len(parts) == 1 or _courses_of(part) != 1]
    worst = ContactShare(reason="one rigid body moves as its mechanism does, whose members say more")
    for part in laid:
        share = _share_of(part, motions, settings or AssessmentSettings(), runs)
        if not share.runs:
            return share
        if not worst.runs or share.falls * worst.runs > worst.falls * share.runs:
            worst = share
    return worst


def _share_of(
    structure: Laid, motions: GroundMotions, settings: AssessmentSettings, runs: int
) -> ContactShare:
    """Return how many stacks of one part fall, between AMPLITUDES and at STEPS.

    Every direction of a pair, of unlike sides every other one with both signs of the motion, is followed at as many
    amplitudes, at which steps and stacks take turns: so that there are `runs` in all. The strongest come first, and no
    more are followed once the rest cannot change the word. The bodies are those of the mechanism where the crack is
    known and nothing holds it, else the courses that `Structure.stack` gives; a tapering member that does not state its
    courses is followed with COURSES and MANY_COURSES in turn. An arch or a portal is followed as its stones.
    """
    signs = _signs(structure, settings)
    directions = [motions.horizontal[direction] for direction in _directions(motions)[:: len(signs)]]
    ways = [
        (motion, sign) for motion in sorted(directions, key=peak_velocity, reverse=True) for sign in signs
    ]
    amplitudes = np.linspace(*AMPLITUDES, max(runs // len(ways), 1))[::-1]
    cases = [
        (amplitude, motion, sign, turn + way)
        for turn, amplitude in enumerate(amplitudes.tolist())
        for way, (motion, sign) in enumerate(ways)
    ]
    falls = followed = 0
    try:
        stacks = _laid(structure)
        if stacks[0].count == 1:
            return ContactShare(reason="one rigid body moves as its mechanism does, whose members say more")

        def falls_in(case: tuple[float, Accelerogram, float, int]) -> bool:
            amplitude, motion, sign, place = case
            # Each stack meets every step in turn.
            stack = stacks[place % len(stacks)]
            step = STEPS[place // len(stacks) % len(STEPS)]
            short_enough = min(step, stack.longest_step * step / STEP)
            return _falls(stack, motion.scaled(sign * amplitude), short_enough, motions.vertical)

        with closing(in_order(falls_in, cases)) as runs_in_order:
            for followed, it_falls in enumerate(runs_in_order, start=1):
                falls += it_falls
                left = len(cases) - followed
                words = [
                    step_of(falls=count, members=len(cases), risk=settings.ensemble.risk)
                    for count in (falls, falls + left)
                ]
                if words[0] is words[1]:
                    break
    except RockingError as error:
        return ContactShare(reason=str(error))
    return ContactShare(falls=falls, runs=followed)


def expected_seconds(
    structure: Structure, components: Sequence[Accelerogram], settings: AssessmentSettings
) -> float:
    """Return the processor time of contact dynamics of a structure, should it be asked, s; 0 where it never is.

    components: the horizontal ones of a record, in place of the directions between them.
    """
    if settings.fidelity == "quick" or not stackable(structure):
        return 0.0
    runs = MOST_RUNS if settings.fidelity == "contact" else RUNS
    once = [
        seconds_of_run(stack, motion, min(step, stack.longest_step * step / STEP))
        for part in _parts(structure)
        for stack in _laid(part)
        for motion in components
        for step in STEPS
    ]
    return runs * float(np.mean(once)) * len(_parts(structure))


def _laid(structure: Laid) -> Sequence[Stack | Stones]:
    """What is to be followed: the stones of an arch, and else stacks.

    Where a member tapers and does not say how many courses it has, these are of a few and of many: the more courses,
    the smaller is the topmost one, which is thrown first. All are on its joints; where a top states a lower friction,
    they keep that.
    """
    friction = structure.joints.friction
    if isinstance(structure, Structure) and structure.as_stones:
        return [replace(structure.stones(), friction=friction)]
    by_size = structure.tapers and not structure.courses_are_given
    stacks = [structure.stack(courses) for courses in ((COURSES, MANY_COURSES) if by_size else (None,))]
    return [replace(stack, friction=min(stack.friction, friction)) for stack in stacks]


def _falls(stack: Stack | Stones, motion: Accelerogram, step: float, vertical: Accelerogram | None) -> bool:
    return follow_stack(stack, motion, step, vertical=vertical).falls
