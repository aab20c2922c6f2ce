"""The kinds of remarks on a study and on its files, with the sentence of each."""

from enum import auto

from rocking.remarks import Kind


class StudyKind(Kind):
    """A kind of remark on a study and on its files."""

    # fmt: off
    # A structure, and where it stands.
    REMARKS_MORE = auto(), "{number} more warnings on the study are in summary/remarks.csv."

    # A catalogue and its folder, and a study before its run.
    FILE_APART = auto(), "{about}: {why}"
    FILE_WITHOUT_RECORD = auto(), "{about} is not used: {why}"
    SIBLING_NOT_USED = auto(), """{other}, next to {about}, is a component of the same station and is not used:
        give it too."""
    # fmt: on
