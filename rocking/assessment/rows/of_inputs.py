"""The rows of the tables of what goes in: each component of a record with its sine pulses, each structure by itself."""

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from rocking.catalogue.place import Coordinates
from rocking.errors import StructureError
from rocking.pulses import Pulse, PulseEvidence, VelocityPulse
from rocking.pulses.pulse import PulseAnalysis
from rocking.signal.measures import RecordMeasures, record_measures
from rocking.structures import Side, Structure
from rocking.structures.capacity import StaticCurve
from rocking.structures.crackable import WEAK_MASONRY
from rocking.structures.equivalent_block import EquivalentBlock, Scale
from rocking.structures.mechanism import PRINTED_SCALE
from rocking.tables import Columns, RowOf, row
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

    @property
    def file(self) -> str:
        """The path of its file."""
        return self.component.accelerogram.source.path

    @property
    def samples(self) -> int:
        """The number of its samples."""
        return self.component.accelerogram.acceleration.size

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
    file: str = of_component("File of the record", lambda read: read.file)
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
    samples: int = of_component("Number of samples", lambda read: read.samples)
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

    @property
    def gain_ratio(self) -> float:
        """Its gain over that of the dominant pulse."""
        return self.evidence.gain / self.analysis.evidence.gain


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
        lambda found: found.gain_ratio,
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


@dataclass(frozen=True)
class Named:
    """Anything about one structure of the list, whatever the records. structure: its name."""

    structure: str


N = TypeVar("N", bound=Named)
of_named = Columns(Named)


@row()
class StructureNameRow(RowOf[N]):
    """A row about one structure of the list."""

    structure: str = of_named(STRUCTURE, lambda named: named.structure)


@dataclass(frozen=True)
class Placed(Named):
    """Anything about one structure where it stands.

    support_period: of the support, s; 0 on the ground below one, None where it has none.
    """

    support_period: float | None = field(default=None, kw_only=True)


L = TypeVar("L", bound=Placed)
of_placed = Columns(Placed)


@row()
class PlacedRow(StructureNameRow[L]):
    """A row about one structure of the list where it stands."""

    support_period_s: float | None = of_placed(SUPPORT_PERIOD, lambda placed: placed.support_period)


@dataclass(frozen=True)
class ListedStructure(Named):
    """One structure of the list. block_used: the block that predicts, as the settings name it."""

    body: Structure
    block_used: Scale = "exact_at_rest"

    @property
    def block_printed(self) -> Scale:
        """The block of the source paper, by the same names."""
        return PRINTED_SCALE

    @property
    def geometry(self) -> str:
        """Its sizes with their units."""
        return self.body.description

    @property
    def side(self) -> Side | None:
        """The positive side; None where it cannot overturn to it."""
        positive = self.body.mechanism().positive
        return positive if positive.can_overturn else None

    def block(self, scale: Scale) -> EquivalentBlock | None:
        """Its equivalent block; None where it cannot overturn, or where the block is refused, as each record says."""
        with contextlib.suppress(StructureError):
            return self.body.mechanism().equivalent_block(scale) if self.side else None
        return None


of_listed = Columns(ListedStructure)
of_side = of_listed.optional(lambda of: of.side)
of_block_defects = of_listed.optional(
    lambda of: None if of.block("exact_at_rest") is None else of.body.mechanism().block_defects
)
of_crushing = of_listed.optional(lambda of: of.body.crushing(WEAK_MASONRY))


def of_block(scale: Scale) -> Columns[EquivalentBlock]:
    """Return the declaration of columns about an equivalent block, which not every structure has."""
    return of_listed.optional(lambda of: of.block(scale))


@row("structures")
class StructureRow(StructureNameRow[ListedStructure]):
    """One row per structure: its mechanism and its equivalent block."""

    type: str = of_listed(
        "Type of the structure, as in the structure list", lambda of: of.body.described.type_name
    )
    geometry: str = of_listed("Sizes of the structure with their units", lambda of: of.geometry)
    crack: str = of_listed(
        "What opens, hinge or crack; empty of one that does not crack", lambda of: of.body.crack_name
    )
    block_used: str = of_listed(
        "The block that predicts: its acceleration_scale, as the settings name it", lambda of: of.block_used
    )
    block_printed: str = of_listed(
        "The block of Eq. 15 as printed: the paper's, linearised about φ_cr, with the scale of the true uplift",
        lambda of: of.block_printed,
    )
    frequency_parameter_rad_s: float = of_side(
        f"{FREQUENCY_PARAMETER}, of the block that is printed",
        lambda side: side.frequency_parameter,
        equation="Eq. 11",
    )
    frequency_parameter_at_rest_rad_s: float = of_block("exact_at_rest")(
        "p of the block exact at rest, which is used unless the settings name another one",
        lambda block: block.frequency_parameter,
    )
    critical_rotation_rad: float = of_side(
        "Critical rotation; empty on a side to which it cannot overturn", lambda side: side.critical_rotation
    )
    uplift_multiplier: float = of_listed(
        "Uplift acceleration in g", lambda of: of.body.mechanism().uplift_multiplier, equation="Eq. 7"
    )
    static_multiplier: float = of_listed(
        "Least acceleration in g at which limit analysis lets a mechanism that counts start",
        lambda of: of.body.static_multiplier,
    )
    static_multiplier_crushing: float = of_crushing(
        "The same if the edges of its joints crush at 2 MPa; empty where it states a strength or would not stand",
        lambda crushed: crushed.static_multiplier,
    )
    acceleration_scale_linearised: float = of_block("linearised")(
        "Scale a_sc of the linearised block",
        lambda block: block.acceleration_scale,
        equation="Eq. 11",
    )
    acceleration_scale_uplift: float = of_block("uplift")(
        "Scale a_sc,alt of the true uplift",
        lambda block: block.acceleration_scale,
        equation="Eq. 13",
    )
    restitution: float = of_listed(
        RESTITUTION, lambda of: of.body.mechanism().positive.restitution, equation="Eq. 2"
    )
    restoring_defect: float = of_block_defects(
        "Largest error of the block's restoring force, relative", lambda defects: defects.restoring
    )
    forcing_defect: float = of_block_defects(
        "Growth of the forcing up to φ_cr; unsafe where above 0", lambda defects: defects.forcing
    )


def structure_rows(
    structures: Mapping[str, Structure], scale: Scale = "exact_at_rest"
) -> Iterator[StructureRow]:
    """Yield the row of each structure. scale: the block that predicts."""
    for entry in structures.items():
        yield StructureRow.of(ListedStructure(*entry, scale))


@dataclass(frozen=True)
class CapacityPoint(Named):
    """One point of the capacity curve of one side. place: its place on the curve."""

    side: str
    curve: StaticCurve
    place: int


of_point = Columns(CapacityPoint)


@row("capacity")
class CapacityRow(StructureNameRow[CapacityPoint]):
    """One row per structure, side and rotation: the static load multiplier against displacement."""

    side: str = of_point("Side of the rotation: positive or negative", lambda at: at.side)
    rotation_rad: float = of_point("Rotation", lambda at: float(at.curve.rotation[at.place]))
    multiplier: float = of_point(
        "Horizontal acceleration in g that keeps it in balance",
        lambda at: float(at.curve.multiplier[at.place]),
        equation="G/B",
    )
    displacement_m: float = of_point(
        "Displacement of the corner that moves farthest sideways",
        lambda at: float(at.curve.displacement[at.place]),
    )
    effective_displacement_m: float = of_point(
        "Displacement d* = d_k Σ P δ²/(δ_k Σ P δ)",
        lambda at: float(at.curve.effective_displacement[at.place]),
    )
    participating_mass_ratio: float = of_point(
        "Mass ratio e* = (Σ P δ)²/(Σ P · Σ P δ²)", lambda at: at.curve.participating_mass_ratio
    )


def capacity_rows(structures: Mapping[str, Structure]) -> Iterator[CapacityRow]:
    """Yield the capacity curve of each side of each structure, at CAPACITY_POINTS rotations."""
    for name, structure in structures.items():
        both = {"positive": 1, "negative": -1}
        for side, sign in list(both.items())[: len(structure.mechanism().sides)]:
            curve = structure.capacity_curve(sign, CAPACITY_POINTS)
            for place in range(curve.rotation.size):
                yield CapacityRow.of(CapacityPoint(name, side, curve, place))
