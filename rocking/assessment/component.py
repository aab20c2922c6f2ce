"""Component: one horizontal component of a record as it acts, with its pulses and the pair that it belongs to."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from rocking.assessment.settings import PredictingPulse
from rocking.errors import PulseError, RecordError
from rocking.floors.support import Support
from rocking.pulses import (
    PULSE_METHODS,
    PulseAnalysis,
    PulseEvidence,
    VelocityPulse,
    extract_pulses,
    velocity_pulse,
)
from rocking.records import Accelerogram, RotD, rotd
from rocking.records.rotation import azimuth_of_axis
from rocking.remarks import Remark


@dataclass(frozen=True)
class HorizontalMotion:
    """The motion of a pair of horizontal components, or of one that stands alone.

    velocity_pulse: None where the motion is still or too short for one. velocity_pulse_azimuth: of its axis, degrees
    clockwise from north in [0, 180); None where a component does not state its own. rotd: None of one component alone.
    """

    velocity_pulse: VelocityPulse | None = None
    velocity_pulse_azimuth: float | None = None
    rotd: RotD | None = None


@dataclass(frozen=True, eq=False)
class Component:
    """One horizontal component of a record as it acts.

    vertical: the component that acts with it, with the same samples; None where none does. motion: of the pair that it
    belongs to, or of itself alone. analysis: None where no pulse could be sought. candidates: the pulses that the
    chosen method offers for prediction, none where it fails. failure: why, in a sentence; "" where nothing failed.
    support: on which this is the motion. ground: the same component of the ground. Both None on the ground itself.
    """

    accelerogram: Accelerogram
    vertical: Accelerogram | None
    motion: HorizontalMotion
    analysis: PulseAnalysis | None
    candidates: tuple[PulseEvidence, ...]
    failure: str = ""
    support: Support | None = None
    ground: "Component | None" = None

    @property
    def name(self) -> str:
        """The name of the component."""
        return self.accelerogram.component


@dataclass(frozen=True, eq=False)
class ComponentPulses:
    """The pulses of one component without its samples, as a store keeps them; no pulse without `ranked`."""

    motion: HorizontalMotion
    ranked: tuple[PulseEvidence, ...]
    sequence: tuple[PulseEvidence, ...]
    flags: tuple[Remark, ...]
    band: tuple[float, float]
    candidates: tuple[PulseEvidence, ...]
    failure: str

    @classmethod
    def of(cls, component: Component) -> "ComponentPulses":
        """Return the pulses of a component."""
        analysis = component.analysis
        return cls(
            motion=component.motion,
            ranked=analysis.ranked if analysis else (),
            sequence=analysis.sequence if analysis else (),
            flags=analysis.flags if analysis else (),
            band=analysis.band if analysis else (0.0, 0.0),
            candidates=component.candidates,
            failure=component.failure,
        )

    def beside(self, accelerogram: Accelerogram, vertical: Accelerogram | None) -> Component:
        """Return the component again."""
        analysis = None
        if self.ranked:
            pulse = self.ranked[0].pulse.acceleration(accelerogram.times)
            residual = accelerogram.acceleration - pulse
            residual.flags.writeable = False
            analysis = PulseAnalysis(
                accelerogram, self.ranked, self.sequence, residual, self.flags, self.band
            )
        return Component(accelerogram, vertical, self.motion, analysis, self.candidates, self.failure)


def component_names(accelerograms: Sequence[Accelerogram]) -> list[str]:
    """Return the names of the components, or numbers where two have the same name or one of two has none."""
    names = [each.component for each in accelerograms]
    if len(names) > 1 and (len(set(names)) < len(names) or not all(names)):
        return [f"component {place}" for place, _ in enumerate(names, start=1)]
    return names


def component_of(
    accelerogram: Accelerogram,
    settings: PredictingPulse,
    vertical: Accelerogram | None = None,
    motion: HorizontalMotion = HorizontalMotion(),
) -> Component:
    """Return a component with its pulses. motion: of the pair that it belongs to, where it is needed."""
    analysis = None
    candidates: tuple[PulseEvidence, ...] = ()
    failure = ""
    try:
        analysis = extract_pulses(accelerogram, settings=settings)
        candidates = PULSE_METHODS[settings.choice].candidates(analysis)
    except PulseError as error:
        failure = str(error)
    return Component(accelerogram, vertical, motion, analysis, candidates, failure)


def horizontal_motions(accelerograms: Sequence[Accelerogram]) -> list[HorizontalMotion]:
    """Return the motion that each of the horizontal components of a record belongs to.

    Two components that share time step and start are a pair; fewer, more or others stand each alone.
    """
    if len(accelerograms) == 2:
        first, second = accelerograms
        with suppress(RecordError):  # two that do not belong together stand alone
            pair = _motion(first, second, rotd(first, second))
            return [pair, pair]
    return [_motion(accelerogram) for accelerogram in accelerograms]


def _motion(
    first: Accelerogram, second: Accelerogram | None = None, peaks: RotD | None = None
) -> HorizontalMotion:
    try:
        pulse = velocity_pulse(first, second)
    except PulseError:  # the motion holds none, which is no failure of the record
        return HorizontalMotion(rotd=peaks)
    azimuth = first.azimuth
    if second is not None:
        azimuth = azimuth_of_axis(first.azimuth, second.azimuth, pulse.orientation)
    return HorizontalMotion(pulse, None if azimuth is None else azimuth % 180, peaks)
