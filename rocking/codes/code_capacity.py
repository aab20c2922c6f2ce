"""The capacity curve of a local mechanism by the Italian code: one degree of freedom, and its limit states.

Circolare 7/2019, C8.7.1.2.1, to the NTC 2018.
"""

import math
from dataclasses import KW_ONLY, dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rocking.codes.kinds import CheckKind
from rocking.quantities import GRAVITY
from rocking.structures.capacity import StaticCapacity
from rocking.structures.mechanism import SideTie
from rocking.structures.structure import Candidate
from rocking.warnings import RockingWarning

_MOST_FALL = 0.5
"""Share of the largest capacity in acceleration by which it may fall as a part breaks (C8.7.1.2.1.6)."""

_OVERTURNS_AS_IT_BREAKS = 1 + 1e-9
"""Share of φ_cr up to which a tie breaks at it, but for rounding."""
_JUST_BEFORE = 1 - 1e-12
"""Share of the rotation at which a tie breaks up to which it surely holds."""


@dataclass(frozen=True, kw_only=True)
class LimitState:
    """A limit state of collapse: its displacement over d_0, the factor of its secant period, and the damping.

    ends_with_ties: whether it is reached, too, where a tie breaks and the capacity falls by more than half.
    """

    name: str
    displacement_share: float
    period_factor: float
    damping: float
    ends_with_ties: bool


LIMIT_STATES = {
    "SLV": LimitState(
        name="SLV", displacement_share=0.4, period_factor=1.68 * math.pi, damping=0.08, ends_with_ties=True
    ),
    "SLC": LimitState(
        name="SLC", displacement_share=0.6, period_factor=1.56 * math.pi, damping=0.10, ends_with_ties=False
    ),
}
"""C8.7.1.2.1.6 and C8.7.1.2.1.8; the limit state of damage, SLD, has the linear check alone."""


@dataclass(frozen=True, kw_only=True)
class LimitPoint:
    """The place of a limit state on the capacity curve: d [m], a [m/s²], the secant period [s], and the reason."""

    displacement: float
    acceleration: float
    period: float
    reason: RockingWarning


@dataclass(frozen=True, eq=False)
class CodeCapacity:
    """The capacity of one mechanism to one side by the code: one degree of freedom, with the confidence factor in it.

    candidate: the mechanism, with the side to which it falls in its description. elastic_period: T_0 of a part free to
    vibrate, s; 0 of one tied rigidly to the structure. support_loss: horizontal displacement of the control point at
    which what it carries falls, m; inf where nothing does. one_sided: whether it leans on something. released: how many
    ruptures of ties that limit its displacement are passed: its limit states lie on the branch of the curve behind
    them, where that bears more.
    """

    candidate: Candidate
    static: StaticCapacity
    confidence_factor: float
    _: KW_ONLY
    elastic_period: float = 0.0
    support_loss: float = math.inf
    one_sided: bool = False
    released: int = 0

    @property
    def description(self) -> str:
        """What opens, and to which side it falls."""
        return self.candidate.description

    @property
    def onset_multiplier(self) -> float:
        """α_0 by virtual work at rest: each tie pulls with the force at which it yields (C8.7.1.1).

        One without a strength pulls with its pretension, as nobody knows what it bears.
        """
        side = self.static.side
        at_rest = np.zeros(())
        work = 0.0
        for tie in side.ties:
            if np.isfinite(tie.tie.strength):
                more = tie.tie.strength - float(tie.tie.tension(tie.stretch(at_rest)))
                work += more * max(float(tie.stretch_slope(at_rest)), 0.0)
        return (side.at("gravity", 0.0) + work) / side.at("ground", 0.0)

    @property
    def participating_mass_ratio(self) -> float:
        """e* (C8.7.1.5); weights that something else holds sideways are left out, which is on the safe side."""
        return self.static.participating_mass_ratio

    @property
    def onset_acceleration(self) -> float:
        """α_0 g/(e* FC), m/s² (C8.7.1.8)."""
        return self.onset_multiplier * GRAVITY / (self.participating_mass_ratio * self.confidence_factor)

    def displacement(self, rotation: ArrayLike) -> np.ndarray:
        """Return d [m] at `rotation` [rad], of any shape (C8.7.1.4)."""
        return self.static.displacement(rotation) * self.static.displacement_factor

    def acceleration(self, rotation: ArrayLike) -> np.ndarray:
        """Return a [m/s²] at `rotation` [rad], of any shape: C8.7.1.3.

        Of a part free to vibrate it is at most its elastic branch, C8.7.1.6.
        """
        multiplier = self.static.multiplier(rotation)
        rigid = multiplier * GRAVITY / (self.participating_mass_ratio * self.confidence_factor)
        if not self.elastic_period:
            return rigid
        elastic = (2 * math.pi / self.elastic_period) ** 2 * self.displacement(rotation)
        least: np.ndarray = np.minimum(rigid, elastic)
        return least

    @cached_property
    def ultimate_displacement(self) -> float:
        """d_0 [m], where a vanishes with only such actions as hold on until then; inf where it vanishes nowhere."""
        if not self.static.side.can_overturn:
            return math.inf
        return float(self.displacement(self.collapse_rotation))

    @property
    def _breaking(self) -> list[tuple[float, SideTie]]:
        """The rotation at which each tie breaks, rad, inf of one that does not, and the tie."""
        side = self.static.side
        return [(tie.rotation(tie.tie.rupture_stretch, side.end_rotation), tie) for tie in side.ties]

    @cached_property
    def ruptures(self) -> tuple[float, ...]:
        """Rotations up to φ_cr at which ties break, in order, rad."""
        critical = self.static.side.critical_rotation * _OVERTURNS_AS_IT_BREAKS
        return tuple(sorted({rotation for rotation, _ in self._breaking if rotation <= critical}))

    @cached_property
    def collapse_rotation(self) -> float:
        """φ at which λ vanishes with only such ties as hold on until then, rad; 0 where it stands by the others alone.

        It is φ_cr but where the structure overturns as a tie breaks.
        """
        from scipy.optimize import brentq  # slow to import, and needed by ties that break only

        side = self.static.side
        critical = side.critical_rotation
        untied = side.untied_gravity
        if not self.ruptures or untied is None:
            return critical
        lasting = [tie for rotation, tie in self._breaking if rotation > critical * _OVERTURNS_AS_IT_BREAKS]

        def gravity(rotation: float) -> float:
            at = np.asarray(rotation)
            return float(untied(at) + sum(tie.moment(at, at) for tie in lasting))

        if gravity(0.0) <= 0:
            return 0.0
        if gravity(critical) >= 0:
            return critical
        return float(brentq(gravity, 0.0, critical, xtol=1e-16, rtol=1e-14))

    @cached_property
    def limiting_ruptures(self) -> tuple[float, ...]:
        """The rotations [rad] at which a tie breaks and a falls more than half of its maximum below it, in order."""
        ruptures = np.array(self.ruptures)
        if not ruptures.size:
            return ()
        critical = self.static.side.critical_rotation
        steps = np.linspace(0.0, critical, 41)
        places = np.concatenate([steps, ruptures * _JUST_BEFORE, self.static.side.bends])
        largest = self.acceleration(places[places <= critical]).max()
        beyond = ruptures * (2 - _JUST_BEFORE)
        after = np.where(beyond < critical, self.acceleration(np.minimum(beyond, critical)), 0.0)
        return tuple(ruptures[after < (1 - _MOST_FALL) * largest].tolist())

    def _rotation_at(self, displacement: float) -> float:
        """The rotation [rad], up to φ_cr, at which d is `displacement` [m]."""
        from scipy.optimize import brentq  # slow to import

        critical = self.static.side.critical_rotation
        if displacement >= self.displacement(critical):
            return critical
        return float(
            brentq(
                lambda at: float(self.displacement(at)) - displacement, 0.0, critical, xtol=1e-16, rtol=1e-15
            )
        )

    def limit(self, state: LimitState) -> LimitPoint:
        """Return where `state` lies on the capacity curve; the period is nan where there is no displacement.

        Where a vanishes nowhere and nothing else limits it, the displacement is inf, and the others are nan.
        """
        share = state.displacement_share
        limits = {share * self.ultimate_displacement: RockingWarning.of(CheckKind.LIMIT_SHARE, share=share)}
        ruptures = self.limiting_ruptures[self.released :] if state.ends_with_ties else ()
        if ruptures:
            limits[float(self.displacement(ruptures[0] * _JUST_BEFORE))] = RockingWarning(
                CheckKind.LIMIT_TIE_BREAKS
            )
        if self.support_loss < math.inf:
            limits[self.support_loss * self.static.displacement_factor] = RockingWarning(
                CheckKind.LIMIT_LOAD_FALLS
            )
        displacement = min(limits)
        if math.isinf(displacement):
            return LimitPoint(
                displacement=displacement,
                acceleration=math.nan,
                period=math.nan,
                reason=RockingWarning(CheckKind.LIMIT_NOWHERE),
            )
        acceleration = float(self.acceleration(self._rotation_at(displacement)))
        period = math.nan
        if displacement > 0:
            period = state.period_factor * math.sqrt(displacement / acceleration)
        return LimitPoint(
            displacement=displacement, acceleration=acceleration, period=period, reason=limits[displacement]
        )
