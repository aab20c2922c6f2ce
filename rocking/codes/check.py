"""The checks of a structure by the Italian code: on what terms they are made, and what each one finds."""

import math
from dataclasses import dataclass
from enum import StrEnum

from rocking.codes.code_capacity import LIMIT_STATES, CodeCapacity, LimitPoint
from rocking.codes.kinds import CheckKind
from rocking.errors import ConfigurationError
from rocking.floors.support import Support
from rocking.quantities import finite, kind_of, positive
from rocking.structures.linkage import Restraint
from rocking.warnings import RockingWarning

CONFIDENCE_FACTOR = 1.35
"""The factor of the level of knowledge LC1, which C8.7.1.2.1 asks for unless crushing enters α, as with a
compressive_strength of the structure."""

BEHAVIOUR_FACTOR = 2.0
"""q of the linear check where no better one is known (C8.7.1.2.1.7)."""

_LARGE_RATIO = 100.0
"""A ratio beyond which a reader learns nothing from its digits."""

LEAST_OTHERS = 0.5
"""Least share of the sets of other stations that must meet the dynamic check, by the lower end of its interval."""
LEAST_SHARE = 0.95
"""Share of SETS sets or more that must meet the check for it to be called met."""


RISK = 0.05
"""Risk of the bound on the share of stations that nobody saw and that let a structure fall."""


@dataclass(frozen=True, kw_only=True)
class CodeTerms:
    """The terms on which a structure is checked.

    limit_state: SLD, SLV or SLC. confidence_factor: FC ≥ 1. support: the modes of what carries the structure above the
    ground. behaviour_factor: q ≥ 1 of the linear check. elastic_period: T_0 of a part free to vibrate, s; 0 where it is
    tied rigidly. support_loss: horizontal displacement of the control point at which what it carries falls, m; inf:
    nothing does. least_others: share of the sets of other stations that must meet the dynamic check at the least.
    Raises ConfigurationError for a value out of range.
    """

    limit_state: str = "SLV"
    confidence_factor: float = CONFIDENCE_FACTOR
    support: Support | None = None
    behaviour_factor: float = BEHAVIOUR_FACTOR
    elastic_period: float = 0.0
    support_loss: float = math.inf
    least_others: float = LEAST_OTHERS

    def __post_init__(self) -> None:
        if self.limit_state not in ("SLD", *LIMIT_STATES):
            allowed = ", ".join(LIMIT_STATES)
            raise ConfigurationError(
                f"limit_state is {self.limit_state!r}, but must be one of SLD, {allowed}.",
                limit_state=self.limit_state,
            )
        if not isinstance(self.support, Support | None):
            raise ConfigurationError(
                f"support is {kind_of(self.support)}, but must be a Support or None.", support=self.support
            )
        for name in ("behaviour_factor", "confidence_factor"):
            value = getattr(self, name)
            if finite(ConfigurationError, name, value) < 1:
                raise ConfigurationError(f"{name} is {value!r}, but must be 1 or more.", **{name: value})
        if finite(ConfigurationError, "elastic_period", self.elastic_period, "s") < 0:
            raise ConfigurationError(
                f"elastic_period is {self.elastic_period!r} s, but must be 0 or more.",
                elastic_period=self.elastic_period,
            )
        if not 0 <= finite(ConfigurationError, "least_others", self.least_others) <= 1:
            raise ConfigurationError(
                f"least_others is {self.least_others!r}, but must be from 0 to 1.",
                least_others=self.least_others,
            )
        if self.support_loss != math.inf:
            positive(ConfigurationError, "support_loss", self.support_loss, "m")


@dataclass(frozen=True, kw_only=True)
class Check:
    """One check of one limit state, with the mechanism that decides it.

    Parameters
    ----------
    clause : str
        Clause of the code.
    limit_state : str
        Limit state of the code.
    capacity : float
        Ground acceleration on rock at which the limit state is reached, m/s², or a displacement, m, as `unit`
        says.
    demand : float
        Ground acceleration on rock of the spectrum, m/s², or a displacement, m.
    mechanism : str
        What opens, and to which side it falls.
    unit : str, default 'm/s²'
        Unit of capacity and demand.
    refusal : RockingWarning or None, optional
        Why it is not called met, where that is not in the numbers; else None.

    Examples
    --------
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    >>> rocking.check(rocking.Block.of_size(breadth=0.6, height=2.0), spectrum).linear.clause
    'C8.7.1.2.1.7'
    """

    clause: str
    limit_state: str
    capacity: float
    demand: float
    mechanism: str
    unit: str = "m/s²"
    refusal: RockingWarning | None = None

    @property
    def ratio(self) -> float:
        """Capacity over demand; 1 or more where it is met."""
        return self.capacity / self.demand if self.demand else math.inf

    @property
    def passed(self) -> bool:
        """Whether the check is met."""
        return not self.refusal and self.capacity >= self.demand

    @property
    def ratio_in_words(self) -> str:
        """The ratio as it is printed."""
        return ratio_in_words(self.ratio)

    @property
    def outcome(self) -> str:
        """Its verdict in a word or two: met, or not met."""
        return "met" if self.passed else "not met"

    def __str__(self) -> str:
        demand = "beyond d_0" if math.isinf(self.demand) else f"{self.demand:.4g} {self.unit}"
        return (
            f"{self.clause}, {self.limit_state}: capacity {self.capacity:.4g} {self.unit}, demand {demand}, "
            f"ratio {self.ratio:.3g}, {self.refusal or self.outcome} ({self.mechanism})"
        )


def ratio_in_words(ratio: float) -> str:
    """Return a capacity over its demand to three digits: "0.41", "> 100" of what hardly moves, "falls" for 0."""
    if not ratio:
        return "falls"
    return f"{ratio:#.3g}" if ratio <= _LARGE_RATIO else f"> {_LARGE_RATIO:g}"


@dataclass(frozen=True, kw_only=True)
class DynamicCheck(Check):
    """The dynamic check under the chosen set, and what the other sets say.

    Parameters
    ----------
    clause : str
        Clause of the code.
    limit_state : str
        Limit state of the code.
    capacity : float
        Displacement d of the limit state, m.
    demand : float
        Mean of the largest displacements, m; inf where one overturns.
    mechanism : str
        What opens, and to which side it falls.
    unit : str, default 'm/s²'
        Unit of capacity and demand.
    refusal : RockingWarning or None, optional
        Why it is not called met, where that is not in the numbers; else None.
    exceeding : int
        Motions of the chosen set under which d_0 is exceeded.
    motions : int
        Number of motions of the chosen set.
    stations : int
        Number of stations of the pool from which sets are drawn.
    earthquakes : int
        Number of earthquakes of that pool.
    sets : int
        Number of sets that were drawn.
    share : float
        Share of the sets that meet the check.
    interval : tuple of (float, float)
        90 % interval of the share for sets of other stations.

    Examples
    --------
    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=0.5, f0=2.5, tc_star=0.4)
    >>> records = rocking.select({"one": [record]}, spectrum, 1, below=0.9, above=9.0)
    >>> rocking.check(rocking.Block.of_size(breadth=2.0, height=2.0), spectrum, records=records).dynamic.exceeding
    0
    """

    exceeding: int
    motions: int
    stations: int
    earthquakes: int
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
    def caution(self) -> RockingWarning | None:
        """How far the stations of the pool speak for others, which belongs to a check that is met."""
        if not self.passed:
            return None
        unseen = 1 - RISK ** (1 / self.stations)
        return RockingWarning.of(
            CheckKind.OTHER_STATIONS,
            stations=self.stations,
            earthquakes=self.earthquakes,
            unseen_percent=100 * unseen,
            least_percent=100 * self.interval[0],
        )


def says_nothing(interval: tuple[float, float]) -> bool:
    """Whether the interval of a share reaches from below 1 % to above 99 %, so that a reader learns nothing from it."""
    low, high = interval
    return low < 0.01 and high > 0.99


class Role(StrEnum):
    """The part that one check has in the conclusion on its structure."""

    DECIDES = "decides"
    COUNTS_TOO = "counts too"
    NOT_NEEDED = "not needed"
    OVERRULED = "overruled"
    NO_ANSWER = "no answer"

    @property
    def in_words(self) -> str:
        """It as a page prints it."""
        return "does not count" if self is Role.OVERRULED else str(self)


@dataclass(frozen=True, eq=False, kw_only=True)
class StructureCheck:
    """The checks of one structure at one limit state.

    Parameters
    ----------
    limit_state : str
        Limit state of the code.
    linear : Check or None, optional
        Linear check; None for SLC, of which the code has none.
    nonlinear : Check or None, optional
        Nonlinear kinematic check; None for SLD, and where nothing can overturn, which `warning` then says.
    dynamic : DynamicCheck or None, optional
        Dynamic check; None without records, and where `nonlinear` is None.
    damage_level : float
        Least a_g at which a mechanism starts, that of SLD, m/s².
    mechanisms : tuple of CodeCapacity
        All that were checked.
    governing : CodeCapacity
        The mechanism that decides.
    restraints : tuple of Restraint, optional
        What holds the structure sideways.
    warning : RockingWarning or None, optional
        Why a check is left out; else None.
    were_it_unknown : StructureCheck or None, optional
        The kinematic checks of a structure whose crack is known, were it not; None where it is not, or would
        not stand with another one.

    Examples
    --------
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    >>> rocking.check(rocking.Block.of_size(breadth=0.6, height=2.0), spectrum)
    StructureCheck(SLV: C8.7.1.2.1.7 met, ratio 2.18; C8.7.1.2.1.8 met, ratio 1.90; starts at a_g = 2.18 m/s²)
    """

    limit_state: str
    linear: Check | None = None
    nonlinear: Check | None = None
    dynamic: DynamicCheck | None = None
    damage_level: float
    mechanisms: tuple[CodeCapacity, ...]
    governing: CodeCapacity
    restraints: tuple[Restraint, ...] = ()
    warning: RockingWarning | None = None
    were_it_unknown: "StructureCheck | None" = None

    def __repr__(self) -> str:
        """The verdict and the ratio of each check, and what the limit state leaves to say."""
        parts = [
            f"{check.clause} {check.refusal or check.outcome}, ratio {check.ratio_in_words}"
            for check in self.checks
        ]
        if self.warning:
            parts.append(str(self.warning))
        parts.append(f"starts at a_g = {self.damage_level:.3g} m/s²")
        return f"StructureCheck({self.limit_state}: {'; '.join(parts)})"

    @property
    def checks(self) -> tuple[Check, ...]:
        """Those that the limit state has."""
        return tuple(check for check in (self.linear, self.nonlinear, self.dynamic) if check)

    @property
    def decisive(self) -> Check | None:
        """The check that decides: the most detailed one that has an answer; None where none was made.

        A dynamic check that its chosen set meets has none as long as there are too few other sets to ask.
        """
        answered = [check for check in self.checks if not _is_open(check)]
        return answered[-1] if answered else None

    def with_any_crack(self, check: Check) -> Check | None:
        """Return a check as it would be were the crack not known; None where it is not known, or none was made."""
        others = self.were_it_unknown.checks if self.were_it_unknown else ()
        return next((other for other in others if other.clause == check.clause), None)

    @property
    def verified(self) -> bool:
        """Whether the check that decides is met."""
        return self.decisive is not None and self.decisive.passed

    def part_of(self, check: Check) -> Role:
        """Return the part that one of the checks has in whether the structure is verified."""
        if check is self.decisive:
            return Role.DECIDES
        if _is_open(check):
            return Role.NO_ANSWER
        if check.passed:
            return Role.COUNTS_TOO if self.verified else Role.OVERRULED
        return Role.NOT_NEEDED if self.verified else Role.COUNTS_TOO

    @property
    def limit(self) -> LimitPoint | None:
        """The place of the limit state on the curve of the mechanism that governs; None for SLD."""
        state = LIMIT_STATES.get(self.limit_state)
        return self.governing.limit(state) if state else None


def _is_open(check: Check) -> bool:
    return check.refusal is not None and check.refusal.kind in (
        CheckKind.SETS_TOO_FEW,
        CheckKind.OTHERS_TOO_FEW,
    )
