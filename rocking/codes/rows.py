"""The row of a check of the code: its capacity and demand, and where the limit state lies on the capacity curve."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rocking.assessment.rows import Placed, PlacedRow
from rocking.codes.check import Check, DynamicCheck, StructureCheck
from rocking.codes.local_mechanism import LimitPoint, LocalMechanism
from rocking.quantities import counted
from rocking.tables import Columns, row

KINDS = {
    "C8.7.1.8": "linear",
    "C8.7.1.9": "linear",
    "C8.7.1.2.1.7": "linear",
    "C8.7.1.2.1.8": "nonlinear",
    "C8.7.1.2.1.9": "dynamic",
}
"""The name of a check, by its clause."""


@dataclass(frozen=True)
class MadeCheck(Placed):
    """One check of one structure, with all that was found of it."""

    check: Check
    checked: StructureCheck

    @property
    def dynamic(self) -> DynamicCheck | None:
        """The check, where it is the dynamic one."""
        return self.check if isinstance(self.check, DynamicCheck) else None

    @property
    def governing(self) -> LocalMechanism:
        """The mechanism that governs."""
        return self.checked.governing

    @property
    def limit(self) -> LimitPoint | None:
        """The point of the limit state on its capacity curve."""
        return self.checked.limit

    def capacity(self, unit: str) -> float:
        """Return the capacity where it is of this unit, else nan."""
        return self.check.capacity if self.check.unit == unit else math.nan

    def demand(self, unit: str) -> float:
        """Return the demand where it is of this unit, else nan."""
        return self.check.demand if self.check.unit == unit else math.nan


of_check = Columns(MadeCheck)


@row("code_checks")
class CodeCheckRow(PlacedRow[MadeCheck]):
    """One row per structure and check of the Italian code at the design level; written by the target checks."""

    check: str = of_check("linear, nonlinear or dynamic", lambda of: KINDS[of.check.clause])
    clause: str = of_check("Clause of the Circolare 7/2019", lambda of: of.check.clause)
    limit_state: str = of_check("Limit state: SLV or SLC", lambda of: of.check.limit_state)
    mechanism: str = of_check(
        "Mechanism that decides: what opens, and to which side it falls", lambda of: of.check.mechanism
    )
    passed: bool = of_check("Whether the check is met", lambda of: of.check.passed)
    ratio: float = of_check("Capacity over demand; 1 or more where it is met", lambda of: of.check.ratio)
    level_capacity_m_s2: float = of_check(
        "a_g at which the limit state is reached; empty for the dynamic check", lambda of: of.capacity("m/s²")
    )
    level_demand_m_s2: float = of_check(
        "a_g of the design level; empty for the dynamic check", lambda of: of.demand("m/s²")
    )
    displacement_capacity_m: float = of_check(
        "Displacement of the limit state; of the dynamic check alone", lambda of: of.capacity("m")
    )
    displacement_demand_m: float = of_check(
        "Mean of the largest displacements of the set; of the dynamic check alone", lambda of: of.demand("m")
    )
    exceeding_motions: int | None = of_check(
        "Motions of the set under which d_0 is exceeded; of the dynamic check alone",
        lambda of: of.dynamic.exceeding if of.dynamic else None,
    )
    motions: int | None = of_check(
        "Motions of the set; of the dynamic check alone",
        lambda of: of.dynamic.motions if of.dynamic else None,
    )
    sets: int | None = of_check(
        "Sets that were drawn; of the dynamic check alone",
        lambda of: of.dynamic.sets if of.dynamic else None,
    )
    sets_share: float = of_check(
        "Share of these that meet the check", lambda of: of.dynamic.share if of.dynamic else math.nan
    )
    sets_share_low: float = of_check(
        "Lower end of its 90 % interval for sets of other stations",
        lambda of: of.dynamic.interval[0] if of.dynamic else math.nan,
    )
    sets_share_high: float = of_check(
        "Upper end of that interval", lambda of: of.dynamic.interval[1] if of.dynamic else math.nan
    )
    onset_multiplier: float = of_check(
        "α_0 of the mechanism that governs", lambda of: of.governing.onset_multiplier, equation="C8.7.1.1"
    )
    participating_mass_ratio: float = of_check(
        "e* of that mechanism", lambda of: of.governing.participating_mass_ratio, equation="C8.7.1.5"
    )
    ultimate_displacement_m: float = of_check(
        "d_0 of that mechanism; empty: none",
        lambda of: _where_it_is(of.governing.ultimate_displacement),
        equation="C8.7.1.4",
    )
    limit_displacement_m: float = of_check(
        "Displacement of the limit state of that mechanism",
        lambda of: _where_it_is(of.limit.displacement) if of.limit else math.nan,
    )
    secant_period_s: float = of_check(
        "Secant period at that displacement", lambda of: of.limit.period if of.limit else math.nan
    )
    confidence_factor: float = of_check("Confidence factor FC", lambda of: of.governing.confidence_factor)
    why: str = of_check(
        "Why a check is not called met, or others were not made",
        lambda of: str(of.check.refusal or of.checked.remark or ""),
    )


def code_check_rows(
    structure: str, checked: StructureCheck, support_period: float | None = None
) -> Iterator[CodeCheckRow]:
    """Yield the row of each check of a structure."""
    for each in checked.checks:
        yield CodeCheckRow.of(MadeCheck(structure, each, checked, support_period=support_period))


def _where_it_is(displacement: float) -> float:
    """A displacement of the capacity curve; nan, an empty cell, where the curve has no such point."""
    return displacement if math.isfinite(displacement) else math.nan


def disagreement(checked: StructureCheck, overturning_share: float, stations: int) -> str:
    """Return the sentence on where the formulas and the dynamics disagree, with both figures; "" where they do not.

    overturning_share: of the records of the study; nan where there are none. stations: how many these are of.
    Formulas that are met disagree with a dynamic check that is not or that depends on the set, or with a structure that
    overturns under more than a tenth of the records; those that are not met, with a dynamic check that is and a
    structure that never overturns.
    """
    formulas = [each for each in checked.checks if not isinstance(each, DynamicCheck)]
    met = [each for each in formulas if each.passed]
    failed = [each for each in formulas if not each.passed]
    against_met = _against_met(checked.dynamic, overturning_share, stations)
    against_failed = _against_failed(checked.dynamic, overturning_share, stations)
    sentences = []
    if met and against_met:
        sentences.append(f"{_with_ratios(met, 'met')}, but {against_met}.")
    if failed and against_failed:
        sentences.append(f"{_with_ratios(failed, 'not met')}, but {against_failed}.")
    return " ".join(sentences)


def _with_ratios(checks: Sequence[Check], outcome: str) -> str:
    """The checks of one outcome with their ratios: "The linear check is met with a ratio of 1.08"."""
    names = " and the ".join(KINDS[each.clause] for each in checks)
    ratios = " and ".join(f"{each.ratio_in_words}" for each in checks)
    if len(checks) == 1:
        return f"The {names} check is {outcome} with a ratio of {ratios}"
    return f"The {names} check are {outcome} with ratios of {ratios}"


def _against_met(dynamic: DynamicCheck | None, overturning_share: float, stations: int) -> str:
    """The finding of the dynamics that speaks against formulas that are met; "" where there is none.

    That fewer sets were drawn than must be asked is none.
    """
    if dynamic is not None and not dynamic.met_by_the_set:
        return f"the dynamic check is not: {_why(dynamic)}"
    if dynamic is not None and not dynamic.sets_agree:
        return f"whether the dynamic check is depends on the records: the chosen set meets it, and {dynamic.sentence}"
    if overturning_share > _OFTEN:
        return _of_records(overturning_share, stations)
    return ""


def _against_failed(dynamic: DynamicCheck | None, overturning_share: float, stations: int) -> str:
    """The finding of the dynamics that speaks against formulas that are not met; "" where there is none."""
    if dynamic is not None:
        return f"the dynamic check is with one of {dynamic.ratio_in_words}" if dynamic.passed else ""
    return _of_records(overturning_share, stations) if overturning_share == 0 else ""


def _of_records(overturning_share: float, stations: int) -> str:
    share = f"{100 * overturning_share:.0f} %"
    return f"under the records of the study, of {counted(stations, 'station')}, it overturns with a share of {share}"


_OFTEN = 0.1
"""Share of the records beyond which a structure that passes a formula is said to contradict it."""


def _why(dynamic: DynamicCheck) -> str:
    """The reason for which the chosen set does not meet the dynamic check, with the share of the sets that do."""
    if dynamic.exceeding:
        return (
            f"d₀ is exceeded under {dynamic.exceeding} of {dynamic.motions} motions, and {dynamic.sentence}"
        )
    allowed = f"{dynamic.capacity:.3g} m are allowed"
    return f"the mean displacement is {dynamic.demand:.3g} m where {allowed}, and {dynamic.sentence}"
