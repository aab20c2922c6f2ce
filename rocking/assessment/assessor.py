"""The assessor: scenes under a record, each case looked up in a store before it is computed, and timed."""

from collections.abc import Callable, Container, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import isclose, isinf, isnan
from typing import Protocol, TypeVar

from rocking.assessment.case import (
    CaseResult,
    Failure,
    PeriodResult,
    Prediction,
    RecordResult,
    SceneResult,
)
from rocking.assessment.cracks import crack_named, cracked, slides_at
from rocking.assessment.inputs import (
    CaseInputs,
    Inputs,
    PairInputs,
    PredictionInputs,
    PulseInputs,
    ReserveInputs,
)
from rocking.assessment.methods import BOTH_COMPONENTS, Method
from rocking.assessment.motions import (
    Component,
    ComponentPulses,
    Motion,
    MovingSupport,
    arrived,
    by_name,
    on_support,
)
from rocking.assessment.one_case import (
    Clock,
    compute_case,
    compute_prediction,
    compute_pulses,
    compute_reserve,
    count_motions,
    predict,
)
from rocking.assessment.reserve import Reserve
from rocking.assessment.scene import Scene, variants_of
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import FaultError, RockingError, one_structure
from rocking.hashes import sha256_of
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.signal import aligned
from rocking.structures import Structure
from rocking.structures.structure import CRACKS

T = TypeVar("T")
I = TypeVar("I", bound=Inputs)

Predictions = Mapping[tuple[str, str], Prediction | Failure | None]
"""The closed forms by the names of scene and component, or why there is none; None without a pulse, and of what cannot
overturn."""


class Store(Protocol):
    """A place that keeps results by their fingerprint."""

    def find(self, kind: type[T], fingerprint: str) -> T | None:
        """Return the `kind` that was kept by this fingerprint; None where there is none."""

    def durations(self, fingerprint: str) -> Mapping[str, float]:
        """Return the CPU time of each stage that computed what is kept by this fingerprint, s."""

    def keep(self, fingerprint: str, result: object, durations: Mapping[str, float]) -> None:
        """Keep a result by its fingerprint, and the CPU time of each stage that computed it."""


@dataclass(frozen=True, eq=False)
class _Shaking:
    """The motion of a record at one place.

    grounds: its components on the ground. floor: on a support, the pulses of each as it arrives there. pair: both
    components; None of one, of two that are none, and without an ensemble.
    """

    grounds: tuple[Component, ...]
    support: MovingSupport | None
    floor: tuple[ComponentPulses, ...]
    pair: Motion | None = None

    @property
    def components(self) -> tuple[Component, ...]:
        """The components as they arrive there."""
        return self.grounds if self.support is None else on_support(self.support, self.grounds, self.floor)


@dataclass(frozen=True, eq=False)
class Assessor:
    """Follows scenes under one record, step by step: pulses, predict, integrate, compare; `assess` takes all four.

    crack_heights: number of heights tried for a hinge or a crack. processing_variants: whether other processings are
    tried. motion_measures: whether the velocity pulse of the components and their peaks over all directions are
    measured, as tables report them. version: of the computation, which enters fingerprints. store: where results are
    looked up before they are computed, and kept. clock: has measured what came before.
    """

    settings: AssessmentSettings = field(default_factory=AssessmentSettings)
    crack_heights: int = 0
    processing_variants: bool = False
    motion_measures: bool = False
    version: str = ""
    store: Store | None = None
    clock: Clock = field(default_factory=Clock)

    def assess(
        self,
        record: str,
        horizontal: Sequence[Accelerogram],
        scenes: Mapping[str, Scene],
        vertical: Accelerogram | None = None,
    ) -> RecordResult:
        """Return what comes of every scene under a record; one that fails costs no other.

        horizontal: its components. See the four steps, in their order.
        """
        components = self.pulses(horizontal, vertical)
        predictions = self.predict(components, scenes)
        result = self.integrate(record, components, scenes, predictions, vertical)
        return self.compare(self._sharing_members(result, scenes, predictions, vertical))

    def _sharing_members(
        self,
        result: RecordResult,
        scenes: Mapping[str, Scene],
        predictions: Predictions,
        vertical: Accelerogram | None,
    ) -> RecordResult:
        """The result with as many members of each variant of a structure as of the one that needs most.

        Their shares are compared, and then have the same error. One whose members all agree has none and is left.
        """
        for structure, names in variants_of(scenes).items():
            of_variants = {
                name: result.scenes[name].worst.ensemble
                for name in (structure, *names)
                if name in result.scenes
            }
            most = max((members.rotation_ratios.size for members in of_variants.values()), default=0)
            fewer = {
                name: scenes[name]
                for name, members in of_variants.items()
                if 0 < members.rotation_ratios.size < most and members.facts().share_error
            }
            if fewer:
                ensemble = replace(self.settings.ensemble, members=most)
                assessor = replace(self, settings=replace(self.settings, ensemble=ensemble))
                again = assessor.integrate(result.record, result.components, fewer, predictions, vertical)
                failures = tuple(dict.fromkeys((*result.failures, *again.failures)))
                result = replace(result, scenes={**result.scenes, **again.scenes}, failures=failures)
                # With more members one may need more still.
                return self._sharing_members(result, scenes, predictions, vertical)
        return result

    def pulses(
        self, horizontal: Sequence[Accelerogram], vertical: Accelerogram | None
    ) -> tuple[Component, ...]:
        """Return the components of a record with the pulses of each. vertical: acts with them."""
        verticals = [None if vertical is None else aligned(vertical, component) for component in horizontal]
        found = self._searched(horizontal, self.motion_measures)
        return tuple(
            pulses.component_of(accelerogram, lift)
            for pulses, accelerogram, lift in zip(found, horizontal, verticals, strict=True)
        )

    def _searched(self, horizontal: Sequence[Accelerogram], measured: bool) -> tuple[ComponentPulses, ...]:
        """The pulses of each component of a record. measured: whether they are measured as a pair, too."""
        each_alone = tuple(Motion((component,)) for component in horizontal)
        found = []
        for place in range(len(horizontal)):
            inputs = PulseInputs(
                components=each_alone, place=place, settings=self.settings.pulse, measured=measured
            )
            found.append(self._remembered(ComponentPulses, inputs, compute_pulses))
        return tuple(found)

    def predict(self, components: Sequence[Component], scenes: Mapping[str, Scene]) -> Predictions:
        """Return the closed form of each scene's equivalent block under the pulse of each component."""
        of_all: dict[tuple[str, str], Prediction | Failure | None] = {}
        for scene in scenes.values():
            try:
                with one_structure(scene.name):
                    scale = self.settings.acceleration_scale
                    mechanism = scene.structure.mechanism()
                    mechanism.equivalent_block(scale)  # no part of what is timed
                    for name, component in by_name(components).items():
                        if not (component.candidates and mechanism.can_overturn):
                            of_all[scene.name, name] = None
                            continue
                        inputs = PredictionInputs(
                            structure=scene.structure,
                            candidates=component.candidates,
                            acceleration_scale=scale,
                        )
                        of_all[scene.name, name] = self._remembered(Prediction, inputs, compute_prediction)
            except FaultError as error:
                failure = Failure("prediction", str(error))
                of_all |= {(scene.name, name): failure for name in by_name(components)}
            except RockingError:
                continue  # why it cannot be followed, the integration says
        return of_all

    def integrate(
        self,
        record: str,
        components: tuple[Component, ...],
        scenes: Mapping[str, Scene],
        predictions: Predictions,
        vertical: Accelerogram | None = None,
    ) -> RecordResult:
        """Return the motion of every scene under the whole record, its members and its reserve.

        An ensemble over the directions of a pair speaks for both components, which then get none of their own. A
        structure on a support meets the motion there, at every one of its periods, and for comparison that of the
        ground. The reserve is computed on the ground and at the worst period, which reports print.
        """
        grounds = components
        failures: list[tuple[str, Failure]] = []
        shakings: dict[MovingSupport | None, _Shaking] = {}
        periods: dict[tuple[str, MovingSupport | None], PeriodResult] = {}
        wanted: dict[MovingSupport | None, list[Scene]] = {None: list(scenes.values())}
        for scene in scenes.values():
            for own_support in scene.place.supports:
                wanted.setdefault(own_support, []).append(scene)
        # By support, so that what its motion stands for is made once for all that it carries.
        for support, carried in wanted.items() if grounds else ():
            try:
                floor = () if support is None else self._pulses_on(support, grounds)
                shaking = _Shaking(grounds, support, floor)
                shaking = shakings[support] = self._with_pair(shaking, vertical, failures)
            except RockingError as error:
                names = list(by_name(grounds))
                periods |= {(scene.name, support): _lost(scene, support, names, error) for scene in carried}
                continue
            if support is not None:
                predictions = self.predict(shaking.components, {scene.name: scene for scene in carried})
            for scene in carried:
                try:
                    with one_structure(scene.name):
                        period_result = self._period_result(scene, shaking, predictions)
                except RockingError as error:
                    period_result = _lost(scene, support, list(by_name(shaking.components)), error)
                if support is None:
                    period_result = self._with_reserve(period_result, shaking, failures)
                periods[scene.name, support] = period_result

        results = {}
        for scene in scenes.values():
            along = [
                periods[scene.name, support]
                for support in (None, *scene.place.supports)
                if (scene.name, support) in periods
            ]
            with_members = [
                period_result for period_result in along if period_result.support and period_result.decisive
            ]
            if with_members:
                worst = max(with_members, key=lambda period_result: period_result.severity)
                along[along.index(worst)] = self._with_reserve(worst, shakings[worst.support], failures)
            if along:
                results[scene.name] = SceneResult(scene, tuple(along))
        return RecordResult(
            record=record,
            components=grounds,
            scenes=results,
            failures=tuple(failures),
            durations=dict(self.clock.durations),
            floors={support: shaking.floor for support, shaking in shakings.items() if support is not None},
        )

    def compare(self, result: RecordResult) -> RecordResult:
        """Return the result with the methods compared on the crack that governs each case.

        So a row of a table speaks of one crack. With fidelity: quick nothing is compared.
        """
        if self.settings.fidelity == "quick":
            return result
        scenes = {}
        for name, of_scene in result.scenes.items():
            periods = []
            for period_result in of_scene.periods:
                components = result.components_under(period_result)
                cases = {}
                for component, case in period_result.cases.items():
                    try:
                        with one_structure(name):
                            cases[component] = self._of_governing(period_result, case, components[component])
                    except RockingError as error:
                        failure = Failure("comparison", str(error))
                        cases[component] = replace(case, failures=(*case.failures, failure))
                periods.append(replace(period_result, cases=cases))
            scenes[name] = replace(of_scene, periods=tuple(periods))
        return replace(result, scenes=scenes, durations=dict(self.clock.durations))

    # The motion -----------------------------------------------------------------------------------------

    def _pulses_on(self, support: MovingSupport, grounds: Sequence[Component]) -> tuple[ComponentPulses, ...]:
        """The pulses of each component as it arrives on a support."""
        with self.clock.stage("supports"):
            motions = [
                arrived(Motion((ground.accelerogram,), ground.vertical, support)) for ground in grounds
            ]
        floors = [next(iter(motion.horizontal.values())) for motion in motions]
        return self._searched(floors, measured=False)

    def _with_pair(
        self, shaking: _Shaking, vertical: Accelerogram | None, failures: list[tuple[str, Failure]]
    ) -> _Shaking:
        """The motion at one place with its pair; why it is none, or has no pulse, is added to the failures."""
        if len(shaking.grounds) == 2 and self.settings.ensemble.members:
            components = tuple(ground.accelerogram for ground in shaking.grounds)
            pair = Motion(components, vertical, shaking.support)
            inputs = PairInputs(pair=pair, processing=self.settings.ensemble.processing)
            try:
                # Where every case is kept, its motions are not made: only that they can be is to be known.
                self._remembered(int, inputs, count_motions)
                shaking = replace(shaking, pair=pair)
            except RockingError as error:
                failures.append((BOTH_COMPONENTS, Failure("directions", str(error))))
        for name, component in by_name(shaking.components).items():
            if component.failure:
                failures.append((name, Failure("pulses", component.failure)))
        return shaking

    # One scene ------------------------------------------------------------------------------------------

    def _period_result(self, scene: Scene, shaking: _Shaking, predictions: Predictions) -> PeriodResult:
        """The result of one scene at one place."""
        cases = {}
        for name, component in by_name(shaking.components).items():
            prediction = predictions.get((scene.name, name))
            failed = (prediction,) if isinstance(prediction, Failure) else ()
            found = None if isinstance(prediction, Failure) else prediction
            case = self._of_component(scene, component, found, alone=shaking.pair is None)
            cases[name] = replace(case, component=name, failures=(*failed, *case.failures))
        directions = None
        pair = shaking.pair
        if pair is not None and any(case.response is not None for case in cases.values()):
            bounces = any(case.check.bounces for case in cases.values())
            inputs = CaseInputs(
                motion=pair, structure=scene.structure, settings=self.settings, bounces=bounces
            )
            directions = replace(self._case(inputs), structure=scene.name)
        loss = scene.terms.support_loss
        cases = {name: case.losing_seats(scene.structure, loss) for name, case in cases.items()}
        directions = directions and directions.losing_seats(scene.structure, loss)
        return PeriodResult.of(scene, cases, directions, shaking.support)

    def _of_governing(
        self, period_result: PeriodResult, case: CaseResult, component: Component
    ) -> CaseResult:
        """The case with the methods compared on the crack that governs, so that a row of a table speaks of one crack.

        It keeps the case itself, which is of the structure's own crack.
        """
        if case.response is None:
            return case
        ensembles = case.ensembles or period_result.ensembles
        crack = ensembles.governing.description if ensembles else ""
        body = cracked(period_result.scene.structure, crack)
        own, other = period_result.scene.structure.mechanism(), body.mechanism()
        # The hinge that statics seeks and the candidate at the same height are computed apart.
        same = isclose(own.uplift_multiplier, other.uplift_multiplier, rel_tol=1e-9)
        if same and isclose(own.critical_rotation, other.critical_rotation, rel_tol=1e-9):
            return case

        prediction = predict(other, component.candidates, self.settings)
        governing = self._case(
            CaseInputs(
                motion=component.of_ground,
                structure=body,
                settings=self.settings,
                pulse=prediction.pulse if prediction else None,
                alone=False,
            )
        )
        if governing.response is None:
            return replace(case, failures=(*case.failures, *governing.failures))
        return replace(
            case,
            prediction=prediction,
            responses=governing.responses,
            check=governing.check,
            crack=crack,
            statics=case,
        )

    def _of_component(
        self, scene: Scene, component: Component, prediction: Prediction | None, alone: bool
    ) -> CaseResult:
        """The case under one component. alone: whether no ensemble over directions speaks for it."""
        # Without members nothing else follows the mechanism that statics chooses.
        unless_asked = 0 if self.settings.ensemble.members else CRACKS
        case = self._case(
            CaseInputs(
                motion=component.of_ground,
                structure=scene.structure,
                settings=self.settings,
                pulse=prediction.pulse if prediction else None,
                alone=alone,
                crack_heights=self.crack_heights or unless_asked,
                processing_variants=self.processing_variants,
            )
        )
        return replace(
            case, structure=scene.name, prediction=prediction if case.response is not None else None
        )

    def _case(self, inputs: CaseInputs) -> CaseResult:
        return self._remembered(CaseResult, inputs, compute_case, lambda case: case.kept)

    def _with_reserve(
        self, period_result: PeriodResult, shaking: _Shaking, failures: list[tuple[str, Failure]]
    ) -> PeriodResult:
        """The result with the reserve of the crack that governs the case that decides.

        With fidelity: quick, which needs the verdict alone, no reserve is computed, nor where nothing can overturn the
        structure, nor where it slides first. Why there is none is added to the failures.
        """
        try:
            with one_structure(period_result.structure):
                return self._reserved(period_result, shaking)
        except RockingError as error:
            component = period_result.decisive.component if period_result.decisive else ""
            failures.append((component, Failure("reserve", f"{period_result.structure}: {error}")))
            return period_result

    def _reserved(self, period_result: PeriodResult, shaking: _Shaking) -> PeriodResult:
        """The result with its reserve, where it has one. Raises RockingError where it cannot be found."""
        case = period_result.decisive
        sought = self.settings.fidelity != "quick" and self.settings.ensemble.reserve
        if case is None or case.ensembles is None or not sought:
            return period_result
        structure = period_result.scene.structure
        description = case.ensembles.governing.description
        crack = crack_named(structure, description)
        loss = period_result.scene.terms.support_loss
        # Of what slides before it lifts nothing can be told at any factor.
        slides = not isnan(slides_at(crack)) and not crack.bulges
        if slides or (isinf(loss) and not crack.mechanism.can_overturn):
            return period_result
        of_pair = case is period_result.directions and shaking.pair is not None
        motion = shaking.pair if of_pair else by_name(shaking.components)[case.component].of_ground
        assert motion is not None

        share = period_result.decision.share
        inputs = ReserveInputs(
            motion=motion,
            structure=structure,
            crack=description,
            settings=self.settings,
            support_loss=loss,
            share=period_result.ensemble.overturning_share if isnan(share) else share,
        )
        with_it = replace(case, reserve=self._remembered(Reserve, inputs, compute_reserve))
        if case is period_result.directions:
            return replace(period_result, directions=with_it)
        return replace(period_result, cases={**period_result.cases, case.component: with_it})

    # What is kept ---------------------------------------------------------------------------------------

    def _remembered(
        self,
        kind: type[T],
        inputs: I,
        compute: Callable[[I, Clock], T],
        kept: Callable[[T], T] = lambda result: result,
    ) -> T:
        """What the store holds by these inputs, else what is computed, of which it then holds what is `kept`."""
        if self.store is None:
            return compute(inputs, self.clock)
        fingerprint = sha256_of(inputs.fingerprint, self.version)
        found = self.store.find(kind, fingerprint)
        if found is not None:
            self.clock.add(self.store.durations(fingerprint))
            return found
        own = Clock()
        result = compute(inputs, own)
        self.clock.add(own.durations)
        self.store.keep(fingerprint, kept(result), own.durations)
        return result


def _lost(
    scene: Scene, support: MovingSupport | None, names: Sequence[str], error: RockingError
) -> PeriodResult:
    """The result of a scene to whose support the record cannot be taken: why. names: of the components."""
    failure = Failure("responses", str(error))
    cases = {name: CaseResult(structure=scene.name, component=name, failures=(failure,)) for name in names}
    return PeriodResult.of(scene, cases, support=support)


def with_histories(
    result: RecordResult,
    tolerance: float,
    shown: Container[tuple[str, str, float | None]] | None = None,
) -> RecordResult:
    """Return a record's result whose responses hold their histories, which results that were kept do not.

    shown: those of these alone, by component, structure and period of its support; None: all.
    """
    scenes = {}
    for name, scene in result.scenes.items():
        periods = []
        for period_result in scene.periods:
            components = result.components_under(period_result)
            cases = dict(period_result.cases)
            for component, case in period_result.cases.items():
                if shown is not None and (component, name, period_result.support_period_s) not in shown:
                    continue
                # The case itself has stood this run; without its history it is not drawn.
                with suppress(FaultError), one_structure(name):
                    body = cracked(period_result.scene.structure, case.crack)
                    cases[component] = _with_history(case, body, components[component], tolerance)
            periods.append(replace(period_result, cases=cases))
        scenes[name] = replace(scene, periods=tuple(periods))
    return replace(result, scenes=scenes)


def _with_history(case: CaseResult, body: Structure, component: Component, tolerance: float) -> CaseResult:
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
