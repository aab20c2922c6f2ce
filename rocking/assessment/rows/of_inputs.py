"""The rows of the tables of what goes in: each component of a record with its sine pulses, each structure by itself."""

import contextlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from rocking.catalogue.place import Coordinates
from rocking.errors import StructureError
from rocking.pulses import Pulse, PulseEvidence, VelocityPulse
from rocking.pulses.pulse import PulseAnalysis
from rocking.signal.measures import RecordMeasures, record_measures
from rocking.structures import Mechanism, Structure
from rocking.structures.crackable import Crackable, crushing
from rocking.structures.equivalent_block import EquivalentBlock, Scale
from rocking.structures.mechanism import PRINTED_SCALE
from rocking.tables import Columns, Row, RowOf, column, row
from rocking.warnings import Kind

if TYPE_CHECKING:  # else who reads a table would load numba
    from rocking.assessment.motions import Component

STRUCTURE = "Name of the structure in the structure list"
SUPPORT_PERIOD = (
    "First period of the support that carries the structure; 0: on the ground, for comparison; "
    "empty: no support"
)
RECORD = "Identifier of the record in the catalogue"
COMPONENT = "Component of the ground motion, as the file names it"
SCALE_FACTOR = "Factor of the catalogue on the accelerations of the file"
RECORD_SHA256 = "SHA-256 of the file the record was read from"
FREQUENCY_PARAMETER = "p of the equivalent block linearised about the critical rotation"
RESTITUTION = "Ratio of angular velocities after and before an impact"
CAPACITY_POINTS = 21
"""Rotations of a capacity curve, from rest to the critical one."""


# What shakes ----------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Identity:
    """Names of a component of a record and of the input behind it, which stand in each row about it."""

    record: str
    component: str
    record_sha256: str
    settings_sha256: str


@dataclass(frozen=True)
class Identified:
    """Anything about one component of one record."""

    identity: Identity


I = TypeVar("I", bound=Identified)
of_identified = Columns(Identified)


@row()
class ComponentRow(RowOf[I]):
    """A row about one component of one record."""

    record: str = of_identified(RECORD, lambda of: of.identity.record)
    component: str = of_identified(COMPONENT, lambda of: of.identity.component)
    record_sha256: str = of_identified(RECORD_SHA256, lambda of: of.identity.record_sha256, last=True)
    settings_sha256: str = of_identified(
        "SHA-256 of settings, structures and package behind the row",
        lambda of: of.identity.settings_sha256,
        last=True,
    )


@dataclass(frozen=True)
class ReadComponent(Identified):
    """One component as it was read, with the licence and the epicentre that the catalogue declares."""

    component: "Component"
    licence: str
    epicentre: Coordinates | None = None

    @cached_property
    def measures(self) -> RecordMeasures:
        """Its measures of intensity."""
        return record_measures(self.component.accelerogram)

    @property
    def both_pulses(self) -> tuple[Pulse, VelocityPulse] | None:
        """The sine that explains most of its energy, and the velocity pulse of the pair; None without one of them."""
        analysis = self.component.analysis
        velocity_pulse = self.component.motion.velocity_pulse
        return (analysis.dominant, velocity_pulse) if analysis and velocity_pulse else None


of_component = Columns(ReadComponent)
of_accelerogram = of_component.part(lambda read: read.component.accelerogram)
of_vertical = of_component.optional(lambda read: read.component.vertical)
of_measures = of_component.part(lambda read: read.measures)
of_directions = of_component.optional(lambda read: read.component.motion.rotd)
of_velocity_pulse = of_component.optional(lambda read: read.component.motion.velocity_pulse)
of_epicentre = of_component.optional(lambda read: read.epicentre)
of_both_pulses = of_component.optional(lambda read: read.both_pulses)


@row("record")
class RecordRow(ComponentRow[ReadComponent]):
    """One row per component: what was read and what was done to it before use."""

    event: str = of_accelerogram("Earthquake", lambda read: read.event)
    magnitude: float | None = of_accelerogram(
        "Magnitude of the earthquake; empty where nothing states it", lambda read: read.magnitude
    )
    epicentral_distance_m: float | None = of_accelerogram(
        "Distance to the epicentre; empty where nothing states it", lambda read: read.epicentral_distance
    )
    magnitude_type: str = of_accelerogram(
        "Scale of the magnitude; empty where nothing states it", lambda read: read.magnitude_type
    )
    event_time: str = of_accelerogram(
        "Date of the earthquake, and its time as far as the file states it, ISO 8601 in the zone of the file",
        lambda read: read.event_time,
    )
    station: str = of_accelerogram("Recording station", lambda read: read.station)
    station_latitude_deg: float | None = of_accelerogram(
        "Latitude of the station, north", lambda read: read.latitude
    )
    station_longitude_deg: float | None = of_accelerogram(
        "Longitude of the station, east", lambda read: read.longitude
    )
    epicentre_latitude_deg: float = of_epicentre(
        "Latitude of the epicentre, north, as the catalogue declares it", lambda epicentre: epicentre.latitude
    )
    epicentre_longitude_deg: float = of_epicentre(
        "Longitude of the epicentre, east, as the catalogue declares it",
        lambda epicentre: epicentre.longitude,
    )
    start_time: str = of_accelerogram(
        "Time of the first sample, as the file states it", lambda read: read.start_time
    )
    file: str = of_accelerogram("File of the record", lambda read: read.source.path)
    format: str = of_accelerogram("Format of the file", lambda read: read.source.format)
    unit: str = of_accelerogram("Unit of the numbers in the file", lambda read: read.source.unit)
    scale_factor: float = of_accelerogram(SCALE_FACTOR, lambda read: read.scale_factor)
    licence: str = of_component(
        "Licence of the record, as the catalogue declares it", lambda read: read.licence
    )
    vertical_component: str = of_vertical(
        "Vertical component that acts as well; empty where none acts",
        lambda vertical: vertical.component or "not named",
    )
    vertical_peak_acceleration_m_s2: float = of_vertical(
        "Largest magnitude of the vertical acceleration", lambda vertical: vertical.peak_acceleration
    )
    samples: int = of_accelerogram("Number of samples", lambda read: read.acceleration.size)
    time_step_s: float = of_accelerogram("Time step", lambda read: read.time_step)
    duration_s: float = of_accelerogram("Time from the first to the last sample", lambda read: read.duration)
    peak_acceleration_m_s2: float = of_measures(
        "Largest magnitude of the acceleration", lambda measures: measures.peak_acceleration
    )
    peak_velocity_m_s: float = of_measures(
        "Largest magnitude of the velocity, by the trapezoidal rule", lambda measures: measures.peak_velocity
    )
    peak_displacement_m: float = of_measures(
        "Largest magnitude of the displacement, by the same rule", lambda measures: measures.peak_displacement
    )
    arias_intensity_m_s: float = of_measures(
        "Arias intensity", lambda measures: measures.arias_intensity, equation="π/(2g) ∫a² dt"
    )
    significant_duration_s: float = of_measures(
        "Time between 5 and 95 % of the Arias intensity (D5–95)",
        lambda measures: measures.significant_duration,
    )
    rotd50_peak_acceleration_m_s2: float = of_directions(
        "Peak acceleration of the pair, median over directions", lambda pair: pair.rotd50
    )
    rotd100_peak_acceleration_m_s2: float = of_directions(
        "Peak acceleration of the pair, largest over directions", lambda pair: pair.rotd100
    )
    velocity_pulse_period_s: float = of_velocity_pulse(
        "Period T_p of the velocity pulse (Shahi & Baker 2014)", lambda pulse: pulse.period
    )
    velocity_pulse_peak_velocity_m_s: float = of_velocity_pulse(
        "Peak velocity along the axis of the velocity pulse", lambda pulse: pulse.peak_velocity
    )
    velocity_pulse_azimuth_deg: float | None = of_component(
        "Axis of the velocity pulse, clockwise from north",
        lambda read: read.component.motion.velocity_pulse_azimuth,
    )
    velocity_pulse_like: bool | None = of_velocity_pulse(
        "Whether Shahi & Baker call the motion pulse-like", lambda pulse: pulse.pulse_like
    )
    pulse_periods_unlike: bool | None = of_both_pulses(
        "Whether these periods differ by more than a factor of 2", lambda both: both[1].is_unlike(both[0])
    )
    high_pass_frequency_hz: float | None = of_accelerogram(
        "Corner of the high-pass that the file or catalogue states", lambda read: read.high_pass_frequency
    )
    processing: tuple[str, ...] = of_accelerogram(
        "Steps applied to the numbers of the file, in order", lambda read: read.processing
    )


@dataclass(frozen=True)
class FoundPulse(Identified):
    """One pulse of the analysis of a component, by its kind and its rank among those of its kind."""

    analysis: PulseAnalysis
    kind: str
    rank: int
    evidence: PulseEvidence


def pulses_found(identity: Identity, component: "Component") -> Iterator[FoundPulse]:
    """Yield the ranked alternatives, the dominant pulse first, then the pursuit sequence.

    Pulses that predict, but are not among the alternatives, follow.
    """
    analysis = component.analysis
    if analysis is None:
        return
    kinds: dict[str, Sequence[PulseEvidence]] = {
        "alternative": analysis.ranked,
        "sequence": analysis.sequence,
        "predicting": [evidence for evidence in component.candidates if evidence not in analysis.ranked],
    }
    for kind, pulses in kinds.items():
        for rank, evidence in enumerate(pulses, start=1):
            yield FoundPulse(identity, analysis, kind, rank, evidence)


of_pulse = Columns(FoundPulse)


@row("pulses")
class PulseRow(ComponentRow[FoundPulse]):
    """One row per sine pulse of acceleration; rank 1 of kind alternative is the dominant pulse."""

    kind: str = of_pulse(
        "alternative: ranked on the record; sequence: pursued on the residual of the pulses before it; "
        "predicting: the pulse that predicts, where it is not an alternative",
        lambda found: found.kind,
    )
    rank: int = of_pulse("Rank among the pulses of its kind, from 1", lambda found: found.rank)
    amplitude_m_s2: float = of_pulse(
        "Signed amplitude a_g of the pulse", lambda found: found.evidence.pulse.amplitude
    )
    circular_frequency_rad_s: float = of_pulse(
        "Circular frequency of the pulse", lambda found: found.evidence.pulse.circular_frequency
    )
    period_s: float = of_pulse("Period of the pulse", lambda found: found.evidence.pulse.period)
    start_time_s: float = of_pulse(
        "Start of the pulse after the first sample", lambda found: found.evidence.pulse.start_time
    )
    gain_m2_s3: float = of_pulse("Energy gain of the matched filter", lambda found: found.evidence.gain)
    gain_ratio: float = of_pulse(
        "Energy gain over that of the dominant pulse",
        lambda found: found.evidence.gain / found.analysis.evidence.gain,
    )
    explained_energy: float = of_pulse(
        "Share of the acceleration energy that the pulse explains (EVa)",
        lambda found: found.evidence.explained_energy,
    )
    flags: tuple[Kind, ...] = of_pulse(
        "Kinds of reason to doubt the pulse",
        lambda found: (
            tuple(flag.kind for flag in found.analysis.flags)
            if found.kind == "alternative" and found.rank == 1
            else ()
        ),
    )

    @property
    def ranked(self) -> bool:
        """Whether it is one of the ranked alternatives."""
        return self.kind == "alternative"

    @property
    def is_dominant(self) -> bool:
        """Whether it explains most of its component."""
        return self.ranked and self.rank == 1

    @property
    def pulse(self) -> Pulse:
        """The pulse itself."""
        return Pulse(
            amplitude=self.amplitude_m_s2,
            circular_frequency=self.circular_frequency_rad_s,
            start_time=self.start_time_s,
        )


# What stands ----------------------------------------------------------------------------------------------


@row()
class PlacedRow(Row):
    """A row about one structure of the list where it stands."""

    structure: str = column(STRUCTURE)
    support_period_s: float | None = column(SUPPORT_PERIOD)


@row("structures")
class StructureRow(Row):
    """One row per structure: its mechanism and its equivalent block."""

    structure: str = column(STRUCTURE)
    type: str = column("Type of the structure, as in the structure list")
    geometry: str = column("Sizes of the structure with their units")
    crack: str = column("What opens, hinge or crack; empty of one that does not crack")
    block_used: str = column("The block that predicts: its acceleration_scale, as the settings name it")
    block_printed: str = column(
        "The block of Eq. 15 as printed: the paper's, linearised about φ_cr, with the scale of the true uplift"
    )
    frequency_parameter_rad_s: float = column(
        f"{FREQUENCY_PARAMETER}, of the block that is printed", equation="Eq. 11"
    )
    frequency_parameter_at_rest_rad_s: float = column(
        "p of the block exact at rest, which is used unless the settings name another one"
    )
    critical_rotation_rad: float = column("Critical rotation; empty on a side to which it cannot overturn")
    uplift_multiplier: float = column("Uplift acceleration in g", equation="Eq. 7")
    static_multiplier: float = column(
        "Least acceleration in g at which limit analysis lets a mechanism that counts start"
    )
    static_multiplier_crushing: float = column(
        "The same if the edges of its joints crush at 2 MPa; empty where it states a strength or would not stand"
    )
    acceleration_scale_linearised: float = column("Scale a_sc of the linearised block", equation="Eq. 11")
    acceleration_scale_uplift: float = column("Scale a_sc,alt of the true uplift", equation="Eq. 13")
    restitution: float = column(RESTITUTION, equation="Eq. 2")
    restoring_defect: float = column("Largest error of the block's restoring force, relative")
    forcing_defect: float = column("Growth of the forcing up to φ_cr; unsafe where above 0")


def structure_rows(
    structures: Mapping[str, Structure], scale: Scale = "exact_at_rest"
) -> Iterator[StructureRow]:
    """Yield the row of each structure. scale: the block that predicts."""
    for name, body in structures.items():
        mechanism = body.mechanism()
        side = mechanism.positive if mechanism.positive.can_overturn else None
        at_rest = _block(mechanism, "exact_at_rest")
        linearised = _block(mechanism, "linearised")
        uplift = _block(mechanism, "uplift")
        defects = mechanism.block_defects if at_rest else None
        crushed = crushing(body)
        yield StructureRow(
            structure=name,
            type=body.described.type_name,
            geometry=body.description,
            crack=body.crack_name if isinstance(body, Crackable) else "",
            block_used=scale,
            block_printed=PRINTED_SCALE,
            frequency_parameter_rad_s=side.frequency_parameter if side else math.nan,
            frequency_parameter_at_rest_rad_s=at_rest.frequency_parameter if at_rest else math.nan,
            critical_rotation_rad=side.critical_rotation if side else math.nan,
            uplift_multiplier=mechanism.uplift_multiplier,
            static_multiplier=body.static_multiplier,
            static_multiplier_crushing=crushed.static_multiplier if crushed else math.nan,
            acceleration_scale_linearised=linearised.acceleration_scale if linearised else math.nan,
            acceleration_scale_uplift=uplift.acceleration_scale if uplift else math.nan,
            restitution=mechanism.positive.restitution,
            restoring_defect=defects.restoring if defects else math.nan,
            forcing_defect=defects.forcing if defects else math.nan,
        )


def _block(mechanism: Mechanism, scale: Scale) -> EquivalentBlock | None:
    """Its equivalent block; None where it cannot overturn to its positive side, or where the block is refused."""
    with contextlib.suppress(StructureError):
        return mechanism.equivalent_block(scale) if mechanism.positive.can_overturn else None
    return None


@row("capacity")
class CapacityRow(Row):
    """One row per structure, side and rotation: the static load multiplier against displacement."""

    structure: str = column(STRUCTURE)
    side: str = column("Side of the rotation: positive or negative")
    rotation_rad: float = column("Rotation")
    multiplier: float = column("Horizontal acceleration in g that keeps it in balance", equation="G/B")
    displacement_m: float = column("Displacement of the corner that moves farthest sideways")
    effective_displacement_m: float = column("Displacement d* = d_k Σ P δ²/(δ_k Σ P δ)")
    participating_mass_ratio: float = column("Mass ratio e* = (Σ P δ)²/(Σ P · Σ P δ²)")


def capacity_rows(structures: Mapping[str, Structure]) -> Iterator[CapacityRow]:
    """Yield the capacity curve of each side of each structure, at CAPACITY_POINTS rotations."""
    for name, structure in structures.items():
        both = {"positive": 1, "negative": -1}
        for side, sign in list(both.items())[: len(structure.mechanism().sides)]:
            curve = structure.capacity_curve(sign, CAPACITY_POINTS)
            along = (curve.rotation, curve.multiplier, curve.displacement, curve.effective_displacement)
            for rotation, multiplier, displacement, effective in np.array(along).T.tolist():
                yield CapacityRow(
                    structure=name,
                    side=side,
                    rotation_rad=rotation,
                    multiplier=multiplier,
                    displacement_m=displacement,
                    effective_displacement_m=effective,
                    participating_mass_ratio=curve.participating_mass_ratio,
                )
