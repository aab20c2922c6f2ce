"""Fig. 8 of the source paper: two arches under a record, integration beside the prediction from one pulse."""

from collections.abc import Mapping

import numpy as np

from docs.paper.curves import ROTATION, Curve
from rocking.motion.integration import integrate
from rocking.pulses import Pulse, extract_pulses
from rocking.records.accelerogram import Accelerogram
from rocking.reports.style import thinned
from rocking.sine_pulse import predict_maximum, printed_maximum
from rocking.structures.arch import Arch
from rocking.structures.mechanism import Mechanism

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
        predict_maximum(mechanism.equivalent_block("rest"), pulse).rotation_ratio,
    )
    return dict(zip(_STYLES, values, strict=True))
