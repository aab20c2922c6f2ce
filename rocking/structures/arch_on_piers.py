"""The arch on two piers or buttresses: the mechanism that governs, by limit analysis (theory: section 5).

The hinges may open anywhere in the arch and at the feet of the piers, which are monolithic: arch alone, arch with the
right pier, arch with both.
"""

import dataclasses
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.structures.arch import GEOMETRY, Arch
from rocking.structures.arch_onset import NoMechanism, Onset, TooThin, static_onset, thrust_line
from rocking.structures.drawing import Path, plane, span
from rocking.structures.fields import Form, length_field, number_field, restitution_field
from rocking.structures.pier_ring import FOOT, PierRing

MECHANISMS = ("arch alone", "arch with one pier", "arch with both piers")
"""By the number of piers that rock."""


@dataclass(frozen=True)
class ArchOnPiers(Arch):
    """A circular arch on equal rectangular piers, flush with its intrados at the springings.

    As `Arch`, with pier_width and pier_height (from the ground to the springing), m, and pier_density_ratio: the piers'
    over the arch's. restitution: η in [0, 1], 0.9 by default. A pier that cracks obliquely or comes apart in leaves is
    weaker than this monolithic one; the wedge between its level head and an inclined springing is left out.
    Raises StructureError when it cannot stand.
    """

    type_name: ClassVar[str] = "arch_on_piers"
    forms: ClassVar[tuple[Form, ...]] = (
        Form(
            "Circular arch on equal monolithic piers, flush with the intrados",
            (
                *GEOMETRY,
                length_field("pier_width", "Width of a pier", 4.0, (0.1, 20), "b"),
                length_field("pier_height", "Height of a pier up to the springing", 6.0, (0.1, 60), "h"),
                number_field(
                    "pier_density_ratio",
                    "Density of the piers over that of the arch",
                    "",
                    1.0,
                    (0.5, 1.5),
                    bounds={"exclusiveMinimum": 0},
                ),
                restitution_field(),
            ),
        ),
    )

    pier_width: float = dataclasses.field(kw_only=True)
    pier_height: float = dataclasses.field(kw_only=True)
    pier_density_ratio: float = dataclasses.field(default=1.0, kw_only=True)

    def _check(self) -> None:
        needed = self.thickness * float(np.sin(self.embrace_angle / 2))
        if self.pier_width < needed:
            raise StructureError(
                f"pier_width is {self.pier_width!r} m, but must be at least {needed:.6g} m to carry the springing."
            )

    @property
    def ring(self) -> PierRing:
        """Arch and piers with a centreline radius of 1."""
        return PierRing(
            self.thickness / self.radius,
            self.embrace_angle,
            self.voussoirs,
            self._fill,
            self.pier_width / self.radius,
            self.pier_height / self.radius,
            self.pier_density_ratio,
        )

    @cached_property
    def onset(self) -> Onset:
        """λ of the mechanism that governs and its hinges (angles from the left springing; a foot is beyond it)."""
        self._check()
        try:
            return static_onset(self.ring)
        except TooThin:
            raise StructureError(f"{self._sentence} does not stand; make the piers wider or lower.") from None
        except NoMechanism:
            raise StructureError(
                f"{self._sentence} has no four-hinge mechanism; make the arch thinner."
            ) from None

    @property
    def _sentence(self) -> str:
        return (
            f"pier_width is {self.pier_width!r} m, but on piers of that width and {self.pier_height!r} m height an "
            f"arch of radius {self.radius!r} m and thickness {self.thickness!r} m"
        )

    @property
    def governing(self) -> str:
        """The mechanism that governs, one of MECHANISMS."""
        return MECHANISMS[int((np.abs(self._hinge_sections) > self.embrace_angle / 2 + FOOT / 2).sum())]

    def thrust_line(self, count: int = 200) -> np.ndarray:
        """Return the line of thrust at the onset: (count + 2,) points in m, from foot to foot."""
        line = thrust_line(self.ring, self.onset, np.linspace(*self._ends, count))
        feet = [self._foot_thrust(side) for side in (-1.0, 1.0)]
        return self.radius * plane(np.concatenate([feet[:1], line, feet[1:]]))

    def _foot_thrust(self, side: float) -> complex:
        """Where the thrust crosses the foot of a pier, over r: the moment about its inner corner over its weight."""
        ring, section = self.ring, np.array([side * (self.embrace_angle / 2 + FOOT)])
        unknowns = np.array([*self.onset.reaction, self.onset.multiplier, 1.0])
        inner, outer = (ring.contact_points(section, np.array([contact]))[0] for contact in (1.0, -1.0))
        at_inner, at_outer = (
            float((ring.gaps(section, np.array([contact])) @ unknowns)[0]) for contact in (1.0, -1.0)
        )
        share = at_inner / (at_inner + at_outer)
        return complex(inner + share * (outer - inner))

    def _outline(self, rotation: float) -> list[np.ndarray]:
        """The piers, then the parts of the arch."""
        piers, motion = [], self.linkage.motion(rotation)
        for side, hinge, bar in ((-1.0, 0, 0), (1.0, -1, 2)):
            corners = self.ring.pier(side)
            if abs(self._hinge_sections[hinge]) > self.embrace_angle / 2 + FOOT / 2:
                turn = np.exp(1j * motion.angles[bar])
                corners = motion.centroids[bar] + turn * (corners - self.linkage.bars.centroids[bar])
            piers.append(self.radius * plane(corners))
        return piers + super()._outline(rotation)

    def _joint_angles(self) -> np.ndarray:
        """Up through the left foot and down through the right one; along the arch elsewhere."""
        beyond = np.abs(self._hinge_sections) > self.embrace_angle / 2 + FOOT / 2
        return np.where(beyond, -np.pi / 2 * np.sign(self._hinge_sections), super()._joint_angles())

    def _dimensions(self) -> dict[str, Path]:
        inner_foot, outer_foot, outer_head, _ = self.radius * plane(self.ring.pier(1.0))
        apart = 0.1 * self.pier_height
        return super()._dimensions() | {
            "pier_width": span(inner_foot, outer_foot, [0.0, -apart]),
            "pier_height": span(outer_foot, outer_head, [apart, 0.0]),
        }
