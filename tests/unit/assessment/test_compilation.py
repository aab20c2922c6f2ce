"""What is said of the compilation at the first use, with a clock and processes that are made here."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from docs.site.build import FOLDER
from docs.site.measured import ROOT, figures
from rocking.assessment import compilation
from rocking.errors import RockingError
from tests import kernels


def compiled_within(seconds: float, folder: Path, monkeypatch, errors: str = "") -> list[str]:
    """The words that are said where both processes take so long; the clock begins at 100 s."""
    clock = SimpleNamespace(now=100.0)

    def sleep(_: float) -> None:
        clock.now += 0.25

    process = SimpleNamespace(
        poll=lambda: None if clock.now < 100.0 + seconds else 0,
        communicate=lambda: ("", errors),
        returncode=int(bool(errors)),
    )
    monkeypatch.setattr(compilation, "time", SimpleNamespace(monotonic=lambda: clock.now, sleep=sleep))
    monkeypatch.setattr(
        compilation, "subprocess", SimpleNamespace(Popen=lambda *_, text, **__: text and process, PIPE=None)
    )
    monkeypatch.setattr(compilation, "rock", SimpleNamespace(stats=SimpleNamespace(cache_path=str(folder))))
    said: list[tuple[str, bool]] = []
    compilation.compile_all(lambda *told: said.append(told))
    assert not said or [is_last for _, is_last in said] == [*[False] * (len(said) - 1), True]
    return [line for line, _ in said]


def test_it_is_told_after_three_seconds_and_every_second_how_long_it_has_taken(
    tmp_path: Path, monkeypatch
) -> None:
    *moving, last = compiled_within(10.0, tmp_path, monkeypatch)
    assert [line.rpartition(": ")[2] for line in moving] == [f"{second} s" for second in range(3, 10)]
    assert last == "Compiled in 10 s; it is cached for every later run."
    assert compiled_within(10.0, tmp_path, monkeypatch) == [], "it is kept"


def test_the_stamp_is_of_every_folder_with_a_kernel() -> None:
    folders = {path.relative_to(kernels.PACKAGE).parts[0] for path in kernels.sources()}
    assert folders == set(compilation.PARTS)


def test_what_is_loaded_soon_is_not_spoken_of(tmp_path: Path, monkeypatch) -> None:
    assert compiled_within(2.0, tmp_path, monkeypatch) == []


def test_what_does_not_compile_is_told_and_tried_again(tmp_path: Path, monkeypatch) -> None:
    for _ in range(2):
        with pytest.raises(RockingError, match="no room"):
            compiled_within(1.0, tmp_path, monkeypatch, errors="Traceback\n  in a file\nno room\n")


def test_how_long_it_usually_takes_is_the_figure_that_was_measured_wherever_it_is_told() -> None:
    figure = figures()["first_compilation"].value
    assert figure == compilation.USUAL
    assert f"once: {figure}." in (ROOT / "README.md").read_text(encoding="utf-8")
    assert "<!-- measured: first_compilation -->" in (FOLDER / "growth.md").read_text(encoding="utf-8")
