"""Structures that several tests share."""

from rocking.structures import LoadedWall

HELD = LoadedWall.of_size(
    3.2,
    0.25,
    20e3,
    1.9,
    tie_heights=(1.6,),
    tie_stiffness=5e7,
    one_sided=True,
    restitution=0.7,
    crack="known",
)
"""A wall that leans against a building and that an unbreakable tie holds for good: it lifts and cannot overturn."""
