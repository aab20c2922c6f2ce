"""Direction: where a component points, decided once from what its reader, its name, its file and its row say."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Protocol

from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning

_VERTICAL = {
    "V", "U-D", "U", "VER", "UPDO", "U/D", "VER.", "V-UP", "DÜŞEY", "DUSEY", "DIKEY", "DİKEY", "U_D", "上下", "上下動",
    "鉛直", "竖向", "竖直", "垂直", "ВЕРТ", "ВЕРТИКАЛЬНАЯ", "ΚΑΤΑΚΟΡΥΦΗ", "ΚΑΤΑΚΌΡΥΦΗ",
    "400", "500", "600",  # codes of vertical, up and down in the headers of USC, SMC and COSMOS
}  # fmt: skip
_NAMED = {
    "NS": 0.0, "EW": 90.0, "WE": 90.0, "W-E": 90.0, "E-O": 90.0, "EO": 90.0, "E/O": 90.0, "K-G": 0.0, "D-B": 90.0,
    "南北": 0.0, "東西": 90.0, "南北動": 0.0, "東西動": 90.0, "东西": 90.0,
    "СЮ": 0.0, "С-Ю": 0.0, "ВЗ": 90.0, "В-З": 90.0,
    **dict.fromkeys(("N", "NORTH", "NORTE", "NORD", "KUZEY", "СЕВЕР", "ΒΟΡΡΆΣ", "ΒΟΡΡΑΣ"), 0.0),
    **dict.fromkeys(("E", "EAST", "ESTE", "LESTE", "EST", "OST", "DOĞU", "DOGU", "ВОСТОК", "ΑΝΑΤΟΛΉ", "ΑΝΑΤΟΛΗ"), 90.0),
    **dict.fromkeys(("S", "SOUTH", "SUR", "SUL", "SUD", "SÜD", "GÜNEY", "GUNEY", "ЮГ", "ΝΌΤΟΣ", "ΝΟΤΟΣ"), 180.0),
    **dict.fromkeys(("W", "WEST", "OESTE", "OUEST", "OVEST", "BATI", "ЗАПАД", "ΔΎΣΗ", "ΔΥΣΗ"), 270.0),
}  # fmt: skip
"""Of two opposite words, as in "NORD-SUD", the first counts."""
_RELATIVE = {
    **{word: word for word in ("L", "T", "R", "X", "Y", "1", "2", "3", "H1", "H2", "FN", "FP", "SN", "SP")},
    "HX": "X", "HY": "Y", "HL": "L", "HT": "T", "HR": "R", "H3": "3",
    "LN": "L", "LON": "L", "LONG": "L", "LONGITUDINAL": "L", "TR": "T", "TRAN": "T", "TRANS": "T", "TRANSVERSE": "T",
    "TRANSVERSAL": "T", "RAD": "R", "RADIAL": "R",
}  # fmt: skip
"""Which of two axes a name says, whose azimuth it does not."""
_ACROSS = ({"L", "T"}, {"R", "T"}, {"FN", "FP"}, {"SN", "SP"}, {"X", "Y"}, {"H1", "H2"}, {"1", "2"})
"""Axes that are at right angles by what they mean."""
_QUADRANT = re.compile(r"([NS])\s*(\d{1,2})\s*°?\s*([EWO])")
"""A bearing; O is oeste, ouest and ovest."""
_DEGREES = re.compile(
    r"(?:AZ(?:IMUTH)?\.?[ =:]*|N(?=\d{3}))?(\d{1,3}(?:\.\d*)?)(?:[ _]?(?:DEG(?:REES?)?\.?|°))?"
)
_BAND = re.compile(r"([A-Z][HNGL][ENZ123])(?:[._ -]?(?:\d\d|--))?")
"""A channel code of three letters, and what may follow it of a code of location."""
_OF_ONE_INSTRUMENT = re.compile(r"([A-Z][HNGL])([RT12XY])")
_BAND_AND_AXIS = re.compile(r"[A-Z][ _]+([ENZ])")
"""Band and axis with a blank in the place of the instrument, as SEISAN writes them."""
_NUMBERED_VERTICAL = re.compile(r"(V|Z|UP|DN|DWN|DOWN|VERT|VERTICAL)[ _.-]?(\d|00|-{1,2})")
"""A vertical with a number of its own, as V1 or DWN1, or dashes in place of a code, as Z--."""
_VERTICAL_WORD = re.compile(r"VERT\w*|VRT\w*|UPW\w*|DOWNW\w*|DWNW?|UPP?|DOWN|DN|Z|UD|UPDOWN")
"""Words of which a name of a vertical consists, apart from numbers and signs: "Vertical (up)", "UP 1", "-Z"."""
_SURELY_VERTICAL = re.compile(r"\b(VERT(ICAL(E|LY)?)?|VERTIKAL|[BCEHS]NZ)\b")
"""A word that makes a vertical of any name that holds it: "Roof vertical", "Ch. 3 - HNZ"."""
_SAYS_WHICH = re.compile(
    r"H?[123XYLTR]\d?|[A-Z][HNGL][RT]|L?N|TR|LN|FN|FP|(LONG|TRAN|RAD)\w*|(COMP|CHAN)\w*[ _-]?\d+", re.I
)
"""Names of components that say which of two it is, and not where it points."""
_OFF_AXIS = 45.0
"""Degrees by which a channel called north or east may be off that direction: beyond, it is nearer the other one."""
_OF_A_STATION = 3
"""Channels of a station that recorded every direction."""
_SEED = re.compile(r"[A-Z]{2}[A-Z0-9]")
"""A channel code as stations give it: band, instrument, and the direction last."""


class Channel(Protocol):
    """What a direction is asked of: a channel with its samples, or as it is listed without."""

    @property
    def component(self) -> str: ...
    @property
    def azimuth(self) -> float | None: ...
    @property
    def vertical(self) -> bool: ...


@dataclass(frozen=True)
class Direction:
    """Where a component points.

    azimuth: degrees clockwise from north in [0, 360), None where it is not known. relative: which of two axes at right
    angles it is where their azimuths are not known: "L", "T", "FN", "1", ...; "" where not even that is said.
    """

    azimuth: float | None = None
    vertical: bool = False
    relative: str = ""

    @classmethod
    @cache
    def of(cls, name: str) -> "Direction":
        """Return what the name of a component says, in plain degrees ("228"), bearings ("N26W"), words and codes.

        >>> Direction.of("N26W").azimuth, Direction.of("+V").vertical, Direction.of("--L").relative
        (334.0, True, 'L')
        """
        word = name.strip().upper().replace("–", "-")
        if _is_vertical(word):
            return cls(vertical=True)
        along = _azimuth(word)
        bare = word.strip(" .+-")
        axis = _RELATIVE.get(bare) or _RELATIVE.get(bare.rstrip("0123456789"), "")
        if code := _OF_ONE_INSTRUMENT.fullmatch(bare):
            axis = code[2]
        return cls(along, relative=axis)

    @property
    def is_known(self) -> bool:
        """Whether it is upwards, or an azimuth."""
        return self.vertical or self.azimuth is not None


def directed(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return fields of an Accelerogram, `vertical` and `azimuth` by its component's name where they are blank."""
    by_name = Direction.of(fields.get("component", ""))
    vertical = fields.get("vertical")
    azimuth = fields.get("azimuth")
    if vertical is None:
        vertical = by_name.vertical
    if azimuth is None:
        azimuth = by_name.azimuth
    return {**fields, "vertical": vertical, "azimuth": None if vertical else azimuth}


def _is_vertical(word: str) -> bool:
    """Whether a word in capitals says that a component is vertical: UP, +V, UD, or a channel code that ends in Z."""
    band = _BAND.fullmatch(word) or _BAND_AND_AXIS.fullmatch(word)
    if band:
        return band[1].endswith("Z")
    if word.strip("+-") in _VERTICAL or _NUMBERED_VERTICAL.fullmatch(word):
        return True
    if _SURELY_VERTICAL.search(word.replace("_", " ")) and "HORIZ" not in word:
        return True
    parts = [part for part in re.split(r"[^A-Z]+", word) if part]
    return bool(parts) and all(_VERTICAL_WORD.fullmatch(part) for part in parts)


def _azimuth(word: str) -> float | None:
    """Return the azimuth that a word in capitals says, degrees, or None."""
    if angle := _DEGREES.fullmatch(word):
        return float(angle[1]) % 360 if float(angle[1]) <= 360 else None
    if band := _BAND.fullmatch(word) or _BAND_AND_AXIS.fullmatch(word):
        word = band[1][-1]
    if quadrant := _QUADRANT.fullmatch(word):
        pole, degrees, side = quadrant.groups()
        turn = int(degrees) if (pole == "N") == (side == "E") else -int(degrees)
        return float(((0 if pole == "N" else 180) + turn) % 360)
    ends = [_NAMED.get(part, math.nan) for part in re.split("[-/ ]+", word)]
    is_pair = len(ends) == 2 and abs(ends[0] - ends[-1]) == 180
    return _NAMED.get(word, ends[0] if is_pair else None)


def names_acceleration(component: str) -> bool:
    """Whether a component's name is but a word for acceleration."""
    return bool(_ONLY_ACCELERATION.fullmatch(component.strip()))


def names_no_direction(component: str) -> bool:
    """Whether a component's name is but the place of its column, or a word for acceleration."""
    is_place = not component or (component.startswith("channel ") and component[8:].isdecimal())
    return is_place or names_acceleration(component)


_ONLY_ACCELERATION = re.compile(r"a|ag|a_g|acc\w*|ground[ _]?acc\w*|amplitude|values?|data", re.I)


def warnings_of_channel(channel: Channel) -> tuple[RockingWarning, ...]:
    """Return a warning where a channel has a name, and neither that nor its header says where it points."""
    name = channel.component.strip()
    if channel.vertical or channel.azimuth is not None or not name:
        return ()
    if _SAYS_WHICH.fullmatch(name.strip("+-")) or _BAND.fullmatch(name.upper()):
        return ()
    is_beyond = name.isdigit() and int(name) > 360
    is_combined = re.match(r"(?i)rot|srss|gm|geo", name) is not None
    is_longer_angle = re.search(r"\d\d", name) is not None  # an angle to which a program has written more
    unknown = is_beyond or is_combined or not is_longer_angle
    return (RockingWarning(RecordKind.DIRECTION_UNKNOWN, name),) if unknown else ()


def contradiction(channel: Channel) -> tuple[RockingWarning, ...]:
    """Return a warning where a channel code (HNE) points elsewhere than the header of its record.

    A code is taken at its word where N and E are near their axes, whichever way they point.
    """
    code = _BAND.fullmatch(channel.component.strip().upper())
    axis = {"N": 0.0, "E": 90.0}.get(code[1][2]) if code else None
    if code is None or (axis is None and code[1][2] != "Z"):
        return ()
    along = channel.azimuth
    is_same = channel.vertical == code[1].endswith("Z")
    off_axis = (
        0.0 if along is None or axis is None or channel.vertical else abs((along - axis + 90) % 180 - 90)
    )
    if is_same and off_axis <= _OFF_AXIS:
        return ()
    direction = (
        "upwards" if channel.vertical else "to no known azimuth" if along is None else f"to {along:g}°"
    )
    return (
        RockingWarning.of(RecordKind.DIRECTION_CONTRADICTED, channel.component.strip(), direction=direction),
    )


def vertical_warning(channels: Sequence[Channel]) -> RockingWarning | None:
    """Return a warning where one of the channels may be vertical, and nothing says whether it is.

    That is so of three channels or more without directions, and of a lone one with a code of unknown direction.
    """
    if any(channel.vertical for channel in channels):
        return None
    if len(channels) == 1:  # a heading of a table is prose, and no less horizontal for that
        code = channels[0].component.strip()
        is_code = _SEED.fullmatch(code) and not names_acceleration(code)
        is_open = is_code and warnings_of_channel(channels[0])
        return RockingWarning(RecordKind.LONE_MAY_BE_VERTICAL, code) if is_open else None
    of_unknown = [channel.component for channel in channels if channel.azimuth is None]
    if len(channels) < _OF_A_STATION or not of_unknown:
        return None
    names = ", ".join(of_unknown[:_OF_A_STATION])
    return RockingWarning.of(RecordKind.SOME_MAY_BE_VERTICAL, channels=len(channels), names=names)


def pair_warning(horizontal: Sequence[Channel]) -> RockingWarning | None:
    """Return a warning where the angle of two horizontal components is neither known nor said by their names."""
    if len(horizontal) != 2 or any(channel.vertical for channel in horizontal):
        return None
    first, second = (channel.component for channel in horizontal)
    axes = {Direction.of(name).relative for name in (first, second)}
    if angle_between(*horizontal) is not None or axes in _ACROSS:
        return None
    if names_no_direction(first) and names_no_direction(second):
        return None
    return RockingWarning.of(RecordKind.ANGLE_UNKNOWN, first=first, second=second)


def angle_between(first: Channel, second: Channel) -> float | None:
    """Return the angle between two horizontal channels, degrees in [0, 180), None where it is unknown."""
    if first.azimuth is None or second.azimuth is None:
        return None
    return (second.azimuth - first.azimuth) % 180
