"""One case: one structure under one motion, predicted, integrated and followed by its ensemble and its contacts.

What a store may keep is computed from its inputs (`inputs.py`) and nothing else.
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from time import process_time

from rocking.assessment.case import CaseResult, Failure, Prediction, Variation
from rocking.assessment.cracks import crack_named, cracks, ensemble_over_cracks
from rocking.assessment.evidence import gathered
from rocking.assessment.evidence.asked import Asked
from rocking.assessment.falls import reserve
from rocking.assessment.inputs import CaseInputs, PairInputs, PredictionInputs, PulseInputs, ReserveInputs
from rocking.assessment.methods import BOTH_COMPONENTS, Method
from rocking.assessment.motions import (
    AS_IT_IS,
    ComponentPulses,
    GroundMotions,
    HorizontalMotion,
    Motion,
    ground_motions,
    horizontal_motions,
    processed,
    pulses_of,
)
from rocking.assessment.reserve import Reserve
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.integration import Members, integrate, integrate_members, strict
from rocking.motion.response import Response, check_model
from rocking.motion.table import forcing_of
from rocking.pulses import Pulse, PulseEvidence, predicting_pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_as_printed, predict_maximum
from rocking.structures import Mechanism, Outcome, Structure


@dataclass
class Clock:
    """The CPU time of each stage, s, added up."""

    durations: dict[str, float] = field(default_factory=lambda: defaultdict(float))

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Add the CPU time of what is done within to that of a stage."""
        started = process_time()
        try:
            yield
        finally:
            self.durations[name] += process_time() - started

    def add(self, durations: Mapping[str, float]) -> None:
        """Add what was measured elsewhere, also in the run that computed what a store has kept."""
        for name, duration in durations.items():
            self.durations[name] += duration


def predict(
    mechanism: Mechanism, candidates: Sequence[PulseEvidence], settings: AssessmentSettings | None = None
) -> Prediction | None:
    """Return the closed forms of the equivalent block of `mechanism` under the candidate of largest demand.

    candidates: as a pulse method offers them. None without one, and of what cannot overturn.
    """
    # The block of what cannot overturn would: it says nothing of it.
    if not (candidates and mechanism.can_overturn):
        return None
    settings = settings or AssessmentSettings()
    block = mechanism.equivalent_block(settings.acceleration_scale)
    chosen = predicting_pulse(candidates, lambda pulse: predict_maximum(block, pulse).rotation_ratio)
    pulse = chosen.pulse
    return Prediction(
        block=block,
        pulse=pulse,
        pulse_rank=candidates.index(chosen) + 1,
        maximum=predict_maximum(block, pulse),
        printed=predict_as_printed(mechanism, pulse),
    )


def compute_prediction(inputs: PredictionInputs, clock: Clock) -> Prediction:
    """Return the closed forms of a structure that can overturn, under one of the candidates."""
    settings = AssessmentSettings(acceleration_scale=inputs.acceleration_scale)
    with clock.stage(Method.CLOSED_FORM):
        found = predict(inputs.structure.mechanism(), inputs.candidates, settings)
    assert found is not None
    return found


def compute_case(inputs: CaseInputs, clock: Clock | None = None) -> CaseResult:
    """Return what comes of one structure under one motion, and with other cracks and processings where asked for.

    Where it cannot be followed, the case says why. The closed form is not kept in it, as a pulse gives it at once.
    clock: takes the time of each stage, and of each method that is compared.
    """
    clock = clock or Clock()
    if len(inputs.motion.components) == 2:
        with clock.stage("directions"):
            return _over_directions(inputs)
    with clock.stage("responses"):
        case = _under_component(inputs, clock)
    with clock.stage("variations"):
        return _with_variations(case, inputs)


# The order in which a case is decided, and where it may end early.
def _under_component(inputs: CaseInputs, clock: Clock) -> CaseResult:
    """The case under one component."""
    structure = inputs.structure
    settings = inputs.settings
    record = inputs.accelerogram
    vertical = inputs.vertical
    try:
        mechanism = structure.mechanism()
        first = cracks(structure).counting[0].mechanism
        at_rest = settings.fidelity == "quick" and stays_at_rest(first, record, vertical)
        responses = {Method.MECHANISM_ON_RECORD: _STILL} if at_rest else _integrated(mechanism, inputs, clock)
        check = check_model(structure, responses[Method.MECHANISM_ON_RECORD], record, vertical)
        case = CaseResult(component=record.component, responses=responses, check=check)
        if not inputs.alone:
            return case
        motions = ground_motions(inputs.motion, settings.ensemble.processing)
        if settings.ensemble.members and not at_rest:
            case = replace(case, ensembles=ensemble_over_cracks(structure, motions, settings))
        return gathered(Asked(case, structure, motions, settings, check.bounces))
    except RockingError as error:
        return CaseResult(component=record.component, failures=(Failure("responses", str(error)),))


_STILL = Response(rotation_ratio=0.0, outcome=Outcome.NO_UPLIFT)
"""Of a structure that the ground never lifts, exactly."""


def stays_at_rest(
    mechanism: Mechanism, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> bool:
    """Whether the ground never reaches the uplift acceleration, whatever its phase with the vertical component."""
    return forcing_of(accelerogram, vertical).excitation <= mechanism.uplift_multiplier


def _over_directions(inputs: CaseInputs) -> CaseResult:
    """The case over all directions of a pair."""
    case = CaseResult(component=BOTH_COMPONENTS)
    settings = inputs.settings
    motions = ground_motions(inputs.motion, settings.ensemble.processing)
    try:
        case = replace(case, ensembles=ensemble_over_cracks(inputs.structure, motions, settings))
        return gathered(Asked(case, inputs.structure, motions, settings, inputs.bounces))
    except RockingError as error:
        return replace(case, failures=(Failure("directions", str(error)),))


def _integrated(mechanism: Mechanism, inputs: CaseInputs, clock: Clock) -> dict[Method, Response]:
    """The response to the record; unless fidelity is quick, also what the closed form is compared with besides."""
    responses: dict[Method, Response] = {}
    settings = inputs.settings
    record = inputs.accelerogram
    vertical = inputs.vertical
    follow_as_recorded = partial(
        integrate,
        mechanism,
        record,
        settings.tolerance,
        history=True,
        vertical=vertical,
        repeat_fragile=True,
    )
    runs = {Method.MECHANISM_ON_RECORD: follow_as_recorded}
    follow_simpler = partial(integrate, tolerance=strict(settings.tolerance))
    compares = settings.fidelity != "quick"
    if compares and mechanism.can_overturn:
        block = mechanism.equivalent_block(settings.acceleration_scale)
        runs[Method.BLOCK_ON_RECORD] = partial(follow_simpler, block, record, vertical=vertical)
    if compares and inputs.pulse is not None:
        runs[Method.MECHANISM_ON_PULSE] = partial(follow_simpler, mechanism, inputs.pulse)
    for method, run in runs.items():
        with clock.stage(method):
            responses[method] = run()
    return responses


def other_cracks(
    structure: Structure,
    accelerogram: Accelerogram,
    pulse: Pulse | None,
    count: int,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> list[Variation]:
    """Return `count` candidates of a structure, the lowest crack first; [] where its own is the only one.

    vertical: acts with the accelerogram. Raises RockingError where one of them cannot be followed.
    """
    others = sorted(structure.candidates(count) if count else (), key=lambda candidate: candidate.position)
    if len(others) < 2 and all(candidate.is_own_of(structure) for candidate in others):
        return []
    variations = []
    for candidate in others:
        ratio = _rotation_ratio(candidate.structure, accelerogram, settings, vertical)
        if math.isnan(ratio):
            # Raises the reason.
            integrate(candidate.structure, accelerogram, strict(settings.tolerance), vertical=vertical)
        mechanism = candidate.mechanism
        predicted = math.nan
        if pulse and mechanism.can_overturn:
            block = mechanism.equivalent_block(settings.acceleration_scale)
            predicted = predict_maximum(block, pulse).rotation_ratio
        variations.append(
            Variation(
                integrated_rotation_ratio=ratio,
                predicted_rotation_ratio=predicted,
                crack=candidate.description,
                position=candidate.position,
                counts=candidate.counts,
            )
        )
    return variations


def other_processings(
    structure: Structure,
    records: Mapping[str, Accelerogram],
    settings: AssessmentSettings,
    as_it_is: float = math.nan,
    vertical: Accelerogram | None = None,
) -> list[Variation]:
    """Return a structure under each of `records`; one under which it cannot be followed is left out.

    records: as `processed` gives them. as_it_is: the ratio under the record itself, which needs no integration; nan
    where it is not known. vertical: acts with each.
    """
    variations = []
    for processing, record in records.items():
        ratio = as_it_is if processing == AS_IT_IS else math.nan
        if math.isnan(ratio):
            ratio = _rotation_ratio(structure, record, settings, vertical)
        if not math.isnan(ratio):
            variations.append(Variation(integrated_rotation_ratio=ratio, processing=processing))
    return variations


def _rotation_ratio(
    structure: Structure,
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
) -> float:
    """The largest rotation ratio of a single run, nan where it cannot be followed."""
    tolerance = strict(settings.tolerance)
    followed = integrate_members(structure, record, Members(), tolerance, vertical=vertical)
    return float(followed.rotation_ratio[0])


def _with_variations(case: CaseResult, inputs: CaseInputs) -> CaseResult:
    """Return the case with its variations: other cracks and other processings of the record.

    For a crack that cannot be followed, the reason is kept as a failure.
    """
    if case.response is None:
        return case
    structure = inputs.structure
    settings = inputs.settings
    record = inputs.accelerogram
    try:
        of_cracks = other_cracks(
            structure, record, inputs.pulse, inputs.crack_heights, settings, inputs.vertical
        )
        case = replace(case, variations=tuple(of_cracks))
    except RockingError as error:
        case = replace(case, failures=(*case.failures, Failure("variations", str(error))))
    if not inputs.processing_variants:
        return case
    motions = _processings(inputs.motion)
    of_processings = other_processings(
        structure,
        {processing: motion for (_, processing), motion in motions.horizontal.items()},
        settings,
        case.integrated_rotation_ratio,
        motions.vertical,
    )
    return replace(case, variations=(*case.variations, *of_processings))


@lru_cache(maxsize=2)  # the two components of a record
def _processings(motion: Motion) -> GroundMotions:
    """One component after each variant of the processing, which comes before any support, and the vertical one."""
    (component,) = motion.components
    variants = {("", name): processing for name, processing in processed(component).items()}
    return GroundMotions(variants, motion.vertical).on(motion.support)


def compute_pulses(inputs: PulseInputs, clock: Clock) -> ComponentPulses:
    """Return the pulses of one component of a record."""
    components = tuple(component for motion in inputs.components for component in motion.components)
    motion = HorizontalMotion()
    if inputs.measured:
        with clock.stage("velocity pulse"):
            motion = _horizontal_motions(components)[inputs.place]
    with clock.stage("pulses"):
        return pulses_of(components[inputs.place], inputs.settings, motion)


@lru_cache(maxsize=1)  # once for both components of a record
def _horizontal_motions(components: tuple[Accelerogram, ...]) -> list[HorizontalMotion]:
    return horizontal_motions(components)


def count_motions(inputs: PairInputs, clock: Clock) -> int:
    """Return the number of motions of a pair. Raises RecordError for components that are no pair."""
    with clock.stage("directions"):
        return len(ground_motions(inputs.pair, inputs.processing).horizontal)


def compute_reserve(inputs: ReserveInputs, clock: Clock) -> Reserve:
    """Return the reserve of the crack of a structure that governs. Raises RockingError where it cannot be followed."""
    crack = crack_named(inputs.structure, inputs.crack)
    with clock.stage("reserve"):
        motions = ground_motions(inputs.motion, inputs.settings.ensemble.processing)
        return reserve(
            inputs.structure,
            crack,
            motions,
            inputs.settings,
            support_loss=inputs.support_loss,
            share=inputs.share,
        )
