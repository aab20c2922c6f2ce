"""What the horizontal components of a record are known by together: velocity pulse and peaks of any direction."""

from collections.abc import Sequence
from dataclasses import dataclass

from rocking.errors import PulseError, RecordError
from rocking.pulses import Pulse, VelocityPulse, azimuth_of_axis, velocity_pulse
from rocking.records import Accelerogram, RotD, rotd


@dataclass(frozen=True)
class HorizontalMotion:
    """The motion of a pair of horizontal components, or of one that stands alone.

    velocity_pulse: None where the motion is still or too short for one. azimuth: of its axis, degrees clockwise from
    north in [0, 180), where the components know theirs. rotd: None of one component alone.
    """

    velocity_pulse: VelocityPulse | None
    azimuth: float | None
    rotd: RotD | None

    def is_unlike(self, sine: Pulse | None) -> bool | None:
        """Whether T_p and the period of `sine` differ by more than a factor 2; None where one of them is missing."""
        return None if sine is None or self.velocity_pulse is None else self.velocity_pulse.is_unlike(sine)


def horizontal_motions(accelerograms: Sequence[Accelerogram]) -> list[HorizontalMotion]:
    """Return the motion that each of the horizontal components of a record belongs to.

    Two components that share time step and start are a pair; fewer, more or others stand each alone.
    """
    if len(accelerograms) == 2:
        first, second = accelerograms
        try:
            pair = _motion(first, second, rotd(first, second))
        except RecordError:  # two that do not belong together
            pass
        else:
            return [pair, pair]
    return [_motion(accelerogram) for accelerogram in accelerograms]


def _motion(
    first: Accelerogram, second: Accelerogram | None = None, peaks: RotD | None = None
) -> HorizontalMotion:
    try:
        pulse = velocity_pulse(first, second)
    except PulseError:  # the motion holds none, which is no failure of the record
        return HorizontalMotion(None, None, peaks)
    azimuth = (
        first.azimuth if second is None else azimuth_of_axis(first.azimuth, second.azimuth, pulse.orientation)
    )
    return HorizontalMotion(pulse, None if azimuth is None else azimuth % 180, peaks)
