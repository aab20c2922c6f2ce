"""The rows of the tables of what goes in: each component of a record with its sine pulses, each structure by itself."""

import contextlib
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rocking.catalogue.place import Coordinates
from rocking.errors import StructureError
from rocking.pulses import Pulse, PulseEvidence
from rocking.signal.measures import record_measures
from rocking.structures import Mechanism, Structure
from rocking.structures.crackable import Crackable, crushing
from rocking.structures.equivalent_block import EquivalentBlock, Scale
from rocking.structures.mechanism import PRINTED_SCALE
from rocking.tables import Row, column, row
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
    """Names of a component of a record and of the input behind it, which each row about it holds."""

    record: str
    component: str
    record_sha256: str
    settings_sha256: str


@row()
class ComponentRow(Row):
    """A row about one component of one record."""

    record: str = column(RECORD)
    component: str = column(COMPONENT)
    record_sha256: str = column(RECORD_SHA256, last=True)
    settings_sha256: str = column("SHA-256 of settings, structures and package behind the row", last=True)


@row("record")
class RecordRow(ComponentRow):
    """One row per component: what was read and what was done to it before use."""

    event: str = column("Earthquake")
    magnitude: float | None = column("Magnitude of the earthquake; empty where nothing states it")
    epicentral_distance_m: float | None = column("Distance to the epicentre; empty where nothing states it")
    magnitude_type: str = column("Scale of the magnitude; empty where nothing states it")
    event_time: str = column(
        "Date of the earthquake, and its time as far as the file states it, ISO 8601 in the zone of the file"
    )
    station: str = column("Recording station")
    station_latitude_deg: float | None = column("Latitude of the station, north")
    station_longitude_deg: float | None = column("Longitude of the station, east")
    epicentre_latitude_deg: float = column("Latitude of the epicentre, north, as the catalogue declares it")
    epicentre_longitude_deg: float = column("Longitude of the epicentre, east, as the catalogue declares it")
    start_time: str = column("Time of the first sample, as the file states it")
    file: str = column("File of the record")
    format: str = column("Format of the file")
    unit: str = column("Unit of the numbers in the file")
    scale_factor: float = column(SCALE_FACTOR)
    licence: str = column("Licence of the record, as the catalogue declares it")
    vertical_component: str = column("Vertical component that acts as well; empty where none acts")
    vertical_peak_acceleration_m_s2: float = column("Largest magnitude of the vertical acceleration")
    samples: int = column("Number of samples")
    time_step_s: float = column("Time step")
    duration_s: float = column("Time from the first to the last sample")
    peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration")
    peak_velocity_m_s: float = column("Largest magnitude of the velocity, by the trapezoidal rule")
    peak_displacement_m: float = column("Largest magnitude of the displacement, by the same rule")
    arias_intensity_m_s: float = column("Arias intensity", equation="π/(2g) ∫a² dt")
    significant_duration_s: float = column("Time between 5 and 95 % of the Arias intensity (D5–95)")
    rotd50_peak_acceleration_m_s2: float = column("Peak acceleration of the pair, median over directions")
    rotd100_peak_acceleration_m_s2: float = column("Peak acceleration of the pair, largest over directions")
    velocity_pulse_period_s: float = column("Period T_p of the velocity pulse (Shahi & Baker 2014)")
    velocity_pulse_peak_velocity_m_s: float = column("Peak velocity along the axis of the velocity pulse")
    velocity_pulse_azimuth_deg: float | None = column("Axis of the velocity pulse, clockwise from north")
    velocity_pulse_like: bool | None = column("Whether Shahi & Baker call the motion pulse-like")
    pulse_periods_unlike: bool | None = column("Whether these periods differ by more than a factor of 2")
    high_pass_frequency_hz: float | None = column("Corner of the high-pass that the file or catalogue states")
    processing: tuple[str, ...] = column("Steps applied to the numbers of the file, in order")


def record_row(
    identity: Identity, component: "Component", licence: str = "", epicentre: Coordinates | None = None
) -> RecordRow:
    """Return the row of one component as it was read. licence, epicentre: as the catalogue declares them."""
    read = component.accelerogram
    vertical = component.vertical
    measures = record_measures(read)
    pair = component.motion.rotd
    pulse = component.motion.velocity_pulse
    dominant = component.analysis.dominant if component.analysis else None
    return RecordRow(
        **vars(identity),
        event=read.event,
        magnitude=read.magnitude,
        epicentral_distance_m=read.epicentral_distance,
        magnitude_type=read.magnitude_type,
        event_time=read.event_time,
        station=read.station,
        station_latitude_deg=read.latitude,
        station_longitude_deg=read.longitude,
        epicentre_latitude_deg=epicentre.latitude if epicentre else math.nan,
        epicentre_longitude_deg=epicentre.longitude if epicentre else math.nan,
        start_time=read.start_time,
        file=read.source.path,
        format=read.source.format,
        unit=read.source.unit,
        scale_factor=read.scale_factor,
        licence=licence,
        vertical_component="" if vertical is None else vertical.component or "not named",
        vertical_peak_acceleration_m_s2=math.nan if vertical is None else vertical.peak_acceleration,
        samples=read.acceleration.size,
        time_step_s=read.time_step,
        duration_s=read.duration,
        peak_acceleration_m_s2=measures.peak_acceleration,
        peak_velocity_m_s=measures.peak_velocity,
        peak_displacement_m=measures.peak_displacement,
        arias_intensity_m_s=measures.arias_intensity,
        significant_duration_s=measures.significant_duration,
        rotd50_peak_acceleration_m_s2=pair.rotd50 if pair else math.nan,
        rotd100_peak_acceleration_m_s2=pair.rotd100 if pair else math.nan,
        velocity_pulse_period_s=pulse.period if pulse else math.nan,
        velocity_pulse_peak_velocity_m_s=pulse.peak_velocity if pulse else math.nan,
        velocity_pulse_azimuth_deg=component.motion.velocity_pulse_azimuth,
        velocity_pulse_like=pulse.pulse_like if pulse else None,
        pulse_periods_unlike=pulse.is_unlike(dominant) if pulse and dominant else None,
        high_pass_frequency_hz=read.high_pass_frequency,
        processing=read.processing,
    )


@row("pulses")
class PulseRow(ComponentRow):
    """One row per sine pulse of acceleration; rank 1 of kind alternative is the dominant pulse."""

    kind: str = column(
        "alternative: ranked on the record; sequence: pursued on the residual of the pulses before it; "
        "predicting: the pulse that predicts, where it is not an alternative"
    )
    rank: int = column("Rank among the pulses of its kind, from 1")
    amplitude_m_s2: float = column("Signed amplitude a_g of the pulse")
    circular_frequency_rad_s: float = column("Circular frequency of the pulse")
    period_s: float = column("Period of the pulse")
    start_time_s: float = column("Start of the pulse after the first sample")
    gain_m2_s3: float = column("Energy gain of the matched filter")
    gain_ratio: float = column("Energy gain over that of the dominant pulse")
    explained_energy: float = column("Share of the acceleration energy that the pulse explains (EVa)")
    flags: tuple[Kind, ...] = column("Kinds of reason to doubt the pulse")

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


def pulse_rows(identity: Identity, component: "Component") -> Iterator[PulseRow]:
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
            is_dominant = kind == "alternative" and rank == 1
            yield PulseRow(
                **vars(identity),
                kind=kind,
                rank=rank,
                amplitude_m_s2=evidence.pulse.amplitude,
                circular_frequency_rad_s=evidence.pulse.circular_frequency,
                period_s=evidence.pulse.period,
                start_time_s=evidence.pulse.start_time,
                gain_m2_s3=evidence.gain,
                gain_ratio=evidence.gain / analysis.evidence.gain,
                explained_energy=evidence.explained_energy,
                flags=tuple(flag.kind for flag in analysis.flags) if is_dominant else (),
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
