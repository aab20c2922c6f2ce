"""Half a sine, a cosine and several cycles against scipy's integration, and their limits."""

import math

import numpy as np
import pytest
from scipy.constants import g

from rocking import Accelerogram
from rocking.errors import MotionError, PulseError
from rocking.motion import integrate
from rocking.pulses import Pulse
from rocking.sine_pulse import Regime, predict_maxima, predict_maximum, printed_maximum
from rocking.structures import Block, EquivalentBlock
from tests.oracles.shaped_pulse import largest_rotation
from tests.refusals import refused

SHAPES = {
    "half sine": (0.0, 0.5),
    "full sine": (0.0, 1.0),
    "cosine": (math.pi / 2, 1.0),
    "two cycles": (0.0, 2.0),
    "five cycles": (0.0, 5.0),
    "three and a half": (0.0, 3.5),
    "late": (2.3, 1.7),
}


def block_of(eta: float) -> EquivalentBlock:
    """p = 1 and gλ = 1, so that a pulse is its ratios."""
    return EquivalentBlock(
        frequency_parameter=1.0, critical_rotation=1.0 / g, acceleration_scale=1.0, restitution=eta
    )


def pulse_of(shape: str, a: float, omega: float) -> Pulse:
    phase, cycles = SHAPES[shape]
    return Pulse(amplitude=a, circular_frequency=omega, cycles=cycles, phase=phase)


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_turns_the_block_as_scipy_integrates_it(shape):
    """To 1e-6, or to what such a change of the pulse makes of it; nothing is asked beside the border of overturning."""
    eta = 0.8
    block = block_of(eta)
    seen = set()
    for a, omega in ((0.9, 2.1), (1.2, 0.7), (2.3, 2.1), (2.3, 4.6), (4.0, 4.6)):
        pulse = pulse_of(shape, a, omega)
        predicted = predict_maximum(block, pulse)
        expected = largest_rotation(eta, a, omega, *SHAPES[shape])
        near = [predict_maximum(block, pulse_of(shape, a * f, omega)) for f in (1 - 1e-6, 1 + 1e-6)]
        overturn = {response.rotation_ratio == math.inf for response in near}
        seen.add(predicted.regime)
        if True in overturn:
            assert False in overturn or predicted.rotation_ratio == expected == math.inf
            continue
        spread = abs(near[1].rotation_ratio - near[0].rotation_ratio)
        told = a, omega, predicted
        assert predicted.rotation_ratio == pytest.approx(expected, rel=1e-6, abs=max(1e-7, spread)), told
    assert Regime.NO_UPLIFT in seen and len(seen) >= 3
    assert seen & {Regime.OVERTURNS_WITHOUT_IMPACT, Regime.OVERTURNS_AFTER_IMPACTS}


def test_many_at_a_call_are_each_as_alone():
    blocks = [
        block_of(0.9),
        EquivalentBlock(
            frequency_parameter=2.2,
            critical_rotation=0.2,
            acceleration_scale=1.1,
            restitution=0.7,
            one_sided=True,
        ),
    ]
    pulses = [pulse_of(shape, a, omega) for shape in SHAPES for a in (-2.5, 2.5) for omega in (1.0, 4.0)]
    ratios = predict_maxima(blocks, pulses)
    for i, block in enumerate(blocks):
        for j, pulse in enumerate(pulses):
            assert ratios[i, j] == pytest.approx(predict_maximum(block, pulse).rotation_ratio, rel=1e-13)


def test_a_short_cosine_leaves_the_block_where_it_was_and_half_a_sine_with_a_velocity():
    """∫a dt is 2a/ω for half a sine and 0 for a cosine: by the impulse alone the first rises to v²/2 and more."""
    block, a, omega = block_of(0.0), 1e4, 1e5
    velocity = 2 * a / omega
    rise = 1 - math.sqrt(1 - velocity**2)
    assert predict_maximum(block, pulse_of("half sine", a, omega)).rotation_ratio == pytest.approx(
        rise, rel=1e-3
    )
    assert predict_maximum(block, pulse_of("cosine", a, omega)).rotation_ratio < 1e-3 * rise


def test_more_cycles_of_what_lifts_turn_no_less_far():
    """Without an impact that stops it, the first cycle is that of one cycle; what follows can only add a maximum."""
    block = block_of(0.0)
    for a in (1.3, 2.0, 3.0):
        for omega in (2.0, 4.0, 8.0):
            counts = [
                predict_maximum(block, Pulse(amplitude=a, circular_frequency=omega, cycles=n)).rotation_ratio
                for n in (1, 2, 3, 8, 40)
            ]
            assert counts[-1] == pytest.approx(counts[-2], rel=1e-9), "η = 0: each cycle begins at rest"


def test_what_is_written_for_a_full_sine_refuses_another():
    block = block_of(0.9)
    half = pulse_of("half sine", 2.0, 3.0)
    with refused(PulseError, "pulse", half):
        printed_maximum(block, half)
    with refused(MotionError, "motion", half):
        integrate(Block(2.0, 0.2), half)
    assert predict_maximum(block, half).regime is not Regime.PRINTED_EXACT
    for wrong in ({"cycles": 0.0}, {"cycles": 2e3}, {"phase": -0.1}, {"phase": 7.0}):
        ((field, value),) = wrong.items()
        with refused(PulseError, field, value):
            Pulse(amplitude=1.0, circular_frequency=1.0, **wrong)


@pytest.mark.parametrize("shape", SHAPES)
def test_its_samples_are_those_of_the_sine_within_it(shape):
    pulse = pulse_of(shape, 3.0, 2.0)
    times = np.linspace(-1, pulse.end_time + 1, 4001)
    inside = (times >= 0) & (times <= pulse.end_time)
    assert pulse.acceleration(times) == pytest.approx(
        inside * 3.0 * np.sin(2.0 * times + pulse.phase), abs=1e-12
    )
    followed = integrate(
        Block(2.0, 0.2), Accelerogram(pulse.acceleration(times[inside]), times[1] - times[0])
    )
    predicted = predict_maximum(Block(2.0, 0.2).mechanism().equivalent_block("exact_at_rest"), pulse)
    assert followed.outcome is predicted.outcome
