"""Records and structures tried by every method: what the choice of the cheapest one is calibrated on."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from time import process_time

from rocking.assessment.assess import AssessmentSettings, predict
from rocking.assessment.fidelity import (
    NUDGE,
    Limits,
    block_stands,
    closed_form_stands,
    known_error,
    stays_at_rest,
)
from rocking.assessment.method import Method
from rocking.motion.integration import integrate
from rocking.pulses import Light, PulseAnalysis, extract_pulses, pulse_method
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Mechanism, Structure

SCALES = (0.5, 0.7, 1.0, 1.4, 2.0)
"""Factors on each record."""


@dataclass(frozen=True)
class Trial:
    """One structure under one record: what the rule looks at, the truth, and the CPU time of each method [s].

    margin: of the closed form under the dominant pulse.
    block_s, mechanism_s: without sensitivity and fragility; block_full_s, mechanism_full_s: with them.
    """

    record: str
    site: str
    structure: str
    scale_factor: float
    at_rest: bool
    light: Light
    margin: float
    known_error: float
    block_ratio: float
    block_sensitivity: float
    block_fragile: bool
    mechanism_ratio: float
    closed_form_s: float
    block_s: float
    block_full_s: float
    mechanism_s: float
    mechanism_full_s: float

    def method(self, limits: Limits) -> Method:
        """What answers under `limits`."""
        if self.at_rest:
            return Method.NOTHING_TO_INTEGRATE
        if closed_form_stands(self.light, self.margin, limits):
            return Method.CLOSED_FORM
        if self.known_error <= limits.known_error and block_stands(
            self.block_ratio, self.block_sensitivity, self.block_fragile, limits
        ):
            return Method.BLOCK_ON_RECORD
        return Method.MECHANISM_ON_RECORD

    def rotation_ratio(self, method: Method) -> float:
        """The answer of one method."""
        answers = {
            Method.NOTHING_TO_INTEGRATE: 0.0,
            Method.CLOSED_FORM: math.inf,
            Method.BLOCK_ON_RECORD: self.block_ratio,
        }
        return answers.get(method, self.mechanism_ratio)

    def duration(self, limits: Limits, full: bool) -> float:
        """What the answer took [s], the methods that were tried before it included.

        full: with its sensitivity and fragility where the mechanism answers.
        """
        method = self.method(limits)
        if method is Method.NOTHING_TO_INTEGRATE:
            return 0.0
        tried = method is not Method.CLOSED_FORM and self.known_error <= limits.known_error
        nudged = tried and 0 < self.block_ratio <= limits.rotation_ratio
        whole = self.mechanism_full_s if full else self.mechanism_s
        block = tried * self.block_s + nudged * self.block_full_s
        return self.closed_form_s + block + (method is Method.MECHANISM_ON_RECORD) * whole


def trials(
    record: str,
    accelerogram: Accelerogram,
    structures: Mapping[str, Structure],
    settings: AssessmentSettings | None = None,
) -> Iterator[Trial]:
    """Yield a trial for each structure and each of SCALES on the record."""
    settings = settings or AssessmentSettings()
    site = f"{accelerogram.event}, {accelerogram.station}"
    for scale in SCALES:
        scaled = accelerogram.scaled(scale)
        analysis = extract_pulses(scaled, settings=settings.pulse)
        for name, structure in structures.items():
            found = _measured(structure.mechanism(), scaled, analysis, settings)
            yield Trial(record, site, name, scale, **found)


def _measured(
    mechanism: Mechanism, accelerogram: Accelerogram, analysis: PulseAnalysis, settings: AssessmentSettings
) -> dict:
    prediction = predict(mechanism, pulse_method(settings.pulse_choice).candidates(analysis), None, settings)
    block = prediction.block
    whole = integrate(
        mechanism, accelerogram, settings.tolerance
    )  # builds the tables, so that the times are warm
    integrate(block, accelerogram)
    times = [process_time()]
    margin = predict_maximum(block, prediction.pulse).overturning_margin
    times.append(process_time())
    on_block = integrate(block, accelerogram)
    times.append(process_time())
    nudged = integrate(block, accelerogram, sensitivity=True, fragility_change=NUDGE)
    times.append(process_time())
    integrate(mechanism, accelerogram, settings.tolerance)
    times.append(process_time())
    integrate(mechanism, accelerogram, settings.tolerance, sensitivity=True)
    times.append(process_time())
    names = ("closed_form_s", "block_s", "block_full_s", "mechanism_s", "mechanism_full_s")
    return {
        "at_rest": stays_at_rest(mechanism, accelerogram),
        "light": prediction.light,
        "margin": margin,
        "known_error": known_error(mechanism, block),
        "block_ratio": on_block.rotation_ratio,
        "block_sensitivity": nudged.sensitivity,
        "block_fragile": bool(nudged.fragile),
        "mechanism_ratio": whole.rotation_ratio,
        **dict(zip(names, (after - before for before, after in pairwise(times)), strict=True)),
    }
