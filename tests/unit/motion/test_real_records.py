"""Structures under real near-fault records: settled digits, the same forcing sampled finer, every verdict reached."""

import numpy as np
import pytest
from motion_cases import MECHANISMS
from scipy.constants import g

from rocking.motion import integrate
from rocking.records import read
from rocking.structures import Arch, Outcome

pytestmark = pytest.mark.real_records
RINALDI = "northridge1994_rinaldi/RSN1063_NORTHR_RRS228.AT2"


@pytest.mark.parametrize("radius", [10.0, 15.0])
def test_six_digits_of_the_arch_under_rinaldi_are_settled(real_records, radius):
    """The arch of the paper's Fig. 8: β = 157.5°, t/r = 0.15, continuous, η = 0.9."""
    (record,) = read(real_records / RINALDI)
    arch = Arch(radius, 0.15 * radius, np.deg2rad(157.5), restitution=0.9).mechanism()
    ratios = [integrate(arch, record, tolerance).rotation_ratio for tolerance in (1e-6, 1e-9, 1e-12)]
    assert 0 < ratios[-1] < np.inf
    assert ratios == pytest.approx([ratios[-1]] * 3, rel=5e-7)


def test_every_record_reaches_a_verdict(real_records, manifest):
    """No record, whatever its quirks, ends in a failure; a record below λ lifts nothing, and only such a record."""
    files = [row["file"] for row in manifest if row["file"].endswith(".AT2")]
    records = [record for file in files[:40] for record in read(real_records / file)]
    structures = [*MECHANISMS.values(), MECHANISMS["arch"].equivalent_block()]
    assert len(records) >= 20
    for record in records:
        for structure in structures:
            response = integrate(structure, record)
            assert response.outcome is not Outcome.FAILED
            assert not np.isnan(response.rotation_ratio)
            if not getattr(structure, "one_sided", False):
                lifted = record.peak_acceleration > g * structure.uplift_multiplier
                if structure.symmetric:
                    assert (response.outcome is not Outcome.NO_UPLIFT) == lifted
