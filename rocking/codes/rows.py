"""The row of a check of the code: its capacity and demand, and where the limit state lies on the capacity curve."""

import math
from collections.abc import Iterator, Sequence

from rocking.assessment.rows.meanings import STRUCTURE
from rocking.codes.dynamic_check import DynamicCheck, StructureCheck
from rocking.codes.static_check import Check
from rocking.quantities import counted
from rocking.tables import Row, column, row

KINDS = {
    "C8.7.1.8": "linear",
    "C8.7.1.9": "linear",
    "C8.7.1.2.1.7": "linear",
    "C8.7.1.2.1.8": "nonlinear",
    "C8.7.1.2.1.9": "dynamic",
}
"""The name of a check, by its clause."""


@row("code_checks")
class CodeCheckRow(Row):
    """One row per structure and check of the Italian code at the design level; written by the target checks."""

    structure: str = column(STRUCTURE)
    check: str = column("linear, nonlinear or dynamic")
    clause: str = column("Clause of the Circolare 7/2019")
    limit_state: str = column("Limit state: SLV or SLC")
    mechanism: str = column("Mechanism that decides: what opens, and to which side it falls")
    passed: bool = column("Whether the check is met")
    ratio: float = column("Capacity over demand; 1 or more where it is met")
    level_capacity_m_s2: float = column(
        "a_g at which the limit state is reached; empty for the dynamic check"
    )
    level_demand_m_s2: float = column("a_g of the design level; empty for the dynamic check")
    displacement_capacity_m: float = column("Displacement of the limit state; of the dynamic check alone")
    displacement_demand_m: float = column(
        "Mean of the largest displacements of the set; of the dynamic check alone"
    )
    exceeding_motions: int | None = column(
        "Motions of the set under which d_0 is exceeded; of the dynamic check alone"
    )
    motions: int | None = column("Motions of the set; of the dynamic check alone")
    sets: int | None = column("Sets that were drawn; of the dynamic check alone")
    sets_share: float = column("Share of these that meet the check")
    sets_share_low: float = column("Lower end of its 90 % interval for sets of other stations")
    sets_share_high: float = column("Upper end of that interval")
    onset_multiplier: float = column("α_0 of the mechanism that governs", equation="C8.7.1.1")
    participating_mass_ratio: float = column("e* of that mechanism", equation="C8.7.1.5")
    ultimate_displacement_m: float = column("d_0 of that mechanism; empty: none", equation="C8.7.1.4")
    limit_displacement_m: float = column("Displacement of the limit state of that mechanism")
    secant_period_s: float = column("Secant period at that displacement")
    confidence_factor: float = column("Confidence factor FC")
    why: str = column("Why a check is not called met, or others were not made")


def code_check_rows(structure: str, checked: StructureCheck) -> Iterator[CodeCheckRow]:
    """Yield the row of each check of a structure."""
    governing = checked.governing
    point = checked.limit
    for each in checked.checks:
        dynamic = each if isinstance(each, DynamicCheck) else None
        check = KINDS[each.clause]
        low, high = dynamic.interval if dynamic else (math.nan, math.nan)
        level_capacity = _of(each, "m/s²", each.capacity)
        level_demand = _of(each, "m/s²", each.demand)
        displacement_capacity = _of(each, "m", each.capacity)
        displacement_demand = _of(each, "m", each.demand)
        yield CodeCheckRow(
            structure=structure,
            check=check,
            clause=each.clause,
            limit_state=each.limit_state,
            mechanism=each.mechanism,
            passed=each.passed,
            ratio=each.ratio,
            level_capacity_m_s2=level_capacity,
            level_demand_m_s2=level_demand,
            displacement_capacity_m=displacement_capacity,
            displacement_demand_m=displacement_demand,
            exceeding_motions=dynamic.exceeding if dynamic else None,
            motions=dynamic.motions if dynamic else None,
            sets=dynamic.sets if dynamic else None,
            sets_share=dynamic.share if dynamic else math.nan,
            sets_share_low=low,
            sets_share_high=high,
            onset_multiplier=governing.onset_multiplier,
            participating_mass_ratio=governing.participating_mass_ratio,
            ultimate_displacement_m=_where_it_is(governing.ultimate_displacement),
            limit_displacement_m=_where_it_is(point.displacement) if point else math.nan,
            secant_period_s=point.period if point else math.nan,
            confidence_factor=governing.confidence_factor,
            why=each.refusal or checked.remark,
        )


def _of(check: Check, unit: str, value: float) -> float:
    return value if check.unit == unit else math.nan


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
