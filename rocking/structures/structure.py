"""What every structure offers: its mechanism, computed once."""

from abc import ABC, abstractmethod
from functools import cached_property

from rocking.structures.mechanism import Mechanism


class Structure(ABC):
    """A geometry that reduces to a Mechanism. Subclasses are frozen dataclasses checked at birth."""

    def mechanism(self) -> Mechanism:
        """Return the structure in standard form; the same object at every call."""
        return self._mechanism

    @cached_property
    def _mechanism(self) -> Mechanism:
        return self._build()

    @abstractmethod
    def _build(self) -> Mechanism:
        """Reduce the geometry to I, J, G, B."""
