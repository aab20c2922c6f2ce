"""The variants of a structure: what becomes of each, and by how much it differs from the first."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rocking.assessment.conclusion import Conclusion
from rocking.assessment.decide import Verdict, share_error
from rocking.tables import Columns, RowOf, row


@dataclass(frozen=True)
class Variant:
    """One of the variants of a structure; the first is the structure itself.

    name: of the scene. conclusion: on it under its worst record; None where no record gave one. first: the structure
    itself; None of that one.
    """

    structure: str
    name: str
    conclusion: Conclusion | None
    first: "Variant | None" = None

    @property
    def variant_name(self) -> str:
        """Its own name, behind that of the structure and a colon."""
        return self.name.removeprefix(f"{self.structure}: ")

    @property
    def share(self) -> float:
        """The share that overturns under its worst record; nan where none can be said."""
        return self.conclusion.row.decision.share if self.conclusion else math.nan

    @property
    def reserve(self) -> float:
        """Factor on the record at which 5 % of the members overturn; nan where none was found."""
        reserve = self.conclusion.row.reserve if self.conclusion else None
        return reserve.low if reserve else math.nan

    @property
    def share_difference(self) -> float:
        """Its share minus that of the first; nan of the first itself."""
        return self.share - self.first.share if self.first else math.nan

    @property
    def shows_difference(self) -> bool:
        """Whether its share differs from that of the first by more than both err for their number of members."""
        both = [variant.conclusion.row for variant in (self, self.first) if variant and variant.conclusion]
        error = sum(share_error(falls=row.overturning_members, members=row.members) for row in both)
        return abs(self.share_difference) > error

    @property
    def reserve_ratio(self) -> float:
        """Its reserve over that of the first; nan of the first itself."""
        return self.reserve / self.first.reserve if self.first else math.nan


of_variant = Columns(Variant)


@row("variants")
class VariantRow(RowOf[Variant]):
    """One row per variant of a structure, under its worst record; the first is the structure itself."""

    structure: str = of_variant("Name of the structure", lambda of: of.structure)
    variant: str = of_variant(
        "Name of the variant; that of the structure itself for the first", lambda of: of.variant_name
    )
    record: str = of_variant(
        "Record that is worst for it", lambda of: of.conclusion.row.record if of.conclusion else ""
    )
    verdict: Verdict | None = of_variant(
        "Verdict under it", lambda of: of.conclusion.row.verdict if of.conclusion else None
    )
    overturning_share: float = of_variant("Share that overturns under it", lambda of: of.share)
    reserve_factor: float = of_variant(
        "Factor on that record at which 5 % of the members overturn", lambda of: of.reserve
    )
    share_difference: float = of_variant("Its share minus that of the first", lambda of: of.share_difference)
    reserve_ratio: float = of_variant("Its reserve over that of the first", lambda of: of.reserve_ratio)


def variants(
    groups: Mapping[str, Sequence[str]], concluded: Iterable[Conclusion]
) -> dict[str, list[Variant]]:
    """Return the variants of each structure that has some, the structure itself first.

    groups: names of the scenes by the structure. concluded: on each scene, under its worst record.
    """
    conclusion_of = {conclusion.row.structure: conclusion for conclusion in concluded}
    made = {}
    for structure, names in groups.items():
        first = Variant(structure, structure, conclusion_of.get(structure))
        others = (Variant(structure, name, conclusion_of.get(name), first) for name in names)
        made[structure] = [first, *others]
    return made
