"""The kinds of warnings on the earthquakes and stations behind a result."""

from enum import auto

from rocking.warnings import Kind


class SampleKind(Kind):
    """A kind of warning on a sample of stations and earthquakes."""

    # fmt: off
    EARTHQUAKES_UNNAMED = auto(), """{records} of {all} records name no earthquake, and count as of one: name
        it in the column event of the catalogue, or declare each of them an earthquake of its own
        (unnamed_events: each)."""
    EARTHQUAKE_ONE = auto(), """All {stations} stations are of one earthquake, which says nothing about another:
        there is no interval."""
    EARTHQUAKES_FEW = auto(), """With {earthquakes} earthquakes, fewer than {fewest}, nothing is resampled:
        intervals are those of Student, or of Clopper and Pearson, on the earthquakes, and those of a median
        and of a rate hold less often than nine times in ten."""
    EARTHQUAKE_NAMED_TWICE = auto(), """One motion is listed under two earthquakes, {first} and {second}: name
        it once, or leave one record out."""
    STATION_OF_TWO_EARTHQUAKES = auto(), """Station {about} is given for two earthquakes, {first} and
        {second}, and counts for the first: give each its own name in each earthquake."""
    # fmt: on
