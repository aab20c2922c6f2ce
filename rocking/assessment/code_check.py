"""The checks of a local mechanism that the Italian code asks for: Circolare 7/2019, C8.7.1.2.1, to the NTC 2018.

Linear and nonlinear kinematics here; the dynamic check, C8.7.1.2.1.9, is that of `dynamic_check`. What crosses over
from the structure is its capacity by virtual work (`StaticCapacity`): α(d_C), e* and d of C8.7.1.1, 4 and 5. Masses Q
that push without resting on the chain are not implemented, nor are other codes.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rocking.errors import ConfigurationError, StructureError
from rocking.quantities import GRAVITY, finite, positive
from rocking.records.design_spectrum import DesignSpectrum
from rocking.records.floor_demand import FloorDemand
from rocking.records.support import Support
from rocking.structures import Structure
from rocking.structures.capacity import StaticCapacity

CONFIDENCE_FACTOR = 1.35
"""The factor of the level of knowledge LC1, which C8.7.1.2.1 asks for unless crushing enters α; here it does not."""

BEHAVIOUR_FACTOR = 2.0
"""q of the linear check where no better one is known (C8.7.1.2.1.7)."""

_MOST_FALL = 0.5
"""Share of the largest capacity in acceleration by which it may fall as a part breaks (C8.7.1.2.1.6)."""
_JUST_BEFORE = 1 - 1e-12
Demand = Callable[[np.ndarray], np.ndarray]
"""The demand on a mechanism at levels (n,) of the spectrum, m/s²."""


@dataclass(frozen=True)
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
    "SLV": LimitState("SLV", 0.4, 1.68 * math.pi, 0.08, ends_with_ties=True),
    "SLC": LimitState("SLC", 0.6, 1.56 * math.pi, 0.10, ends_with_ties=False),
}
"""C8.7.1.2.1.6 and C8.7.1.2.1.8; the limit state of damage, SLD, has the linear check alone."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """One check of one limit state, with the mechanism that decides it.

    capacity, demand: a_g on rock [m/s²] at which the limit state is reached and that of the spectrum, or displacements
    [m], as `unit` says. mechanism: what opens, and to which side it falls. refusal: why it is not called met, where
    that is not in the numbers.

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
    refusal: str = ""

    @property
    def ratio(self) -> float:
        """Capacity over demand; 1 or more where it is met."""
        return self.capacity / self.demand if self.demand else math.inf

    @property
    def passed(self) -> bool:
        """Whether the check is met."""
        return not self.refusal and self.capacity >= self.demand

    def __str__(self) -> str:
        outcome = self.refusal or ("met" if self.passed else "not met")
        return (
            f"{self.clause}, {self.limit_state}: capacity {self.capacity:.4g} {self.unit}, demand "
            f"{self.demand:.4g} {self.unit}, ratio {self.ratio:.3g}, {outcome} ({self.mechanism})"
        )


@dataclass(frozen=True)
class LimitPoint:
    """The place of a limit state on the capacity curve: d [m], a [m/s²], the secant period [s], and the reason."""

    displacement: float
    acceleration: float
    period: float
    reason: str


@dataclass(frozen=True, eq=False)
class LocalMechanism:
    """One mechanism to one side as the code sees it: one degree of freedom, with the confidence factor in it.

    description: what opens, to which side. body: the structure with that crack. sign: of the rotation. elastic_period:
    T_0 of a part free to vibrate, s; 0 of one tied rigidly to the structure. support_loss: horizontal displacement of
    the control point at which what it carries falls, m; inf where nothing does. one_sided: whether it leans on
    something.
    """

    description: str
    body: Structure
    sign: int
    static: StaticCapacity
    confidence_factor: float
    elastic_period: float = 0.0
    support_loss: float = math.inf
    one_sided: bool = False

    @property
    def onset_multiplier(self) -> float:
        """α_0 (C8.7.1.1)."""
        return self.static.side.uplift_multiplier

    @property
    def participating_mass_ratio(self) -> float:
        """e* (C8.7.1.5); weights that something else holds sideways are left out, which is on the safe side."""
        return self.static.participating_mass_ratio

    @property
    def onset_acceleration(self) -> float:
        """α_0 g/(e* FC), m/s² (C8.7.1.8)."""
        return self.onset_multiplier * GRAVITY / (self.participating_mass_ratio * self.confidence_factor)

    def displacement(self, rotation: float) -> float:
        """Return d [m] (C8.7.1.4)."""
        return float(self.static.displacement(rotation)) * self.static.displacement_factor

    def acceleration(self, rotation: float) -> float:
        """Return a [m/s²]: C8.7.1.3, and of a part free to vibrate at most its elastic branch, C8.7.1.6."""
        multiplier = float(self.static.multiplier(rotation))
        rigid = multiplier * GRAVITY / (self.participating_mass_ratio * self.confidence_factor)
        if not self.elastic_period:
            return rigid
        elastic = (2 * math.pi / self.elastic_period) ** 2 * self.displacement(rotation)
        return min(rigid, elastic)

    @cached_property
    def ultimate_displacement(self) -> float:
        """d_0 [m], where a vanishes with only such actions as hold on until then; inf where it vanishes nowhere."""
        if not self.static.side.can_overturn:
            return math.inf
        return self.displacement(self.static.collapse_rotation)

    @cached_property
    def _limiting_rupture(self) -> float:
        """The rotation at which a tie breaks and a falls more than half of its maximum below it; inf without."""
        ruptures = self.static.ruptures
        if not ruptures:
            return math.inf
        critical = self.static.side.critical_rotation
        just_before = [rotation * _JUST_BEFORE for rotation in ruptures]
        places = np.unique([*np.linspace(0.0, critical, 41), *just_before, *self.static.side.bends])
        largest = max(self.acceleration(float(each)) for each in places if each <= critical)
        for rotation in ruptures:
            beyond = rotation * (2 - _JUST_BEFORE)
            after = self.acceleration(beyond) if beyond < critical else 0.0
            if after < (1 - _MOST_FALL) * largest:
                return rotation
        return math.inf

    def limit(self, state: LimitState) -> LimitPoint:
        """Return where `state` lies on the capacity curve; the period is nan where there is no displacement.

        Where a vanishes nowhere and nothing else limits it, the displacement is inf, and the others are nan.
        """
        share = state.displacement_share
        limits = {share * self.ultimate_displacement: f"{share:g} d₀"}
        if state.ends_with_ties and self._limiting_rupture < math.inf:
            limits[self.displacement(self._limiting_rupture * _JUST_BEFORE)] = "a tie breaks"
        if self.support_loss < math.inf:
            limits[self.support_loss * self.static.displacement_factor] = "what it carries falls"
        displacement = min(limits)
        if math.isinf(displacement):
            return LimitPoint(displacement, math.nan, math.nan, "a vanishes nowhere")
        rotation = self.static.rotation_at(displacement / self.static.displacement_factor)
        acceleration = self.acceleration(rotation)
        period = math.nan
        if displacement > 0:
            period = state.period_factor * math.sqrt(displacement / acceleration)
        return LimitPoint(displacement, acceleration, period, limits[displacement])


def elastic_period(
    length: float,
    thickness: float,
    unit_weight: float,
    elastic_modulus: float,
    *,
    cantilever: bool = True,
) -> float:
    """Return T_0 = κ λ L √(W/(E g)), s (C8.7.1.7), of a part that is free to vibrate, λ = L/t.

    length, thickness: m. unit_weight: W, N/m³. elastic_modulus: E, Pa. cantilever: κ = 6.2, else between two supports,
    2.2. Raises ConfigurationError for what is not above zero.

    >>> from rocking.assessment.code_check import elastic_period
    >>> round(elastic_period(2.0, 0.3, 18e3, 1e9), 4)
    0.112
    """
    given = {
        "length": length,
        "thickness": thickness,
        "unit_weight": unit_weight,
        "elastic_modulus": elastic_modulus,
    }
    for name, value in given.items():
        positive(ConfigurationError, name, value)
    factor = 6.2 if cantilever else 2.2
    slenderness = length / thickness
    return factor * slenderness * length * math.sqrt(unit_weight / (elastic_modulus * GRAVITY))


@dataclass(frozen=True, eq=False, kw_only=True)
class CodeCheck:
    """The kinematic checks of one structure at one limit state.

    linear: None for SLC, of which the code has none. nonlinear: None for SLD, and where nothing can overturn, which
    `remark` then says. mechanisms: all that were checked. damage_level: the least a_g [m/s²] at which a mechanism
    starts, that of SLD.
    """

    limit_state: str
    linear: Check | None
    nonlinear: Check | None
    damage_level: float
    mechanisms: tuple[LocalMechanism, ...] = field(repr=False)
    governing: LocalMechanism = field(repr=False)
    remark: str = ""

    @property
    def checks(self) -> tuple[Check, ...]:
        """Those that the limit state has."""
        return tuple(each for each in (self.linear, self.nonlinear) if each)

    @property
    def limit(self) -> LimitPoint | None:
        """The place of the limit state on the curve of the mechanism that governs; None for SLD."""
        state = LIMIT_STATES.get(self.limit_state)
        return self.governing.limit(state) if state else None


def kinematic_check(
    structure: Structure,
    spectrum: DesignSpectrum,
    *,
    limit_state: str = "SLV",
    confidence_factor: float = CONFIDENCE_FACTOR,
    support: Support | None = None,
    behaviour_factor: float = BEHAVIOUR_FACTOR,
    elastic_period: float = 0.0,
    support_loss: float = math.inf,
) -> CodeCheck:
    """Return the linear and the nonlinear check of `structure`; see `check`."""
    if limit_state not in ("SLD", *LIMIT_STATES):
        raise ConfigurationError(
            f"limit_state is {limit_state!r}, but must be one of SLD, {', '.join(LIMIT_STATES)}."
        )
    confidence = _at_least_one("confidence_factor", confidence_factor)
    behaviour = _at_least_one("behaviour_factor", behaviour_factor)
    if finite(ConfigurationError, "elastic_period", elastic_period, "s") < 0:
        raise ConfigurationError(f"elastic_period is {elastic_period!r} s, but must be 0 or more.")
    loss = math.inf
    if support_loss != math.inf:
        loss = positive(ConfigurationError, "support_loss", support_loss, "m")
    floor = FloorDemand(spectrum, support)
    mechanisms = tuple(
        LocalMechanism(
            description=words,
            body=body,
            sign=sign,
            static=body.static_capacity(sign),
            confidence_factor=confidence,
            elastic_period=elastic_period,
            support_loss=loss,
            one_sided=structure.one_sided,
        )
        for words, sign, body in _opening(structure)
    )
    # What lets the weakest mechanism start does so at the least level, as all feel the same motion.
    first = int(np.argmin([each.onset_acceleration for each in mechanisms]))
    damage = _damage_level(mechanisms[first], floor)
    linear = nonlinear = None
    remark = ""
    governing = mechanisms[first]
    if limit_state != "SLC":
        clause = "C8.7.1.2.1.7"
        if limit_state == "SLD":
            behaviour = 1.0
            clause = "C8.7.1.9" if elastic_period else "C8.7.1.8"
        linear = Check(
            clause=clause,
            limit_state=limit_state,
            capacity=behaviour * damage,
            demand=spectrum.level,
            mechanism=mechanisms[first].description,
        )
    if limit_state in LIMIT_STATES:
        governed_by, capacity = _weakest(mechanisms, floor, LIMIT_STATES[limit_state])
        if math.isinf(capacity):
            remark = _not_made(mechanisms[first])
        else:
            governing = mechanisms[governed_by]
            nonlinear = Check(
                clause="C8.7.1.2.1.8",
                limit_state=limit_state,
                capacity=capacity,
                demand=spectrum.level,
                mechanism=governing.description,
            )
    return CodeCheck(
        limit_state=limit_state,
        linear=linear,
        nonlinear=nonlinear,
        damage_level=damage,
        mechanisms=mechanisms,
        governing=governing,
        remark=remark,
    )


def _not_made(mechanism: LocalMechanism) -> str:
    """Why checks that need d_0 were not made."""
    return (
        f"It cannot overturn: it {mechanism.body.mechanism().never_lets_go}. The displacement d₀ that the nonlinear "
        "and the dynamic check ask for does not exist, so that neither was made; the force in the ties is not checked."
    )


def _at_least_one(name: str, value: float) -> float:
    number = finite(ConfigurationError, name, value)
    if number < 1:
        raise ConfigurationError(f"{name} is {value!r}, but must be 1 or more.")
    return number


def _opening(structure: Structure) -> Iterator[tuple[str, int, Structure]]:
    """The mechanisms that may open: crack and side of the fall, sign of that side, and the structure with the crack.

    Of hinges between supports those that limit analysis finds, of other cracks all that may open.
    """
    if not isinstance(structure, Structure):
        raise StructureError(
            f"the structure is a {type(structure).__name__}, which has no capacity curve; give a structure with a "
            "geometry, as rocking.Block or rocking.Facade."
        )
    candidates = structure.candidates()
    for candidate in candidates[:1] if structure.statics_chooses else candidates:
        body = candidate.structure
        opens = "" if candidate.description == "as given" else f"{candidate.description}, "
        signs = (1,) if body.symmetric or body.one_sided else (1, -1)
        for sign, side in zip(signs, body.side_names, strict=False):
            falls = "" if body.symmetric else side
            yield f"{opens}{falls}".removesuffix(", ") or "as given", sign, body


def _felt_by(floor: FloorDemand, period: float) -> Demand:
    """The acceleration [m/s²] that a mechanism of elastic `period` [s] feels as it starts: C8.7.1.8, or C8.7.1.9."""
    if not period:
        return floor.peak

    def felt(level: np.ndarray) -> np.ndarray:
        return floor.acceleration(period, level, floor.spectrum.damping)

    return felt


def _damage_level(mechanism: LocalMechanism, floor: FloorDemand) -> float:
    """a_g [m/s²] at which the mechanism starts."""
    felt = _felt_by(floor, mechanism.elastic_period)
    return Crossing.of(floor.spectrum, felt, mechanism.onset_acceleration).level


def _weakest(
    mechanisms: Sequence[LocalMechanism], floor: FloorDemand, state: LimitState
) -> tuple[int, float]:
    """The place of the mechanism that reaches `state` at the least a_g, and that a_g [m/s²]; inf where none does.

    a_g,SLV is never below a_g,SLD. Levels are refined only of such mechanisms as may be the weakest.
    """
    crossings = [_collapse(each, floor, state) for each in mechanisms]
    lowest = [each.low if isinstance(each, Crossing) else each for each in crossings]
    weakest, least = int(np.argmin(lowest)), math.inf
    for place in np.argsort(lowest, kind="stable").tolist():
        if lowest[place] > least:
            break
        crossing = crossings[place]
        level = crossing.level if isinstance(crossing, Crossing) else crossing
        mechanism = mechanisms[place]
        felt = _felt_by(floor, mechanism.elastic_period)
        if math.isfinite(level) and float(felt(np.array(level))) < mechanism.onset_acceleration:
            level = max(level, _damage_level(mechanism, floor))
        if level < least or (level == least and place < weakest):
            weakest, least = place, level
    return weakest, least


def _collapse(mechanism: LocalMechanism, floor: FloorDemand, state: LimitState) -> "Crossing | float":
    """The a_g at which the displacement demand at the secant period is that of the limit state."""
    point = mechanism.limit(state)
    if not point.displacement > 0:
        return 0.0
    if math.isinf(point.displacement):
        return math.inf

    def asked(level: np.ndarray) -> np.ndarray:
        return floor.displacement(mechanism.elastic_period, point.period, level, state.damping)

    return Crossing.of(floor.spectrum, asked, point.displacement)


@dataclass(frozen=True)
class Crossing:
    """The least level [m/s²] of a spectrum at which a demand reaches a capacity, between `low` and `high`.

    On soft soil the factor S_S falls with a_g, so that it may be reached more than once.
    """

    demand: Demand
    capacity: float
    low: float
    high: float

    @classmethod
    def of(cls, spectrum: DesignSpectrum, demand: Demand, capacity: float) -> "Crossing":
        """Return the first one. demand: of levels (n,)."""
        near = spectrum.level * capacity / float(demand(np.array(spectrum.level)))
        levels = near * _TRIED
        beyond = int(np.argmax(demand(levels) >= capacity))
        return cls(demand, capacity, float(levels[beyond - 1]), float(levels[beyond]))

    @property
    def level(self) -> float:
        """The level itself."""
        from scipy.optimize import brentq  # slow to import, and needed by checks only

        return float(brentq(self._missing, self.low, self.high, rtol=1e-14, xtol=1e-16))

    def _missing(self, level: float) -> float:
        return float(self.demand(np.array(level))) - self.capacity


_TRIED = np.geomspace(1e-2, 1e2, 801)
"""Levels over a first guess among which a crossing is sought."""
