"""The one g, and the doors through which units come in. Inside, everything is SI and radians."""

from rocking.errors import RecordError

GRAVITY = 9.80665
"""scipy.constants.g, m/s². Typed here because importing scipy.constants costs every process a fifth of a second."""

ACCELERATION_UNITS = {
    "m/s2": 1.0,
    "cm/s2": 0.01,
    "mm/s2": 0.001,
    "gal": 0.01,
    "g": GRAVITY,
    "mg": GRAVITY / 1000,
    "g/10": GRAVITY / 10,
}
"""Factor from each unit of acceleration to m/s²; one g = 9.80665 m/s² for units and gravity alike."""


def acceleration_factor(unit: str) -> float:
    """Return the factor from `unit` to m/s². Raises RecordError when the unit is not known."""
    name = (
        str(unit)
        .strip()
        .lower()
        .replace("²", "2")
        .replace("^2", "2")
        .replace("**2", "2")
        .replace("/s/s", "/s2")
    )
    if name not in ACCELERATION_UNITS:
        raise RecordError(f"unit is {unit!r}, but must be one of {', '.join(ACCELERATION_UNITS)}.")
    return ACCELERATION_UNITS[name]
