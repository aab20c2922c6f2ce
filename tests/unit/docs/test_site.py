"""The documentation: its examples run, it leaves nothing of the code out, and it opens without a network."""

import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from html import unescape
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import obspy
import pytest
import yaml
from obspy.core.inventory import Channel, Inventory, Network, Response, Station
from obspy.core.inventory.response import InstrumentSensitivity

import rocking
from docs.site.build import FOLDER, MARKED, write_site, written_pages
from docs.site.drawings import drawing, forms
from docs.site.pages import filled, main, python_blocks
from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES
from rocking.errors import ConfigurationError
from rocking.records.formats import FORMATS
from rocking.study.cli import _parser

ROOT = Path(rocking.__file__).parents[1]
PAGES = written_pages()
WRITTEN = [*PAGES, ROOT / "README.md", ROOT / "CONTRIBUTING.md"]


def written(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def succeeds(*command: str, folder: Path) -> str:
    """Run a command in a folder as a reader would, this Python first; return what it printed."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    surroundings = os.environ | {"MPLBACKEND": "agg", "PATH": path}
    run = subprocess.run(command, cwd=folder, env=surroundings, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """The site, as MkDocs sets it without a complaint."""
    pytest.importorskip("material", reason="the site is set with mkdocs-material, of the extra docs")
    target = tmp_path_factory.mktemp("site") / "documentation"
    write_site(target)
    return target


@pytest.fixture(scope="module")
def site(folder) -> dict[str, str]:
    return {path.name: written(path) for path in folder.glob("*.html")}


def targets(text: str) -> list[str]:
    """What a page links."""
    return [unescape(target) for target in re.findall(r'<a\b[^>]*? href="?([^" >]+)', text)]


def loaded(text: str) -> list[str]:
    """What a page needs to be shown."""
    return re.findall(r'<(?!a\b)\w[^>]*? (?:src|href)="?([^" >]+)', text)


def anchors(text: str) -> set[str]:
    """Where a page can be linked."""
    return {unescape(name) for name in re.findall(r' (?:id|name)="?([^" >]+)', text)}


@pytest.mark.slow
@pytest.mark.parametrize("path", [p for p in PAGES if python_blocks(written(p))], ids=lambda path: path.stem)
def test_the_examples_of_a_page_run(path, tmp_path):
    """In a process of their own, one after the other, warnings as errors."""
    (tmp_path / "records").symlink_to(ROOT / "records")
    script = tmp_path / "example.py"
    script.write_text("\n".join(python_blocks(written(path))), encoding="utf-8")
    ignored = "ignore:SelectableGroups dict interface:DeprecationWarning"
    succeeds(sys.executable, "-W", "error", "-W", ignored, str(script), folder=tmp_path)


@pytest.mark.slow
def test_the_page_on_fdsn_reaches_a_verdict(monkeypatch, capsys):
    """With a stored answer in the place of the service: counts, and the sensitivity that makes them m/s²."""
    (code, _) = re.findall(r"^```py\n(.*?)^```$", written(FOLDER / "fdsn.md"), re.M | re.S)
    stream, inventory, acceleration = stored_answer()

    client = SimpleNamespace(get_waveforms=lambda **_: stream, get_stations=lambda **_: inventory)
    monkeypatch.setattr("obspy.clients.fdsn.Client", lambda name: client)
    names = {}
    exec(compile(code, "fdsn.md", "exec"), names)
    assert names["records"]
    for record in names["records"]:
        assert np.allclose(record.acceleration, acceleration, atol=1 / COUNTS_PER_M_S2)
    # A cycle of a second at 0.31 g on a pier of 9 m: above uplift (0.22 g), far below what overturns it at ω/p of 5.
    assert capsys.readouterr().out.startswith("<stands: 0 of 64 members overturn")


COUNTS_PER_M_S2 = 2.0e5


def stored_answer():
    """A stream of two horizontal channels in counts, its inventory, and the acceleration that it holds, m/s²."""
    times = np.arange(0, 20, 0.01)
    acceleration = 3.0 * np.sin(2 * np.pi * times) * (times > 5) * (times < 6)
    place = {"latitude": 35.8, "longitude": -117.6, "elevation": 735}
    since = obspy.UTCDateTime("2019-07-06T03:19:40")
    sensitivity = InstrumentSensitivity(COUNTS_PER_M_S2, 1.0, input_units="M/S**2", output_units="COUNTS")
    place |= {"start_date": since - 1e6, "response": Response(instrument_sensitivity=sensitivity)}
    channels, traces = [], []
    for code, azimuth in (("HNE", 90.0), ("HNN", 0.0)):
        channels.append(Channel(code, "", **place, depth=0.0, azimuth=azimuth, dip=0.0))
        header = {"network": "CI", "station": "CLC", "channel": code, "delta": 0.01, "starttime": since}
        traces.append(obspy.Trace(np.round(acceleration * COUNTS_PER_M_S2).astype(np.int32), header))
    station = Station("CLC", 35.8, -117.6, 735.0, channels=channels)
    network = Network("CI", stations=[station])
    return obspy.Stream(traces), Inventory([network]), acceleration


@pytest.mark.slow
def test_the_readme_leads_to_the_report_of_an_own_record(tmp_path):
    """Its commands as they stand, in an empty folder with one accelerogram."""
    (block,) = re.findall(r"^```sh\n(.*?)^```$", written(ROOT / "README.md"), re.M | re.S)
    commands = "\n".join(line for line in block.splitlines() if not line.startswith("source "))
    shutil.copy(ROOT / "records" / "synthetic_strong_pulse.AT2", tmp_path / "own.AT2")
    succeeds("bash", "-e", "-c", commands, folder=tmp_path)
    assert (tmp_path / "my_study" / "results" / "own" / "report.pdf").read_bytes().startswith(b"%PDF")


def test_the_commands_of_the_pages_are_understood():
    text = MARKED.sub("", "\n".join(map(written, WRITTEN)))
    shell = "\n".join(re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)).splitlines()
    commands = [line for line in shell if line.startswith("rocking ")]
    commands += [line for line in re.findall(r"`(rocking [a-z]+ [^`\n]+)`", text) if "FILE" not in line]
    assert len(commands) > 15
    for command in commands:  # the parser ends the process where it does not understand
        assert vars(_parser().parse_args(shlex.split(command, comments=True)[1:])), command


def headings(path: Path) -> set[str]:
    """The anchors that a repository gives the headings of a page."""
    text = re.sub(r"^```.*?^```$", "", written(path), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-") for title in titles}


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_a_page_reads_in_the_repository_as_it_stands(path):
    """No hole, no mark that would end a paragraph or hide its line, and no link or picture that leads nowhere."""
    text = re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```$", "", written(path), flags=re.M | re.S))
    assert all(inside.strip() for _, _, inside in MARKED.findall(text))
    assert not re.search(r"<!-- (?!end)", MARKED.sub("", text)), "a mark without its end"
    assert not re.search(r"^\s*(?:[*-] |\d+\. )?<!-- (?!generated|end)", text, re.M), (
        "a line begins with a mark"
    )
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        file, _, anchor = link.partition("#")
        target = path.parent / file if file else path
        if not link.startswith("https://"):
            assert target.is_file(), link
            assert not anchor or anchor in headings(target), link


def test_the_pages_hold_what_the_code_says():
    assert main(["--check"]) == 0


@pytest.mark.slow
def test_the_pages_hold_what_their_examples_print_and_draw():
    assert main(["--check", "--figures"]) == 0


def test_every_test_that_a_page_names_exists():
    tests = re.findall(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", "\n".join(map(written, PAGES)))
    assert tests
    for file, function in tests:
        assert f"def {function}" in written(ROOT / file), f"{file}::{function}"


@pytest.mark.slow
def test_the_site_needs_no_network_and_its_links_lead_somewhere(site, folder):
    pages = {name: text for name, text in site.items() if name != "404.html"}
    names = {name: anchors(text) for name, text in pages.items()}
    for name, page in pages.items():  # not 404.html, whose links start at the root of a server
        for target in loaded(page):
            assert target[0] == "#" or (folder / target.split("?")[0]).is_file(), f"{name}: {target}"
        for target in targets(page):
            file, _, anchor = target.partition("#")
            if file.startswith("https://"):
                continue
            assert file in (*pages, "", "."), f"{name}: {target}"
            assert not anchor or anchor in names.get(file, names[name]), f"{name}: {target}"
    assert {path.stem for path in PAGES} <= {Path(name).stem for name in pages}
    assert site["theory.html"].count("<math") > 30, "equations are set before the page is opened"


@pytest.mark.slow
def test_the_site_leaves_nothing_of_the_code_out(site):
    for form in FORMATS:
        assert f"<td>{form.name}</td>" in unescape(site["formats.html"])
    for row_class in (*RECORD_TABLES[:-3], *SUMMARY_TABLES):
        for column in row_class.table.columns:
            assert f"<code>{column.name}</code>" in site["tables.html"]
    settings = yaml.safe_load(written(ROOT / "config" / "config.yaml"))
    for name, value in settings.items():
        names = [f"{name}.{inner}" for inner in value] if isinstance(value, dict) else [name]
        assert all(f"<code>{key}</code>" in site["settings.html"] for key in names)
    assert "Annotated" not in site["api_structures.html"], "a parameter is printed with its plain type"
    described = set().union(*map(anchors, site.values()))
    assert {f"{getattr(rocking, name).__module__}.{name}" for name in rocking.__all__} <= described


@pytest.mark.slow
@pytest.mark.parametrize(("name", "kind", "form"), list(forms()))
def test_a_drawing_shows_the_letter_of_every_size(name, kind, form):
    """Every length and angle that the form requires; those of several floors are numbered."""
    texts = {text.get_text().strip() for text in drawing(kind, form).axes[0].texts} - {""}
    for field in form.keys.values():
        letter = field.value.letter
        if field.required and letter and field.unit in ("m", "°"):
            assert any(text.rstrip("₀₁₂₃₄₅₆₇₈₉") in (letter, letter[0]) for text in texts), field.meaning


def test_an_unknown_generated_part_is_refused():
    with pytest.raises(ConfigurationError, match=r"^strange.md: .*'nonsense'"):
        filled("<!-- generated: nonsense --><!-- end -->\n", "strange.md")


@pytest.mark.slow
@pytest.mark.parametrize(("word", "page"), [("Oppenheim", "theory.html"), ("batch", "api")])
def test_a_word_is_found_in_a_site_opened_from_a_file(browser, folder, word, page):
    browser.get(f"{(folder / 'index.html').as_uri()}?q={word}")
    until = time.monotonic() + 100
    targets: list[str] = []
    while not any(page in target for target in targets) and time.monotonic() < until:
        results = browser.find_elements("class name", "md-search-result__link")
        targets = [item.get_attribute("href") for item in results]
        time.sleep(0.1)
    assert any(page in target for target in targets)
    assert [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
