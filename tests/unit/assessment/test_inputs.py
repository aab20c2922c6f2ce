"""Inputs: whatever a result is computed from is in the hash by which it is known, without being listed."""

from dataclasses import field, fields, make_dataclass, replace

import numpy as np
import pytest

from rocking.assessment.inputs import (
    CaseInputs,
    Inputs,
    PairInputs,
    PredictionInputs,
    PulseInputs,
    ReserveInputs,
)
from rocking.assessment.motions import Motion
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings, PredictingPulse
from rocking.hashes import sha256_of_content
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Block, LoadedWall
from rocking.structures.unknown_geometry import as_structure

RECORD = Accelerogram(np.sin(np.arange(100.0)), 0.01, "EW")
MOTION = Motion((RECORD,))
PAIR = Motion((RECORD, Accelerogram(np.cos(np.arange(100.0)), 0.01, "NS")))
BLOCK = Block(2.0, 0.2)
CASE = CaseInputs(motion=MOTION, structure=BLOCK, settings=AssessmentSettings())
OTHERS = {
    CASE: {
        "motion": PAIR,
        "structure": Block(2.0, 0.21),
        "settings": AssessmentSettings(ensemble=EnsembleSettings(risk=0.04)),
        "pulse": Pulse(amplitude=1.0, circular_frequency=2.0, start_time=3.0),
        "alone": False,
        "bounces": False,
        "crack_heights": 1,
        "processing_variants": True,
    },
    PulseInputs(components=(MOTION,), place=0, settings=PredictingPulse(), measured=True): {
        "components": (MOTION, MOTION),
        "place": 1,
        "settings": PredictingPulse(choice="demand"),
        "measured": False,
    },
    PredictionInputs(structure=BLOCK, candidates=(), acceleration_scale="mean"): {
        "structure": Block(2.0, 0.21),
        "candidates": (Pulse(amplitude=1.0, circular_frequency=2.0, start_time=3.0),),
        "acceleration_scale": "uplift",
    },
    PairInputs(pair=PAIR, processing=True): {"pair": MOTION, "processing": False},
    ReserveInputs(motion=MOTION, structure=BLOCK, crack="", settings=AssessmentSettings()): {
        "motion": PAIR,
        "structure": Block(2.0, 0.21),
        "crack": "hinge at 1 m",
        "settings": AssessmentSettings(ensemble=EnsembleSettings(reserve=2.0)),
        "support_loss": 0.1,
        "share": 0.1,
    },
}


def test_every_kind_of_inputs_is_here():
    assert {type(inputs) for inputs in OTHERS} == set(Inputs.__subclasses__())


@pytest.mark.parametrize("inputs", OTHERS, ids=lambda inputs: type(inputs).__name__)
def test_every_field_is_in_the_fingerprint(inputs):
    others = OTHERS[inputs]
    assert list(others) == [field.name for field in fields(inputs)]
    prints = {inputs.fingerprint} | {
        replace(inputs, **{name: other}).fingerprint for name, other in others.items()
    }
    assert len(prints) == 1 + len(others)
    assert replace(inputs).fingerprint == inputs.fingerprint


def test_a_field_that_is_added_is_in_the_fingerprint():
    """Of the inputs, of a structure, and of a setting within settings."""
    more = make_dataclass(
        "More", [("courses", int, field(kw_only=True, default=3))], bases=(CaseInputs,), frozen=True
    )
    given = {field.name: getattr(CASE, field.name) for field in fields(CASE)}
    assert (
        more(**given).fingerprint
        == more(**given, courses=3).fingerprint
        != more(**given, courses=4).fingerprint
    )

    part = make_dataclass("Part", [("mortar", str, "lime")], frozen=True)
    settings = make_dataclass("Given", [("part", part, part())], frozen=True)
    assert sha256_of_content(settings()) != sha256_of_content(settings(part("cement")))


def test_what_no_file_gives_is_in_the_fingerprint():
    """The mechanism in which a wall opens."""
    wall = LoadedWall.of_size(3.2, 0.35, 20e3, tie_heights=(2.0,), tie_stiffness=5e4, tie_strength=8e3)
    opened = [candidate.structure for candidate in wall.mechanisms() if candidate.structure.opening]
    prints = {replace(CASE, structure=structure).fingerprint for structure in (wall, *opened)}
    assert len(prints) == 1 + len(opened) > 2


def test_content_that_nothing_tells_is_refused():
    """Functions, of which a mechanism alone consists: two of them would be one case."""
    with pytest.raises(TypeError):
        assert replace(CASE, structure=as_structure(BLOCK.mechanism())).fingerprint
