"""The conclusion on a structure at its design level: made once of its checks, and the same wherever it is printed."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rocking.assessment.scene import placed
from rocking.codes.check import Role, ratio_in_words, says_nothing
from rocking.codes.kinds import CheckKind
from rocking.products.checks.rows import CodeCheckRow
from rocking.quantities import counted, percents
from rocking.warnings import RockingWarning


@dataclass(frozen=True)
class CodeConclusion:
    """Whether a structure is verified at the design level, and by which clause; on a support at its worst period.

    checks: its rows there, from the plainest check to the most detailed one. elsewhere: those at other periods.
    """

    structure: str
    checks: Sequence[CodeCheckRow]
    elsewhere: Sequence["CodeConclusion"] = ()

    @property
    def period(self) -> float | None:
        """Period of the support, s: 0 of the ground below one, None on the ground itself."""
        return self.checks[0].support_period_s

    @property
    def decisive(self) -> CodeCheckRow:
        """The check that decides."""
        return next(check for check in reversed(self.checks) if check.part == Role.DECIDES)

    @property
    def verified(self) -> bool:
        """Whether it is met."""
        return self.decisive.passed

    @property
    def severity(self) -> tuple[float, ...]:
        """Key by which the worst comes last: what is not verified, then the least ratio of the most detailed check."""
        ratios = (-check.ratio for check in reversed(self.checks))
        return (not self.verified, *ratios)

    @property
    def warning(self) -> RockingWarning:
        """The conclusion: "verified by C8.7.1.2.1.9"."""
        kind = CheckKind.VERIFIED if self.verified else CheckKind.NOT_VERIFIED
        return RockingWarning.of(kind, clause=self.decisive.clause)

    @property
    def other_sets(self) -> RockingWarning | None:
        """How many sets of other stations would meet the dynamic check, where one was made."""
        if self.other_share is None:
            return None
        if says_nothing(self.other_share):
            return RockingWarning(CheckKind.OTHER_SETS_UNKNOWN)
        return RockingWarning.of(CheckKind.OTHER_SETS, share=percents(*self.other_share))

    @property
    def other_share(self) -> tuple[float, float] | None:
        """The 90 % interval of their share; None without a dynamic check."""
        shares = ((check.sets_share_low, check.sets_share_high) for check in self.checks)
        return next((share for share in shares if not math.isnan(share[0])), None)

    @property
    def other_share_in_words(self) -> str:
        """That interval: "20–100 %"; "too few stations to say" of one that spans everything, "" without one."""
        if self.other_share is None:
            return ""
        return "too few stations to say" if says_nothing(self.other_share) else percents(*self.other_share)

    @property
    def ratios(self) -> Mapping[str, str]:
        """Capacity over demand by the kind of check, "falls" where a motion lets it fall."""
        return {check.check: ratio_in_words(check.ratio) for check in self.checks}

    def __str__(self) -> str:
        """The conclusion, and after "verified" what other stations would say of it."""
        others = self.other_sets
        in_brackets = f" ({others})" if self.verified and others else ""
        return f"{self.warning}{in_brackets}"

    @property
    def name(self) -> str:
        """Name of the structure, with the period of its support."""
        return placed(self.structure, self.period)


_NAMED = 3
"""Names of a sentence at most."""


def code_conclusion_in_words(concluded: Sequence[CodeConclusion]) -> str:
    """Return the sentence on all structures: "By the code 2 of 6 structures are verified …".

    It ends in how many sets of other stations would meet the dynamic checks, by the widest interval of all, where that
    says anything. "" without any structure.
    """
    if not concluded:
        return ""
    verified = [conclusion.structure for conclusion in concluded if conclusion.verified]
    if not verified:
        return f"By the code none of {counted(len(concluded), 'structure')} is verified at the design level."
    others = [conclusion.structure for conclusion in concluded if not conclusion.verified]
    names = f": {', '.join(verified)}"
    if len(verified) > _NAMED:
        names = f", all but {', '.join(others)}" if len(others) <= _NAMED else ""
    names = names if others else ""
    verb = "is" if len(verified) == 1 else "are"
    whole = f"{len(verified)} of {counted(len(concluded), 'structure')}"
    shares = [
        conclusion.other_share for conclusion in concluded if conclusion.verified and conclusion.other_share
    ]
    end = ""
    if shares:
        widest = min(low for low, _ in shares), max(high for _, high in shares)
        end = f"; {percents(*widest)} of sets of other stations would agree"
        if says_nothing(widest):
            end = "; the pool has too few stations to speak for others"
    # Unsaid, one that is verified and overturns under the records of the study is taken for a contradiction.
    return (
        f"By the code {whole} {verb} verified at the design level{names}; these records may exceed it{end}."
    )


def code_conclusions(rows: Iterable[CodeCheckRow]) -> list[CodeConclusion]:
    """Return the conclusion on each structure, in the order of the rows, which are those of code_checks.csv.

    Of what stands on a support the worst period counts, and not the ground below it.
    """
    places: dict[str, dict[float | None, list[CodeCheckRow]]] = {}
    for row in rows:
        places.setdefault(row.structure, {}).setdefault(row.support_period_s, []).append(row)
    made = []
    for structure, by_period in places.items():
        everywhere = [CodeConclusion(structure, checks) for checks in by_period.values()]
        counting = [at_period for at_period in everywhere if at_period.period != 0] or everywhere
        worst = max(counting, key=lambda at_period: at_period.severity)
        made.append(
            CodeConclusion(
                structure, worst.checks, [at_period for at_period in everywhere if at_period is not worst]
            )
        )
    return made
