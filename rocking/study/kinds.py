"""The kinds of remarks on a study and on its files, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class StudyKind(Kind):
    """A kind of remark on a study and on its files."""

    # fmt: off
    # A structure, and where it stands.
    REMARKS_MORE = auto(), Sentence(
        "{number} more remarks on the study stand in summary/remarks.csv.",
        "altre {number} osservazioni sullo studio stanno in summary/remarks.csv.",
    )

    # A catalogue and its folder, and a study before its run.
    FILE_APART = auto(), Sentence("{about}: {why}", "{about}, a parte: {why}")
    FILE_WITHOUT_RECORD = auto(), Sentence("{about} is not used: {why}", "{about} non è usato: {why}")
    SIBLING_NOT_USED = auto(), Sentence(
        "{other}, beside {about}, is a component of the same station and is not used: give it too.",
        "{other}, accanto a {about}, è una componente della stessa stazione e non è usato: indicarlo anch'esso.",
    )
    OUTDATED = auto(), Sentence(
        "{about}: {why}, so that the summary leaves it out and its files go; measure it again: "
        "rocking run . {about}.",
        "{about}: {why}, per cui il riepilogo lo omette e i suoi file sono rimossi; per ricalcolarlo: "
        "rocking run . {about}.",
    )
    # fmt: on
