"""The cores that a record was given: kernels that run side by side, with what they give in its order all the same.

Compiled kernels let go of the interpreter, so that threads of one process use several cores.
"""

from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

A = TypeVar("A")
R = TypeVar("R")

_POOL: ContextVar[tuple[ThreadPoolExecutor, int] | None] = ContextVar("pool", default=None)
"""The threads at hand and their number; None in these themselves, which take one thing after another."""


@contextmanager
def on_cores(number: int) -> Iterator[None]:
    """Let `in_order` use so many cores within."""
    if number < 2:
        yield
        return
    with ThreadPoolExecutor(number) as pool:
        token = _POOL.set((pool, number))
        try:
            yield
        finally:
            _POOL.reset(token)


def in_order(work: Callable[[A], R], items: Iterable[A]) -> Generator[R, None, None]:
    """Yield what `work` gives of each of `items`, or raise what it raises, in the order of the items.

    On several cores as many of the next ones are begun meanwhile; what they give is lost if nobody asks for it. So that
    the results do not depend on the number of cores, `work` must depend on its item alone.
    """
    at_hand = _POOL.get()
    if at_hand is None:
        yield from map(work, items)
        return
    pool, number = at_hand
    begun: deque[Future[R]] = deque()
    try:
        for item in items:
            begun.append(pool.submit(work, item))
            if len(begun) > number:  # one waits, so that no core does
                yield begun.popleft().result()
        while begun:
            yield begun.popleft().result()
    finally:
        for future in begun:
            future.cancel()
