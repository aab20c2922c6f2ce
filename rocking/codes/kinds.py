"""The kinds of remarks on a check at the design level, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class CheckKind(Kind):
    """A kind of remark on a check at the design level."""

    # fmt: off
    # Why the displacement of a limit state is what it is.
    LIMIT_SHARE = auto(), Sentence("{share:g} d₀", "{share:g} d₀")
    LIMIT_TIE_BREAKS = auto(), Sentence("a tie breaks", "una catena si rompe")
    LIMIT_LOAD_FALLS = auto(), Sentence("what it carries falls", "perdita di appoggio di ciò che porta")
    LIMIT_NOWHERE = auto(), Sentence("a vanishes nowhere", "a non si annulla")

    # A check of a code, and the conclusion on a structure at its design level.
    VERIFIED = auto(), Sentence("verified by {clause}", "verificato secondo {clause}")
    NOT_VERIFIED = auto(), Sentence(
        "not verified by {clause}",
        "non verificato secondo {clause}",
        brief="not verified",
    )
    OTHER_SETS = auto(), Sentence(
        "{share} of sets of other stations would meet it",
        "{share} dei gruppi di altre stazioni la soddisferebbe",
    )
    OTHER_SETS_UNKNOWN = auto(), Sentence(
        "too few stations to say what sets of other stations would give",
        "stazioni troppo poche per dire che cosa darebbero gruppi di altre stazioni",
    )
    CHECK_NOT_MET = auto(), Sentence("not met", "non soddisfatta")
    DISPLACEMENT_EXCEEDED = auto(), Sentence(
        "not met: d₀ is exceeded under {exceeding} of {motions} motions",
        "non soddisfatta: d₀ è superato in {exceeding} dei {motions} accelerogrammi",
    )
    SETS_TOO_FEW = auto(), Sentence(
        "met by this set, but not called met: only {sets} other sets lie within the limits, and {asked} are "
        "required; give more records, or a narrower range of periods",
        "soddisfatta da questo gruppo, ma non considerata soddisfatta: altri gruppi entro i limiti sono "
        "{sets}, e ne occorrono {asked}; servono più registrazioni o un intervallo di periodi più stretto",
    )
    SETS_DISAGREE = auto(), Sentence(
        "met by this set, but not called met: {share_percent:.0f} % of {sets} sets meet it, and "
        "{least_percent:.0f} % are required",
        "soddisfatta da questo gruppo, ma non considerata soddisfatta: lo è per il {share_percent:.0f} % di "
        "{sets} gruppi, e ne occorre il {least_percent:.0f} %",
    )
    OTHERS_TOO_FEW = auto(), Sentence(
        "met by this set, but not called met by sets: {low_percent:.0f} to {high_percent:.0f} % of sets of other "
        "stations meet it, to judge by {stations} stations of {earthquakes} earthquakes, and at least "
        "{least_percent:.0f} % must (least_others); from about {needed} stations of as many earthquakes on, none of "
        "which lets it fall, that can be shown",
        "soddisfatta da questo gruppo, ma non considerata soddisfatta: lo è per il {low_percent:.0f}–"
        "{high_percent:.0f} % dei gruppi di altre stazioni, per quanto ne dicono {stations} stazioni di {earthquakes} "
        "terremoti, e ne occorre almeno il {least_percent:.0f} % (least_others); lo si può mostrare con circa {needed} "
        "stazioni di altrettanti terremoti, nessuna delle quali la faccia cadere",
    )
    OTHER_STATIONS = auto(), Sentence(
        "That the check is met is no proof for other stations than the {stations} of the pool, of {earthquakes} "
        "earthquakes: even if it falls at none of these, it may fall at up to {unseen_percent:.0f} % of all stations, "
        "and as few as {least_percent:.0f} % of sets of other stations may meet the check, to judge by the stations "
        "and earthquakes of the pool.",
        "Che la verifica sia soddisfatta non prova nulla per stazioni diverse dalle {stations} disponibili, di "
        "{earthquakes} terremoti: "
        "anche se nessuna di queste fa ribaltare la struttura, può farlo fino al {unseen_percent:.0f} % di "
        "tutte le stazioni, e dei gruppi di altre stazioni può soddisfarla anche solo il {least_percent:.0f} "
        "%, per quanto ne dicono le stazioni e i terremoti disponibili.",
    )
    NO_DISPLACEMENT = auto(), Sentence(
        "It cannot overturn: it {why}. The displacement d₀ that the nonlinear and the dynamic check require "
        "does not exist, so neither was made; the force in the ties is not checked.",
        "Non può ribaltare: lo spostamento d₀ richiesto dalle analisi non lineare e dinamica non esiste, per "
        "cui nessuna delle due è stata eseguita; lo sforzo nelle catene non è verificato.",
    )

    # Why something could not be computed or drawn.
    STATIONS_TOO_FEW = auto(), Sentence(
        "the records come from {stations} stations, but a set of {count} needs as many; give more records, or ask for "
        "fewer stations.",
        "le registrazioni provengono da {stations} stazioni, ma un gruppo di {count} ne richiede altrettante; fornire "
        "più registrazioni, o chiedere meno stazioni.",
    )
    NO_SET_WITHIN = auto(), Sentence(
        "no set of {count} stations lies within {below_percent:+.0f} and {above_percent:+.0f} % of the target, of "
        "{drawn} drawn; the nearest lies between {low_percent:+.0f} and {high_percent:+.0f} %; give more records, "
        "wider factors or a narrower range of periods.",
        "nessun gruppo di {count} stazioni sta fra {below_percent:+.0f} e {above_percent:+.0f} % dello spettro di "
        "progetto, su {drawn} estratti; il più vicino sta fra {low_percent:+.0f} e {high_percent:+.0f} %; fornire più "
        "registrazioni, fattori più ampi o un intervallo di periodi più stretto.",
    )
    # fmt: on
