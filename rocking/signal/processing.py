"""Processing: what turns recorded numbers into ground acceleration, each step optional and recorded in the result."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from rocking.described import check_described, described
from rocking.errors import RecordError
from rocking.signal.accelerogram import Accelerogram

Baseline = Literal["none", "linear", "adaptive"]
_LOW_PASS_SHARE = 0.8
"""Share of the new Nyquist frequency above which nothing is left before a record is thinned out."""


@dataclass(frozen=True)
class Processing:
    """Settings, applied in this order; a step that is None, 0 or "none" is left out.

    order: of each Butterworth filter, before it is run both ways. While it is filtered, a record is padded with zeros
    of 1.5 order/corner seconds (Boore 2005). Raises RecordError when a setting is out of range.
    """

    pre_event: float | None = described(
        None, "time at the start of the record whose mean is removed", "s", gt=0
    )
    baseline: Baseline = described(
        "none",
        "none; linear: removes the least-squares line; adaptive: removes the drift "
        "of velocity around the shaking",
    )
    taper: float = described(0.0, "share of the record that a cosine taper covers at each end", ge=0, le=0.5)
    high_pass: float | None = described(None, "corner frequency of the acausal high-pass filter", "Hz", gt=0)
    low_pass: float | None = described(None, "corner frequency of the acausal low-pass filter", "Hz", gt=0)
    order: int = described(4, "order of the filters", ge=1, le=10)
    time_step: float | None = described(
        None, "time step to which the record is resampled", "s", ge=1e-4, le=1
    )

    def __post_init__(self) -> None:
        check_described(RecordError, self)
        if self.high_pass and self.low_pass and self.high_pass >= self.low_pass:
            raise RecordError(
                f"high_pass is {self.high_pass!r} Hz, but low_pass only {self.low_pass!r} Hz.",
                high_pass=self.high_pass,
            )


UNPROCESSED_DEFAULT = Processing(pre_event=1.0, baseline="linear", taper=0.02, high_pass=0.1)
"""The processing of raw records unless the settings say otherwise."""


def process(record: Accelerogram, processing: Processing | None = None) -> Accelerogram:
    """Return `record` after the steps of `processing`, each stated in its `processing` field.

    None: the default for raw records, and nothing for those whose file says they are processed already or cannot say.
    Raises RecordError when a corner or a window does not fit the record.
    """
    if processing is None:
        processing = UNPROCESSED_DEFAULT if record.processed is False else Processing()
    for step in (_levelled, _filtered, _resampled):
        record = step(record, processing)
    return record


def variants() -> dict[str, Processing]:
    """Return named settings that differ in baseline and corner, to see how much an answer owes to them."""
    corners = {f"high-pass {f:g} Hz": Processing(taper=0.02, high_pass=f) for f in (0.05, 0.1, 0.2)}
    baselines = {f"{kind} baseline": Processing(baseline=kind) for kind in ("linear", "adaptive")}
    return {"unchanged": Processing(), **baselines, **corners}


def velocity(record: Accelerogram) -> np.ndarray:
    """Return the velocity (n,) in m/s by the trapezoidal rule, from the record's initial one, mostly rest."""
    return record.initial_velocity + integral(record.acceleration, record.time_step)


def displacement(record: Accelerogram) -> np.ndarray:
    """Return the displacement (n,) in m by the trapezoidal rule twice, from the record's initial motion."""
    return record.initial_displacement + integral(velocity(record), record.time_step)


def integral(values: np.ndarray, time_step: float) -> np.ndarray:
    """Return the integral (n,) of `values` from the first sample on by the trapezoidal rule."""
    summed: np.ndarray = np.cumsum(values) - (values + values[0]) / 2
    return time_step * summed


def _levelled(record: Accelerogram, processing: Processing) -> Accelerogram:
    if processing.pre_event is not None:
        samples = round(processing.pre_event / record.time_step)
        if not 1 <= samples < record.acceleration.size:
            window = f"pre_event is {processing.pre_event!r} s"
            raise RecordError(
                f"{window}, but must hold a sample and end within the record.", pre_event=processing.pre_event
            )
        mean = record.acceleration[:samples].mean()
        sentence = f"Mean of the first {processing.pre_event:g} s removed, {mean:.6g} m/s²."
        record = record.processed_by(record.acceleration - mean, sentence)
    if processing.baseline == "adaptive":
        return record.processed_by(*adaptive_baseline(record.acceleration, record.time_step))
    if processing.baseline == "none":
        return record
    times = record.times - record.duration / 2
    # Summed rather than as a product of vectors: for that, BLAS starts threads that wait for longer than they work.
    slope = float(np.sum(times * record.acceleration) / np.sum(times * times))
    mean = record.acceleration.mean()
    sentence = f"Least-squares line removed, mean {mean:.6g} m/s² and slope {slope:.6g} m/s³."
    return record.processed_by(record.acceleration - mean - slope * times, sentence)


def _filtered(record: Accelerogram, processing: Processing) -> Accelerogram:
    values = record.acceleration
    steps = []
    if processing.taper:
        length = max(1, int(processing.taper * values.size))
        ramp = 0.5 * (1 - np.cos(np.pi * np.arange(length) / length))
        window = np.concatenate([ramp, np.ones(values.size - length)])
        values = values * np.minimum(window, window[::-1])
        steps.append(f"Cosine taper over {processing.taper:.3g} of the record at each end.")
    lowest = processing.high_pass or processing.low_pass
    pad = _room(processing.order, lowest, record) if lowest else 0
    if pad:
        values = np.pad(values, pad)
        steps.append(f"{pad} zeros before and after while filtering.")
    for kind, corner in (("highpass", processing.high_pass), ("lowpass", processing.low_pass)):
        if corner:
            values = _butterworth(values, record.time_step, kind, corner, processing.order, 0)
            run = f"of order {processing.order}, run both ways, corner {corner:g} Hz"
            steps.append(f"Acausal Butterworth {kind} {run}.")
    initial: dict[str, float] = {}
    if pad:
        # A filter that is run both ways moves the ground before the record; without that, displacement would drift.
        speed = integral(values, record.time_step)
        initial["initial_velocity"] = float(speed[pad])
        initial["initial_displacement"] = float(integral(speed, record.time_step)[pad])
        values = values[pad:-pad]
    if not steps:
        return record
    highest = max(processing.high_pass or 0, record.high_pass_frequency or 0) or None
    return record.processed_by(values, " ".join(steps), high_pass_frequency=highest, **initial)


def _room(order: int, corner: float, record: Accelerogram) -> int:
    """Samples over which a filter rings, 1.5 order/corner seconds (Boore 2005), at most ten times the record."""
    return int(np.ceil(min(1.5 * order / corner, 10 * record.duration) / record.time_step))


def _butterworth(
    values: np.ndarray, time_step: float, kind: str, corner: float, order: int, margin: int
) -> np.ndarray:
    """Return `values` (n,) run both ways through a Butterworth filter, its end values continued over `margin` samples.

    The spectrum is multiplied by the square of the gain of one run, 1/√(1 + (tan πfΔt / tan πf_cΔt)^±2 order) by the
    bilinear transform, without a phase (Oppenheim & Schafer 2010, section 7.2).
    """
    nyquist = 0.5 / time_step
    if not corner < nyquist:
        raise RecordError(
            f"the {kind} corner is {corner!r} Hz, but must be below {nyquist:g} Hz (Nyquist).",
            **{kind: corner},
        )
    whole = np.pad(values, margin, mode="edge")
    count = fast_length(whole.size)
    frequencies = np.fft.rfftfreq(count, time_step)
    ratio = np.tan(np.pi * frequencies * time_step) / np.tan(np.pi * corner * time_step)
    with np.errstate(divide="ignore", over="ignore"):
        gain = 1 / (1 + ratio ** (-2 * order if kind == "highpass" else 2 * order))
    filtered = np.fft.irfft(np.fft.rfft(whole, count) * gain, count)
    return np.asarray(filtered[margin : margin + values.size])


def fast_length(count: int) -> int:
    """Return a number of samples from `count` on, at most a quarter more, with no prime factor above 5.

    A Fourier transform is fast at such a number, and takes some six times as long at a prime one.
    """
    return min(base << (-(-count // base) - 1).bit_length() for base in (1, 3, 5, 9, 15))


def _resampled(record: Accelerogram, processing: Processing) -> Accelerogram:
    step = processing.time_step
    if step is None or abs(step / record.time_step - 1) < 1e-12:
        return record
    number = int(record.duration / step * (1 + 1e-12)) + 1
    if not 2 <= number <= 10_000_000:
        raise RecordError(
            f"time_step is {step!r} s, which makes {number} samples; it must make 2 to 1e7.", time_step=step
        )
    values = record.acceleration
    sentence = f"Resampled from {record.time_step:g} to {step:g} s, linear between samples."
    if step > record.time_step:
        corner = _LOW_PASS_SHARE * 0.5 / step
        margin = _room(8, corner, record)
        values = _butterworth(values, record.time_step, "lowpass", corner, 8, margin)
        sentence = f"Low-passed at {corner:g} Hz against aliasing. {sentence}"
    even = np.interp(np.arange(number) * step, record.times, values)
    return record.processed_by(even, sentence, time_step=step)


_CANDIDATES = 20  # places at which shaking may end
_DEGREES = (1, 2)  # of the polynomial after each
_FEWEST = 64  # samples of the record, at least: fewer say nothing of a drift
_LEFT = 16  # samples after shaking, at least


def adaptive_baseline(acceleration: np.ndarray, time_step: float) -> tuple[np.ndarray, str]:
    """Return (corrected acceleration (n,), the sentence that says what was removed).

    After the PRISM processing of the U.S. Geological Survey (Jones, Kalkan & Stephens 2017, OFR 2017-1008): a line is
    fitted to the velocity before shaking, a polynomial of low degree to that after it, and a smooth bridge joins the
    two; the acceleration of that drift is subtracted.

    Onset and end of shaking are where 0.1 % and 95 % of the squared acceleration have passed; the end is moved among
    20 places up to 85 % of what remains, each tried with degrees 1 and 2; the drift that leaves the smallest
    displacement wins. At least 8 samples are taken as rest before the onset, and 16 as shaking; where fewer than 16 are
    left after it, the record stays as it is. Raises RecordError for fewer than 64 samples or a record without motion.
    """
    if (size := acceleration.size) < _FEWEST or not np.any(acceleration):
        raise RecordError(
            f"the adaptive baseline needs motion and at least {_FEWEST} samples, got {size}.", samples=size
        )
    velocity = integral(acceleration, time_step)
    share = np.cumsum(acceleration**2)
    onset = max(8, int(np.searchsorted(share, 1e-3 * share[-1])))
    strong = max(onset + 16, int(np.searchsorted(share, 0.95 * share[-1])))
    if strong > acceleration.size - _LEFT:
        return acceleration, "Adaptive baseline left the record as it is: shaking lasts to its end."
    last = min(strong + int(0.85 * (acceleration.size - strong)), acceleration.size - _LEFT)
    ends = np.unique(np.linspace(strong, last, _CANDIDATES).astype(int)).tolist()

    least = np.inf
    for candidate in _drifts(velocity, onset, ends):
        # A drift that is left makes the displacement larger than the ground's own.
        course = np.cumsum(velocity - candidate[2])
        largest = max(course.max(), -course.min())
        if largest < least:
            least = largest
            end, degree, drift = candidate
    sentence = (
        f"Adaptive baseline: drift of velocity fitted before {onset * time_step:g} s and after {end * time_step:g} s "
        f"(degree {degree}), bridged between, and its acceleration removed."
    )
    return acceleration - np.gradient(drift, time_step), sentence


def _drifts(velocity: np.ndarray, onset: int, ends: Sequence[int]) -> Iterator[tuple[int, int, np.ndarray]]:
    """Yield end, degree and drift (n,): a line to the onset, a polynomial from the end, a cubic bridge between."""
    before, slope = _polynomials(velocity[:onset])[0]
    height = before[-1] + slope
    for end in ends:
        width = end - onset
        s = np.arange(width) / width
        start = (1 + 2 * s) * (1 - s) ** 2 * height + s * (1 - s) ** 2 * (slope * width)
        for degree, (after, rise) in zip(_DEGREES, _polynomials(velocity[end:]), strict=True):
            bridge = start + s**2 * (3 - 2 * s) * after[0] + s**2 * (s - 1) * width * rise
            yield end, degree, np.concatenate([before, bridge, after])


def _polynomials(values: np.ndarray) -> list[tuple[np.ndarray, float]]:
    """Return the least-squares polynomial of each degree through `values` (k,), and its slope there, per sample."""
    # In Legendre's polynomials of these places, which are orthogonal, a degree only adds its own term.
    x = np.linspace(-1, 1, values.size)
    square = (x * x).sum()  # sums, because a dot product of many samples wakes a thread on every core
    bow = x * x - square / x.size
    first = float((x * values).sum() / square)
    second = float((bow * values).sum() / (bow * bow).sum())
    line = values.mean() + first * x
    per_sample = 2 / (x.size - 1)
    return [(line, first * per_sample), (line + second * bow, (first - 2 * second) * per_sample)]
