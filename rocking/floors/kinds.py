"""The kinds of warnings on a support and on its motion, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class FloorKind(Kind):
    """A kind of warning on a support and on its motion."""

    # fmt: off
    # The samples of a record.
    STILL_RINGING = auto(), """The support still rings at {share:.1%} of its peak where its motion is cut off,
        {after_s:.0f} s after the record."""

    # A structure, and where it stands.
    HEAVY_ON_SUPPORT = auto(), """{about} has {ratio:.2g} of the mass of {support}: beyond {limit:g} its
        reaction on the support changes rotations by more than one per cent, at 0.1 by 11 % in the median, and
        is left out here."""
    # fmt: on
