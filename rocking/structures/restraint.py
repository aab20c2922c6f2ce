"""What holds a wall sideways: the force that it needs, and the one that friction and ties give."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rocking.remarks import Kind, Remark

FRICTION = 0.6
"""Coefficient of friction of joints where none is given."""


class Reaction(NamedTuple):
    """What holds a wall sideways at a height [m]: a "tie", a "floor" or the "top", with its force, (k,) N per metre.

    pressing: the weight that presses the wall there against what holds it, N per metre, by whose friction it may do so.
    """

    kind: str
    height: float
    force: np.ndarray
    pressing: float = 0.0

    @property
    def needed_friction(self) -> np.ndarray:
        """The friction coefficient at which friction alone gives that force, (k,); inf where nothing presses."""
        return (
            np.maximum(self.force, 0.0) / self.pressing
            if self.pressing
            else np.where(self.force > 0, np.inf, 0.0)
        )


@dataclass(frozen=True)
class Restraint:
    """A height at which a tie or what lies on its top keeps a wall from moving outwards; forces in N per metre.

    kind: "tie" or "top". holds: the mechanism that it holds back, in words. needed: the force that this asks for at
    rest, as it starts (theory: section 12.4). friction: that of what presses on it, by `coefficient`. ties: the force
    at which they yield, inf of such as have no strength. weight: of the wall per metre; 1 where that is not known, so
    that `needed` is a share of it.
    """

    kind: str
    height: float
    holds: str
    needed: float
    friction: float = 0.0
    coefficient: float = 0.0
    ties: float = 0.0
    weight: float = 1.0

    @property
    def gives(self) -> float:
        """The force up to which it holds, N per metre."""
        return self.friction + self.ties

    @property
    def lets_go(self) -> bool:
        """Whether it moves before the wall behind it does."""
        return self.needed > self.gives

    @property
    def remark(self) -> Remark:
        """The two forces, and what follows from them."""
        about = self.holds
        facts = {"height_m": self.height, "needed_kN_m": self.needed / 1e3}
        given = facts | {"gives_kN_m": self.gives / 1e3}
        if self.kind == "tie":
            if self.ties == float("inf"):
                return Remark.of(Kind.TIE_MUST_BEAR, about, **facts)
            return Remark.of(Kind.TIE_YIELDS if self.lets_go else Kind.TIE_BEARS, about, **given)
        if self.gives == float("inf"):
            if self.weight == 1.0:
                return Remark.of(Kind.TOP_TAKEN_AS_HELD, about, share=self.needed)
            return Remark.of(Kind.TOP_MUST_BE_HELD, about, **facts)
        kind = Kind.TOP_SLIPS if self.lets_go else Kind.TOP_HOLDS
        more = {"tie_kN_m": (self.needed - self.friction) / 1e3} if self.lets_go else {}
        return Remark.of(kind, about, **given, friction=self.coefficient, **more)
