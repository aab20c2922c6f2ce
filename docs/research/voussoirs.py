"""Arches, arches on piers and portals as stones: does what is said to stand fall as another chain of stones?

Arches with and without fill, with the voussoirs that they state or without, arches on piers and frames of two columns
are drawn, and each stands under a real motion. What is said to stand, or probably to, by the package or by its
mechanism alone, is followed as stones of other numbers and at finer steps than `fidelity: contact` takes. Of arches
whose mechanism does not stand, on joints of several frictions, the runs of a study are held beside such stones. Nothing
was chosen on these. A share of them LMGC90 follows as well, below and above the level at which they fall.
"""

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import product
from typing import Any, Literal

import numpy as np
import pandas as pd

from docs.research import scores
from docs.research.comparison.bodies import RigidBodies, properties, rectangle
from docs.research.comparison.bodies import rigid_bodies as bodies_of_voussoirs
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
    timed,
)
from docs.research.stacks import strong_part
from rocking import Arch, ArchOnPiers, Block, Frame, Verdict, assess
from rocking.assessment.contacts import contact_share
from rocking.assessment.decide import Facts, decide
from rocking.assessment.ensemble import ensemble
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.contacts.dynamics import follow_stack
from rocking.errors import RockingError, StructureError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures.joints import USUAL, Joints
from rocking.structures.stones import Stone, Stones
from rocking.tables import column, row

CAMPAIGN = 14
"""Structures and scales are drawn anew for each campaign."""
TRIALS = {"arch": 8, "arch on piers": 2, "frame of two columns": 3}
"""Under one component of each site."""
ON_FRICTION = ("arch", "arch on piers", "arch", "arch")
"""Under one component of each site: on FRICTIONS in turn, first the one whose turn it is at the site."""
FRICTIONS = (0.4, 0.5, 0.6)
LIMITS = 1.3 * 1.15 ** np.arange(16)
"""Peak acceleration over that of uplift at which the level is sought at which the mechanism no longer stands."""
BEYOND = (1.0, 1.1)
"""That level is multiplied by, so that stones stand in some cases and fall in others."""
UPLIFTS = {"arch": (1.1, 3.0), "arch on piers": (1.1, 3.0), "frame of two columns": (1.1, 5.0)}
"""Ranges of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""
MOST = 1.5
"""Largest peak acceleration, over g."""
TRUE_RUNS = ((15, 3e-4, 1.0), (29, 2.5e-4, 1.02), (12, 2e-4, 0.98))
"""Voussoirs of an arch that does not state them, time step [s] and factor on the motion of each true run."""
LIFTED = 1e-4
"""Turn of a stone beyond which the true stones have lifted, rad."""
DRAWS = 40
"""Draws of which one has to stand at rest."""
STANDING = (Verdict.STANDS, Verdict.PROBABLY_STANDS)

CHECKED = 12
"""Arches that LMGC90 follows, each under one component of another site."""
ON_PIERS = 4
"""Every so many of them stands on piers."""
SHARES = (0.9, 1.1)
"""Of the level at which the stones fall, at which it follows them."""
LEVELS = 1.05 * 1.04 ** np.arange(90)
"""Peak acceleration over that of uplift at which that level is sought."""
CHECKED_SECONDS = 8.0
"""Length of the stretch of a record that it is given, s."""
CHECKED_STEP = 1e-3
"""Its time step, s; that of the package is half of it."""
TIMEOUT = 600.0
"""Seconds that one run of it may take."""


@row("voussoirs", "One row per structure and component: what the package says, and the true stones")
class StonesTrial(Trial):
    """One trial."""

    voussoirs: int | None = column("Voussoirs that the arch states; empty: none")
    fill_m: float = column("Depth of its fill at the crown, m; empty: without")
    multiplier: float = column("Uplift multiplier: ground acceleration over g")
    verdict: Verdict = column("Verdict of the package")
    mechanism: Verdict = column("What its mechanism says without contact dynamics")
    stack_falls: int | None = column("Chains of stones that fall in contact dynamics; empty: not asked")
    stack_runs: int | None = column("Chains of stones that contact dynamics followed")
    true_falls: int | None = column("True chains of stones that fall; empty: neither word is of standing")
    true_runs: int | None = column("True chains of stones that were followed")
    turn_rad: float = column("Largest turn of a stone of these, as far as it was followed, rad")
    verdict_s: float = column("CPU time of the verdict, s")


@row(
    "disagreements",
    "One row per arch whose mechanism does not stand: the runs of a study, and the true stones",
)
class DisagreementTrial(Trial):
    """One trial. The record is that stretch of it which LMGC90 is given, too."""

    friction: float = column("Friction of its joints")
    voussoirs: int | None = column("Voussoirs that the arch states; empty: none")
    multiplier: float = column("Uplift multiplier: ground acceleration over g")
    mechanism: Verdict = column("What the members of its mechanism say")
    member_falls: int = column("Members that overturn, of the number in the settings")
    verdict: Verdict = column("What they and the chains of stones of a study say")
    stack_falls: int = column("Chains of stones of a study that fall in contact dynamics")
    stack_runs: int = column("Chains of stones that contact dynamics followed")
    true_falls: int = column("True chains of stones that fall")
    true_runs: int = column("True chains of stones that were followed")


@row("lmgc90", "One row per arch and level of its motion, near that at which it falls as stones")
class CheckedTrial(Trial):
    """One run of both codes."""

    voussoirs: int = column("Number of voussoirs")
    share: float = column("Level over that at which the stones fall")
    falls: bool = column("Whether the stones fall in the package")
    falls_in_lmgc90: bool | None = column("Whether they fall in LMGC90; empty: no answer")
    turn_rad: float = column("Largest turn of a stone in the package, rad")
    turn_in_lmgc90_rad: float = column("Largest turn of a stone in LMGC90, rad")
    run_s: float = column("CPU time of the run of the package, s")
    run_in_lmgc90_s: float = column("CPU time of the run of LMGC90, s")
    reason: str = column("Why LMGC90 gave no answer")


def arch(draw: np.random.Generator) -> Arch:
    """Half of them state their voussoirs, a quarter bears fill."""
    radius = float(draw.uniform(3, 15))
    return Arch(
        radius,
        float(draw.uniform(0.08, 0.2)) * radius,
        float(np.radians(draw.uniform(100, 180))),
        int(draw.integers(7, 28)) if draw.random() < 0.5 else None,
        fill_depth=float(draw.uniform(0, 0.1)) * radius if draw.random() < 0.25 else None,
    )


def arch_on_piers(draw: np.random.Generator) -> ArchOnPiers:
    """On piers of 0.4 to 1.6 of its radius, a quarter to a half as wide."""
    radius = float(draw.uniform(2, 6))
    height = float(draw.uniform(0.4, 1.6)) * radius
    return ArchOnPiers(
        radius,
        float(draw.uniform(0.1, 0.2)) * radius,
        float(np.radians(draw.uniform(130, 180))),
        int(draw.integers(7, 22)) if draw.random() < 0.5 else None,
        pier_width=float(draw.uniform(0.25, 0.5)) * height,
        pier_height=height,
    )


def portal(draw: np.random.Generator) -> Frame:
    """Two columns of a slenderness of 1 to 8 to 1 to 3, under a beam."""
    height = float(draw.uniform(3, 10))
    column_of = Block.of_size(float(draw.uniform(0.12, 0.33)) * height, height)
    return Frame(column_of, 2, float(draw.uniform(0.2, 2.0)))


DRAWN: dict[str, Callable[[np.random.Generator], Arch | Frame]] = {
    "arch": arch,
    "arch on piers": arch_on_piers,
    "frame of two columns": portal,
}


def drawn(kind: str, draw: np.random.Generator, joints: Joints = USUAL) -> Arch | Frame:
    """Return the first structure drawn that stands and rocks below MOST. Raises StructureError where none does."""
    for _ in range(DRAWS):
        try:
            structure = DRAWN[kind](draw).on_joints(joints)
        except StructureError:
            continue  # drawn so that it does not stand at rest
        if 0.02 < structure.static_multiplier < MOST / UPLIFTS[kind][0]:
            return structure
    raise StructureError(f"none of {DRAWS} draws of the kind {kind!r} stands; draw it in other sizes.")


def voussoirs(target: Target) -> None:
    """Hold what is said of arches and portals against true stones, whose rows are written as they come."""
    components = one_of_each(independent(target.records))
    trials: list[StonesTrial] = []
    for kind in TRIALS:
        for component in components:
            trials += target.kept(
                StonesTrial, f"{component.identifier} {kind}", stones_trials(component, kind)
            )
        own = [trial.verdict for trial in trials if trial.structure == kind]
        target.tell(f"{kind}: {len(own)} trials, {own.count(Verdict.STANDS)} stand")
    apart: list[DisagreementTrial] = []
    for place, component in enumerate(components):
        name = f"{component.identifier} on its joints"
        apart += target.kept(DisagreementTrial, name, disagreement_trials(component, place))
        target.tell(f"{component.identifier}: {len(apart)} arches whose mechanism does not stand")
    checks: list[CheckedTrial] = []
    for place, component in enumerate(components[:CHECKED]):
        name = f"{component.identifier} in LMGC90"
        checks += target.kept(CheckedTrial, name, checked_trials(component, place))
        target.tell(f"{component.identifier}: {len(checks)} runs of LMGC90")
    subtitle = "Arches, arches on piers and frames of two columns, beside other chains of stones and LMGC90."
    found = [*stones_scores(trials), *disagreement_scores(apart), *checked_scores(checks)]
    tables: Tables = {
        StonesTrial: trials,
        DisagreementTrial: apart,
        CheckedTrial: checks,
        scores.Score: found,
    }
    target.publish("Stones", subtitle, tables)


def stones_trials(component: SiteRecord, kind: str) -> Iterator[StonesTrial]:
    """Yield the trials of one kind under one component."""
    for place in range(TRIALS[kind]):
        yield stones_trial(component, kind, place)


def stones_trial(component: SiteRecord, kind: str, place: int) -> StonesTrial:
    """Return one trial: structure and scale drawn."""
    record = component.accelerogram
    draw = draw_of(component.identifier, CAMPAIGN, list(TRIALS).index(kind), place)
    structure = drawn(kind, draw)
    multiplier = structure.static_multiplier
    least, most = UPLIFTS[kind]
    motion = record.scaled(lifting_factor(record, multiplier, (least, min(most, MOST / multiplier)), draw))
    motion = strong_part(motion, multiplier)
    # An arch alone is followed as stones where its mechanism does not stand; of the others only these say it.
    fidelity: Literal["standard", "contact"] = "standard" if kind == "arch" else "contact"
    settings = AssessmentSettings(fidelity=fidelity, ensemble=EnsembleSettings(reserve=0))
    assessed, spent = timed(lambda: assess(motion, structure, settings=settings))
    (case,) = assessed.cases.values()
    facts = case.facts(structure)
    mechanism = decide(replace(facts, stacks=None, stackable=False)).verdict
    falls: list[bool] = []
    turns = [0.0]
    if assessed.verdict in STANDING or mechanism in STANDING:
        for stones, step, amplitude in true_stones(structure):
            response = follow_stack(stones, motion.scaled(amplitude), min(step, stones.longest_step))
            falls.append(response.falls)
            turns.append(float(response.largest_turns.max()))
    stack_falls, stack_runs = facts.stacks or (None, None)
    return StonesTrial(
        **component.named,
        structure=kind,
        scale_factor=float(motion.peak_acceleration / record.peak_acceleration),
        voussoirs=getattr(structure, "voussoirs", None),
        fill_m=_or_none(getattr(structure, "fill_depth", None)),
        multiplier=multiplier,
        verdict=assessed.verdict,
        mechanism=mechanism,
        stack_falls=stack_falls,
        stack_runs=stack_runs,
        true_falls=sum(falls) if falls else None,
        true_runs=len(falls) or None,
        turn_rad=max(turns),
        verdict_s=spent,
    )


def _or_none(value: float | None) -> float:
    return np.nan if value is None else value


def true_stones(structure: Arch | Frame) -> Iterator[tuple[Stones, float, float]]:
    """Yield the true stones of each run, its time step [s] and its factor on the motion.

    Where an arch states its voussoirs, or a frame has none, they differ in step and factor alone.
    """
    states = isinstance(structure, Frame) or structure.voussoirs is not None
    for number, step, amplitude in TRUE_RUNS:
        stones = structure.stones(None if states else number)
        yield replace(stones, friction=structure.joints.friction), step, amplitude


def stones_scores(trials: Sequence[StonesTrial]) -> Iterator[scores.Score]:
    """Yield the shares of what falls among what is said to stand, by kind, with intervals by earthquake."""
    every = pd.DataFrame(trials).astype({"true_falls": float})
    for kind, own in every.groupby("structure", sort=False):
        fall = own.true_falls > 0
        stands = own.verdict == Verdict.STANDS
        of_mechanism = own.mechanism == Verdict.STANDS
        for part, counts in (
            ('"stands"', stands),
            ('"stands", and its stones lift', stands & (own.turn_rad > LIFTED)),
            ('"probably stands"', own.verdict == Verdict.PROBABLY_STANDS),
            ('"stands" by its mechanism', of_mechanism),
            ('"probably stands" by its mechanism', own.mechanism == Verdict.PROBABLY_STANDS),
        ):
            of_part = own[counts]
            if of_part.empty:
                continue
            measures = {"some true stones fall": fall[counts].astype(float).to_numpy()}
            yield from scores.scored(str(kind), part, measures, sample_of(of_part.site, of_part.earthquake))
        measures = {
            '"stands"': stands.astype(float).to_numpy(),
            "processor time of the verdict, s": scores.median(own.verdict_s),
        }
        yield from scores.scored(str(kind), "all trials", measures, sample_of(own.site, own.earthquake))


def disagreement_trials(component: SiteRecord, place: int) -> Iterator[DisagreementTrial]:
    """Yield the arches of ON_FRICTION whose mechanism does not stand under the stretch at the level sought for it."""
    for turn, kind in enumerate(ON_FRICTION):
        joints = Joints(FRICTIONS[(place + turn) % len(FRICTIONS)])
        draw = draw_of(component.identifier, CAMPAIGN + 1, turn)
        with suppress(RockingError):
            structure = drawn(kind, draw, joints)
            beyond = float(draw.uniform(*BEYOND))
            trial = disagreement_trial(component, kind, structure, beyond)
            if trial is not None:
                yield trial


def disagreement_trial(
    component: SiteRecord, kind: str, structure: Arch | Frame, beyond: float
) -> DisagreementTrial | None:
    """Return one trial, its level `beyond` times that at which the mechanism no longer stands; None where it stands."""
    record = component.accelerogram
    multiplier = structure.static_multiplier
    unit = strongest(record).scaled(multiplier * GRAVITY / record.peak_acceleration)
    settings = AssessmentSettings()

    def facts_at(level: float) -> Facts:
        motions = GroundMotions.of(unit.scaled(level))
        members = ensemble(structure.mechanism(), motions, settings.ensemble, verdict_only=True, grows=False)
        return Facts(cracks=(members.facts(),), as_stones=structure.joints.as_stones)

    levels = (level for level in LIMITS.tolist() if decide(facts_at(level)).verdict not in STANDING)
    limit = next(levels, None)
    if limit is None:
        return None
    facts = facts_at(beyond * limit)
    mechanism = decide(facts).verdict
    if mechanism in STANDING:
        return None
    motion = unit.scaled(beyond * limit)
    share = contact_share(structure, GroundMotions.of(motion), settings)
    falls = [
        follow_stack(stones, motion.scaled(amplitude), min(step, stones.longest_step)).falls
        for stones, step, amplitude in true_stones(structure)
    ]
    return DisagreementTrial(
        **component.named,
        structure=kind,
        scale_factor=float(motion.peak_acceleration / record.peak_acceleration),
        friction=structure.joints.friction,
        voussoirs=getattr(structure, "voussoirs", None),
        multiplier=multiplier,
        mechanism=mechanism,
        member_falls=facts.cracks[0].falls,
        verdict=decide(replace(facts, stacks=(share.falls, share.runs))).verdict,
        stack_falls=share.falls,
        stack_runs=share.runs,
        true_falls=sum(falls),
        true_runs=len(falls),
    )


def disagreement_scores(trials: Sequence[DisagreementTrial]) -> Iterator[scores.Score]:
    """Yield the shares of which some true stones fall, by the runs of a study and by friction."""
    if not trials:
        return
    every = pd.DataFrame(trials)
    of_runs = {
        "none of its runs falls": every.stack_falls == 0,
        "some of its runs fall": every.stack_falls > 0,
    }
    for (runs, has), friction in product(of_runs.items(), (None, *FRICTIONS)):
        own = every[has if friction is None else has & (every.friction == friction)]
        if not own.empty:
            subject = "an arch that does not stand as a mechanism" + (f", on {friction}" if friction else "")
            measures = {"some true stones fall": (own.true_falls > 0).astype(float).to_numpy()}
            yield from scores.scored(subject, runs, measures, sample_of(own.site, own.earthquake))


@dataclass(frozen=True)
class CheckedArch:
    """An arch of voussoirs, on piers where their width and height are given, as LMGC90 follows it: m, rad."""

    radius: float
    thickness: float
    embrace_angle: float
    voussoirs: int
    pier_width: float | None = None
    pier_height: float | None = None

    @property
    def structure(self) -> Arch:
        """As the package knows it. Raises StructureError where it does not stand."""
        size = self.radius, self.thickness, self.embrace_angle, self.voussoirs
        if self.pier_width is None or self.pier_height is None:
            return Arch(*size)
        return ArchOnPiers(*size, pier_width=self.pier_width, pier_height=self.pier_height)

    @property
    def bodies(self) -> RigidBodies:
        """As separate bodies; a pier goes up to the springing, and with it the wedge below an inclined one."""
        structure = self.structure
        of_arch = bodies_of_voussoirs(structure)
        if not isinstance(structure, ArchOnPiers):
            return of_arch
        joints = self._joints
        (outer_x, outer_z), (inner_x, inner_z) = joints[-1]
        foot = inner_z - structure.pier_height
        width = structure.pier_width
        corners = [[inner_x, foot], [inner_x + width, foot], [inner_x + width, outer_z], [outer_x, outer_z]]
        right = np.array([*corners, [inner_x, inner_z]])
        left = right[::-1] * [-1, 1]
        reach = inner_x + 3 * width
        ground = rectangle(-reach, reach, foot - 0.5, foot)
        return RigidBodies((ground, left, *of_arch.polygons[1:-1], right), (0,))

    @property
    def _joints(self) -> np.ndarray:
        """Outer and inner end of every joint from left to right, (n + 1, 2, 2), m."""
        half = self.embrace_angle / 2
        angles = np.linspace(-half, half, self.voussoirs + 1)
        along = np.stack([np.sin(angles), np.cos(angles)], axis=1)
        ends = self.radius + self.thickness / 2 * np.array([1.0, -1.0])
        joints: np.ndarray = ends[:, None] * along[:, None, :]
        return joints

    @property
    def stones(self) -> Stones:
        """The same bodies as stones, on joints of the friction of a study."""
        bodies = self.bodies
        faces = list(self._joints)
        if self.pier_width is not None:
            inner_x, foot = bodies.polygons[-1][0]
            feet = np.array([[inner_x + self.pier_width, foot], [inner_x, foot]])
            faces = [feet * [-1, 1], *faces, feet]
        moving = [polygon for place, polygon in enumerate(bodies.polygons) if place not in bodies.driven]
        made = []
        for polygon, first, last in zip(moving, faces[:-1], faces[1:], strict=True):
            area, centre, gyration = properties(polygon)
            corners = tuple(map(tuple, np.array([first[0], first[1], last[1], last[0]]).tolist()))
            made.append(Stone(corners, area, (centre.real, centre.imag), area * gyration))
        return Stones(tuple(made), USUAL.friction)


class ArchQuestion(Question):
    """A question on an arch."""

    arch: dict[str, Any]


def checked_arch(draw: np.random.Generator, on_piers: bool) -> CheckedArch:
    """Return an arch of few voussoirs, drawn until one stands, whose bodies lift where its mechanism does."""
    for _ in range(DRAWS):
        radius, ratio, degrees = draw.uniform([2, 0.12, 130], [5, 0.2, 175]).tolist()
        if not on_piers:
            radius, ratio, degrees = draw.uniform([3, 0.1, 110], [12, 0.2, 175]).tolist()
        height = float(draw.uniform(0.4, 1.2)) * radius if on_piers else None
        width = None if height is None else float(draw.uniform(0.3, 0.5)) * height + ratio * radius
        size = radius, ratio * radius, float(np.radians(degrees)), int(draw.integers(7, 12))
        found = CheckedArch(*size, width, height)
        try:
            if found.stones.resting_multiplier > 0.9 * found.structure.onset.multiplier:
                return found
        except StructureError:
            continue
    raise StructureError(f"none of {DRAWS} drawn arches stands; draw them in other sizes.")


def strongest(record: Accelerogram) -> Accelerogram:
    """Return the CHECKED_SECONDS of a record about its peak."""
    peak = int(np.abs(record.acceleration).argmax())
    span = round(CHECKED_SECONDS / record.time_step)
    start = max(peak - span // 2, 0)
    return replace(record, acceleration=record.acceleration[start : start + span])


def checked_trials(component: SiteRecord, place: int) -> Iterator[CheckedTrial]:
    """Yield the runs of both codes of one arch, below and above the level at which its stones fall."""
    record = component.accelerogram
    draw = draw_of(component.identifier, CAMPAIGN, len(TRIALS), place)
    of_arch = checked_arch(draw, place % ON_PIERS == ON_PIERS - 1)
    stones = of_arch.stones
    stretch = strongest(record)
    unit = stretch.scaled(stones.resting_multiplier * GRAVITY / stretch.peak_acceleration)
    step = CHECKED_STEP / 2
    limit = next((level for level in LEVELS if follow_stack(stones, unit.scaled(level), step).falls), None)
    if limit is None:
        return
    for share in SHARES:
        motion = unit.scaled(share * limit)
        own, spent = timed(partial(follow_stack, stones, motion, step))
        question: ArchQuestion = {
            "arch": asdict(of_arch),
            "acceleration": motion.acceleration.tolist(),
            "time_step": motion.time_step,
            "critical_rotation": stones.fallen_turn / FALLEN,
            "frequency_parameter": 1.5,
            "settled": stones.settled_turn,
        }
        answer, reason = ask("docs.research.voussoirs", question, TIMEOUT)
        turn, drop, seconds = answer or (np.nan, np.nan, np.nan)
        fell = turn > stones.fallen_turn or drop > of_arch.thickness / 2
        yield CheckedTrial(
            **component.named,
            structure="arch" if of_arch.pier_width is None else "arch on piers",
            scale_factor=float(motion.peak_acceleration / record.peak_acceleration),
            voussoirs=of_arch.voussoirs,
            share=share,
            falls=own.falls,
            falls_in_lmgc90=None if answer is None else bool(fell),
            turn_rad=float(own.largest_turns.max()),
            turn_in_lmgc90_rad=turn,
            run_s=spent,
            run_in_lmgc90_s=seconds,
            reason=reason,
        )


def checked_scores(trials: Sequence[CheckedTrial]) -> Iterator[scores.Score]:
    """Yield how often both codes agree, and how far those turn that stand in both, with intervals by earthquake."""
    answered = [trial for trial in trials if trial.falls_in_lmgc90 is not None]
    if not answered:
        return
    table = pd.DataFrame(answered)
    falls = table.falls.astype(bool)
    as_lmgc90 = falls == table.falls_in_lmgc90.astype(bool)
    stand_in_both = as_lmgc90 & ~falls
    ratio = (table.turn_in_lmgc90_rad / table.turn_rad).where(stand_in_both)
    measures: dict[str, scores.Measured] = {
        "falls or stands as in LMGC90": as_lmgc90.astype(float).to_numpy(),
        "largest turn in LMGC90 over that of the package": scores.median(ratio),
        "processor time of the package, s": scores.median(table.run_s),
        "processor time of LMGC90, s": scores.median(table.run_in_lmgc90_s),
    }
    yield from scores.scored(
        "stones near their limit", "beside LMGC90", measures, sample_of(table.site, table.earthquake)
    )


def main() -> None:
    """Follow the arch on standard input in LMGC90 and print its largest turn [rad], its largest drop [m], and s."""
    question = json.load(sys.stdin)
    bodies = CheckedArch(**question["arch"]).bodies
    friction = USUAL.friction
    (_, turns, centres), spent = timed(lambda: follow(question, bodies, CHECKED_STEP, friction))
    drop = float((centres[0, :, 1] - centres[:, :, 1]).max())
    print("\n" + json.dumps([float(np.abs(turns).max()), drop, spent]))


if __name__ == "__main__":
    main()
