"""One record against one list of structures: predictions, integrations, and the two side by side."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from statistics import median
from time import process_time
from typing import Any

from rocking.assessment.ensemble import Ensemble, GroundMotions
from rocking.assessment.fidelity import Answer, cheapest_answer, estimate_from_velocity
from rocking.assessment.method import Method
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.tiers import Estimate
from rocking.assessment.variations import cracks, ensemble_over_cracks
from rocking.errors import PulseError, RockingError
from rocking.motion.integration import integrate
from rocking.motion.response import UNKNOWN, ModelCheck, Response, check_model
from rocking.pulses import (
    PULSE_METHODS,
    Pulse,
    PulseAnalysis,
    PulseEvidence,
    extract_pulses,
    predicting_pulse,
)
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.sine_pulse import Maximum, predict_maximum, printed_maximum
from rocking.structures import EquivalentBlock, Mechanism, Structure


@dataclass(frozen=True)
class Prediction:
    """The closed forms of one structure under one pulse.

    rank: of the pulse among those that its method offers.
    """

    block: EquivalentBlock
    pulse: Pulse
    rank: int
    amplitude_ratio: float
    frequency_ratio: float
    printed: float
    maximum: Maximum


@dataclass(frozen=True)
class Case:
    """One structure under one accelerogram. prediction is None where the record has no pulse.

    check: whether the model held along the response of the mechanism to the record. answer: of the mechanism on the
    record, or of the cheapest method that is trusted in its stead. ensemble: None where none was asked for.
    """

    structure: str
    mechanism: Mechanism
    prediction: Prediction | None
    responses: Mapping[Method, Response]
    check: ModelCheck
    answer: Answer
    ensemble: Ensemble | None = None
    estimate: Estimate | None = None
    """Of the share that overturns, from the peak velocity, where no ensemble ran; None of an unusual structure."""
    durations: Mapping[Method, float] = field(default_factory=dict)
    """CPU time of the methods that were compared, s."""


@dataclass(frozen=True)
class Failure:
    """Something that gave no result: at which stage, for which structure ("" for all), and why."""

    stage: str
    structure: str
    message: str


@dataclass(frozen=True)
class Assessment:
    """One accelerogram against all structures. analysis is None where no pulse could be sought.

    candidates: the pulses that the chosen method offers for prediction, none where it fails.
    """

    accelerogram: Accelerogram
    analysis: PulseAnalysis | None
    candidates: tuple[PulseEvidence, ...]
    cases: tuple[Case, ...]
    failures: tuple[Failure, ...]
    durations: Mapping[str, float]
    """CPU time of each stage, s, and of each method within the responses."""


def assess_structures(
    accelerogram: Accelerogram,
    structures: Mapping[str, Structure | Mechanism],
    settings: AssessmentSettings | None = None,
    vertical: Accelerogram | None = None,
    alone: bool = False,
) -> Assessment:
    """Predict and integrate every structure under `accelerogram`; one that fails costs no other.

    alone: whether the record has no other component, so that its ensemble decides and covers other cracks too.
    """
    settings = settings or AssessmentSettings()
    started = process_time()
    failures: list[Failure] = []
    analysis = None
    candidates: tuple[PulseEvidence, ...] = ()
    try:
        analysis = extract_pulses(accelerogram, settings=settings.pulse)
        candidates = PULSE_METHODS[settings.pulse.choice].candidates(analysis)
    except PulseError as error:
        failures.append(Failure("pulses", "", str(error)))
    extracted = process_time()
    cases = []
    for name, structure in structures.items():
        try:
            cases.append(_case(name, structure, candidates, accelerogram, settings, vertical, alone))
        except RockingError as error:
            failures.append(Failure("responses", name, str(error)))
    durations = {"pulses": extracted - started, "responses": process_time() - extracted}
    for method in Method:
        if spent := [case.durations[method] for case in cases if method in case.durations]:
            durations[method] = len(spent) * median(spent)  # the first case of a process loads compiled code
    return Assessment(accelerogram, analysis, candidates, tuple(cases), tuple(failures), durations)


def predict(
    mechanism: Mechanism,
    candidates: Sequence[PulseEvidence],
    settings: AssessmentSettings | None = None,
) -> Prediction:
    """Return the closed forms of the equivalent block of `mechanism` under the candidate of largest demand.

    candidates: as a pulse method offers them.
    """
    settings = settings or AssessmentSettings()
    block = mechanism.equivalent_block(settings.acceleration_scale)

    def demand(pulse: Pulse) -> float:
        return predict_maximum(block, pulse).rotation_ratio

    chosen = predicting_pulse(candidates, demand)
    pulse = chosen.pulse
    amplitude_ratio = abs(pulse.amplitude) / (GRAVITY * _uplift_multiplier(block, pulse))
    return Prediction(
        block=block,
        pulse=pulse,
        rank=candidates.index(chosen) + 1,
        amplitude_ratio=amplitude_ratio,
        frequency_ratio=pulse.circular_frequency / block.frequency_parameter,
        printed=printed_maximum(block, pulse),
        maximum=predict_maximum(block, pulse),
    )


def _case(
    name: str,
    structure: Structure | Mechanism,
    candidates: Sequence[PulseEvidence],
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
    alone: bool,
) -> Case:
    mechanism = structure if isinstance(structure, Mechanism) else structure.mechanism()
    prediction, durations = None, {}
    if candidates:
        mechanism.equivalent_block(
            settings.acceleration_scale
        )  # kept by the mechanism: no time of the closed form
        started = process_time()
        prediction = predict(mechanism, candidates, settings)
        durations[Method.CLOSED_FORM] = process_time() - started
    if settings.fidelity == "full":
        answer, responses, spent = _compared(mechanism, record, prediction, settings, vertical)
        durations |= spent
    else:
        answer, responses = _cheapest(structure, mechanism, record, settings, vertical)
    on_record = responses.get(Method.MECHANISM_ON_RECORD)
    check = UNKNOWN
    if on_record is not None and isinstance(structure, Structure):
        check = check_model(structure, on_record, record, vertical)
    sure = None
    if settings.ensemble.members and answer.method is Method.MECHANISM_ON_RECORD:
        # Of two components the ensemble over their directions decides, so that theirs need not try every crack.
        covered = structure if alone or settings.fidelity == "auto" else cracks(structure)[0][1]
        sure = ensemble_over_cracks(
            covered,
            GroundMotions.of(record, vertical, processing=settings.ensemble.processing),
            settings,
            nominal=answer.rotation_ratio,
            verdict_only=settings.fidelity == "auto",
        )
    estimate = estimate_from_velocity(mechanism, record) if sure is None and vertical is None else None
    return Case(name, mechanism, prediction, responses, check, answer, sure, estimate, durations)


def _compared(
    mechanism: Mechanism,
    record: Accelerogram,
    prediction: Prediction | None,
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
) -> tuple[Answer, dict[Method, Response], dict[Method, float]]:
    """Every method, and the CPU time [s] of each; the mechanism on the record answers."""
    responses: dict[Method, Response] = {}
    durations: dict[Method, float] = {}

    def follow(
        method: Method, moved: Mechanism | EquivalentBlock, motion: Accelerogram | Pulse, **more: Any
    ) -> None:
        started = process_time()
        responses[method] = integrate(moved, motion, settings.tolerance, **more)
        durations[method] = process_time() - started

    block = mechanism.equivalent_block(settings.acceleration_scale)
    follow(Method.MECHANISM_ON_RECORD, mechanism, record, history=True, vertical=vertical)
    follow(Method.BLOCK_ON_RECORD, block, record, vertical=vertical)
    if prediction is not None:
        follow(Method.MECHANISM_ON_PULSE, mechanism, prediction.pulse)
        follow(Method.BLOCK_ON_PULSE, prediction.block, prediction.pulse)
    whole = responses[Method.MECHANISM_ON_RECORD]
    answer = Answer(Method.MECHANISM_ON_RECORD, whole.rotation_ratio, whole.outcome, whole)
    return answer, responses, durations


def _cheapest(
    structure: Structure | Mechanism,
    mechanism: Mechanism,
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
) -> tuple[Answer, dict[Method, Response]]:
    """What settles the verdict with the least work, and the response of the mechanism where it took part.

    Where other cracks may form, nothing cheaper than the mechanism settles it unless all of them rest, or stand by
    their peak velocities.
    """
    risk, first = settings.fidelity_risk, mechanism
    if len(may_form := cracks(structure)) > 1:
        first = may_form[0][1]
        estimates = (estimate_from_velocity(each, record) for _, each in may_form)
        if not all(each is not None and each.high <= risk for each in estimates):
            risk = 0.0
    answer = cheapest_answer(
        first,
        record,
        risk=risk,
        tolerance=settings.tolerance,
        vertical=vertical,
        history=True,
        ensemble_follows=settings.ensemble.members > 0,
    )
    if answer.method is Method.MECHANISM_ON_RECORD and first is not mechanism:
        whole = integrate(mechanism, record, settings.tolerance, history=True, vertical=vertical)
        answer = replace(answer, rotation_ratio=whole.rotation_ratio, outcome=whole.outcome, response=whole)
    return answer, {} if answer.response is None else {Method.MECHANISM_ON_RECORD: answer.response}


def _uplift_multiplier(block: EquivalentBlock, pulse: Pulse) -> float:
    """λ of the side that the pulse lifts first: positive acceleration lifts the negative side."""
    side = block.other_side if block.other_side is not None and pulse.amplitude > 0 else block
    return side.uplift_multiplier
