"""One case: one structure under one motion, predicted, integrated and followed by its ensemble and its contacts."""

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from time import process_time

from rocking.assessment.case import CaseResult, Failure, Prediction, Variation
from rocking.assessment.contacts import MOST_RUNS, RUNS, contact_share, doubt, ties_give
from rocking.assessment.cracks import counting_cracks, cracks, ensemble_over_cracks, slides_first
from rocking.assessment.decide import Verdict, decide
from rocking.assessment.fidelity import Answer, Tier, cheapest_answer, estimated
from rocking.assessment.methods import BOTH_COMPONENTS, Method
from rocking.assessment.motions import AS_IT_IS, Component, GroundMotions, Motion, ground_motions, processed
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.integration import Members, integrate, integrate_members, strict
from rocking.motion.response import UNKNOWN, Response, check_model
from rocking.pulses import Pulse, PulseEvidence, predicting_pulse
from rocking.records import Accelerogram
from rocking.remarks import Kind
from rocking.sine_pulse import predict_maximum
from rocking.structures import Mechanism, Structure
from rocking.structures.structure import CRACKS


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
    )


# Whole on purpose: the order in which a case is decided, and where it may end early.
def assess_case(
    structure: Structure,
    component: Component,
    prediction: Prediction | None = None,
    settings: AssessmentSettings | None = None,
    alone: bool = True,
    clock: Clock | None = None,
) -> CaseResult:
    """Return what comes of one structure under one component; where it cannot be followed, why.

    prediction: the closed form, under whose pulse the mechanism is integrated as well; None without one.
    alone: False where an ensemble over the directions of the record speaks for its components, which then get neither
    an ensemble nor an estimate of their own. clock: takes the time of each method that is compared.
    """
    settings = settings or AssessmentSettings()
    record = component.accelerogram
    vertical = component.vertical
    try:
        mechanism = structure.mechanism()
        responses = _integrated(mechanism, component, prediction, settings, clock or Clock())
        members = settings.ensemble.members if alone else 0
        auto = settings.fidelity == "auto"
        if auto:
            answer = _cheapest(structure, component, settings, ensemble_follows=members > 0)
            if answer.response is not None:
                responses[Method.MECHANISM_ON_RECORD] = answer.response
        else:
            whole = responses[Method.MECHANISM_ON_RECORD]
            answer = Answer(Method.MECHANISM_ON_RECORD, whole.outcome, "", whole)
        check = UNKNOWN
        if answer.response is not None:
            check = check_model(structure, answer.response, record, vertical)
        case = CaseResult(
            component=record.component,
            prediction=prediction,
            responses=responses,
            check=check,
            answer=answer,
        )
        if not alone:
            return case
        motions = ground_motions(motion_of(component), settings.ensemble.processing)
        if members and answer.method is Method.MECHANISM_ON_RECORD:
            case = replace(case, ensembles=ensemble_over_cracks(structure, motions, settings))
            return with_contacts(case, structure, motions, settings, check.bounces)
        if vertical is None and component.support is None:
            case = replace(case, overturning_estimate=estimated(Tier.PEAK_VELOCITY, mechanism, record))
        return with_contacts(case, structure, motions, settings, check.bounces)
    except RockingError as error:
        return CaseResult(component=record.component, failures=(Failure("responses", str(error)),))


def with_contacts(
    case: CaseResult,
    structure: Structure,
    motions: GroundMotions,
    settings: AssessmentSettings,
    bounces: bool | None,
) -> CaseResult:
    """Return the case with what its joints do: whether they slide, a doubt, and contact dynamics where it is needed.

    Doubts are looked for with every word below "probably overturns", and of a wall that stands whether its ties hold it
    still enough. Contact dynamics runs, except with fidelity: auto, where nothing else decides; with fidelity:
    contact by MOST_RUNS runs, and also where a held wall turns so far that it only probably stands. bounces: whether a
    contact opens in a run as recorded; None where that is not known.
    """
    counting = counting_cracks(structure)
    if all(slides_first(each, motions, settings) for each in counting):
        return replace(case, slides_at=counting[0].slides_at(settings.friction_coefficient))
    if decide(case.facts(structure)).word.badness < Verdict.PROBABLY_OVERTURNS.badness:
        reason = doubt(structure, motions, case.largest_rotation_ratio, settings, bounces)
        case = replace(case, doubt=reason)
    if decide(case.facts(structure)).word is Verdict.STANDS:
        case = replace(case, ties_give=ties_give(structure, motions, settings))
    decision = decide(case.facts(structure))
    advised = any(each.kind is Kind.CONTACT_DYNAMICS for each in decision.tells)
    asking = {
        "auto": (),
        "full": (Verdict.CANNOT_BE_TOLD,),
        "contact": (Verdict.CANNOT_BE_TOLD, Verdict.PROBABLY_STANDS),
    }
    if advised and decision.word in asking[settings.fidelity]:
        runs = MOST_RUNS if settings.fidelity == "contact" else RUNS
        return replace(case, contact=contact_share(structure, motions, settings, runs))
    return case


def _integrated(
    mechanism: Mechanism,
    component: Component,
    prediction: Prediction | None,
    settings: AssessmentSettings,
    clock: Clock,
) -> dict[Method, Response]:
    """Every integration beside the closed form; with fidelity: auto none."""
    responses: dict[Method, Response] = {}
    if settings.fidelity == "auto":
        return responses
    block = mechanism.equivalent_block(settings.acceleration_scale)
    record = component.accelerogram
    vertical = component.vertical
    follow_as_given = partial(
        integrate,
        mechanism,
        record,
        settings.tolerance,
        history=True,
        vertical=vertical,
        fragility=True,
    )
    runs = {Method.MECHANISM_ON_RECORD: follow_as_given}
    follow_simpler = partial(integrate, tolerance=strict(settings.tolerance))
    if mechanism.can_overturn:
        runs[Method.BLOCK_ON_RECORD] = partial(follow_simpler, block, record, vertical=vertical)
    if prediction is not None:
        runs[Method.MECHANISM_ON_PULSE] = partial(follow_simpler, mechanism, prediction.pulse)
    for method, run in runs.items():
        with clock.stage(method):
            responses[method] = run()
    return responses


def motion_of(component: Component) -> Motion:
    """Return the motion of one component, as the ground had it and what carries the structure."""
    ground = component.ground or component
    return Motion((ground.accelerogram,), ground.vertical, component.support)


def _cheapest(
    structure: Structure, component: Component, settings: AssessmentSettings, ensemble_follows: bool
) -> Answer:
    """Return what settles the verdict with the least work, at the settings' risk of the opposite outcome.

    Where other cracks may form, nothing cheaper than the mechanism settles it unless all of them rest, or stand by
    their peak velocities.
    """
    record = component.accelerogram
    vertical = component.vertical
    mechanism = structure.mechanism()
    # Peak velocities were calibrated on the ground, not on supports that ring.
    risk = settings.fidelity_risk if component.support is None else 0.0
    mechanisms = [each.mechanism for each in cracks(structure)]
    of_statics = mechanism if len(mechanisms) == 1 else mechanisms[0]
    if len(mechanisms) > 1:
        estimates = (estimated(Tier.PEAK_VELOCITY, each, record) for each in mechanisms)
        if not all(each is not None and each.high <= risk for each in estimates):
            risk = 0.0
    answer = cheapest_answer(
        of_statics,
        record,
        risk=risk,
        ensemble_follows=ensemble_follows,
        tolerance=settings.tolerance,
        vertical=vertical,
        history=True,
    )
    if answer.method is not Method.MECHANISM_ON_RECORD or of_statics is mechanism:
        return answer
    whole = integrate(
        mechanism,
        record,
        tolerance=settings.tolerance,
        vertical=vertical,
        history=True,
        fragility=True,
    )
    return replace(answer, outcome=whole.outcome, response=whole)


def other_cracks(
    structure: Structure,
    accelerogram: Accelerogram,
    pulse: Pulse | None,
    count: int,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> list[Variation]:
    """Return `count` candidates of a structure, the lowest crack first; [] where there is one mechanism.

    vertical: acts with the accelerogram. Raises RockingError where one of them cannot be followed.
    """
    others = sorted(structure.candidates(count) if count else (), key=lambda each: each.position)
    if len(others) < 2:
        return []
    variations = []
    for each in others:
        ratio = _rotation_ratio(each.structure, accelerogram, settings, vertical)
        if math.isnan(ratio):
            # Raises the reason.
            integrate(each.structure, accelerogram, strict(settings.tolerance), vertical=vertical)
        mechanism = each.structure.mechanism()
        predicted = math.nan
        if pulse and mechanism.can_overturn:
            block = mechanism.equivalent_block(settings.acceleration_scale)
            predicted = predict_maximum(block, pulse).rotation_ratio
        variations.append(Variation(ratio, predicted, each.description, each.position))
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
            variations.append(Variation(ratio, processing=processing))
    return variations


def _rotation_ratio(
    structure: Structure,
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> float:
    """The largest rotation ratio of a single run, nan where it cannot be followed."""
    tolerance = strict(settings.tolerance)
    with suppress(RockingError):
        return float(
            integrate_members(structure, record, Members(), tolerance, vertical=vertical).rotation_ratio[0]
        )
    return math.nan


def with_variations(
    case: CaseResult,
    structure: Structure,
    component: Component,
    settings: AssessmentSettings,
    crack_heights: int,
    processing_variants: bool,
) -> CaseResult:
    """Return the case with other cracks and other processings of the record beside it.

    For a crack that cannot be followed, the reason is kept as a failure. crack_heights, processing_variants: as the
    assessor has them; without an ensemble cracks are followed in any case.
    """
    if case.answer is None:
        return case
    pulse = case.prediction.pulse if case.prediction else None
    record = component.accelerogram
    # Without members nothing else follows the mechanism that statics chooses.
    count = crack_heights or (0 if settings.ensemble.members else CRACKS)
    try:
        of_cracks = other_cracks(structure, record, pulse, count, settings, component.vertical)
        case = replace(case, variations=tuple(of_cracks))
    except RockingError as error:
        case = replace(case, failures=(*case.failures, Failure("variations", str(error))))
    if not processing_variants:
        return case
    motions, vertical = _processings(component)
    of_processings = other_processings(structure, motions, settings, case.integrated_rotation_ratio, vertical)
    return replace(case, variations=(*case.variations, *of_processings))


@lru_cache(maxsize=2)  # the two components of a record
def _processings(component: Component) -> tuple[Mapping[str, Accelerogram], Accelerogram | None]:
    """The component after each variant of the processing, which comes before any support, and the vertical one."""
    if component.support is None or component.ground is None:
        return processed(component.accelerogram), component.vertical
    ground = component.ground
    variants = {("", name): each for name, each in processed(ground.accelerogram).items()}
    floors = GroundMotions(variants, ground.vertical).on(component.support)
    return {name: each for (_, name), each in floors.horizontal.items()}, floors.vertical


def assess_directions(
    structure: Structure,
    pair: Motion,
    settings: AssessmentSettings,
    bounces: bool | None = None,
) -> CaseResult:
    """Return the ensemble of one structure over all directions of a pair; where it cannot be followed, why.

    bounces: whether a contact opens under one of the components as recorded; None where that is not known.
    """
    case = CaseResult(component=BOTH_COMPONENTS)
    motions = ground_motions(pair, settings.ensemble.processing)
    try:
        case = replace(case, ensembles=ensemble_over_cracks(structure, motions, settings))
        return with_contacts(case, structure, motions, settings, bounces)
    except RockingError as error:
        return replace(case, failures=(Failure("directions", str(error)),))
