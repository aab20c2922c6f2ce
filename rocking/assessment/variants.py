"""The variants of a structure: what becomes of each, and by how much it differs from the first."""

import math
from collections.abc import Iterable, Mapping, Sequence

from rocking.assessment.conclusion import Conclusion
from rocking.assessment.decide import Verdict, share_error
from rocking.tables import Row, column, row


@row("variants")
class VariantRow(Row):
    """One row per variant of a structure, under its worst record; the first is the structure itself.

    name: of the scene. conclusion: on it under its worst record; None where no record gave one. shows_difference:
    whether its share differs from that of the first by more than both err for their number of members.
    """

    name: str
    conclusion: Conclusion | None
    shows_difference: bool
    structure: str = column("Name of the structure")
    variant: str = column("Name of the variant; that of the structure itself for the first")
    record: str = column("Record that is worst for it")
    verdict: Verdict | None = column("Verdict under it")
    overturning_share: float = column("Share that overturns under it")
    reserve_factor: float = column("Factor on that record at which 5 % of the members overturn")
    share_difference: float = column("Its share minus that of the first")
    reserve_ratio: float = column("Its reserve over that of the first")


def variants(
    groups: Mapping[str, Sequence[str]], concluded: Iterable[Conclusion]
) -> dict[str, list[VariantRow]]:
    """Return the variants of each structure that has some, the structure itself first.

    groups: names of the scenes by the structure. concluded: on each scene, under its worst record.
    """
    of = {conclusion.row.structure: conclusion for conclusion in concluded}
    return {
        structure: [
            _variant(structure, name, of.get(name), of.get(structure)) for name in (structure, *names)
        ]
        for structure, names in groups.items()
    }


def _variant(
    structure: str, name: str, conclusion: Conclusion | None, first: Conclusion | None
) -> VariantRow:
    """One of the variants. conclusion, first: on it, and on the structure itself."""
    both = [one.row for one in (conclusion, first) if one]
    error = sum(share_error(falls=row.overturning_members, members=row.members) for row in both)
    own_row = conclusion.row if conclusion else None
    (share, reserve), (first_share, first_reserve) = map(_share_and_reserve, (conclusion, first))
    is_first = name == structure
    difference = math.nan if is_first else share - first_share
    return VariantRow(
        name=name,
        conclusion=conclusion,
        shows_difference=abs(difference) > error,
        structure=structure,
        variant=name.removeprefix(f"{structure}: "),
        record=own_row.record if own_row else "",
        verdict=own_row.verdict if own_row else None,
        overturning_share=share,
        reserve_factor=reserve,
        share_difference=difference,
        reserve_ratio=math.nan if is_first else reserve / first_reserve,
    )


def _share_and_reserve(conclusion: Conclusion | None) -> tuple[float, float]:
    """The share that overturns and the factor at which 5 % of the members do; nan where none is known."""
    if conclusion is None:
        return math.nan, math.nan
    reserve = conclusion.row.reserve
    return conclusion.row.decision.share, reserve.low if reserve else math.nan
