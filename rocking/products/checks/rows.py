"""The row of a check of the code: its capacity and demand, and where the limit state lies on the capacity curve."""

import math
from collections.abc import Iterator

from rocking.assessment.rows import PlacedRow
from rocking.codes.check import DynamicCheck, Role, StructureCheck
from rocking.earthquakes.sample import INTERVAL
from rocking.tables import column, row

KINDS = {
    "C8.7.1.8": "linear",
    "C8.7.1.9": "linear",
    "C8.7.1.2.1.7": "linear",
    "C8.7.1.2.1.8": "nonlinear",
    "C8.7.1.2.1.9": "dynamic",
}
"""The name of a check, by its clause."""


@row("code_checks")
class CodeCheckRow(PlacedRow):
    """One row per structure and check of the Italian code at the design level; written by the target checks."""

    check: str = column("linear, nonlinear or dynamic")
    clause: str = column("Clause of the Circolare 7/2019")
    limit_state: str = column("Limit state: SLV or SLC")
    mechanism: str = column("Mechanism that decides: what opens, and to which side it falls")
    passed: bool = column("Whether the check is met")
    part: Role = column(
        "Part of this check in the conclusion: it decides (the most detailed check that has an answer), counts too, is "
        "not needed (not met, where the one that decides is), overruled (met, where the one that decides is not), or "
        "has no answer (too few sets)"
    )
    ratio: float = column("Capacity over demand; 1 or more where it is met")
    ratio_with_any_crack: float = column(
        "The same where the crack is known, were it not; linear and nonlinear check only"
    )
    weakest_of_any_crack: str = column("Mechanism that would then decide")
    level_capacity_m_s2: float = column(
        "a_g at which the limit state is reached; empty for the dynamic check"
    )
    level_demand_m_s2: float = column("a_g of the design level; empty for the dynamic check")
    displacement_capacity_m: float = column("Displacement of the limit state; dynamic check only")
    displacement_demand_m: float = column("Mean of the largest displacements of the set; dynamic check only")
    exceeding_motions: int | None = column(
        "Motions of the set under which d_0 is exceeded; dynamic check only"
    )
    motions: int | None = column("Motions of the set; dynamic check only")
    sets: int | None = column("Sets that were drawn; dynamic check only")
    sets_share: float = column("Share of these that meet the check")
    sets_share_low: float = column(f"Lower end of its {INTERVAL} for sets of other stations")
    sets_share_high: float = column("Upper end of that interval")
    onset_multiplier: float = column("α_0 of the mechanism that governs", equation="C8.7.1.1")
    participating_mass_ratio: float = column("e* of that mechanism", equation="C8.7.1.5")
    ultimate_displacement_m: float = column("d_0 of that mechanism; empty: none", equation="C8.7.1.4")
    limit_displacement_m: float = column("Displacement of the limit state of that mechanism")
    secant_period_s: float = column("Secant period at that displacement")
    confidence_factor: float = column("Confidence factor FC")
    why: str = column("Why a check is not called met, or others were not made")


def code_check_rows(
    structure: str, checked: StructureCheck, support_period: float | None = None
) -> Iterator[CodeCheckRow]:
    """Yield the row of each check of a structure."""
    governing = checked.governing
    limit = checked.limit
    for check in checked.checks:
        any_crack = checked.with_any_crack(check)
        dynamic = check if isinstance(check, DynamicCheck) else None
        of_level = check.unit == "m/s²"
        low, high = dynamic.interval if dynamic else (math.nan, math.nan)
        yield CodeCheckRow(
            structure=structure,
            support_period_s=support_period,
            check=KINDS[check.clause],
            clause=check.clause,
            limit_state=check.limit_state,
            mechanism=check.mechanism,
            passed=check.passed,
            part=checked.part_of(check),
            ratio=check.ratio,
            ratio_with_any_crack=any_crack.ratio if any_crack else math.nan,
            weakest_of_any_crack=any_crack.mechanism if any_crack else "",
            level_capacity_m_s2=check.capacity if of_level else math.nan,
            level_demand_m_s2=check.demand if of_level else math.nan,
            displacement_capacity_m=math.nan if of_level else check.capacity,
            displacement_demand_m=math.nan if of_level else check.demand,
            exceeding_motions=dynamic.exceeding if dynamic else None,
            motions=dynamic.motions if dynamic else None,
            sets=dynamic.sets if dynamic else None,
            sets_share=dynamic.share if dynamic else math.nan,
            sets_share_low=low,
            sets_share_high=high,
            onset_multiplier=governing.onset_multiplier,
            participating_mass_ratio=governing.participating_mass_ratio,
            ultimate_displacement_m=_where_it_is(governing.ultimate_displacement),
            limit_displacement_m=_where_it_is(limit.displacement) if limit else math.nan,
            secant_period_s=limit.period if limit else math.nan,
            confidence_factor=governing.confidence_factor,
            why=str(check.refusal or checked.warning or ""),
        )


def _where_it_is(displacement: float) -> float:
    """A displacement of the capacity curve; nan, an empty cell, where the curve has no such point."""
    return displacement if math.isfinite(displacement) else math.nan
