"""Remarks: what there is to say of a file, a record, a structure or a case.

A remark is made where the fact is known: its kind, what it is about, and its values. Code compares kinds and reads
values; the words are made where a person reads them, from the one catalogue of sentences that the kinds hold. A new
remark is one line of that catalogue.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum, auto
from string import Formatter
from typing import Any, Literal, get_args

Language = Literal["en", "it"]
"""The languages of the pages to sign; everything else is English."""
Value = str | int | float


class _Commas(Formatter):
    """Formats numbers with a decimal comma."""

    def format_field(self, value: Any, format_spec: str) -> str:
        text = str(super().format_field(value, format_spec))
        return text.replace(".", ",") if isinstance(value, float) else text


def filled(text: str, language: Language, values: Mapping[str, Any]) -> str:
    """Return a text with its values in braces, the numbers as the language writes them."""
    formatter = Formatter() if language == "en" else _Commas()
    return formatter.vformat(text, (), values)


def values_named(text: str) -> set[str]:
    """Return the names of the values that a text holds in braces."""
    return {name for _, name, _, _ in Formatter().parse(text) if name}


@dataclass(frozen=True)
class Sentence:
    """What a kind of remark says, in every language: one field a language, so that none can be left out.

    A sentence names its values in braces, with their format; {about} is what the remark is about. brief: the English
    one in as few words as a line of a table has room for, of a kind that such a table shows.
    Raises ValueError where a text is missing, or names a value that the English one does not have.
    """

    en: str
    it: str
    brief: str = ""

    def __post_init__(self) -> None:
        for language in get_args(Language):
            text = self.text_in(language)
            if not text:
                raise ValueError(f"a sentence has no words in the language {language}.")
            if surplus := values_named(text) - values_named(self.en) - {"about"}:
                raise ValueError(f"{text!r} names {sorted(surplus)}, which {self.en!r} does not.")

    def text_in(self, language: Language) -> str:
        """Return the text of one language, with its values in braces."""
        text: str = getattr(self, language)
        return text


class Kind(StrEnum):
    """Every kind of remark: its code, which tables and results hold, and its sentence in every language.

    The code is the name in small letters.
    """

    said: Sentence
    sentence: str
    """The English sentence."""
    brief: str
    """The same in as few words as a line of a table has room for; the sentence where it is short itself."""
    value_names: tuple[str, ...]
    """The values that the sentence names, in order of the alphabet."""
    names_subject: bool
    """Whether it also names what the remark is about."""

    def __new__(cls, code: str, said: Sentence | None = None) -> "Kind":
        """Make a kind of its code, with what it says beside it. Raises ValueError for one that says nothing."""
        if not isinstance(said, Sentence):
            raise ValueError(f"remark {code} has no Sentence, which holds its words in every language.")
        kind = str.__new__(cls, code)
        kind._value_ = code
        kind.said = said
        kind.sentence = said.en
        kind.brief = said.brief or said.en
        named = values_named(said.en)
        kind.value_names = tuple(sorted(named - {"about"}))
        kind.names_subject = "about" in named
        return kind

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
        "contact dynamics cannot follow it, because it is not a stack of courses",
        "la dinamica dei contatti non può seguirla: non è una pila di corsi",
        brief="not a stack of courses",
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
    CURVE_ALONE = auto(), Sentence(
        "a capacity curve says nothing of impacts, sliding or opening contacts",
        "una curva di capacità non dice nulla di urti, scorrimenti e contatti che si aprono",
        brief="curve alone",
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
    STANDS_AS_VOUSSOIRS = auto(), Sentence(
        "A joint of {about} needs a friction of {needed:.2g} while it rocks; as loose voussoirs on a friction of 0.5 "
        "and more, such arches stood wherever their mechanism does.",
        "Un giunto di {about} richiede un attrito di {needed:.2g} mentre oscilla; come conci sciolti con attrito di "
        "0,5 e oltre, archi simili sono rimasti in piedi ovunque vi resti il loro meccanismo.",
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

    # The samples of a record.
    STEP_UNUSUAL = auto(), Sentence(
        "The time step is {time_step_s:g} s: accelerographs sample strong motion at steps from {shortest_s:g}"
        " to {longest_s:g} s.",
        "Il passo di campionamento è {time_step_s:g} s: gli accelerografi campionano il moto forte a passi da"
        " {shortest_s:g} a {longest_s:g} s.",
    )
    PEAK_IMPOSSIBLE = auto(), Sentence(
        "The peak acceleration is above 5 g, which no recorded ground motion has reached; check the unit and "
        "the factor.",
        "L'accelerazione massima supera 5 g, che nessun moto registrato del suolo ha raggiunto; controllare "
        "l'unità e il fattore.",
    )
    PEAK_RARE = auto(), Sentence(
        "The peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded ground motion is so strong; "
        "check unit and file.",
        "L'accelerazione massima è {peak_g:.3g} g, oltre 3 g: quasi nessun moto registrato del suolo è così "
        "forte; controllare unità e file.",
    )
    VELOCITY_RARE = auto(), Sentence(
        "The peak velocity is {velocity_m_s:.3g} m/s, above {rare_m_s:g} m/s: hardly any recorded ground motion is so "
        "fast; check unit and file.",
        "La velocità massima è {velocity_m_s:.3g} m/s, oltre {rare_m_s:g} m/s: quasi nessun moto registrato del suolo "
        "è così veloce; controllare unità e file.",
    )
    PEAK_RARE_BY_FACTOR = auto(), Sentence(
        "Multiplied by {factor:g} the peak acceleration is {peak_g:.3g} g, above 3 g: hardly any recorded "
        "ground motion is so strong; check the factor.",
        "Moltiplicata per {factor:g}, l'accelerazione massima è {peak_g:.3g} g, oltre 3 g: quasi nessun moto "
        "registrato del suolo è così forte; controllare il fattore.",
    )
    PEAK_TINY = auto(), Sentence(
        "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit.",
        "L'accelerazione massima è {peak_g:.3g} g, sotto 1e-5 g: rumore, o un'unità sbagliata.",
    )
    PEAK_TINY_BY_UNIT = auto(), Sentence(
        "The peak acceleration is {peak_g:.3g} g, below 1e-5 g: noise, or a wrong unit; multiplied {factors} "
        "it would be plausible.",
        "L'accelerazione massima è {peak_g:.3g} g, sotto 1e-5 g: rumore, o un'unità sbagliata; moltiplicata "
        "{factors} sarebbe plausibile.",
    )
    SCALED_FAR = auto(), Sentence(
        "Scaled by {factor:.3g}, beyond a factor of {largest:g}: a record that is really so strong or weak "
        "has another duration and other periods; choose another record.",
        "Scalata di {factor:.3g}, oltre un fattore di {largest:g}: una registrazione davvero così forte o "
        "debole ha un'altra durata e altri periodi; scegliere un'altra registrazione.",
    )
    SAMPLE_ALONE = auto(), Sentence(
        "The sample at {time_s:g} s is {peak_g:.3g} g and stands alone; without it the peak acceleration is "
        "{others_g:.3g} g: a number is damaged, or the instrument was struck.",
        "Il campione a {time_s:g} s vale {peak_g:.3g} g ed è isolato; senza di esso l'accelerazione massima è"
        " {others_g:.3g} g: un numero è danneggiato, o lo strumento è stato urtato.",
    )
    ZEROS_IN_SHAKING = auto(), Sentence(
        "Within the strong shaking {samples} samples in a row are zero: a filled gap?",
        "Nella fase forte {samples} campioni di seguito sono nulli: una lacuna riempita?",
    )
    STILL_STRETCH = auto(), Sentence(
        "From {time_s:g} s on {samples} samples in a row are the same, while those before and after change: a"
        " filled gap?",
        "Da {time_s:g} s in poi {samples} campioni di seguito sono uguali, mentre quelli prima e dopo "
        "cambiano: una lacuna riempita?",
    )
    ROW_REPEATED = auto(), Sentence(
        "At {time_s:g} s all channels repeat the sample before: a row of numbers is repeated.",
        "A {time_s:g} s tutti i canali ripetono il campione precedente: una riga di numeri è ripetuta.",
    )
    HALF_REPEATED = auto(), Sentence(
        "The second half of the samples repeats the first, {samples} numbers: the file may be appended to "
        "itself.",
        "La seconda metà dei campioni ripete la prima, {samples} numeri: il file può essere stato accodato a "
        "se stesso.",
    )
    NEVER_NEGATIVE = auto(), Sentence(
        "No number of {about} is below zero: it is a spectrum, a series of magnitudes, or a record whose "
        "offset was not removed.",
        "Nessun numero di {about} è negativo: è uno spettro, una serie di magnitudo, o una registrazione il "
        "cui scostamento dallo zero non è stato tolto.",
    )
    NUMBER_CUT = auto(), Sentence(
        "The last number has fewer decimals than those above it and no line end: the file may be cut.",
        "L'ultimo numero ha meno decimali di quelli precedenti e manca la fine della riga: il file può essere"
        " troncato.",
    )
    UNEVEN = auto(), Sentence(
        "The {samples} samples are unevenly spaced; interpolated linearly to {number} at their median step, "
        "{time_step_s:g} s.",
        "I {samples} campioni non sono equidistanti; interpolati linearmente a {number} con il loro passo "
        "mediano, {time_step_s:g} s.",
    )
    UNEVEN_FILM = auto(), Sentence(
        "The {samples} samples are unevenly spaced; interpolated linearly to {number}, {time_step_s:g} s "
        "apart.",
        "I {samples} campioni non sono equidistanti; interpolati linearmente a {number}, distanti "
        "{time_step_s:g} s.",
    )
    CUT_TO_THE_SHORTER = auto(), Sentence(
        "The components hold {short} and {long} samples; the longer was cut to the shorter.",
        "Le componenti hanno {short} e {long} campioni; la più lunga è stata tagliata sulla più corta.",
    )
    STILL_RINGING = auto(), Sentence(
        "The support still rings at {share:.1%} of its peak where its motion is cut off, {after_s:.0f} s "
        "after the record.",
        "Il supporto oscilla ancora con {share:.1%} del suo massimo dove il suo moto è tagliato, "
        "{after_s:.0f} s dopo la registrazione.",
    )

    # The header of a record against its samples.
    PEAK_UNLIKE_HEADER = auto(), Sentence(
        "The peak is {peak_m_s2:.6g} m/s², but the header states {stated_m_s2:.6g} m/s², which is more than "
        "rounding: a number or a factor is damaged.",
        "Il massimo è {peak_m_s2:.6g} m/s², ma l'intestazione dichiara {stated_m_s2:.6g} m/s², più di un "
        "arrotondamento: un numero o un fattore è danneggiato.",
    )
    PEAK_ELSEWHERE = auto(), Sentence(
        "The header puts the peak at {stated_s:g} s, but it occurs at {time_s:g} s: lines may be missing, "
        "repeated or out of order before it, or the time step differs.",
        "L'intestazione pone il massimo a {stated_s:g} s, ma si trova a {time_s:g} s: prima di esso possono "
        "mancare righe, o essere ripetute o fuori ordine, oppure il passo è diverso.",
    )
    MEAN_SQUARE_UNLIKE_HEADER = auto(), Sentence(
        "The root mean square of the samples is {value:.6g} {unit}, but the header states {stated:.6g} "
        "{unit}: numbers are damaged, missing or repeated, or a factor is wrong.",
        "Il valore quadratico medio dei campioni è {value:.6g} {unit}, ma l'intestazione dichiara "
        "{stated:.6g} {unit}: numeri danneggiati, mancanti o ripetuti, o un fattore sbagliato.",
    )
    VELOCITY_UNLIKE_THERE = auto(), Sentence(
        "Around {time_s:g} s the file's own velocity is not the integral of its acceleration: numbers of one "
        "of them are damaged there.",
        "Intorno a {time_s:g} s la velocità del file non è l'integrale della sua accelerazione: là i numeri "
        "di una delle due sono danneggiati.",
    )
    VELOCITY_UNLIKE = auto(), Sentence(
        "The file's own velocity is not the integral of its acceleration: it is damaged.",
        "La velocità del file non è l'integrale della sua accelerazione: è danneggiata.",
    )
    SAMPLES_SURPLUS = auto(), Sentence(
        "The header declares {declared} samples; the file holds {held}, and all are kept.",
        "L'intestazione dichiara {declared} campioni; il file ne contiene {held}, e tutti sono conservati.",
    )
    LINE_SURPLUS = auto(), Sentence(
        "The header declares {declared} samples; the 1 surplus line repeats the end and is left out.",
        "L'intestazione dichiara {declared} campioni; la riga in eccesso ripete la fine ed è tralasciata.",
    )
    LINES_SURPLUS = auto(), Sentence(
        "The header declares {declared} samples; the {lines} surplus lines repeat the end and are left out.",
        "L'intestazione dichiara {declared} campioni; le {lines} righe in eccesso ripetono la fine e sono "
        "tralasciate.",
    )
    SEAM_CUT = auto(), Sentence(
        "The header declares {declared} numbers or points: those after a seam in the file, which belong to "
        "another trace, are left out.",
        "L'intestazione dichiara {declared} numeri o punti: quelli dopo una giunzione del file, che "
        "appartengono a un'altra traccia, sono tralasciati.",
    )
    CHANNELS_UNLIKE_HEADER = auto(), Sentence(
        "The header announces {announced:g} channels, but the file holds {held}.",
        "L'intestazione annuncia {announced:g} canali, ma il file ne contiene {held}.",
    )
    CHANNELS_OF_GEONET = auto(), Sentence(
        "A GeoNet file holds 3 components, but this one holds {held}.",
        "Un file GeoNet contiene 3 componenti, ma questo ne contiene {held}.",
    )
    LENGTH_UNLIKE_HEADER = auto(), Sentence(
        "The header gives the series a length of {stated_s:g} s, but its samples last {lasts_s:g} s.",
        "L'intestazione dà alla serie una durata di {stated_s:g} s, ma i suoi campioni durano {lasts_s:g} s.",
    )
    RATE_NO_NUMBER = auto(), Sentence(
        "The header gives a rate of {rate!r}, which is not a number: the file may be damaged.",
        "L'intestazione dà una frequenza di {rate!r}, che non è un numero: il file può essere danneggiato.",
    )
    RATE_UNLIKE_STEP = auto(), Sentence(
        "The header gives a rate of {rate_hz:g} Hz, but duration and sample count give a step of "
        "{time_step_s:g} s.",
        "L'intestazione dà una frequenza di {rate_hz:g} Hz, ma durata e numero di campioni danno un passo di "
        "{time_step_s:g} s.",
    )
    MATCHED_TO_SPECTRUM = auto(), Sentence(
        "The header says that the record is matched to a spectrum: artificial, not a recorded motion.",
        "L'intestazione dice che la registrazione è adattata a uno spettro: artificiale, non un moto "
        "registrato.",
    )
    SCALE_APPLIED = auto(), Sentence(
        "Samples multiplied by the SCALE that the header states, {factor:g}.",
        "Campioni moltiplicati per lo SCALE che l'intestazione dichiara, {factor:g}.",
    )
    CALIBRATION_NOT_APPLIED = auto(), Sentence(
        "The header states a calibration of {factor:g}, which in this format converts to displacement: the "
        "samples are taken as they are, in the unit that is declared.",
        "L'intestazione dichiara una calibrazione di {factor:g}, che in questo formato converte in "
        "spostamento: i campioni sono presi come sono, nell'unità dichiarata.",
    )
    FACTOR_NOT_APPLIED = auto(), Sentence(
        "The text above the numbers mentions a factor or counts ({text}): no factor is applied, and the "
        "numbers are read as they are.",
        "Il testo sopra i numeri nomina un fattore o dei conteggi ({text}): nessun fattore è applicato, e i "
        "numeri sono letti come sono.",
    )
    SENSITIVITY_ELSEWHERE = auto(), Sentence(
        "The overall sensitivity of {about} is stated at {at_hz:g} Hz and differs by {off:.0%} from the "
        "product of its stages at other frequencies: the sensitivity was used.",
        "La sensibilità complessiva di {about} è dichiarata a {at_hz:g} Hz e differisce di {off:.0%} dal "
        "prodotto dei suoi stadi ad altre frequenze: è stata usata la sensibilità.",
    )
    SENSITIVITY_UNLIKE_STAGES = auto(), Sentence(
        "The overall sensitivity of {about} is more than 5 % off what the stages of its response give at the "
        "frequency it is stated for; the stages were used: ask the network which of the two is valid.",
        "La sensibilità complessiva di {about} dista più del 5 % da ciò che danno gli stadi della sua "
        "risposta alla frequenza per cui è dichiarata; sono stati usati gli stadi: chiedere alla rete quale "
        "dei due è valido.",
    )
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
    PULSE_BESIDE_GAP = auto(), Sentence(
        "The record holds a run of identical samples longer than a second, which may be a gap that was "
        "filled.",
        "La registrazione contiene una serie di campioni uguali più lunga di un secondo, che può essere una "
        "lacuna riempita.",
    )

    # An integration.
    WEIGHTLESS = auto(), Sentence(
        "for an instant the ground falls faster than gravity, so that bodies would lose contact; the model "
        "keeps them on the ground.",
        "per un istante il suolo cade più velocemente della gravità, e i corpi perderebbero contatto; il "
        "modello li tiene a terra.",
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
    HELD_AT_CEILING = auto(), Sentence(
        "{about} of type wall: taken as held at floor and ceiling; a wall that is free at its top, such as a "
        "boundary wall, is a free_wall.",
        "{about} di tipo wall: si assume trattenuta a pavimento e soffitto; una parete libera in sommità, "
        "come un muro di cinta, è una free_wall.",
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
    REMARKS_MORE = auto(), Sentence(
        "{number} more remarks on the study stand in summary/remarks.csv.",
        "altre {number} osservazioni sullo studio stanno in summary/remarks.csv.",
    )
    VERTICAL_MISSING = auto(), Sentence(
        "The settings ask for the vertical component (vertical: true), but there is none, and none acts.",
        "Le impostazioni richiedono la componente verticale (vertical: true), ma non ve n'è: nessuna agisce.",
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
    HEAVY_ON_SUPPORT = auto(), Sentence(
        "{about} has {ratio:.2g} of the mass of {support}: beyond {limit:g} its reaction on the support "
        "changes rotations by more than one per cent, at 0.1 by 11 % in the median, and is left out here.",
        "{about} ha {ratio:.2g} della massa di {support}: oltre {limit:g} la sua reazione sul supporto cambia"
        " le rotazioni di più dell'uno per cento, a 0,1 dell'11 % in mediana, e qui è trascurata.",
    )
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
        "by friction (0.6 of what lies above it and of a course of 0.2 m): the course that the anchor grips may slide "
        "out; spread the anchor over several courses.",
        "La catena a {height_m:.4g} m può ricevere {most_kN_m:.3g} kN/m, ma la parete attorno all'ancoraggio dà "
        "{grip_kN_m:.3g} kN/m per attrito (0,6 di ciò che sta sopra e di un corso di 0,2 m): il corso afferrato può "
        "sfilarsi; va distribuito l'ancoraggio su più corsi.",
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
    FAULT = auto(), Sentence(
        "a fault of rocking in what it computes or draws of {about} ({said}); please report it, with {log}.",
        "un errore di rocking in ciò che calcola o disegna di {about} ({said}); si prega di segnalarlo, con {log}.",
    )
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
    # What was read of a file, and what was not.
    FIRST_NUMBERS = auto(), Sentence(
        "The first of the numbers are not samples but {what}.",
        "I primi numeri non sono campioni ma {what}.",
    )
    UNLIKE_ITS_ANSWER = auto(), Sentence(
        "It is read as {answer!r}, as layouts.csv says, but looks different ({holds}): check whether it is "
        "like the other files of its folder.",
        "È letto come {answer!r}, come dice layouts.csv, ma ha un altro aspetto ({holds}): controllare che "
        "sia come gli altri file della sua cartella.",
    )
    TAIL_PASSED_OVER = auto(), Sentence(
        "Text below the numbers is passed over: {text!r}.",
        "Il testo sotto i numeri è tralasciato: {text!r}.",
    )
    ROW_FILLED_UP = auto(), Sentence(
        "The last row is filled up with NaN, which are left out.",
        "L'ultima riga è completata con NaN, che sono tralasciati.",
    )
    LINE_ENDS_DOUBLED = auto(), Sentence(
        "The line ends are doubled (CR CR LF) by a faulty conversion; the numbers are unharmed.",
        "Le fini di riga sono raddoppiate (CR CR LF) da una conversione difettosa; i numeri sono intatti.",
    )
    FILES_NOT_READ = auto(), Sentence(
        "Of the archive these files were not read: {names}.",
        "Di questo archivio non sono stati letti i file: {names}.",
    )
    MORE_FILES_NOT_READ = auto(), Sentence(
        "Of the archive these files were not read: {names} and {more} more.",
        "Di questo archivio non sono stati letti i file: {names} e altri {more}.",
    )
    BLOCKS_OVERLAP = auto(), Sentence(
        "Blocks of {about} overlap by {overlap_s:g} s at {time}: repeated or overwritten.",
        "I blocchi di {about} si sovrappongono di {overlap_s:g} s a {time}: ripetuti o sovrascritti.",
    )
    BLOCKS_LEAP = auto(), Sentence(
        "Block number {after} follows number {before}: blocks are missing, repeated or overwritten.",
        "Il blocco numero {after} segue il numero {before}: mancano blocchi, o sono ripetuti o sovrascritti.",
    )
    FAILED_IN_GMPROCESS = auto(), Sentence(
        "gmprocess rejects this record: {reason}; check whether it can be used.",
        "gmprocess scarta questa registrazione: {reason}; verificare se è utilizzabile.",
    )
    TOLD_BY_OBSPY = auto(), Sentence("obspy: {text}.", "obspy: {text}.")

    # Where a component points, and where its instrument stood.
    DIRECTION_UNKNOWN = auto(), Sentence(
        "The direction of the component {about} is unknown: its name is neither a direction nor an angle, and"
        " it is taken as horizontal; leave it out in the catalogue if it is not.",
        "La direzione della componente {about} non è nota: il suo nome non è né una direzione né un angolo, e"
        " la si assume orizzontale; escluderla dal catalogo se non lo è.",
    )
    DIRECTION_CONTRADICTED = auto(), Sentence(
        "The header of {about} gives the direction {direction}, which the channel code contradicts; the "
        "header is followed: check which of the two is right, and name the horizontal ones in the column "
        "component.",
        "L'intestazione di {about} dà la direzione {direction}, che il codice del canale contraddice; si "
        "segue l'intestazione: controllare quale dei due è giusto, e nominare le componenti orizzontali nella"
        " colonna component.",
    )
    SOME_MAY_BE_VERTICAL = auto(), Sentence(
        "Of the {channels} channels {names} may be vertical, because nothing says which one is: name the "
        "horizontal ones in the column component of the catalogue, or as --component.",
        "Dei {channels} canali {names} possono essere verticali, perché nulla dice quale lo sia: nominare gli"
        " orizzontali nella colonna component del catalogo, o come --component.",
    )
    LONE_MAY_BE_VERTICAL = auto(), Sentence(
        "The direction of the component {about} is unknown, because its name is neither a direction nor an "
        "angle, and it may be vertical: if it is horizontal, name it in the column component of the "
        "catalogue, or as --component.",
        "La direzione della componente {about} non è nota, perché il suo nome non è né una direzione né un "
        "angolo, e può essere verticale: se è orizzontale, nominarla nella colonna component del catalogo, o "
        "come --component.",
    )
    VERTICAL_BY_NAME = auto(), Sentence(
        "Only the name of the file says that the motion is vertical ({word}): if it is horizontal, name it in"
        " the column component of the catalogue, or as --component.",
        "Solo il nome del file dice che il moto è verticale ({word}): se è orizzontale, nominarlo nella "
        "colonna component del catalogo, o come --component.",
    )
    VERTICAL_AS_HORIZONTAL = auto(), Sentence(
        "Component {about} is vertical, but the catalogue takes it as horizontal.",
        "La componente {about} è verticale, ma il catalogo la prende come orizzontale.",
    )
    ANGLE_UNKNOWN = auto(), Sentence(
        "The angle between components {first} and {second} is not known: they are taken to be at right "
        "angles.",
        "L'angolo fra le componenti {first} e {second} non è noto: si assume retto.",
    )
    DOWN_HOLE = auto(), Sentence(
        "The instrument stood down-hole ({place}): this is not the motion of the surface.",
        "Lo strumento stava in pozzo ({place}): non è il moto della superficie.",
    )
    IN_A_STRUCTURE = auto(), Sentence(
        "The instrument stood in a structure ({place}): its motion may not be that of the ground.",
        "Lo strumento stava in una costruzione ({place}): il suo moto può non essere quello del suolo.",
    )
    CHANNEL_NO_MOTION = auto(), Sentence(
        "The channel code {about} is that of a {sensor}: leave the channel out.",
        "Il codice di canale {about} è quello di un {sensor}: escludere il canale.",
    )
    CHANNEL_OF_VELOCITY = auto(), Sentence(
        "The channel code {about} is that of a {sensor}, which measures velocity and clips in strong motion; "
        "an accelerometer has N in second place.",
        "Il codice di canale {about} è quello di un {sensor}, che misura la velocità e va in saturazione nel "
        "moto forte; un accelerometro ha N al secondo posto.",
    )

    # The files of a folder, each beside the others.
    COUNTS_WITHOUT_UNIT = auto(), Sentence(
        "Without a unit its samples are taken as counts of the recorder: put the StationXML of the station "
        "beside it, or name it in the column inventory.",
        "Senza unità i suoi campioni sono presi come conteggi del registratore: porvi accanto lo StationXML "
        "della stazione, o nominarlo nella colonna inventory.",
    )
    VERTICAL_IN_NAME = auto(), Sentence(
        "The file's name says {word}, but {about} is taken as horizontal.",
        "Il nome del file dice {word}, ma {about} è presa come orizzontale.",
    )
    STATIONS_UNLIKE = auto(), Sentence(
        "The stream holds channels of {number} stations ({stations}): they are not a record of one place; "
        "read each station separately.",
        "Il flusso contiene canali di {number} stazioni ({stations}): non sono la registrazione di un solo "
        "luogo; leggere ogni stazione separatamente.",
    )
    STEPS_OF_STREAM_UNLIKE = auto(), Sentence(
        "The channels of the stream have time steps from {least_s:g} to {most_s:g} s: resample them before "
        "they are used together.",
        "I canali del flusso hanno passi da {least_s:g} a {most_s:g} s: ricampionarli prima di usarli "
        "insieme.",
    )
    TILTED = auto(), Sentence(
        "The sensor {about} dips {dip_deg:g}°, neither level nor upright: its motion is taken along the "
        "nearer of the two.",
        "Il sensore {about} è inclinato di {dip_deg:g}°, né orizzontale né verticale: il suo moto è preso "
        "lungo la più vicina delle due direzioni.",
    )
    CONTENT_REPEATED = auto(), Sentence(
        "Its content is that of {original}: listed as two records it would count twice.",
        "Il suo contenuto è quello di {original}: elencato come due registrazioni conterebbe due volte.",
    )
    NOT_SQUARE = auto(), Sentence(
        "Components {first} and {second} are {angle_deg:g}° apart, not at right angles.",
        "Le componenti {first} e {second} formano un angolo di {angle_deg:g}°, non retto.",
    )
    COMPONENT_TWICE = auto(), Sentence(
        "component {about} occurs {times} times",
        "la componente {about} compare {times} volte",
    )
    STEPS_UNLIKE = auto(), Sentence(
        "their time steps are {least_s:g} and {most_s:g} s",
        "i loro passi sono {least_s:g} e {most_s:g} s",
    )
    BEGINNINGS_UNKNOWN = auto(), Sentence(
        "they hold {least} and {most} samples and do not all say when they begin",
        "contengono {least} e {most} campioni e non tutti dicono quando iniziano",
    )
    COMPONENT_NOT_NAMED = auto(), Sentence(
        "{about} does not name its component",
        "{about} non nomina la sua componente",
    )
    TOO_MANY_COMPONENTS = auto(), Sentence(
        "it has {horizontal} horizontal and {vertical} vertical components",
        "ha {horizontal} componenti orizzontali e {vertical} verticali",
    )
    POINT_THE_SAME_WAY = auto(), Sentence(
        "components {first} and {second} point the same way",
        "le componenti {first} e {second} hanno la stessa direzione",
    )
    NOT_SQUARE_BY_NAME = auto(), Sentence(
        "components {first} and {second}, as the files' names end, are not at right angles",
        "le componenti {first} e {second}, come terminano i nomi dei file, non sono ad angolo retto",
    )
    DECLARED_BY_SOME = auto(), Sentence(
        "not all of them declare unit and time step",
        "non tutti dichiarano unità e passo",
    )

    # Which earthquakes the records of a figure are of.
    EARTHQUAKES_UNNAMED = auto(), Sentence(
        "{records} of {all} records name no earthquake, and count as of one: name it in the column event of the "
        "catalogue, or declare each of them an earthquake of its own (unnamed_events: each).",
        "{records} registrazioni su {all} non indicano il terremoto e contano come di uno solo: indicarlo nella "
        "colonna event del catalogo, o dichiarare ciascuna di un terremoto proprio (unnamed_events: each).",
    )
    EARTHQUAKE_ONE = auto(), Sentence(
        "All {stations} stations are of one earthquake, which tells nothing of another: there is no interval.",
        "Tutte le {stations} stazioni sono di un solo terremoto, che nulla dice di un altro: non c'è intervallo.",
    )
    EARTHQUAKES_FEW = auto(), Sentence(
        "With {earthquakes} earthquakes, fewer than {fewest}, nothing is resampled: intervals are those of Student, "
        "or of Clopper and Pearson, on the earthquakes, and that of a median holds less often than nine times in ten.",
        "Con {earthquakes} terremoti, meno di {fewest}, nulla è ricampionato: gli intervalli sono quelli di Student, "
        "o di Clopper e Pearson, sui terremoti, e quello di una mediana vale meno di nove volte su dieci.",
    )
    EARTHQUAKE_NAMED_TWICE = auto(), Sentence(
        "One motion is listed under two earthquakes, {first} and {second}: name it once, or leave one record out.",
        "Un moto è elencato con due terremoti, {first} e {second}: indicarne uno, o togliere una registrazione.",
    )
    STATION_OF_TWO_EARTHQUAKES = auto(), Sentence(
        "Station {about} is given for two earthquakes, {first} and {second}, and counts for the first: give each its "
        "own name in each earthquake.",
        "La stazione {about} è data per due terremoti, {first} e {second}, e conta per il primo: darle un nome "
        "proprio in ciascun terremoto.",
    )

    # A catalogue and its folder, and a study before its run.
    FILE_RENAMED = auto(), Sentence(
        "{about}: the file {before} is now {now}, by its content; the row names it.",
        "{about}: il file {before} è ora {now}, secondo il suo contenuto; la riga lo nomina.",
    )
    FILE_APART = auto(), Sentence("{about}: {why}", "{about}, a parte: {why}")
    FILE_WITHOUT_RECORD = auto(), Sentence("{about} is not used: {why}", "{about} non è usato: {why}")
    SIBLING_NOT_USED = auto(), Sentence(
        "{other}, beside {about}, is a component of the same station and is not used: give it too.",
        "{other}, accanto a {about}, è una componente della stessa stazione e non è usato: indicarlo anch'esso.",
    )
    ROWS_TO_JOIN = auto(), Sentence(
        "{files} are components of one station: name them all in the row {rows} to join them.",
        "{files} sono componenti di una stessa stazione: nominarle tutte nella riga {rows} per unirle.",
    )
    ANSWER_IDLE = auto(), Sentence(
        "{about}, line {line}: the answer {answer!r} fits no file that lies here; remove the line.",
        "{about}, riga {line}: la risposta {answer!r} non vale per alcun file presente; togliere la riga.",
    )
    READINGS_UNUSABLE = auto(), Sentence(
        "{about}: {why}; every file is read again.",
        "{about}: {why}; ogni file è letto di nuovo.",
    )
    RECORD_REPEATED = auto(), Sentence(
        "{about} ({file}): its content is that of {other} ({other_file}), so that one motion counts twice; "
        "leave one of them out.",
        "{about} ({file}): il suo contenuto è quello di {other} ({other_file}), per cui un solo moto conta "
        "due volte; escluderne uno.",
    )
    FILE_UNLISTED = auto(), Sentence(
        "{about} is not in the catalogue; rocking catalogue {folder} adds what is new.",
        "{about} non è nel catalogo; rocking catalogue {folder} aggiunge ciò che è nuovo.",
    )
    FILES_UNLISTED = auto(), Sentence(
        "{files} files are not in the catalogue; rocking catalogue {folder} adds what is new.",
        "{files} file non sono nel catalogo; rocking catalogue {folder} aggiunge ciò che è nuovo.",
    )
    OTHER_VERSION = auto(), Sentence(
        "The results are of another version of rocking; they are recomputed.",
        "I risultati sono di un'altra versione di rocking; sono ricalcolati.",
    )
    OUTDATED = auto(), Sentence(
        "{about}: {why}, so that the summary leaves it out and its files go; measure it again: "
        "rocking run . {about}.",
        "{about}: {why}, per cui il riepilogo lo omette e i suoi file sono rimossi; per ricalcolarlo: "
        "rocking run . {about}.",
    )
    # fmt: on


@dataclass(frozen=True)
class Remark:
    """One thing to say: its kind, what it is about, and its values by name, in SI units unless their names say else.

    Parameters
    ----------
    kind : Kind
        What is said.
    about : str, default ''
        The file, record or structure that it is about.
    values : tuple of tuple of (str, str, int or float), optional
        Values by name, in the order of `Kind.value_names`.

    Raises
    ------
    ValueError
        For an unknown kind, and where the values are not those that its sentence names.

    Examples
    --------
    >>> from rocking.remarks import Kind
    >>> str(rocking.Remark(Kind.CONTACTS_OPEN))
    'contacts open'
    """

    kind: Kind
    about: str = ""
    values: tuple[tuple[str, Value], ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.kind, Kind):
            raise ValueError(f"remark {self.kind!r} is of no kind of the catalogue.")
        given = [name for name, _ in self.values]
        if given != list(self.kind.value_names):
            raise ValueError(
                f"remark {self.kind}: values {given}, but must be {list(self.kind.value_names)}."
            )
        for name, value in self.values:
            if not isinstance(value, Value):
                raise ValueError(f"remark {self.kind}: {name} is {value!r}, but must be a text or a number.")

    @classmethod
    def of(cls, kind: Kind, about: str = "", **values: Value) -> "Remark":
        """Return the remark of `kind` about a file, a record or a structure, with its values by name."""
        return cls(kind, about, tuple(sorted(values.items())))

    def __getitem__(self, name: str) -> Value:
        """Return one of the values. Raises KeyError for a name that the sentence does not have."""
        return dict(self.values)[name]

    def __str__(self) -> str:
        """The remark in English; what it is about stands before a sentence that does not name it."""
        words = self.sentence_in("en")
        return f"{self.about}: {words}" if self.about and not self.kind.names_subject else words

    def sentence_in(self, language: Language) -> str:
        """Return the sentence alone in one language."""
        text = self.kind.said.text_in(language)
        return filled(text, language, {**dict(self.values), "about": self.about})

    @property
    def brief(self) -> str:
        """The remark in as few words as a line of a table has room for."""
        return self.kind.brief.format(about=self.about, **dict(self.values))
