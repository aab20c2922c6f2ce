"""The structures of the comparison as separate rigid bodies, for codes that know contacts and no mechanism."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from rocking.structures import Arch, Block, Frame

BASE_DEPTH = 0.5
"""Of what moves with the ground, m."""


@dataclass(frozen=True, eq=False)
class RigidBodies:
    """Convex bodies in the plane, and how φ is read off them.

    polygons: (k, 2) corners of each [m], counterclockwise. driven: those that move with the ground.
    legs: the body whose clockwise turn is φ when it rocks to the right, and that whose counterclockwise turn is φ to
    the left. hinges: for a chain of bodies the joints that open to the right and to the left; else none.
    guided: those that move with the ground horizontally, do not turn, and are free vertically.
    depths: of each, m; by default 1.
    """

    polygons: Sequence[np.ndarray]
    driven: tuple[int, ...]
    legs: tuple[int, int] = (1, 1)
    hinges: tuple[tuple[int, ...], tuple[int, ...]] = ((), ())
    guided: tuple[int, ...] = ()
    depths: Sequence[float] = ()

    @cached_property
    def properties(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Volume [m³], centroid (complex, m) and squared gyration [m²] of each, (n,)."""
        areas, centres, gyrations = (
            np.array(values) for values in zip(*map(properties, self.polygons), strict=True)
        )
        return areas * (self.depths or 1.0), centres, gyrations

    def rotation(self, turns: np.ndarray) -> np.ndarray:
        """Return φ [rad], positive to the right, from the counterclockwise turns (n, bodies)."""
        right, left = -turns[:, self.legs[0]], turns[:, self.legs[1]]
        return np.where(right > left, right, -left)

    def outside_hinges(self, turns: np.ndarray) -> float:
        """Return the share of all joint rotation that is outside the joints of the mechanism; turns: (bodies,)."""
        hinges = self.hinges[0 if self.rotation(turns[None])[0] > 0 else 1]
        if not hinges:
            return math.nan
        opened = np.abs(np.diff(turns))
        return float(1 - opened[list(hinges)].sum() / opened.sum())


def properties(polygon: np.ndarray) -> tuple[float, complex, float]:
    """Return the area [m²], the centroid (complex, m) and the squared gyration about it [m²] of a polygon (k, 2)."""
    corner = polygon[:, 0] + 1j * polygon[:, 1]
    following = np.roll(corner, -1)
    cross = (corner.conj() * following).imag
    area = cross.sum() / 2
    centroid = ((corner + following) * cross).sum() / (6 * area)
    squares = np.abs(corner) ** 2 + (corner * following.conj()).real + np.abs(following) ** 2
    return float(area), complex(centroid), float((cross * squares).sum() / (12 * area) - abs(centroid) ** 2)


def rigid_bodies(structure: Block | Frame | Arch) -> RigidBodies:
    """Return a block, a frame or an arch of voussoirs as bodies on what moves with the ground."""
    if isinstance(structure, Block):
        half = structure.breadth / 2
        ground = rectangle(-10 * half, 10 * half, -BASE_DEPTH, 0.0)
        return RigidBodies((ground, rectangle(-half, half, 0.0, structure.height)), (0,))
    if isinstance(structure, Arch):
        return _arch(structure)
    # The columns of a frame, 0.6 of their height apart, and a beam of their material as deep as its mass asks.
    half, height = structure.column_breadth / 2, structure.column_height
    axes = 0.6 * height * (np.arange(structure.columns) - (structure.columns - 1) / 2)
    edge = axes[-1] + half
    depth = structure.beam_mass_ratio * structure.columns * half * height / edge
    ground = rectangle(-2 * edge, 2 * edge, -BASE_DEPTH, 0.0)
    columns = (rectangle(axis - half, axis + half, 0.0, height) for axis in axes)
    beam = rectangle(-edge, edge, height, height + depth)
    return RigidBodies((ground, *columns, beam), (0,))


def _arch(structure: Arch) -> RigidBodies:
    """Voussoirs with the joints and the centroids of the annular sectors, on two abutments.

    A code of convex bodies cannot have the curved intrados. The chord in its place lowers the centroid, and a peak of
    the extrados raises it again, so that masses over one another, centroids and hinges, and with them λ, are those of
    the arch; the gyration of a voussoir about its own centroid is not quite.
    """
    count = structure.voussoirs or 0
    inner, outer = structure.radius - structure.thickness / 2, structure.radius + structure.thickness / 2
    joints = np.linspace(structure.embrace_angle / 2, -structure.embrace_angle / 2, count + 1)
    voussoir = _voussoir(inner, outer, structure.embrace_angle / count)
    turned = [_turned(voussoir, (left + right) / 2) for left, right in pairwise(joints)]
    abutment = rectangle(inner - BASE_DEPTH, outer + BASE_DEPTH, 0.0, BASE_DEPTH)
    left = _turned(abutment, math.pi / 2 + joints[0])
    right = _turned(abutment[::-1] * [1, -1], math.pi / 2 + joints[-1])
    opened = np.rint(structure.onset.hinges / structure.embrace_angle * count).astype(int)
    hinges = tuple(opened.tolist()), tuple((count - opened).tolist())
    return RigidBodies((left, *turned, right), (0, count + 1), (1, count), hinges)


def _voussoir(inner: float, outer: float, angle: float) -> np.ndarray:
    """The voussoir about the crown; its peak puts its centroid where that of the sector is."""

    def with_peak(peak: float) -> np.ndarray:
        edges = np.array([[inner, -1], [inner, 1], [outer, 1], [peak, 0], [outer, -1]])
        place = edges[:, 0] * np.exp(1j * (np.pi / 2 - edges[:, 1] * angle / 2))
        return np.stack([place.real, place.imag], axis=1)

    sector = 2 * (outer**3 - inner**3) / (3 * (outer**2 - inner**2)) * np.sinc(angle / (2 * np.pi))
    ends = outer * math.cos(angle / 2), 2 * outer
    return with_peak(brentq(lambda peak: properties(with_peak(peak))[1].imag - sector, *ends))


def rectangle(left: float, right: float, low: float, high: float) -> np.ndarray:
    """Return the corners (4, 2) of an upright rectangle, counterclockwise, m."""
    return np.array([[left, low], [right, low], [right, high], [left, high]])


def _turned(polygon: np.ndarray, angle: float) -> np.ndarray:
    """Counterclockwise about the origin."""
    sine, cosine = math.sin(angle), math.cos(angle)
    turned: np.ndarray = polygon @ np.array([[cosine, sine], [-sine, cosine]])
    return turned
