"""The documentation: its examples run, it leaves nothing of the code out, and it opens without a network."""

import math
import os
import re
import shlex
import shutil
import subprocess
import sys
from html import unescape
from html.parser import HTMLParser
from pathlib import Path

import pytest
import yaml

import rocking
from docs.site import PAGES, Page, pages, python_blocks, read_page, write_site
from docs.site.signatures import MODULES
from rocking.assessment import columns
from rocking.errors import ConfigurationError
from rocking.records.formats import FORMATS
from rocking.structures import load_structures
from rocking.study.cli import _parser

ROOT = Path(rocking.__file__).parents[1]
WORKFLOW = ROOT / "workflow"
WRITTEN = [*(page.path for page in PAGES), ROOT / "README.md"]


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> dict[str, str]:
    pytest.importorskip("markdown", reason="the site is set with markdown, of the extra docs")
    files = write_site(tmp_path_factory.mktemp("site"), WORKFLOW)
    return {path.name: path.read_text(encoding="utf-8") for path in files}


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.anchors: list[str] = []
        self.tags: list[str] = []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.tags.append(tag)
        self.targets += [given[name] for name in ("href", "src") if name in given]
        self.anchors += [given["id"]] if "id" in given else []


def links(text: str) -> _Links:
    parser = _Links()
    parser.feed(text)
    return parser


@pytest.mark.parametrize("page", [page for page in PAGES if python_blocks(page)], ids=lambda page: page.name)
def test_the_examples_of_a_page_run(page, tmp_path):
    """In a process of their own, as a reader would run them: one after the other, warnings as errors."""
    script = tmp_path / "example.py"
    script.write_text("\n".join(python_blocks(page)), encoding="utf-8")
    ignored = "ignore:SelectableGroups dict interface:DeprecationWarning"
    command = [sys.executable, "-W", "error", "-W", ignored, str(script)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_the_readme_leads_to_the_report_of_an_own_record(tmp_path):
    """Its commands as they stand, in an empty folder with one accelerogram."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```sh\n(.*?)^```$", readme, re.M | re.S)
    commands = "\n".join(line for line in block.splitlines() if not line.startswith("source "))
    shutil.copy(ROOT / "records" / "synthetic_strong_pulse.AT2", tmp_path / "own.AT2")
    environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    done = subprocess.run(
        ["bash", "-e", "-c", commands],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "my_study" / "results" / "own" / "report.pdf").read_bytes().startswith(b"%PDF")


def test_the_figure_of_the_readme_shows_what_its_caption_says():
    """Within 10 % for arch and spire; the pier falls under the pulse and not under the record."""
    assert (WORKFLOW / "report" / "example.png").stat().st_size < 150_000
    (record,) = rocking.read(ROOT / "records" / "synthetic_strong_pulse.AT2")
    pulse = rocking.extract_pulses(record).dominant
    structures = load_structures(WORKFLOW / "structures.yaml")

    def ratios(name):
        mechanism = structures[name].mechanism()
        predicted = rocking.predict_maximum(mechanism.equivalent_block("uplift"), pulse).rotation_ratio
        return predicted, rocking.integrate(mechanism, record).rotation_ratio

    for name in ("arch 15 m", "spire"):
        predicted, integrated = ratios(name)
        assert 0.9 < predicted / integrated < 1.1
    predicted, integrated = ratios("stone pier")
    assert predicted == math.inf and 0 < integrated < 1


def test_pages_have_examples():
    assert sum(len(python_blocks(page)) for page in PAGES) >= 8


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_the_commands_of_a_page_are_understood(path):
    text = path.read_text(encoding="utf-8")
    shell = "\n".join(re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)).splitlines()
    commands = [line for line in shell if line.startswith("rocking ")]
    commands += [line for line in re.findall(r"`(rocking [a-z]+ [^`]+)`", text) if "FILE" not in line]
    for command in commands:
        _parser().parse_args(shlex.split(command, comments=True)[1:])


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_every_file_that_a_page_links_exists(path):
    text = path.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)", text):
        assert (path.parent / target).is_file(), target


def test_every_test_that_the_theory_names_exists():
    named = re.findall(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", (PAGES[2].path).read_text(encoding="utf-8"))
    assert len(named) >= 8
    for file, function in named:
        assert f"def {function}" in (ROOT / file).read_text(encoding="utf-8"), f"{file}::{function}"


def test_the_site_needs_no_network_and_its_links_lead_somewhere(site):
    for name, text in site.items():
        found = links(text)
        assert not {"script", "img", "iframe", "link"} & set(found.tags), name
        assert "@import" not in text and "url(" not in text
        for target in found.targets:
            file, _, anchor = target.partition("#")
            assert file in site, f"{name}: {target}"
            assert not anchor or anchor in links(site[file]).anchors, f"{name}: {target}"


def test_the_site_leaves_nothing_of_the_code_out(site):
    assert "generated:" not in "".join(site.values())
    for form in FORMATS:
        assert f"<td>{form.name}</td>" in unescape(site["formats.html"])
    for table in (*columns.RECORD_TABLES, *columns.SUMMARY_TABLES, columns.SPECTRUM):
        for column in table.columns:
            assert f"<code>{column.name}</code>" in site["tables.html"]
    settings = yaml.safe_load((WORKFLOW / "config.yaml").read_text(encoding="utf-8"))
    for name, value in settings.items():
        names = [f"{name}.{inner}" for inner in value] if isinstance(value, dict) else [name]
        assert all(f"<code>{known}</code>" in site["settings.html"] for known in names)
    for module in MODULES:
        for name in sys.modules[module].__all__:
            assert f">{name}</h3>" in site["api.html"], f"{module}.{name}"


def test_the_table_of_equations_is_that_of_the_code(site):
    from docs.paper.equations import equation_rows

    cells = re.findall(r"<td>(.*?)</td>", site["theory.html"])
    for row in equation_rows():
        assert row["quantity"] in [unescape(cell) for cell in cells]
        assert f"{row['corrected_number']:.5g}".replace("inf", "overturns") in cells


def test_an_unknown_generated_part_is_refused(tmp_path, monkeypatch):
    page = Page("strange", "Strange")
    monkeypatch.setattr(Page, "path", tmp_path / "strange.md")
    page.path.write_text("<!-- generated: nonsense -->\n", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="'nonsense'"):
        pages.read_page(page, WORKFLOW)


def test_a_missing_package_is_said_in_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "markdown", None)
    with pytest.raises(ConfigurationError, match="extra docs"):
        write_site(tmp_path, WORKFLOW)
    assert not list(tmp_path.iterdir())


def test_a_bar_in_a_cell_does_not_split_it():
    from docs.site.generated import table

    assert table(("a",), [("float | None",)]).splitlines()[2] == "| float &#124; None |"


def test_read_page_fills_what_is_generated():
    assert "| PEER AT2 |" in read_page(PAGES[4], WORKFLOW)
