"""The basis of the checks: the table of mechanisms, what holds each, e* by the letter, and what a tie brings."""

from dataclasses import replace

import pytest

from rocking import DesignSpectrum, Facade, LoadedWall, check
from rocking.assessment.cracks import mechanisms_of
from rocking.products.checks.report import CheckedStructure, structures_data
from rocking.structures.joints import Joints
from rocking.study.settings import Settings

pytestmark = pytest.mark.usefixtures("undrawn")
SPECTRUM = DesignSpectrum.ntc(ag=1.5, f0=2.5, tc_star=0.35, soil="B")
ONE_STOREY = Facade(
    (3.6,), (0.35,), 18e3, floor_loads=(10e3,), eccentricity=0.05, behind="cross_walls", restitution=0.7,
    tie_heights=(3.6,), tie_stiffness=2e7, tie_strength=30e3,
)  # fmt: skip


def basis(structure, share=None, forces=()):
    listed = mechanisms_of(structure)
    page = CheckedStructure(
        name="wall",
        structure=structure,
        checked=check(structure, SPECTRUM),
        untied=check(structure.without_ties(), SPECTRUM) if structure.tie_heights else None,
        mechanisms=listed,
        mechanism_shares={} if share is None else dict.fromkeys(listed, share),
        largest_forces=dict.fromkeys(listed, forces),
    )
    return structures_data([page], SPECTRUM, Settings().for_pages).sheets[0].answers[0].basis


def texts(rows):
    return [" | ".join(str(cell) for cell in row) for row in rows]


def test_the_table_names_each_kind_of_mechanism_once_with_the_force_that_holds_it():
    """Section 12.7: α₀ = .496 and R = 8.86 kN/m as the storey bulges below its tie."""
    rows = texts(basis(ONE_STOREY).mechanisms.rows)
    (bulge,) = [one_row for one_row in rows if one_row.startswith("bulges between foot and tie")]
    assert "0.496" in bulge
    assert "tie at 3.60 m: 8.86 kN/m" in bulge
    # of cracks at eleven heights the weakest one, about the foot, in which the tie pulls with its strength
    (whole,) = [row for row in rows if row.startswith("overturns about its foot")]
    assert "1.49" in whole
    followed = texts(basis(ONE_STOREY, share=0.25, forces=[12e3]).mechanisms.rows)
    assert len(followed) == len(mechanisms_of(ONE_STOREY))
    assert all("25\u00a0%" in crack for crack in followed)
    assert any("tie at 3.60 m: 8.86 (12.0) kN/m" in one_crack for one_crack in followed)


def test_the_page_says_what_holds_the_top_and_what_slips():
    wall = LoadedWall.of_size(3.0, 0.35, 19e3, top_load=2e3, restitution=0.7).on_joints(Joints(0.6))
    told = " ".join(basis(wall).sentences)
    (top,) = wall.restraints
    assert str(top.warning) in told


def test_the_page_says_which_mass_ratio_counts_beside_that_of_the_letter():
    """Section 12.7: e* = 1 of a bulge with its floor left out; with it 22.68/32.68 = .694 where the hinge is at 2.40 m.

    With the hinge free both bodies still move by the same δ in the mean, so that both figures stay.
    """
    told = " ".join(basis(ONE_STOREY).sentences)
    assert "e* would be 0.694 and every capacity in acceleration 1.44 times as large; e* = 1.00" in told
    alone = replace(ONE_STOREY, floor_loads=())
    assert "e* would be" not in " ".join(basis(alone).sentences)


@pytest.mark.parametrize(("top", "lowers"), [(9.0, True), (None, False)])
def test_a_tie_that_brings_a_weaker_mechanism_is_told_with_both_ratios(top, lowers):
    """Three storeys cracked at the foot: what bulges below a tie at the top bears less displacement than the whole."""
    wall = Facade(
        (3.0, 3.0, 3.0), (0.4, 0.4, 0.4), 18e3, floor_loads=(8e3, 8e3, 8e3), behind="cross_walls",
        restitution=0.7, tie_heights=(top or 3.0,), tie_stiffness=2e7, tie_strength=30e3, crack_storey=1,
        crack="known",
    )  # fmt: skip
    if not lowers:  # weak enough to do next to nothing
        wall = replace(wall, tie_strength=100.0)
    tied, free = check(wall, SPECTRUM), check(wall.without_ties(), SPECTRUM)
    assert (tied.nonlinear.ratio < free.nonlinear.ratio * (1 - 1e-6)) is lowers
    told = [sentence for sentence in basis(wall).sentences if sentence.startswith("With the tie another")]
    assert len(told) == lowers
    if lowers:
        assert tied.linear.ratio > free.linear.ratio
        assert tied.nonlinear.ratio_in_words in told[0]
        assert free.nonlinear.ratio_in_words in told[0]
