"""The dynamic check of a local mechanism: Circolare 7/2019, C8.7.1.2.1.9, under sets of natural records.

The mechanism itself is followed, with its restitution, and with the confidence factor on what restores it, as on the
capacity curve that the code lets stand for it. Met under a set: d_0 is exceeded under none of its motions, and the mean
of the largest displacements is no more than that of the limit state. As that depends on the set, it is met only where
nearly all sets that were drawn say so.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.local_mechanism import LIMIT_STATES, LimitState, LocalMechanism
from rocking.codes.selection import SETS, Selection
from rocking.codes.static_check import (
    BEHAVIOUR_FACTOR,
    CONFIDENCE_FACTOR,
    Check,
    CodeCheck,
    kinematic_check,
)
from rocking.errors import ConfigurationError
from rocking.floors.support import Support
from rocking.quantities import counted, kind_of
from rocking.records.accelerogram import Accelerogram
from rocking.structures import Mechanism, Side, Structure
from rocking.structures.mechanism import SideTie

LEAST_SHARE = 0.95
"""Share of SETS sets or more that must meet the check for it to be called met."""

CONFIRMED = (
    "Of 96 checks of cantilevers that real records of 25 stations called met, those of 25 other stations confirmed 72; "
    "in the other 24 one station let the cantilever fall."
)
"""The finding of the target code_sets of docs/research on what a check that is met is worth."""

_RISK = 0.05
"""Risk of the bound on the share of stations that nobody saw and that let a structure fall."""

BOOTSTRAPS = 50
INTERVAL = 0.05, 0.95


@dataclass(frozen=True, kw_only=True)
class DynamicCheck(Check):
    """The dynamic check under the chosen set, and what the other sets say.

    capacity, demand: d of the limit state and the mean of the largest displacements, m; inf where one overturns.
    exceeding: motions of the chosen set under which d_0 is exceeded. motions: how many it has. stations: of the pool
    from which sets are drawn. sets: how many were drawn; share: of them that meet the check, with its 90 % interval for
    sets of other stations, (2,).

    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=0.5, f0=2.5, tc_star=0.4)
    >>> records = rocking.select({"one": [record]}, spectrum, 1, below=0.9, above=9.0)
    >>> rocking.check(rocking.Block.of_size(breadth=2.0, height=2.0), spectrum, records=records).dynamic.exceeding
    0
    """

    exceeding: int
    motions: int
    stations: int
    sets: int
    share: float
    interval: tuple[float, float]

    @property
    def met_by_the_set(self) -> bool:
        """Whether the chosen set meets it, whatever others say."""
        return not self.exceeding and self.demand <= self.capacity

    @property
    def sets_agree(self) -> bool:
        """Whether nearly all sets that were drawn meet it, however few they are."""
        return self.share >= LEAST_SHARE

    @property
    def outcome(self) -> str:
        """Its verdict in words: met, not met, or by the chosen set only, for which it is not called met."""
        if self.met_by_the_set and not self.passed:
            return "not called met"
        return super().outcome

    @property
    def sentence(self) -> str:
        """The share of the sets that meet it, with its interval and the cases that are undecided."""
        low, high = self.interval
        return (
            f"of {self.sets} sets drawn {100 * self.share:.0f} % meet it ({100 * low:.0f} to {100 * high:.0f} % "
            "for sets of other stations)"
        )

    @property
    def caution(self) -> str:
        """The sentence that belongs beside a check that is met: how far the stations of the pool speak for others."""
        if not self.passed:
            return ""
        unseen = 1 - _RISK ** (1 / self.stations)
        return (
            f"That the check is met is no proof for other stations than the {self.stations} of the pool: even if none "
            f"of these lets it fall, up to {100 * unseen:.0f} % of all stations may, and of sets of other stations as "
            f"few as {100 * self.interval[0]:.0f} % may meet the check. {CONFIRMED}"
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class StructureCheck(CodeCheck):
    """The three checks of one structure. dynamic: None without records, and for SLD.

    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    >>> len(rocking.check(rocking.Block.of_size(breadth=0.6, height=2.0), spectrum).checks)
    2
    """

    dynamic: DynamicCheck | None = field(default=None)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Those that the limit state has."""
        return (*super().checks, *((self.dynamic,) if self.dynamic else ()))


# Whole on purpose: half of it are the arguments of a public name and what it hands on.
def check(
    structure: Structure,
    spectrum: DesignSpectrum,
    *,
    limit_state: str = "SLV",
    confidence_factor: float = CONFIDENCE_FACTOR,
    support: Support | None = None,
    behaviour_factor: float = BEHAVIOUR_FACTOR,
    elastic_period: float = 0.0,
    support_loss: float = math.inf,
    records: Selection | None = None,
) -> StructureCheck:
    """Return the checks of `structure` at a limit state of the Italian code, each of the mechanism that decides it.

    The mechanism is the one that limit analysis finds between supports, and above cracks each that may open, to each
    side. spectrum: of the design level, for the limit state. limit_state: SLD, SLV or SLC. confidence_factor: FC ≥ 1.
    support: the modes of what carries the structure above the ground. behaviour_factor:
    q of the linear check. elastic_period: T_0 of a part free to vibrate, s; 0 where it is tied rigidly.
    support_loss: horizontal displacement of the control point at which what it carries falls, m; inf: nothing does.
    records: sets for the dynamic check, as rocking.select gives them. Masses are those of the structure.
    Raises ConfigurationError for a value out of range, StructureError for a structure without capacity curve.

    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    >>> checks = rocking.check(rocking.Block.of_size(breadth=0.6, height=2.0), spectrum)
    >>> checks.linear.passed, checks.nonlinear.passed
    (True, True)
    """
    for name, value, allowed, words in (
        ("spectrum", spectrum, DesignSpectrum, "a DesignSpectrum, as rocking.DesignSpectrum.ntc gives it"),
        ("support", support, Support | None, "a Support or None"),
        ("records", records, Selection | None, "sets of records, as rocking.select gives them, or None"),
    ):
        if not isinstance(value, allowed):
            raise ConfigurationError(f"{name} is {kind_of(value)}, but must be {words}.")
    by_formula = kinematic_check(
        structure,
        spectrum,
        limit_state=limit_state,
        confidence_factor=confidence_factor,
        support=support,
        behaviour_factor=behaviour_factor,
        elastic_period=elastic_period,
        support_loss=support_loss,
    )
    dynamic = None
    if records is not None and by_formula.nonlinear is not None:
        dynamic = _dynamic_check(by_formula, records, support)
    return StructureCheck(
        limit_state=by_formula.limit_state,
        linear=by_formula.linear,
        nonlinear=by_formula.nonlinear,
        damage_level=by_formula.damage_level,
        mechanisms=by_formula.mechanisms,
        governing=by_formula.governing,
        remark=by_formula.remark,
        dynamic=dynamic,
    )


def _dynamic_check(by_formula: CodeCheck, records: Selection, support: Support | None) -> DynamicCheck:
    state = LIMIT_STATES[by_formula.limit_state]
    together = [_Body.of(sides, state) for sides in _sides_together(by_formula.mechanisms)]
    bodies = [each for each in together if any(map(math.isfinite, each.limits))]
    places = np.unique(np.concatenate([records.chosen, records.sets.ravel()]).astype(int))
    # by body and record of the pool: the mean of d over its limit, and motions under which d_0 is exceeded
    use = np.full((len(bodies), len(records.names)), np.nan)
    falls = np.zeros(use.shape, dtype=int)
    motions = np.zeros(len(records.names), dtype=int)
    for place in places:
        felt = [_felt(each, support) for each in records.scaled(int(place))]
        for row, body in enumerate(bodies):
            use[row, place], falls[row, place] = body.answer(felt)
            motions[place] = max(motions[place], len(felt) * len(body.polarities))
    met = _met(use, falls, records.sets)
    chosen_use = use[:, records.chosen].mean(axis=1)
    worst = int(np.argmax(np.nan_to_num(chosen_use, nan=np.inf)))
    exceeding = int(falls[:, records.chosen].sum(axis=1).max())
    limit = next(each for each in bodies[worst].limits if math.isfinite(each))
    share = float(met.mean()) if met.size else float("nan")
    found = DynamicCheck(
        clause="C8.7.1.2.1.9",
        limit_state=by_formula.limit_state,
        capacity=limit,
        demand=float(limit * chosen_use[worst]),
        mechanism=bodies[worst].sides[0].description,
        unit="m",
        exceeding=exceeding,
        motions=int(motions[records.chosen].sum()),
        stations=len(set(records.stations)),
        sets=int(met.size),
        share=share,
        interval=_interval(use, falls, records, share),
    )
    return replace(found, refusal=_refusal(found))


def _refusal(found: DynamicCheck) -> str:
    if found.exceeding:
        return f"not met: d₀ is exceeded under {found.exceeding} of {found.motions} motions"
    if not found.met_by_the_set:
        return "not met"
    if found.sets < SETS:
        return (
            f"met by this set, but not called met: {counted(found.sets, 'other set')} lay within the limits, and "
            f"{SETS} must be asked; give more records, or a narrower range of periods"
        )
    if not found.sets_agree:
        of_sets = f"{100 * found.share:.0f} % of {found.sets} sets"
        return f"met by this set, but not called met: it is by {of_sets}, and {100 * LEAST_SHARE:.0f} % must"
    return ""


def _met(use: np.ndarray, falls: np.ndarray, sets: np.ndarray) -> np.ndarray:
    """Whether each of the sets (s, n) meets the check with every body: (s,)."""
    met = np.ones(len(sets), dtype=bool)
    for of_body, fallen in zip(use, falls, strict=True):
        met &= (of_body[sets].mean(axis=1) <= 1) & (fallen[sets].sum(axis=1) == 0)
    return met


def _interval(use: np.ndarray, falls: np.ndarray, records: Selection, share: float) -> tuple[float, float]:
    """The 90 % interval of what sets of other stations say: pools of stations drawn again, and sets of these.

    Two pools differ by √2 times what one does from the truth. Where no station of the pool lets it fall, up to
    1 − .05^(1/S) of all stations may, so that a set of n of them stands with .05^(n/S) at least.
    """
    rng = np.random.default_rng(0)
    shares = []
    for _ in range(BOOTSTRAPS):
        sets = records.redrawn(rng)
        answered = sets[(~np.isnan(use[:, sets])).all(axis=(0, 2))]
        if len(answered):
            shares.append(float(_met(use, falls, answered).mean()))
    if not shares:
        return 0.0, 1.0
    low, high = share + math.sqrt(2) * (np.quantile(shares, INTERVAL) - share)
    if not falls.any():
        stations = len(set(records.stations))
        low = min(low, share * _RISK ** (records.chosen.size / stations))
    return float(np.clip(low, 0, share)), float(np.clip(high, share, 1))


def _sides_together(mechanisms: Sequence[LocalMechanism]) -> list[tuple[LocalMechanism, ...]]:
    """The mechanisms of each crack together: one to a side, positive first."""
    bodies: list[tuple[LocalMechanism, ...]] = []
    for each in mechanisms:
        if each.sign < 0:
            bodies[-1] = (*bodies[-1], each)
        else:
            bodies.append((each,))
    return bodies


@dataclass(frozen=True, eq=False)
class _Body:
    """One crack with its sides, the mechanism that is followed, and d of the limit state on each side, m."""

    sides: tuple[LocalMechanism, ...]
    mechanism: Mechanism
    limits: tuple[float, ...]

    @classmethod
    def of(cls, sides: tuple[LocalMechanism, ...], state: LimitState) -> "_Body":
        limits = tuple(each.limit(state).displacement for each in sides)
        return cls(sides, with_confidence(sides), limits)

    @property
    def polarities(self) -> list[float]:
        """Unlike sides meet a record both ways, as nobody knows how it will come."""
        alike = len(self.sides) == 1 and not self.sides[0].one_sided
        return [1.0] if alike else [1.0, -1.0]

    def answer(self, motions: Sequence[Accelerogram]) -> tuple[float, int]:
        """Return the mean over the motions of the largest d over its limit, and under how many d_0 is exceeded."""
        # numba comes with it, and the scheduler of a study, which imports the rows of this check, needs it for nothing
        from rocking.motion.members import Members, integrate_members

        members = Members(polarity=self.polarities)
        uses: list[float] = []
        exceeded = 0
        for motion in motions:
            responses = integrate_members(self.mechanism, motion, members)
            for ratio, sign in zip(responses.rotation_ratio, responses.peak_side, strict=True):
                place = -1 if sign < 0 else 0
                side = self.sides[place]
                moved = float(ratio)
                if math.isfinite(moved):
                    moved = float(side.displacement(moved * side.static.side.critical_rotation))
                ends = math.isinf(moved) or not self.limits[place]
                uses.append(math.inf if ends else moved / self.limits[place])
                exceeded += not moved <= side.ultimate_displacement or math.isinf(moved)
        return float(np.mean(uses)), exceeded


def _felt(record: Accelerogram, support: Support | None) -> Accelerogram:
    return record if support is None else support.motion(record)


def with_confidence(sides: Sequence[LocalMechanism]) -> Mechanism:
    """Return the mechanism whose restoring actions are divided by the confidence factor."""
    made = [_weakened(each.static.side, each.confidence_factor) for each in sides]
    negative = made[1] if len(made) > 1 else None
    return Mechanism(made[0], negative, one_sided=sides[0].one_sided)


def _weakened(side: Side, factor: float) -> Side:
    """The side with G, ties included, over `factor`."""
    if factor == 1:
        return side

    def over(function: Callable[[np.ndarray], np.ndarray], rotation: np.ndarray) -> np.ndarray:
        return function(rotation) / factor

    ties = tuple(SideTie(each.tie.over(factor), each.stretch, each.stretch_slope) for each in side.ties)
    untied = side.untied_gravity and partial(over, side.untied_gravity)
    return replace(
        side,
        gravity=partial(over, side.gravity),
        gravity_slope=partial(over, side.gravity_slope),
        ties=ties,
        untied_gravity=untied,
    )
