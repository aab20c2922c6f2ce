"""The components of one station: a horizontal pair seen from another direction, and the vertical one beside it."""

from dataclasses import dataclass, replace

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import finite
from rocking.records.accelerogram import Accelerogram

_FLATTEST = np.sin(np.radians(30.0))


@dataclass(frozen=True)
class RotD:
    """Peak accelerations over all directions (Boore 2010), m/s²: median and largest, and the azimuth of the largest.

    azimuth: degrees clockwise from north in [0, 180), or from the first component where azimuths are unknown.

    >>> rocking.RotD(rotd50=2.0, rotd100=2.5, azimuth=30.0).rotd100
    2.5
    """

    rotd50: float
    rotd100: float
    azimuth: float


def rotate(first: Accelerogram, second: Accelerogram, azimuth: float) -> Accelerogram:
    """Return the horizontal motion along `azimuth` (degrees clockwise from north), from two components.

    The components need known azimuths at least 30° apart, one time step and one start; the longer is cut to the
    shorter. They need not be orthogonal.
    Raises RecordError when they do not fit together.
    """
    azimuth = finite(RecordError, "azimuth", azimuth, "degrees")
    if first.azimuth is None or second.azimuth is None:
        raise RecordError(
            "a component has no known azimuth; give one with dataclasses.replace(record, azimuth=...)."
        )
    a, b = _paired(first, second)
    one, two, wanted = np.radians([first.azimuth, second.azimuth, azimuth])
    base = np.sin(two - one)
    if abs(base) < _FLATTEST:
        raise RecordError(
            f"the azimuths are {first.azimuth:g}° and {second.azimuth:g}°, but must differ by 30° or more."
        )
    shares = np.sin(two - wanted) / base, np.sin(wanted - one) / base
    motion = shares[0] * a + shares[1] * b
    sentence = (
        f"Rotated from {first.azimuth:g}° and {second.azimuth:g}° to {azimuth:g}° clockwise from north."
    )
    short, long = sorted((first.acceleration.size, second.acceleration.size))
    cut = f"The components hold {short} and {long} samples; the longer was cut to the shorter."
    warnings = dict.fromkeys((*first.warnings, *second.warnings, *([cut] if short < long else [])))
    turned = {"component": f"{azimuth:g}", "azimuth": azimuth % 360, "warnings": tuple(warnings)}
    for name in ("initial_velocity", "initial_displacement"):
        turned[name] = shares[0] * getattr(first, name) + shares[1] * getattr(second, name)
    return first.processed_by(motion, sentence, **turned)


def rotd(first: Accelerogram, second: Accelerogram, step: float = 1.0) -> RotD:
    """Return RotD50 and RotD100 of peak acceleration over directions `step` degrees apart.

    Components without azimuths are taken as orthogonal.

    >>> north, across, up = rocking.read("records/20161113_110259_WTMC_20.V2A")
    >>> round(rocking.rotd(north, across).rotd100, 1)
    9.9
    """
    if not 0 < step <= 90:
        raise RecordError(f"step is {step!r} degrees, but must be above 0 and at most 90.")
    a, b = _paired(first, second)
    if first.azimuth is not None and second.azimuth is not None:
        north, east = rotate(first, second, 0.0), rotate(first, second, 90.0)
        a, b = north.acceleration, east.acceleration
    angles = np.arange(0.0, 180.0, step)
    peaks = np.array([np.abs(a * np.cos(t) + b * np.sin(t)).max() for t in np.radians(angles)])
    return RotD(float(np.median(peaks)), float(peaks.max()), float(angles[peaks.argmax()]))


def _paired(first: Accelerogram, second: Accelerogram) -> tuple[np.ndarray, np.ndarray]:
    if abs(first.time_step / second.time_step - 1) > 1e-9:
        raise RecordError(
            f"time_step is {first.time_step!r} s and {second.time_step!r} s, but must be one; resample first."
        )
    if first.vertical or second.vertical:
        raise RecordError("a component is vertical, but both must be horizontal.")
    if first.start_time and second.start_time and first.start_time != second.start_time:
        raise RecordError(
            f"the components start at {first.start_time} and {second.start_time}, but must start together."
        )
    n = min(first.acceleration.size, second.acceleration.size)
    return first.acceleration[:n], second.acceleration[:n]


def aligned(vertical: Accelerogram, horizontal: Accelerogram) -> Accelerogram:
    """Return `vertical` with as many samples as `horizontal`: cut, or still after its end.

    Raises RecordError when their time steps differ by more than rounding.
    """
    if not np.isclose(vertical.time_step, horizontal.time_step, rtol=1e-9, atol=0):
        raise RecordError(
            f"time_step of the vertical component is {vertical.time_step!r} s, but must equal that of the horizontal "
            f"one, {horizontal.time_step!r} s; resample one of them."
        )
    size = horizontal.acceleration.size
    samples = np.zeros(size)
    kept = min(size, vertical.acceleration.size)
    samples[:kept] = vertical.acceleration[:kept]
    return replace(vertical, acceleration=samples, time_step=horizontal.time_step)
