"""The kinds of warnings on an integration, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class MotionKind(Kind):
    """A kind of warning on an integration."""

    # fmt: off
    # An integration.
    WEIGHTLESS = auto(), """for an instant the ground falls faster than gravity, so that bodies would lose
        contact; the model keeps them on the ground."""
    # fmt: on
