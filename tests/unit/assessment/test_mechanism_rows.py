"""The table of all mechanisms: what is followed, what statics alone lists, and the forces that hold each back."""

import math

import numpy as np
import pytest

import rocking
from rocking.assessment.assessor import Assessor
from rocking.assessment.rows import MechanismRow, rows_of_record
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.structures import Block, Facade, LoadedWall

SETTINGS = AssessmentSettings(ensemble=EnsembleSettings(members=16, reserve=0))


def rows_under(amplitude, **structures) -> list[MechanismRow]:
    pulse = rocking.Pulse(amplitude=amplitude, circular_frequency=6.0, start_time=0.5)
    record = rocking.Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    result = Assessor(SETTINGS).assess("r", [record], on_the_ground(structures))
    return list(rows_of_record(result).mechanisms)


def test_every_mechanism_stands_in_the_table_with_its_members_and_one_of_them_governs():
    wall = LoadedWall.of_size(3.0, 0.35, 19e3, top_load=2e3)
    rows = rows_under(4.0, wall=wall, pier=Block.of_size(0.6, 3.0))
    of_wall = [row for row in rows if row.structure == "wall"]
    family = wall.mechanisms()
    # of two alike sides one stands for both
    both = {member.name.replace(" inwards", "") for member in family}
    assert both <= {other_part.mechanism.replace(" inwards", "") for other_part in of_wall}
    assert [one_part.governs for one_part in of_wall].count(True) == 1
    assert of_wall[0].governs and of_wall[0].members >= 16  # its top slips first
    # what statics alone lists has no members
    assert of_wall[-1].members is None and of_wall[-1].static_multiplier > of_wall[0].static_multiplier
    assert {part.hold for part in of_wall} == {"top"}
    (pier,) = [one_row for one_row in rows if one_row.structure == "pier"]
    assert (pier.hold, pier.governs) == ("", True)
    assert math.isnan(pier.hold_force_at_rest_n_per_m)


def test_force_at_rest_is_that_of_hand():
    """Section 12.7: R = 8.858030 kN/m with the hinge where λ is least."""
    facade = Facade(
        (3.6,), (0.35,), 18e3, floor_loads=(10e3,), eccentricity=0.05, behind="cross_walls", restitution=0.7,
        tie_heights=(3.6,), tie_stiffness=2e7,
    )  # fmt: skip
    rows = rows_under(7.0, facade=facade)
    bulge = next(one_row for one_row in rows if one_row.mechanism == "bulges between foot and tie")
    assert (bulge.hold, bulge.hold_height_m) == ("tie", 3.6)
    assert bulge.hold_force_at_rest_n_per_m == pytest.approx(8.858030e3, abs=5e-3)
    assert bulge.largest_hold_force_n_per_m > bulge.hold_force_at_rest_n_per_m
    # a crack that the tie keeps shut for good is none
    assert {row.mechanism for row in rows} == {"bulges between foot and tie"}


def test_largest_force_of_an_elastic_tie_is_its_stretch():
    """k z sin φ as the wall turns about its toe, φ the largest rotation to its side; to 1e-3 of the steps."""
    wall = Facade(
        (4.0,), (0.5,), 18e3, behind="cross_walls", restitution=0.7, crack_storey=1, crack="known",
        tie_heights=(2.0,), tie_stiffness=3e5, tie_strength=1e9,
    )  # fmt: skip
    turns = next(structure for structure in rows_under(5.0, wall=wall) if structure.mechanism == wall.does)
    pulse = rocking.Pulse(amplitude=5.0, circular_frequency=6.0, start_time=0.5)
    record = rocking.Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    response = rocking.integrate(wall, record)
    largest = response.rotation_ratio * wall.mechanism().critical_rotation
    assert largest > 1e-3
    assert turns.largest_hold_force_n_per_m == pytest.approx(3e5 * 2.0 * math.sin(largest), rel=1e-3)


def test_forces_of_what_holds_it_are_in_newton_per_metre():
    """Their names end in _m as lengths do."""
    units = {column.name: column.unit for column in MechanismRow.table.columns if "force" in column.name}
    assert units == {"hold_force_at_rest_n_per_m": "N/m", "largest_hold_force_n_per_m": "N/m"}
