"""A seal holds while every file is as it was written and what it was made from is the same."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from rocking.study.results import part
from rocking.study.seal import SEAL, TRADE_SEAL, beside, remove_broken_seals, write_seal
from rocking.study.settings import Settings


@pytest.fixture
def plan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """One job with a report, and a summary, both sealed."""
    monkeypatch.chdir(tmp_path)
    results = Path("results")
    files = [results / "a" / "report.pdf", results / "a" / "pulses.csv", part(results, "one") / "record.csv"]
    for file in (*files, part(results, "one") / "timings.csv", results / "summary" / "record.csv"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"content of {file}\n")
    outputs = [str(files[0]), str(files[2]), str(part(results, "one") / "timings.csv")]
    assert set(beside(outputs)) == {*map(Path, outputs), files[1]}
    write_seal(part(results, "one") / SEAL, "origin", beside(outputs), results)
    write_seal(results / "summary" / SEAL, "all", [results / "summary" / "record.csv"], results)
    settings = Settings(results="results")
    return SimpleNamespace(
        settings=settings,
        jobs={"one": ("a",)},
        made_from=lambda job: "origin",
        summary_made_from="all",
        fragility_made_from="scaled",
        trade_made_from="timed",
    )


@pytest.mark.parametrize(
    ("file", "seal", "origin", "target"),
    [
        ("fragility/fragility_summary.csv", f"fragility/{SEAL}", "scaled", "fragility"),
        ("summary/trade.csv", f"summary/{TRADE_SEAL}", "timed", "trade"),
    ],
)
def test_what_was_measured_once_and_is_edited_loses_its_seal_and_says_what_makes_it_again(
    plan: SimpleNamespace, file: str, seal: str, origin: str, target: str
) -> None:
    table, path = Path("results", file), Path("results", seal)
    table.parent.mkdir(exist_ok=True)
    table.write_text("median\n")
    write_seal(path, origin, [table], Path("results"))
    assert list(remove_broken_seals(plan)) == []
    table.write_text("edited\n")
    (told,) = remove_broken_seals(plan)
    assert told == f"{table} is not as it was written; snakemake {target} makes it again."
    assert not path.exists() and Path("results", "summary", SEAL).exists()


def test_a_seal_holds_while_nothing_changes_but_the_times(plan: SimpleNamespace) -> None:
    Path("results/summary/jobs/one/timings.csv").write_text("other times\n")
    Path("results/a/report.pdf").touch()
    assert list(remove_broken_seals(plan)) == []


@pytest.mark.parametrize("file", ["a/report.pdf", "a/pulses.csv", "summary/jobs/one/record.csv"])
@pytest.mark.parametrize("content", [b"", b"cut", b"CONTENT"])
def test_a_changed_file_breaks_the_seal_of_its_job_only(
    plan: SimpleNamespace, file: str, content: bytes
) -> None:
    path = Path("results", file)
    path.write_bytes(content + path.read_bytes()[len(content) :] if content == b"CONTENT" else content)
    (told,) = remove_broken_seals(plan)
    assert told == f"{path} is not as it was written; it is made again."
    assert not Path("results/summary/jobs/one", SEAL).exists() and Path("results/summary", SEAL).exists()
    assert list(remove_broken_seals(plan)) == []


def test_a_lost_file_and_another_origin_break_it_too(plan: SimpleNamespace) -> None:
    Path("results/summary/record.csv").unlink()
    plan.made_from = lambda job: "another"
    told = list(remove_broken_seals(plan))
    assert [each.split(" ", 1)[0] for each in told] == [
        "results/summary/jobs/one",
        "results/summary/record.csv",
    ]


@pytest.mark.parametrize(
    "junk", [b"", b"[]", b"{", b"\xff", b"[" * 100_000, b'{"files": {"a": 1}}', b'{"files": 3}']
)
def test_junk_in_place_of_a_seal_breaks_it(plan: SimpleNamespace, junk: bytes) -> None:
    Path("results/summary", SEAL).write_bytes(junk)
    (told,) = remove_broken_seals(plan)
    assert told == "results/summary/seal.json cannot be read; it is made again."
