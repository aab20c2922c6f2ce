"""Clock: the CPU time that each stage of an assessment takes."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from time import process_time


class Clock:
    """The CPU time of each stage, s, added up."""

    def __init__(self) -> None:
        self.durations: dict[str, float] = defaultdict(float)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Add the CPU time of what is done within to that of a stage."""
        started = process_time()
        try:
            yield
        finally:
            self.durations[name] += process_time() - started

    def add(self, durations: Mapping[str, float]) -> None:
        """Add what was measured elsewhere, also in the run that computed what a store has kept."""
        for name, duration in durations.items():
            self.durations[name] += duration
