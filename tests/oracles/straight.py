"""The side whose inertia is constant and whose moments are straight lines: an equivalent block as a mechanism."""

from scipy.constants import g

from rocking.structures import EquivalentBlock, Side


def straight(block: EquivalentBlock) -> Side:
    """I = 1, G from its value at rest to 0 at φ_cr, B = G(0)/λ."""
    square, critical = block.frequency_parameter**2 / g, block.critical_rotation
    return Side(
        inertia=lambda r: 1.0 + 0.0 * r,
        inertia_slope=lambda r: 0.0 * r,
        gravity=lambda r: square * (critical - r),
        gravity_slope=lambda r: -square + 0.0 * r,
        ground=lambda r: square * critical / block.uplift_multiplier + 0.0 * r,
        critical_rotation=critical,
        end_rotation=5 * critical,
        restitution=block.restitution,
    )
