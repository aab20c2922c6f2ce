"""Site: where an instrument stood and what it measures, as far as header and channel code say it."""

import re

_STRUCTURE = re.compile(
    r"\b(roof|floor|fl|flr|storey|story|penthouse|mezzanine|attic|deck|bent|column|girder|abutment|pier|crest|tower|"
    r"dam|gallery|basement|bsmt|bldg|building|bridge)\b",
    re.I,
)
_FREE = re.compile(r"\bfree[- ]?field\b", re.I)
_DOWN_HOLE = re.compile(
    r"\b(down-?hole|bore-?hole|depth|below (?:ground|surface))\b|-\s*\d+(?:\.\d+)?\s*m\b", re.I
)
_CODE = re.compile(r"[A-Z]([HLMP])[ENZ123](\d\d)?")


def site_warnings(place: str) -> tuple[str, ...]:
    """Return a warning when the `place` of an instrument is in a structure or below the ground."""
    if _DOWN_HOLE.search(place):
        return (f"The instrument stood down-hole ({place}): this is not the motion of the surface.",)
    if _STRUCTURE.search(place) and not _FREE.search(place):
        return (f"The instrument stood in a structure ({place}): its motion may not be that of the ground.",)
    return ()


def channel_warnings(component: str) -> tuple[str, ...]:
    """Return a warning when a channel code is that of a seismometer (BH?, HH?, HL?), not of an accelerometer (?N?)."""
    found = _CODE.fullmatch(component.strip().upper())
    if not found:
        return ()
    kind = {"H": "high-gain seismometer", "L": "low-gain seismometer", "M": "mass position", "P": "geophone"}
    return (
        f"The channel code {component.strip()} is that of a {kind[found[1]]}, which measures velocity and clips in "
        "strong motion; an accelerometer's code has N in second place.",
    )
