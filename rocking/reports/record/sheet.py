"""The record sheet of a report: the figure of each component, and what the record is known by."""

import math
from collections.abc import Callable, Mapping, Sequence

from rocking.assessment.rows.of_record import PulseRow, RecordRow
from rocking.records.accelerogram import Accelerogram
from rocking.reports import printing
from rocking.reports.printing import number, with_unit, words
from rocking.reports.record.curves import Picture, component_picture, placed_structures, ranked_pulses
from rocking.reports.record.sheet_figures import RecordSheet, record_sheet
from rocking.reports.record.tables import facts_table
from rocking.structures import Structure


def sheet_picture(
    accelerogram: Accelerogram,
    row: RecordRow,
    pulses: Sequence[PulseRow],
    structures: Mapping[str, Structure],
    numbers: Mapping[str, str],
    height: float,
) -> Picture:
    """Return the record sheet of one component."""
    from rocking.records.measures import record_measures, response_spectrum

    known = math.isfinite(row.velocity_pulse_period_s)
    figure = record_sheet(
        RecordSheet(
            accelerogram,
            record_measures(accelerogram),
            response_spectrum(accelerogram),
            next(iter(ranked_pulses(pulses)), None),
            (row.velocity_pulse_period_s, row.velocity_pulse_centre_time_s) if known else None,
            placed_structures(structures, numbers),
        ),
        height,
    )
    alt = "Response spectrum, pulse, Husid plot, velocity and displacement of component {}."
    return component_picture(accelerogram, figure, alt)


def sheet_table(rows: Sequence[RecordRow]) -> dict[str, object]:
    """Return what the components are known by."""
    return facts_table(rows, _FACTS)


def sheet_sentences(rows: Sequence[RecordRow]) -> list[str]:
    """Say of each component where sine pulse and velocity pulse are not the same feature."""
    return [
        f"Component {words(row.component)}: the dominant sine pulse is {number(row.pulse_period_ratio)} times as long "
        "as the velocity pulse. They differ by more than a factor of two, so they are two features of the motion; the "
        "closed form knows only the pulse that it is given."
        for row in rows
        if row.pulse_periods_unlike
    ]


def _axis(row: RecordRow) -> str:
    if math.isfinite(row.velocity_pulse_azimuth_deg):
        return f"{row.velocity_pulse_azimuth_deg:.0f}° from north"
    if math.isfinite(row.velocity_pulse_orientation_rad):
        return f"{printing.given(round(math.degrees(row.velocity_pulse_orientation_rad)))}° from the first component"
    return printing.NOTHING


def _kilometres(row: RecordRow) -> str:
    known = row.epicentral_distance_m
    return with_unit(printing.given(None if known is None else known / 1000), "km")


_FACTS: dict[str, Callable[[RecordRow], str]] = {
    "Magnitude": lambda row: printing.given(row.magnitude),
    "Epicentral distance": _kilometres,
    "Peak acceleration": lambda row: with_unit(number(row.peak_acceleration_m_s2, 4), "m/s²"),
    "Pair, RotD50 of the peak": lambda row: with_unit(number(row.rotd50_peak_acceleration_m_s2, 4), "m/s²"),
    "Pair, RotD100 of the peak": lambda row: with_unit(number(row.rotd100_peak_acceleration_m_s2, 4), "m/s²"),
    "Peak velocity": lambda row: with_unit(number(row.peak_velocity_m_s, 4), "m/s"),
    "Peak displacement": lambda row: with_unit(number(row.peak_displacement_m, 4), "m"),
    "Arias intensity": lambda row: with_unit(number(row.arias_intensity_m_s, 4), "m/s"),
    "Significant duration D5–95": lambda row: with_unit(number(row.significant_duration_s), "s"),
    "Velocity pulse, period": lambda row: with_unit(number(row.velocity_pulse_period_s), "s"),
    "Velocity pulse, axis": _axis,
    "Velocity pulse, peak": lambda row: with_unit(number(row.velocity_pulse_peak_velocity_m_s), "m/s"),
    "Velocity pulse, indicator": lambda row: number(row.velocity_pulse_indicator),
    "Velocity pulse, pulse-like": lambda row: printing.yes_or_no(row.velocity_pulse_like),
    "Sine period over that": lambda row: number(row.pulse_period_ratio),
    "More than a factor 2 apart": lambda row: printing.yes_or_no(row.pulse_periods_unlike),
}
