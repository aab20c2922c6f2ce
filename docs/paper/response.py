"""Fig. 8 of the source paper: two arches under a record, integration beside the prediction from one pulse."""

from collections.abc import Mapping

import numpy as np

from docs.paper.curves import ROTATION, Curve
from rocking.motion.integration import integrate
from rocking.pulses import Pulse, extract_pulses
from rocking.reports.drawings import thinned
from rocking.signal.accelerogram import Accelerogram
from rocking.sine_pulse import predict_maximum, printed_maximum
from rocking.structures.arch import Arch
from rocking.structures.mechanism import Mechanism
from rocking.tables import Row, column, row

RADII = {"c": 10.0, "d": 15.0}
"""Centreline radius of each panel's arch, m; β = 157.5°, t/r = 0.15, η = 0.9 as in the paper."""
_TIME = "time [s]"
_POINTS = 640
"""Of a trace: ten on a millimetre, as far as paper shows them."""
_STYLES = {"Eq. 15 as printed": ":", "paper's block, every regime": "-.", "block exact at rest": "--"}
"""What is predicted, and the line it gets."""


def example_arch(radius: float) -> Arch:
    """Return the arch of Fig. 8 with that radius [m], continuous."""
    return Arch(radius, 0.15 * radius, np.radians(157.5), restitution=0.9)


def response_curves(accelerogram: Accelerogram) -> list[Curve]:
    """Return the strong phase with the dominant pulse (b) and the responses with what is predicted (c, d)."""
    pulse = extract_pulses(accelerogram).dominant
    times = np.linspace(pulse.start_time, pulse.end_time, 121)
    strong = np.flatnonzero(np.abs(accelerogram.acceleration) > 0.25 * accelerogram.peak_acceleration)
    phase = slice(int(strong[0]), int(strong[-1]) + 1)
    ground = thinned(accelerogram.times[phase], accelerogram.acceleration[phase], _POINTS)
    curves = [
        Curve("b", "record", _TIME, "acceleration [m/s²]", *ground),
        Curve("b", "dominant pulse", _TIME, "acceleration [m/s²]", times, pulse.acceleration(times), "--"),
    ]
    return curves + [
        curve for panel, radius in RADII.items() for curve in _arch_curves(panel, radius, accelerogram, pulse)
    ]


def _arch_curves(panel: str, radius: float, accelerogram: Accelerogram, pulse: Pulse) -> list[Curve]:
    mechanism = example_arch(radius).mechanism()
    response = integrate(mechanism, accelerogram, history=True)
    assert response.times is not None and response.rotation is not None  # asked for
    size = np.abs(response.rotation)
    moving = np.flatnonzero(size > 0.01 * size.max())
    used = slice(max(int(moving[0]) - 1, 0), int(moving[-1]) + 1)
    times, ratio = response.times[used], response.rotation[used] / mechanism.critical_rotation
    curves = [
        Curve(panel, f"full integration, r = {radius:g} m", _TIME, ROTATION, *thinned(times, ratio, _POINTS))
    ]
    span = np.array([times[0], times[-1]])
    for name, level in predicted_levels(mechanism, pulse).items():
        if np.isfinite(level):
            curves.append(Curve(panel, name, _TIME, ROTATION, span, np.full(2, level), _STYLES[name]))
    return curves


def predicted_levels(mechanism: Mechanism, pulse: Pulse) -> Mapping[str, float]:
    """Return what is predicted as the largest rotation ratio: by the paper's block and formula, and by ours."""
    paper = mechanism.equivalent_block("uplift")
    values = (
        printed_maximum(paper, pulse),
        predict_maximum(paper, pulse).rotation_ratio,
        predict_maximum(mechanism.equivalent_block("exact_at_rest"), pulse).rotation_ratio,
    )
    return dict(zip(_STYLES, values, strict=True))


@row("predictions", "One row per arch of Fig. 8: the closed forms under the dominant pulse of its record")
class PredictionRow(Row):
    """What Eq. 15 is fed and says with either block of the paper, beside the block exact at rest and the integration.

    Reports leave Eq. 15 out: the closed form that they print follows the same pulse in every regime.
    """

    radius_m: float = column("Radius of the centreline of the arch")
    amplitude_m_s2: float = column("Signed amplitude a_g of the pulse")
    circular_frequency_rad_s: float = column("Circular frequency of the pulse")
    frequency_parameter_rad_s: float = column("p of the linearised block", equation="Eq. 11")
    critical_rotation_rad: float = column("Critical rotation")
    restitution: float = column("Ratio of angular velocities after and before an impact")
    acceleration_scale_linearised: float = column("Scale a_sc of the linearised block", equation="Eq. 11")
    acceleration_scale_uplift: float = column("Scale a_sc,alt of the true uplift", equation="Eq. 13")
    printed_rotation_ratio: float = column(
        "Largest rotation over critical rotation as printed, with a_sc; empty where the radicand is negative",
        equation="Eqs. 11, 15",
    )
    printed_uplift_rotation_ratio: float = column("The same with a_sc,alt", equation="Eqs. 13, 15")
    predicted_rotation_ratio: float = column("That of the block exact at rest; INF if it overturns")
    integrated_rotation_ratio: float = column("That of the mechanism under the record; INF if it overturns")


def prediction_rows(accelerogram: Accelerogram) -> list[PredictionRow]:
    """Return what the closed forms say of each arch under the dominant pulse of a record."""
    pulse = extract_pulses(accelerogram).dominant
    rows = []
    for radius in RADII.values():
        mechanism = example_arch(radius).mechanism()
        linearised = mechanism.equivalent_block("linearised")
        uplift = mechanism.equivalent_block("uplift")
        rows.append(
            PredictionRow(
                radius_m=radius,
                amplitude_m_s2=pulse.amplitude,
                circular_frequency_rad_s=pulse.circular_frequency,
                frequency_parameter_rad_s=linearised.frequency_parameter,
                critical_rotation_rad=mechanism.critical_rotation,
                restitution=linearised.restitution,
                acceleration_scale_linearised=linearised.acceleration_scale,
                acceleration_scale_uplift=uplift.acceleration_scale,
                printed_rotation_ratio=printed_maximum(linearised, pulse),
                printed_uplift_rotation_ratio=printed_maximum(uplift, pulse),
                predicted_rotation_ratio=predict_maximum(
                    mechanism.equivalent_block("exact_at_rest"), pulse
                ).rotation_ratio,
                integrated_rotation_ratio=integrate(mechanism, accelerogram).rotation_ratio,
            )
        )
    return rows
