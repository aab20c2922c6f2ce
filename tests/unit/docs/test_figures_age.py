"""Figures that know their age: what changes their code, and what a page, a list and a release say of it."""

import re
import subprocess
from dataclasses import replace

import pytest

from docs.research.run import targets
from docs.research.scores import Score
from docs.site import kept
from docs.site import measured as module
from docs.site.build import written_pages
from docs.site.measured import FIGURES, ROOT, code_of, figures, main, records_sha256
from docs.site.pages import filled
from rocking.errors import ConfigurationError
from rocking.reports.printing import MEASURED


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """A repository of two files, one of which imports the other; what stages all of it and returns the commit."""

    def git(*arguments: str) -> str:
        who = ("-c", "user.name=one", "-c", "user.email=one@example.org")
        return subprocess.check_output(("git", *who, *arguments), cwd=tmp_path, text=True).strip()

    def committed() -> str:
        git("add", ".")
        git("commit", "-qm", "one")
        return git("rev-parse", "HEAD")

    monkeypatch.setattr(module, "ROOT", tmp_path)
    git("init", "-q")
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "measures.py").write_text("from docs.numbers import NUMBER\n", encoding="utf-8")
    (tmp_path / "docs" / "numbers.py").write_text("NUMBER = 1\n", encoding="utf-8")
    for kept_answers in (code_of, module._differing):
        kept_answers.cache_clear()
    yield tmp_path, committed
    for kept_answers in (code_of, module._differing):
        kept_answers.cache_clear()


@pytest.mark.process
@pytest.mark.parametrize(("changed", "older"), [("NUMBER = 2\n", True), (None, False)])
def test_a_figure_is_older_where_what_its_code_imports_has_changed(
    repository, monkeypatch, capsys, changed, older
):
    folder, committed = repository
    before = committed()
    if changed is not None:
        (folder / "docs" / "numbers.py").write_text(changed, encoding="utf-8")
    after = committed() if changed is not None else before
    name, known = next(iter(figures().items()))
    figure = replace(known, commit=before, read="", files="docs/measures.py", records_sha256="")
    assert {path.name for path in code_of(figure.files)} == {"measures.py", "numbers.py"}
    assert figure.is_older is older
    assert not replace(figure, read=after).is_older, "somebody has read that it changes nothing"
    for first in ("", "yes"):
        told = replace(figure, first_screen=first)
        monkeypatch.setattr(module, "figures", lambda told=told: {name: told})
        assert main(["--first-screen"]) == int(older and first == "yes")
        assert (f"{name}: measured at" in capsys.readouterr().out) is older


def test_what_was_measured_again_has_its_commit_and_what_was_read_has_its_own(monkeypatch, tmp_path):
    path = tmp_path / "figures.csv"
    path.write_bytes(FIGURES.read_bytes())
    monkeypatch.setattr(module, "FIGURES", path)
    monkeypatch.setattr(module, "figures", lambda: figures(path))
    monkeypatch.setattr(module.Figure, "is_older", False)
    first, second = list(figures(path))[:2]
    main(["--read", first, second, "--commit", "1a2b3c4d"])
    main(["--renew", second, "--commit", "5e6f7a8b"])
    told = figures(path)
    assert (told[first].read, told[second].read, told[second].commit) == ("1a2b3c4d", "", "5e6f7a8b")
    assert told[first].commit == figures(FIGURES)[first].commit
    assert "code read at 1a2b3c4d" in told[first].origin


def test_every_page_prints_figures_that_there_are_and_every_figure_names_files_that_there_are():
    known = figures()
    for page in written_pages():
        for name in re.findall(r"<!-- measured(?: by)?: (\S+) -->", page.read_text(encoding="utf-8")):
            assert name in known, f"{page.name}: {name}"
    for figure in known.values():
        assert all((ROOT / file).is_file() for file in figure.files.split()), figure.name
        assert figure.script and figure.commit


def test_every_target_of_the_research_on_a_page_and_every_figure_of_a_report_has_a_row():
    known = figures()
    scripts = {figure.script[figure.script.find("snakemake") :] for figure in known.values()}
    for page in written_pages():
        for name in re.findall(r"`snakemake (\w+)`", page.read_text(encoding="utf-8")):
            assert name not in {*targets(), "validate"} or f"snakemake {name}" in scripts, (
                f"{page.name}: {name}"
            )
    for name, figure in MEASURED.items():
        assert not figure.source.startswith("docs/research") or name in known, name
        if name in known:
            row = known[name]
            numbers = re.findall(r"\d+", f"{row.value} {row.interval} {row.sites}")
            assert set(numbers) <= set(re.findall(r"\d+", figure.figure)), name
            assert figure.commit == row.commit and f"measured at {row.commit}" in figure.words


def test_a_page_prints_a_figure_within_its_line():
    name, figure = next(iter(figures().items()))
    for mark, words in (("measured", figure.words), ("measured by", figure.origin)):
        page = f"It is <!-- {mark}: {name} -->old<!-- end -->."
        assert filled(page, "page") == page.replace("old", words)
    assert figure.script in figure.origin and figure.commit in figure.origin
    with pytest.raises(ConfigurationError, match="measured figure is 'nothing'"):
        filled("<!-- measured: nothing --><!-- end -->", "page")


def test_a_page_prints_a_score_as_the_target_left_it(monkeypatch, tmp_path):
    """Each form by a row that is known; what names no row, or no form, is refused with what there is."""
    rows = "s,none,m,0.0,0.0,0.031,20,18,95\ns,some,m,0.0288,0.0144,0.0464,50,20,278\ns,ratio,m,0.971,0.9,1.02,9,8,7\n"
    (tmp_path / "made.csv").write_text(",".join(Score.table.column_names) + "\n" + rows, encoding="utf-8")
    monkeypatch.setattr(kept, "SCORES", tmp_path)
    kept.scores_of.cache_clear()
    for form, part, found in (
        ("n%", "none", "0 of 95, below 3.1 %"),
        ("n%", "some", "8 of 278, 2.9 % (1.4–4.6)"),
        ("%", "some", "3 % (1–5)"),
        (".2", "ratio", "0.97 (0.90–1.02)"),
        ("sites", "none", "20 sites of 18 earthquakes; 95 cases"),
    ):
        mark = f"<!-- score {form}: made; s; {part}; m -->"
        assert filled(f"{mark}<!-- end -->!", "page") == f"{mark}{found}<!-- end -->!"
    for form, content in (
        ("%", "made; s; none; other"),
        ("?", "made; s; none; m"),
        ("%", "other; s; none; m"),
    ):
        with pytest.raises(ConfigurationError, match=r"must be one|must have one"):
            filled(f"<!-- score {form}: {content} --><!-- end -->", "page")
    kept.scores_of.cache_clear()


def test_every_score_on_a_page_is_kept_and_its_target_has_a_figure_that_says_when():
    scripts = {figure.script.rpartition("snakemake ")[2] for figure in figures().values()}
    for page in written_pages():
        for form, content in re.findall(r"<!-- score (\S+): (.*?) -->", page.read_text(encoding="utf-8")):
            assert kept.printed_score(form, content), page.name
            assert content.partition(";")[0] in scripts, f"{page.name}: {content}"


def test_a_figure_is_older_where_its_list_of_records_has_changed():
    figure = replace(next(iter(figures().values())), records_sha256=records_sha256("near_fault"), files="")
    assert not figure.is_older and replace(figure, records_sha256="0" * 16).is_older
