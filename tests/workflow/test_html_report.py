"""snakemake --report: one page that a browser opens without a network, with every result under its category."""

import base64
import csv
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote

import pytest
import yaml

import rocking
from rocking.assessment.rows import SUMMARY_TABLES
from rocking.study.cli import main

ROOT = Path(rocking.__file__).parents[1]
CATEGORIES = {
    "Study": {"page to explore the study", "prediction against integration", "report on all records"},
    "Records": {"synthetic_strong_pulse"},
    "Tables": {table.file_name for table in (row_class.table for row_class in SUMMARY_TABLES)},
}
"""What must stand under each category, by the first label of each result."""
PATIENCE = 20
"""s; a loaded machine, not the page, is what takes so long."""
ATTEMPTS = 4

pytestmark = pytest.mark.slow


STRUCTURES = ".. raw:: html .. <script>kilroy_was_here<_script>.yaml"
TITLE = "</script><script>document.title = 'kilroy_was_here'</script>"
"""Texts of a study that came from somebody else."""


@pytest.fixture(scope="module")
def study(tmp_path_factory) -> Path:
    """A study of one record and one structure that was run, with its page in report.html."""
    folder = tmp_path_factory.mktemp("html") / "my study"
    assert main(["start", str(folder)]) == 0
    pier = "- {name: pier, type: block, breadth_m: 2.0, height_m: 9.0}\n"
    (folder / "structures.yaml").unlink()
    (folder / STRUCTURES).write_text(pier, encoding="utf-8")
    settings = {"study": TITLE, "client": TITLE, "structures": STRUCTURES}
    (folder / "config.yaml").write_text(yaml.safe_dump(settings), encoding="utf-8")
    shutil.copy(ROOT / "records" / "synthetic_strong_pulse.AT2", folder / "records")
    assert main(["catalogue", str(folder / "records")]) == 0
    run = [sys.executable, "-m", "rocking.study.cli", "run", str(folder), "--"]  # where libraries may warn
    subprocess.run([*run, "--cores", "1", "--quiet"], check=True)
    assert (folder / "results" / "synthetic_strong_pulse" / "report.pdf").read_bytes().startswith(b"%PDF")
    subprocess.run([*run, "--report", "report.html"], check=True)
    return folder


@pytest.fixture
def page(study, browser) -> Callable:
    """The page, freshly opened; call it with an XPath to wait for what stands there."""
    from selenium.webdriver.support.ui import WebDriverWait

    browser.get((study / "report.html").as_uri())
    return lambda path: WebDriverWait(browser, PATIENCE).until(lambda at: at.find_elements("xpath", path))


def opened(page: Callable, browser, *path: str) -> list:
    """What the last of `path` names after a click on each menu entry and button before it, in turn.

    A click that meets the page while it is drawn anew is lost, so all of it is tried again from a fresh page.
    """
    from selenium.common.exceptions import StaleElementReferenceException, TimeoutException

    for _ in range(ATTEMPTS):
        try:
            for step in path[:-1]:
                page(step)[0].click()
            return page(path[-1])
        except (StaleElementReferenceException, TimeoutException):
            browser.refresh()
    pytest.fail(f"{path[-1]} is not shown after {ATTEMPTS} attempts")


def entry(name: str) -> str:
    """The XPath of an entry of the menu."""
    return f"//a[normalize-space()='{name}']"


def button(label: str, number: int) -> str:
    """The XPath of the eye (1) or the information (2) of the result with that label."""
    return f"//tr[td[normalize-space()='{label}']]/descendant::a[@type='button'][{number}]"


def test_the_page_to_explore_is_what_is_seen_first(page, browser):
    (frame,) = page("//iframe")
    browser.switch_to.frame(frame)
    try:
        assert page("//*[@id='matrix']//button[@data-record]")
    finally:
        browser.switch_to.default_content()


@pytest.mark.parametrize("category", CATEGORIES)
def test_every_result_stands_in_its_category(page, category):
    page(entry(category))[0].click()
    for label in CATEGORIES[category]:
        assert page(f"//tr/td[1][normalize-space()='{label}']")
    assert len(page("//tr/td[1]")) == len(CATEGORIES[category])


def test_a_table_in_the_page_is_the_file(page, browser, study):
    """The page offers the table as a download that carries its bytes."""
    link = opened(page, browser, entry("Tables"), button("comparison.csv", 1))[0].get_attribute("href")
    assert link.startswith("data:text/csv")
    content = base64.b64decode(unquote(link.partition("base64,")[2]))
    assert content == (study / "results" / "summary" / "comparison.csv").read_bytes()
    assert [row["structure"] for row in csv.DictReader(content.decode().splitlines())] == ["pier"]


def test_the_page_to_explore_says_where_motions_and_reports_of_records_are(page, browser):
    """It stands within the page without the folders of the records, of which each has its motions and its report."""
    (frame,) = page("//iframe")
    browser.switch_to.frame(frame)
    try:
        (facts,) = page(
            "//*[@id='facts'][contains(., 'open summary/study.html in the folder of the results')]"
        )
        assert not facts.find_elements("css selector", "a")
    finally:
        browser.switch_to.default_content()


def test_no_text_of_a_study_is_markup_or_a_script_of_a_page(study):
    """Neither its title nor the name of its structure list; the page to explore stands within the page as base64."""
    page = (study / "report.html").read_text(encoding="utf-8")
    assert "kilroy_was_here" not in page and ".. raw" not in page
    explore = (study / "results" / "summary" / "study.html").read_text(encoding="utf-8")
    assert "kilroy_was_here" in explore and TITLE not in explore, "the title is shown, as text"


def test_the_browser_had_nothing_to_complain_about(page, browser):
    page("//iframe")
    assert [said for said in browser.get_log("browser") if said["level"] == "SEVERE"] == []
