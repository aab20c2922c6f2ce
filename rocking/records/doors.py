"""Doors: the way in through which a file is read, in whose words an error says what to do."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Literal

Door = Literal["python", "command", "catalogue"]
"""The functions of this package, the command line with files, or a catalogue of records."""
Wanted = Literal["unit", "time_step", "inventory"]
"""What a file may leave to its user: a unit, a time step, the StationXML of the instrument."""

_DOOR: ContextVar[Door] = ContextVar("door", default="python")
_ADVICE: dict[Door, dict[Wanted, str]] = {
    "python": {
        "unit": "give unit=",
        "time_step": "give time_step=",
        "inventory": "give its StationXML as inventory=",
    },
    "command": {
        "unit": "give --unit",
        "time_step": "give --time-step",
        "inventory": "give its StationXML among the files, or put it in the same folder",
    },
    "catalogue": {
        "unit": "fill in the column unit of the catalogue",
        "time_step": "fill in the column time_step_s of the catalogue",
        "inventory": "put its StationXML in the folder of the file, or name it in the catalogue's column inventory",
    },
}


@contextmanager
def through(door: Door) -> Iterator[None]:
    """Let errors that are raised within speak to a user who came through `door`."""
    token = _DOOR.set(door)
    try:
        yield
    finally:
        _DOOR.reset(token)


def advice(wanted: Wanted) -> str:
    """Return what a user does to say what is `wanted`, in the words of the door that is open.

    >>> from rocking.records.doors import advice, through
    >>> with through("command"):
    ...     print(advice("unit"))
    give --unit
    """
    return _ADVICE[_DOOR.get()][wanted]
