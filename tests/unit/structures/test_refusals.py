"""What one value alone cannot tell: sizes that do not go together are refused in one sentence, with their bound."""

import numpy as np
import pytest

from rocking.errors import DoesNotStandError, StructureError
from rocking.structures import Arch, ArchOnPiers, Block, Facade, Frame, LoadedWall, RigidBody, Spire, Wall
from tests.refusals import refused

LEANING = Block(2.0, 0.2, one_sided=True, restitution=0.5)
PIERS = {"pier_width": 2.0, "pier_height": 4.0}
TIED = {"tie_heights": (3.4,), "tie_stiffness": 8e3}
TIGHT = TIED | {"tie_pretension": 3e3, "behind": "cross_walls", "restitution": 0.5}


def facade(**changes):
    return Facade((3.5, 3.0, 2.5), (0.6, 0.5, 0.4), 20e3, **changes)


@pytest.mark.parametrize(
    "make, field, value",
    [
        (lambda: Block(1.0, 0.2, restitution="magic"), "restitution", "'magic'"),
        (lambda: Wall(2.0, 1.0, float("nan")), "thickness", "nan"),
        (lambda: Block(1.0, 0.2, one_sided=True), "restitution", "missing"),
        (lambda: Wall.of_size(3.0, 0.3, 3.5), "hinge_height", "3.5"),
        (lambda: RigidBody(0.3, 0.4, 2.0, -1.4), "inertia", "-1.4"),
        (lambda: Spire(3.0, 12.0, crack_height=12.0), "crack_height", "12.0"),
        (lambda: Spire(3.0, 12.0, 1.5), "wall_thickness", "1.5"),
        (lambda: Arch(10.0, 21.0, 2.0), "thickness", "21.0"),
        (lambda: ArchOnPiers(5.0, 2.8, np.pi, **PIERS), "pier_width", "2.0"),
        (lambda: facade(**TIED | {"tie_heights": (9.1,)}), "tie_heights", "9.1"),
        (lambda: facade(tie_stiffness=1e3), "tie_heights", "empty"),
        (lambda: facade(**TIED, tie_pretension=1e3), "tie_pretension", "1000.0"),
        (lambda: facade(**TIGHT, tie_strength=2e3), "tie_strength", "2000.0"),
        (lambda: facade(**TIED, tie_plastic_elongation=0.02), "tie_plastic_elongation", "0.02"),
        (lambda: facade(tie_heights=(3.4,), tie_strength=2e3), "tie_stiffness", "0"),
        (lambda: facade(eccentricity=0.21), "eccentricity", "0.21"),
        (lambda: facade(thrust_height=12.0), "thrust_height", "12.0"),
        (lambda: facade(crack_storey=4), "crack_storey", 4),
        (lambda: facade(crack_height=9.0), "crack_height", "9.0"),
        (lambda: LoadedWall(2.0, -1.4, 0.3, 19e3), "upper_height", "-1.4"),
    ],
)
def test_a_size_that_does_not_go_with_the_others_is_refused(make, field, value):
    with refused(StructureError, field, value) as caught:
        make()
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "make, field, value, said",
    [
        (lambda: Wall.of_size(3.0, 0.3, crack="known"), "crack", "known", "hinge_height"),
        (lambda: Spire(3.0, 15.0, crack="known"), "crack", "known", "crack_height"),
        (
            lambda: Facade((3.5, 3.0), (0.6, 0.5), 20e3, crack="known"),
            "crack",
            "known",
            "crack_storey or crack_height",
        ),
        (lambda: Arch(10.0, 1.5, np.radians(157.5), crack="known"), "crack", "known", "hinge_angles"),
        (lambda: Frame(2.0, 2, 0.3), "column", 2.0, "Block"),
        (lambda: Frame(LEANING, 2, 0.3), "column", LEANING, "Block that rocks to both sides"),
        pytest.param(
            lambda: Arch(10.0, 1.0, np.pi),
            "thickness",
            1.0,
            "1.07478038 m",  # the least at which a semicircle stands
            marks=pytest.mark.process,  # the least thickness takes more than a second
        ),
        (lambda: Arch(10.0, 2.0, 0.5), "thickness", 2.0, "0.2121"),
        (
            lambda: Arch(10.0, 1.5, 3.0, restitution="momentum"),
            "restitution",
            "momentum",
            "'unsafe momentum'",
        ),
        (lambda: Arch(10.0, 1.5, 2.75, hinge_angles=(0, 1, 2)), "hinge_angles", (0, 1, 2), ""),
        (lambda: facade(floor_loads=(1e3,)), "floor_loads", (1e3,), ""),
        (lambda: facade(crack_storey=2, crack_height=1.0), "crack_height", 1.0, ""),
    ],
)
def test_sizes_that_do_not_go_together_are_refused_in_one_sentence(make, field, value, said):
    with refused(StructureError, field, value) as caught:
        make()
    assert said in str(caught.value)
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "make",
    [
        lambda: facade(thrust=1e6),
        lambda: Facade((3.5, 3.0), (1.0, 0.35), 20e3, thrust=3e3),  # with a crack above the ground floor
        lambda: Facade((3.0, 3.0), (0.3, 1.0), 20e3),
    ],
)
def test_what_its_loads_turn_over_at_rest_is_refused(make):
    with pytest.raises(DoesNotStandError) as caught:
        make()
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)
