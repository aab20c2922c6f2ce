"""What a surface mesh says of a rigid body: volume, height of its centre of mass, inertia, p and η."""

from dataclasses import dataclass

import numpy as np

from rocking.errors import ConfigurationError
from rocking.quantities import GRAVITY

AZIMUTHS = np.arange(0.0, 180.0, 5.0)
"""Directions of shaking that are tried, degrees."""
FOOT = 0.01
"""Share of the height, from the lowest point, in which the body may touch the table."""


@dataclass(frozen=True)
class Specimen:
    """A homogeneous body standing on the plane through its lowest point, z upwards.

    volume: m³. centre_height: of the centre of mass, m. radii: (k,) of gyration about the horizontal axis across each
    of AZIMUTHS, m. reach: (k, 2) horizontal distance from the centre of mass to the outermost points of the foot,
    backwards and forwards, m. closed: whether the mesh encloses its volume; if not, these are of its convex hull.
    """

    volume: float
    centre_height: float
    radii: np.ndarray
    reach: np.ndarray
    closed: bool

    def frequency_parameter(self, uplift_multiplier: float) -> tuple[float, float]:
        """Return p, rad/s, least and largest over the azimuths: p² = g R/(k² + R²), R = h √(1 + λ²)."""
        semi_diagonal = self.centre_height * np.sqrt(1 + uplift_multiplier**2)
        found = np.sqrt(GRAVITY * semi_diagonal / (self.radii**2 + semi_diagonal**2))
        return float(found.min()), float(found.max())

    def restitution(self, positive: float, negative: float) -> tuple[float, float]:
        """Return the momentum balance's η, least and largest over the azimuths, for λ of the two sides.

        Angular momentum about the line of contact to come: η = (k² + h² − b₊ b₋)/(k² + h² + b²), b = λ h.
        """
        height = self.centre_height
        square = self.radii**2 + height**2
        kept = square - positive * negative * height**2
        each = [kept / (square + (multiplier * height) ** 2) for multiplier in (positive, negative)]
        return float(np.min(each)), float(np.max(each))

    def uplift_multiplier(self) -> tuple[float, float]:
        """Return the least and the largest λ that a foot as wide as the mesh could have, over sides and azimuths."""
        return float(self.reach.min() / self.centre_height), float(self.reach.max() / self.centre_height)


def specimen_from_mesh(text: str) -> Specimen:
    """Return the body inside a Wavefront mesh in metres; of points without faces, or of an open mesh, the convex hull.

    Raises ConfigurationError when trimesh is not installed.
    """
    try:
        import trimesh
    except ImportError:
        raise ConfigurationError(
            "the package trimesh is missing, but mass properties of a mesh need it; install rocking with its extra "
            "validate."
        ) from None
    points, faces = _wavefront(text)
    mesh = trimesh.Trimesh(points, faces, process=False)
    closed = len(faces) > 0 and bool(mesh.is_watertight)
    body = mesh if closed else trimesh.PointCloud(points).convex_hull
    if body.volume < 0:
        body.invert()
    return _measured(body, closed)


def _measured(body, closed: bool) -> Specimen:
    centre, lowest = body.center_mass, body.vertices[:, 2].min()
    tensor = body.moment_inertia / body.volume
    foot = body.vertices[body.vertices[:, 2] <= lowest + FOOT * body.extents[2]] - centre
    along = np.column_stack([np.cos(np.radians(AZIMUTHS)), np.sin(np.radians(AZIMUTHS)), 0 * AZIMUTHS])
    across = np.column_stack([-along[:, 1], along[:, 0], 0 * AZIMUTHS])
    steps = foot @ along.T
    return Specimen(
        volume=float(body.volume),
        centre_height=float(centre[2] - lowest),
        radii=np.sqrt(np.einsum("ki,ij,kj->k", across, tensor, across)),
        reach=np.column_stack([-steps.min(axis=0), steps.max(axis=0)]),
        closed=closed,
    )


def _wavefront(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices (n, 3) and the triangles (m, 3) of a Wavefront file."""
    points, faces = [], []
    for line in text.splitlines():
        if line.startswith("v "):
            points.append([float(cell) for cell in line.split()[1:4]])
        elif line.startswith("f "):
            faces.append([int(cell.partition("/")[0]) - 1 for cell in line.split()[1:4]])
    return np.array(points), np.array(faces, dtype=int).reshape(-1, 3)
