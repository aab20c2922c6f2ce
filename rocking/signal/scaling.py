"""Scaling: one factor on all components of a record, such that a measure of its horizontal motion is what is asked."""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from rocking.described import number_hint
from rocking.errors import RecordError
from rocking.quantities import GRAVITY, VELOCITY_UNITS, acceleration_factor, is_number, shown
from rocking.signal.accelerogram import RARE_PEAK, Accelerogram
from rocking.signal.kinds import SignalKind
from rocking.signal.measures import peak_velocity
from rocking.warnings import RockingWarning

FORM = "a measure, pga or pgv, a number and its unit, as in pga 0.35 g or pgv 50 cm/s"
_SPELLING = re.compile(r"(pga|pgv)\s+([-+.,\d]+(?:e[-+]?\d+)?|nan|inf)\s*([a-z].*)", re.I)
LARGEST_FACTOR = 10.0
"""Factor up to which a record may be scaled without a word, as for fragility."""


_MEASURES: dict[str, Callable[[Accelerogram], float]] = {
    "pga": lambda record: record.peak_acceleration,
    "pgv": peak_velocity,
}


@dataclass(frozen=True)
class ScalingTarget:
    """The value to which the largest peak among the horizontal components of a record is scaled.

    measure: pga or pgv. value: m/s² or m/s, above 0. text: as it was asked for.

    >>> ScalingTarget.parse("pga .35 g").value
    3.4323275
    """

    measure: str
    value: float
    text: str

    @classmethod
    def parse(cls, text: str) -> "ScalingTarget":
        """Return the target that `text` names. Raises RecordError when it names none."""
        match = _SPELLING.fullmatch(text.strip())
        if not match:
            raise RecordError(f"scale_to is {shown(text)}, but must be {FORM}.", scale_to=text)
        measure = match[1].lower()
        number = match[2]
        unit = match[3].strip()
        if not is_number(number) or not 0 < float(number) < math.inf:
            must = f"must be finite and above 0{number_hint(number)}"
            raise RecordError(
                f"scale_to is {shown(text)}, but its number {must}; give {FORM}.", scale_to=text
            )
        if measure == "pgv" and unit not in VELOCITY_UNITS:
            raise RecordError(
                f"scale_to is {shown(text)}, but a velocity is given in {' or '.join(VELOCITY_UNITS)}.",
                scale_to=text,
            )
        factor = acceleration_factor(unit) if measure == "pga" else VELOCITY_UNITS[unit]
        return cls(measure, float(number) * factor, " ".join(text.split()))


def scaled_to(
    target: ScalingTarget, horizontal: Sequence[Accelerogram], vertical: Accelerogram | None
) -> tuple[list[Accelerogram], Accelerogram | None]:
    """Return the components of a record, each multiplied by the one factor that takes it to `target`, as it states.

    The largest peak among the horizontal components becomes what is asked; scale_factor of each says by how much its
    file was multiplied in all. Raises RecordError for a record that is zero throughout.
    """
    largest = max(map(_MEASURES[target.measure], horizontal))
    if largest <= 0:
        raise RecordError(
            f"the record is zero throughout, so that nothing scales it to {target.text}.",
            scale_to=target.text,
        )
    factor = target.value / largest
    sentence = (
        f"All components multiplied by {factor:.5g}, so that the larger {target.measure.upper()} of the horizontal "
        f"ones is {target.text.split(' ', 1)[1]}."
    )
    far = RockingWarning.of(SignalKind.SCALED_FAR, factor=factor, largest=LARGEST_FACTOR)
    warning = [] if 1 / LARGEST_FACTOR <= factor <= LARGEST_FACTOR else [far]

    def enlarged(record: Accelerogram) -> Accelerogram:
        larger = scaled(record, factor).warned(*warning)
        return replace(larger, processing=(*larger.processing, sentence))

    return [enlarged(record) for record in horizontal], None if vertical is None else enlarged(vertical)


def scaled(record: Accelerogram, factor: float) -> Accelerogram:
    """Return `record` multiplied by `factor`, with a warning where that, and not the file, takes its peak above 3 g."""
    enlarged = record.scaled(factor)
    peak = enlarged.peak_acceleration
    if peak <= max(RARE_PEAK, record.peak_acceleration):
        return enlarged
    return enlarged.warned(
        RockingWarning.of(SignalKind.PEAK_RARE_BY_FACTOR, factor=factor, peak_g=peak / GRAVITY)
    )
