"""Comments: what the lines of text above the numbers of a table declare of them."""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TypeVar

from rocking.quantities import acceleration_unit
from rocking.records.direction import Direction
from rocking.records.formats.text import NUMBER
from rocking.records.kinds import RecordKind
from rocking.remarks import Remark


@dataclass(frozen=True)
class Declarations:
    """Facts that comments state of the numbers below them, None (the component: "") where none does, or several differ.

    unit: of acceleration. time_step: s. component: where the only channel points. samples: their number, as written.
    stated_steps: the steps [s] of every rate that is spoken of, but for those of filters.
    """

    unit: str | None = None
    time_step: float | None = None
    component: str = ""
    samples: str = ""
    stated_steps: tuple[float, ...] = ()

    @classmethod
    def of(cls, comments: Sequence[str]) -> "Declarations":
        """Return what `comments`, without their marks, declare."""
        lines = (*comments, *(_CELLS.sub(r"\1: \2", comment) for comment in comments))
        of_numbers = [line for line in lines if not _OF_PEAK.search(line)]
        as_they_stand = [line for line in of_numbers if not (_TIMES.search(line) or _SCALED.search(line))]
        units = {unit for line in as_they_stand for unit in _units(line)}
        steps = {step for line in of_numbers for step in _steps(line)}
        components = {component.upper(): component for line in of_numbers for component in _components(line)}
        counts = {match[1] or match[2] for line in comments for match in _SAMPLES.finditer(line)}
        stated_steps = {1 / rate for line in of_numbers for rate in _rates(line)}
        # A rate next to another one may be the one that the numbers were recorded at, and not theirs.
        is_sampled_twice = any(_SAMPLED.search(line) for line in of_numbers) and not _are_one(
            stated_steps | steps
        )
        return cls(
            unit=_the_only(units),
            time_step=None if is_sampled_twice else _the_only(steps),
            stated_steps=tuple(sorted(stated_steps | steps)),
            component=_the_only(components.values()) or "",
            samples=_the_only(counts) or "",
        )


T = TypeVar("T")


def _the_only(values: Collection[T]) -> T | None:
    """Return the value of which there is one, None of none or several."""
    if len(values) != 1:
        return None
    return next(iter(values))


_SAME_STEP = 1e-3
"""Share by which two steps may differ that are one: a header rounds."""


def _are_one(steps: Collection[float]) -> bool:
    return not steps or max(steps) <= min(steps) * (1 + _SAME_STEP)


def contradicts(steps: Collection[float], step: float) -> bool:
    """Whether none of `steps` [s], of which a page speaks, is `step`; False where it speaks of none."""
    return bool(steps) and not any(_are_one((stated, step)) for stated in steps)


OF_ACCELERATION = re.compile(r"(?i)(?<![a-z])(acc|acel|beschl|amplitud)")
"""Words next to which a unit in brackets is that of the numbers: elsewhere "(G)" may be the code of a network."""
_TIMES = re.compile(r"(?i)(?:[x×*]|\btimes|\b(?:multiplied|divided) by)\s*\d|\d\s*[x×*]\s*(?:acc|g\b)")
"""A factor by which numbers are multiplied, as in "cm/s2 * 100": the unit next to it is not that of the numbers."""
_SCALED = re.compile(
    r"(?i)\b(s[ck]al\w*|fa[ck]?t+(?:eu|[eo])re?\w*|m[uo]ltipl\w*|gain|guadagno|ganancia|sensitivity|counts|conteggi|"
    r"cuentas|çarpan\w*|katsayı\w*|ölçek\w*)\b|倍率|係数|系数|カウント"
)
"""Words that speak of a factor by which numbers may still have to be multiplied."""
_CELLS = re.compile(r"^\s*([^:=,;\t]+?)\s*[,;\t]\s*([^:=,;\t]+?)[\s,;]*$")
"""A comment of two cells, as "Unit,gal"."""
_OF_PEAK = re.compile(r"(?i)\b(pga|peak|max\w*|scale\w*|factor|picco|pico)\b")
"""The subjects of a comment whose unit need not be that of the numbers."""
_UNIT = re.compile(
    r"(?:\b(?:units?|unidad(?:es)?|unit[aà]|unités?|einheit(?:en)?|birim(?:i|ler)?)\b|単位|单位)[^:=：]*[:=：]\s*[(\[]?\s*([^\s,;()\[\]]+)|"
    r"\b(?:acc|accel|acceleration|acel|aceleraci[oó]n)\s*[:=]\s*([a-z][\w/^*²]*)|"
    r"\bunits?(?: of| are| is)?\s+[(\[]?([A-Za-z][\w/^*²]*)|(?:\bin\s+|[(\[]\s*)([A-Za-z][\w/^*²]*)",
    re.I,
)
_SECONDS = r"(?:s|seg|secs?|segundos?|seconds?)"
_END = r"\s*(?:\.?\s*$|[,;)\]]|\s/\s)"
_STEP = re.compile(
    r"(?:\b(?:dt|delta|time[ _-]?(?:step|interval|increment)|(?:sampling|sample)[ _-]?(?:interval|period|step)|"
    r"(?:equal )?spacing|intervals|intervalo(?: de muestreo)?|(?:passo|intervallo) (?:di campionamento|temporale)|"
    r"(?:pas|intervalle) (?:de temps|d.échantillonnage)|abtastintervall|zeitschritt|"
    r"(?:örnekleme|zaman) (?:aralığı|adımı))|サンプリング間隔|采样间隔)"
    rf"\s*(?:[(\[]\s*{_SECONDS}\s*[)\]])?\s*(?:[:=：]|is|of)?\s*({NUMBER})\s*\(?{_SECONDS}?{_END}|"
    rf"^\s*(?:sampling|muestreo)\s*[:=]\s*({NUMBER})\s*{_SECONDS}\s*$",
    re.I,
)
_RATE = re.compile(
    r"(?:\b(?:fs|(?:sampling|sample)[ _-]?(?:rate|frequency)|tasa de muestreo|frecuencia de muestreo|"
    r"frequenza di campionamento|fréquence d.échantillonnage|abtast(?:rate|frequenz)|örnekleme (?:frekansı|hızı))\b|"
    r"サンプリング周波数|采样频率)"
    rf"\s*(?:[(\[]\s*hz\s*[)\]])?\s*(?:[:=：]|is|of)\s*({NUMBER})\s*(?:hz|sps)?{_END}|"
    rf"\bsampled at ({NUMBER})\s*(?:hz|sps){_END}",
    re.I,
)
_RATE_STATED = re.compile(
    rf"(?<![\w.])({NUMBER})\s*(?:hz|sps|samples? ?(?:/|per) ?s(?:ec(?:ond)?)?)(?![a-z])", re.I
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
    r"(?:^|[\s,;(])(-?\d[\d.e]*)\s+(?:points|samples|values)\b(?!\s+(?:per|across|a|each|in)\b)|"
    r"\b(?:npts|(?:no\.?|number) (?:of )?(?:points|samples|data|values)|"
    r"n[uú]m(?:ero|\.)? (?:total )?de (?:datos|muestras|puntos))"
    r"\s*[:=]\s*(-?\d[\d.e]*)",
    re.I,
)
_VALUE = r"\b\.?\s*(?:code|name)?\s*[:=]?\s*([^,;:=()\[\]]*?)\s*(?:$|[,;()\[\]]|\s-\s)"
_DIRECTIONS = (
    re.compile(
        rf"\b(?:comp(?:onent[ea]?)?|direction|orientation|direcci[oó]n|orientaci[oó]n){_VALUE}",
        re.I,
    ),
    re.compile(
        r"(?<!class )(?<!type )(?<!site )(?<!soil )\b([\w/-]+)\s+(?:comp(?:onent)?|direction)\b",
        re.I,
    ),
    re.compile(r"\b([\w/-]{2,})\s+(?:acc(?:el(?:eration)?)?|(?:ground )?motion|record)\b", re.I),
    re.compile(
        r"(?:^|[\s,_-])([NS]\d{1,2}[EW]|UP|UD|U-D|NS|N-S|EW|E-W|[BCHS]N[NEZ]|[BH]H[NEZ]|VERT|(?i:vertical))"
        r"\s*(?:$|,)"
    ),
    re.compile(r",[^,]+,\s*(\d{3})\s*$"),
)
"""Words that may be directions: "Component: HNZ", "vertical component", and what ends a title, as "KOBE UP"."""
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


def meaning(comment: str) -> str:
    """Return the words of a comment that say what numbers are, without its names and values; all of one on a factor."""
    if speaks_of_factor(comment):
        return comment.strip()[:80]
    words = (match[1] or acceleration_unit(match[2]) or "" for match in _MEANING.finditer(comment))
    return " ".join(word.lower() for word in words if word)


def speaks_of_factor(comment: str) -> bool:
    """Whether a comment speaks of a factor by which the numbers may still have to be multiplied."""
    return bool(_SCALED.search(comment) or (_TIMES.search(comment) and OF_ACCELERATION.search(comment)))


def factor_warnings(comments: Sequence[str]) -> tuple[Remark, ...]:
    """Return a warning where comments speak of a factor: none is applied."""
    spoken = [comment.strip() for comment in comments if speaks_of_factor(comment)]
    if not spoken:
        return ()
    return (Remark.of(RecordKind.FACTOR_NOT_APPLIED, text=spoken[0][:60]),)


def _units(comment: str) -> set[str]:
    """The units of acceleration that a comment declares for the numbers."""
    is_of_numbers = bool(OF_ACCELERATION.search(comment))
    words = [
        match[1] or match[2] or match[3] or (match[4] if is_of_numbers else "")
        for match in _UNIT.finditer(comment)
    ]
    return {unit for word in words if word and (unit := acceleration_unit(word))}


def _steps(comment: str) -> set[float]:
    """The time steps [s] that a comment declares, or follow from the rates that it does."""
    steps = {float(match[1] or match[2]) for match in _STEP.finditer(comment)}
    rates = {float(match[1] or match[2]) for match in _RATE.finditer(comment)}
    return {step for step in steps if step > 0} | {1 / rate for rate in rates if rate > 0}


def _rates(comment: str) -> set[float]:
    """The rates [Hz] that a comment speaks of, but for those of filters."""
    if _OF_FILTER.search(comment):
        return set()
    return {
        rate for match in _RATE_STATED.finditer(comment) if (rate := float(match[1])) >= _FEWEST_PER_SECOND
    }


def _components(comment: str) -> list[str]:
    """The directions that a comment says the channel points in."""
    if re.search(r"(?i)\bhorizontal\b", comment):
        return []
    comment = _BOTH_ENDS.sub(r"\1-\2", comment)
    words = [match[1].strip() for pattern in _DIRECTIONS for match in pattern.finditer(comment)]
    words += [match[1].strip() for match in _CHANNEL.finditer(comment) if not match[1].strip().isdigit()]
    return [word for word in words if _is_direction(word)]


def _is_direction(name: str) -> bool:
    """Whether a name in a text is a direction: a bare number is one if it is written as three digits, else a count."""
    if name.isdigit():
        return len(name) == _DIGITS_OF_AN_ANGLE and Direction.of(name).azimuth is not None
    return Direction.of(name).is_known


_DIGITS_OF_AN_ANGLE = 3
