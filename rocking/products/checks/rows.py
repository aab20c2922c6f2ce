"""The row of a check of the code: its capacity and demand, and where the limit state lies on the capacity curve."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from rocking.assessment.rows import Placed, PlacedRow
from rocking.codes.check import Check, DynamicCheck, Role, StructureCheck
from rocking.codes.code_capacity import CodeCapacity, LimitPoint
from rocking.earthquakes.sample import INTERVAL
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
    def with_any_crack(self) -> Check | None:
        """The check as it would be were the crack not known; None where it is not."""
        return self.checked.with_any_crack(self.check)

    @property
    def governing(self) -> CodeCapacity:
        """The mechanism that governs."""
        return self.checked.governing

    @property
    def limit(self) -> LimitPoint | None:
        """The point of the limit state on its capacity curve."""
        return self.checked.limit

    @property
    def check_kind(self) -> str:
        """Linear, nonlinear or dynamic."""
        return KINDS[self.check.clause]

    @property
    def of_level(self) -> Check | None:
        """The check, where it is one of the acceleration of the ground."""
        return self.check if self.check.unit == "m/s²" else None

    @property
    def of_displacement(self) -> Check | None:
        """The check, where it is one of a displacement."""
        return self.check if self.check.unit == "m" else None

    @property
    def why(self) -> str:
        """Why it is not called met, or others were not made; "" where that needs no reason."""
        return str(self.check.refusal or self.checked.remark or "")

    @property
    def sets_share_low(self) -> float:
        """The lower end of the interval of the share of sets that meet it; nan for another than the dynamic one."""
        return self.dynamic.interval[0] if self.dynamic else math.nan

    @property
    def sets_share_high(self) -> float:
        """Its upper end."""
        return self.dynamic.interval[1] if self.dynamic else math.nan


of_check = Columns(MadeCheck)


@row("code_checks")
class CodeCheckRow(PlacedRow[MadeCheck]):
    """One row per structure and check of the Italian code at the design level; written by the target checks."""

    check: str = of_check("linear, nonlinear or dynamic", lambda of: of.check_kind)
    clause: str = of_check("Clause of the Circolare 7/2019", lambda of: of.check.clause)
    limit_state: str = of_check("Limit state: SLV or SLC", lambda of: of.check.limit_state)
    mechanism: str = of_check(
        "Mechanism that decides: what opens, and to which side it falls", lambda of: of.check.mechanism
    )
    passed: bool = of_check("Whether the check is met", lambda of: of.check.passed)
    part: Role = of_check(
        "Part of this check in the conclusion: it decides (the most detailed check that has an answer), counts too, is "
        "not needed (not met, where the one that decides is), overruled (met, where the one that decides is not), or "
        "has no answer (too few sets)",
        lambda of: of.checked.part_of(of.check),
    )
    ratio: float = of_check("Capacity over demand; 1 or more where it is met", lambda of: of.check.ratio)
    ratio_with_any_crack: float = of_check(
        "The same where the crack is known, were it not; linear and nonlinear check only",
        lambda of: of.with_any_crack.ratio if of.with_any_crack else math.nan,
    )
    weakest_of_any_crack: str = of_check(
        "Mechanism that would then decide",
        lambda of: of.with_any_crack.mechanism if of.with_any_crack else "",
    )
    level_capacity_m_s2: float = of_check(
        "a_g at which the limit state is reached; empty for the dynamic check",
        lambda of: of.of_level.capacity if of.of_level else math.nan,
    )
    level_demand_m_s2: float = of_check(
        "a_g of the design level; empty for the dynamic check",
        lambda of: of.of_level.demand if of.of_level else math.nan,
    )
    displacement_capacity_m: float = of_check(
        "Displacement of the limit state; dynamic check only",
        lambda of: of.of_displacement.capacity if of.of_displacement else math.nan,
    )
    displacement_demand_m: float = of_check(
        "Mean of the largest displacements of the set; dynamic check only",
        lambda of: of.of_displacement.demand if of.of_displacement else math.nan,
    )
    exceeding_motions: int | None = of_check(
        "Motions of the set under which d_0 is exceeded; dynamic check only",
        lambda of: of.dynamic.exceeding if of.dynamic else None,
    )
    motions: int | None = of_check(
        "Motions of the set; dynamic check only",
        lambda of: of.dynamic.motions if of.dynamic else None,
    )
    sets: int | None = of_check(
        "Sets that were drawn; dynamic check only",
        lambda of: of.dynamic.sets if of.dynamic else None,
    )
    sets_share: float = of_check(
        "Share of these that meet the check", lambda of: of.dynamic.share if of.dynamic else math.nan
    )
    sets_share_low: float = of_check(
        f"Lower end of its {INTERVAL} for sets of other stations",
        lambda of: of.sets_share_low,
    )
    sets_share_high: float = of_check("Upper end of that interval", lambda of: of.sets_share_high)
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
        lambda of: of.why,
    )


def code_check_rows(
    structure: str, checked: StructureCheck, support_period: float | None = None
) -> Iterator[CodeCheckRow]:
    """Yield the row of each check of a structure."""
    for check in checked.checks:
        yield CodeCheckRow.of(MadeCheck(structure, check, checked, support_period=support_period))


def _where_it_is(displacement: float) -> float:
    """A displacement of the capacity curve; nan, an empty cell, where the curve has no such point."""
    return displacement if math.isfinite(displacement) else math.nan
