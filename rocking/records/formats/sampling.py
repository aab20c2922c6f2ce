"""Sampling: the step of printed times, and an even step for times that are uneven."""

import numpy as np

from rocking.errors import RecordError

LARGEST_SERIES = 4_000_000
"""Samples of all channels of a file: five and a half hours at 200 Hz."""
_SMALLEST_STEP = 1e-6
_LONGEST_GAP = 5


def even_step(times: np.ndarray) -> float | None:
    """Return the step of `times` (n,) s if they are even within the rounding of their printing, else None.

    Raises RecordError when they do not increase.
    """
    if times.size < 2 or not np.all(np.isfinite(times)):
        raise RecordError(f"{times.size} finite times, but at least 2 are needed.")
    steps = np.diff(times)
    if steps.min() <= 0:
        at = int(np.flatnonzero(steps <= 0)[0])
        raise RecordError(f"time {times[at + 1]:g} s follows {times[at]:g} s, but times must increase.")
    step = (times[-1] - times[0]) / (times.size - 1)
    if step < _SMALLEST_STEP:
        raise RecordError(f"the times are {step:g} s apart, less than any recorder's {_SMALLEST_STEP:g} s.")
    off = np.abs(times - (times[0] + step * np.arange(times.size))).max()
    shifted = (times * 10.0**digits for digits in range(9))
    digits = (n for n, each in enumerate(shifted) if np.allclose(each, np.round(each), 0, 1e-4))
    quantum = 10.0 ** -next(digits, 9)
    # Half a printed digit for the time itself, and as much for the line through the rounded first and last ones. A
    # digit as coarse as the step rounds nothing: a line that is missing would pass for rounding.
    allowed = max(0.01 * step, 1.02 * quantum if quantum < 0.9 * step else 0.0) + 1e-9 * abs(times[-1])
    if off > allowed or steps.max() - step > allowed:
        return None
    return _rounded(step, quantum / times.size)


def resampled(times: np.ndarray) -> tuple[float, np.ndarray, str]:
    """Return (step, even times, the sentence that says so) for uneven `times`: linear, at their median step.

    Raises RecordError at a gap of more than five of these steps: a line across it would be no record.
    """
    step = float(f"{np.median(np.diff(times)):.6g}")
    check_no_gap(times, _LONGEST_GAP * step)
    number = int(min((times[-1] - times[0]) / step, 1e12)) + 1 if step > 0 else 0
    if not 2 <= number <= LARGEST_SERIES:
        raise RecordError(f"the times are uneven and would make {number} samples {step:g} s apart.")
    change = f"interpolated linearly to {number} at their median step, {step:g} s"
    sentence = f"The {times.size} samples are unevenly spaced; {change}."
    return step, times[0] + step * np.arange(number), sentence


def check_no_gap(times: np.ndarray, longest: float) -> None:
    """Raise RecordError when two neighbours of `times` (n,) s are more than `longest` s apart."""
    gaps = np.diff(times)
    at = int(gaps.argmax())
    if gaps[at] > longest * (1 + 1e-9):
        gap = f"no samples between {times[at]:g} and {times[at + 1]:g} s, more than {longest:g} s apart"
        raise RecordError(f"{gap}; cut the record there, a gap is not bridged.")


def _rounded(step: float, uncertainty: float) -> float:
    """Return a step derived from rounded times as a whole rate in Hz, or with few digits, if that is as likely."""
    allowed = uncertainty + 1e-12 * step
    rate = round(1 / step)
    few = (float(f"{step:.{digits}g}") for digits in range(1, 10))
    candidates = (*([1 / rate] if rate else []), *few)
    return next((candidate for candidate in candidates if abs(candidate - step) <= allowed), step)
