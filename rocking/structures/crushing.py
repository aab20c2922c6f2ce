"""The edge of a joint that crushes, so that what turns on it turns further in (theory: section 12.8)."""

from rocking.errors import DoesNotStandError

PRESSED = 0.85
"""Share of the compressive strength at which the edge of a joint is pressed all over."""


def inset(pressing: float, strength: float | None, breadth: float) -> float:
    """Return how far in from its edge a hinge lies, m: N/(1.7 f_c), the middle of what is pressed at .85 f_c.

    pressing: N on the joint, N per metre of edge. strength: f_c, Pa; None where nothing crushes. breadth: of the joint,
    m. Raises DoesNotStandError where all of it is pressed.

    >>> round(inset(62680.0, 1.5e6, 0.35), 6)
    0.02458
    """
    if strength is None:
        return 0.0
    depth = pressing / (PRESSED * strength)
    check_pressed(depth, breadth)
    return depth / 2


def check_pressed(pressed: float, whole: float) -> None:
    """Refuse a joint of which the part that is pressed at rest is not less than the whole, both in m or in m²."""
    if not pressed < whole:
        raise DoesNotStandError(
            "the structure does not stand: at rest its weight crushes a joint over "
            f"{pressed / whole:.4g} times its breadth; correct compressive_strength, or the sizes and loads above it."
        )
