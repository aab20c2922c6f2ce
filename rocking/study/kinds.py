"""The kinds of warnings on a study and on its files, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class StudyKind(Kind):
    """A kind of warning on a study and on its files."""

    # fmt: off
    # A catalogue and its folder, and a study before its run.
    FILE_APART = auto(), "{about}: {why}"
    FILE_WITHOUT_RECORD = auto(), "{about} is not used: {why}"
    SIBLING_NOT_USED = auto(), """{other}, next to {about}, is a component of the same station and is not used:
        give it too."""
    # fmt: on
