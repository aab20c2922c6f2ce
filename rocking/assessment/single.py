"""One structure under one record, in one call: what can be said of it, and how sure that is."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import NoneType
from typing import TYPE_CHECKING, Any

from rocking.assessment.assess import Case, assess_structures
from rocking.assessment.ensemble import Ensemble, EnsembleSettings, GroundMotions
from rocking.assessment.method import Method
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.variations import cracks, ensemble_over_cracks
from rocking.assessment.verdict import Verdict, ratio_in_words
from rocking.errors import ConfigurationError, RockingError
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Mechanism, Structure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame

_NAME = "structure"


@dataclass(frozen=True)
class Governing:
    """The mechanism that governs: what opens, the share of members that overturn, and their median rotation ratio."""

    description: str
    overturning_share: float
    rotation_ratio: float


@dataclass(frozen=True, eq=False, repr=False)
class StructureAssessment:
    """What came of one structure. cases: by component. ensemble: over all that is not known, directions included.

    static_multiplier: least λ of the cracks that may form, the acceleration in g at which statics lets it fall.

    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> assessment = rocking.assess(record, rocking.Block(2.0, 0.2))
    >>> print(assessment.verdict)
    overturns
    """

    cases: Mapping[str, Case]
    ensemble: Ensemble
    static_multiplier: float

    @property
    def verdict(self) -> Verdict:
        """Stands, overturns or undecided, from the ensemble."""
        return self.ensemble.verdict

    @property
    def governing(self) -> Governing:
        """The mechanism of statics, or the one that does not stand though that does; "" where there is one only."""
        worst = self.ensemble.elsewhere or self.ensemble
        return Governing(worst.crack, worst.overturning_share, worst.median)

    @property
    def falls_to(self) -> int:
        """Side to which it falls as given, 1 or -1 as `Response.peak_side` counts them; 0 where it does not."""
        return self.response.peak_side if self.rotation_ratio == float("inf") else 0

    @property
    def overturning_share(self) -> float:
        """Share of the members that overturn."""
        return self.ensemble.overturning_share

    @property
    def rotation_ratio(self) -> float:
        """Largest rotation over critical rotation of the case as given, the worse component; inf if it overturns."""
        return self.ensemble.nominal

    @property
    def rotation_ratio_low(self) -> float:
        """5 % quantile of the members'."""
        return self.ensemble.low

    @property
    def rotation_ratio_median(self) -> float:
        """Median of the members'."""
        return self.ensemble.median

    @property
    def rotation_ratio_high(self) -> float:
        """95 % quantile of the members'; inf where more than 5 % overturn."""
        return self.ensemble.high

    @property
    def members(self) -> int:
        """Members of the ensemble."""
        return self.ensemble.members

    @property
    def response(self) -> Response:
        """The integration of the mechanism as given, with its history; of the worse component."""
        responses = [case.responses[Method.MECHANISM_ON_RECORD] for case in self.cases.values()]
        return max(responses, key=lambda response: response.rotation_ratio)

    def __repr__(self) -> str:
        return (
            f"<{self.verdict}: overturns in {self.ensemble.overturning} of {self.members} members; as given "
            f"{_shown(self.rotation_ratio)}, 5–95 % {_shown(self.rotation_ratio_low)} to "
            f"{_shown(self.rotation_ratio_high)} of the critical rotation{self._elsewhere}>"
        )

    @property
    def _elsewhere(self) -> str:
        other = self.ensemble.elsewhere
        return "" if other is None else f"; with the {other.crack} in {other.overturning} of {other.members}"

    def frame(self) -> "DataFrame":
        """One row per method and component: its rotation ratio, and how that stands to the integration, in words."""
        from pandas import DataFrame  # slow to import, and needed by those alone who ask for a frame

        return DataFrame(row for component, case in self.cases.items() for row in _rows(component, case))

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the rotation of the case as given against time, with the members' 5–95 % beside it; return the axes."""
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)


def assess(
    record: Accelerogram | Sequence[Accelerogram] | object,
    structure: Structure | Mechanism,
    *,
    members: int | None = None,
    settings: AssessmentSettings | None = None,
    vertical: Accelerogram | None = None,
) -> StructureAssessment:
    """Say whether `structure` survives `record`, and how sure that is.

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
    for name, value, allowed, words in (
        ("structure", structure, (Structure, Mechanism), "a structure or a mechanism"),
        ("vertical", vertical, (Accelerogram, NoneType), "an accelerogram"),
        ("settings", settings, (AssessmentSettings, NoneType), "AssessmentSettings"),
    ):
        if not isinstance(value, allowed):
            raise ConfigurationError(f"{name} is a {type(value).__name__}, but must be {words}.")
    settings = replace(settings or AssessmentSettings(), fidelity="full")
    if members is not None:
        settings = replace(settings, ensemble=replace(settings.ensemble, members=members))
    if settings.ensemble.members == 0:
        settings = replace(settings, ensemble=replace(settings.ensemble, members=EnsembleSettings().members))
    names = [each.component for each in records]
    if len(set(names)) < len(names) or not all(names):
        names = [f"component {place}" for place, _ in enumerate(records, start=1)]
    cases = {}
    for name, each in zip(names, records, strict=True):
        assessment = assess_structures(each, {_NAME: structure}, settings, vertical, alone=len(records) == 1)
        if not assessment.cases:
            raise RockingError(assessment.failures[-1].message)
        cases[name] = assessment.cases[0]
    over_all = _over_all(records, structure, cases, settings, vertical)
    return StructureAssessment(cases, over_all, cracks(structure)[0][1].uplift_multiplier)


def _checked_records(record: object) -> list[Accelerogram]:
    """The horizontal components. Raises ConfigurationError unless they are one or two accelerograms."""
    records = [record] if isinstance(record, Accelerogram) else record
    if isinstance(records, str | bytes) or not isinstance(records, Sequence):
        raise ConfigurationError(
            f"record is a {type(record).__name__}, but must be an accelerogram, or two horizontal ones; "
            "rocking.read gives those of a file."
        )
    for each in records:
        if not isinstance(each, Accelerogram):
            raise ConfigurationError(f"record holds a {type(each).__name__}, but must hold accelerograms.")
    if len(records) not in (1, 2):
        raise ConfigurationError(
            f"record holds {len(records)} accelerograms, but must hold one or two horizontal ones."
        )
    return list(records)


def _over_all(
    records: Sequence[Accelerogram],
    structure: Structure | Mechanism,
    cases: Mapping[str, Case],
    settings: AssessmentSettings,
    vertical: Accelerogram | None,
) -> Ensemble:
    alone = [case.ensemble for case in cases.values() if case.ensemble is not None]
    if len(records) == 1:
        return alone[0]
    return ensemble_over_cracks(
        structure,
        GroundMotions.of_pair(records[0], records[1], vertical, processing=settings.ensemble.processing),
        settings,
        nominal=max(each.nominal for each in alone),
    )


def _rows(component: str, case: Case) -> list[dict[str, Any]]:
    integrated = case.responses[Method.MECHANISM_ON_RECORD].rotation_ratio
    ratios = {method: response.rotation_ratio for method, response in case.responses.items()}
    if case.prediction is not None:
        ratios[Method.CLOSED_FORM] = case.prediction.maximum.rotation_ratio
    return [
        {
            "component": component,
            "method": str(method),
            "rotation_ratio": ratios[method],
            "in_words": ""
            if method is Method.MECHANISM_ON_RECORD
            else ratio_in_words(ratios[method], integrated),
        }
        for method in Method
        if method in ratios
    ]


def _shown(rotation_ratio: float) -> str:
    return "overturns" if rotation_ratio == float("inf") else f"{rotation_ratio:.2g}"
