"""Quantity: a file of velocity or displacement is refused by that word, never read as acceleration."""

import re

from rocking.errors import RecordError

_ACCELERATION = re.compile(r"(?<![a-z])(acc|acel|beschl)", re.I)
_OTHER = {
    "velocity": re.compile(r"(?<![a-z])vel(oc\w*|\b)|(?<![\w/])(cm|m|mm|in)/s(ec)?\b(?!\s*[/^*²2])", re.I),
    "displacement": re.compile(r"(?<![a-z])displ?(ac\w*|\b)", re.I),
}
_OF_THE_GROUND = re.compile(r"shear|wave|vs[ _,]?30", re.I)
"""The velocity of a site is no record."""
_SUFFIXES = {
    ".vt2": "velocity", ".vel": "velocity", ".vtx": "velocity",
    ".dt2": "displacement", ".dis": "displacement", ".disp": "displacement",
}  # fmt: skip


def other_quantity(text: str) -> str | None:
    """Return "velocity" or "displacement" when `text`, a header or the name of a column, speaks of it alone."""
    if _ACCELERATION.search(text) or _OF_THE_GROUND.search(text):
        return None
    return next((word for word, pattern in _OTHER.items() if pattern.search(text)), None)


def refuse_other_quantity(file: str, text: str) -> None:
    """Raise RecordError when `text`, a header, or the ending of the name `file` speaks of another quantity."""
    suffix = next((word for end, word in _SUFFIXES.items() if file.lower().endswith(end)), None)
    if quantity := other_quantity(text) or suffix:
        raise RecordError(
            f"this is a file of {quantity}, not of acceleration; use the acceleration of the same record."
        )
