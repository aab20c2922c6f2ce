"""The label of a column in a table: what it says of the quantity, the unit and the direction of its numbers."""

import re
from dataclasses import dataclass
from functools import cached_property

from rocking.errors import RecordError
from rocking.quantities import acceleration_unit
from rocking.records.direction import Direction
from rocking.records.instrument import other_quantity

_TIME = re.compile(
    r"(?i)t\d?|(time|zeit|tiempo|temp[os]|zaman|seconds?|secs?)(?![a-z]).*|"
    r"[^()\[\]]*[(\[]\s*(s(ec|eg)?|sn|sek)\s*[)\]]"
)
_COUNT = re.compile(
    r"(?i)(no|nr|n|i|id|#|index|count|counter|sample|samples|point|points|step|row|line)\b\.?.*"
)
_TIMES = {
    "s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "millisecond": 1e-3,
    "seg": 1.0, "segundos": 1.0, "sek": 1.0, "sekunden": 1.0, "sn": 1.0, "saniye": 1.0, "secondi": 1.0, "secondes": 1.0,
    "milliseconds": 1e-3, "us": 1e-6, "µs": 1e-6, "microseconds": 1e-6, "min": 60.0, "minute": 60.0, "minutes": 60.0,
    "h": 3600.0, "hour": 3600.0, "hours": 3600.0, "utc": 1.0, "gmt": 1.0, "local": 1.0, "hh:mm:ss": 1.0,
}  # fmt: skip
_TIME_UNIT = re.compile(r"[(\[]\s*([^)\]]*?)\s*[)\]]\s*$|[\s,_/]([A-Za-zµ]+)\s*$")
"""The unit of times, in brackets or as the last word."""
_BRACKETS = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_BARE_UNIT = (
    re.compile(r"(?i)\s+in\s+(\S+)\s*$"),
    re.compile(r"(?i)\s*[/,]\s*(m?g|gals?|[mc]?m/s\S+)\s*$"),
    re.compile(r"(?i)[\s_]+((?:[munc]?m|ft|in)\s?[/_ ]?s(?:ec)?(?:/s(?:ec)?|[_^]?2|\*\*2|²))\s*$"),
    re.compile(r"(?i)[\s_]+(gals?)\s*$"),
    re.compile(r"(?i)[\s_]+([munc]?m(?:[_ ]?per[_ ]?s(?:ec)?2|s2))\s*$"),
)
"""A unit that ends a label without brackets: "Acc/g", "NS, cm/s2", "ns_m_s2". A "g" after a blank is of ground, but
after "in" it is a unit."""
_ACCELERATION = re.compile(r"(?i)^(acc(el(eration)?)?|a)([_\s.-]+(?!g$)|(?=(ns|ew|ud|up|[xyznev])$))")
_GROUND = re.compile(r"(?i)(?<!\bu)[_\s]g$")
"""The mark of the ground, as in "ns_g"; not that of "u_g", a displacement, which would be left as "u", up."""
_OF_DIRECTION = re.compile(
    r"(?i)^([xyz])[\s_-]*(?:dir(?:ection)?\.?|axis|comp(?:onent)?\.?|acc(?:el(?:eration)?)?)$"
)
"""A letter with the word for what it is, as "Z-direction", "X axis"."""
_AND_WHAT = re.compile(r"(?i)[\s_-]+(acc(el(eration)?)?|comp(onent)?|dir(ection)?)\.?$")
"""The noun after a direction: "vertical acceleration", "N-S component"."""
_BESIDE_DIRECTION = re.compile(
    r"(?i)linear|ground|input|raw|corr(ected)?|(un)?filt(ered)?|acc\w*|acel\w*|beschl\w*|ivme\w*|comp\w*|dir\w*|"
    r"axis|eje|ch(an(nel)?)?\d{0,2}|canal|kanal|\d{1,2}|g|a"
)
"""A word that says nothing of where a channel points."""
_PARTS = re.compile(r"[\s_.,:;()\[\]]+|(?<=[a-z])(?=[A-Z])|成分|方向")
"""The places at which the words of a label part."""
_SEED_ID = re.compile(r"[\w-]+([._ -][\w-]*)*[._ -]([A-Z][HNGL][A-Z\d])")
"""A channel code at the end of what names network and station: "IV.AMT..HNZ"."""

_OTHER_UNIT = re.compile(
    r"(?i)([cmuµk]?m|in(ch(es)?)?|ft|feet)(/s(ec)?)?|kines?|"
    r"[mk]?n|kips?|lbf?|kn[.*-]?m|[km]?pa|psi|[muµ]?v|volts?|count|cou?nts?|cts|adc|digits?|"
    r"(m?rad|deg(ree)?s?|°)(/s(ec)?[\^]?[2²]?)?|dps|rpm|[mµu]?t|lux|bar|kelvin|hz|g\^?[2²]|°?c|[uµ]?strain|µε|-|%|db|k?j|c?m2/s3"
)
"""Units in brackets that are of no acceleration."""
_LIKE_A_UNIT = re.compile(r"(?i).*(/|s\s*\^?-\d|\*\*|\^\s*-?\d|gal\b|²).*|[kmuµn]?g|\S*counts?\S*")
_OTHER_WORDS = re.compile(
    r"(?i)(?<![a-z])(gyro(scope)?|angular|magnet(ic|ometer)|strain|force|shear|moment|tilt|rot(ation)?|angle|temp(erature)?|pressure|volt(age)?|counts?|drift|"
    r"load|intensity|arias|husid|energy|power|stress|slip|uplift)(?![a-z])"
)
_NOT_OF_THE_GROUND = re.compile(
    r"(?i)(?<![a-z])(relative|rel|norm(ali[sz]ed)?|error|residual|resultant|srss|vector[ _]sum|rotd\d*|"
    r"geo(metric)?[ _]?mean)(?![a-z])"
)
"""Words before an acceleration that is not that of the ground in one direction, or no acceleration any more."""
_MULTIPLIED = re.compile(
    r"(?i)(?<![\w.])(?:10+|\d+[./]\d+)\s*(?:gal\b|(?:[munc]?m|ft|in)\s*/\s*s)|[x×*]\s*1\d*(\.0*)?(e[+-]?\d+|\^|0\b)|\b1e[+-]?\d+\b|\b10\s*(\^|\*\*|-\d)|\b10+\s*[x×*]"
)
"""A power of ten by which a label says that its numbers are multiplied."""
_MEANT = {
    **dict.fromkeys(("v", "vel"), "velocity"),
    **dict.fromkeys(("d", "u", "x", "dis", "des", "desp", "spost", "disp", "displ"), "displacement"),
}
"""The quantity of a letter beside a column "a"."""


@dataclass(frozen=True)
class ColumnLabel:
    """The name of a column as its file writes it, "" where it writes none."""

    text: str

    @property
    def is_time(self) -> bool:
        """Whether the column is called one of times."""
        return bool(_TIME.fullmatch(self.text))

    @property
    def is_count(self) -> bool:
        """Whether the column is called one of a count of the rows."""
        return bool(_COUNT.fullmatch(self.text))

    @property
    def seconds(self) -> float:
        """The unit of a column of times, s. Raises RecordError where it is in brackets and unknown."""
        match = _TIME_UNIT.search(self.text)
        if match is None:
            return 1.0
        if match[1] and match[1].lower() not in _TIMES:
            raise RecordError(
                f"the times are in {match[1][:20]!r}, but must be in s, ms or min; convert them."
            )
        return _TIMES.get((match[1] or match[2] or "s").lower(), 1.0)

    @cached_property
    def unit(self) -> str | None:
        """The unit of acceleration that it names, None where it names none."""
        if match := _BRACKETS.search(self.text):
            return acceleration_unit(match[1])
        found = (match[1] for pattern in _BARE_UNIT if (match := pattern.search(self.text)))
        return next((unit for each in found if (unit := acceleration_unit(each))), None)

    @property
    def other(self) -> str:
        """The quantity that it states, where that is no acceleration, "" else."""
        if quantity := other_quantity(self.text):
            return quantity
        if _MULTIPLIED.search(self.text):
            return "multiplied by a power of ten"
        if word := _NOT_OF_THE_GROUND.search(self.text):
            return word[1].lower()
        if self.unit:
            return ""
        if word := _OTHER_WORDS.search(self.text):
            return word[1].lower()
        match = _BRACKETS.search(self.text)
        if match is None or self._is_direction(match):
            return ""
        unit = match[1]
        if _OTHER_UNIT.fullmatch(unit) or _LIKE_A_UNIT.fullmatch(unit):
            return f"in {unit[:20]!r}"
        return ""

    def beside_acceleration(self) -> str:
        """The quantity of a label like "v" or "disp" beside a column called "a", "" of another label."""
        return _MEANT.get(self.text.strip().lower(), "")

    @property
    def is_plain_acceleration(self) -> bool:
        """Whether it names the quantity and no direction: "a", "Acc", "acceleration"."""
        bare = _BRACKETS.sub("", self.text).strip()
        return bool(re.fullmatch(r"(?i)ag?|a_g|ac|acc(el(eration)?)?|aceleraci[oó]n|accelerazione", bare))

    @property
    def is_direction(self) -> bool:
        """Whether it says where the component points."""
        return Direction.of(self.component).is_known

    @property
    def component(self) -> str:
        """The name of the component: without unit, word for acceleration, network and station."""
        name = _BRACKETS.sub("", self.text)
        match = _BRACKETS.search(self.text)
        if match and self.unit is None and self._is_direction(match):
            return match[1].strip()
        if self.unit and not match:
            for pattern in _BARE_UNIT:
                name = pattern.sub("", name)
        name = _ACCELERATION.sub("", name.strip())
        name = _OF_DIRECTION.sub(r"\1", name)
        directed = _GROUND.sub("", _AND_WHAT.sub("", name))
        if directed != name and Direction.of(directed).is_known:
            name = directed
        if code := _SEED_ID.fullmatch(name.strip()):
            name = code[2]
        return _only_direction(name) or name.strip()

    def _is_direction(self, brackets: re.Match[str]) -> bool:
        """Whether what stands in brackets is a direction, as in "Acc (N)": no other name stands before it."""
        before = self.text[: brackets.start()].strip()
        words = [word for word in _PARTS.split(before) if word]
        is_letter = len(brackets[1]) == 1  # V may be of volts
        is_named = any(not _BESIDE_DIRECTION.fullmatch(word) for word in words)
        if is_letter and before and not ColumnLabel(before.rstrip(".")).is_plain_acceleration:
            return False
        return not is_named and Direction.of(brackets[1]).is_known


_AXES = {"x", "y", "z"}


def _only_direction(name: str) -> str:
    """Return the only word of a name that says where it points, "" where it has another that says something else."""
    if _NUMBERED.search(name):
        return ""
    words = [word.strip("-") for word in _PARTS.split(name)]
    words = [part for word in words for part in ([word] if _points(word) else word.split("-"))]
    told = [word for word in words if word and not _BESIDE_DIRECTION.fullmatch(word)]
    return told[0] if len(told) == 1 and _points(told[0]) else ""


_NUMBERED = re.compile(r"(?i)[nsew]-\d+")
"""A letter with a number behind a dash, as "S-1", which counts soils or sites."""


def _points(word: str) -> bool:
    """Whether a word is a direction or an axis, and no mere number nor "u", which is a displacement too."""
    if word.isdigit() or word.lower() == "u":
        return False
    return word.lower() in _AXES or Direction.of(word).is_known
