"""The ranges that the package says and the values that it refuses, where no test of the part itself meets them."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest

import rocking
from rocking.codes.check import CodeTerms
from rocking.errors import (
    ConfigurationError,
    MotionError,
    PulseError,
    RecordError,
    RockingError,
    StructureError,
)
from rocking.floors.place import place_from_config
from rocking.floors.spectrum import floor_spectrum
from rocking.floors.support import Mode, Support
from rocking.motion.batch import rocking_spectrum
from rocking.pulses import predicting_pulse
from rocking.quantities import GRAVITY
from rocking.records.formats.format import Options
from rocking.records.formats.text import even_step
from rocking.signal.processing import Processing, process
from rocking.signal.rotation import aligned, rotd
from rocking.sine_pulse.maximum import pulse_spectrum, sides_under
from rocking.structures.equivalent_block import EquivalentBlock
from rocking.structures.joints import Joints
from rocking.structures.stack import Held, Stack
from rocking.structures.stones import counted_voussoirs
from rocking.study.settings import Settings
from tests.refusals import refused

BLOCK = rocking.Block(2.0, 0.2)
SIDE = BLOCK.mechanism().positive
BROKEN = replace(SIDE, inertia=lambda rotation: np.where(abs(rotation - 0.1) < 0.01, np.nan, 1.0))
LINEAR = BLOCK.mechanism().equivalent_block()
STACK = rocking.Block.of_size(0.6, 2.0).stack()
(COURSE,) = STACK.courses
RECORD = rocking.Accelerogram(np.sin(np.arange(200) * 0.1), 0.01)
STILL = np.zeros(9)
sensitive = partial(rocking.integrate, BLOCK, RECORD, sensitivity=True)
PULSE = rocking.Pulse(amplitude=3.0, circular_frequency=6.0)
ntc = partial(rocking.DesignSpectrum.ntc, f0=2.5, tc_star=0.35)
CODE = ntc(ag=2.0)
MODE = Mode(period=0.3, damping_ratio=0.05, participation=1.3)
ONE = rocking.Members([1.0])
SUPPORT = Support((MODE,))
SLAB = rocking.Facade((3.0,), (0.5,), 20e3, floor_loads=(5e3,), top_slab="flat")
STOREYS = {"name": "tower", "period_s": 0.3, "damping_ratio": 0.05, "storeys": 2, "height_m": 3.0}


@pytest.mark.parametrize("make, error, field, low, high", [
    (lambda value: rocking.integrate(BLOCK, PULSE, value), MotionError, "tolerance", 1e-13, 0.1),
    (lambda value: rocking.integrate_members(BLOCK, PULSE, ONE, value), MotionError, "tolerance", 1e-13, 0.1),
    (lambda value: rocking.integrate_batch([BLOCK], PULSE, tolerance=value), MotionError, "tolerance", 1e-13, 0.1),
    (Joints, StructureError, "friction", 0.0, 10.0),
    (lambda value: replace(STACK, friction=value), StructureError, "friction", 0.0, math.inf),
    (lambda value: rocking.Wall(2.0, 1.0, 0.4).stack(value), StructureError, "courses", 1, 40),
    (lambda value: counted_voussoirs(value, None), StructureError, "voussoirs", 3, 60),
    (lambda value: replace(LINEAR, restitution=value), StructureError, "restitution", 0.0, 1.0),
    (lambda value: replace(SIDE, restitution=value), StructureError, "restitution", 0.0, 1.0),
    (lambda value: pulse_spectrum([2.0], [2.0], value), StructureError, "restitution", 0.0, 1.0),
    (lambda value: rocking_spectrum(RECORD, [2.0], [0.2], value), MotionError, "restitution", 0.0, 1.0),
    (lambda value: BLOCK.hinges(value), StructureError, "rotation", -SIDE.end_rotation, SIDE.end_rotation),
    (lambda value: replace(PULSE, phase=value), PulseError, "phase", 0.0, 2 * math.pi),
    (lambda value: rocking.response_spectrum(RECORD, [1.0], value), RecordError, "damping", 0.0, 0.999),
    (lambda value: ntc(ag=value), ConfigurationError, "ag", math.ulp(0.0), 3 * GRAVITY),
    (lambda value: replace(CODE, damping=value), ConfigurationError, "damping", 0.0, 0.5),
    (lambda value: replace(CODE, topography=value), ConfigurationError, "topography", 1.0, 1.4),
    (lambda value: floor_spectrum(SUPPORT, STILL, value, max), RecordError, "damping_ratio", 0.001, 0.999),
    (lambda value: replace(MODE, participation=value), RecordError, "participation", -20.0, 20.0),
    (lambda value: replace(MODE, period=value), RecordError, "period", 0.0, 20.0),
    (lambda value: CodeTerms(behaviour_factor=value), ConfigurationError, "behaviour_factor", 1.0, math.inf),
    (lambda value: CodeTerms(confidence_factor=value), ConfigurationError, "confidence_factor", 1.0, math.inf),
    (lambda value: CodeTerms(elastic_period=value), ConfigurationError, "elastic_period", 0.0, math.inf),
    (lambda value: CodeTerms(least_others=value), ConfigurationError, "least_others", 0.0, 1.0),
    (lambda value: sensitive(fragile_change=value), MotionError, "fragile_change", 0.0, 0.5),
    (lambda value: rotd(RECORD, RECORD, step=value), RecordError, "step", math.ulp(0.0), 90.0),
    (lambda value: Options().time_step_of(value), RecordError, "time_step", 1e-6, 10.0),
])  # fmt: skip
def test_the_ends_of_a_range_are_allowed_and_nothing_beyond(
    make: Callable[[Any], object], error: type[RockingError], field: str, low: float, high: float
) -> None:
    for end, beyond in ((low, -math.inf), (high, math.inf)):
        if math.isfinite(end):
            if end != math.ulp(0.0):
                make(end)
            with refused(error, field):
                make(end + int(math.copysign(1, beyond)) if type(end) is int else np.nextafter(end, beyond))


@pytest.mark.parametrize("make, error, field", [
    (lambda: CodeTerms(limit_state="SLU"), ConfigurationError, "limit_state"),
    (lambda: Settings(pulse=3), ConfigurationError, "pulse"),
    (lambda: even_step(STILL[:1]), RecordError, "times"),
    (lambda: rocking.plot(RECORD.time_step), RockingError, "thing"),
    (lambda: CodeTerms(support=0.3), ConfigurationError, "support"),
    (lambda: CodeTerms(support_loss=0.0), ConfigurationError, "support_loss"),
    (lambda: replace(CODE, soil="F"), ConfigurationError, "soil"),
    (lambda: rocking.fragility([RECORD], BLOCK, method="cloud", levels=[0.1]), ConfigurationError, "levels"),
    (lambda: rocking.fragility([RECORD], LINEAR), ConfigurationError, "structure"),
    (lambda: rocking.integrate_batch("abc", RECORD), MotionError, "structures"),
    (lambda: rocking.integrate_batch(BLOCK, RECORD), MotionError, "structures"),
    (lambda: rocking.rocking_spectrum(PULSE, [2.0], [0.2], 0.9), MotionError, "accelerogram"),
    (lambda: rocking.integrate_members(BLOCK, PULSE, [1.0]), MotionError, "members"),
    (lambda: process(RECORD, Processing(low_pass=50.0)), RecordError, "lowpass"),
    (lambda: process(RECORD, Processing(high_pass=50.0)), RecordError, "highpass"),
    (lambda: process(RECORD, Processing(time_step=2.0)), RecordError, "time_step"),
    (lambda: process(RECORD, Processing(time_step=1e-7)), RecordError, "time_step"),
    (lambda: process(rocking.Accelerogram(STILL, 0.1), Processing(time_step=1.0)), RecordError, "time_step"),
    (lambda: rocking.assess([RECORD, replace(RECORD, time_step=0.02)], BLOCK), RecordError, ""),
    (lambda: rocking.integrate(BLOCK, replace(PULSE, amplitude=1e200)), MotionError, "acceleration"),
    (lambda: rocking.integrate(rocking.Mechanism(BROKEN), RECORD), MotionError, ""),
    (lambda: aligned(replace(RECORD, time_step=0.02), RECORD), RecordError, "time_step"),
    (lambda: sides_under(BLOCK, PULSE), StructureError, "equivalent_block"),
    (lambda: sides_under(LINEAR, RECORD), PulseError, "pulse"),
    (lambda: replace(PULSE, amplitude=math.nan), PulseError, "amplitude"),
    (lambda: replace(PULSE, circular_frequency=0.0), PulseError, "circular_frequency"),
    (lambda: replace(PULSE, start_time=math.inf), PulseError, "start_time"),
    (lambda: rocking.response_spectrum(RECORD, [0.0]), RecordError, "period"),
    (lambda: predicting_pulse((), lambda pulse: 1.0), PulseError, ""),
    (lambda: rocking.follow_stack(STACK, RECORD, vertical=replace(RECORD, acceleration=STILL)), MotionError, ""),
    (lambda: rocking.RigidBody(0.3, 1.0, 2.0, 1.4).stack(2), StructureError, "courses"),
    (lambda: BLOCK.mechanism().equivalent_block("largest"), StructureError, "scale"),
    (lambda: replace(SIDE, end_rotation=SIDE.critical_rotation), StructureError, "end_rotation"),
    (lambda: replace(SIDE, ties=(object(),), untied_gravity=None), StructureError, "untied_gravity"),
    (lambda: rocking.Mechanism(SIDE, SIDE, one_sided=True), StructureError, "negative"),
    (lambda: rocking.Mechanism(SIDE, one_sided=True).side_of(-STILL - 1, STILL), StructureError, "rotation"),
    (lambda: replace(LINEAR, one_sided=True, other_side=LINEAR), StructureError, ""),
    (lambda: rocking.Facade((3.0,) * 51, (0.5,) * 51, 20e3), StructureError, "storey_heights"),
    (lambda: replace(SLAB, loads_held=True).stack(), StructureError, "loads_held"),
    (lambda: replace(COURSE, mass=math.nan), StructureError, ""),
    (lambda: replace(COURSE, mass=0.0), StructureError, ""),
    (lambda: Stack(()), StructureError, ""),
    (lambda: Stack((COURSE, COURSE)), StructureError, ""),
    (lambda: Stack((COURSE,), (Held(1, (0.0, 0.5)),)), StructureError, ""),
    (lambda: place_from_config({"name": "tower", "modes": [0.3]}), ConfigurationError, ""),
    (lambda: place_from_config(STOREYS | {"building_height_m": 0.0}), ConfigurationError, ""),
])  # fmt: skip
def test_what_is_refused_is_refused(
    make: Callable[[], object], error: type[RockingError], field: str
) -> None:
    """Without a field there is none: what is wrong is more than one value."""
    with pytest.raises(error) as caught:
        make()
    assert str(caught.value).endswith(".") and caught.value.field == field


@pytest.mark.parametrize(
    "made",
    [
        Mode(period=1, damping_ratio=0, participation=1),
        rocking.Pulse(amplitude=1, circular_frequency=6, start_time=0, cycles=1, phase=0),
        EquivalentBlock(frequency_parameter=2, critical_rotation=1, acceleration_scale=1, restitution=1),
        rocking.Accelerogram([0, 1], 1, scale_factor=2),
        rocking.DesignSpectrum.ntc(ag=2, f0=2, tc_star=1, topography=1, damping=0),
        rocking.Wall(2, 1, 1, restitution=0),
    ],
)
def test_a_whole_number_is_taken_as_a_number(made: object) -> None:
    given = {name: type(value) for name, value in vars(made).items() if isinstance(value, int | float)}
    given.pop("smooth_steps", None)  # a count
    assert len(given) > 1 and {*given.values()} <= {float, bool}
