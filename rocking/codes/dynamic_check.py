"""The dynamic check of a local mechanism: Circolare 7/2019, C8.7.1.2.1.9, under sets of natural records.

The mechanism itself is followed, with its restitution, and with the confidence factor on what restores it, as on the
capacity curve that the code lets stand for it. Met under a set: d_0 is exceeded under none of its motions, and the mean
of the largest displacements is no more than that of the limit state. As that depends on the set, it is met only where
nearly all sets that were drawn say so.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rocking.codes.check import (
    BEHAVIOUR_FACTOR,
    CONFIDENCE_FACTOR,
    LEAST_OTHERS,
    LEAST_SHARE,
    CodeTerms,
    DynamicCheck,
    StructureCheck,
)
from rocking.codes.code_capacity import LIMIT_STATES, CodeCapacity, LimitState
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.kinds import CheckKind
from rocking.codes.selection import SETS, Selection
from rocking.codes.static_check import kinematic_check
from rocking.errors import ConfigurationError
from rocking.floors.support import Support
from rocking.quantities import kind_of
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Mechanism, Side, Structure
from rocking.structures.mechanism import SideTie
from rocking.warnings import RockingWarning

BOOTSTRAPS = 50
INTERVAL = 0.05, 0.95


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
    least_others: float = LEAST_OTHERS,
    records: Selection | None = None,
) -> StructureCheck:
    """Return the checks of `structure` at a limit state of the Italian code, each of the mechanism that decides it.

    The mechanism is the one that limit analysis finds between supports, and above cracks each that may open,
    to each side.

    Parameters
    ----------
    structure : Structure
        The structure; its masses are those that move.
    spectrum : DesignSpectrum
        Spectrum of the design level, for the limit state.
    limit_state : str, default 'SLV'
        "SLD", "SLV" or "SLC".
    confidence_factor : float, default 1.35
        FC, 1 or more.
    support : Support or None, optional
        Modes of what carries the structure above the ground; None: it stands on the ground.
    behaviour_factor : float, default 2.0
        q of the linear check.
    elastic_period : float, default 0.0
        T_0 of a part free to vibrate, s; 0 where it is tied rigidly.
    support_loss : float, default inf
        Horizontal displacement of the control point at which what it carries falls, m; inf: nothing does.
    least_others : float, default 0.5
        Share of the sets of other stations that must meet the dynamic check, by the lower end of its
        interval, for it to be called met.
    records : Selection or None, optional
        Sets for the dynamic check, as `rocking.select` gives them; None: without it.

    Returns
    -------
    StructureCheck
        The checks, each of the mechanism that decides it.

    Raises
    ------
    ConfigurationError
        For a value out of range.
    StructureError
        For a structure without a capacity curve.

    Examples
    --------
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    >>> checks = rocking.check(rocking.Block.of_size(breadth=0.6, height=2.0), spectrum)
    >>> checks.linear.passed, checks.nonlinear.passed
    (True, True)
    """
    for name, value, kind, words in (
        ("spectrum", spectrum, DesignSpectrum, "a DesignSpectrum, as rocking.DesignSpectrum.ntc gives it"),
        ("records", records, Selection | None, "sets of records, as rocking.select gives them, or None"),
    ):
        if not isinstance(value, kind):
            raise ConfigurationError(f"{name} is {kind_of(value)}, but must be {words}.", **{name: value})
    terms = CodeTerms(
        limit_state=limit_state,
        confidence_factor=confidence_factor,
        support=support,
        behaviour_factor=behaviour_factor,
        elastic_period=elastic_period,
        support_loss=support_loss,
        least_others=least_others,
    )
    checked = kinematic_check(structure, spectrum, terms)
    if records is None or checked.nonlinear is None:
        return checked
    return replace(checked, dynamic=_dynamic_check(checked, records, support, least_others))


def _dynamic_check(
    by_formula: StructureCheck, records: Selection, support: Support | None, least_others: float
) -> DynamicCheck:
    state = LIMIT_STATES[by_formula.limit_state]
    together = [_Body.of(sides, state) for sides in _sides_together(by_formula.mechanisms)]
    bodies = [body for body in together if any(map(math.isfinite, body.limits))]
    places = np.unique(np.concatenate([records.chosen, records.sets.ravel()]).astype(int))
    # by body and record of the pool: the mean of d over its limit, and motions under which d_0 is exceeded
    use = np.full((len(bodies), len(records.names)), np.nan)
    falls = np.zeros(use.shape, dtype=int)
    motions = np.zeros(len(records.names), dtype=int)
    for place in places:
        felt = records.scaled(int(place))
        if support is not None:
            felt = tuple(map(support.motion, felt))
        for row, body in enumerate(bodies):
            use[row, place], falls[row, place] = body.answer(felt)
            motions[place] = max(motions[place], len(felt) * len(body.polarities))
    met = _met(use, falls, records.sets)
    chosen_use = use[:, records.chosen].mean(axis=1)
    worst = int(np.argmax(np.nan_to_num(chosen_use, nan=np.inf)))
    exceeding = int(falls[:, records.chosen].sum(axis=1).max())
    limit = next(limit for limit in bodies[worst].limits if math.isfinite(limit))
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
        stations=records.sample.count,
        earthquakes=records.sample.earthquakes,
        sets=int(met.size),
        share=share,
        interval=_interval(use, falls, records, share),
    )
    return replace(found, refusal=_refusal(found, least_others, records.chosen.size))


def _refusal(found: DynamicCheck, least_others: float, size: int) -> RockingWarning | None:
    if found.exceeding:
        return RockingWarning.of(
            CheckKind.DISPLACEMENT_EXCEEDED, exceeding=found.exceeding, motions=found.motions
        )
    if not found.met_by_the_set:
        return RockingWarning(CheckKind.CHECK_NOT_MET)
    if found.sets < SETS:
        return RockingWarning.of(CheckKind.SETS_TOO_FEW, sets=found.sets, asked=SETS)
    if not found.sets_agree:
        return RockingWarning.of(
            CheckKind.SETS_DISAGREE,
            share_percent=100 * found.share,
            sets=found.sets,
            least_percent=100 * LEAST_SHARE,
        )
    low, high = found.interval
    if low < least_others:
        return RockingWarning.of(
            CheckKind.OTHERS_TOO_FEW,
            low_percent=100 * low,
            high_percent=100 * high,
            stations=found.stations,
            earthquakes=found.earthquakes,
            least_percent=100 * least_others,
            needed=stations_for(least_others, size),
        )
    return None


_MOST_STATIONS = 2000
"""Stations up to which it is said from how many on a share of other sets can be shown."""


def stations_for(least_share: float, size: int) -> int:
    """Return from how many stations on, each of another earthquake and none of which fails, at least such a share of
    the sets of `size` of other stations is shown to meet a check; no more than 2000 are reported.
    """
    for number in range(size, _MOST_STATIONS):
        _, most = _elsewhere(np.arange(number), np.zeros(number, dtype=bool), np.zeros(number, dtype=bool))
        if _none_of(number, most, size) >= least_share:
            return number
    return _MOST_STATIONS


def _met(use: np.ndarray, falls: np.ndarray, sets: np.ndarray) -> np.ndarray:
    """Whether each of the sets (s, n) meets the check with every body: (s,)."""
    met = np.ones(len(sets), dtype=bool)
    for of_body, fallen in zip(use, falls, strict=True):
        met &= (of_body[sets].mean(axis=1) <= 1) & (fallen[sets].sum(axis=1) == 0)
    return met


def _interval(use: np.ndarray, falls: np.ndarray, records: Selection, share: float) -> tuple[float, float]:
    """The 90 % interval of what sets of another pool of as many stations say: the widest of three.

    Earthquakes are drawn again, and stations within each, and with them the sets: two pools differ by √2 times what one
    does from the truth. That knows nothing of what no station of this pool does. So the stations that fail a set alone
    are bounded too: k of n here, and of another n a number that is beta-binomial (with Jeffreys' prior); a set then has
    none of them with a hypergeometric probability. So are the earthquakes of such stations. One earthquake says nothing
    of the sets of others.
    """
    if records.sample.earthquakes < 2:
        return 0.0, 1.0
    alone = np.asarray((falls > 0).any(axis=0) | (use > records.chosen.size).any(axis=0))
    sample = records.sample
    fails = np.bincount(sample.of_record, weights=alone) > 0
    rng = np.random.default_rng(0)
    shares = []
    for drawn in sample.redrawn(BOOTSTRAPS):
        sets = records.redrawn(drawn, rng)
        answered = sets[(~np.isnan(use[:, sets])).all(axis=(0, 2))]
        if len(answered):
            shares.append(float(_met(use, falls, answered).mean()))
    if not shares:
        return 0.0, 1.0
    low, high = share + math.sqrt(2) * (np.quantile(shares, INTERVAL) - share)
    lows, highs = [share, low], [share, high]
    for groups in (sample.stations, sample.events):
        fewest, most = _elsewhere(np.asarray(groups), alone, fails)
        here, best, worst = (
            _none_of(sample.count, failing, records.chosen.size) for failing in (fails.sum(), fewest, most)
        )
        lows.append(share * worst / here if here else 0.0)
        highs.append(share * best / here if here else best)
    return max(float(min(lows)), 0.0), min(float(max(highs)), 1.0)


def _elsewhere(groups: np.ndarray, alone: np.ndarray, fails: np.ndarray) -> tuple[float, float]:
    """The 5 and 95 % quantiles of the stations that fail a set alone in another pool, by stations or earthquakes.

    alone: (m,) whether a record does here; fails: (n,) whether a station does. Of each earthquake with any as many
    do as here, all of its stations where none does here.
    """
    from scipy.stats import betabinom  # half a second of import, which the rows of this check do not need

    names = np.unique(groups)
    of_group = sum(bool(alone[groups == group].any()) for group in names)
    per_group = fails.sum() / of_group if of_group else fails.size / names.size
    counts = betabinom.ppf(INTERVAL, names.size, of_group + 0.5, names.size - of_group + 0.5)
    fewest, most = (counts * per_group).tolist()
    return fewest, most


def _none_of(stations: int, failing: float, size: int) -> float:
    """The probability that a set of `size` stations has none of those that are `failing`."""
    sound = stations - round(failing)
    return math.comb(sound, size) / math.comb(stations, size) if sound >= size else 0.0


def _sides_together(mechanisms: Sequence[CodeCapacity]) -> list[tuple[CodeCapacity, ...]]:
    """The mechanisms of each crack together: one to a side, positive first; a bulge, to either side, is one alone."""
    bodies: list[tuple[CodeCapacity, ...]] = []
    for capacity in mechanisms:
        if bodies and bodies[-1][-1].candidate.structure is capacity.candidate.structure:
            bodies[-1] = (*bodies[-1], capacity)
        else:
            bodies.append((capacity,))
    return bodies


@dataclass(frozen=True, eq=False)
class _Body:
    """One crack with its sides, the mechanism that is followed, and d of the limit state on each side, m."""

    sides: tuple[CodeCapacity, ...]
    mechanism: Mechanism
    limits: tuple[float, ...]

    @classmethod
    def of(cls, sides: tuple[CodeCapacity, ...], state: LimitState) -> "_Body":
        limits = tuple(capacity.limit(state).displacement for capacity in sides)
        return cls(sides, with_confidence(sides), limits)

    @property
    def polarities(self) -> list[float]:
        """Unlike sides meet a record both ways, as nobody knows how it will come."""
        alike = len(self.sides) == 1 and not self.sides[0].one_sided
        return [1.0] if alike else [1.0, -1.0]

    def answer(self, motions: Sequence[Accelerogram]) -> tuple[float, int]:
        """Return the mean over the motions of the largest d over its limit, and under how many d_0 is exceeded."""
        # numba comes with it, and the scheduler of a study, which imports the rows of this check, needs it for nothing
        from rocking.motion.integration import Members, integrate_members

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


def with_confidence(sides: Sequence[CodeCapacity]) -> Mechanism:
    """Return the mechanism whose restoring actions are divided by the confidence factor."""
    made = [_weakened(capacity.static.side, capacity.confidence_factor) for capacity in sides]
    negative = made[1] if len(made) > 1 else None
    return Mechanism(made[0], negative, one_sided=sides[0].one_sided)


def _weakened(side: Side, factor: float) -> Side:
    """The side with G, ties included, over `factor`."""
    if factor == 1:
        return side

    def over(function: Callable[[np.ndarray], np.ndarray], rotation: np.ndarray) -> np.ndarray:
        return function(rotation) / factor

    ties = tuple(SideTie(tie.tie.over(factor), tie.stretch, tie.stretch_slope) for tie in side.ties)
    untied = side.untied_gravity and partial(over, side.untied_gravity)
    return replace(
        side,
        gravity=partial(over, side.gravity),
        gravity_slope=partial(over, side.gravity_slope),
        ties=ties,
        untied_gravity=untied,
    )
