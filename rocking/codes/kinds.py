"""The kinds of warnings on a check at the design level, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class CheckKind(Kind):
    """A kind of warning on a check at the design level."""

    # fmt: off
    # Why the displacement of a limit state is what it is.
    LIMIT_SHARE = auto(), "{share:g} d₀"
    LIMIT_TIE_BREAKS = auto(), "a tie breaks"
    LIMIT_LOAD_FALLS = auto(), "what it carries falls"
    LIMIT_NOWHERE = auto(), "a vanishes nowhere"

    # A check of a code, and the conclusion on a structure at its design level.
    VERIFIED = auto(), "verified by {clause}"
    NOT_VERIFIED = auto(), "not verified by {clause}", "not verified"
    OTHER_SETS = auto(), "{share} of sets of other stations would meet it"
    OTHER_SETS_UNKNOWN = auto(), "too few stations to say what sets of other stations would give"
    CHECK_NOT_MET = auto(), "not met"
    DISPLACEMENT_EXCEEDED = auto(), "not met: d₀ is exceeded under {exceeding} of {motions} motions"
    SETS_TOO_FEW = auto(), """met by this set, but not called met: only {sets} other sets lie within the
        limits, and {asked} are required; give more records, or a narrower range of periods"""
    SETS_DISAGREE = auto(), """met by this set, but not called met: {share_percent:.0f} % of {sets} sets meet
        it, and {least_percent:.0f} % are required"""
    OTHERS_TOO_FEW = auto(), """met by this set, but not called met by sets: {low_percent:.0f} to
        {high_percent:.0f} % of sets of other stations meet it, to judge by {stations} stations of
        {earthquakes} earthquakes, and at least {least_percent:.0f} % must (least_others); from about {needed}
        stations of as many earthquakes on, none of which lets it fall, that can be shown"""
    OTHER_STATIONS = auto(), """That the check is met is no proof for other stations than the {stations} of
        the pool, of {earthquakes} earthquakes: even if it falls at none of these, it may fall at up to
        {unseen_percent:.0f} % of all stations, and as few as {least_percent:.0f} % of sets of other stations
        may meet the check, to judge by the stations and earthquakes of the pool."""
    NO_DISPLACEMENT = auto(), """It cannot overturn: it {why}. The displacement d₀ that the nonlinear and the
        dynamic check require does not exist, so neither was made; the force in the ties is not checked."""

    # Why something could not be computed or drawn.
    STATIONS_TOO_FEW = auto(), """the records come from {stations} stations, but a set of {count} needs as
        many; give more records, or ask for fewer stations."""
    NO_SET_WITHIN = auto(), """no set of {count} stations lies within {below_percent:+.0f} and
        {above_percent:+.0f} % of the target, of {drawn} drawn; the nearest lies between {low_percent:+.0f}
        and {high_percent:+.0f} %; give more records, wider factors or a narrower range of periods."""
    # fmt: on
