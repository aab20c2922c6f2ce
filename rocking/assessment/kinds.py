"""The kinds of remarks on a case and on its decision, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class AssessmentKind(Kind):
    """A kind of remark on a case and on its decision."""

    # fmt: off
    # What one degree of freedom does not follow.
    CONTACTS_OPEN = auto(), Sentence("contacts open", "i contatti si aprono")
    IMPACT_OPENS = auto(), Sentence(
        "an impact that keeps less than 0.3 of the velocity may open contacts",
        "un urto che conserva meno di 0,3 della velocità può aprire i contatti",
        brief="impact may open",
    )
    COURSES_THROWN = auto(), Sentence(
        "courses above a rocking body may be thrown",
        "i corsi sopra un corpo che oscilla possono essere proiettati",
        brief="courses may be thrown",
    )
    NOT_FOLLOWED = auto(), Sentence(
        "the mechanism of least λ cannot be followed",
        "il meccanismo di λ minimo non può essere simulato",
        brief="weakest not followed",
    )

    # What else makes a decision doubtful.
    COMPONENT_MISSING = auto(), Sentence("a component gave no result", "una componente non ha dato risultato")
    OTHER_CRACK_WORSE = auto(), Sentence(
        "a crack other than the known one is worse",
        "una lesione diversa da quella nota è peggiore",
        brief="another crack is worse",
    )
    MEMBERS_FAILED = auto(), Sentence(
        "members could not be followed",
        "alcune simulazioni non sono giunte al termine",
        brief="some members failed",
    )
    SLIDES_FIRST = auto(), Sentence(
        "a crack that slides before it lifts is left out",
        "è esclusa una lesione che scorre prima di aprirsi",
        brief="a crack slides first",
    )
    NO_STACK = auto(), Sentence(
        "contact dynamics cannot follow it, because it is neither a stack of courses nor a chain of stones",
        "la dinamica dei contatti non può seguirla: non è una pila di corsi né una catena di conci",
        brief="no stack or stones",
    )
    STONES_TELL = auto(), Sentence(
        "an arch on piers may fall as voussoirs where its mechanism stands",
        "un arco su piedritti può cadere come conci dove il suo meccanismo resta in piedi",
        brief="not followed as voussoirs",
    )
    HELD_BEYOND = auto(), Sentence(
        "a held wall rotates so far that its mechanism may predict too little",
        "una parete vincolata ruota tanto che il suo meccanismo può non bastare a descriverla",
        brief="rotates far",
    )
    TIES_GIVE = auto(), Sentence(
        "its ties stretch, and under the motion that they transmit the wall between them rotates far",
        "le catene si allungano, e con il moto che trasmettono la parete fra di esse ruota molto",
        brief="its ties give",
    )
    FRICTION_SHORT = auto(), Sentence(
        "a contact needs more friction than it has while it rocks",
        "un contatto richiede più attrito di quello che ha mentre oscilla",
        brief="a contact slides",
    )
    ANCHOR_GIVES = auto(), Sentence(
        "the course that the anchor of a tie grips slides out before the wall moves as it is followed",
        "il corso afferrato dal capochiave di una catena si sfila prima che la parete si muova come simulato",
        brief="an anchor slides out",
    )

    # What would tell more of a decision.
    TIE_STRENGTH = auto(), Sentence(
        "give the strength at which its ties fail",
        "assegnare la resistenza alla quale le catene cedono",
        brief="give the ties' strength",
    )
    FRICTION = auto(), Sentence(
        "measure the friction of its joints, and give it (friction_coefficient)",
        "misurare l'attrito dei giunti e assegnarlo (friction_coefficient)",
        brief="measure friction",
    )
    ANCHORS = auto(), Sentence(
        "let each anchor grip more of the wall, and say how much (anchor_height_m)",
        "far afferrare al capochiave più muratura, e dichiararla (anchor_height_m)",
        brief="larger anchors",
    )
    INPUT = auto(), Sentence(
        "give a record and settings under which it can be followed",
        "assegnare una registrazione e impostazioni con cui si possa seguire",
        brief="not followed",
    )
    ENSEMBLE = auto(), Sentence(
        "follow an ensemble of members (ensemble: members)",
        "seguire un insieme di simulazioni (ensemble: members)",
        brief="follow an ensemble",
    )
    TOLERANCE = auto(), Sentence(
        "give a restitution below 1, or another tolerance",
        "assegnare un coefficiente di restituzione minore di 1, o un'altra tolleranza",
        brief="give restitution below 1",
    )
    CRACK = auto(), Sentence(
        "find out where it cracks, and state it (crack: known)",
        "accertare dove si lesiona, e dichiararlo (crack: known)",
        brief="find where it cracks",
    )
    RESTITUTION = auto(), Sentence(
        "measure the restitution, or take it from tests of such masonry",
        "misurare il coefficiente di restituzione, o ricavarlo da prove su murature simili",
        brief="measure its restitution",
    )
    PROCESSING = auto(), Sentence(
        "use a processed record of the network instead of the raw one",
        "usare la registrazione elaborata dalla rete invece di quella grezza",
        brief="use a processed record",
    )
    CONTACT_DYNAMICS = auto(), Sentence(
        "follow it by 64 runs of contact dynamics (fidelity: contact)",
        "seguirla con 64 simulazioni della dinamica dei contatti (fidelity: contact)",
        brief="contact dynamics",
    )
    COMPONENT = auto(), Sentence(
        "find the component that gave no result",
        "cercare la componente che non ha dato risultato",
        brief="find missing component",
    )

    # What explains a decision of which nothing more would tell.
    OTHER_PERIODS = auto(), Sentence(
        "at other periods {share} overturn",
        "ad altri periodi ribalta {share}",
        brief="at other T_b {share} fall",
    )
    CONTACT_SLIDES = auto(), Sentence(
        "a contact needs a friction of {lifting:.2g} as it lifts and up to {largest:.2g} as it rocks",
        "un contatto richiede un attrito di {lifting:.2g} al sollevamento e fino a {largest:.2g} mentre "
        "oscilla",
        brief="slides below μ {lifting:.2g}–{largest:.2g}",
    )
    FALLS_AS_RECORDED = auto(), Sentence(
        "as recorded it falls",
        "con la registrazione così com'è ribalta",
        brief="as recorded: falls",
    )
    STANDS_AS_RECORDED = auto(), Sentence(
        "as recorded it stands",
        "con la registrazione così com'è non ribalta",
        brief="as recorded: stands",
    )
    STACKS_FALL = auto(), Sentence(
        "in contact dynamics {falls} of {runs} runs fall",
        "nella dinamica dei contatti ribaltano {falls} simulazioni su {runs}",
        brief="contact dynamics: {falls} of {runs} fall",
    )
    STRENGTHEN = auto(), Sentence("strengthen or tie it", "rinforzarla o trattenerla con catene", brief="strengthen")
    TIE_THE_TOP = auto(), Sentence(
        "tie its top, or say by top_friction what holds it",
        "trattenere la sommità con una catena, o dire con top_friction che cosa la trattiene",
        brief="tie its top",
    )
    NOTHING_DECIDES = auto(), Sentence(
        "no input decides by itself",
        "nessun dato è determinante da solo",
        brief="no input decides",
    )
    NOTHING_TO_DO = auto(), Sentence("nothing needs to be done", "non occorre fare nulla", brief="nothing")

    # A structure, and where it stands.
    HELD_AT_CEILING = auto(), Sentence(
        "{about} of type wall: taken as held at floor and ceiling; a wall that is free at its top, such as a "
        "boundary wall, is a free_wall.",
        "{about} di tipo wall: si assume trattenuta a pavimento e soffitto; una parete libera in sommità, "
        "come un muro di cinta, è una free_wall.",
    )
    VERTICAL_MISSING = auto(), Sentence(
        "The settings ask for the vertical component (vertical: true), but there is none, and none acts.",
        "Le impostazioni richiedono la componente verticale (vertical: true), ma non ve n'è: nessuna agisce.",
    )
    # fmt: on
