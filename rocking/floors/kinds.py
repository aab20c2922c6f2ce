"""The kinds of remarks on a support and on its motion, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class FloorKind(Kind):
    """A kind of remark on a support and on its motion."""

    # fmt: off
    # The samples of a record.
    STILL_RINGING = auto(), Sentence(
        "The support still rings at {share:.1%} of its peak where its motion is cut off, {after_s:.0f} s "
        "after the record.",
        "Il supporto oscilla ancora con {share:.1%} del suo massimo dove il suo moto è tagliato, "
        "{after_s:.0f} s dopo la registrazione.",
    )

    # A structure, and where it stands.
    HEAVY_ON_SUPPORT = auto(), Sentence(
        "{about} has {ratio:.2g} of the mass of {support}: beyond {limit:g} its reaction on the support "
        "changes rotations by more than one per cent, at 0.1 by 11 % in the median, and is left out here.",
        "{about} ha {ratio:.2g} della massa di {support}: oltre {limit:g} la sua reazione sul supporto cambia"
        " le rotazioni di più dell'uno per cento, a 0,1 dell'11 % in mediana, e qui è trascurata.",
    )
    # fmt: on
