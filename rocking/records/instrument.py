"""The instrument: where a component points, where it stood and what it measured, as far as names and headers say it."""

import re
from collections.abc import Sequence
from typing import Any

from rocking.errors import RecordError
from rocking.remarks import Kind, Remark

_VERTICAL = {
    "UP", "-UP", "DOWN", "DN", "DWN", "V", "Z", "UD", "U-D", "U", "VER", "VERT", "VERTICAL", "UPDO", "U/D", "UPWARD",
    "UP-DOWN", "UP/DOWN", "VERT.", "VRT", "VRTL", "UPP", "UPWD", "DWNW", "VERTICAL UP", "VERTICAL DOWN", "V-UP",
    "DÜŞEY", "上下", "鉛直",
    "400", "500", "600",  # codes of vertical, up and down in the headers of USC, SMC and COSMOS
}  # fmt: skip
_NAMED = {
    "N": 0.0, "NS": 0.0, "N-S": 0.0, "S-N": 180.0, "NORTH": 0.0, "E": 90.0, "EW": 90.0, "E-W": 90.0, "W-E": 90.0,
    "N/S": 0.0, "E/W": 90.0, "WE": 90.0, "EAST": 90.0, "S": 180.0, "SOUTH": 180.0, "W": 270.0, "WEST": 270.0,
    "NORTH-SOUTH": 0.0, "NORTH SOUTH": 0.0, "EAST-WEST": 90.0, "EAST WEST": 90.0,
    "NORTE": 0.0, "NORTE-SUR": 0.0, "SUR": 180.0, "ESTE": 90.0, "OESTE": 270.0,
    "ESTE-OESTE": 90.0, "NORD": 0.0, "NORD-SUD": 0.0, "SUD": 180.0, "EST": 90.0, "EST-OUEST": 90.0, "EST-OVEST": 90.0,
    "OUEST": 270.0, "OVEST": 270.0, "OST": 90.0, "KUZEY-GÜNEY": 0.0, "DOĞU-BATI": 90.0, "南北": 0.0, "東西": 90.0,
}  # fmt: skip
_QUADRANT = re.compile(r"([NS])\s*(\d{1,2})\s*°?\s*([EW])")
_DEGREES = re.compile(r"(\d{1,3}(?:\.\d*)?)(?:[ _]?(?:DEG(?:REES?)?\.?|°))?")
_BAND = re.compile(r"([A-Z][HNGL][ENZ123])(?:[._ -]?(?:\d\d|--))?")
"""A channel code of three letters, and what may follow it of a code of location."""
_NUMBERED_VERTICAL = re.compile(r"(V|Z|UP|DN|DWN|DOWN|VERT|VERTICAL)[ _.-]?(\d|00|-{1,2})")
"""A vertical with a number of its own, as V1 or DWN1, or dashes in place of a code, as Z--."""
_VERTICAL_WORD = re.compile(r"VERT\w*|VRT\w*|UPW\w*|DOWNW\w*|DWNW?|UPP?|DOWN|DN|Z|UD|UPDOWN")
"""Words of which a name of a vertical consists, beside numbers and signs: "Vertical (up)", "UP 1", "-Z"."""
_SURELY_VERTICAL = re.compile(r"\b(VERT(ICAL(E|LY)?)?|VERTIKAL|[BCEHS]NZ)\b")
"""A word that makes a vertical of any name in which it stands: "Roof vertical", "Ch. 3 - HNZ"."""
_RELATIVE = re.compile(
    r"H?[123XYLTR]|[A-Z][HNGL][RT]|L?N|TR|LN|FN|FP|(LONG|TRAN|RAD)\w*|(COMP|CHAN)\w*[ _-]?\d+", re.I
)
"""Names of components that say which of two it is, and not where it points."""


def is_vertical(component: str) -> bool:
    """Whether the component's name says that it is vertical: UP, V, UD, or a channel code ending in Z."""
    name = component.strip().upper()
    band = _BAND.fullmatch(name)
    if band:
        return band[1].endswith("Z")
    if name in _VERTICAL or _NUMBERED_VERTICAL.fullmatch(name):
        return True
    if _SURELY_VERTICAL.search(name.replace("_", " ")) and "HORIZ" not in name:
        return True
    words = [word for word in re.split(r"[^A-Z]+", name) if word]
    return bool(words) and all(_VERTICAL_WORD.fullmatch(word) for word in words)


def azimuth(component: str) -> float | None:
    """Return the azimuth the name says, degrees clockwise from north in [0, 360), or None.

    Reads plain degrees ("228"), quadrants ("N26W"), words ("NS", "E-W") and channel codes ("HNE").

    >>> azimuth("N26W")
    334.0
    """
    name = component.strip().upper().replace("–", "-")
    if angle := _DEGREES.fullmatch(name):
        return float(angle[1]) % 360 if float(angle[1]) <= 360 else None
    if band := _BAND.fullmatch(name):
        name = band[1][2]
    if quadrant := _QUADRANT.fullmatch(name):
        pole, degrees, side = quadrant.groups()
        turn = int(degrees) if (pole == "N") == (side == "E") else -int(degrees)
        return float(((0 if pole == "N" else 180) + turn) % 360)
    return _NAMED.get(name)


def directed(fields: dict[str, Any]) -> dict[str, Any]:
    """Return fields of an Accelerogram, `vertical` and `azimuth` by its component's name where they are blank."""
    component = fields.get("component", "")
    vertical = fields.get("vertical", is_vertical(component))
    along = fields.get("azimuth")
    along = None if vertical else azimuth(component) if along is None else along
    return fields | {"vertical": vertical, "azimuth": along}


def direction_warnings(component: str, along: float | None, vertical: bool) -> tuple[Remark, ...]:
    """Return a warning when nothing says where a component points: neither its header, nor its name."""
    if not _has_unknown_direction(component, along, vertical):
        return ()
    return (Remark(Kind.DIRECTION_UNKNOWN, component.strip()),)


def contradiction(component: str, along: float | None, vertical: bool) -> Remark | None:
    """Return a remark where a channel code (HNE) points elsewhere than the header of its record.

    along: degrees. A code is taken at its word where N and E are near their axes, whichever way they point.
    """
    code = _BAND.fullmatch(component.strip().upper())
    axis = {"N": 0.0, "E": 90.0}.get(code[1][2]) if code else None
    if code is None or (axis is None and code[1][2] != "Z"):
        return None
    is_same = vertical == code[1].endswith("Z")
    off_axis = 0.0 if along is None or axis is None or vertical else abs((along - axis + 90) % 180 - 90)
    if is_same and off_axis <= _OFF_AXIS:
        return None
    direction = "upwards" if vertical else "to no known azimuth" if along is None else f"to {along:g}°"
    return Remark.of(Kind.DIRECTION_CONTRADICTED, component.strip(), direction=direction)


_OFF_AXIS = 45.0
"""Degrees by which a channel called north or east may be off that direction: beyond, it is nearer the other one."""


def _has_unknown_direction(component: str, along: float | None, vertical: bool) -> bool:
    """Whether a component has a name, and neither it nor the header says where the component points."""
    name = component.strip()
    if vertical or along is not None or not name:
        return False
    if _RELATIVE.fullmatch(name) or _BAND.fullmatch(name.upper()):
        return False
    is_beyond = name.isdigit() and int(name) > 360
    is_combined = re.match(r"(?i)rot|srss|gm|geo", name) is not None
    is_longer_angle = re.search(r"\d\d", name) is not None  # an angle to which a program has written more
    return is_beyond or is_combined or not is_longer_angle


def vertical_doubt(
    components: Sequence[str], along: Sequence[float | None], vertical: Sequence[bool]
) -> Remark | None:
    """Return a remark where a channel may be vertical, and nothing says whether it is.

    That is so of three channels or more without directions, and of a lone one with a code of unknown direction.
    """
    if any(vertical):
        return None
    if len(components) == 1:
        return _lone_doubt(components[0], along[0])
    of_unknown = [name for name, azimuth in zip(components, along, strict=True) if azimuth is None]
    if len(components) < _OF_A_STATION or not of_unknown:
        return None
    names = ", ".join(of_unknown[:_OF_A_STATION])
    return Remark.of(Kind.SOME_MAY_BE_VERTICAL, channels=len(components), names=names)


def _lone_doubt(component: str, along: float | None) -> Remark | None:
    """A remark on a lone channel with a code. A heading of a table is prose, and no less horizontal for that."""
    code = component.strip()
    is_code = _SEED.fullmatch(code) and not names_acceleration(code)
    if not is_code or not _has_unknown_direction(code, along, vertical=False):
        return None
    return Remark(Kind.LONE_MAY_BE_VERTICAL, code)


def names_acceleration(component: str) -> bool:
    """Whether a component's name is but a word for acceleration."""
    return bool(_ONLY_ACCELERATION.fullmatch(component.strip()))


_ONLY_ACCELERATION = re.compile(r"a|ag|a_g|acc\w*|ground[ _]?acc\w*|amplitude|values?|data", re.I)
_SEED = re.compile(r"[A-Z]{2}[A-Z0-9]")
"""A channel code as stations give it: band, instrument, and the direction last."""
_OF_A_STATION = 3
"""Channels of a station that recorded every direction."""
_ENDING = re.compile(r"\.(at2|txt|csv|asc|dat|acc|prn|out|th|tcl|gz|time_\w+|g3)$", re.I)
_WORDS = (
    r"NS|EW|SN|WE|N-S|E-W|S-N|W-E|N|E|S|W|NORTH|EAST|SOUTH|WEST|UD|UP|DN|DWN|DOWN|V|Z|VER|VERT|VERTICAL|"
    r"[A-Z][HNGL][NEZ]"
)
_IN_NAME = (
    re.compile(rf"^(.*?)[-_. ]({_WORDS})$", re.I),
    re.compile(r"^(.*?)[-_. ]?([NS]\d{1,2}[EW])$", re.I),
    re.compile(r"^(.*\D)(\d{3})$"),
    re.compile(r"^(.+)[-_. ](\d{1,3})(?:deg)?$", re.I),
    re.compile(r"^(.*[a-z\d])(NS|EW|UD|UP)$"),
)
"""A direction at the end of a file's name: a word, a bearing or three digits, or one to three after a sign."""


def without_ending(name: str) -> str:
    """Return the name of a file without the endings that say what kind of file it is."""
    while (shorter := _ENDING.sub("", name)) not in (name, ""):
        name = shorter
    return name


def direction_in_name(name: str) -> tuple[str, str]:
    """Return the name of a file before the direction at its end, and that direction; ("", "") where it ends in none.

    >>> direction_in_name("RSN779_LOMAP_LGP090.time_g.csv")
    ('RSN779_LOMAP_LGP', '090')
    """
    stem = without_ending(name)
    for pattern in _IN_NAME:
        match = pattern.match(stem)
        if match and (azimuth(match[2]) is not None or is_vertical(match[2])):
            return match[1], match[2]
    return "", ""


def vertical_in_name(name: str) -> str:
    """Return the word for a vertical with which the name of a file ends, "" where it ends in none."""
    stem = without_ending(name.rpartition("/")[2])
    is_word = len(stem) > 1 and stem.isalpha() and is_vertical(stem)
    if not is_word and _NO_DIRECTION.search(stem):
        return ""
    word = stem if is_word else direction_in_name(name.rpartition("/")[2])[1]
    return word if is_vertical(word) and not word.isdigit() else ""


_NO_DIRECTION = re.compile(
    r"(?i)(scaled?|clean(ed)?|rounded|filled|sped|speed|back|set|sized?)[-_. ](up|down)$"
)
"""The end of a name in which "up" says what was done, as in "scaled_up"."""


_STRUCTURE = re.compile(
    r"(?i)\b(roof|floor|fl|flr|storey|story|penthouse|mezzanine|attic|deck|bent|column|girder|abutment|pier|crest|tower|"
    r"dam|gallery|basement|bsmt|bldg|building|bridge)\b"
)
_FREE = re.compile(r"\bfree[- ]?field\b", re.I)
_DOWN_HOLE = re.compile(r"(?i)\b(down-?hole|bore-?hole|depth|below (ground|surface))\b|-\s*\d+(\.\d+)?\s*m\b")
_CODE = re.compile(r"(?!CH\d)[A-Z](?:([HLMPJ])[ENZ123]|([DFK])[FHEIOZ])(\d\d)?")
"""A channel code but for CH1, CH2 and CH3, which count the channels of a logger."""
_NO_MOTION = {"J": "rotational sensor", "D": "pressure sensor", "F": "magnetometer", "K": "thermometer"}


_BURIED = 5.0
"""m below the surface from which on an instrument stands in a borehole; vaults are shallower."""
_DEPTH = re.compile(r"(?i)(\d+(?:\.\d+)?)\s*(m|ft|feet)\b")


def is_down_hole(place: str) -> bool:
    """Whether the `place` of an instrument, as a header writes it, is a borehole or more than 5 m below the ground."""
    if not _DOWN_HOLE.search(place):
        return False
    depths = [float(depth) * (1.0 if unit in "mM" else 0.3048) for depth, unit in _DEPTH.findall(place)]
    return max(depths) >= _BURIED if depths else bool(re.search(r"(?i)(down|bore)-?hole", place))


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
