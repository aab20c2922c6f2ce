"""One record against structures: predictions, integrations and the two side by side; and one structure in one call."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import partial
from math import inf, nan
from statistics import median
from time import process_time
from typing import TYPE_CHECKING, Any

from rocking.assessment.ensemble import Ensemble, GroundMotions
from rocking.assessment.fidelity import Answer, Estimate, Tier, cheapest_answer, estimated
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.variations import cracks, ensemble_over_cracks
from rocking.assessment.verdict import Method, ratio_in_words
from rocking.drawn import Drawn
from rocking.errors import ConfigurationError, PulseError, RockingError
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

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True)
class Prediction:
    """The closed forms of one structure under one pulse.

    pulse_rank: of the pulse among those that its method offers. amplitude_ratio, frequency_ratio: a and ω_g/p.
    """

    block: EquivalentBlock
    pulse: Pulse
    pulse_rank: int
    amplitude_ratio: float
    frequency_ratio: float
    printed_rotation_ratio: float
    maximum: Maximum


@dataclass(frozen=True)
class Case:
    """One structure under one accelerogram. prediction is None where the record has no pulse.

    check: whether the model held along the response of the mechanism to the record. answer: of the mechanism on the
    record, or of the cheapest method that settles the case. ensemble: None where none ran. overturning_estimate: from
    the peak velocity, where no ensemble ran; None of a structure unlike those behind the estimate. durations: CPU time
    of the methods that were compared, s.
    """

    structure: str
    mechanism: Mechanism
    prediction: Prediction | None
    responses: Mapping[Method, Response]
    check: ModelCheck
    answer: Answer
    ensemble: Ensemble | None = None
    overturning_estimate: Estimate | None = None
    durations: Mapping[Method, float] = field(default_factory=dict)

    @property
    def predicted_rotation_ratio(self) -> float:
        """Rotation ratio of the closed form; nan without a pulse."""
        return self.prediction.maximum.rotation_ratio if self.prediction else nan

    @property
    def integrated_rotation_ratio(self) -> float:
        """Rotation ratio of the mechanism on the record; nan where a cheaper method settled the case."""
        response = self.responses.get(Method.MECHANISM_ON_RECORD)
        return response.rotation_ratio if response else nan


@dataclass(frozen=True)
class Failure:
    """A stage that gave no result: for which structure ("" for all), and why."""

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
    alone: bool = True,
) -> Assessment:
    """Predict and integrate every structure under `accelerogram`; one that fails costs no other.

    alone: False where an ensemble over the directions of the record speaks for its components, which then get neither
    an ensemble nor an estimate of their own.
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
    mechanism: Mechanism, candidates: Sequence[PulseEvidence], settings: AssessmentSettings | None = None
) -> Prediction:
    """Return the closed forms of the equivalent block of `mechanism` under the candidate of largest demand.

    candidates: as a pulse method offers them.
    """
    settings = settings or AssessmentSettings()
    block = mechanism.equivalent_block(settings.acceleration_scale)
    chosen = predicting_pulse(candidates, lambda pulse: predict_maximum(block, pulse).rotation_ratio)
    pulse = chosen.pulse
    # Positive acceleration lifts the negative side first.
    side = block.other_side if block.other_side is not None and pulse.amplitude > 0 else block
    return Prediction(
        block=block,
        pulse=pulse,
        pulse_rank=candidates.index(chosen) + 1,
        amplitude_ratio=abs(pulse.amplitude) / (GRAVITY * side.uplift_multiplier),
        frequency_ratio=pulse.circular_frequency / block.frequency_parameter,
        printed_rotation_ratio=printed_maximum(block, pulse),
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
    # The block is made before the clock of the closed form starts, which does not count it.
    block = mechanism.equivalent_block(settings.acceleration_scale)
    durations: dict[Method, float] = {}
    prediction = None
    if candidates:
        started = process_time()
        prediction = predict(mechanism, candidates, settings)
        durations[Method.CLOSED_FORM] = process_time() - started
    responses: dict[Method, Response] = {}
    auto = settings.fidelity == "auto"
    members = settings.ensemble.members if alone else 0
    if auto:
        answer = _cheapest(structure, mechanism, record, settings, vertical, ensemble_follows=members > 0)
        if answer.response is not None:
            responses[Method.MECHANISM_ON_RECORD] = answer.response
    else:
        follow = partial(integrate, tolerance=settings.tolerance)
        runs = {
            Method.MECHANISM_ON_RECORD: partial(follow, mechanism, record, history=True, vertical=vertical),
            Method.BLOCK_ON_RECORD: partial(follow, block, record, vertical=vertical),
        }
        if prediction is not None:
            runs[Method.MECHANISM_ON_PULSE] = partial(follow, mechanism, prediction.pulse)
        for method, run in runs.items():
            started = process_time()
            responses[method] = run()
            durations[method] = process_time() - started
        whole = responses[Method.MECHANISM_ON_RECORD]
        answer = Answer(Method.MECHANISM_ON_RECORD, whole.outcome, "", whole)
    check = UNKNOWN
    if isinstance(structure, Structure) and answer.response is not None:
        check = check_model(structure, answer.response, record, vertical)
    case = Case(name, mechanism, prediction, responses, check, answer, durations=durations)
    if members and answer.method is Method.MECHANISM_ON_RECORD:
        motions = GroundMotions.of(record, vertical=vertical, processing=settings.ensemble.processing)
        ensemble = ensemble_over_cracks(structure, motions, settings, verdict_only=auto)
        return replace(case, ensemble=replace(ensemble, rotation_ratio=case.integrated_rotation_ratio))
    if alone and vertical is None:
        return replace(case, overturning_estimate=estimated(Tier.PEAK_VELOCITY, mechanism, record))
    return case


def _cheapest(
    structure: Structure | Mechanism,
    mechanism: Mechanism,
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
    ensemble_follows: bool,
) -> Answer:
    """Return what settles the verdict with the least work.

    Where other cracks may form, nothing cheaper than the mechanism settles it unless all of them rest, or stand by
    their peak velocities.
    """
    mechanisms = [each for _, each in cracks(structure)]
    of_statics = mechanism if len(mechanisms) == 1 else mechanisms[0]
    risk = settings.fidelity_risk
    if len(mechanisms) > 1 and isinstance(structure, Structure):
        motion = record.scaled(structure.crack_margin)
        estimates = (estimated(Tier.PEAK_VELOCITY, each, motion) for each in mechanisms)
        if not all(each is not None and each.high <= risk for each in estimates):
            risk = 0.0
    how: Any = {"tolerance": settings.tolerance, "vertical": vertical, "history": True}
    answer = cheapest_answer(of_statics, record, risk=risk, ensemble_follows=ensemble_follows, **how)
    if answer.method is not Method.MECHANISM_ON_RECORD or of_statics is mechanism:
        return answer
    whole = integrate(mechanism, record, **how)
    return replace(answer, outcome=whole.outcome, response=whole)


@dataclass(frozen=True)
class Governing:
    """The mechanism that governs: what opens, the share of members that overturn, and their median rotation ratio."""

    description: str
    overturning_share: float
    rotation_ratio: float


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class StructureAssessment(Drawn, Ensemble):
    """What came of one structure: the ensemble over all uncertain inputs, directions included.

    cases: by component. rotation_ratio: largest rotation over critical rotation of the case as given, the worse
    component; inf if it overturns. static_multiplier: least λ of the cracks that may form, the acceleration in g at
    which statics lets it fall. `plot` draws the rotation as given, with the members' 5–95 % beside it.

    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> assessment = rocking.assess(record, rocking.Block(2.0, 0.2))
    >>> print(assessment.verdict)
    overturns
    """

    cases: Mapping[str, Case]
    static_multiplier: float

    @property
    def governing(self) -> Governing:
        """The mechanism of statics, or the one that does not stand though that does; "" where there is one only."""
        worst = self.elsewhere or self
        return Governing(worst.crack, worst.overturning_share, worst.rotation_ratio_median)

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
        other = self.elsewhere
        ratios = (self.rotation_ratio, self.rotation_ratio_low, self.rotation_ratio_high)
        given, low, high = ("overturns" if ratio == inf else f"{ratio:.2g}" for ratio in ratios)
        there = f"; with the {other.crack} in {other.overturning_members} of {other.members}" if other else ""
        return (
            f"<{self.verdict}: overturns in {self.overturning_members} of {self.members} members; as given {given}, "
            f"5–95 % {low} to {high} of the critical rotation{there}>"
        )

    def frame(self) -> "DataFrame":
        """One row per method and component: its rotation ratio, and how that stands to the integration, in words."""
        from pandas import DataFrame  # slow to import, and needed by those alone who ask for a frame

        rows = []
        for component, case in self.cases.items():
            ratios = {Method.CLOSED_FORM: case.predicted_rotation_ratio} if case.prediction else {}
            ratios |= {method: response.rotation_ratio for method, response in case.responses.items()}
            for method, ratio in ratios.items():
                whole = method is Method.MECHANISM_ON_RECORD
                words = "" if whole else ratio_in_words(ratio, case.integrated_rotation_ratio)
                rows.append((component, str(method), ratio, words))
        return DataFrame(rows, columns=["component", "method", "rotation_ratio", "in_words"])


def assess(
    record: Accelerogram | Sequence[Accelerogram] | object,
    structure: Structure | Mechanism,
    *,
    members: int | None = None,
    settings: AssessmentSettings | None = None,
    vertical: Accelerogram | None = None,
) -> StructureAssessment:
    """Return the verdict on `structure` under `record`, with the ensemble that says how sure it is.

    record: one accelerogram, or both horizontal components, which then make one ensemble over eight directions; or an
    obspy Stream or Trace, as Accelerogram.from_obspy reads it, whose vertical component acts too. members: of the
    ensemble, by default those of the settings. vertical: sample by sample as the record; half of the members feel it.
    Raises ConfigurationError for no record or more than two, RockingError where it cannot be followed.

    >>> pulse = rocking.Pulse(amplitude=3.0, circular_frequency=8.0, start_time=0.5)
    >>> record = rocking.Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    >>> print(rocking.assess(record, rocking.Block(semi_diagonal=2.0, slenderness=0.2)).verdict)
    stands
    """
    if type(record).__module__.startswith("obspy."):
        channels = Accelerogram.from_obspy(record)
        record = [each for each in channels if not each.vertical]
        vertical = vertical or next((each for each in channels if each.vertical), None)
    records = _checked_records(record)
    settings = settings or AssessmentSettings()
    for name, value, allowed, words in (
        ("structure", structure, Structure | Mechanism, "a structure or a mechanism"),
        ("vertical", vertical, Accelerogram | None, "an accelerogram"),
        ("settings", settings, AssessmentSettings, "AssessmentSettings"),
    ):
        if not isinstance(value, allowed):
            raise ConfigurationError(f"{name} is a {type(value).__name__}, but must be {words}.")
    number = settings.ensemble.members if members is None else members
    varied = replace(settings.ensemble, members=number or EnsembleSettings().members)
    settings = replace(settings, fidelity="full", ensemble=varied)
    names = [each.component for each in records]
    if len(set(names)) < len(names) or not all(names):
        names = [f"component {place}" for place, _ in enumerate(records, start=1)]
    cases = {}
    for name, each in zip(names, records, strict=True):
        alone = len(records) == 1
        assessment = assess_structures(each, {"structure": structure}, settings, vertical, alone)
        if not assessment.cases:
            raise RockingError(assessment.failures[-1].message)
        cases[name] = assessment.cases[0]
    over_all = cases[names[0]].ensemble
    if over_all is None:
        motions = GroundMotions.of(*records, vertical=vertical, processing=varied.processing)
        over_all = ensemble_over_cracks(structure, motions, settings)
    of_all = {each.name: getattr(over_all, each.name) for each in fields(Ensemble)}
    of_all["rotation_ratio"] = max(case.integrated_rotation_ratio for case in cases.values())
    multiplier = cracks(structure)[0][1].uplift_multiplier
    return StructureAssessment(**of_all, cases=cases, static_multiplier=multiplier)


def _checked_records(record: object) -> list[Accelerogram]:
    """The horizontal components. Raises ConfigurationError unless they are one or two accelerograms."""
    records = [record] if isinstance(record, Accelerogram) else record
    if isinstance(records, str | bytes) or not isinstance(records, Sequence):
        wrong = f"is a {type(record).__name__}, but must be an accelerogram, or two horizontal ones; "
        wrong += "rocking.read gives those of a file"
    elif odd := [each for each in records if not isinstance(each, Accelerogram)]:
        wrong = f"holds a {type(odd[0]).__name__}, but must hold accelerograms"
    elif len(records) not in (1, 2):
        wrong = f"holds {len(records)} accelerograms, but must hold one or two horizontal ones"
    else:
        return list(records)
    raise ConfigurationError(f"record {wrong}.")
