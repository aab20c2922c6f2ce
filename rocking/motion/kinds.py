"""The kinds of remarks on an integration, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class MotionKind(Kind):
    """A kind of remark on an integration."""

    # fmt: off
    # An integration.
    WEIGHTLESS = auto(), Sentence(
        "for an instant the ground falls faster than gravity, so that bodies would lose contact; the model "
        "keeps them on the ground.",
        "per un istante il suolo cade più velocemente della gravità, e i corpi perderebbero contatto; il "
        "modello li tiene a terra.",
    )
    # fmt: on
