"""The candidate that governs, for demands whose answer is known."""

import numpy as np
import pytest
from governing import governing_envelope

from rocking.errors import StructureError
from rocking.structures.spire import Spire
from rocking.structures.wall import Wall


def test_the_lowest_uplift_multiplier_of_a_wall_belongs_to_the_highest_hinge():
    """λ = 2 t/h₁ falls with the height of the hinge."""
    heights = np.linspace(0.5, 2.5, 9)
    found = governing_envelope(
        Wall(1.5, 1.5, 0.3, 0.9).candidates(heights), lambda mechanism: 1 / mechanism.uplift_multiplier
    )
    np.testing.assert_allclose(found.demands, heights / 0.6, rtol=1e-14)
    assert found.position == 2.5
    assert found.structure == Wall(2.5, 0.5, 0.3, 0.9)


def test_the_largest_frequency_parameter_of_a_spire_belongs_to_the_highest_crack():
    spire = Spire(3.0, 12.0, restitution=0.8)
    found = governing_envelope(
        spire.candidates((0.0, 6.0, 3.0)), lambda mechanism: mechanism.positive.frequency_parameter
    )
    assert found.position == 6.0
    assert found.demand == found.demands.max()
    assert found.structure == Spire(3.0, 12.0, crack_height=6.0, restitution=0.8)


def test_the_first_that_overturns_governs():
    found = governing_envelope(
        Wall(1.5, 1.5, 0.3).candidates((1.0, 1.5, 2.0)),
        lambda mechanism: np.inf if mechanism.uplift_multiplier < 0.5 else 0.3,
    )
    assert found.position == 1.5
    assert found.demand == np.inf


def test_candidates_outside_and_demands_that_are_no_number_are_refused():
    with pytest.raises(StructureError, match=r"hinge_height is 3\.0 m, but must lie inside the wall"):
        Wall(1.5, 1.5, 0.3).candidates((1.0, 3.0))
    with pytest.raises(StructureError, match=r"crack_height is 13\.0 m"):
        Spire(3.0, 12.0).candidates((1.0, 13.0))
    with pytest.raises(StructureError, match="candidates is empty"):
        governing_envelope({}, lambda mechanism: 1.0)
    with pytest.raises(StructureError, match="not a number for the candidate at 1"):
        governing_envelope(Wall(1.5, 1.5, 0.3).candidates((1.0,)), lambda mechanism: np.nan)
