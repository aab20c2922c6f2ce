"""The kinds of remarks that only a page makes, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class ReportKind(Kind):
    """A kind of remark that only a page makes."""

    # fmt: off
    # What explains a decision that nothing more would settle.
    STANDS_AS_VOUSSOIRS = auto(), Sentence(
        "A joint of {about} needs a friction of {needed:.2g} while it rocks; as loose voussoirs on a friction of 0.5 "
        "and more, such arches stood wherever their mechanism does.",
        "Un giunto di {about} richiede un attrito di {needed:.2g} mentre oscilla; come conci sciolti con attrito di "
        "0,5 e oltre, archi simili sono rimasti in piedi ovunque vi resti il loro meccanismo.",
        brief="needs μ {needed:.2g}; such arches stood",
    )

    # A structure, and where it stands.
    CRUSHING_WOULD_TELL = auto(), Sentence(
        "{about}: no compressive_strength is given. If the edges of the joints crush at 2 MPa, rocking starts"
        " at a lower acceleration (static_multiplier_crushing in structures.csv), which by the reserves under"
        " this record changes the verdict or moves the share that overturns by more than 0.1: give the "
        "strength.",
        "{about}: non è assegnata compressive_strength. Se gli spigoli dei giunti si schiacciano a 2 MPa, "
        "l'oscillazione inizia a un'accelerazione minore (static_multiplier_crushing in structures.csv), il "
        "che, secondo i margini con questa registrazione, cambia l'esito o sposta di oltre 0,1 la percentuale"
        " che ribalta: assegnare la resistenza.",
        brief="{about}: crushing at 2 MPa would matter",
    )

    # What a strip of variants says of each against the first.
    THE_FIRST = auto(), Sentence("the first", "riferimento")
    SHARE_DIFFERS = auto(), Sentence("{points} points of share", "{points} punti percentuali")
    SAME_SHARE = auto(), Sentence("same share", "stessa percentuale")
    RESERVE_DIFFERS = auto(), Sentence("reserve × {ratio}", "margine × {ratio}")
    NO_DIFFERENCE = auto(), Sentence("not comparable", "non confrontabile")
    RESERVE_OF_VARIANT = auto(), Sentence(
        "5–50 % fall at {reserve} × the record",
        "5–50 % delle simulazioni ribalta a {reserve} × la registrazione",
    )
    RESERVE_OF_MECHANISM = auto(), Sentence(
        "5–50 % fall at {reserve} × the record (mechanism alone)",
        "5–50 % delle simulazioni ribalta a {reserve} × la registrazione (solo meccanismo)",
    )
    NOT_JUDGED = auto(), Sentence("not judged", "non valutato")
    # fmt: on
