"""The instrument: where it stood and what it measured, as far as names and headers say it."""

import re

from rocking.errors import RecordError
from rocking.remarks import Kind, Remark

_STRUCTURE = re.compile(
    r"(?i)\b(roof|floor|fl|flr|storey|story|penthouse|mezzanine|attic|deck|bent|column|girder|abutment|pier|crest|tower|"
    r"dam|gallery|basement|bsmt|bldg|building|bridge)\b"
)
_FREE = re.compile(r"\bfree[- ]?field\b", re.I)
_DOWN_HOLE = re.compile(r"(?i)\b(down-?hole|bore-?hole|depth|below (ground|surface))\b|-\s*\d+(\.\d+)?\s*m\b")
_CODE = re.compile(r"(?!CH\d)[A-Z](?:([HLMPJ])[ENZ123]|([DFK])[FHEIOZ])(\d\d)?")
"""A channel code but for CH1, CH2 and CH3, which count the channels of a logger."""
_NO_MOTION = {"J": "rotational sensor", "D": "pressure sensor", "F": "magnetometer", "K": "thermometer"}


BURIED = 5.0
"""m below the surface from which on an instrument stands in a borehole; vaults are shallower."""
_DEPTH = re.compile(r"(?i)(\d+(?:\.\d+)?)\s*(m|ft|feet)\b")


def is_down_hole(place: str) -> bool:
    """Whether the `place` of an instrument, as a header writes it, is a borehole or more than 5 m below the ground."""
    if not _DOWN_HOLE.search(place):
        return False
    depths = [float(depth) * (1.0 if unit in "mM" else 0.3048) for depth, unit in _DEPTH.findall(place)]
    return max(depths) >= BURIED if depths else bool(re.search(r"(?i)(down|bore)-?hole", place))


def site_warnings(place: str) -> tuple[Remark, ...]:
    """Return a warning when the `place` of an instrument is in a structure or below the ground."""
    if _DOWN_HOLE.search(place):
        return (Remark.of(Kind.DOWN_HOLE, place=place),)
    if _STRUCTURE.search(place) and not _FREE.search(place):
        return (Remark.of(Kind.IN_A_STRUCTURE, place=place),)
    return ()


def channel_warnings(component: str) -> tuple[Remark, ...]:
    """Return a warning when a channel code is that of a seismometer (BH?, HH?, HL?), not of an accelerometer (?N?)."""
    code = _CODE.fullmatch(component.strip().upper())
    if not code:
        return ()
    if other := _NO_MOTION.get(code[1] or code[2]):
        return (Remark.of(Kind.CHANNEL_NO_MOTION, component.strip(), sensor=other),)
    kind = {"H": "high-gain seismometer", "L": "low-gain seismometer", "M": "mass position", "P": "geophone"}
    return (Remark.of(Kind.CHANNEL_OF_VELOCITY, component.strip(), sensor=kind[code[1]]),)


_ACCELERATION = re.compile(r"(?<![a-z])(acc|acel|beschl)", re.I)
_OTHER = {
    "velocity": re.compile(
        r"(?<![a-z])vel(oc\w*|(?![a-z]))|(?<![\w/])(cm|m|mm|in)/s(ec)?\b(?!\s*[/^*²2])", re.I
    ),
    "displacement": re.compile(r"(?<![a-z])displ?(ac\w*|(?![a-z]))", re.I),
}
_OF_THE_GROUND = re.compile(r"shear|wave|vs[ _,]?30", re.I)  # the velocity of a site is no record
_SUFFIXES = {
    ".vt2": "velocity",
    ".vel": "velocity",
    ".vtx": "velocity",
    ".dt2": "displacement",
    ".dis": "displacement",
    ".disp": "displacement",
    ".semv": "velocity",
    ".semd": "displacement",
}


def other_quantity(text: str) -> str | None:
    """Return "velocity" or "displacement" when `text`, a header or the name of a column, speaks of it alone."""
    if _ACCELERATION.search(text) or _OF_THE_GROUND.search(text):
        return None
    return next((word for word, pattern in _OTHER.items() if pattern.search(text)), None)


def refuse_other_quantity(file: str, text: str) -> None:
    """Raise RecordError when `text`, a header, or the ending of the name `file` speaks of another quantity."""
    suffix = next((word for end, word in _SUFFIXES.items() if file.lower().endswith(end)), None)
    if quantity := other_quantity(text) or suffix:
        raise RecordError(f"this is a file of {quantity}; use the acceleration of the same record.")


_QUANTITY_IN_NAME = re.compile(r"(?<![a-z])(vel(?:ocity|oc)?|disp(?:l|lacement)?)(?![a-z])", re.I)


def refuse_by_name(file: str) -> None:
    """Raise RecordError when the name of a file of bare numbers speaks of velocity or displacement alone."""
    word = _QUANTITY_IN_NAME.search(file)
    if word and not _ACCELERATION.search(file):
        quantity = "velocity" if word[1][0] in "vV" else "displacement"
        raise RecordError(
            f"its name speaks of {quantity}, and nothing in it of acceleration; use the acceleration of the same "
            "record, or rename the file if it is that."
        )
