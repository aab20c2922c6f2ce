"""Claims: what the words about numbers say of them, each with its place, and what holds where several speak.

Heads, names of columns and files, StationXML, answers and typed options say the same few things in many languages. One
vocabulary reads them all; `agreed` returns what holds, or asks, naming the two that differ.
"""

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache
from typing import Any, Literal

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import NUMBER, SECONDS, acceleration_factor, acceleration_unit
from rocking.records.direction import Direction
from rocking.records.doors import advice
from rocking.records.kinds import RecordKind
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

What = Literal["unit", "time_step", "samples", "peak", "direction"]


class Where(StrEnum):
    """The place of a claim, in words. Of two that agree the later one gives the value; the first two give none.

    SPOKEN: of a rate, which may be that of the recorder.
    """

    FILE_NAME = "its name"
    SPOKEN = "a rate in its header"
    OPTION = "declared"
    FORMAT = "its format"
    HEAD = "its header"
    SAMPLES = "its numbers"
    COLUMN = "the name of the column"
    ANSWER = "layouts.csv"


_PERSONS = (Where.OPTION, Where.ANSWER)
_WITHOUT_VALUE = (Where.FILE_NAME, Where.SPOKEN)


@dataclass(frozen=True)
class Claim:
    """One statement: what it is about, its value in SI or as this package calls it, its place, and its words."""

    what: What
    value: Any
    where: Where
    text: str = ""

    def __str__(self) -> str:
        value = f"{self.value:g} s" if self.what == "time_step" else repr(self.value)
        return f"{repr(self.text[:60]) if self.text else value} ({self.where})"


_SAME_STEP = 1e-3
"""Share by which two steps may differ that are one: a header rounds."""
_SAME: dict[str, Callable[[Any, Any], bool]] = {
    "unit": lambda one, other: (
        not {one, other} & _QUANTITIES and acceleration_factor(one) == acceleration_factor(other)
    ),
    "time_step": lambda one, other: abs(one - other) <= _SAME_STEP * min(one, other),
    "peak": lambda one, other: abs(one[0] - other[0]) <= max(0.01 * one[0], one[1]),
    "samples": lambda one, other: float(one) == float(other),
}


def _same(one: Claim, other: Claim) -> bool:
    return _SAME[one.what](one.value, other.value)


class AnswerContradictedError(RecordError):
    """An answer that a file contradicts."""


def agreed(what: What, claims: Collection[Claim]) -> Any:
    """Return the value of `what` on which claims agree, None where none has one.

    What a person says settles what a file says twice, and may not contradict all that it says, nor against another
    person. So do the name or the numbers of a column where a header says several things, one of them the same. The name
    of a file gives no value, and may not contradict what it holds unless a person says the same as that. Raises
    RecordError where a person contradicts the file, or its name alone speaks, of another quantity; UndeclaredError
    where it contradicts itself.
    """
    of_what = [claim for claim in claims if claim.what == what and claim.value]
    spoken = [claim for where in reversed(Where) for claim in of_what if claim.where == where]
    persons = [claim for claim in spoken if claim.where in _PERSONS]
    named = [claim for claim in spoken if claim.where in _WITHOUT_VALUE]
    inside = [claim for claim in spoken if claim not in persons and claim not in named]
    if not inside and (quantity := next((claim.value for claim in named if claim.value in _QUANTITIES), "")):
        raise RecordError(
            f"its name speaks of {quantity}, and nothing in it of acceleration; use the acceleration of the same "
            "record, or rename the file if it is that.",
            quantity=quantity,
        )
    nearest = [claim for claim in inside if claim.where in (Where.COLUMN, Where.SAMPLES)]
    if nearest and any(claim.where == Where.HEAD and _same(claim, nearest[0]) for claim in inside):
        inside = nearest
    if persons and not _same(persons[0], persons[-1]):
        one, other = persons[0], persons[-1]
        raise RecordError(f"{what} is {one}, but also {other}; omit one of the two.", **{what: other.value})
    against = inside or named
    for person in persons:
        if against and not any(_same(person, claim) for claim in against):
            error = AnswerContradictedError if person.where == Where.ANSWER else RecordError
            is_named = against[0].where == Where.FILE_NAME
            mend = "type that, or rename the file" if is_named else "omit it, or correct the file"
            raise error(
                f"{what} is {person}, but the file says {against[0]}; {mend}.", **{what: person.value}
            )
    of_file = [*inside, *(claim for claim in named if claim.where == Where.FILE_NAME)]
    unlike = [(one, other) for one in inside for other in of_file if not _same(one, other)]
    if unlike and not persons:
        one, other = unlike[0]
        wanted, error = "correct the file", RecordError
        if what == "unit" or what == "time_step":
            wanted, error = f"{advice(what)} to say which holds", UndeclaredError
        raise error(
            f"of its {what.replace('_', ' ')} the file says both {one} and {other}; {wanted}.",
            **{what: one.value},
        )
    holding = (claim for claim in spoken if claim in persons or claim in inside)
    return next((claim.value for claim in holding if not persons or _same(claim, persons[0])), None)


def point_apart(first: str, second: str) -> bool:
    """Whether two names of one component say where it points, and do not say the same."""
    one, other = Direction.of(first), Direction.of(second)
    if not (one.is_known and other.is_known):
        return False
    return (one.azimuth, one.vertical) != (other.azimuth, other.vertical)


# Quantities.

WORDS_OF_ACCELERATION = r"(?:(?<![a-z])(?:acc|acel|beschl|[iİ]vme|ускорени|επιτάχυνση)\w*|加速度)"
_ACCELERATION = re.compile(rf"(?i){WORDS_OF_ACCELERATION}")
_UNITS = (
    r"(?:(?<![a-z])(?:y?units?|unidade?s?|unit[aà]|unités?|einheit(?:en)?|birim(?:i|ler)?|ед(?:иниц\w*|\. ?изм\.?)|"
    r"μονάδ\w*)(?![a-z])|単位|单位)"
)
_OTHER: dict[str, re.Pattern[str]] = {
    "velocity": re.compile(
        r"(?i)(?<![a-z])(?:vel(?:oc?\w*|(?![a-z]))|vitesse|h[ıi]z[ıi]?(?![a-z]))|geschwindigkeit|скорость|速度|ταχύτητα|"
        r"(?<![\w/])(?:cm|m|mm|in|см|м)/(?:s(?:ec)?|с)\b(?!\s*[/^*²2])"
    ),
    "displacement": re.compile(
        r"(?i)(?<![a-z])(?:displ?(?:ac\w*|(?![a-z]))|desp(?:laz)\w*|despl?(?![a-z])|spostament\w*|d[eé]placement|"
        r"deslocamento|yer ?de[gğ]i[sş]tirme)|verschiebung|перемещение|変位|变位|位移|μετατόπιση|"
        rf"(?m:{_UNITS}(?: \w+){{0,2}} ?[:=：]\s*[(\[]?[cm]?m[)\]]?\s*$)"
    ),
}
_QUANTITIES: set[str] = {"spectrum", *_OTHER}
_OF_NO_MOTION = re.compile(
    r"(?i)shear|wave|vs[ _,]?30|\bond[ae]s?\b|welle|\bdalga\b|muestreo|chantillon|abtast|örnekle|campion"
)
"""The velocity of a site, or of a recorder, is no record."""
_OF_OTHER_PEAK = re.compile(r"(?i)(?<![a-z])(?:pgv|pgd|arias|peak|max\w*)[^\n]*")
"""A peak velocity, which next to a unit of acceleration is one of the same motion."""
_SERIES_IN_NAME = re.compile(r"(?i)(?<![a-z])(?:(vt2)|dt2)(?![a-z\d])|\.(?:(vel|vtx|semv)|disp?|semd)$")
_SPECTRA = r"\w*spe[ck]tr\w*|spettr\w*|psa|psv|fas|fft|fourier|спектр\w*|φάσμα"
_SPECTRUM = re.compile(rf"(?i)(?<![a-z])(?:{_SPECTRA})(?![a-z])|スペクトル|反应谱")
_OF_MOTION = re.compile(
    r"(?i)match|compatib|consistent|scaled to|target|time[ -]?(history|series)|accelerogram"
)
"""Words of a motion that was made to a spectrum, or accompanies one."""


_MADE = re.compile(
    r"(?i)\b(?:synthetic|artificial|simulated)[ _-]+(?:\w+[ _-]+)?"
    r"(?:accelerogram|motion|record|time[ _-]?(?:histor(?:y|ies)|series))"
)


def says_made(header: Sequence[str]) -> bool:
    """Whether the lines of a header say that nobody recorded the motion."""
    return any(_MADE.search(line) for line in header)


def other_quantity(text: str) -> str | None:
    """Return "velocity" or "displacement" when `text`, a header or the name of a column, speaks of it alone."""
    if _ACCELERATION.search(text) or _OF_NO_MOTION.search(text):
        return None
    return next((word for word, pattern in _OTHER.items() if pattern.search(text)), None)


def of_another(quantity: str) -> RecordError:
    """Return the error of a file of another quantity than acceleration."""
    return RecordError(
        f"this is a file of {quantity}; use the acceleration of the same record.", quantity=quantity
    )


def _of_spectrum(said: str) -> RecordError:
    return RecordError(
        f"this is a spectrum ({said}); use the record of acceleration against time.", quantity="spectrum"
    )


def refuse_other_quantity(text: str, has_unit: bool = False) -> None:
    """Raise RecordError when `text`, a header, speaks of another quantity; has_unit: whether it states acceleration."""
    if quantity := other_quantity(_OF_OTHER_PEAK.sub("", text) if has_unit else text):
        raise of_another(quantity)


def refuse_spectrum(header: Sequence[str]) -> None:
    """Raise RecordError when the lines of a header say that a file holds a spectrum, and none speaks of a motion."""
    if any(_OF_MOTION.search(line) for line in header):
        return
    if said := next((match[0] for line in header if (match := _SPECTRUM.search(line))), ""):
        raise _of_spectrum(said)


_ABSCISSA = re.compile(r"(?i)\s*(period|freq(uency)?)\b.*|f(_hz)?|.*[(\[]\s*hz\s*[)\]]")
_ORDINATE = re.compile(r"(?i)\s*(p?s[av]|sd|fas|fourier|spectr\w*)\b.*")
_OTHER_TITLE = re.compile(
    r"(?i)(?<![a-z])((?:shear |axial )?strains?|(?:shear |normal )?stress(?:es)?|forces?|moments?|pressure|jerk|"
    rf"{_SPECTRA})(?![a-z])|スペクトル|反应谱"
)
_OF_TARGET = re.compile("(?i)match|compatib|consistent|target|scaled to|spectrally")


def refuse_other_table(above: str, columns: Sequence[str]) -> None:
    """Raise RecordError when names of columns, or the text above them, are of another quantity.

    Of a text that speaks of acceleration no other word counts.
    """
    if columns and (_ABSCISSA.fullmatch(columns[0]) or any(map(_ORDINATE.fullmatch, columns[1:]))):
        raise _of_spectrum(", ".join(columns[:4]))
    has_unit = any(map(unit_of_column, columns)) or bool(Declarations.of(above.split("\n")).only("unit"))
    refuse_other_quantity(above, has_unit)
    if (word := _OTHER_TITLE.search(above)) and not (_ACCELERATION.search(above) or _OF_TARGET.search(above)):
        raise of_another(word[0].lower())


# The name of a column.

PLAIN_ACCELERATION = re.compile(r"(?i)ag?|a_g|ac|acc(el(eration)?)?|aceleraci[oó]n|accelerazione|επιτάχυνση")

IN_BRACKETS = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_BEFORE_UNIT = re.compile(r"\s+in\s+|\s*[/,]\s*|[\s_]+")
_WORDS_OF_OTHERS = re.compile(
    r"(?i)(?<![a-z])(gyro(?:scope)?|angular|magnet(?:ic|ometer)|rotation|tilt|pressure|volt(?:age)?|counts?|drift|"
    r"arias|husid|energy|power|jerk|slip|uplift|shear strain|strain|stress|forces?|moments?|shear|periods?|"
    rf"freq(?:uency)?|sv|sa|sd|{_SPECTRA}|relative|rel|norm(?:ali[sz]ed)?|error|residual|resultant|srss|"
    r"vector[ _]sum|rotd\d*|geo(?:metric)?[ _]?mean)(?![a-z])|[\[(](f|hz|mm|cm|m|in|ft|[mµu]?v|kn|k?pa|psi|-|%)[\])]$"
)
"""Other quantities, accelerations that are not those of the ground in one direction, and units of what is neither."""
MULTIPLIED = re.compile(
    r"(?i)(?<![\w.])(?:10+|\d+[./]\d+)\s*(?:gal\b|(?:[munc]?m|ft|in)\s*/\s*s)|[x×*]\s*1\d*(\.0*)?(e[+-]?\d+|\^|0\b)|\b1e[+-]?\d+\b|\b10\s*(\^|\*\*|-\d)|\b10+\s*[x×*]"
)
"""A power of ten by which a label says that its numbers are multiplied."""


def unit_of_column(name: str) -> str | None:
    """Return the unit of acceleration that the name of a column states, None of a power of ten next to it."""
    if MULTIPLIED.search(name):
        return None
    if match := IN_BRACKETS.search(name):
        return acceleration_unit(match[1])
    return without_unit(name)[1]


def without_unit(name: str) -> tuple[str, str | None]:
    """Return the name of a column before a unit that ends it without brackets, and that: "Acc/g", "ns_m_s2".

    A "g" after a blank is of ground, but after "in" it is a unit.
    """
    for match in _BEFORE_UNIT.finditer(name):
        unit = acceleration_unit(name[match.end() :])
        if unit and (match[0].strip(" _") or unit not in ("g", "mg")):
            return name[: match.start()], unit
    return name, None


def other_of_column(name: str) -> str:
    """Return what the name of a column states that is no acceleration of the ground, "" where it is or may be."""
    if quantity := other_quantity(name):
        return quantity
    word = _WORDS_OF_OTHERS.search(name)
    return (word[1] or f"in {word[2]}").lower() if word else ""


# The name of a file.

_ENDING = re.compile(r"\.(at2|txt|csv|asc|dat|acc|prn|out|th|tcl|gz|time_\w+|g3)$", re.I)
_ANY_ENDING = re.compile(r"\.\w{1,16}$")
_WORDS = (
    r"NS|EW|SN|WE|EO|N-S|E-W|S-N|W-E|E-O|N|E|S|W|NORTH|EAST|SOUTH|WEST|UD|UP|DN|DWN|DOWN|V|\+V|V\+|Z|VER|VERT|"
    r"VERTICAL|[A-Z][HNGL][NEZ]"
)
_IN_NAME = (
    re.compile(rf"^(.*?)[-_. ]({_WORDS})$", re.I),
    re.compile(r"^(.*?)[-_ ](V\d)$", re.I),
    re.compile(r"^(.*?)[-_. ]?([NS]\d{1,2}[EWO])$", re.I),
    re.compile(r"^(.*\D)(\d{3})$"),
    re.compile(r"^(.*[A-Za-z]\d{2})(\d{3})$"),
    re.compile(r"^(.+)[-_. ](\d{1,3})(?:deg)?$", re.I),
    re.compile(r"^(.*[a-z\d])(NS|EW|UD|UP)$"),
    re.compile(r"^(.*(?<!T\d{5})(?<!T\d{3})\d)([NEVZ])$"),  # and not the zone of a time
)
"""A direction at the end of a file's name: a word, a bearing or three digits, or one to three after a sign.

Three digits may follow the two of a station, as in "H-E12140"; a longer number is a date or counts files.
"""
_GLUED = re.compile(r"^(.*[A-Z])(DWN)$|^(RSN\d+_.*[A-Z\d])(UP|DWN|DN|VER|VRT)$")
"""A vertical behind the letters of a station, as NGA writes it."""
_UPWARDS = re.compile(
    r"(?i)(?<![a-z\d])(?:(?-i:[BCEHS][HNG]Z)|UD\d?|vert(?:ical\w*|ikal)?|vrt|d[uü][sş]ey|updown)(?![a-z\d])|上下|垂直|竖向|вертик\w*"
)
"""A word that says nothing else, anywhere in a name that ends in no direction."""
_DONE = re.compile(r"(?i)(scaled?|clean(ed)?|rounded|filled|sped|speed|back|set|sized?)[-_. ](up|down)$")
"""The end of a name in which "up" says what was done, as in "scaled_up"."""


def spaced(name: str) -> str:
    """Return the words of a name: parted at signs and digits, and where a capital follows a small letter."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|[\W\d_]+", " ", name)


def without_ending(name: str) -> str:
    """Return the name of a file without the endings that say what kind of file it is."""
    while (shorter := _ENDING.sub("", name)) not in (name, ""):
        name = shorter
    return name


def direction_in_name(name: str) -> tuple[str, str]:
    """Return the name of a file before the direction at its end, and that direction; ("", "") where it ends in none.

    >>> from rocking.records.claims import direction_in_name
    >>> direction_in_name("RSN779_LOMAP_LGP090.time_g.csv")
    ('RSN779_LOMAP_LGP', '090')
    """
    stem = without_ending(name)
    for pattern in _IN_NAME:
        match = pattern.match(stem)
        if match and Direction.of(match[2]).is_known:
            return match[1], match[2]
    return "", ""


def vertical_in_name(name: str) -> str:
    """Return the word for a vertical with which the name of a file ends, or its channel code; "" where it has none."""
    stem = without_ending(name.rpartition("/")[2])
    is_level = False
    while stem:
        if len(stem) > 1 and stem.isalpha() and Direction.of(stem).vertical:
            return stem
        if _DONE.search(stem):
            return ""
        glued = _GLUED.match(stem)
        word = (glued[2] or glued[4]) if glued else direction_in_name(stem)[1]
        if Direction.of(word).vertical and not word.isdigit():
            return word
        is_level = is_level or (bool(word) and not word.isdigit())
        shorter = _ANY_ENDING.sub("", stem)
        stem = shorter if shorter != stem else ""
    upwards = None if is_level else _UPWARDS.search(name)
    return upwards[0] if upwards else ""


_TIMING_IN_NAME = re.compile(
    r"(?i)(?<![a-z\d.])(dt[ _=-]?)?(\d+(?:\.\d+)?|\.\d+)(?: ?(hz|sps|m?s(?:ec)?)(?![a-z]))?"
)
_UNIT_IN_NAME = re.compile(
    r"(?<![A-Za-z])([cm]?m)[_ -]?(?:per[_ ]?)?s(?:ec)?[_^]?2(?![A-Za-z\d])|"
    r"(?<![A-Za-z])(gals?|GAL(?=$))(?![A-Za-z])|(?<=_)(m?g)$"
)


@lru_cache(maxsize=64)
def claims_of_name(file: str) -> tuple[Claim, ...]:
    """Return what the name of a file says of its unit and its step, "kobe_dt0.005", "x_100Hz", "acc_cm_s2".

    The name of another quantity, as in "x.VT2", is no unit of acceleration.
    """
    name = file.rpartition("/")[2]
    stem = re.sub(r"(?i)\.(txt|csv|dat|at2|asc|acc|th|out|prn|xlsx)$", "", name)
    found = []
    is_of_filter = bool(_OF_FILTER.search(spaced(stem)))
    for match in _TIMING_IN_NAME.finditer(stem):
        unit, number = (match[3] or "").lower(), float(match[2])
        step = 1 / number if unit in _HERTZ and number else number * SECONDS.get(unit, 1.0)
        is_sure = match[1] and "." in match[2]
        if is_sure or (unit and not is_of_filter and 0 < step <= 1 / _FEWEST_PER_SECOND):
            found.append(Claim("time_step", step, Where.FILE_NAME, match[0]))
    for match in _UNIT_IN_NAME.finditer(stem):
        unit = f"{match[1]}/s2" if match[1] else match[2].lower().rstrip("s") if match[2] else match[3]
        found.append(Claim("unit", unit, Where.FILE_NAME, match[0].strip("_")))
    words = spaced(name)
    quantity = other_quantity(words)
    if _SPECTRUM.search(words) and not _OF_MOTION.search(words):
        quantity = "spectrum"
    if series := _SERIES_IN_NAME.search(name):
        quantity = "velocity" if series.lastindex else "displacement"
    found.append(Claim("unit", quantity, Where.FILE_NAME, quantity or ""))
    return tuple(claim for claim in found if claim.value)


# Sentences.

_TIMES = re.compile(
    r"(?i)(?:(?<!\*)[x×*]|\btimes|\b(?:multiplied|divided) by)\s*\d|\d\s*[x×*]\s*(?:acc|g\b)|[(\[]\s*%\s*[)\]]"
)
"""A factor by which numbers are multiplied, as in "cm/s2 * 100": the unit next to it is not that of the numbers."""
_SCALED = re.compile(
    r"(?i)\b(s[ck]al\w*|fa[ck]?t+(?:eu|[eo])re?\w*|m[uo]ltipl\w*|amplif\w*|normali[sz]\w*|sf(?= ?=)|gain|"
    r"guadagno|ganancia|sensitivity|counts|conteggi|cuentas|çarpan\w*|katsayı\w*|ölçek\w*|коэффициент\w*|συντελεστής)\b|"
    r"倍率|係数|系数|カウント"
)
"""Words that speak of a factor by which numbers may still have to be multiplied."""
_SCALED_TO = re.compile(r"(?i)\(\s*scaled to [^)]*\)")
_CELLS = re.compile(r"^\s*([^:=,;\t]+?)\s*[,;\t]\s*([^:=,;\t]+?)[\s,;]*$")
"""A comment of two cells, as "Unit,gal"."""
_CLAUSE = re.compile(r"[;,]\s+|(?<![Mm]ax)(?<!MAX)\.\s+(?=[A-Z])")
_PEAKS = (
    r"(?<![a-z])(?:(?:pga|peak|picco|pico|amax)(?![a-z])|max\w*|m[aá]xim\w*|massim\w*|spitzen\w*|en büyük|maks\w*|"
    r"максимал\w*|μέγιστ\w*)|最大|峰值"
)
_OF_PEAK = re.compile(rf"(?i){_PEAKS}|\b(?:scale\w*|factor)\b")
"""The subjects of a comment whose unit need not be that of the numbers."""
_PEAK = re.compile(
    rf"(?i)(?:{_PEAKS})[^\d:=：,;(\[]*(?:[(\[]\s*(?P<in>[^)\]]+)[)\]])?\s*[:=：]?\s*(?P<value>{NUMBER})\s*[(\[]?"
    r"(?P<unit>[^\W\d_][\w/^*²]*|%g)?"
)
_OF_VALUES = re.compile(
    rf"(?i){WORDS_OF_ACCELERATION}|(?<![a-z])(amplitud|values?\b|valor[ei]|werte|valeurs)"
)
"""Words next to which a unit in brackets is that of the numbers: elsewhere "(G)" may be the code of a network."""
_LEAD = re.compile(
    rf"(?i)(?P<sure>{_UNITS}(?:[^:=：.]*[:=：]|\s+(?:of|are|is|in|-))?\s*['(\[]?\s*|{WORDS_OF_ACCELERATION}\s*[:=,：]\s*)|"
    r"\b(?:in|en|em|σε|в)\s+(?!units?\b)|[(\[（]\s*"
)
"""The words that a unit may follow, and whether what follows them is one whatever the line speaks of."""
_OF_SAMPLING = (
    r"(?:d[eioa] |d['’]|по |)(?:muestreo|campionamento|[eé]chantillonnage|amostragem|дискретизации|δειγματοληψίας|"
    r"tiempo|tempo|temporale|temps|времени|χρόνου)"
)
_TIMING = re.compile(
    r"(?i)(?<![a-z])(?:(?P<step>dt|δt|delta(?:[ _]?t)?|t(?:ime)?[ _-]?(?:step|interval|increment)|"
    r"(?:sampl|digiti)\w*[ _-](?:interval|period|step|time)|(?:equal(?:ly)? )?spac(?:ing|ed)(?: at)?|intervals?|every|"
    rf"intervalo|(?:paso|passo|pas|intervall?[oe]|per[ií]odo|шаг|βήμα) {_OF_SAMPLING}|интервал|"
    r"abtast(?:intervall|schritt)|zeitschritt|(?:örnekleme|zaman) (?:aralığı|adımı)|(?:采样|时间)间隔|"
    r"(?:サンプリング|時間)間隔)|"
    r"(?P<rate>fs|(?:sampl\w*?|data|digiti\w*)[ _-]?(?:rate|freq\w*)|samples ?(?:per|/) ?s(?:ec(?:ond)?)?|"
    r"(?:tasa|fre[cq]\w*\.?|velocidad|razón|taxa|fréquence|частота|συχνότητα|ρυθμός) "
    rf"{_OF_SAMPLING}|muestras por segundo|abtast(?:rate|frequenz)|örnekleme (?:frekansı|hızı)|"
    r"(?:サンプリング(?:周波数|レート)|[采採]样频?率))|sampl(?:ing|ed at)|digiti[sz]ed at|muestreo)"
    r"(?:\s*[(\[_]\s*(?P<in>[^\W\d_]+)\s*[)\]]?)?\s*(?:[:=：]|is|of)?\s*"
    rf"(?P<of>1/)?(?P<value>\d+,\d+|{NUMBER})\s*\(?(?P<unit>[^\W\d_]+)?(?:\s*\.?\s*$|,(?!\d)|[;)\]]|\s/\s)"
)
"""A step or a rate: which of the two it is its unit says, and its name where it has none."""
_HERTZ = {"hz": 1.0, "гц": 1.0, "sps": 1.0, "mps": 1.0, "khz": 1e3}
_RATE_STATED = re.compile(
    rf"(?i)(?<![\w.])({NUMBER})\s*(?:hz|гц|sps|(?:samples?|times) ?(?:/|per) ?s(?:ec(?:ond)?)?)(?![a-z])"
)
_SAMPLED = re.compile(
    r"(?i)sampl|decimat|interpol|digiti|muestr|abtast|chantill|campion|örnekle|サンプリング|采样|rate|frecuencia de m"
)
"""Words next to which a second rate leaves open which one the numbers have."""
_OF_FILTER = re.compile(
    r"(?i)filt|pass|corner|cut|band|butter|natural|period|reson|dominant|range|nyquist|usable|taper|instrument|\bfn\b"
)
"""Words next to which a number of hertz is no rate of samples."""
_FEWEST_PER_SECOND = 10.0
"""The lowest rate that a recorder has, Hz: below, a number of hertz is that of a motion."""
_SAMPLES = re.compile(
    rf"(?i)(?:^|[\s,;(])({NUMBER})\s+(?:data )?(?:points|samples|values)\b(?!\s+(?:per|across|a|each|in)\b|\s*/)|"
    r"(?<![a-z])(?:(?:npts|npoints|ndata|(?:#|(?:n[or]?|num(?:ber|ero)?|n[uú]mero|total|cantidad|nombre|anzahl|число|количество|αριθμός)\b)"
    r"[.º]? ?(?:total )?(?:of |de |di |d['’]|der )?(?:data )?(?:points|samples|data|values|dat[io]s?|muestras|puntos|"
    r"campioni|punti|échantillons|(?:abtast)?werte|punkte|amostras|точек|отсч[её]тов|σημείων)|"
    r"(?:veri|nokta|örnek) sayısı|"
    r"(?:データ|采样|数据)?点数|データ数)\s*[:=：]?|(?:data )?(?:points|samples)\s*[:=])\s*(\d{2,})(?:\.0*)?(?![\d.])"
)
_VALUE = r"\.?\s*(?:code|name)?\s*[:=：]?\s*([^,;:=()\[\]]*?)\s*(?:$|[,;()\[\]]|\s-\s)"
_COMPONENT = (
    r"(?:\bcomp(?:onent[ea]?|osante)?\b|komponente?\b|\bbileşen\w*|\bdirection\b|\bdirecci[oó]n\b|\bdirezione\b|\brichtung\b|"
    r"\byön\w*|компонент\w*|συνιστώσα|成分|分量|方向)"
)
_DIRECTIONS = (
    re.compile(rf"(?i)(?:{_COMPONENT}|\borient\w+|\baxis\b|\beje\b|\brumbo\b){_VALUE}"),
    re.compile(rf"(?i)(?<!class )(?<!type )(?<!site )(?<!soil )(?<![\w/-])([\w/-]+?)\s*{_COMPONENT}"),
    re.compile(r"(?i)\b([\w/-]{2,})\s+(?:acc(?:el(?:eration)?)?|(?:ground )?motion|record)\b"),
    re.compile(
        r"(?:^|[\s,_-])([NS]\d{1,2}[EW]|UP|UD|U-D|NS|N-S|EW|E-W|[BCHS]N[NEZ]|[BH]H[NEZ]|VERT|(?i:vertical))"
        r"\s*(?:$|,)"
    ),
    re.compile(r",[^,]+,\s*(\d{3})\s*$"),
)
"""Words that may be directions: "Component: HNZ", "vertical component", and what ends a title, as "KOBE UP"."""
_OF_SENSOR = re.compile(
    r"(?i)\b(?:comp|component|channel|sensor)\b.*\bazimuth\s*[:=]\s*(\d{1,3})(?:\.0*)?(?![\d.])"
)
"""Where a sensor points by a key of its own, which counts more than a title: the azimuth of a source is none."""
_BOTH_ENDS = re.compile(r"(?i)\b(north|east|up)(?:\s*[/–]\s*|\s+)(south|west|down)\b")
"""A direction in two words, of which the second alone would turn it round."""
_CHANNEL = re.compile(rf"\b(?:canal|chan(?:nel)?){_VALUE}", re.I)
"""A channel may be named by a direction, but "Channel 101" is none."""
_MEANING = re.compile(
    r"(?i)(?<![a-z.])(acc\w*|acel\w*|beschl\w*|vel\w*|displ?\w*|(?:shear |axial )?strains?|stress\w*|forces?|moments?|"
    r"fourier|spectr\w*|psa|fas|periods?|freq\w*|hz|dt|delta|time|intervalo?|sampl\w*|muestr\w*|rate|points|units?|"
    r"unidad\w*|conversion|format|npts|\(?\d+f\d+\.\d+\)?|sec\w*|seg\w*)(?![a-z])|([a-z][\w/^*²]*)"
)
"""Words that say what numbers are; the others are names, of which a unit alone counts."""


@lru_cache(maxsize=4096)
def _claims_of(line: str) -> tuple[Claim, ...]:
    """Return what a line of text says of the numbers that it accompanies; agencies write the same one above each."""
    found: list[tuple[What, Any]] = [("samples", match[1] or match[2]) for match in _SAMPLES.finditer(line)]
    for match in _PEAK.finditer(line):
        if unit := acceleration_unit(match["in"] or match["unit"] or ""):
            factor = acceleration_factor(unit)
            half_digit = 0.5 * 10.0 ** -len(match["value"].partition(".")[2])
            found.append(("peak", (abs(float(match["value"])) * factor, half_digit * factor)))
    for text in dict.fromkeys((line, _CELLS.sub(r"\1: \2", line))):
        bare = _SCALED_TO.sub("", text)
        if not (_TIMES.search(bare) or _SCALED.search(bare)):
            found += [("unit", unit) for unit in _units(bare)]
        if not _OF_PEAK.search(text):
            found += [("time_step", step) for match in _TIMING.finditer(text) if (step := _step_of(match))]
            found += [("direction", name) for name in _components(text)]
    claims = [Claim(what, value, Where.HEAD, line.strip()) for what, value in found]
    if not (_OF_FILTER.search(line) or _OF_PEAK.search(line)):
        rates = [rate for rate in map(float, _RATE_STATED.findall(line)) if rate >= _FEWEST_PER_SECOND]
        claims += [Claim("time_step", 1 / rate, Where.SPOKEN, line.strip()) for rate in rates]
    return tuple(claims)


def _step_of(match: re.Match[str]) -> float | None:
    """Return the step [s] that a step or a rate says, None where its unit is of neither."""
    value = float(match["value"].replace(",", "."))
    value = 1 / value if match["of"] and value else value
    unit = (match["in"] or match["unit"] or "").lower()
    if value > 0 and (unit in _HERTZ or (match["rate"] and not unit)):
        return 1 / (value * _HERTZ.get(unit, 1.0))
    return value * SECONDS.get(unit, 1.0) if unit in SECONDS or (match["step"] and not unit) else None


def azimuth_of_sensor(lines: Sequence[str]) -> str:
    """Return the azimuth of the only sensor that the lines of a header speak of, "" where none or several do."""
    found = {match[1] for line in lines if (match := _OF_SENSOR.search(line))}
    return found.pop() if len(found) == 1 else ""


@dataclass(frozen=True)
class Declarations:
    """All that one text says."""

    claims: tuple[Claim, ...] = ()

    @classmethod
    def of(cls, lines: Sequence[str]) -> "Declarations":
        """Return what the `lines` of a text, without their marks, declare: of several steps those of all rates."""
        said = cls(tuple(claim for line in lines for claim in _claims_of(line)))
        steps = said.stated_steps
        is_resampled = any(_SAMPLED.search(line) for line in lines if not _OF_PEAK.search(line))
        is_apart = is_resampled and bool(steps) and steps[-1] > steps[0] * (1 + _SAME_STEP)
        if is_apart or (len(steps) > 1 and said.only("time_step") is None):
            return cls(tuple(replace(claim, where=Where.HEAD) for claim in said.claims))
        return said

    def _values(self, what: What) -> list[Any]:
        return list(dict.fromkeys(claim.value for claim in self.claims if claim.what == what))

    def only(self, what: What) -> Any:
        """Return the one value of `what`, None where it says none, or several: one of two rates is the recorder's."""
        own = (claim for claim in self.claims if claim.what == what and claim.where != Where.SPOKEN)
        values = list({str(claim.value).upper(): claim.value for claim in own}.values())
        return values[0] if len(values) == 1 else None

    @property
    def stated_steps(self) -> tuple[float, ...]:
        """The steps [s] of every rate that is spoken of, but for those of filters, the least first."""
        return tuple(sorted(self._values("time_step")))

    def count(self, held: int) -> str:
        """Return the number of samples that a text declares, of several that which is `held`; "" where it says none."""
        if len(counts := self._values("samples")) < 2:
            return "".join(counts)
        agreed("samples", [*self.claims, Claim("samples", held, Where.SAMPLES)])
        return str(held)


def warnings_of_claims(channel: Accelerogram, said: Declarations) -> tuple[RockingWarning, ...]:
    """Return a warning where the text says two directions, or another one or another peak than the only channel."""
    warnings = []
    peaks = [claim.value for claim in said.claims if claim.what == "peak"]
    if peaks and not any(_SAME["peak"](peak, (channel.peak_acceleration,)) for peak in peaks):
        values = {"peak_m_s2": channel.peak_acceleration, "stated_m_s2": peaks[0][0]}
        warnings.append(RockingWarning.of(RecordKind.PEAK_UNLIKE_HEADER, **values))
    names = [claim.value for claim in said.claims if claim.what == "direction"]
    own = channel.component if Direction.of(channel.component).is_known else "".join(names[:1])
    if other := next((name for name in names if point_apart(name, own)), ""):
        warnings.append(RockingWarning.of(RecordKind.DIRECTION_SAID_TWICE, own, other=other))
    return tuple(warnings)


def meaning(comment: str) -> str:
    """Return the words of a comment that say what numbers are, without its names and values; all of one on a factor."""
    if speaks_of_factor(comment):
        return comment.strip()[:80]
    words = (match[1] or acceleration_unit(match[2]) or "" for match in _MEANING.finditer(comment))
    return " ".join(word.lower() for word in words if word)


def speaks_of_factor(line: str) -> bool:
    """Whether a line speaks of a factor by which the numbers may still have to be multiplied."""
    return bool(_SCALED.search(line) or (_TIMES.search(line) and _OF_VALUES.search(line)))


def factor_warnings(lines: Sequence[str]) -> tuple[RockingWarning, ...]:
    """Return a warning where lines speak of a factor: none is applied."""
    spoken = next((line.strip() for line in lines if speaks_of_factor(line)), "")
    return (RockingWarning.of(RecordKind.FACTOR_NOT_APPLIED, text=spoken[:60]),) if spoken else ()


def _units(line: str) -> set[str]:
    """The units of acceleration that a line declares for the numbers: no clause of a peak does."""
    of_line = not _OF_PEAK.search(line) and bool(_OF_VALUES.search(line))
    found: list[str] = []
    for clause in (clause for clause in _CLAUSE.split(line) if not _OF_PEAK.search(clause)):
        for lead in _LEAD.finditer(clause):
            words = clause[lead.end() :].split()
            is_sure = lead["sure"] or "/" in "".join(words[:1]) or of_line or _OF_VALUES.search(clause)
            spelt = (" ".join(words[:count]).rstrip(".,;)]'") for count in range(5, 0, -1)) if is_sure else ()
            found += [unit for word in spelt if (unit := acceleration_unit(word))][:1]
    return set(found)


def _components(line: str) -> list[str]:
    """The directions that a line says the channel points in."""
    if re.search(r"(?i)\bhorizontal\b", line):
        return []
    line = _BOTH_ENDS.sub(r"\1-\2", line)
    words = [match[1].strip() for pattern in _DIRECTIONS for match in pattern.finditer(line)]
    words += [match[1].strip() for match in _CHANNEL.finditer(line) if not match[1].strip().isdigit()]
    return [word for word in words if _is_direction(word)]


def _is_direction(name: str) -> bool:
    """Whether a name in a text is a direction: a bare number is one if it is written as three digits, else a count."""
    if name.isdigit():
        return len(name) == _DIGITS_OF_AN_ANGLE and Direction.of(name).azimuth is not None
    return Direction.of(name).is_known


_DIGITS_OF_AN_ANGLE = 3

_MARK = (
    r"(?:[^\w\n]*(?:end|eof)(?:[ \t]+(?:of|d\w+|file)){0,2}[^\w\n]*|/?[&*/]|[*=-]{3,}|"
    r"[a-z]+[ \t]*\$|[}\])]+;?)"
)
END = re.compile(rf"(?i)(?:[#%$!]|//).*|{_MARK}|[\W_]*end(?:[ \t]+of)?(?:[ \t]+\w+)?[\W_]*")
"""Warnings, or a word for the end, below the numbers: these are reported to nobody."""
_MARK_OF_END = re.compile(rf"(?i)(?:(?:(?<=\n)|(?<=\d)(?![)\]])){_MARK})\Z".encode())


def without_end(body: bytes) -> bytes:
    """Return a text without a mark of its end: "*** End Data ***", "/&", "EOF", "LEE $", "};"."""
    match = _MARK_OF_END.search(body[-80:])
    return body[: len(body) - len(match[0])].rstrip() if match else body
