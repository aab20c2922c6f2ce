"""Assess: the door for Python, one record and one structure in, the verdict with its ensemble out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from math import inf
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocking.assessment.assessor import Assessor
from rocking.assessment.case import PeriodResult
from rocking.assessment.cracks import FollowedCrack, cracked
from rocking.assessment.methods import Method, ratio_in_words
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.drawn import Drawn, in_a_notebook
from rocking.errors import ConfigurationError, RecordError, RockingError
from rocking.motion.response import Response
from rocking.quantities import kind_of
from rocking.records import Accelerogram
from rocking.records.obspy.stream import from_obspy
from rocking.structures import Mechanism, Structure

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, eq=False, repr=False)
class StructureAssessment(PeriodResult, Drawn):
    """The result of one structure: the verdict with the ensemble over all uncertain inputs, directions included.

    `rotation_ratio` is the largest rotation over the critical one under the record as recorded, of the worse
    component; inf if it overturns. `plot` draws that rotation, with the members' 5–95 %.

    Parameters
    ----------
    scene : Scene
        The structure, and where it stands.
    cases : mapping of str to CaseResult
        Result of each component, by its name.
    directions : CaseResult or None
        Result of the pair over its directions; None of one component.
    support : MovingSupport or None
        What carries the structure; None on the ground.
    decision : Decision
        What becomes of it.
    decided_on : str
        Name of the component that decides, or "both".

    Examples
    --------
    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> assessment = rocking.assess(record, rocking.Block(2.0, 0.2))
    >>> print(assessment.verdict)
    overturns
    """

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism with the crack that governs."""
        return cracked(self.body, self.worst.crack if self.worst else "").mechanism()

    @property
    def body(self) -> Structure:
        """The structure itself."""
        return self.scene.structure

    @property
    def overturning_share(self) -> float:
        """The largest share that overturns, of members and stacks; of a single run 0 or 1, nan where there is none."""
        return self.decision.share

    @property
    def why(self) -> str:
        """The reason for the verdict."""
        return self.decision.why

    @property
    def members(self) -> int:
        """Number of members that were followed; 0 without an ensemble."""
        return self.ensemble.members

    @property
    def overturning_members(self) -> int:
        """Number of members that overturn."""
        return self.ensemble.overturning_members

    @property
    def rotation_ratio_low(self) -> float:
        """5 % quantile of the rotation ratio of the members; nan without any."""
        return self.ensemble.rotation_ratio_low

    @property
    def rotation_ratio_median(self) -> float:
        """Median of the rotation ratio of the members; nan without any."""
        return self.ensemble.rotation_ratio_median

    @property
    def rotation_ratio_high(self) -> float:
        """95 % quantile of the rotation ratio of the members; nan without any."""
        return self.ensemble.rotation_ratio_high

    @property
    def rotation_ratios(self) -> np.ndarray:
        """(m,) largest rotation over critical rotation of every member; inf overturns, 0 does not lift, nan failed."""
        return self.ensemble.rotation_ratios

    @property
    def causes(self) -> Mapping[str, np.ndarray]:
        """Value of each cause that varied, by member, (m,)."""
        return self.ensemble.causes

    @property
    def statics(self) -> FollowedCrack | None:
        """The crack of statics where another one governs, or the worst other than a known one; None without one."""
        return self.ensembles.reported_statics if self.ensembles else None

    @property
    def statics_crack(self) -> str:
        """The crack of `statics`, in words; "" where only one may form or that one governs."""
        return self.statics.description if self.statics else ""

    @property
    def response(self) -> Response:
        """The integration of the mechanism under the record as recorded, with its history; of the worse component."""
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
                words = (
                    ""
                    if whole
                    else ratio_in_words(predicted=ratio, integrated=case.integrated_rotation_ratio)
                )
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

    Parameters
    ----------
    record : Accelerogram, sequence of Accelerogram or object
        One accelerogram, or both horizontal components, which then make one ensemble over eight directions;
        or an obspy Stream or Trace, as from_obspy reads it with `unit` and `inventory`, whose
        vertical component acts too.
    structure : Structure or Mechanism
        The structure, or a mechanism alone.
    members : int or None, optional
        Number of members of the ensemble; None: that of the settings.
    settings : AssessmentSettings or None, optional
        Settings of the assessment; None: the default.
    vertical : Accelerogram or None, optional
        Sample by sample as the record; half of the members feel it.
    unit : str or None, optional
        Unit of the samples of an obspy object, where it does not say one.
    inventory : object, optional
        StationXML of an obspy object, as obspy reads it.

    Returns
    -------
    StructureAssessment
        The verdict, the share that overturns and the case of each component.

    Raises
    ------
    ConfigurationError
        For no record or more than two.
    RockingError
        Where the structure cannot be followed.

    Examples
    --------
    >>> pulse = rocking.Pulse(amplitude=3.0, circular_frequency=8.0, start_time=0.5)
    >>> record = rocking.Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    >>> print(rocking.assess(record, rocking.Block(semi_diagonal=2.0, slenderness=0.2)).verdict)
    stands
    """
    if type(record).__module__.startswith("obspy."):
        channels = from_obspy(record, inventory, unit)
        record = [channel for channel in channels if channel.is_horizontal]
        vertical = vertical or next((channel for channel in channels if channel.vertical), None)
    records = _checked_records(record)
    settings = settings or AssessmentSettings()
    for name, value, allowed, words in (
        ("structure", structure, Structure | Mechanism, "a structure or a mechanism"),
        ("vertical", vertical, Accelerogram | None, "an accelerogram"),
        ("settings", settings, AssessmentSettings, "AssessmentSettings"),
    ):
        if not isinstance(value, allowed):
            raise ConfigurationError(f"{name} is {kind_of(value)}, but must be {words}.", **{name: value})
    number = settings.ensemble.members if members is None else members
    varied = replace(settings.ensemble, members=number or EnsembleSettings().members)
    fidelity: Literal["standard", "contact"] = "contact" if settings.fidelity == "contact" else "standard"
    settings = replace(settings, fidelity=fidelity, ensemble=varied)
    result = Assessor(settings).assess("", records, on_the_ground({"structure": structure}), vertical)
    (period_result,) = result.periods
    for case in period_result.every_case:
        if case.failure:
            raise RockingError(case.failure.message)
    for _, failure in result.failures:
        if failure.stage == "directions":
            raise RecordError(failure.message)
    return StructureAssessment(*(getattr(period_result, field.name) for field in fields(period_result)))


def _checked_records(record: object) -> list[Accelerogram]:
    """The horizontal components. Raises ConfigurationError unless they are one or two accelerograms."""
    records = [record] if isinstance(record, Accelerogram) else record
    if isinstance(records, str | bytes) or not isinstance(records, Sequence):
        wrong = f"is {kind_of(record)}, but must be an accelerogram, or two horizontal ones; "
        wrong += "rocking.read gives those of a file"
    elif odd := [item for item in records if not isinstance(item, Accelerogram)]:
        wrong = f"holds a {type(odd[0]).__name__}, but must hold accelerograms"
    elif len(records) not in (1, 2):
        wrong = f"holds {len(records)} accelerograms, but must hold one or two horizontal ones"
    else:
        return list(records)
    raise ConfigurationError(f"record {wrong}.", record=record)
