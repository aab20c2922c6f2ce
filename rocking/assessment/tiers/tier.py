"""Tier: what is known of a case before its mechanism is followed."""

from collections.abc import Mapping
from enum import StrEnum

STRUCTURE = ("restitution", "restoring_defect", "forcing_defect")
"""Known of every structure before any motion."""


class Tier(StrEnum):
    """What is known of a case."""

    CLOSED_FORM = "closed form"
    SINE = "most dangerous sine"
    PEAK_VELOCITY = "peak velocity"
    CLOSED_FORM_AND_PEAKS = "closed form and peaks"
    SEVEN_FIGURES = "seven figures"
    BLOCK = "block on record"
    BLOCK_AT_FIVE_SCALES = "block at five scales"

    @property
    def terms(self) -> tuple[str, ...]:
        """The measures it takes, of rocking.assessment.intensity."""
        return (*_KNOWN[self], *STRUCTURE)

    @property
    def follows_the_block(self) -> bool:
        """Whether its band is around the rotation of the block."""
        return "block" in _KNOWN[self]


_PULSE_AND_PEAKS = ("pulse", "peak_velocity", "peak_acceleration", "frequency_ratio")
_BLOCK = ("block", "block_overturns")
_AROUND = ("block_high", "block_overturning_share", "block_never_overturns", "block_always_overturns")
_KNOWN: Mapping[Tier, tuple[str, ...]] = {
    Tier.CLOSED_FORM: ("pulse",),
    Tier.SINE: ("sine",),
    Tier.PEAK_VELOCITY: ("peak_velocity",),
    Tier.CLOSED_FORM_AND_PEAKS: _PULSE_AND_PEAKS,
    Tier.SEVEN_FIGURES: (*_PULSE_AND_PEAKS, "sine", "velocity_change", "push"),
    Tier.BLOCK: _BLOCK,
    Tier.BLOCK_AT_FIVE_SCALES: (*_BLOCK, *_AROUND),
}
