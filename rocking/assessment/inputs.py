"""Inputs: what a result that a store keeps is computed from, one frozen object for each kind of result.

The function that computes a result is given its inputs and nothing else, and a store knows the result by the hash of
the same object, so that nothing on which the result depends can be missing from the hash.
"""

import math
from dataclasses import dataclass
from functools import cached_property

from rocking.assessment.motions import Motion, arrived
from rocking.assessment.settings import AssessmentSettings, PredictingPulse
from rocking.hashes import sha256_of_content
from rocking.pulses import Pulse, PulseEvidence
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.structures.equivalent_block import Scale


@dataclass(frozen=True, eq=False, kw_only=True)
class Inputs:
    """What one result is computed from."""

    @cached_property
    def fingerprint(self) -> str:
        """Hash of every field: a motion stands for its samples, anything else for its class and all its fields."""
        return sha256_of_content(self)


@dataclass(frozen=True, eq=False, kw_only=True)
class CaseInputs(Inputs):
    """What a case is computed from.

    motion: one component, or the pair over whose directions the ensemble runs. pulse: that predicts, under which the
    mechanism is integrated as well; None without one, and of a pair. alone: False where an ensemble over the directions
    of the record speaks for its components, which then get neither an ensemble nor an estimate of their own. bounces:
    whether a contact opens under one of the components of a pair as recorded; None where that is not known.
    crack_heights: number of other cracks that are followed once each; 0: none. processing_variants: whether the
    structure is followed under other processings of the record.
    """

    motion: Motion
    structure: Structure
    settings: AssessmentSettings
    pulse: Pulse | None = None
    alone: bool = True
    bounces: bool | None = None
    crack_heights: int = 0
    processing_variants: bool = False

    @property
    def accelerogram(self) -> Accelerogram:
        """The one component as it arrives where the structure stands."""
        (accelerogram,) = arrived(self.motion).horizontal.values()
        return accelerogram

    @property
    def vertical(self) -> Accelerogram | None:
        """The vertical component there, sample by sample as the other one; None where none acts."""
        return arrived(self.motion).vertical


@dataclass(frozen=True, eq=False, kw_only=True)
class PulseInputs(Inputs):
    """What the pulses of one component are found from.

    components: of the record, each by itself. place: of the one whose pulses are searched for, from 0. measured:
    whether the motion of the pair that it belongs to is measured.
    """

    components: tuple[Motion, ...]
    place: int
    settings: PredictingPulse
    measured: bool


@dataclass(frozen=True, eq=False, kw_only=True)
class PredictionInputs(Inputs):
    """What the closed form of a structure is computed from. candidates: as a pulse method offers them."""

    structure: Structure
    candidates: tuple[PulseEvidence, ...]
    acceleration_scale: Scale


@dataclass(frozen=True, eq=False, kw_only=True)
class PairInputs(Inputs):
    """What the number of the motions of a pair, in all directions and processings, follows from."""

    pair: Motion
    processing: bool


@dataclass(frozen=True, eq=False, kw_only=True)
class ReserveInputs(Inputs):
    """What the reserve of a structure is computed from.

    crack: description of the one that governs; "" where only one may form. support_loss: horizontal displacement at
    which what bears on the structure falls, m; inf where nothing does. share: that falls under the motion itself; nan
    where it is not known.
    """

    motion: Motion
    structure: Structure
    crack: str
    settings: AssessmentSettings
    support_loss: float = math.inf
    share: float = math.nan
