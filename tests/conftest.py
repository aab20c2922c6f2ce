"""Fixtures and oracles that every test may use."""

import csv
import os
import random
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

_VARIABLE = "ROCKING_RECORDS"
_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")

# By default an example must end within 0.2 s of the clock.
settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")

ON_DEMAND = Path(__file__).parent / "research"
"""The tests of docs/research, each marked slow: `make test-all` runs them."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark every test of research as slow, before the slow ones are left out.

    ROCKING_ORDER, a number, draws the order of the files and of the tests in each: none may lean on another.
    """
    for item in items:
        if item.path.is_relative_to(ON_DEMAND):
            item.add_marker(pytest.mark.slow)
    if seed := os.environ.get("ROCKING_ORDER"):
        draw = random.Random(seed)
        files = {item.path: draw.random() for item in items}
        items.sort(key=lambda item: (files[item.path], draw.random()))


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
