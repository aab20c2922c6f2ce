"""The force of a tie: from the history of the course that it holds, by hand."""

import numpy as np
import pytest

from docs.research.tie_forces import largest_force
from rocking.contacts.dynamics import StackResponse
from rocking.structures.mechanism import Tie
from rocking.structures.stack import Held


def test_a_tie_pulls_by_how_far_its_point_goes_to_the_right_and_never_pushes():
    """A course whose centre goes 0.02 m to the right and which turns by 0.1 rad about it; the tie is 1 m above it."""
    held = Held(0, (0.3, 2.0), tie=Tie(stiffness=5e6, pretension=1e3))

    def response(right: float, turn: float) -> StackResponse:
        places = np.array([[[0.0, 0.0, 0.0]], [[right, 0.0, turn]]])
        return StackResponse(False, np.zeros(1), np.zeros(1), 1, 0, np.arange(2.0), places)

    moved = 0.02 + 0.3 * (np.cos(0.1) - 1) + 1.0 * np.sin(0.1)
    assert largest_force(held, (0.0, 1.0), response(0.02, 0.1)) == pytest.approx(1e3 + 5e6 * moved)
    assert largest_force(held, (0.0, 1.0), response(-0.02, -0.1)) == 1e3
