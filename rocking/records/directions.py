"""Directions: what a component's name says of where it points."""

import re

_VERTICAL = {
    "UP",
    "-UP",
    "DOWN",
    "DN",
    "DWN",
    "V",
    "Z",
    "UD",
    "U-D",
    "U",
    "VER",
    "VERT",
    "VERTICAL",
    "UPDO",
    "U/D",
    "UPWARD",
    "UP-DOWN",
    "UP/DOWN",
    "VERT.",
}
_NAMED = {
    "N": 0.0, "NS": 0.0, "N-S": 0.0, "S-N": 180.0, "NORTH": 0.0, "E": 90.0, "EW": 90.0, "E-W": 90.0, "W-E": 90.0,
    "EAST": 90.0, "S": 180.0, "SOUTH": 180.0, "W": 270.0, "WEST": 270.0,
}  # fmt: skip
_QUADRANT = re.compile(r"([NS])\s*(\d{1,2})\s*([EW])")
_BAND = re.compile(r"[A-Z][HNGL][ENZ123]")


def is_vertical(component: str) -> bool:
    """Whether the component's name says that it is vertical: UP, V, UD, or a channel code ending in Z."""
    name = component.strip().upper()
    return name in _VERTICAL or (bool(_BAND.fullmatch(name)) and name.endswith("Z"))


def azimuth(component: str) -> float | None:
    """Return the azimuth the name says, degrees clockwise from north in [0, 360), or None.

    Reads plain degrees ("228"), quadrants ("N26W"), words ("NS", "E-W") and channel codes ("HNE").
    """
    name = component.strip().upper()
    if re.fullmatch(r"\d{1,3}(\.\d*)?", name):
        return float(name) % 360 if float(name) <= 360 else None
    if _BAND.fullmatch(name):
        name = name[2]
    if name in _NAMED:
        return _NAMED[name]
    quadrant = _QUADRANT.fullmatch(name)
    return _from_quadrant(*quadrant.groups()) if quadrant else None


def _from_quadrant(pole: str, degrees: str, side: str) -> float:
    start, turn = (0, 1) if pole == "N" else (180, -1)
    return float((start + (turn if side == "E" else -turn) * int(degrees)) % 360)
