"""The kinds of remarks on a structure, with the sentence of each in every language."""

from enum import auto

from rocking.remarks import Kind, Sentence


class StructureKind(Kind):
    """A kind of remark on a structure."""

    # fmt: off
    # What a model leaves out.
    CURVE_ALONE = auto(), Sentence(
        "A capacity curve says nothing of impacts, sliding or opening contacts.",
        "Una curva di capacità non dice nulla di urti, scorrimenti e contatti che si aprono.",
    )
    FRAME_CONTACTS = auto(), Sentence(
        "The contact forces of a frame are indeterminate: no verdict says whether its contacts slide as it rocks.",
        "Le forze di contatto di un telaio sono indeterminate: nessun esito dice se i contatti scorrono mentre "
        "oscilla.",
    )

    # A structure, and where it stands.
    SIZE_UNUSUAL = auto(), Sentence(
        "{about} is {value:.6g}{unit}, but is usually between {low:g} and {high:g}{unit} for {type}; check "
        "the unit.",
        "{about} vale {value:.6g}{unit}, ma di solito sta fra {low:g} e {high:g}{unit}; controllare l'unità.",
    )
    BROADER_THAN_TALL = auto(), Sentence(
        "{about} is {across_m:.6g} m and {height} {height_m:.6g} m: a body this broad slides before it rocks;"
        " check which is which.",
        "{about} vale {across_m:.6g} m e {height} {height_m:.6g} m: un corpo così largo scorre prima di "
        "oscillare; controllare quale sia quale.",
    )
    LEVELS_TYPED = auto(), Sentence(
        "{about} is {typed} m, each about a storey more than the one before: if these are levels above the ground, "
        "give the height of each storey; as they stand they make {total_m:.6g} m.",
        "{about} vale {typed} m, ciascuno circa un piano più del precedente: se sono quote dal suolo, assegnare "
        "l'altezza di ogni piano; così sommano a {total_m:.6g} m.",
    )
    ONE_LEAF = auto(), Sentence(
        "Taken as one leaf of {thickness} m; give leaves_m where leaves may part.",
        "Si assume un solo paramento di {thickness} m: se i paramenti possono separarsi, assegnarne gli spessori "
        "(leaves_m).",
    )
    TIES_ALL_ALONG = auto(), Sentence(
        "Its ties are taken to hold it all along: give their tie_spacing and the unit_length of the masonry, or "
        "held_between: floor where a stiff floor or a ring beam holds it between them.",
        "Si assume che le catene trattengano la parete per tutta la lunghezza: vanno assegnati l'interasse "
        "(tie_spacing) e la lunghezza dei blocchi (unit_length), oppure held_between: floor se un solaio rigido o un "
        "cordolo la trattiene fra di esse.",
    )
    RODS_SPREAD = auto(), Sentence(
        "Rods of {diameter_mm:g} mm, {length_m:g} m long, every {spacing_m:g} m are spread over the metre: "
        "E A/(L s) = {stiffness_kN_m2:.4g} kN/m per m, f_y A/s = {strength_kN_m:.4g} kN/m.",
        "Le catene da {diameter_mm:g} mm, lunghe {length_m:g} m e poste ogni {spacing_m:g} m, sono ripartite al metro: "
        "E A/(L s) = {stiffness_kN_m2:.4g} kN/m per m, f_y A/s = {strength_kN_m:.4g} kN/m.",
    )
    FLOORS_BEHIND = auto(), Sentence(
        "It rocks inwards as freely as outwards, although the floors that it carries or is tied to are behind"
        " it; behind: floors or cross_walls, with the restitution of its impact on them, prevents this. "
        "Neither is always on the safe side, so assess both.",
        "Oscilla verso l'interno liberamente come verso l'esterno, benché i solai che porta o a cui è legata "
        "le stiano a tergo; behind: floors o cross_walls, con la restituzione del suo urto su di essi, lo "
        "impedisce. Nessuna delle due ipotesi è sempre a favore di sicurezza: valutarle entrambe.",
    )
    RESTITUTION_TYPED = auto(), Sentence(
        "The restitution of {typed:.2g} is typed, while the balance of momentum of the geometry gives "
        "{own:.2g}, with which less energy is lost: both are followed, and where their verdicts differ the "
        "share is a range.",
        "È assegnata la restituzione {typed:.2g}, mentre il bilancio della quantità di moto della geometria "
        "dà {own:.2g}, con cui si perde meno energia: si seguono entrambe, e dove gli esiti differiscono la "
        "percentuale è un intervallo.",
        brief="{about}: restitution {typed:.2g} typed, {own:.2g} by geometry",
    )
    RESTITUTION_ABOVE = auto(), Sentence(
        "The restitution of {typed:.2g} is typed, above the {own:.2g} that the balance of momentum gives for "
        "rigid bodies of this geometry: it rocks longer than they would; check it, or leave it out.",
        "È assegnata la restituzione {typed:.2g}, superiore al valore {own:.2g} che il bilancio della "
        "quantità di moto dà per corpi rigidi di questa geometria: oscilla più a lungo di quanto farebbero; "
        "controllarla, o tralasciarla.",
    )

    # A crack that a survey found.
    CRACK_KNOWN = auto(), Sentence("crack known (survey)", "posizione della lesione nota (da rilievo)")
    CRACK_KNOWN_AT = auto(), Sentence(
        "crack known at {height_m:.6g} m (survey)",
        "lesione nota a {height_m:.6g} m (da rilievo)",
        brief="crack known at {height_m:.6g} m",
    )

    # What holds a wall sideways. In motion: the largest forces of ties in 65 walls (theory: what the hold needs).
    TIE_MUST_BEAR = auto(), Sentence(
        "The tie at {height_m:.4g} m has no strength (tie_strength) and is assumed to hold: when the wall "
        "{about} it carries {needed_kN_m:.3g} kN/m statically, and in motion, with the impacts of the wall, "
        "about 2.8 times that (1.9 to 4.8 in eight of ten walls); give its strength.",
        "La catena a {height_m:.4g} m non ha una resistenza assegnata e si assume che tenga: all'attivazione "
        "del meccanismo che trattiene deve sopportare {needed_kN_m:.3g} kN/m, e nel moto, con gli urti della "
        "parete, circa 2,8 volte tanto (da 1,9 a 4,8 in otto pareti su dieci); va assegnata.",
    )
    TIE_BEARS = auto(), Sentence(
        "The tie at {height_m:.4g} m fails at {gives_kN_m:.3g} kN/m and carries {needed_kN_m:.3g} kN/m "
        "statically when the wall {about}; in motion, with the impacts of the wall, ties carried about 2.8 "
        "times the static force (1.9 to 4.8 in eight of ten walls).",
        "La catena a {height_m:.4g} m cede a {gives_kN_m:.3g} kN/m e all'attivazione del meccanismo che "
        "trattiene sopporta {needed_kN_m:.3g} kN/m; nel moto, con gli urti della parete, circa 2,8 volte "
        "tanto (da 1,9 a 4,8 in otto pareti su dieci).",
    )
    ANCHOR_SLIDES = auto(), Sentence(
        "The tie at {height_m:.4g} m may get {most_kN_m:.3g} kN/m, but the wall around it gives {grip_kN_m:.3g} kN/m "
        "by friction (0.6 of what lies above it and of what the anchor grips, anchor_height_m): that may slide out; "
        "spread the anchor over several courses.",
        "La catena a {height_m:.4g} m può ricevere {most_kN_m:.3g} kN/m, ma la parete attorno all'ancoraggio dà "
        "{grip_kN_m:.3g} kN/m per attrito (0,6 di ciò che sta sopra e di ciò che il capochiave afferra, "
        "anchor_height_m): questo può sfilarsi; va distribuito l'ancoraggio su più corsi.",
    )
    TIE_YIELDS = auto(), Sentence(
        "The tie at {height_m:.4g} m fails at {gives_kN_m:.3g} kN/m, before the wall {about}, for which it "
        "would have to carry {needed_kN_m:.3g} kN/m.",
        "La catena a {height_m:.4g} m cede a {gives_kN_m:.3g} kN/m, prima del meccanismo che tratterrebbe, "
        "per cui dovrebbe sopportare {needed_kN_m:.3g} kN/m.",
    )
    TOP_HOLDS = auto(), Sentence(
        "The top at {height_m:.4g} m needs {needed_kN_m:.3g} kN/m statically when the wall {about}; friction "
        "of {friction:.2g} under what lies on it, and ties there, provide {gives_kN_m:.3g} kN/m. In motion, "
        "with the impacts of the wall, it needs about 2.8 times the static force (1.9 to 4.8 in eight of ten "
        "walls).",
        "La sommità a {height_m:.4g} m richiede {needed_kN_m:.3g} kN/m all'attivazione; l'attrito "
        "{friction:.2g} sotto ciò che porta e le catene danno {gives_kN_m:.3g} kN/m. Richiede nel moto, con "
        "gli urti della parete, circa 2,8 volte tanto (da 1,9 a 4,8 in otto pareti su dieci).",
    )
    TOP_SLIPS = auto(), Sentence(
        "The top at {height_m:.4g} m slips: when the wall {about} it needs {needed_kN_m:.3g} kN/m, and "
        "friction of {friction:.2g} under what lies on it, and ties there, provide {gives_kN_m:.3g} kN/m, so "
        "the wall is computed as one that slips there; ties of {tie_kN_m:.3g} kN/m at the top (tie_heights) "
        "hold it statically, and in motion it needs about 2.8 times that force.",
        "La sommità a {height_m:.4g} m scorre: richiede {needed_kN_m:.3g} kN/m, e l'attrito {friction:.2g} "
        "sotto ciò che porta e le catene danno {gives_kN_m:.3g} kN/m; si segue la parete che scorre in "
        "sommità. Catene in sommità da {tie_kN_m:.3g} kN/m la trattengono all'attivazione; nel moto servono "
        "circa 2,8 volte la forza richiesta.",
        brief="its top slips: it needs {needed_kN_m:.3g} kN/m, friction and ties provide {gives_kN_m:.3g}",
    )
    TOP_MUST_BE_HELD = auto(), Sentence(
        "The top at {height_m:.4g} m is assumed to be held: when the wall {about} it needs {needed_kN_m:.3g} "
        "kN/m statically, and in motion, with the impacts of the wall, about 2.8 times that (1.9 to 4.8 in "
        "eight of ten walls).",
        "La sommità a {height_m:.4g} m si assume trattenuta: richiede {needed_kN_m:.3g} kN/m all'attivazione,"
        " e nel moto, con gli urti della parete, circa 2,8 volte tanto (da 1,9 a 4,8 in otto pareti su "
        "dieci).",
    )
    TOP_TAKEN_AS_HELD = auto(), Sentence(
        "The top is assumed to be held: when the wall {about} it needs {share:.2g} of the weight of the wall "
        "statically, and about 2.8 times that in motion, but no load on it is given, so no friction holds it.",
        "La sommità si assume trattenuta: richiede {share:.2g} del peso della parete all'attivazione, e circa"
        " 2,8 volte tanto nel moto, benché non sia assegnato nulla che vi prema, per cui nessun attrito la "
        "trattiene.",
    )

    # Why something could not be computed or drawn.
    CURVE_HAS_NO_GEOMETRY = auto(), Sentence(
        "a capacity curve has no geometry of which a static check could take masses and displacements; check it in the "
        "program that it comes from.",
        "una curva di capacità non ha una geometria da cui un'analisi statica possa ricavare masse e spostamenti; "
        "verificarla nel programma da cui proviene.",
    )
    FALLS_AT_REST = auto(), Sentence(
        "the structure does not stand: what acts on it at rest turns it over.",
        "la struttura non sta in equilibrio: ciò che agisce su di essa a riposo la ribalta.",
    )
    # fmt: on
