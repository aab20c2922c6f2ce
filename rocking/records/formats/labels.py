"""The label of a column in a table: what it says of its numbers, by closed lists; what these do not hold is asked."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from rocking.quantities import SECONDS, seconds_of
from rocking.records.claims import (
    IN_BRACKETS,
    MULTIPLIED,
    PLAIN_ACCELERATION,
    WORDS_OF_ACCELERATION,
    Claim,
    Where,
    agreed,
    other_of_column,
    unit_of_column,
    without_unit,
)
from rocking.records.direction import Direction

_TIME = re.compile(
    r"(?i)t\d?|(time(stamp)?|date[ _]?time|zeit|tiempo|temp[os]|zaman|χρόνος|seconds?|secs?)(?![a-z]).*|"
    r"t\d?\s*[(\[]\s*(min|minutes?|h|hours?)\s*[)\]]|[^()\[\]]*[(\[]\s*([mµu]?s(ec|eg)?|sn|sek)\s*[)\]]"
)
_COUNT = re.compile(
    r"(?i)(no|nr|n|i|id|#|index|count|counter|sample|samples|point|points|step|row|line)\b\.?.*"
)
_TIME_UNIT = re.compile(r"[(\[]\s*([^)\]]*?)\s*[)\]]\s*$|(?:^|[\s,_/])([A-Za-zµ]+)\s*$")
"""The unit of times, in brackets or as the last word."""
_NO_TIME_UNIT = re.compile(r"(?i)(samples?|points?|ticks?|(?<!\d)1/\d.*|[x×*]\s*\d.*|\d\s*[x×*].*)")
"""A count, or a factor by which the times are still to be multiplied."""

_PARTS = re.compile(r"[\s_.,:;()\[\]]+|(?<=[a-z])(?=[A-Z])|成分|方向")
"""The places at which the words of a label part."""
_NO_DIRECTION = re.compile(
    rf"(?i)linear|ground|input|raw|corr(ected)?|(un)?filt(ered)?|{WORDS_OF_ACCELERATION}|comp\w*|dir\w*|"
    r"axis|eje|ch(an(nel)?)?\d{0,2}|canal|kanal|\d{1,2}|g|a"
)
"""A word that says nothing of where a channel points."""
_LEADING = re.compile(r"(?i)^(?:acc(?:el(?:eration)?)?|a)(?=(?:ns|ew|ud|up|[xyznev])$)")
"""The word for acceleration at the head of one word, as in "AccUD" and "az"."""
_NUMBERED = re.compile(r"(?i)[nsew]-\d+")
"""A letter with a number behind a dash, as "S-1", which counts soils or sites."""
_COUNTED = re.compile(r"(?i)(ch)?\d+")
"""What counts the columns, or the channels of a logger."""
_SEED_ID = re.compile(r"[\w-]+([._ -][\w-]*)*[._ -]([A-Z][HNGL][A-Z\d])")
"""A channel code at the end of what names network and station: "IV.AMT..HNZ"."""
_AXES = {"x", "y", "z"}


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
    def seconds(self) -> float | None:
        """The unit of times, s, None where it says none. Raises RecordError where it is in brackets and unknown."""
        match = _NO_TIME_UNIT.search(self.text) or _TIME_UNIT.search(self.text)
        if match and match[1]:
            return seconds_of(match[1])
        return SECONDS.get(match[2].lower()) if match and match[2] else None

    @cached_property
    def unit(self) -> str | None:
        """The unit of acceleration that it names, None where it names none, or a factor next to it."""
        return unit_of_column(self.text)

    @property
    def other(self) -> str:
        """The quantity that it states, where that is no acceleration of the ground, "" else."""
        return other_of_column(self.text)

    @property
    def is_known(self) -> bool:
        """Whether it is in the closed lists: times, a count, another quantity, or acceleration.

        Acceleration it is by its unit, by its direction, or by the word for it alone: not with a strange unit.
        """
        is_motion = self.is_direction or self.is_plain_acceleration
        return self.is_time or self.is_count or bool(self.other) or bool(self.unit) or is_motion

    @property
    def is_strange(self) -> bool:
        """Whether it holds a factor, or in brackets what is neither a unit of acceleration nor a direction."""
        match = IN_BRACKETS.search(self.text)
        is_foreign = match is not None and self.unit is None and not self._is_direction(match)
        return is_foreign or bool(MULTIPLIED.search(self.text))

    @property
    def is_plain_acceleration(self) -> bool:
        """Whether it names the quantity and no direction: "a", "Acc", "acceleration"."""
        bare = IN_BRACKETS.sub("", self.text).strip()
        return not self.is_strange and bool(PLAIN_ACCELERATION.fullmatch(bare))

    @property
    def is_direction(self) -> bool:
        """Whether it says where the component points, or which of two axes it is."""
        direction = Direction.of(self.component)
        is_axis = bool(direction.relative) and not _COUNTED.fullmatch(self.component)
        return not self.is_strange and (direction.is_known or is_axis)

    @cached_property
    def component(self) -> str:
        """The name of the component: its one word that says where it points, else the label without unit."""
        name = self.text
        match = IN_BRACKETS.search(name)
        if match and self.unit is None and self._is_direction(match):
            return match[1].strip()
        name = IN_BRACKETS.sub("", name)
        if self.unit and not match:
            name = without_unit(name)[0]
        name = name.strip()
        if code := _SEED_ID.fullmatch(name):
            name = code[2]
        return _only_direction(name) or name

    def _is_direction(self, brackets: re.Match[str]) -> bool:
        """Whether the text in brackets is a direction, as in "Acc (N)": no other name precedes it."""
        before = self.text[: brackets.start()].strip()
        if len(brackets[1]) == 1 and before:  # V may be of volts
            return (
                ColumnLabel(before.rstrip(".")).is_plain_acceleration and Direction.of(brackets[1]).is_known
            )
        is_named = any(not _NO_DIRECTION.fullmatch(word) for word in _PARTS.split(before) if word)
        return not is_named and Direction.of(brackets[1]).is_known


def with_units(names: Sequence[str], units: Sequence[str]) -> tuple[str, ...]:
    """Return names of columns with the units in brackets, which the row below them holds.

    () where that row holds anything else than units, or none of acceleration.
    """
    bare = [unit.strip("()[] ") for unit in units]
    given = [ColumnLabel(f"({unit})") for unit in bare if unit]
    are_units = all(label.unit or label.is_time or label.other for label in given)
    if not (are_units and any(label.unit for label in given)):
        return ()
    for name, label in zip(names, (ColumnLabel(f"({unit})") for unit in bare), strict=False):
        texts = zip((ColumnLabel(name).unit, label.unit), (name, label.text), strict=True)
        agreed("unit", [Claim("unit", unit, Where.COLUMN, text) for unit, text in texts])
    return tuple(f"{name} ({unit})" if unit else name for name, unit in zip(names, bare, strict=False))


def _only_direction(name: str) -> str:
    """Return the only word of a name that says where it points, "" where it has another that says something else."""
    if _NUMBERED.search(name):
        return ""
    words = [_LEADING.sub("", word.strip("-")) for word in _PARTS.split(name)]
    words = [part for word in words for part in ([word] if _points(word) else word.split("-"))]
    directions = [word for word in words if word and not _NO_DIRECTION.fullmatch(word)]
    return directions[0] if len(directions) == 1 and _points(directions[0]) else ""


def _points(word: str) -> bool:
    """Whether a word is a direction or an axis, and no mere number nor "u", which is a displacement too."""
    if word.isdigit() or word.lower() == "u":
        return False
    return word.lower() in _AXES or Direction.of(word).is_known
