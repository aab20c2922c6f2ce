"""One record against one list of structures: predictions, integrations, and the two side by side."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from time import process_time

from rocking.checks import within
from rocking.errors import ConfigurationError, PulseError, RockingError
from rocking.motion import Response, integrate
from rocking.outcome import Outcome
from rocking.pulses import Light, Pulse, PulseAnalysis, PulseSettings, extract_pulses, light
from rocking.records import Accelerogram
from rocking.sine_pulse import Maximum, predict_maximum, printed_maximum
from rocking.structures import EquivalentBlock, Mechanism, Structure
from rocking.units import GRAVITY


class Method(StrEnum):
    """How a largest rotation was computed."""

    PRINTED = "printed"
    CLOSED_FORM = "closed form"
    BLOCK_ON_PULSE = "block on pulse"
    BLOCK_ON_RECORD = "block on record"
    MECHANISM_ON_PULSE = "mechanism on pulse"
    MECHANISM_ON_RECORD = "mechanism on record"


@dataclass(frozen=True)
class AssessmentSettings:
    """What a comparison is made with.

    acceleration_scale: which scale the equivalent block carries. tolerance: of the nonlinear integration.
    fragility_change: relative change of the ground motion that must not flip a verdict.
    """

    acceleration_scale: str = "mean"
    tolerance: float = 1e-6
    fragility_change: float = 0.01
    pulse: PulseSettings = field(default_factory=PulseSettings)

    def __post_init__(self) -> None:
        within(ConfigurationError, "tolerance", self.tolerance, 1e-13, 0.1)
        within(ConfigurationError, "fragility_change", self.fragility_change, 0, 0.5)


@dataclass(frozen=True)
class Prediction:
    """The closed forms of one structure under the dominant pulse, and how far to trust them."""

    block: EquivalentBlock
    amplitude_ratio: float
    frequency_ratio: float
    printed: float
    maximum: Maximum
    low: float
    high: float
    light: Light


@dataclass(frozen=True)
class Case:
    """One structure under one accelerogram. prediction is None where the record has no pulse."""

    structure: str
    mechanism: Mechanism
    prediction: Prediction | None
    responses: Mapping[Method, Response]


@dataclass(frozen=True)
class Failure:
    """Something that gave no result: at which stage, for which structure ("" for all), and why."""

    stage: str
    structure: str
    message: str


@dataclass(frozen=True)
class Assessment:
    """One accelerogram against all structures. analysis is None where no pulse could be sought."""

    accelerogram: Accelerogram
    analysis: PulseAnalysis | None
    cases: tuple[Case, ...]
    failures: tuple[Failure, ...]
    durations: Mapping[str, float]
    """CPU time of each stage, s."""


def assess(
    accelerogram: Accelerogram,
    structures: Mapping[str, Structure],
    settings: AssessmentSettings | None = None,
    vertical: Accelerogram | None = None,
) -> Assessment:
    """Predict and integrate every structure under `accelerogram`; one that fails costs no other."""
    settings = settings or AssessmentSettings()
    started = process_time()
    failures: list[Failure] = []
    analysis = None
    try:
        analysis = extract_pulses(accelerogram, settings=settings.pulse)
    except PulseError as error:
        failures.append(Failure("pulses", "", str(error)))
    extracted = process_time()
    cases = []
    for name, structure in structures.items():
        try:
            cases.append(_case(name, structure, accelerogram, analysis, settings, vertical))
        except RockingError as error:
            failures.append(Failure("responses", name, str(error)))
    durations = {"pulses": extracted - started, "responses": process_time() - extracted}
    return Assessment(accelerogram, analysis, tuple(cases), tuple(failures), durations)


def predict(block: EquivalentBlock, analysis: PulseAnalysis, pulse: Pulse | None = None) -> Prediction:
    """Return the closed forms of `block` under `pulse` (default: the dominant) with its band."""
    pulse = pulse or analysis.dominant
    amplitude_ratio = abs(pulse.amplitude) / (GRAVITY * _uplift_multiplier(block, pulse))
    ratios = [predict_maximum(block, other).rotation_ratio for other in ()]
    maximum = predict_maximum(block, pulse)
    return Prediction(
        block=block,
        amplitude_ratio=amplitude_ratio,
        frequency_ratio=pulse.circular_frequency / block.frequency_parameter,
        printed=printed_maximum(block, pulse),
        maximum=maximum,
        low=min([maximum.rotation_ratio, *ratios]),
        high=max([maximum.rotation_ratio, *ratios]),
        light=light(analysis.explained_energy, amplitude_ratio),
    )


def verdict(predicted: Outcome, integrated: Outcome) -> str:
    """Say whether a prediction errs: agree, unsafe (it says less than happens) or safe (it says more)."""
    order = [Outcome.NO_UPLIFT, Outcome.ROCKS, Outcome.OVERTURNS]
    if predicted not in order or integrated not in order:
        return "unknown"
    difference = order.index(predicted) - order.index(integrated)
    return "agree" if difference == 0 else "safe" if difference > 0 else "unsafe"


def ratio(predicted: float, integrated: float) -> float:
    """Return predicted over integrated rotation ratio where both rock, else nan."""
    both_rock = 0 < predicted < math.inf and 0 < integrated < math.inf
    return predicted / integrated if both_rock else math.nan


def _case(
    name: str,
    structure: Structure,
    accelerogram: Accelerogram,
    analysis: PulseAnalysis | None,
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
) -> Case:
    mechanism = structure.mechanism()
    block = mechanism.equivalent_block(settings.acceleration_scale)
    responses = {
        Method.MECHANISM_ON_RECORD: integrate(
            mechanism,
            accelerogram,
            tolerance=settings.tolerance,
            vertical=vertical,
            sensitivity=True,
            fragility_change=settings.fragility_change,
        ),
        Method.BLOCK_ON_RECORD: integrate(block, accelerogram, vertical=None),
    }
    if analysis is None:
        return Case(name, mechanism, None, responses)
    responses[Method.MECHANISM_ON_PULSE] = integrate(
        mechanism, analysis.dominant, tolerance=settings.tolerance
    )
    responses[Method.BLOCK_ON_PULSE] = integrate(block, analysis.dominant)
    return Case(name, mechanism, predict(block, analysis), responses)


def _uplift_multiplier(block: EquivalentBlock, pulse: Pulse) -> float:
    """λ of the side that the pulse lifts first: positive acceleration lifts the negative side."""
    side = block.other_side if block.other_side is not None and pulse.amplitude > 0 else block
    return side.uplift_multiplier
