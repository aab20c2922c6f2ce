"""Fixtures and oracles that every test may use."""

import csv
import os
import random
import shutil
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

from tests import kernels

_VARIABLE = "ROCKING_RECORDS"
_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")

# By default an example must end within 0.2 s of the clock.
settings.register_profile("thorough", deadline=None)
settings.register_profile("quick", deadline=None, max_examples=24)
settings.load_profile("quick")

MARKED = {Path(__file__).parent / "research": "slow", Path(__file__).parent / "workflow": "process"}
"""The mark of every test in a folder: docs/research is run on demand, and what runs the workflow starts processes."""

PROGRAMS = {os.path.basename(sys.executable), "bash", "pdftotext", "snakemake"}
"""What only a test marked `process` may start; libraries ask other programs, as obspy asks git for its version."""

_running: list[pytest.Item] = []


def _hold_to_mark(event: str, arguments: tuple) -> None:
    """Refuse a process to a test that runs by `make test`."""
    starts = event == "os.fork" or (
        event == "subprocess.Popen" and os.path.basename(os.fsdecode(arguments[0])) in PROGRAMS
    )
    if starts and _running and not {"process", "slow"} & _running[-1].keywords.keys():
        raise RuntimeError(f"{_running[-1].nodeid} starts a process: mark it with pytest.mark.process")


sys.addaudithook(_hold_to_mark)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Name the test that runs, for the audit hook."""
    _running.append(item)
    try:
        return (yield)
    finally:
        _running.pop()


def pytest_configure(config: pytest.Config) -> None:
    """Hold what is refused and warned of to its list, which needs the package and therefore comes after the options."""
    config.pluginmanager.import_plugin("tests.sentences")


def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile once for all workers, or fetch what was compiled of the same kernels before."""
    if not hasattr(session.config, "workerinput") and not session.config.option.collectonly:
        kernels.fetch()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests of a folder, before those of some marks are left out; files that start processes come first.

    ROCKING_ORDER, a number, draws the order of the files and of the tests in each: none may lean on another.
    """
    for item in items:
        for folder, mark in MARKED.items():
            if item.path.is_relative_to(folder):
                item.add_marker(mark)
    long = {item.path for item in items if "process" in item.keywords}
    items.sort(key=lambda item: item.path not in long)
    if seed := os.environ.get("ROCKING_ORDER"):
        draw = random.Random(seed)
        files = {item.path: draw.random() for item in items}
        items.sort(key=lambda item: (files[item.path], draw.random()))


_LACKS = (_VARIABLE, "not installed", "by root", "asks Linux", "the extra compare")
"""What the reason of a skip says where the machine itself lacks something."""


def _skips(reporter: Any) -> Counter[str]:
    """How many tests were skipped, by the reason."""
    reasons = (report.longrepr[-1] for report in reporter.stats.get("skipped", []) if report.longrepr)
    return Counter(str(reason).removeprefix("Skipped: ") for reason in reasons)


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Say what was not tested, and how to test it."""
    terminal, skips = terminalreporter, _skips(terminalreporter)
    left_out = len(terminal.stats.get("deselected", []))
    if skips or left_out:
        terminal.section("not tested")
    for reason, number in skips.most_common():
        terminal.write_line(f"{number} of the tests: {reason}")
    if left_out:
        terminal.write_line(f"{left_out} of the tests: left out by their mark; make test-all runs every one")


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """With ROCKING_STRICT a skip fails the run, unless it says that the machine lacks something."""
    if not hasattr(session.config, "workerinput") and not session.config.option.collectonly:
        kernels.keep()
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if reporter and os.environ.get("ROCKING_STRICT"):
        avoidable = [reason for reason in _skips(reporter) if not any(word in reason for word in _LACKS)]
        if avoidable and session.exitstatus == pytest.ExitCode.OK:
            reporter.write_line(f"skipped, though this machine can run it: {'; '.join(avoidable)}", red=True)
            session.exitstatus = pytest.ExitCode.TESTS_FAILED


@pytest.fixture(scope="session")
def real_records() -> Path:
    """The folder of real strong-motion records, or a skip that says what to set."""
    folder = os.environ.get(_VARIABLE)
    if not folder:
        pytest.skip(f"{_VARIABLE} is not set; set it to the folder of real records to run this test")
    path = Path(folder).expanduser()
    if not (path / "manifest.tsv").is_file():
        pytest.skip(f"{_VARIABLE} is {folder!r}, but holds no manifest.tsv")
    return path.resolve()


@pytest.fixture(scope="session")
def manifest(real_records: Path) -> list[dict[str, str]]:
    """The rows of manifest.tsv as mappings of text."""
    with (real_records / "manifest.tsv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream, delimiter="\t"))


@pytest.fixture(scope="session")
def chromium() -> Iterator:
    """A headless Chromium that can reach no host, or a skip that says what to install."""
    webdriver = pytest.importorskip(
        "selenium.webdriver", reason="pages are opened by selenium, of the extra test"
    )
    binary = next(filter(None, map(shutil.which, _BROWSERS)), None)
    driver = shutil.which("chromedriver")
    if binary is None or driver is None:
        pytest.skip("Chromium and chromedriver are not installed; install them to open pages in a browser")
    options = webdriver.ChromeOptions()
    options.binary_location = binary
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1400,1600"):
        options.add_argument(argument)
    options.add_argument("--disable-dev-shm-usage")  # a small /dev/shm, as in a container, fails large pages
    options.add_argument("--host-resolver-rules=MAP * ~NOTFOUND")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    opened = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    yield opened
    opened.quit()


@pytest.fixture(scope="module")
def browser(chromium):
    """The browser, with nothing in its log that an earlier module wrote."""
    chromium.get_log("browser")
    return chromium


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Documents without figures, for a test that asks what they say: to draw takes most of its time."""
    from rocking.reports.pages import Picture

    nothing = Picture(svg='<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"/>', alt="none")
    monkeypatch.setattr("rocking.reports.summary.pictures", lambda *_: ())
    monkeypatch.setattr("rocking.reports.record.drawn_by_hand", lambda *_: nothing)
    for figure in ("bars_figure", "basis_figure"):
        monkeypatch.setattr(f"rocking.products.checks.report.{figure}", lambda *_: None)
    monkeypatch.setattr("rocking.products.checks.report.picture", lambda *_: nothing)
