"""The kinds of warnings that only a page makes, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class ReportKind(Kind):
    """A kind of warning that only a page makes."""

    # fmt: off
    # What explains a decision that nothing more would settle.
    STANDS_AS_VOUSSOIRS = auto(), """A joint of {about} needs a friction of {needed:.2g} while it rocks; as
        loose voussoirs on a friction of 0.5 and more, such arches stood wherever their mechanism
        does.""", "needs μ {needed:.2g}; such arches stood"

    # A structure, and where it stands.
    CRUSHING_WOULD_TELL = auto(), """{about}: no compressive_strength is given. If the edges of the joints
        crush at 2 MPa, rocking starts at a lower acceleration (static_multiplier_crushing in structures.csv),
        which by the reserves under this record changes the verdict or moves the share that overturns by more
        than 0.1: give the strength.""", "{about}: crushing at 2 MPa would matter"

    # What a strip of variants says of each against the first.
    THE_FIRST = auto(), "the first"
    SHARE_DIFFERS = auto(), "{points} points of share"
    SAME_SHARE = auto(), "no difference of share shown"
    RESERVE_DIFFERS = auto(), "reserve × {ratio}"
    NO_DIFFERENCE = auto(), "not comparable"
    RESERVE_OF_VARIANT = auto(), "5–50 % fall at {reserve} × the record"
    RESERVE_OF_MECHANISM = auto(), "5–50 % fall at {reserve} × the record (mechanism alone)"
    NOT_JUDGED = auto(), "not judged"
    # fmt: on
