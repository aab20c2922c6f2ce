"""Every sentence that refuses or warns in a test, held to sentences.txt: no word changes without a line in its diff.

A number is held as #, what is quoted as '…' and a path as /…: neither the machine nor the values of a test matter.
"""

import os
import re
from collections.abc import Callable, Iterator
from functools import wraps
from pathlib import Path
from typing import Any

import pytest

from rocking.errors import RockingError
from rocking.warnings import RockingWarning

LISTED = Path(__file__).with_suffix(".txt")
RENEW = "ROCKING_SENTENCES"
"""The variable of the environment with which the sentences of a whole run are listed anew: `make sentences`."""
DRAWN = {"test_formats_mutation"}
"""The modules whose input is drawn, as that of hypothesis is, and with it what they refuse."""
_LONGEST = 300
_SHAPES = (
    (re.compile(r"'[^']*'|\"[^\"]*\"|“[^”]*”"), "'…'"),
    (re.compile(r"(?<!\w)/[\w./-]+"), "/…"),
    (re.compile(r"[-+−]?\d[\d.,]*(e[-+]?\d+)?"), "#"),
)
_listed = frozenset(LISTED.read_text(encoding="utf-8").splitlines())
_of_test: set[str] = set()
_of_run: set[str] = set()


def _noted(method: Callable[..., None], sentence_of: Callable[..., str]) -> Callable[..., None]:
    """Return the method that makes an error or a warning, which then also notes its sentence."""

    @wraps(method)
    def noting(made: object, *values: object, **named: object) -> None:
        method(made, *values, **named)
        sentence = " ".join(sentence_of(made).encode("utf-8", "backslashreplace").decode().split())
        for pattern, shape in _SHAPES:
            sentence = pattern.sub(shape, sentence)
        _of_test.add(sentence[:_LONGEST].strip())

    return noting


RockingError.__init__ = _noted(RockingError.__init__, Exception.__str__)
RockingWarning.__post_init__ = _noted(RockingWarning.__post_init__, str)


@pytest.fixture(autouse=True)
def held_to_the_list(request: pytest.FixtureRequest) -> Iterator[None]:
    """Fail a test in which a sentence is said that the list does not hold."""
    _of_run.update(_of_test)  # of what a module makes when it is imported
    _of_test.clear()
    yield
    said = set(_of_test)
    _of_test.clear()
    if hasattr(getattr(request.node, "obj", None), "hypothesis") or request.module.__name__ in DRAWN:
        return
    _of_run.update(said)
    if RENEW not in os.environ and not said <= _listed:
        new = sorted(said - _listed)
        pytest.fail(
            f"{LISTED.name} does not list: {new}; where they are meant, run make sentences.", pytrace=False
        )


def pytest_testnodedown(node: Any) -> None:
    """Take the sentences of a worker of pytest-xdist."""
    _of_run.update(getattr(node, "workeroutput", {}).get("sentences", ()))


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Give the sentences to the process that started this one, or list those of the whole run."""
    if hasattr(session.config, "workerinput"):
        session.config.workeroutput["sentences"] = sorted(_of_run)
    elif RENEW in os.environ:
        LISTED.write_text("".join(f"{sentence}\n" for sentence in sorted(_of_run)), encoding="utf-8")
