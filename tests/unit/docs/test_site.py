"""The documentation: its examples run, it leaves nothing of the code out, and it opens without a network."""

import math
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from html import unescape
from html.parser import HTMLParser
from pathlib import Path

import pytest
import yaml

import rocking
from docs.site import filled, python_blocks, write_site, written_pages
from docs.site.drawings import drawing, forms
from docs.site.generated import table
from docs.site.pages import FOLDER
from rocking.assessment.rows.of_folder import RECORD_TABLES
from rocking.assessment.rows.of_study import SUMMARY_TABLES, SpectrumRow
from rocking.errors import ConfigurationError
from rocking.records.formats import FORMATS
from rocking.structures import load_structures
from rocking.study.cli import _parser
from tests.workflow.conftest import new_study

ROOT = Path(rocking.__file__).parents[1]
WORKFLOW = ROOT / "workflow"
PAGES = written_pages()
WRITTEN = [*PAGES, ROOT / "README.md", ROOT / "CONTRIBUTING.md"]


def written(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """The site, as the target of the workflow has MkDocs set it without a complaint."""
    pytest.importorskip("material", reason="the site is set with mkdocs-material, of the extra docs")
    study = new_study(tmp_path_factory.mktemp("site") / "study", ROOT)
    study.add_synthetic("one", 1)
    done = study.run("documentation")
    assert done.returncode == 0, done.stdout
    return study.results / "documentation"


@pytest.fixture(scope="module")
def site(folder) -> dict[str, str]:
    return {path.name: written(path) for path in folder.glob("*.html")}


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.loaded: list[str] = []
        self.anchors: list[str] = []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.targets += [given["href"]] if tag == "a" and given.get("href") else []
        self.loaded += [given[name] for name in ("src", "href") if tag != "a" and given.get(name)]
        self.anchors += [given[name] for name in ("id", "name") if given.get(name)]


def links(text: str) -> _Links:
    parser = _Links()
    parser.feed(text)
    return parser


@pytest.mark.parametrize("path", [p for p in PAGES if python_blocks(written(p))], ids=lambda path: path.stem)
def test_the_examples_of_a_page_run(path, tmp_path):
    """In a process of their own, as a reader would run them: one after the other, warnings as errors."""
    script = tmp_path / "example.py"
    script.write_text("\n".join(python_blocks(written(path))), encoding="utf-8")
    ignored = "ignore:SelectableGroups dict interface:DeprecationWarning"
    command = [sys.executable, "-W", "error", "-W", ignored, str(script)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_example_of_the_readme_runs():
    """Where a reader would run it: at the top of the repository."""
    (code,) = python_blocks(written(ROOT / "README.md"))
    environment = os.environ | {"MPLBACKEND": "agg"}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "members" in done.stdout


@pytest.mark.slow
def test_the_readme_leads_to_the_report_of_an_own_record(tmp_path):
    """Its commands as they stand, in an empty folder with one accelerogram."""
    (block,) = re.findall(r"^```sh\n(.*?)^```$", written(ROOT / "README.md"), re.M | re.S)
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
        predicted = rocking.predict_maximum(mechanism.equivalent_block(), pulse).rotation_ratio
        return predicted, rocking.integrate(mechanism, record).rotation_ratio

    for name in ("arch 15 m", "spire"):
        predicted, integrated = ratios(name)
        assert 0.9 < predicted / integrated < 1.1
    predicted, integrated = ratios("stone pier")
    assert predicted == math.inf and 0 < integrated < 1


def test_pages_have_examples():
    assert sum(len(python_blocks(written(path))) for path in PAGES) >= 8


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_the_commands_of_a_page_are_understood(path):
    text = written(path)
    shell = "\n".join(re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)).splitlines()
    commands = [line for line in shell if line.startswith("rocking ")]
    commands += [line for line in re.findall(r"`(rocking [a-z]+ [^`]+)`", text) if "FILE" not in line]
    for command in commands:
        _parser().parse_args(shlex.split(command, comments=True)[1:])


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_every_file_that_a_page_links_exists(path):
    for target in re.findall(r"\]\(([^)#]+)", written(path)):
        assert target.startswith(("https://", "figures/")) or (path.parent / target).is_file(), target


def test_every_test_that_a_page_names_exists():
    text = "\n".join(map(written, PAGES))
    named = re.findall(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", text)
    assert len(named) >= 8
    for file, function in named:
        assert f"def {function}" in written(ROOT / file), f"{file}::{function}"


def test_every_page_has_its_place_in_the_navigation():
    configuration = written(FOLDER.parent / "mkdocs.yml")
    assert {path.name for path in PAGES} == set(re.findall(r": (\w+\.md)$", configuration, re.M))


def test_the_site_needs_no_network_and_its_links_lead_somewhere(site, folder):
    parsed = {name: links(text) for name, text in site.items() if name != "404.html"}
    for name, found in parsed.items():  # not 404.html, whose links start at the root of a server
        assert all(
            (folder / target.split("?")[0]).is_file() for target in found.loaded if target[0] != "#"
        ), name
        for target in found.targets:
            file, _, anchor = target.partition("#")
            if file.startswith("https://"):
                continue
            assert file in (*parsed, "", "."), f"{name}: {target}"
            assert not anchor or anchor in parsed.get(file, found).anchors, f"{name}: {target}"


def test_equations_are_set_before_the_page_is_opened(site):
    text = site["theory.html"]
    assert text.count("<math") > 30 and "arithmatex" not in text and "$" not in text
    assert re.search(
        r"<mfrac><mrow><mn>3</mn><mi>g</mi></mrow><mrow><mn>4</mn><mi>R</mi></mrow></mfrac>", text
    )


def test_the_site_leaves_nothing_of_the_code_out(site):
    assert "generated:" not in "".join(site.values())
    for form in FORMATS:
        assert f"<td>{form.name}</td>" in unescape(site["formats.html"])
    for each in (*RECORD_TABLES, *SUMMARY_TABLES, SpectrumRow):
        for column in each.table.columns:
            assert f"<code>{column.name}</code>" in site["tables.html"]
    settings = yaml.safe_load(written(WORKFLOW / "config.yaml"))
    for name, value in settings.items():
        names = [f"{name}.{inner}" for inner in value] if isinstance(value, dict) else [name]
        assert all(f"<code>{known}</code>" in site["settings.html"] for known in names)
    anchors = links(site["api.html"]).anchors
    for name in rocking.__all__:
        value = getattr(rocking, name)
        assert f"{value.__module__}.{name}" in anchors


@pytest.mark.parametrize(("name", "kind", "form"), list(forms()))
def test_a_drawing_shows_the_letter_of_every_size(name, kind, form):
    """Every length and angle that the form requires; those of several floors are numbered."""
    texts = {text.get_text().strip() for text in drawing(kind, form).axes[0].texts} - {""}
    for field in form.fields:
        if field.required and field.letter and field.unit in ("m", "°"):
            assert any(text.rstrip("₀₁₂₃₄₅₆₇₈₉") in (field.letter, field.letter[0]) for text in texts), (
                field.key
            )


def test_every_figure_of_the_pages_is_made(folder):
    named = {
        f"{path.stem}_{name}.svg"
        for path in PAGES
        for name in re.findall(r"^<!-- figure: (\w+)\.", written(path), re.M)
    }
    made = {path.name for path in (folder / "figures").iterdir()}
    paper = {f"paper_figure_{number}.svg" for number in (3, 4, 6, 7)}
    assert len(named) >= 8 and made == named | paper | {f"{name}.svg" for name, *_ in forms()}


def test_the_table_of_equations_is_that_of_the_code(site):
    from docs.paper.equations import equation_rows

    cells = re.findall(r"<td>(.*?)</td>", site["equations.html"])
    for row in equation_rows():
        assert row.quantity in [unescape(cell) for cell in cells]
        assert f"{row.corrected_number:.5g}".replace("inf", "overturns") in cells


def test_an_unknown_generated_part_is_refused():
    with pytest.raises(ConfigurationError, match=r"^strange.md: .*'nonsense'"):
        filled("<!-- generated: nonsense -->\n", "strange.md", WORKFLOW)


def test_a_missing_package_is_said_in_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "latex2mathml", None)
    with pytest.raises(ConfigurationError, match="make documentation"):
        write_site(tmp_path, WORKFLOW)
    assert not list(tmp_path.iterdir())


def test_a_bar_in_a_cell_does_not_split_it():
    assert table(("a",), [("float | None",)]).splitlines()[2] == "| float &#124; None |"


@pytest.mark.slow
def test_a_word_is_found_in_a_site_opened_from_a_file(browser, folder):
    browser.get(f"{(folder / 'index.html').as_uri()}?q=Oppenheim")
    until = time.monotonic() + 100
    found: list[str] = []
    while not found and time.monotonic() < until:
        found = [
            item.get_attribute("href")
            for item in browser.find_elements("class name", "md-search-result__link")
        ]
        time.sleep(0.1)
    assert any("theory.html" in target for target in found)
    assert [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
