"""Assess: one record against structures, each case predicted, integrated and followed by its ensemble."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from functools import lru_cache, partial
from math import inf
from statistics import median
from time import process_time
from typing import TYPE_CHECKING, Literal, Protocol, TypeVar

import numpy as np

from rocking.assessment.case import (
    CaseResult,
    Failure,
    Motion,
    Prediction,
    RecordResult,
    SceneResult,
    StationResult,
)
from rocking.assessment.component import (
    Component,
    ComponentPulses,
    HorizontalMotion,
    component_names,
    component_of,
    horizontal_motions,
)
from rocking.assessment.contacts import contact_share, doubt
from rocking.assessment.cracks import cracks, ensemble_over_cracks, slides_first
from rocking.assessment.decide import Verdict, decide
from rocking.assessment.fidelity import Answer, Tier, cheapest_answer, estimated
from rocking.assessment.ground_motions import GroundMotions, processed
from rocking.assessment.reserve import Reserve
from rocking.assessment.reserve_search import reserve
from rocking.assessment.scene import Scene, on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.variations import candidates, processed_variants
from rocking.assessment.verdict import BOTH_COMPONENTS, Method, ratio_in_words
from rocking.drawn import Drawn, in_a_notebook
from rocking.errors import ConfigurationError, RecordError, RockingError
from rocking.floors.support import Support
from rocking.hashes import sha256_of
from rocking.motion.integration import integrate, strict
from rocking.motion.response import UNKNOWN, Response, check_model
from rocking.pulses import PulseEvidence, predicting_pulse
from rocking.quantities import kind_of
from rocking.records import Accelerogram, aligned
from rocking.sine_pulse import predict_maximum, printed_maximum
from rocking.structures import Mechanism, Structure

if TYPE_CHECKING:
    from pandas import DataFrame


T = TypeVar("T")


class Store(Protocol):
    """A place that keeps results by their fingerprint."""

    def find(self, kind: type[T], fingerprint: str) -> T | None:
        """Return the `kind` that was kept by this fingerprint; None where there is none."""

    def durations(self, fingerprint: str) -> Mapping[str, float]:
        """Return the CPU time of each stage that computed what is kept by this fingerprint, s."""

    def keep(self, fingerprint: str, result: object, durations: Mapping[str, float]) -> None:
        """Keep a result by its fingerprint, and the CPU time of each stage that computed it."""


@dataclass(frozen=True)
class Extent:
    """The settings of a case, and the variations that are computed beside it.

    crack_heights: number of heights tried for a hinge or a crack. processing_variants: whether other processings are
    tried. motion_measures: whether the velocity pulse of the components and their peaks over all directions are
    measured, which tables tell. version: of the computation, which enters fingerprints.
    """

    settings: AssessmentSettings = field(default_factory=AssessmentSettings)
    crack_heights: int = 0
    processing_variants: bool = False
    motion_measures: bool = False
    version: str = ""

    def fingerprint(self, motion: Motion, structure: Structure, alone: bool) -> str:
        """Return the hash of all that the result of a case depends on."""
        own = {each.name: getattr(self.settings, each.name) for each in fields(AssessmentSettings)}
        return sha256_of(
            motion.fingerprint,
            structure.as_config(),
            own,
            self.crack_heights,
            self.processing_variants,
            alone,
            self.version,
        )

    def pulses_fingerprint(self, motions: Sequence[Motion], place: int) -> str:
        """Return the hash of all that the pulses of the component at `place` depend on."""
        prints = [each.fingerprint for each in motions]
        return sha256_of("pulses", place, prints, self.settings.pulse, self.motion_measures, self.version)


class Clock:
    """The CPU time of each stage, s, added up."""

    def __init__(self) -> None:
        self.durations: dict[str, float] = defaultdict(float)

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


def _shared(clock: Clock, parts: int) -> dict[str, float]:
    """Return an equal part of each stage, for each of what was computed in one go."""
    return {name: duration / parts for name, duration in clock.durations.items()}


# One record -----------------------------------------------------------------------------------------------


def assess_record(
    record: str,
    horizontal: Sequence[Accelerogram],
    scenes: Mapping[str, Scene],
    extent: Extent | None = None,
    vertical: Accelerogram | None = None,
    store: Store | None = None,
    clock: Clock | None = None,
) -> RecordResult:
    """Return what comes of every scene under a record; one that fails costs no other.

    horizontal: its components. An ensemble over the directions of a pair speaks for both components, which then get
    none of their own. scenes: by name; a structure on a support meets the motion there, for each period of the support,
    and for comparison that of the ground. store: where results are sought before they are computed, and kept. clock:
    has measured what came before.
    """
    extent = extent or Extent()
    clock = clock or Clock()
    grounds = _components(horizontal, vertical, extent, store, clock)
    failures: list[tuple[str, Failure]] = []
    floors: dict[Support, tuple[Component, ...]] = {}
    stations: dict[tuple[str, Support | None], StationResult] = {}
    supports = dict.fromkeys(support for scene in scenes.values() for support in scene.place.axis)
    for support in {None: None} | supports:
        carried = {name: each for name, each in scenes.items() if support in each.place.axis}
        components = grounds
        if support is not None:
            try:
                components = floors[support] = _on_support(support, grounds, extent, store, clock)
            except RockingError as error:
                lost = _not_carried(carried, support, component_names(horizontal), str(error))
                stations |= {(name, support): station for name, station in lost.items()}
                continue
        found, failed = _assess_carried(carried, components, vertical, support, extent, store, clock)
        stations |= {(name, support): station for name, station in found.items()}
        failures += failed
        if support is None:
            for name, station in found.items():
                stations[name, None], lost_reserve = _with_reserve(
                    station, grounds, vertical, extent, store, clock
                )
                failures += lost_reserve
    results = {}
    for name, scene in scenes.items():
        along_axis = [stations[name, each] for each in scene.place.axis if (name, each) in stations]
        with_members = [station for station in along_axis if station.support and station.decisive]
        if with_members:
            # On a support the reserve is sought at the period that reports print, the worst one.
            worst = max(with_members, key=lambda station: station.severity)
            assert worst.support is not None
            sought, lost_reserve = _with_reserve(worst, floors[worst.support], vertical, extent, store, clock)
            along_axis[along_axis.index(worst)] = sought
            failures += lost_reserve
        if along_axis:
            results[name] = SceneResult(scene, tuple(along_axis))
    return RecordResult(
        record=record,
        components=grounds,
        scenes=results,
        failures=tuple(failures),
        durations=dict(clock.durations),
        floors=floors,
    )


def _not_carried(
    scenes: Mapping[str, Scene], support: Support, components: Sequence[str], message: str
) -> dict[str, StationResult]:
    """The results of scenes to whose support the record cannot be taken: why."""
    failure = Failure("responses", message)
    lost = {}
    for name, scene in scenes.items():
        cases = {each: CaseResult(structure=name, component=each, failures=(failure,)) for each in components}
        lost[name] = StationResult(scene, cases, support=support)
    return lost


def _on_support(
    support: Support, grounds: Sequence[Component], extent: Extent, store: Store | None, clock: Clock
) -> tuple[Component, ...]:
    """The components as they arrive on a support, with the pulses of the motion there."""
    with clock.stage("supports"):
        motions = [
            Motion((each.accelerogram,), each.vertical, support).ground_motions(processing=False)
            for each in grounds
        ]
    floors = [next(iter(each.horizontal.values())) for each in motions]
    sought = _components(floors, None, replace(extent, motion_measures=False), store, clock)
    return tuple(
        replace(each, vertical=motion.vertical, support=support, ground=ground)
        for each, motion, ground in zip(sought, motions, grounds, strict=True)
    )


def _assess_carried(
    scenes: Mapping[str, Scene],
    components: Sequence[Component],
    vertical: Accelerogram | None,
    support: Support | None,
    extent: Extent,
    store: Store | None,
    clock: Clock,
) -> tuple[dict[str, StationResult], list[tuple[str, Failure]]]:
    """The results of the scenes that one support, or the ground, carries, and the failures of no single one.

    components: as they arrive there. vertical: of the record.
    """
    structures = {name: scene.structure for name, scene in scenes.items()}
    failures: list[tuple[str, Failure]] = []
    grounds = [(each.ground or each).accelerogram for each in components]
    pair = None
    if len(grounds) == 2 and extent.settings.ensemble.members and (structures or support is None):
        pair = Motion(tuple(grounds), vertical, support)
        try:
            with clock.stage("directions"):
                _ground_motions(pair, extent.settings.ensemble.processing)
        except RockingError as error:
            failures.append((BOTH_COMPONENTS, Failure("directions", str(error))))
            pair = None
    names = component_names(grounds)
    cases: dict[str, dict[str, CaseResult]] = {name: {} for name in structures}
    for name, component in zip(names, components, strict=True):
        if component.failure:
            failures.append((name, Failure("pulses", component.failure)))
        of_component = _component_cases(component, structures, extent, pair is None, store, clock)
        for structure, result in of_component.items():
            cases[structure][name] = replace(result, component=name)
    directions = {} if pair is None else _direction_cases(pair, structures, cases, extent, store, clock)
    stations = {
        name: StationResult(scene, cases[name], directions.get(name), support)
        for name, scene in scenes.items()
        if cases[name]
    }
    return stations, failures


def _components(
    horizontal: Sequence[Accelerogram],
    vertical: Accelerogram | None,
    extent: Extent,
    store: Store | None,
    clock: Clock,
) -> tuple[Component, ...]:
    """The components with the pulses of each."""
    beside = [None if vertical is None else aligned(vertical, each) for each in horizontal]
    fingerprints: list[str] = []
    if store is not None:
        motions = [Motion((each,)) for each in horizontal]
        fingerprints = [extent.pulses_fingerprint(motions, place) for place, _ in enumerate(motions)]
        kept = [store.find(ComponentPulses, fingerprint) for fingerprint in fingerprints]
        pulses = [each for each in kept if each is not None]
        if len(pulses) == len(horizontal):
            for fingerprint in fingerprints:
                clock.add(store.durations(fingerprint))
            triples = zip(pulses, horizontal, beside, strict=True)
            return tuple(each.beside(accelerogram, lift) for each, accelerogram, lift in triples)
    of_pair = [HorizontalMotion()] * len(horizontal)
    own = Clock()
    if extent.motion_measures:
        with own.stage("velocity pulse"):
            of_pair = horizontal_motions(horizontal)
    components = []
    for accelerogram, lift, motion in zip(horizontal, beside, of_pair, strict=True):
        with own.stage("pulses"):
            components.append(component_of(accelerogram, extent.settings.pulse, lift, motion))
    clock.add(own.durations)
    for fingerprint, component in zip(fingerprints, components, strict=False):
        if store is not None:
            store.keep(fingerprint, ComponentPulses.of(component), _shared(own, len(components)))
    return tuple(components)


def _component_cases(
    component: Component,
    structures: Mapping[str, Structure | Mechanism],
    extent: Extent,
    alone: bool,
    store: Store | None,
    clock: Clock,
) -> dict[str, CaseResult]:
    """The case of each structure under one component. alone: whether no ensemble over directions speaks for it."""
    motion = _motion_of(component)
    fingerprints = {
        name: extent.fingerprint(motion, structure, alone)
        for name, structure in structures.items()
        if store is not None and isinstance(structure, Structure)
    }
    results: dict[str, CaseResult] = {}
    for name, fingerprint in fingerprints.items():
        kept = store.find(CaseResult, fingerprint) if store is not None else None
        if kept is not None:
            prediction = None
            mechanism = _mechanism(structures[name])
            if component.candidates and kept.answer is not None and mechanism.can_overturn:
                prediction = predict(mechanism, component.candidates, extent.settings)
            durations = store.durations(fingerprint) if store is not None else {}
            results[name] = replace(kept, structure=name, prediction=prediction, durations=durations)
    missing = {name: structure for name, structure in structures.items() if name not in results}
    computed = {}
    for name, structure in missing.items():
        own = Clock()
        with own.stage("responses"):
            case = assess_case(name, structure, component, extent.settings, alone)
        computed[name] = replace(case, durations={**case.durations, **own.durations})
    together = Clock()
    with together.stage("variations"):
        computed = _with_variations(computed, missing, component, extent)
    for name, result in computed.items():
        fingerprint = fingerprints.get(name, "")
        durations = {**result.durations, **_shared(together, len(computed))}
        results[name] = replace(result, fingerprint=fingerprint, durations=durations)
        if store is not None and fingerprint:
            store.keep(fingerprint, results[name].kept, durations)
    for stage in ("responses", "variations"):
        clock.add({stage: sum(each.durations.get(stage, 0.0) for each in results.values())})
    for method in Method:
        spent = [each.durations[method] for each in results.values() if method in each.durations]
        if spent:  # the first case of a process loads compiled code, so not the sum
            clock.add({method: len(spent) * median(spent)})
    return {name: results[name] for name in structures}


def _direction_cases(
    pair: Motion,
    structures: Mapping[str, Structure | Mechanism],
    cases: Mapping[str, Mapping[str, CaseResult]],
    extent: Extent,
    store: Store | None,
    clock: Clock,
) -> dict[str, CaseResult]:
    """The ensemble over all directions of a pair, of each structure that any component gave a result for."""
    results = {}
    for name, structure in structures.items():
        if all(case.answer is None for case in cases[name].values()):
            continue
        fingerprint = ""
        known = None
        if store is not None and isinstance(structure, Structure):
            fingerprint = extent.fingerprint(pair, structure, alone=True)
            known = store.find(CaseResult, fingerprint)
        if known is not None and store is not None:
            results[name] = replace(known, structure=name)
            clock.add(store.durations(fingerprint))
            continue
        bounces = any(case.check.bounces for case in cases[name].values())
        own = Clock()
        with own.stage("directions"):
            result = replace(
                assess_directions(name, structure, pair, extent.settings, bounces), fingerprint=fingerprint
            )
        results[name] = result
        clock.add(own.durations)
        if store is not None and fingerprint:
            store.keep(fingerprint, result, own.durations)
    return results


def _with_reserve(
    station: StationResult,
    components: Sequence[Component],
    vertical: Accelerogram | None,
    extent: Extent,
    store: Store | None,
    clock: Clock,
) -> tuple[StationResult, list[tuple[str, Failure]]]:
    """The station with the reserve of the crack that governs the case that decides, and why there is none.

    components: as they arrive where the structure stands. vertical: of the record. With fidelity: auto, which asks for
    the verdict alone, no reserve is sought, nor where nothing can overturn the structure.
    """
    case = station.decisive
    if case is None or extent.settings.fidelity == "auto" or not extent.settings.ensemble.reserve:
        return station, []
    grounds = [(each.ground or each).accelerogram for each in components]
    of_component = dict(zip(component_names(grounds), components, strict=True))
    if case is station.directions:
        motion = Motion(tuple(grounds), vertical, station.support)
    else:
        motion = _motion_of(of_component[case.component])
    try:
        return station.with_reserve(_reserve(case, station.body, motion, extent, store, clock)), []
    except RockingError as error:
        return station, [(case.component, Failure("reserve", f"{station.structure}: {error}"))]


def _reserve(
    case: CaseResult,
    structure: Structure | Mechanism,
    motion: Motion,
    extent: Extent,
    store: Store | None,
    clock: Clock,
) -> Reserve | None:
    """The reserve of the crack that governs a case under its motion, from the store where it holds it."""
    assert case.ensembles is not None
    several = cracks(structure)
    description = case.ensembles.governing.description
    governing = next((each for each in several if each.description == description), several[0])
    if not governing.mechanism.can_overturn:
        return None
    fingerprint = sha256_of("reserve", case.fingerprint) if case.fingerprint else ""
    kept = store.find(Reserve, fingerprint) if store is not None else None
    if kept is not None and store is not None:
        clock.add(store.durations(fingerprint))
        return kept
    ensemble = extent.settings.ensemble
    own = Clock()
    with own.stage("reserve"):
        sought = reserve(governing.mechanism, _ground_motions(motion, ensemble.processing), ensemble)
    clock.add(own.durations)
    if store is not None and fingerprint:
        store.keep(fingerprint, sought, own.durations)
    return sought


# One case -------------------------------------------------------------------------------------------------


def predict(
    mechanism: Mechanism, candidates: Sequence[PulseEvidence], settings: AssessmentSettings | None = None
) -> Prediction:
    """Return the closed forms of the equivalent block of `mechanism` under the candidate of largest demand.

    candidates: as a pulse method offers them.
    """
    settings = settings or AssessmentSettings()
    block = mechanism.equivalent_block(settings.acceleration_scale)
    chosen = predicting_pulse(candidates, lambda pulse: predict_maximum(block, pulse).rotation_ratio)
    pulse = chosen.pulse
    return Prediction(
        block=block,
        pulse=pulse,
        pulse_rank=candidates.index(chosen) + 1,
        printed_rotation_ratio=printed_maximum(mechanism.equivalent_block("linearised"), pulse),
        printed_uplift_rotation_ratio=printed_maximum(mechanism.equivalent_block("uplift"), pulse),
        maximum=predict_maximum(block, pulse),
    )


def assess_case(
    name: str,
    structure: Structure | Mechanism,
    component: Component,
    settings: AssessmentSettings | None = None,
    alone: bool = True,
) -> CaseResult:
    """Return what comes of one structure under one component; where it cannot be followed, why.

    alone: False where an ensemble over the directions of the record speaks for its components, which then get neither
    an ensemble nor an estimate of their own.
    """
    settings = settings or AssessmentSettings()
    try:
        return _case(name, structure, component, settings, alone)
    except RockingError as error:
        return CaseResult(
            structure=name, component=component.name, failures=(Failure("responses", str(error)),)
        )


# Whole on purpose: the order in which a case is decided, and where it may end early.
def _case(
    name: str,
    structure: Structure | Mechanism,
    component: Component,
    settings: AssessmentSettings,
    alone: bool,
) -> CaseResult:
    record = component.accelerogram
    vertical = component.vertical
    mechanism = _mechanism(structure)
    prediction, responses, durations = _compared_methods(mechanism, component, settings)
    members = settings.ensemble.members if alone else 0
    auto = settings.fidelity == "auto"
    if auto:
        # What a peak velocity tells was learnt on the ground, not on supports that ring.
        risk = settings.fidelity_risk if component.support is None else 0.0
        answer = _cheapest(structure, mechanism, record, settings, risk, vertical, members > 0)
        if answer.response is not None:
            responses[Method.MECHANISM_ON_RECORD] = answer.response
    else:
        whole = responses[Method.MECHANISM_ON_RECORD]
        answer = Answer(Method.MECHANISM_ON_RECORD, whole.outcome, "", whole)
    check = UNKNOWN
    if isinstance(structure, Structure) and answer.response is not None:
        check = check_model(structure, answer.response, record, vertical)
    case = CaseResult(
        structure=name,
        component=component.name,
        prediction=prediction,
        responses=responses,
        check=check,
        answer=answer,
        durations=durations,
    )
    if not alone:
        return case
    motions = _ground_motions(_motion_of(component), settings.ensemble.processing)
    if members and answer.method is Method.MECHANISM_ON_RECORD:
        case = with_ensembles(case, structure, motions, settings)
        return with_contacts(case, structure, motions, settings, check.bounces)
    if vertical is None and component.support is None:
        case = replace(case, overturning_estimate=estimated(Tier.PEAK_VELOCITY, mechanism, record))
    return with_contacts(case, structure, motions, settings, check.bounces)


def with_ensembles(
    case: CaseResult,
    structure: Structure | Mechanism,
    motions: GroundMotions,
    settings: AssessmentSettings,
) -> CaseResult:
    """Return the case with the ensembles of its cracks; with fidelity: auto, as far as the verdict asks for them."""
    auto = settings.fidelity == "auto"
    return replace(case, ensembles=ensemble_over_cracks(structure, motions, settings, verdict_only=auto))


def with_contacts(
    case: CaseResult,
    structure: Structure | Mechanism,
    motions: GroundMotions,
    settings: AssessmentSettings,
    bounces: bool | None,
) -> CaseResult:
    """Return the case with what its joints say: whether they slide, a doubt, and contact dynamics where that is asked.

    A doubt is asked for every word below "probably overturns", and contact dynamics where there is a doubt. bounces:
    whether a contact opens in a run as recorded; None where that is not known.
    """
    given = isinstance(structure, Structure) and structure.crack_is_given
    counting = cracks(structure)[:1] if given else cracks(structure)
    if all(slides_first(each, motions, settings) for each in counting):
        return replace(case, slides_at=counting[0].slides_at(settings.friction_coefficient))
    if decide(case.facts(structure)).word.badness < Verdict.PROBABLY_OVERTURNS.badness:
        reason = doubt(structure, motions, case.largest_rotation_ratio, settings, bounces)
        case = replace(case, doubt=reason)
    if settings.fidelity == "contact" and case.doubt is not None and isinstance(structure, Structure):
        return replace(case, contact=contact_share(structure, motions, settings))
    return case


def _compared_methods(
    mechanism: Mechanism, component: Component, settings: AssessmentSettings
) -> tuple[Prediction | None, dict[Method, Response], dict[str, float]]:
    """The closed form and, with fidelity: full, every integration, with the CPU time of each, s."""
    # The block is made before the clock of the closed form starts, which does not count it.
    block = mechanism.equivalent_block(settings.acceleration_scale)
    durations: dict[str, float] = {}
    prediction = None
    # The block of what cannot overturn would: it says nothing of it.
    if component.candidates and mechanism.can_overturn:
        started = process_time()
        prediction = predict(mechanism, component.candidates, settings)
        durations[Method.CLOSED_FORM] = process_time() - started
    responses: dict[Method, Response] = {}
    if settings.fidelity == "auto":
        return prediction, responses, durations
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
        started = process_time()
        responses[method] = run()
        durations[method] = process_time() - started
    return prediction, responses, durations


def _motion_of(component: Component) -> Motion:
    """The motion of one component, as the ground had it and what carries the structure."""
    ground = component.ground or component
    return Motion((ground.accelerogram,), ground.vertical, component.support)


def _mechanism(structure: Structure | Mechanism) -> Mechanism:
    return structure if isinstance(structure, Mechanism) else structure.mechanism()


def _cheapest(
    structure: Structure | Mechanism,
    mechanism: Mechanism,
    record: Accelerogram,
    settings: AssessmentSettings,
    risk: float,
    vertical: Accelerogram | None,
    ensemble_follows: bool,
) -> Answer:
    """Return what settles the verdict with the least work, at a `risk` of the opposite outcome.

    Where other cracks may form, nothing cheaper than the mechanism settles it unless all of them rest, or stand by
    their peak velocities.
    """
    mechanisms = [each.mechanism for each in cracks(structure)]
    of_statics = mechanism if len(mechanisms) == 1 else mechanisms[0]
    if len(mechanisms) > 1 and isinstance(structure, Structure):
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


def _with_variations(
    results: Mapping[str, CaseResult],
    structures: Mapping[str, Structure | Mechanism],
    component: Component,
    extent: Extent,
) -> dict[str, CaseResult]:
    """The cases with other cracks and other processings of the record beside them."""
    varied = dict(results)
    own: dict[str, Structure] = {}
    for name, result in results.items():
        structure = structures[name]
        if result.answer is not None and isinstance(structure, Structure):
            own[name] = structure
            varied[name] = _with_candidates(result, structure, component, extent)
    if not (extent.processing_variants and own):
        return varied
    motions, vertical = _processings(component)
    as_recorded = {name: results[name].integrated_rotation_ratio for name in own}
    of_each = processed_variants(own, motions, extent.settings, as_recorded, vertical)
    for name, several in of_each.items():
        result = varied[name]
        varied[name] = replace(result, variations=(*result.variations, *several))
    return varied


def _with_candidates(
    result: CaseResult, structure: Structure, component: Component, extent: Extent
) -> CaseResult:
    """The case with what each crack that may form does beside it, or with the reason why one cannot be followed."""
    pulse = result.prediction.pulse if result.prediction else None
    record = component.accelerogram
    vertical = component.vertical
    try:
        several = candidates(structure, record, pulse, extent.crack_heights, extent.settings, vertical)
    except RockingError as error:
        failure = Failure("variations", str(error))
        return replace(result, failures=(*result.failures, failure))
    return replace(result, variations=tuple(several))


def _processings(component: Component) -> tuple[Mapping[str, Accelerogram], Accelerogram | None]:
    """The component after each variant of the processing, which comes before any support, and the vertical one."""
    if component.support is None or component.ground is None:
        return processed(component.accelerogram), component.vertical
    ground = component.ground
    variants = {("", name): each for name, each in processed(ground.accelerogram).items()}
    floors = GroundMotions(variants, ground.vertical).on(component.support)
    return {name: each for (_, name), each in floors.horizontal.items()}, floors.vertical


@lru_cache(maxsize=2)
def _ground_motions(motion: Motion, processing: bool) -> GroundMotions:
    """The motions that one motion stands for, made once for all structures and for their reserves."""
    return motion.ground_motions(processing)


def assess_directions(
    name: str,
    structure: Structure | Mechanism,
    pair: Motion,
    settings: AssessmentSettings,
    bounces: bool | None = None,
) -> CaseResult:
    """Return the ensemble of one structure over all directions of a pair; where it cannot be followed, why.

    bounces: whether a contact opens under one of the components as recorded; None where that is not known.
    """
    case = CaseResult(structure=name, component=BOTH_COMPONENTS)
    motions = _ground_motions(pair, settings.ensemble.processing)
    try:
        case = with_ensembles(case, structure, motions, settings)
        return with_contacts(case, structure, motions, settings, bounces)
    except RockingError as error:
        return replace(case, failures=(Failure("directions", str(error)),))


def with_histories(result: RecordResult, tolerance: float) -> RecordResult:
    """Return a record's result whose responses hold their histories, which results that were kept do not."""
    scenes = {}
    for name, scene in result.scenes.items():
        stations = []
        for station in scene.stations:
            components = result.components_under(station)
            cases = {
                component: _with_history(case, station.body, components[component], tolerance)
                for component, case in station.cases.items()
            }
            stations.append(replace(station, cases=cases))
        scenes[name] = replace(scene, stations=tuple(stations))
    return replace(result, scenes=scenes)


def _with_history(
    case: CaseResult, body: Structure | Mechanism, component: Component, tolerance: float
) -> CaseResult:
    response = case.response
    if response is None or response.times is not None:
        return case
    # A fragile run was repeated at a smaller tolerance than that of the settings, which it states.
    whole = integrate(
        body,
        component.accelerogram,
        tolerance=min(tolerance, response.tolerance or tolerance),
        vertical=component.vertical,
        history=True,
    )
    whole = replace(whole, fragile=response.fragile)
    return replace(case, responses={**case.responses, Method.MECHANISM_ON_RECORD: whole})


# In one call ----------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class StructureAssessment(StationResult, Drawn):
    """The result of one structure: the verdict with the ensemble over all uncertain inputs, directions included.

    cases: by component. rotation_ratio: largest rotation over critical rotation of the case as given, the worse
    component; inf if it overturns. `plot` draws the rotation as given, with the members' 5–95 % beside it.

    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> assessment = rocking.assess(record, rocking.Block(2.0, 0.2))
    >>> print(assessment.verdict)
    overturns
    """

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism as given."""
        return _mechanism(self.body)

    @property
    def static_multiplier(self) -> float:
        """Least λ of the cracks that may form, the acceleration in g at which statics lets it rock."""
        return cracks(self.body)[0].mechanism.uplift_multiplier

    @property
    def rotation_ratios(self) -> np.ndarray:
        """(m,) largest rotation over critical rotation of every member; inf overturns, 0 does not lift, nan failed."""
        return np.array([]) if self.ensemble is None else self.ensemble.rotation_ratios

    @property
    def causes(self) -> Mapping[str, np.ndarray]:
        """Value of each cause that varied, by member, (m,)."""
        return {} if self.ensemble is None else self.ensemble.causes

    @property
    def falls_to(self) -> int:
        """Side to which it falls as given, 1 or -1 as `Response.peak_side` counts them; 0 where it does not."""
        return self.response.peak_side if self.rotation_ratio == inf else 0

    @property
    def response(self) -> Response:
        """The integration of the mechanism as given, with its history; of the worse component."""
        responses = [case.responses[Method.MECHANISM_ON_RECORD] for case in self.cases.values()]
        return max(responses, key=lambda response: response.rotation_ratio)

    def __repr__(self) -> str:
        ratios = (self.rotation_ratio, self.rotation_ratio_low, self.rotation_ratio_high)
        given, low, high = ("overturns" if ratio == inf else f"{ratio:.2g}" for ratio in ratios)
        return (
            f"<{self.verdict}: {self.why}; as given {given}, 5–95 % {low} to {high} of the critical rotation>"
        )

    def frame(self) -> "DataFrame":
        """One row per method and component: its rotation ratio, how that stands to the integration, and the verdict."""
        from pandas import DataFrame  # slow to import, and needed by those alone who ask for a frame

        rows = []
        for component, case in self.cases.items():
            ratios = {Method.CLOSED_FORM: case.predicted_rotation_ratio} if case.prediction else {}
            ratios |= {method: response.rotation_ratio for method, response in case.responses.items()}
            for method, ratio in ratios.items():
                whole = method is Method.MECHANISM_ON_RECORD
                words = "" if whole else ratio_in_words(ratio, case.integrated_rotation_ratio)
                rows.append((component, str(method), ratio, words, str(self.verdict)))
        return DataFrame(rows, columns=["component", "method", "rotation_ratio", "in_words", "verdict"])

    def _repr_html_(self) -> str:
        return in_a_notebook(repr(self).strip("<>"), self.frame())


def assess(
    record: Accelerogram | Sequence[Accelerogram] | object,
    structure: Structure | Mechanism,
    *,
    members: int | None = None,
    settings: AssessmentSettings | None = None,
    vertical: Accelerogram | None = None,
    unit: str | None = None,
    inventory: object = None,
) -> StructureAssessment:
    """Return the verdict on `structure` under `record`, with the ensemble that says how sure it is.

    record: one accelerogram, or both horizontal components, which then make one ensemble over eight directions; or an
    obspy Stream or Trace, as Accelerogram.from_obspy reads it with `unit` and `inventory`, whose vertical component
    acts too. members: of the ensemble, by default those of the settings. vertical: sample by sample as the record; half
    of the members feel it.
    Raises ConfigurationError for no record or more than two, RockingError where it cannot be followed.

    >>> pulse = rocking.Pulse(amplitude=3.0, circular_frequency=8.0, start_time=0.5)
    >>> record = rocking.Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    >>> print(rocking.assess(record, rocking.Block(semi_diagonal=2.0, slenderness=0.2)).verdict)
    stands
    """
    if type(record).__module__.startswith("obspy."):
        channels = Accelerogram.from_obspy(record, inventory, unit)
        record = [each for each in channels if each.is_horizontal]
        vertical = vertical or next((each for each in channels if each.vertical), None)
    records = _checked_records(record)
    settings = settings or AssessmentSettings()
    for name, value, allowed, words in (
        ("structure", structure, Structure | Mechanism, "a structure or a mechanism"),
        ("vertical", vertical, Accelerogram | None, "an accelerogram"),
        ("settings", settings, AssessmentSettings, "AssessmentSettings"),
    ):
        if not isinstance(value, allowed):
            raise ConfigurationError(f"{name} is {kind_of(value)}, but must be {words}.")
    number = settings.ensemble.members if members is None else members
    varied = replace(settings.ensemble, members=number or EnsembleSettings().members)
    fidelity: Literal["full", "contact"] = "contact" if settings.fidelity == "contact" else "full"
    settings = replace(settings, fidelity=fidelity, ensemble=varied)
    scenes = on_the_ground({"structure": structure})
    result = assess_record("", records, scenes, Extent(settings), vertical)
    (station,) = result.stations
    over_all = [*station.cases.values(), *([station.directions] if station.directions else [])]
    for case in over_all:
        if case.failure:
            raise RockingError(case.failure.message)
    for _, failure in result.failures:
        if failure.stage == "directions":
            raise RecordError(failure.message)
    return StructureAssessment(station.scene, station.cases, station.directions)


def _checked_records(record: object) -> list[Accelerogram]:
    """The horizontal components. Raises ConfigurationError unless they are one or two accelerograms."""
    records = [record] if isinstance(record, Accelerogram) else record
    if isinstance(records, str | bytes) or not isinstance(records, Sequence):
        wrong = f"is {kind_of(record)}, but must be an accelerogram, or two horizontal ones; "
        wrong += "rocking.read gives those of a file"
    elif odd := [each for each in records if not isinstance(each, Accelerogram)]:
        wrong = f"holds a {type(odd[0]).__name__}, but must hold accelerograms"
    elif len(records) not in (1, 2):
        wrong = f"holds {len(records)} accelerograms, but must hold one or two horizontal ones"
    else:
        return list(records)
    raise ConfigurationError(f"record {wrong}.")
