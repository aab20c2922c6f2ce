"""A plugin of pytest: which functions of the package each test calls; or the tests that a list names, in its order.

MUTATION_CALLS=FOLDER pytest -p calls    writes, for each test, its seconds and the functions that it called
MUTATION_TESTS=FILE pytest -p calls      runs the tests of FILE; one that takes ten times as long has failed
"""

import json
import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FrameType

import pytest

PACKAGE = f"{Path.cwd()}/rocking/"
FOLDER = os.environ.get("MUTATION_CALLS")
TESTS = json.loads(Path(os.environ["MUTATION_TESTS"]).read_text()) if "MUTATION_TESTS" in os.environ else {}
PATIENCE = 30.0
"""s of the clock that a test may take besides ten times what it took: kernels are compiled, others use the machine."""

calls: dict[str, tuple[float, list[tuple[str, int]]]] = {}


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if TESTS:
        places = {name: place for place, name in enumerate(TESTS)}
        items[:] = sorted(
            (each for each in items if each.nodeid in places), key=lambda each: places[each.nodeid]
        )


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    codes: set[CodeType] = set()

    def note(frame: FrameType, event: str, argument: object) -> None:
        codes.add(frame.f_code)

    if FOLDER:
        sys.settrace(note)
    if item.nodeid in TESTS:
        signal.alarm(round(PATIENCE + 10 * TESTS[item.nodeid]))  # its signal ends the process
    begin = time.perf_counter()
    yield
    signal.alarm(0)
    sys.settrace(None)
    own = {(code.co_filename.removeprefix(PACKAGE), code.co_firstlineno) for code in codes}
    calls[item.nodeid] = (time.perf_counter() - begin, sorted(each for each in own if each[0][0] not in "/<"))


def pytest_sessionfinish() -> None:
    if FOLDER and calls:
        Path(FOLDER, f"{os.getpid()}.json").write_text(json.dumps(calls))
