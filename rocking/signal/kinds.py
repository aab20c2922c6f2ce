"""The kinds of warnings on the samples of a record and on what is made of them."""

from enum import auto

from rocking.warnings import Kind


class SignalKind(Kind):
    """A kind of warning on the samples of a record."""

    # fmt: off
    STEP_UNUSUAL = auto(), """The time step is {time_step_s:g} s: accelerographs sample strong motion at steps
        from {shortest_s:g} to {longest_s:g} s."""
    PEAK_IMPOSSIBLE = auto(), """The peak acceleration is above 5 g, which no recorded ground motion has
        reached; check the unit and the factor."""
    PEAK_RARE_BY_FACTOR = auto(), """Multiplied by {factor:g} the peak acceleration is {peak_g:.3g} g, above 3
        g: hardly any recorded ground motion is so strong; check the factor."""
    SCALED_FAR = auto(), """Scaled by {factor:.3g}, beyond a factor of {largest:g}: a record that is really so
        strong or weak has another duration and other periods; choose another record."""
    CUT_TO_THE_SHORTER = auto(), """The components hold {short} and {long} samples; the longer was cut to the
        shorter."""
    # fmt: on
