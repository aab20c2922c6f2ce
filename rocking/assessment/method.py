"""Method: how a largest rotation was computed."""

from enum import StrEnum


class Method(StrEnum):
    """How a largest rotation was computed."""

    PRINTED = "printed"
    CLOSED_FORM = "closed form"
    BLOCK_ON_PULSE = "block on pulse"
    BLOCK_ON_RECORD = "block on record"
    MECHANISM_ON_PULSE = "mechanism on pulse"
    MECHANISM_ON_RECORD = "mechanism on record"
    PEAK_VELOCITY = "peak velocity"
    """The probability of overturning that p PGV/(gλ) gives is beyond doubt; the rotation is its median."""
    NOTHING_TO_INTEGRATE = "nothing to integrate"
    """The ground never reaches the uplift acceleration, so the rotation is zero exactly."""
