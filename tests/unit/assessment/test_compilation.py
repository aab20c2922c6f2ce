"""What is said of the compilation at the first use, with a clock and processes that are made here."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from docs.site.build import FOLDER
from docs.site.measured import ROOT, figures
from rocking.assessment import compilation
from rocking.errors import RockingError
from tests import kernels


def compiled_within(seconds: float, folder: Path, monkeypatch, errors: str = "") -> None:
    """Compile where both processes take so long together; the clock begins at 100 s."""
    clock = SimpleNamespace(now=100.0)

    def communicate() -> tuple[str, str]:
        clock.now += seconds / 2
        return "", errors

    process = SimpleNamespace(communicate=communicate, returncode=int(bool(errors)))
    monkeypatch.setattr(compilation, "time", SimpleNamespace(monotonic=lambda: clock.now))
    monkeypatch.setattr(
        compilation, "subprocess", SimpleNamespace(Popen=lambda *_, text, **__: text and process, PIPE=None)
    )
    monkeypatch.setattr(compilation, "rock", SimpleNamespace(stats=SimpleNamespace(cache_path=str(folder))))
    compilation.compile_all()


def test_it_is_told_from_three_seconds_on_how_long_it_took(tmp_path: Path, monkeypatch, capsys) -> None:
    compiled_within(10.0, tmp_path, monkeypatch)
    assert capsys.readouterr().out == "Compiled in 10 s; it is cached for every later run.\n"
    compiled_within(10.0, tmp_path, monkeypatch)
    compiled_within(2.0, tmp_path / "soon", monkeypatch)
    assert capsys.readouterr().out == "", "it is kept, or loaded soon"


def test_the_stamp_is_of_every_folder_with_a_kernel() -> None:
    folders = {path.relative_to(kernels.PACKAGE).parts[0] for path in kernels.sources()}
    assert folders == set(compilation.PARTS)


def test_what_does_not_compile_is_told_and_tried_again(tmp_path: Path, monkeypatch) -> None:
    for _ in range(2):
        with pytest.raises(RockingError, match="no room"):
            compiled_within(1.0, tmp_path, monkeypatch, errors="Traceback\n  in a file\nno room\n")


def test_how_long_it_usually_takes_is_the_figure_that_was_measured_wherever_it_is_told() -> None:
    figure = figures()["first_compilation"].value
    assert f"once: {figure}." in (ROOT / "README.md").read_text(encoding="utf-8")
    assert "<!-- measured: first_compilation -->" in (FOLDER / "growth.md").read_text(encoding="utf-8")
