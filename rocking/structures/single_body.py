"""The side of one rigid body that rocks about a corner (theory: section 2, "Single rigid bodies")."""

import numpy as np

from rocking.structures.mechanism import Side


def corner_side(slenderness: float, inertia_length: float, end_rotation: float, restitution: float) -> Side:
    """Return the Side of a body whose centre of mass lies at a distance R from the corner.

    slenderness: α, angle between the vertical and the line from the corner to the centre of mass, rad.
    inertia_length: I_O/(mR), m; 4R/3 for a rectangular block.
    I = I_O/(mR), G = sin(α − φ), B = cos(α − φ), φ_cr = α (Eq. 1).
    """
    return Side(
        inertia=lambda rotation: np.full_like(rotation, inertia_length, dtype=float),
        inertia_slope=lambda rotation: np.zeros_like(rotation, dtype=float),
        gravity=lambda rotation: np.sin(slenderness - rotation),
        gravity_slope=lambda rotation: -np.cos(slenderness - rotation),
        ground=lambda rotation: np.cos(slenderness - rotation),
        critical_rotation=slenderness,
        end_rotation=end_rotation,
        restitution=restitution,
    )
