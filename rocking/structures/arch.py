"""The circular masonry arch that rocks as a four-hinge mechanism (Fig. 5; theory: section 5), alone or on two piers.

On piers the hinges may open anywhere in the arch and at the feet of the piers, which are monolithic: arch alone, arch
with the right pier, arch with both.
"""

import math
import warnings
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from rocking.errors import DoesNotStandError, StructureError, StructureWarning
from rocking.structures.arch_mechanism import (
    FourBar,
    NoMechanism,
    Onset,
    TooThin,
    limiting_thickness,
    multiplier_on_friction,
    onset_at,
    other_hinges,
    static_onset,
)
from rocking.structures.arch_ring import EXTRADOS, INTRADOS, PATTERN, Bars, Fill, Piers, Ring
from rocking.structures.crackable import Crackable, unplaced
from rocking.structures.drawing import Path, plane, span, swept
from rocking.structures.fields import OptionalUnitWeight, Value, count, length, restitution_value, stated
from rocking.structures.linkage import PRESSED, STILL, Restitution, momentum_balance
from rocking.structures.stones import Stones, chain, counted_voussoirs
from rocking.structures.structure import Candidate, Mechanisms
from rocking.warnings import Phrase

_CRUSHINGS = 60
_CRUSHED_ALIKE = 1e-14
"""A change of λ that is rounding."""
_LIFTS_FROM = 0.99
"""Share of the λ of its mechanism below which the λ of statics with friction says that it slides before it lifts."""
UNSAFE_MOMENTUM = "unsafe momentum"
"""The balance of the mirrored mechanism by its name: it loses more speed than the hinges of a real arch do."""


_STANDS_ON_FRICTION = 0.5
"""In 70 pairs of an arch and a motion that it stands as a mechanism none fell as voussoirs on joints of 0.6, nor in 63
runs on joints of 0.5; on 0.4 there fell 6 of 63."""


@stated
@dataclass(frozen=True, repr=False)
class Arch(Crackable):
    """A circular arch of radial joints, its bars exact annular sectors; φ is the rotation of the bar AB.

    Raises
    ------
    StructureError
        When it cannot stand, or has no four-hinge mechanism; the message names the bound.

    Examples
    --------
    >>> rocking.Arch(radius=10.0, thickness=1.5, embrace_angle=2.75).mechanism()
    Mechanism(λ = 0.3528, φ_cr = 0.09068 rad, p = 1.779 rad/s, η = 0.9)
    """

    type_name: ClassVar[str] = "arch"
    crack_name: ClassVar[str] = "hinges"
    statics_chooses: ClassVar[bool] = True
    _usual_restitution: ClassVar[float | str] = 0.9
    _described_as: ClassVar[dict[str, str]] = {
        "": "Circular arch with radial joints; radius of the centreline"
    }

    radius: Annotated[float, length("Radius of the centreline", 10.0, (0.3, 50), "r")]
    thickness: Annotated[float, length("Radial thickness", 1.5, (0.03, 5), "t")]
    embrace_angle: Annotated[
        float, Value("Embrace angle", 157.5, "°", (60, 240), "β", bounds={"ge": 5, "le": 270})
    ]
    voussoirs: Annotated[
        int | None, count("How many equal voussoirs; left out when hinges may open anywhere", 7, 3, 1000)
    ] = None
    restitution: Annotated[Restitution, restitution_value(UNSAFE_MOMENTUM)] = None
    fill_depth: Annotated[
        float | None,
        Value(
            "Depth of level fill above the extrados at the crown; left out without fill",
            0.2,
            "m",
            (0, 3),
            "f",
            bounds={"ge": 0, "le": 1000},
        ),
    ] = None
    fill_density_ratio: Annotated[
        float,
        Value(
            "Density of the fill over that of the masonry", 0.8, usual=(0.3, 1.2), bounds={"ge": 0, "le": 10}
        ),
    ] = 0.8
    # No key of a list, as the angles that would say where are none.
    crack: Annotated[Literal["known"] | None, "known where a survey found the hinge_angles"] = field(
        default=None, kw_only=True
    )
    hinge_angles: Annotated[
        tuple[float, ...] | None,
        "Angles of the hinges A, B, C and D from the left springing, rad; left out: where statics puts them",
    ] = field(default=None, kw_only=True)
    unit_weight: OptionalUnitWeight = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        if self.restitution == "momentum":
            raise StructureError(
                "restitution is 'momentum', but that balance takes more speed from an arch than its hinges do, on "
                "the unsafe side; give a number, such as the default of 0.9, or, of an arch without piers, "
                f"{UNSAFE_MOMENTUM!r} to take it all the same.",
                restitution="momentum",
            )
        super().__post_init__()
        said = f" m, but must be less than twice the radius of {self.radius!r} m."
        self._demand(self.thickness < 2 * self.radius, "thickness", said)
        if self.crack_is_known and self.hinge_angles is None:
            raise unplaced("hinge_angles")
        self.onset  # noqa: B018  an arch that cannot stand or rock is refused at birth

    @property
    def ring(self) -> Ring:
        """The arch with a centreline radius of 1."""
        fill = None
        if self.fill_depth is not None:
            fill = Fill(depth=self.fill_depth / self.radius, density=self.fill_density_ratio)
        return Ring(
            thickness=self.thickness / self.radius,
            embrace_angle=self.embrace_angle,
            voussoirs=self.voussoirs,
            fill=fill,
        )

    @cached_property
    def onset(self) -> Onset:
        """The uplift multiplier λ and the hinges A, B, C, D (angles from the left springing, rad)."""
        if self.hinge_angles is None:
            return self._static_onset()
        self._static_onset()  # one that does not stand is refused in its words
        try:
            return self._as_crushed(lambda ring: onset_at(ring, np.array(self.hinge_angles)))
        except (NoMechanism, TooThin, ValueError):
            angles = ", ".join(f"{angle:.6g}" for angle in np.degrees(self.hinge_angles))
            raise StructureError(
                f"hinge_angles is {angles}°, but must be four angles of a mechanism that turns about the intrados "
                "at the first and the third and about the extrados at the others; leave it out for those of statics.",
                hinge_angles=self.hinge_angles,
            ) from None

    def _may_form(self, count: int) -> Mechanisms:
        """The mechanism of statics, that of the hinges that are typed, and the weakest with other hinges.

        To the other side the mirror image of each rocks.
        """
        static = self._static_onset()
        hinges = [static.hinges, *other_hinges(self.ring, static, count - 1)]
        if self.hinge_angles is not None:
            hinges.append(np.array(self.hinge_angles))
        others = []
        for angles in hinges:
            description = self._in_words(angles)
            restitution = self.mechanism().restitution
            with suppress(StructureError):
                other = replace(self, hinge_angles=tuple(angles), crack="known", restitution=restitution)
                other.mechanism()
                others.append(Candidate(description, np.nan, other))
        return Mechanisms(sorted(others, key=lambda candidate: candidate.uplift_multiplier))

    @property
    def crack_position(self) -> float:
        """nan: no height locates the hinges of an arch."""
        return np.nan

    @property
    def crack_in_words(self) -> str:
        """The hinges of its description, in words."""
        return self._in_words(self.onset.hinges)

    def _in_words(self, angles: np.ndarray) -> str:
        hinges = dict(zip("abcd", map(self._hinge_text, angles), strict=True))
        return Phrase("hinges at {a}, {b}, {c}, {d}", **hinges)

    def _hinge_text(self, angle: float) -> str:
        foot = self.ring.feet(angle - self.embrace_angle / 2)
        if foot:
            return "the left foot" if foot < 0 else "the right foot"
        return Phrase(
            "{angle:.0f}°", angle=float(abs(np.degrees(angle)))
        )  # candidates lie several degrees apart

    @cached_property
    def static_multiplier(self) -> float:
        """That of statics: the linear programme is the least over all hinges, so that no candidate has to be formed."""
        return (self.onset if self.crack_is_known else self._static_onset()).multiplier

    def slides_at(self) -> float:
        """By statics of all joints, those between the hinges too."""
        onset = self._static_onset()
        least = multiplier_on_friction(self._crushed_ring(onset), self.joints.friction)
        return least if least < _LIFTS_FROM * onset.multiplier else np.nan

    @property
    def _joints_do(self) -> dict[str, Any]:
        return {
            "hinges_migrate": True,
            "fall_by_sliding": True,
            "as_stones": "as voussoirs",
            # With fill, or on piers, it was not shown (docs/pages/limits.md).
            "stand_on_friction": _STANDS_ON_FRICTION if self.fill_depth is None else math.inf,
        }

    def stones(self, voussoirs: int | None = None) -> Stones:
        """Return it as equal voussoirs, with the fill on each, and its piers; joints keep sharp edges.

        voussoirs: their number, 3 to 60; None: its own, or 21 of an arch that does not say how many it has.
        """
        ring = self.ring
        half = self.embrace_angle / 2
        joints = np.linspace(-half, half, counted_voussoirs(voussoirs, self.voussoirs) + 1)
        if ring.piers is not None:
            joints = np.array([ring.ends[0], *joints, ring.ends[1]])
        both = [ring.contact_points(joints, contact) for contact in (EXTRADOS, INTRADOS)]
        faces = self.radius * np.stack([plane(points) for points in both], axis=1)
        bars = self._bars(joints)
        return chain(list(faces), bars.masses, plane(bars.centroids), bars.inertias)

    def _as_crushed(self, seek: Callable[[Ring], Onset]) -> Onset:
        """The onset that `seek` finds with the contacts where its own line of thrust crushes the joints.

        Each line moves them in for the next: they lie N/(1.7 f_c) in, and N hardly depends on it.
        """
        onset = seek(self.ring)
        if self.compressive_strength is None:
            return onset
        for _ in range(_CRUSHINGS):
            before = onset
            onset = seek(self._crushed_ring(before))
            if abs(onset.multiplier - before.multiplier) < _CRUSHED_ALIKE:
                return onset
        raise TooThin

    def _crushed_ring(self, onset: Onset) -> Ring:
        """The ring with its contacts where the line of thrust at `onset` crushes the joints."""
        if self.compressive_strength is None or self.unit_weight is None:
            return self.ring
        softness = self.unit_weight * self.thickness / (2 * PRESSED * self.compressive_strength)
        line = softness, *onset.reaction.tolist(), onset.multiplier
        return replace(self.ring, crushed=line)

    def _static_onset(self) -> Onset:
        whole = None
        try:
            whole = static_onset(self.ring)
            return self._as_crushed(static_onset)
        except (TooThin, NoMechanism) as reason:
            if whole is not None:
                raise DoesNotStandError(
                    f"{self._sentence} does not stand or rock where its joints crush at a compressive_strength of "
                    f"{self.compressive_strength!r} Pa.",
                    compressive_strength=self.compressive_strength,
                ) from None
            raise StructureError(
                f"{self._sentence} {self._refusal(type(reason))}.", thickness=self.thickness
            ) from None

    def _refusal(self, reason: type[StructureError]) -> str:
        limit = limiting_thickness(self.ring, reason) * self.radius
        if reason is TooThin:
            return f"stands only above a thickness of {limit:.9g} m"
        return (
            f"has a four-hinge mechanism only below a thickness of {limit:.9g} m; make it thinner or the embrace "
            "angle larger"
        )

    @property
    def _sentence(self) -> str:
        joints = "" if self.voussoirs is None else f" and {self.voussoirs} voussoirs"
        joints += "" if self.fill_depth is None else f" under {self.fill_depth!r} m of fill"
        return (
            f"thickness is {self.thickness!r} m, but an arch of radius {self.radius!r} m and embrace_angle "
            f"{self.embrace_angle:.6g} rad ({np.degrees(self.embrace_angle):.6g}°){joints}"
        )

    def _linkage(self, mirrored: bool) -> FourBar:
        """The four-bar linkage; it ends where A, B and C come into line.

        There the left half of the mechanism has snapped through, far below the unstable equilibrium, and the
        bar CD turns back. All functions are smooth up to that rotation.
        """
        sections = self._hinge_sections
        ring = self.ring
        points = self.radius * self._crushed_ring(self.onset).contact_points(sections, PATTERN)
        foot = ring.feet(sections)
        # the thrust runs along the arch at a hinge, up through the left foot and down through the right one
        joints = np.where(foot == 0, -sections, -np.pi / 2 * foot)
        linkage = FourBar(points, self._bars(sections), self.radius, ring.mass, joints)
        if not linkage.gravity(linkage.end_rotation) < 0:
            raise StructureError(
                f"{self._sentence} finds no unstable equilibrium before its hinges come into line."
            )
        return linkage

    def _bars(self, sections: np.ndarray) -> Bars:
        """The bars between successive sections, in m."""
        bars = self.ring.bars(sections)
        return Bars(bars.masses, self.radius * bars.centroids, self.radius**2 * bars.inertias)

    @property
    def _hinge_sections(self) -> np.ndarray:
        return self.onset.hinges - self.embrace_angle / 2

    def _momentum_balance(self, mirrored: bool) -> float:
        """That of the velocity fields of the mechanism and of its mirror image, whose bars are others."""
        warnings.warn(
            "restitution of the arch by momentum balance rests on an impulse line that leaves the ring; "
            "compare it with a measured value.",
            StructureWarning,
            stacklevel=4,
        )
        hinges = self._hinge_sections
        motion = self.linkages[0].motion(0.0)
        edges = self._split(-hinges)
        parts = self._bars(edges)
        middles = (edges[1:] + edges[:-1]) / 2

        def velocities(sections: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            bar = np.searchsorted(hinges, sections) - 1
            moving = (bar >= 0) & (bar <= 2)
            bar = np.clip(bar, 0, 2)
            speeds = motion.velocities[bar] + 1j * motion.spins[bar] * (points - motion.centroids[bar])
            return speeds * moving, motion.spins[bar] * moving

        return momentum_balance(
            parts.masses,
            parts.inertias,
            velocities(middles, parts.centroids),
            velocities(-middles, -parts.centroids.conj()),
        )

    def _split(self, more: np.ndarray) -> np.ndarray:
        """The ends of the arch, its hinges and `more` sections in order, each once."""
        edges = np.concatenate([self._ends, self._hinge_sections, more])
        edges = np.unique(np.clip(edges, *self._ends))
        return edges[np.append(True, np.diff(edges) > 1e-9)]  # type: ignore[no-any-return]

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        """The parts that stay at the springings, the bars, or the voussoirs of both; about the centre of the arch."""
        parts = []
        for ends in pairwise(self._split(self.ring.sections() if self.voussoirs else np.empty(0))):
            bar = int(np.searchsorted(self._hinge_sections, sum(ends) / 2)) - 1
            parts.append((bar if 0 <= bar <= 2 else STILL, self.radius * self.ring.sector(*ends)))
        return parts

    @property
    def _ends(self) -> tuple[float, float]:
        return -self.embrace_angle / 2, self.embrace_angle / 2

    def _dimensions(self) -> dict[str, Path]:
        half = self.embrace_angle / 2
        inner = self.radius - self.thickness / 2
        outer = inner + self.thickness
        aside = np.array([np.sin(half / 2), np.cos(half / 2)])
        return {
            "radius": span([0.0, 0.0], self.radius * aside),
            "thickness": span([0.0, inner], [0.0, outer]),
            "fill_depth": span(
                [0.0, outer], [0.0, outer + (self.fill_depth or 0.0)], [0.3 * self.radius, 0.0]
            ),
            "embrace_angle": swept([0.0, 0.0], 0.3 * self.radius, -half, half),
        }

    def thrust_line(self, count: int = 200) -> np.ndarray:
        """Return the line of thrust at the onset to the positive side, (k, 2) in m: `count` points along the arch.

        On piers it starts and ends with a point more, at the foot of each.
        """
        ring = self.ring
        onset = self.onset
        sections = np.unique([*ring.ends, *np.linspace(*self._ends, count)])
        unknowns = np.array([*onset.reaction, onset.multiplier, 1.0])
        contacts = [np.full(sections.shape, contact) for contact in (INTRADOS, EXTRADOS)]
        inner, outer = (ring.contact_points(sections, contact) for contact in contacts)
        # a gap is the normal force times the distance of the thrust from the contact point
        from_inner, from_outer = (ring.gaps(sections, contact) @ unknowns for contact in contacts)
        return self.radius * plane(inner + from_inner / (from_inner + from_outer) * (outer - inner))


@stated
@dataclass(frozen=True, repr=False)
class ArchOnPiers(Arch):
    """A circular arch on equal rectangular piers, flush with its intrados at the springings.

    A pier that cracks obliquely or comes apart in leaves is weaker than this monolithic one; the wedge
    between its level head and an inclined springing is left out.

    Examples
    --------
    >>> rocking.ArchOnPiers(5.0, 0.8, np.pi, pier_width=1.5, pier_height=4.0).mechanism()
    Mechanism(λ = 0.0537, φ_cr = 0.02456 rad, p = 2.04 rad/s, η = 0.9)
    """

    type_name: ClassVar[str] = "arch_on_piers"
    _described_as: ClassVar[dict[str, str]] = {
        "": "Circular arch on equal monolithic piers, flush with the intrados"
    }

    restitution: Annotated[Restitution, restitution_value()] = None
    pier_width: Annotated[float, length("Width of a pier", 4.0, (0.1, 20), "b")] = field(kw_only=True)
    pier_height: Annotated[float, length("Height of a pier up to the springing", 6.0, (0.1, 60), "h")] = (
        field(kw_only=True)
    )
    pier_density_ratio: Annotated[
        float,
        Value(
            "Density of the piers over that of the arch",
            1.0,
            usual=(0.5, 1.5),
            bounds={"ge": 1e-3, "le": 1e3},
        ),
    ] = field(default=1.0, kw_only=True)

    @property
    def _joints_do(self) -> dict[str, Any]:
        return {**super()._joints_do, "need_stones": True, "stand_on_friction": math.inf}

    @property
    def ring(self) -> Ring:
        """Arch and piers with a centreline radius of 1."""
        ring = super().ring
        width = self.pier_width / self.radius
        height = self.pier_height / self.radius
        springing = complex(ring.contact_points(np.array(self.embrace_angle / 2), INTRADOS))
        mass = self.pier_density_ratio * width * height / ring.thickness
        return replace(ring, piers=Piers(springing=springing, width=width, height=height, mass=mass))

    def _static_onset(self) -> Onset:
        """λ of the mechanism that governs and its hinges (angles from the left springing; a foot is beyond it)."""
        least = self.thickness * float(np.sin(self.embrace_angle / 2))
        said = f" m, but must be at least {least:.6g} m to carry the springing."
        self._demand(self.pier_width >= least, "pier_width", said)
        return super()._static_onset()

    def _refusal(self, reason: type[StructureError]) -> str:
        if reason is TooThin:
            return "does not stand; make the piers wider or lower"
        return "has no four-hinge mechanism; make the arch thinner"

    @property
    def _sentence(self) -> str:
        return (
            f"pier_width is {self.pier_width!r} m, but on piers of that width and {self.pier_height!r} m height an "
            f"arch of radius {self.radius!r} m and thickness {self.thickness!r} m"
        )

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        """The piers, then the parts of the arch."""
        feet = self.ring.feet(self._hinge_sections)
        right = self._right_pier
        piers = [(0 if feet[0] else STILL, -right.conj()), (2 if feet[-1] else STILL, right)]
        return piers + super()._parts()

    @property
    def _right_pier(self) -> np.ndarray:
        assert self.ring.piers is not None
        return self.radius * self.ring.piers.corners

    def _dimensions(self) -> dict[str, Path]:
        inner_foot, outer_foot, outer_head, _ = plane(self._right_pier)
        apart = 0.1 * self.pier_height
        return super()._dimensions() | {
            "pier_width": span(inner_foot, outer_foot, [0.0, -apart]),
            "pier_height": span(outer_foot, outer_head, [apart, 0.0]),
        }
