"""The kinds of remarks on the pulses of a record, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class PulseKind(Kind):
    """A kind of remark on the pulses of a record."""

    # fmt: off
    # The dominant pulse of a record.
    PULSE_UNSTABLE = auto(), Sentence(
        "The choice is unstable: another pulse often wins when the record is turned.",
        "La scelta è instabile: ruotando la registrazione vince spesso un altro impulso.",
    )
    PULSE_AT_AN_END = auto(), Sentence(
        "The pulse touches an end of the record, so part of it may be missing.",
        "L'impulso tocca un'estremità della registrazione, per cui può mancarne una parte.",
    )
    PULSE_FILTERED = auto(), Sentence(
        "The pulse is long enough that the record's high-pass filter has reduced it.",
        "L'impulso è tanto lungo che il filtro passa-alto della registrazione lo ha ridotto.",
    )
    PULSE_SYMMETRIC = auto(), Sentence(
        "Two pulses of opposite sign, half a cycle apart, represent the motion equally well.",
        "Due impulsi di segno opposto, distanti mezzo ciclo, rappresentano il moto ugualmente bene.",
    )
    PULSE_AT_BAND_LIMIT = auto(), Sentence(
        "The period lies at a limit of the band that was searched, so the true pulse may lie outside it.",
        "Il periodo sta a un limite della banda esplorata, per cui il vero impulso può starne fuori.",
    )
    PULSE_RECORD_SHORT = auto(), Sentence(
        "The record is shorter than the longest period sought, so that period was left out.",
        "La registrazione è più corta del periodo più lungo cercato, che è stato quindi tralasciato.",
    )
    PULSE_SAMPLING_COARSE = auto(), Sentence(
        "The sampling is too coarse for the upper frequency; shorter periods were left out.",
        "Il campionamento è troppo rado per la frequenza superiore; i periodi più brevi sono stati "
        "tralasciati.",
    )
    PULSE_NEXT_TO_GAP = auto(), Sentence(
        "The record holds a run of identical samples longer than a second, which may be a gap that was "
        "filled.",
        "La registrazione contiene una serie di campioni uguali più lunga di un secondo, che può essere una "
        "lacuna riempita.",
    )
    # fmt: on
