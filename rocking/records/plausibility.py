"""Plausibility: what a record's samples say against its header, against any ground, or of damage; and its instrument.

A peak that contradicts its own header, or that no ground has, does not pass unseen. Each test of damage (a struck
sample, gaps, a row that is repeated) asks whether it could be chance, in so long a record; none of the
real files is accused. Where the instrument stood, and what it measured, names and headers say.
"""

import math
import re
from collections.abc import Sequence
from contextlib import suppress
from typing import NoReturn

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from rocking.errors import RecordError
from rocking.quantities import GRAVITY, acceleration_factor
from rocking.records.doors import advice
from rocking.records.kinds import RecordKind
from rocking.signal.accelerogram import LARGEST_PEAK, RARE_PEAK, Accelerogram
from rocking.signal.processing import UNPROCESSED_DEFAULT, integral, process, velocity
from rocking.warnings import RockingWarning

SMALLEST_PEAK = 1e-5 * GRAVITY
"""m/s²; below, a record is noise or has a wrong unit."""
RARE_VELOCITY = 3.0
"""m/s; no recorded ground has moved much faster."""
LARGEST_VELOCITY = 4.0
"""m/s; above, no ground has moved."""
_FACTORS = {
    980.665: "cm/s² against g",
    9.80665: "m/s² against g",
    100.0: "cm/s² against m/s²",
    1000.0: "mg against g, or mm/s² against m/s²",
    10.0: "g/10 against g",
}
_ROUNDING = 1e-3
"""Share by which a stated peak may be off for its rounding, beyond its last digit: fifty times what real files show."""
_NEAR = 0.02  # how close a ratio must come to a factor between units to be explained by it
_PLAUSIBLE = (0.005, 1.5)
_NEIGHBOURS = 3
"""Samples by which the stated time of a peak may be off, as it has few digits, and counts from 0 or from 1; and those
next to a sample that it is compared with."""


def agree_with_header(
    record: Accelerogram,
    peak: float | None,
    unit: str,
    half_digit: float = 0.0,
    at: float | None = None,
    samples: np.ndarray | None = None,
    times: np.ndarray | None = None,
) -> Accelerogram:
    """Return `record` after comparing its peak with the one that its header states, within 1 % or half a digit.

    A peak that is more than 0.1 % off, or out of its place, is a warning; without a stated peak nothing is checked. at:
    its time, s after the first sample. samples: (n,) m/s² as the file holds them, where the record's are resampled;
    times: (n,) s of those, where they are not evenly spaced. Raises RecordError with the factor that would explain the
    difference.
    """
    if not peak:
        return record
    magnitudes = np.abs(record.acceleration if samples is None else samples)
    peak_read = float(magnitudes.max())
    stated = abs(peak) * acceleration_factor(unit)
    off = abs(peak_read - stated)
    digit = half_digit * acceleration_factor(unit)
    if off > max(0.01 * stated, digit):
        ratio = peak_read / stated
        apart = {factor: min(abs(ratio / factor - 1), abs(ratio * factor - 1)) for factor in _FACTORS}
        near = min(apart, key=apart.__getitem__)
        is_unit = apart[near] < _NEAR
        factor = f"{near:g} ({_FACTORS[near]})" if is_unit else f"{ratio:.4g} that no unit explains"
        raise RecordError(
            f"peak acceleration of {record.component or 'the samples'} is {peak_read:.6g} m/s², but the file's header "
            f"states {stated:.6g} m/s², a factor {factor}; the two must agree within 1 %.",
            peak=stated,
        )
    if off > max(_ROUNDING * stated, digit):
        record = record.warned(
            RockingWarning.of(RecordKind.PEAK_UNLIKE_HEADER, peak_m_s2=peak_read, stated_m_s2=stated)
        )
    if at is None:
        return record
    instants = np.arange(magnitudes.size) * record.time_step if times is None else times
    place = int(np.abs(instants - at).argmin())
    around = magnitudes[max(0, place - _NEIGHBOURS) : place + _NEIGHBOURS + 1]
    if around.max() >= 0.98 * magnitudes.max():
        return record
    found_at = float(instants[magnitudes.argmax()])
    return record.warned(RockingWarning.of(RecordKind.PEAK_ELSEWHERE, stated_s=at, time_s=found_at))


def pass_limits(record: Accelerogram, form: str = "") -> tuple[RockingWarning, ...]:
    """Return warnings on a peak below 1e-5 g, or above 3 g or 3 m/s; raise RecordError when it is above 5 g or 4 m/s.

    form: the name of the format, by which the sentence says what to do.
    """
    peak = record.peak_acceleration / GRAVITY
    if record.peak_acceleration > LARGEST_PEAK:
        _refuse_peak(record, f"peak acceleration is {peak:.6g} g", "the 5 g that no ground has reached", form)
    fast = _velocity_limit(record, form)
    if record.peak_acceleration > RARE_PEAK:
        return (RockingWarning.of(RecordKind.PEAK_RARE, peak_g=peak), *fast)
    if record.peak_acceleration >= SMALLEST_PEAK:
        return fast
    if fits := _fitting_factors(peak):
        return (RockingWarning.of(RecordKind.PEAK_TINY_BY_UNIT, peak_g=peak, factors=fits),)
    return (RockingWarning.of(RecordKind.PEAK_TINY, peak_g=peak),)


def _velocity_limit(record: Accelerogram, form: str) -> tuple[RockingWarning, ...]:
    """Return a warning on a peak velocity above 3 m/s; raise RecordError when it is above 4 m/s.

    After the processing of raw records, whatever the file says: without it an offset of the recorder would count.
    """
    samples = record.acceleration
    if (
        samples.size < _SHORTEST
        or np.ptp(integral(samples - samples.mean(), record.time_step)) <= _SURELY_SLOW
    ):
        return ()
    fastest = 0.0
    with suppress(RecordError):  # a record that is too short to be processed
        fastest = float(np.abs(velocity(process(record, UNPROCESSED_DEFAULT))).max())
    if fastest > LARGEST_VELOCITY:
        found = f"peak velocity is {fastest:.3g} m/s"
        _refuse_peak(record, found, f"the {LARGEST_VELOCITY:g} m/s that no ground has reached", form)
    if fastest > RARE_VELOCITY:
        return (RockingWarning.of(RecordKind.VELOCITY_RARE, velocity_m_s=fastest, rare_m_s=RARE_VELOCITY),)
    return ()


_SURELY_SLOW = 2.5
"""m/s; where velocity about its mean ranges so little, no high-pass makes it 1.2 of that: of 230 channels 0.83."""


def _fitting_factors(peak: float) -> str:
    """Return the factors between units by which a peak, in g, would be plausible: those of a tiny one multiply it."""
    is_tiny = peak < SMALLEST_PEAK / GRAVITY
    plausible = {f: _PLAUSIBLE[0] < (peak * f if is_tiny else peak / f) < _PLAUSIBLE[1] for f in _FACTORS}
    return ", ".join(f"by {f:g} ({meaning})" for f, meaning in _FACTORS.items() if plausible[f])


def _refuse_peak(record: Accelerogram, found: str, limit: str, form: str) -> NoReturn:
    """Raise RecordError for what was `found` of a record, beyond a `limit`, and say what to do by its peak."""
    fits = _fitting_factors(record.peak_acceleration / GRAVITY)
    if form in OF_COUNTS:
        what = (
            f": the samples may be counts of the recorder; {advice('inventory')} and no unit, or as the unit the "
            "acceleration of one count, as in 4.71e-6 m/s2"
            f"{f'; divided {fits} they would be plausible as acceleration' if fits else ''}."
        )
    elif fits:
        what = f"; divided {fits} it would be plausible; declare the true unit."
    else:
        what = (
            ", and no factor between units explains it: counts of the recorder, perhaps; give as the unit the "
            "acceleration of one count, as in 4.71e-6 m/s2, or use the calibrated file of the record."
        )
    raise RecordError(f"{found} read as {record.source.unit or 'm/s2'}, above {limit}{what}", peak=found)


OF_COUNTS = ("SAC", "miniSEED", "GSE", "SLIST or TSPAIR", "WIN", "SEISAN", "REFTEK 130", "obspy")
"""Kinds of file whose samples are mostly counts."""


def agree_with_mean_square(record: Accelerogram, stated: float, unit: str, digit: float) -> Accelerogram:
    """Return `record`, with a warning where its root mean square is not the one stated in `unit`, to its last digit.

    Real headers agree with their samples to that digit. Nothing is checked when zero or less is stated.
    """
    factor = acceleration_factor(unit)
    in_samples = float(np.sqrt(np.mean(np.square(record.acceleration)))) / factor
    if stated <= 0 or abs(in_samples - stated) <= digit + _ROUNDING * stated:
        return record
    return record.warned(
        RockingWarning.of(RecordKind.MEAN_SQUARE_UNLIKE_HEADER, value=in_samples, stated=stated, unit=unit)
    )


_VELOCITY_OFF = 0.25
"""Share of a file's own velocity, root mean square, by which the integral of its acceleration may differ from it.

A processed file is off by a line at most, which is taken out; real ones agree within 6 %.
"""


_REACH = 5
"""Samples before and after a step of velocity by which it is foretold: agencies integrate finer than they print."""
_STRAY = 100.0
"""The largest plausible error of one step, in usual errors from the median; of seven real channels none reaches 53."""
_DIGITS_OFF = 4.0
"""Units of the last digit by which rounding may take one step off: one by both velocities, and as much by each side."""


def agree_with_velocity(record: Accelerogram, stated: np.ndarray) -> Accelerogram:
    """Return `record`, with a warning where the velocity in its file, (n,) m/s, is not the integral of its numbers.

    The two are compared as a whole, and step by step: a number that is damaged, or two lines that are exchanged, in
    either of them leave velocity and integral apart in one place.
    """
    size = record.acceleration.size
    if stated.size != size:
        return record

    if size >= 100 * _REACH:
        around = sliding_window_view(record.acceleration, 2 * _REACH)
        steps = np.diff(stated)[_REACH - 1 :][: len(around)]
        # Summed by einsum, for a library of matrices would set threads on so small a task.
        products = np.einsum("ij,ik->jk", around, around)
        weights = np.linalg.lstsq(products, np.einsum("ij,i->j", around, steps), rcond=None)[0]
        errors = np.abs(steps - np.einsum("ij,j->i", around, weights))
        stray = int(errors.argmax())
        usual = max(float(np.median(errors)) * 1.4826, 1e-12)
        # A unit of the last digit is the smallest difference between two unlike numbers.
        apart = np.diff(np.unique(stated))
        digit = float(apart[apart > 1e-6 * np.ptp(stated)].min(initial=np.ptp(stated)))
        # Where most of the record is still, the usual error says nothing: what rounding explains is no damage.
        if errors[stray] > max(_STRAY * usual, _DIGITS_OFF * digit):
            time = (stray + _REACH) * record.time_step
            return record.warned(RockingWarning.of(RecordKind.VELOCITY_UNLIKE_THERE, time_s=time))

    times = np.linspace(-1, 1, size)
    differing = stated - integral(record.acceleration, record.time_step)
    differing = differing - differing.mean() - times * np.sum(times * differing) / np.sum(times * times)
    if differing.std() <= _VELOCITY_OFF * stated.std():
        return record
    return record.warned(RockingWarning(RecordKind.VELOCITY_UNLIKE))


_ODDS = 100.0
"""The odds of damage against chance that a warning asks, over all samples of a record at which it could be."""


def damage_warnings(record: Accelerogram) -> tuple[RockingWarning, ...]:
    """Return a warning for each kind of damage in a record."""
    return (
        *_sample_alone(record),
        *_zeros_in_shaking(record),
        *_still_stretch(record),
    )


_ALONE = 3.0, 2.0
"""A sample alone: this many times the three next to it on each side, and the largest of all others.

Of the strongest real records a peak reaches 2.6 and 1.1, or 1.7 and 1.6 times.
"""
_SHORTEST = 100
"""Samples below which a record is too short for a warning on its course."""


def _sample_alone(record: Accelerogram) -> tuple[RockingWarning, ...]:
    """Return a warning on a sample alone far above all others."""
    magnitudes = np.abs(record.acceleration)
    if magnitudes.size < _SHORTEST or not magnitudes.any():
        return ()
    at = int(magnitudes.argmax())
    peak = float(magnitudes[at])
    others = np.delete(magnitudes, at)
    near = others[max(0, at - _NEIGHBOURS) : at + _NEIGHBOURS].max()
    if peak <= _ALONE[0] * near or peak <= _ALONE[1] * others.max():
        return ()
    return (
        RockingWarning.of(
            RecordKind.SAMPLE_ALONE,
            time_s=at * record.time_step,
            peak_g=peak / GRAVITY,
            others_g=float(others.max()) / GRAVITY,
        ),
    )


_ZEROS = 50
"""Exact zeros in a row that no recorder writes while the ground shakes; real files hold at most 14."""


def _zeros_in_shaking(record: Accelerogram) -> tuple[RockingWarning, ...]:
    """Return a warning on zeros within strong shaking, between 5 and 95 % of the energy."""
    magnitudes = np.abs(record.acceleration)
    if magnitudes.size < 2 * _ZEROS or not magnitudes.any():
        return ()
    spent = np.cumsum(np.square(magnitudes))
    begin, end = np.searchsorted(spent, np.array([0.05, 0.95]) * spent[-1])
    moving = np.flatnonzero(magnitudes[begin : end + 1])
    longest = int(np.diff(moving).max(initial=0)) - 1
    if longest < _ZEROS:
        return ()
    return (RockingWarning.of(RecordKind.ZEROS_IN_SHAKING, samples=longest),)


_STEPS_AROUND = 100
"""Samples on each side of a stretch by which it is judged, at least a fifth of which must be there."""
_SHORT = 20
"""Samples in a row that may be the same at a crest, or where a trace was clipped, without a word."""
_LIVELY = 0.5
"""Share of the steps next to a still stretch that must change the value: in files of few digits even noise is still."""


def _still_stretch(record: Accelerogram) -> tuple[RockingWarning, ...]:
    """Return a warning where the value stays what it is for longer than the samples on both sides allow.

    Where a share q of the steps next to it change the value, n steps in a row change nothing in (1 - q)ⁿ of cases.
    """
    values = record.acceleration
    changes = np.flatnonzero(np.diff(values))
    if changes.size < 2 * _STEPS_AROUND // 5:
        return ()
    steps = np.diff(changes) - 1
    # Not of the longest alone: a record that begins or ends still has a longer one there.
    for place in np.argsort(steps, kind="stable")[::-1].tolist():
        if steps[place] < _SHORT:
            break
        first = int(changes[place]) + 1
        last = int(changes[place + 1])
        before = _share_of_changes(values[:first][-_STEPS_AROUND:])
        after = _share_of_changes(values[last + 1 :][:_STEPS_AROUND])
        share = min(before, after)
        by_chance = (last - first) * math.log1p(-min(share, 1 - 1 / _STEPS_AROUND)) + math.log(values.size)
        if share >= _LIVELY and by_chance <= -3 * math.log(_ODDS):
            return (
                RockingWarning.of(
                    RecordKind.STILL_STRETCH, time_s=first * record.time_step, samples=last - first + 1
                ),
            )
    return ()


def _share_of_changes(values: np.ndarray) -> float:
    """Return the share of the steps of `values` that change the value, 0 of too few."""
    return float(np.mean(np.diff(values) != 0)) if values.size >= _STEPS_AROUND // 5 else 0.0


_STILL = 1 / 200
"""Least share of steps without a change that is believed of a channel, from the two hundred next to them."""


def repeated_rows(records: Sequence[Accelerogram]) -> tuple[RockingWarning, ...]:
    """Return a warning where a row of numbers, one of each of several channels, occurs twice in succession.

    By chance no channel changes in the product of the shares in which each does not, from the steps next to it.
    """
    sizes = {record.acceleration.size for record in records}
    if len(records) < 2 or len(sizes) > 1 or min(sizes) < 2 * _STEPS_AROUND:
        return ()
    still = np.array([np.diff(record.acceleration) == 0 for record in records])
    steps = still.shape[1]
    places = np.flatnonzero(still.all(axis=0))
    first = np.maximum(0, places - _STEPS_AROUND)
    end = np.minimum(steps, places + _STEPS_AROUND + 1)
    counted = np.pad(np.cumsum(still, axis=1), ((0, 0), (1, 0)))
    others = counted[:, end] - counted[:, first] - 1  # but the step itself
    shares = np.maximum(others / (end - first - 1), _STILL)
    unlikely = places[np.prod(shares, axis=0) * steps < 1 / _ODDS]
    if not unlikely.size:
        return ()
    return (RockingWarning.of(RecordKind.ROW_REPEATED, time_s=float(unlikely[0] + 1) * records[0].time_step),)


def same_motion(first: Accelerogram, second: Accelerogram) -> bool:
    """Whether two channels are one, or one the other turned round; a look at one sample tells most apart."""
    one, other = first.acceleration, second.acceleration
    if one.size != other.size or abs(one[one.size // 2]) != abs(other[other.size // 2]):
        return False
    return np.array_equal(one, other) or np.array_equal(one, -other)


_STRUCTURE = re.compile(
    r"(?i)\b(roof|floor|fl|flr|storey|story|penthouse|mezzanine|attic|deck|bent|column|girder|abutment|pier|crest|tower|"
    r"dam|gallery|basement|bsmt|bldg|building|bridge)\b"
)
_FREE = re.compile(r"\bfree[- ]?field\b", re.I)
_DOWN_HOLE = re.compile(r"(?i)\b(down-?hole|bore-?hole|depth|below (ground|surface))\b|-\s*\d+(\.\d+)?\s*m\b")
_CODE = re.compile(r"(?!CH\d)[A-Z](?:([HLMPJ])[ENZ123]|([DFK])[FHEIOZ])(\d\d)?")
"""A channel code but for CH1, CH2 and CH3, which count the channels of a logger."""
_NO_MOTION = {"J": "rotational sensor", "D": "pressure sensor", "F": "magnetometer", "K": "thermometer"}


BURIED = 5.0
"""m below the surface from which on an instrument is in a borehole; vaults are shallower."""
_DEPTH = re.compile(r"(?i)(\d+(?:\.\d+)?)\s*(m|ft|feet)\b")


def is_down_hole(place: str) -> bool:
    """Whether the `place` of an instrument, as a header writes it, is a borehole or more than 5 m below the ground."""
    if not _DOWN_HOLE.search(place):
        return False
    depths = [float(depth) * (1.0 if unit in "mM" else 0.3048) for depth, unit in _DEPTH.findall(place)]
    return max(depths) >= BURIED if depths else bool(re.search(r"(?i)(down|bore)-?hole", place))


def site_warnings(place: str) -> tuple[RockingWarning, ...]:
    """Return a warning when the `place` of an instrument is in a structure or below the ground."""
    if _DOWN_HOLE.search(place) and (is_down_hole(place) or not _DEPTH.search(place)):
        return (RockingWarning.of(RecordKind.DOWN_HOLE, place=place),)
    if _STRUCTURE.search(place) and not _FREE.search(place):
        return (RockingWarning.of(RecordKind.IN_A_STRUCTURE, place=place),)
    return ()


def channel_warnings(component: str) -> tuple[RockingWarning, ...]:
    """Return a warning when a channel code is that of a seismometer (BH?, HH?, HL?), not of an accelerometer (?N?)."""
    code = _CODE.fullmatch(component.strip().upper())
    if not code:
        return ()
    if other := _NO_MOTION.get(code[1] or code[2]):
        return (RockingWarning.of(RecordKind.CHANNEL_NO_MOTION, component.strip(), sensor=other),)
    kind = {"H": "high-gain seismometer", "L": "low-gain seismometer", "M": "mass position", "P": "geophone"}
    return (RockingWarning.of(RecordKind.CHANNEL_OF_VELOCITY, component.strip(), sensor=kind[code[1]]),)
