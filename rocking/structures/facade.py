"""The façade that leans out as one rigid body above a crack, with floors, ties and thrusts on it (theory: section 2).

x = 0 is the outer face, x < 0 the building; the positive side rocks outwards about the outer toe of the crack.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import whole
from rocking.structures.bodies import (
    Bodies,
    Contacts,
    MotionState,
    Restitution,
    corner,
    momentum_balance,
    on_side,
    resolve_restitution,
)
from rocking.structures.drawing import Kind, Mark, Path, rectangle, span, turned
from rocking.structures.fields import Value, restitution_value
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.tied import (
    Eccentricity,
    Tied,
    TopSlab,
    UnitWeight,
    check_eccentricity,
    check_inside,
    loaded_side,
)
from rocking.structures.ties import Attached, ConstantForce, LoadedForm, PointMotion


@dataclass(frozen=True)
class Turning:
    """The path of a point that turns clockwise about the origin; `start`: where it is at rest."""

    start: complex

    def __call__(self, rotation: np.ndarray) -> PointMotion:
        """Return its motion at `rotation` [rad], any shape."""
        turn = np.exp(-1j * np.asarray(rotation, dtype=float))
        # e^(−iφ) − 1 without cancellation
        moved = -2j * np.sin(np.asarray(rotation) / 2) * np.exp(-0.5j * np.asarray(rotation))
        return PointMotion(self.start * moved, -1j * self.start * turn, -self.start * turn)


@dataclass(frozen=True, eq=False)
class TurningBody:
    """weights (k,), centres (k,) complex and inertias (k,) about them (weight times m²) of rigid parts, and what hangs.

    The centre of mass lies to the left of the toe, above it; it turns clockwise, to the right.
    """

    weights: np.ndarray
    centres: np.ndarray
    inertias: np.ndarray
    attached: tuple[Attached, ...]

    @cached_property
    def masses(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Weights, centres and inertias of all that moves, the attached masses among them."""
        moving = [each for each in self.attached if each.mass]
        return (
            np.append(self.weights, [each.mass for each in moving]),
            np.append(self.centres, [each.path.start for each in moving]),
            np.append(self.inertias, np.zeros(len(moving))),
        )

    @cached_property
    def form(self) -> LoadedForm:
        """I, I', G, G' and B, divided by the static moment |Σ W r| of the moving masses about the toe."""
        weights, centres, inertias = self.masses
        moment = complex(weights @ centres)
        size, slenderness = abs(moment), float(np.arctan2(-moment.real, moment.imag))
        inertia = float(inertias.sum() + weights @ np.abs(centres) ** 2)
        bare = (
            lambda phi: np.full_like(phi, inertia, dtype=float),
            lambda phi: np.zeros_like(phi, dtype=float),
            lambda phi: size * np.sin(slenderness - phi),
            lambda phi: -size * np.cos(slenderness - phi),
            lambda phi: size * np.cos(slenderness - phi),
        )
        return LoadedForm(bare, tuple(each for each in self.attached if each.force), size)

    def side(self, restitution: float) -> Side:
        """Return the side of rocking about the toe, until the body lies."""
        return loaded_side(self.form, np.pi / 2, restitution)

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        """Return all that moves; see Structure.bodies."""
        weights, centres, inertias = self.masses
        turn = np.exp(-1j * np.asarray(rotation, dtype=float))
        places = np.multiply.outer(centres, turn)
        return Bodies(weights, inertias, places, -np.asarray(rotation) + 0 * places.real)

    def impact_on(self, other: "TurningBody") -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return what `momentum_balance` takes of the impact from this toe to that of `other`, the mirror image."""
        weights, centres, inertias = self.masses
        arriving, leaving = -1j * centres, 1j * other.masses[1].conj()
        spins = -np.ones(weights.size)
        before, after = (np.stack([speed.real, speed.imag, spins], axis=1) for speed in (arriving, leaving))
        return weights, inertias, before, after

    def contacts(self, state: MotionState) -> Contacts:
        """Return the force at the toe, per mass of all that moves; ties pull back, weights press, thrusts push."""
        weights, centres, _ = self.masses
        total = weights.sum()
        centre = complex(weights @ centres) / total
        found = corner(-centre.real, centre.imag, state)
        forces = [each.acting(state)[1] / total for each in self.attached if each.force]
        held = sum(forces, np.zeros(state.rotation.shape, dtype=complex))
        return Contacts(found.names, found.normal - held.imag, found.tangential - held.real)


_MOST_STOREYS = 50
_SIZES = {"gt": 0, "le": 1000}


@dataclass(frozen=True, repr=False)
class Facade(Tied):
    """Storeys stacked as one rigid body, flush outside, that rocks above the crack at the foot of one storey.

    storey_heights, thicknesses: of each storey from the ground up, m. unit_weight: of the masonry, N/m³. All forces
    are per metre of façade. floor_loads: on top of each storey, N/m, or () for none; eccentricity: of their bearings
    from the middle of the wall they rest on, inwards positive, m. loads_held: the rest of the building holds their
    mass, so that only their weight acts. top_slab: the uppermost load rests on a "hinged" bearing, or is a slab that
    stays "flat" and so rests on the corner that rises.
    thrust: of a vault or a roof outwards, N/m, at thrust_height above the ground, m; None is the top. crack_storey: 1
    is the ground floor. restitution: η in [0, 1] or "momentum" (the default), for both sides; inward_restitution: of
    the inward side instead. Ties and one_sided: as `Tied`.
    Raises StructureError when it cannot stand.

    >>> rocking.Facade((3.5, 3.0), (0.6, 0.5), unit_weight=20e3, restitution=0.8).mechanism().positive
    Side(λ = 0.08993, φ_cr = 0.08969 rad, p = 1.521 rad/s, η = 0.8)
    """

    type_name: ClassVar[str] = "facade"
    crack_name: ClassVar[str] = "crack"
    draws_both_sides: ClassVar[bool] = True
    described_as: ClassVar[dict[str, str]] = {
        "": "Façade of one storey or several with floor loads, ties and thrust; forces per metre of façade"
    }

    storey_heights: Annotated[
        tuple[float, ...],
        Value("Height of each storey from the ground up", [3.5, 3.0], "m", (0.5, 30), "h", bounds=_SIZES),
    ]
    thicknesses: Annotated[
        tuple[float, ...],
        Value("Thickness of each storey, flush outside", [0.6, 0.5], "m", (0.1, 5), "t", bounds=_SIZES),
    ]
    unit_weight: UnitWeight
    floor_loads: Annotated[
        tuple[float, ...],
        Value("Load of the floor or roof on top of each storey", [12.0, 6.0], "kN/m", (0, 200), "N"),
    ] = ()
    eccentricity: Eccentricity = 0.0
    loads_held: Annotated[
        bool,
        Value(
            "Whether the rest of the building holds the mass of the loads, so that only their weight acts",
            False,
            phrase="loads held sideways",
        ),
    ] = False
    top_slab: TopSlab = "hinged"
    thrust: Annotated[
        float, Value("Horizontal thrust of a vault or roof outwards", 2.0, "kN/m", (0, 100), "H")
    ] = 0.0
    thrust_height: Annotated[
        float | None, Value("Height of the thrust above the ground", 6.0, "m", (0, 60))
    ] = None
    crack_storey: Annotated[
        int,
        Value("Storey at whose foot it cracks; 1 is the ground floor", 1, usual=(1, 12), bounds={"ge": 1}),
    ] = 1
    restitution: Annotated[Restitution, restitution_value("momentum")] = None
    inward_restitution: Annotated[
        float | None,
        Value(
            "Restitution of the impact that ends rocking inwards, where it differs",
            0.8,
            usual=(0.1, 1),
            bounds={"ge": 0, "le": 1},
        ),
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check_storeys()
        self._check_ties(self.height)
        self.mechanism()  # one that is pushed over at rest is refused at birth

    def _check_storeys(self) -> None:
        heights, thicknesses, loads = self.storey_heights, self.thicknesses, self.floor_loads
        if len(heights) > _MOST_STOREYS:
            raise StructureError(
                f"storey_heights has {len(heights)} values, but must have {_MOST_STOREYS} at most."
            )
        for name, values in (("thicknesses", thicknesses), ("floor_loads", loads or heights)):
            if len(values) != len(heights):
                raise StructureError(
                    f"{name} has {len(values)} values, but must have {len(heights)}, one for each storey."
                )
        bearing = [t for load, t in zip(loads, thicknesses, strict=False) if load]
        check_eccentricity(self.eccentricity, min(bearing or thicknesses))
        object.__setattr__(self, "crack_storey", whole("crack_storey", self.crack_storey, 1, len(heights)))
        if self.thrust_height is not None:
            check_inside("thrust_height", self.thrust_height, self.height)

    @property
    def height(self) -> float:
        """Of all storeys, m."""
        return float(sum(self.storey_heights))

    @property
    def crack_height(self) -> float:
        """Of the crack above the ground, m."""
        return float(sum(self.storey_heights[: self.crack_storey - 1]))

    @cached_property
    def levels(self) -> np.ndarray:
        """The foot of each storey and the top, (n + 1,) m above the ground."""
        return np.concatenate([[0.0], np.cumsum(self.storey_heights)])

    @cached_property
    def outward(self) -> TurningBody:
        """The façade above the crack as it turns about its outer toe, which is the origin."""
        return self._turning(mirrored=False)

    @cached_property
    def inward(self) -> TurningBody:
        """The mirror image of the façade as it turns about its inner toe."""
        return self._turning(mirrored=True)

    def _turning(self, mirrored: bool) -> TurningBody:
        toe = complex(-self.thicknesses[self.crack_storey - 1] if mirrored else 0.0, self.crack_height)

        def seen(point: Any) -> Any:
            return -(point - toe).conjugate() if mirrored else point - toe

        storeys = slice(self.crack_storey - 1, None)
        heights, thicknesses = np.array(self.storey_heights)[storeys], np.array(self.thicknesses)[storeys]
        weights = self.unit_weight * heights * thicknesses
        centres = seen(-thicknesses / 2 + 1j * (self.levels[:-1][storeys] + heights / 2))
        inertias = weights * (heights**2 + thicknesses**2) / 12
        return TurningBody(weights, centres, inertias, tuple(self._attached(seen, mirrored)))

    def _attached(self, seen: Callable[[complex], complex], mirrored: bool) -> Iterable[Attached]:
        """What hangs on the part above the crack, at points seen from the toe."""
        for point, load in self._bearings(mirrored):
            path = Turning(seen(point))
            yield Attached(path, ConstantForce(-1j * load)) if self.loads_held else Attached(path, None, load)
        if self.thrust and self._thrust_point.imag > self.crack_height:
            thrust = complex(-self.thrust if mirrored else self.thrust)
            yield Attached(Turning(seen(self._thrust_point)), ConstantForce(thrust))
        for height in () if mirrored else self._tied:
            yield Attached(Turning(seen(1j * height)), self._tie())

    def _bearings(self, mirrored: bool) -> Iterable[tuple[complex, float]]:
        """The points of the loads above the crack, and the loads."""
        last = len(self.floor_loads) - 1
        for storey, load in enumerate(self.floor_loads):
            if storey < self.crack_storey - 1 or not load:
                continue
            across = -self.thicknesses[storey] / 2 - self.eccentricity
            if storey == last and self.top_slab == "flat":
                across = 0.0 if mirrored else -self.thicknesses[storey]
            yield complex(across, self.levels[storey + 1]), load

    @property
    def _thrust_point(self) -> complex:
        return 1j * (self.height if self.thrust_height is None else self.thrust_height)

    @property
    def _tied(self) -> tuple[float, ...]:
        """Heights of the ties above the crack; those below hold what does not move."""
        return tuple(height for height in self.tie_heights if height > self.crack_height)

    def _build(self) -> Mechanism:
        outward = self.outward.side(self._restitution(self.outward, self.inward))
        if self.one_sided:
            return Mechanism(outward, one_sided=True)
        inward = self.inward.side(self._restitution(self.inward, self.outward, self.inward_restitution))
        return Mechanism(outward, inward)

    def _restitution(self, body: TurningBody, other: TurningBody, own: float | None = None) -> float:
        """η of the impact that ends turning about the toe of `body` and starts it about that of `other`."""
        chosen = self.restitution if own is None else own
        return resolve_restitution(chosen, "momentum", lambda: momentum_balance(*body.impact_on(other)))

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        bodies = self.outward.bodies(rotation)
        return bodies._replace(centres=bodies.centres + 1j * self.crack_height)

    def held_work(self, rotation: float | np.ndarray) -> np.ndarray:
        return self.outward.form.held_work(np.asarray(rotation, dtype=float))

    def contacts(self, state: MotionState) -> Contacts:
        return on_side(state, self.outward.contacts(state), self.inward.contacts(state))

    def tie_stretches(self, rotation: float) -> dict[float, float]:
        return {z: (z - self.crack_height) * float(np.sin(max(rotation, 0.0))) for z in self._tied}

    def _crack_heights(self, count: int) -> np.ndarray:
        """The foot of every storey."""
        return self.levels[:-1]

    def cracked_at(self, height: float) -> "Facade":
        """Return this façade cracked at the foot of the storey nearest to `height` [m]."""
        return replace(self, crack_storey=int(np.argmin(np.abs(self.levels[:-1] - height))) + 1)

    def _outline(self, rotation: float) -> list[np.ndarray]:
        still = self.crack_storey - 1
        storeys = [
            rectangle(-t, 0.0, *ends) for t, ends in zip(self.thicknesses, pairwise(self.levels), strict=True)
        ]
        toe = self._hinges(rotation)[0]
        return storeys[:still] + [turned(each, toe, rotation) for each in storeys[still:]]

    def _hinges(self, rotation: float) -> np.ndarray:
        inner = -self.thicknesses[self.crack_storey - 1]
        return np.array([[0.0 if rotation >= 0 else inner, self.crack_height]])

    def marks(self, rotation: float = 0.0) -> tuple[Mark, ...]:
        toe, size, drawn = self._hinges(rotation)[0], 0.15 * self.height, []

        def at(point: complex, kind: Kind, tail: tuple[float, float], text: str) -> None:
            head = np.array([point.real, point.imag])
            if point.imag > self.crack_height:
                head = turned(head[None], toe, rotation)[0]
            drawn.append(Mark(kind, text, np.array([head + tail, head])))

        for point, load in self._bearings(rotation < 0):
            at(point, "load", (0.0, size), f"{load / 1e3:.6g} kN/m")
        if self.thrust:
            at(self._thrust_point, "thrust", (-size, 0.0), f"{self.thrust / 1e3:.6g} kN/m")
        for height in self.tie_heights:
            at(1j * height, "tie", (-max(self.thicknesses) - 2 * size, 0.0), self._tie_text)
        return tuple(drawn)

    def _dimensions(self) -> dict[str, Path | list[Path]]:
        apart, levels = 0.12 * self.height, self.levels
        borne = [point for point, _ in self._bearings(mirrored=False)]
        middles = {levels[n + 1]: -t / 2 for n, t in enumerate(self.thicknesses)}
        off = [z for z in borne if np.isclose(z.real, middles[z.imag] - self.eccentricity)][-1:]
        eccentricity = [span([middles[z.imag], z.imag], [z.real, z.imag], [0.0, -0.25 * apart]) for z in off]
        return {
            **({"eccentricity": eccentricity[0]} if eccentricity and self.eccentricity else {}),
            "storey_heights": [span([0.0, low], [0.0, high], [apart, 0.0]) for low, high in pairwise(levels)],
            "thicknesses": [
                span([-t, z], [0.0, z])
                for t, z in zip(self.thicknesses, (levels[1:] + levels[:-1]) / 2, strict=False)
            ],
        }
