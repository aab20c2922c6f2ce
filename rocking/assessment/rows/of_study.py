"""Rows about a whole study: its structures, their blocks, its counts, its spectrum and what accuracy costs."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from enum import StrEnum
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from rocking.assessment.rows import of_record as rows
from rocking.assessment.rows.meanings import COMPONENT, RECORD_SHA256, SCALE_FACTOR, STRUCTURE
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.tables import Row, column, row

if TYPE_CHECKING:
    from pandas import DataFrame

_P = "p of the equivalent block linearised about the critical rotation"
_ETA = "Ratio of angular velocities after and before an impact"
CAPACITY_POINTS = 21
"""Rotations of a capacity curve, from rest to the critical one."""


@row("structures")
class StructureRow(Row):
    """One row per structure: its mechanism and its equivalent block."""

    structure: str = column(STRUCTURE)
    type: str = column("Type of the structure, as in the structure list")
    geometry: str = column("Sizes of the structure with their units")
    crack: str = column("Hinge or crack, whose place is open; empty where none is")
    frequency_parameter_rad_s: float = column(_P, equation="Eq. 11")
    frequency_parameter_at_rest_rad_s: float = column(
        "p of the block exact at rest, which predicts unless the settings name another one"
    )
    critical_rotation_rad: float = column("Critical rotation; empty to a side it cannot overturn to")
    uplift_multiplier: float = column("Uplift acceleration in g", equation="Eq. 7")
    static_multiplier: float = column("Least uplift acceleration in g over all cracks")
    acceleration_scale_linearised: float = column("Scale a_sc of the linearised block", equation="Eq. 11")
    acceleration_scale_uplift: float = column("Scale a_sc,alt of the true uplift", equation="Eq. 13")
    linearised_over_true_uplift: float = column("Uplift acceleration over the true one", equation="Eq. 12")
    restitution: float = column(_ETA, equation="Eq. 2")
    restoring_defect: float = column("Largest error of the block's restoring force, relative")
    forcing_defect: float = column("Growth of the forcing up to φ_cr; unsafe where above 0")


@row("capacity")
class CapacityRow(Row):
    """One row per structure, side and rotation: the static load multiplier against displacement."""

    structure: str = column(STRUCTURE)
    side: str = column("Side of the rotation: positive or negative")
    rotation_rad: float = column("Rotation")
    multiplier: float = column("Horizontal acceleration in g that holds the balance", equation="G/B")
    displacement_m: float = column("Displacement of the corner that moves farthest sideways")
    effective_displacement_m: float = column("Displacement d* = d_k Σ P δ²/(δ_k Σ P δ)")
    participating_mass_ratio: float = column("Mass ratio e* = (Σ P δ)²/(Σ P · Σ P δ²)")


@row("agreement")
class AgreementRow(Row):
    """One row per structure and one for all: the closed form under the dominant pulse against the full integration."""

    structure: str = column("Name of the structure in the structure list; empty for all together")
    records: int = column("Number of records")
    cases: int = column("Number of cases with a prediction and an integration")
    both_rock: int = column("Number of cases in which both rock")
    within_factor_two: int = column("Number of these with a ratio between 1/2 and 2")
    median_ratio: float = column("Median of predicted over integrated rotation where both rock")
    overturning: int = column("Number of cases that overturn in the integration")
    overturning_hits: int = column("Number of these that overturn in the closed form")
    overturning_misses: int = column("Number of these that stand in the closed form")
    overturning_false_alarms: int = column("Number of cases that overturn in the closed form alone")


@row("spectrum")
class SpectrumRow(Row):
    """One row per component and equivalent block under the whole record; written by rocking spectrum."""

    component: str = column(COMPONENT)
    frequency_parameter_rad_s: float = column(_P, equation="Eq. 11")
    uplift_multiplier: float = column("Uplift acceleration of the equivalent block in g", equation="Eq. 12")
    restitution: float = column(_ETA, equation="Eq. 2")
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")
    scale_factor: float = column(SCALE_FACTOR)
    record_sha256: str = column(RECORD_SHA256)


def structure_rows(structures: Mapping[str, Structure]) -> Iterator[StructureRow]:
    """Yield the row of each structure."""
    for name, structure in structures.items():
        held = _held_row(name, structure)
        mechanism = structure.mechanism()
        side = mechanism.positive
        if not side.can_overturn:
            yield held
            continue
        at_rest = mechanism.equivalent_block("rest")
        linearised = mechanism.equivalent_block("linearised")
        uplift = mechanism.equivalent_block("uplift")
        yield replace(
            held,
            frequency_parameter_rad_s=side.frequency_parameter,
            frequency_parameter_at_rest_rad_s=at_rest.frequency_parameter,
            critical_rotation_rad=side.critical_rotation,
            acceleration_scale_linearised=linearised.acceleration_scale,
            acceleration_scale_uplift=uplift.acceleration_scale,
            linearised_over_true_uplift=linearised.uplift_multiplier / side.uplift_multiplier,
            restoring_defect=mechanism.block_defects.restoring,
            forcing_defect=mechanism.block_defects.forcing,
        )


def _held_row(name: str, structure: Structure) -> StructureRow:
    """Return the row of a structure without the figures of its equivalent block, which only what overturns has."""
    mechanism = structure.mechanism()
    geometry = structure.description
    return StructureRow(
        structure=name,
        type=structure.type_name,
        geometry=geometry,
        crack=structure.crack_name,
        frequency_parameter_rad_s=math.nan,
        frequency_parameter_at_rest_rad_s=math.nan,
        critical_rotation_rad=math.nan,
        uplift_multiplier=mechanism.uplift_multiplier,
        static_multiplier=structure.static_multiplier,
        acceleration_scale_linearised=math.nan,
        acceleration_scale_uplift=math.nan,
        linearised_over_true_uplift=math.nan,
        restitution=mechanism.positive.restitution,
        restoring_defect=math.nan,
        forcing_defect=math.nan,
    )


def capacity_rows(structures: Mapping[str, Structure]) -> Iterator[CapacityRow]:
    """Yield the capacity curve of each side of each structure, at CAPACITY_POINTS rotations."""
    for name, structure in structures.items():
        both = {"positive": 1, "negative": -1}
        for side, sign in list(both.items())[: len(structure.mechanism().sides)]:
            curve = structure.capacity_curve(sign, CAPACITY_POINTS)
            points = zip(
                curve.rotation.tolist(),
                curve.multiplier.tolist(),
                curve.displacement.tolist(),
                curve.effective_displacement.tolist(),
                strict=True,
            )
            for rotation, multiplier, displacement, effective_displacement in points:
                yield CapacityRow(
                    structure=name,
                    side=side,
                    rotation_rad=rotation,
                    multiplier=multiplier,
                    displacement_m=displacement,
                    effective_displacement_m=effective_displacement,
                    participating_mass_ratio=curve.participating_mass_ratio,
                )


AGREEMENT_COLUMNS = (
    "record",
    "structure",
    "predicted_rotation_ratio",
    "integrated_rotation_ratio",
    "prediction_over_integration",
    "within_factor_two",
)
"""The columns that `agreement_rows` needs of the comparison table."""


def agreement_rows(comparison: "DataFrame") -> Iterator[AgreementRow]:
    """Yield the counts of all and of each structure, from the comparison table as a data frame."""
    ratios = comparison[["predicted_rotation_ratio", "integrated_rotation_ratio"]]
    compared = comparison[ratios.notna().all(axis="columns")]
    for structure, cases in [("", compared), *compared.groupby("structure", sort=False)]:
        predicted, integrated = np.isinf(cases[list(ratios)].to_numpy()).T
        overturning_hits = int((predicted & integrated).sum())
        overturning_misses = int((integrated & ~predicted).sum())
        overturning_false_alarms = int((predicted & ~integrated).sum())
        where_both_rock = cases["prediction_over_integration"]
        records = cases["record"].nunique()
        both_rock = int(where_both_rock.count())
        within_factor_two = int(cases["within_factor_two"].sum())
        overturning = int(integrated.sum())
        yield AgreementRow(
            structure=str(structure),
            records=records,
            cases=len(cases),
            both_rock=both_rock,
            within_factor_two=within_factor_two,
            median_ratio=float(where_both_rock.median()),
            overturning=overturning,
            overturning_hits=overturning_hits,
            overturning_misses=overturning_misses,
            overturning_false_alarms=overturning_false_alarms,
        )


def spectrum_rows(
    accelerograms: Iterable[Accelerogram],
    frequency_parameters: np.ndarray,
    uplift_multipliers: np.ndarray,
    restitution: float,
) -> Iterator[SpectrumRow]:
    """Yield the rocking spectrum of each component over p (m,) [rad/s] and λ (n,)."""
    from rocking.motion.batch import rocking_spectrum  # else who reads a table would load numba

    for accelerogram in accelerograms:
        ratios = rocking_spectrum(accelerogram, frequency_parameters, uplift_multipliers, restitution)
        blocks = product(frequency_parameters.tolist(), uplift_multipliers.tolist())
        for (frequency, multiplier), ratio in zip(blocks, np.ravel(ratios).tolist(), strict=True):
            yield SpectrumRow(
                component=accelerogram.component,
                frequency_parameter_rad_s=frequency,
                uplift_multiplier=multiplier,
                restitution=restitution,
                rotation_ratio=ratio,
                scale_factor=accelerogram.scale_factor,
                record_sha256=accelerogram.source.sha256,
            )


SUMMARY_TABLES: tuple[type[Row], ...] = (
    rows.RecordRow,
    rows.PulseRow,
    rows.ComparisonRow,
    rows.EnsembleRow,
    rows.VerdictRow,
    rows.SupportRow,
    AgreementRow,
    StructureRow,
    CapacityRow,
    rows.FailureRow,
    rows.TimingRow,
)
"""The rows of the tables of the summary folder."""


class TradeMethod(StrEnum):
    """The methods of the trade, the cheapest response first."""

    ONE_SINE = "one sine"
    """The closed form under the dominant sine."""
    SINES = "five sines"
    """The closed form under the one of the five best-ranked sines that turns the structure farthest."""
    BLOCK = "block on record"
    COARSE = "mechanism, 1e-3"
    MECHANISM = "mechanism, 1e-6"
    FINE = "mechanism, 1e-9"
    ENSEMBLE = "ensemble"
    """The mechanism with its uncertain inputs; its rotation is the median of the members."""


@row("trade")
class TradeRow(Row):
    """One row per method and structure, and one of all structures: error and time of one response.

    The reference is the mechanism at a tolerance of 1e-12.
    """

    method: TradeMethod = column("Method")
    structure: str = column("Name of the structure; empty: all structures together")
    cases: int = column("Records in which the method has an answer, and it or the reference does not rest")
    error: float = column("Median relative error of the largest rotation where method and reference rock")
    error_high: float = column("95 % quantile of that error")
    wrong_verdicts: int = column("Cases that rest, rock or overturn otherwise than the reference")
    unsafe_verdicts: int = column("Those in which the method says less than the reference")
    cpu_s: float = column("Processor time of one response, median, with all preparations at hand")
    preparation_record_s: float = column("Processor time once for each record, median: search for its pulses")
