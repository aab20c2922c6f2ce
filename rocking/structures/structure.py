"""What every structure offers: its mechanism, computed once, and its drawing at any rotation."""

from abc import ABC, abstractmethod
from dataclasses import fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureError
from rocking.quantities import within
from rocking.structures.mechanism import Mechanism


class Structure(ABC):
    """A geometry that reduces to a Mechanism. Subclasses are frozen dataclasses checked at birth."""

    def mechanism(self) -> Mechanism:
        """Return the structure in standard form; the same object at every call."""
        return self._mechanism

    def __getstate__(self) -> dict[str, Any]:
        """The fields alone: what is computed from them is computed again after a copy or in another process."""
        return {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]

    def outline(self, rotation: float = 0.0) -> list[np.ndarray]:
        """Return the rigid parts at a signed `rotation` [rad] as polygons (k, 2) in m, x to the right, y up."""
        return self._on_side(rotation, "_outline")

    def hinges(self, rotation: float = 0.0) -> np.ndarray:
        """Return the contact points (k, 2) in m at a signed `rotation` [rad]; at rest those of the positive side."""
        return self._on_side(rotation, "_hinges")

    @cached_property
    def _mechanism(self) -> Mechanism:
        return self._build()

    def _on_side(self, rotation: float, drawing: str) -> Any:
        """The drawing of the positive side, or the mirror image of the mirrored structure's for a negative rotation."""
        sides = self.mechanism().sides
        lowest = 0.0 if self.mechanism().one_sided else -sides[-1].end_rotation
        rotation = within(StructureError, "rotation", rotation, lowest, sides[0].end_rotation, "rad")
        if rotation >= 0:
            return getattr(self, drawing)(rotation)
        drawn = getattr(self._mirrored(), drawing)(-rotation)
        mirror = np.array([-1.0, 1.0])
        return [part * mirror for part in drawn] if isinstance(drawn, list) else drawn * mirror

    def _mirrored(self) -> "Structure":
        return self

    @abstractmethod
    def _build(self) -> Mechanism:
        """Reduce the geometry to I, J, G, B."""

    @abstractmethod
    def _outline(self, rotation: float) -> list[np.ndarray]:
        """The parts at a rotation ≥ 0 on the positive side."""

    @abstractmethod
    def _hinges(self, rotation: float) -> np.ndarray:
        """The contacts at a rotation ≥ 0 on the positive side."""


def turned(points: ArrayLike, pivot: ArrayLike, rotation: float) -> np.ndarray:
    """Return `points` (k, 2) turned clockwise by `rotation` [rad] about `pivot` (2,)."""
    cosine, sine = np.cos(rotation), np.sin(rotation)
    return (np.asarray(points, dtype=float) - pivot) @ np.array(
        [[cosine, -sine], [sine, cosine]]
    ) + np.asarray(pivot)
