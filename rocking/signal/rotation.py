"""Rotation: a horizontal pair seen from another direction, and its vertical component on the same samples."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import finite, instance
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.kinds import SignalKind
from rocking.warnings import RockingWarning

_FLATTEST = np.sin(np.radians(30.0))


@dataclass(frozen=True, kw_only=True)
class RotD:
    """Peak accelerations over all directions (Boore 2010), m/s²: median and largest, and the azimuth of the largest.

    Parameters
    ----------
    rotd50 : float
        Median of the peak accelerations over all directions, m/s².
    rotd100 : float
        Largest of them, m/s².
    azimuth : float
        Direction of the largest, degrees clockwise from north in [0, 180), or from the first component where
        azimuths are unknown.

    Examples
    --------
    >>> rocking.RotD(rotd50=2.0, rotd100=2.5, azimuth=30.0).rotd100
    2.5
    """

    rotd50: float
    rotd100: float
    azimuth: float


def rotate(first: Accelerogram, second: Accelerogram, angle: float) -> Accelerogram:
    """Return the horizontal motion along an axis at `angle`, rad, from the first component towards the second.

    The components have one time step and one start, and are taken as orthogonal; the longer is cut to the shorter.
    Raises RecordError when they do not fit together.
    """
    a, b = paired(first, second)
    angle = finite(RecordError, "angle", angle, "rad")
    shares = np.cos(angle), np.sin(angle)
    one = first.component or "one"
    degrees = np.degrees(angle)
    sentence = (
        f"Rotated by {degrees:.2f}° from component {one} towards component {second.component or 'two'}."
    )
    changes: dict[str, Any] = {"component": f"{degrees:.0f}° from {one}"}
    changes["azimuth"] = azimuth_of_axis(first=first.azimuth, second=second.azimuth, angle=angle)
    short, long = sorted((first.acceleration.size, second.acceleration.size))
    cut = [RockingWarning.of(SignalKind.CUT_TO_THE_SHORTER, short=short, long=long)] if short < long else []
    warnings = dict.fromkeys((*first.warnings, *second.warnings, *cut))
    changes["warnings"] = tuple(warnings)
    for name in ("initial_velocity", "initial_displacement"):
        changes[name] = shares[0] * getattr(first, name) + shares[1] * getattr(second, name)
    return first.processed_by(shares[0] * a + shares[1] * b, sentence, **changes)


def azimuth_of_axis(*, first: float | None, second: float | None, angle: float) -> float | None:
    """Return the azimuth of an axis at `angle` [rad] from the first component; None unless they are square, to 1°."""
    if first is None or second is None:
        return None
    apart = (second - first) % 360
    if abs(min(apart, 360 - apart) - 90) > 1:
        return None
    return float((first + np.degrees(angle) * (1 if apart < 180 else -1)) % 360)


def rotd(first: Accelerogram, second: Accelerogram, step: float = 1.0) -> RotD:
    """Return RotD50 and RotD100 of peak acceleration over directions `step` degrees apart.

    Components without azimuths are taken as orthogonal.

    Parameters
    ----------
    first : Accelerogram
        One horizontal component.
    second : Accelerogram
        The other, sample by sample.
    step : float, default 1.0
        Angle between two directions, degrees.

    Returns
    -------
    RotD
        Median and largest peak over all directions.

    Examples
    --------
    >>> north, across, up = rocking.read("records/20161113_110259_WTMC_20.V2A")
    >>> round(rocking.rotd(north, across).rotd100, 1)
    9.9
    """
    if not 0 < step <= 90:
        raise RecordError(f"step is {step!r} degrees, but must be above 0 and at most 90.", step=step)
    a, b = paired(first, second)
    if first.azimuth is not None and second.azimuth is not None:
        one, two = np.radians([first.azimuth, second.azimuth])
        base = np.sin(two - one)
        if abs(base) < _FLATTEST:
            azimuths = f"{first.azimuth:g}° and {second.azimuth:g}°"
            raise RecordError(
                f"the azimuths are {azimuths}, but must differ by 30° or more.",
                azimuth=(first.azimuth, second.azimuth),
            )
        axes = np.radians([0.0, 90.0])
        a, b = (np.sin(two - axis) / base * a + np.sin(axis - one) / base * b for axis in axes)
    angles = np.arange(0.0, 180.0, step)
    peaks = np.array([np.abs(a * np.cos(t) + b * np.sin(t)).max() for t in np.radians(angles)])
    return RotD(
        rotd50=float(np.median(peaks)), rotd100=float(peaks.max()), azimuth=float(angles[peaks.argmax()])
    )


def paired(first: Accelerogram, second: Accelerogram) -> tuple[np.ndarray, np.ndarray]:
    """Return both accelerations, m/s², over the samples they share. Raises RecordError where they do not fit."""
    instance(RecordError, "the first component", first, Accelerogram)
    instance(RecordError, "the second component", second, Accelerogram)
    if abs(first.time_step / second.time_step - 1) > 1e-9:
        steps = f"time_step is {first.time_step!r} s and {second.time_step!r} s"
        raise RecordError(
            f"{steps}, but must be one; resample first.", time_step=(first.time_step, second.time_step)
        )
    if first.vertical or second.vertical:
        raise RecordError("a component is vertical, but both must be horizontal.", vertical=True)
    if first.start_time and second.start_time and first.start_time != second.start_time:
        starts = f"{first.start_time} and {second.start_time}"
        raise RecordError(
            f"the components start at {starts}, but must start together.",
            start_time=(first.start_time, second.start_time),
        )
    n = min(first.acceleration.size, second.acceleration.size)
    return first.acceleration[:n], second.acceleration[:n]


def aligned(vertical: Accelerogram, horizontal: Accelerogram) -> Accelerogram:
    """Return `vertical` with as many samples as `horizontal`: cut, or still after its end.

    Raises RecordError when their time steps differ by more than rounding.
    """
    if not np.isclose(vertical.time_step, horizontal.time_step, rtol=1e-9, atol=0):
        steps = f"time_step of the vertical component is {vertical.time_step!r} s"
        raise RecordError(
            f"{steps}, but the horizontal one has {horizontal.time_step!r} s; resample one of them.",
            time_step=vertical.time_step,
        )
    size = horizontal.acceleration.size
    samples = vertical.acceleration[:size]
    samples = np.pad(samples, (0, size - samples.size))
    return replace(vertical, acceleration=samples, time_step=horizontal.time_step)
