"""The candidate that governs: a structure may crack at many places, and the demand decides which is worst."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from rocking.errors import StructureError
from rocking.structures.mechanism import Mechanism
from rocking.structures.structure import Structure


@dataclass(frozen=True, eq=False)
class Envelope:
    """Demand on every candidate. positions (k,): what tells them apart, a height in m. demands (k,).

    structures: the candidates in the same order. governing: index of the largest demand; the first of several that
    overturn (inf).
    """

    positions: np.ndarray
    demands: np.ndarray
    structures: tuple[Structure, ...]
    governing: int

    @property
    def position(self) -> float:
        """Position of the governing candidate."""
        return float(self.positions[self.governing])

    @property
    def demand(self) -> float:
        """The largest demand."""
        return float(self.demands[self.governing])

    @property
    def structure(self) -> Structure:
        """The governing candidate."""
        return self.structures[self.governing]


def governing_envelope(
    candidates: Mapping[float, Structure], demand: Callable[[Mechanism], float]
) -> Envelope:
    """Return the demand on each of `candidates` (Wall.candidates, Spire.candidates) and the one that governs.

    demand: for a mechanism, how much is asked of it, for instance the largest φ/φ_cr under a pulse or a record.
    Raises StructureError when there is no candidate or a demand is not a number.
    """
    if not candidates:
        raise StructureError("candidates is empty, but must hold one structure or more.")
    demands = np.array([float(demand(structure.mechanism())) for structure in candidates.values()])
    positions = np.array(list(candidates), dtype=float)
    if np.isnan(demands).any():
        raise StructureError(
            f"demand is not a number for the candidate at {positions[np.isnan(demands)][0]:g}."
        )
    return Envelope(positions, demands, tuple(candidates.values()), int(np.argmax(demands)))
