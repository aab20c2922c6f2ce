"""The rocking command: every verb does its work, and refuses bad input in one sentence without leaving a trace.

Refused is also what a study folder may not bring, and a config.yaml that would hang or be read in silence.
"""

import csv
import io
import math
import os
import shutil
import sys
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest
import yaml

import rocking
from rocking.assessment.scene import load_scenes, placed
from rocking.errors import ConfigurationError
from rocking.signal.kinds import SignalKind
from rocking.study.cli import main
from rocking.study.plan import check_config_file, make_plan
from rocking.study.products import FRAGILITY
from rocking.study.settings import Settings, read_settings
from rocking.tables.yaml_file import scalar_value
from rocking.warnings import RockingWarning
from tests.refusals import refused

ROOT = Path(rocking.__file__).parents[1]
PERIOD, STEP = 1.0, 0.01
BLOCKS = """
- {name: slender, type: block, breadth_m: 0.5, height_m: 3.0}
- {name: squat, type: block, breadth_m: 3.0, height_m: 3.0}
"""
BOMB = "\n".join(
    ["a0: &a0 [x, x]", *(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12))]
)


def sine_file(path, amplitude=0.5):
    """One full sine cycle of acceleration in g, with still ground before and after it."""
    times = np.arange(0, 10 + STEP / 2, STEP)
    cycle = np.where((times >= 3) & (times <= 3 + PERIOD), np.sin(2 * np.pi * (times - 3) / PERIOD), 0)
    lines = [f"{time:.2f} {amplitude * value:.9f}" for time, value in zip(times, cycle, strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def record(tmp_path):
    return sine_file(tmp_path / "own record.txt")


@pytest.fixture
def blocks(tmp_path):
    path = tmp_path / "blocks.yaml"
    path.write_text(BLOCKS, encoding="utf-8")
    return path


@pytest.fixture
def study(tmp_path):
    """A study with one record and one structure in a folder whose name holds a space."""
    folder = tmp_path / "my study"
    assert main(["start", str(folder)]) == 0
    (folder / "structures.yaml").write_text(BLOCKS, encoding="utf-8")
    sine_file(folder / "records" / "own record.txt")
    assert main(["catalogue", str(folder / "records"), "--unit", "g"]) == 0
    return folder


def files(folder):
    return {path.relative_to(folder) for path in folder.rglob("*")}


def rows(path):
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.parametrize(("scale", "warned"), [("5.9", False), ("6.1", True), ("-80", True), ("1", False)])
def test_a_factor_that_takes_the_peak_above_three_g_is_told(record, capsys, scale, warned):
    """The file reaches 0.5 g: six times that is the limit."""
    assert main(["read", str(record), "--unit", "g", f"--scale={scale}"]) == 0
    peak = 0.5 * abs(float(scale))
    told = RockingWarning.of(SignalKind.PEAK_RARE_BY_FACTOR, factor=float(scale), peak_g=peak)
    assert (str(told) in capsys.readouterr().out) == warned


@pytest.mark.parametrize(
    ("content", "words"), [("[1, 2]", "a list"), ("3", "a number"), ("text", "a text"), ("true", "a truth")]
)
def test_what_a_file_holds_is_told_in_plain_words(study, capsys, content, words):
    (study / "config.yaml").write_text(content, encoding="utf-8")
    assert main(["run", str(study)]) == 2
    assert f"the file holds {words}, but must hold settings" in capsys.readouterr().err
    with refused(rocking.RecordError, "path", 3):
        rocking.read(3)


def test_a_name_says_nothing_to_the_terminal_itself(tmp_path, capsys):
    """Nor does a message; and a folder of bytes that are no text is named, too."""
    folder = tmp_path / "my\x1b]0;title\x07 study"
    assert main(["start", str(folder)]) == 0
    assert main(["run", str(folder)]) == 2
    told = capsys.readouterr()
    for text in (told.out, told.err):
        assert "my\\x1b]0;title\\x07 study" in text and "\x1b" not in text
    assert main(["run", os.fsdecode(bytes(tmp_path) + b"/\xff\x9b2J")]) == 2
    assert "\\udcff" in capsys.readouterr().err


def test_a_terminal_of_few_letters_gets_the_others_escaped(record, blocks, monkeypatch):
    for encoding, written in (("ascii", b"m/s\\xb2"), ("cp1252", b"m/s\xb2")):
        received = io.BytesIO()
        monkeypatch.setattr("sys.stdout", io.TextIOWrapper(received, encoding))
        assert main(["read", str(record), "--unit", "g"]) == 0
        assert main(["assess", str(record), "--structures", str(blocks), "--unit", "g"]) == 0
        sys.stdout.flush()
        assert written in received.getvalue()


def test_a_closed_terminal_is_no_failure(record, monkeypatch):
    monkeypatch.setattr("sys.stdout", None)
    monkeypatch.setattr("sys.stderr", None)
    assert main(["read", str(record), "--unit", "g"]) == 0
    assert main(["read", "nowhere"]) == 1


def test_of_many_defects_the_first_forty_are_told(study, capsys):
    """They would push one another off the screen."""
    wrong = "".join(f"wrong_{number}: 1\n" for number in range(100))
    (study / "config.yaml").write_text(wrong, encoding="utf-8")
    assert main(["run", str(study)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 41 and "wrong_0" in lines[0] and lines[-1] == "and 60 lines more"


def test_read_and_pulse_say_what_is_in_a_file(record, capsys):
    assert main(["read", str(record), "--unit", "g"]) == 0
    assert main(["pulse", str(record), "--unit", "g"]) == 0
    text = capsys.readouterr().out
    assert "1001 samples every 0.01 s" in text
    assert f"peak {0.5 * 9.80665:.4g} m/s² = 0.5 g" in text
    assert "= 0.5 g, period 1 s, start 3.000 s, explains 100%" in text


def test_assess_tells_overturning_from_no_uplift(record, blocks, capsys):
    """Peak 0.5 g: below the uplift at tan α = 1 of the squat block, far above that of the slender one (1/6)."""
    assert main(["assess", str(record), "--structures", str(blocks), "--unit", "g"]) == 0
    lines = capsys.readouterr().out.splitlines()
    told = [line.split(": ")[1].split(";")[0] for line in lines]
    expected = [
        "PGA as read channel 1 0.5 g",
        "overturns (100\u00a0%)",
        "overturns",
        "stands (0\u00a0%)",
        "no uplift",
    ]
    assert told == expected, "the peak, verdict and share, then the component by itself"


@pytest.mark.parametrize(
    "names",
    [("storey wall", "slender block"), pytest.param(("",), marks=pytest.mark.slow)],
    ids=["two", "all"],
)
def test_terminal_tables_and_python_say_the_same_of_every_shipped_structure(
    names, tmp_path, capsys, monkeypatch
):
    """Under the shipped record of two components, of which eight directions make one ensemble.

    The reserve, on which no verdict hangs, is not sought: it takes more time than the rest.
    """
    monkeypatch.setattr("rocking.assessment.one_case.reserve", lambda *_: None)
    shipped = ROOT / "records" / "20161113_110259_WTMC_20.V2A"
    entries = (ROOT / "config" / "structures.yaml").read_text(encoding="utf-8").splitlines()
    structures = tmp_path / "structures.yaml"
    structures.write_text("\n".join(line for line in entries if any(name in line for name in names)))
    assert main(["assess", str(shipped), "--structures", str(structures), "--output", str(tmp_path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    (path,) = tmp_path.glob("*/verdicts.csv")
    table = rows(path)
    first, second, _ = rocking.read(shipped)
    bodies = load_scenes(structures)
    assert {row["structure"] for row in table} == set(bodies)
    for row in table:
        name, verdict = row["structure"], row["verdict"]
        period = float(row["support_period_s"] or "nan")
        if period > 0:
            assert any(line.startswith(f"{placed(name, period)}: {verdict}") for line in lines)
            continue
        assessment = rocking.assess([first, second], bodies[name].structure)
        assert (assessment.verdict, str(assessment.overturning_members)) == (
            verdict,
            row["overturning_members"],
        )
        share = assessment.decision.share_in_words
        assert f"{placed(name, period)}: {verdict}{f' ({share})' if share else ''}; {row['why']}" in lines
        assert row["why"] == assessment.why


def test_assess_opens_a_file_once_and_writes_report_and_tables_like_a_study(
    record, blocks, tmp_path, capsys, monkeypatch
):
    opened, real = [], os.open
    monkeypatch.setattr(
        os, "open", lambda path, *mode, **more: opened.append(path) or real(path, *mode, **more)
    )
    arguments = [
        "assess",
        str(record),
        "--structures",
        str(blocks),
        "--name",
        "squat",
        "--unit",
        "g",
        "--scale",
        "1.5",
    ]
    assert main([*arguments, "--output", str(tmp_path / "out")]) == 0
    assert opened.count(record) == 1
    assert "multiplied by 1.5" in capsys.readouterr().out
    folder = tmp_path / "out" / "own_record"
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
    comparison = rows(folder / "comparison.csv")
    assert [row["structure"] for row in comparison] == ["squat"]
    assert rows(folder / "record.csv")[0]["scale_factor"] == "1.5"
    assert rows(tmp_path / "out" / "summary" / "structures.csv")[0]["structure"] == "squat"


def test_spectrum_is_printed_and_written_only_where_that_is_asked(record, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    before = {path.name for path in tmp_path.iterdir()}
    assert main(["spectrum", str(record), "--unit", "g"]) == 0
    printed = capsys.readouterr().out
    assert {path.name for path in tmp_path.iterdir()} == before
    assert main(["spectrum", str(record), "--unit", "g", "--output", "own.csv"]) == 0
    assert (tmp_path / "own.csv").read_text() == printed


def test_spectrum_agrees_with_the_integration_of_one_block(record, tmp_path):
    target = tmp_path / "spectrum.csv"
    assert main(["spectrum", str(record), "--unit", "g", "--output", str(target)]) == 0
    table = rows(target)
    across, up = (
        [float(row[name]) for row in table] for name in ("frequency_parameter_rad_s", "uplift_multiplier")
    )
    assert sorted(across)[::40] == pytest.approx(0.5 * 20 ** (np.arange(40) / 39))
    assert sorted(up)[::40] == pytest.approx(0.02 * 50 ** (np.arange(40) / 39))
    rocks = [row for row in table if 0 < float(row["rotation_ratio"]) < math.inf]
    chosen = rocks[len(rocks) // 2]
    p, multiplier = float(chosen["frequency_parameter_rad_s"]), float(chosen["uplift_multiplier"])
    block = rocking.EquivalentBlock(
        frequency_parameter=p, critical_rotation=0.1, acceleration_scale=0.1 / multiplier, restitution=0.9
    )
    response = rocking.integrate(block, rocking.read(record, unit="g")[0])
    # both are exact solutions of the same linear equation; only event times are iterated, to rounding
    assert float(chosen["rotation_ratio"]) == pytest.approx(response.rotation_ratio, rel=1e-9)


def test_a_catalogue_keeps_what_was_typed_in_and_adds_what_is_new(study, capsys):
    catalogue = study / "records" / "catalogue.csv"
    before, (first,) = catalogue.read_bytes(), rows(catalogue)
    assert main(["catalogue", str(study / "records"), "--unit", "cm/s2"]) == 0
    assert catalogue.read_bytes() == before
    name = first["file"]
    text = "time,NS (g)\n" + "".join(f"{i / 100},{i % 5}\n" for i in range(99))
    (study / "records" / "more.csv").write_text(text, encoding="utf-8")
    (study / "records" / name).rename(study / "records" / f".{name}")
    (study / "records" / "letter.txt").write_text("Dear Sir or Madam\n", encoding="utf-8")
    assert main(["catalogue", str(study / "records")]) == 0
    printed = capsys.readouterr().out
    assert "1 of them new" in printed and "its file is not there" in printed
    assert "Not read:\n  letter.txt: " in printed
    after = rows(catalogue)
    assert [row["file"] for row in after] == [name, "more.csv"]
    assert after[0] == dict.fromkeys(after[0], "") | first


def test_start_writes_the_ten_settings_changed_first_and_where_the_others_stand(tmp_path):
    assert main(["start", str(tmp_path)]) == 0
    text = (tmp_path / "config.yaml").read_text(encoding="utf-8")
    own = yaml.safe_load(text)
    assert read_settings(own) == Settings()
    assert len(own.pop("design_spectrum")) + len(own) == 10
    assert "docs/pages/settings.md" in text and (ROOT / "docs" / "pages" / "settings.md").exists()
    assert all(not line or line.endswith(":") or "#" in line for line in text.splitlines())
    assert (tmp_path / own["structures"]).exists()


@pytest.mark.process
def test_run_plans_a_study_in_its_own_folder(study, monkeypatch, capfd):
    monkeypatch.chdir(study.parent)
    assert main(["run", study.name, "--", "--dry-run"]) == 0
    told = capfd.readouterr()
    assert "results/own_record/report.pdf" in told.out + told.err
    assert main(["run", study.name, "fragility", "--", "--dry-run"]) == 0
    assert FRAGILITY.does in "".join(capfd.readouterr())
    assert not (study / "results").exists()


def _bad_inputs():
    yield "no such file", ["read", "absent.AT2"], "absent.AT2"
    yield "a folder of no records", ["read", "nothing"], "it holds no record"
    yield "an empty file", ["read", "empty"], "empty"
    yield "an unknown format", ["read", "letter"], "no reader recognises"
    yield "a unit not declared", ["read", "record"], "unit is not declared"
    yield "an unknown unit", ["read", "record", "--unit", "furlong"], "furlong"
    yield "a time step that contradicts", ["read", "record", "--unit", "g", "--time-step", "0.02"], "0.02"
    yield "a scale of nothing", ["pulse", "record", "--unit", "g", "--scale", "0"], "scale is 0"
    yield "a scale that is no number", ["pulse", "record", "--unit", "g", "--scale", "nan"], "scale is nan"
    yield "a component that is not there", ["pulse", "two", "--unit", "g", "--component", "X"], "'X'"
    yield (
        "a list that is not there",
        ["assess", "record", "--structures", "absent.yaml", "--unit", "g"],
        "absent.yaml",
    )
    yield (
        "a list that is no list",
        ["assess", "record", "--structures", "letter", "--unit", "g"],
        "must hold a list",
    )
    yield (
        "a structure that is not listed",
        ["assess", "record", "--structures", "list", "--name", "tower", "--unit", "g"],
        "'tower'",
    )
    yield "no record to assess", ["assess", "empty", "--structures", "list", "--output", "out"], "empty"
    yield "a restitution above 1", ["spectrum", "record", "--unit", "g", "--restitution", "2"], "restitution"
    yield "a folder without records", ["catalogue", "nothing"], "no accelerogram was read"
    yield "no folder", ["catalogue", "absent"], "this is no folder"
    yield "a folder with a study", ["start", "started"], "exists already"
    yield "no study", ["run", "nothing"], "config.yaml"
    yield "no catalogue", ["run", "empty_study"], "there is no catalogue yet"
    yield "a catalogue misspelt", ["run", "misspelt"], "setting catalogue is 'records/catalog.csv'"
    yield "a list misspelt", ["run", "started"], "setting structures is 'structure.yml'"
    yield "a near name", ["run", "misspelt"], "did you mean records/catalogue.csv?"
    yield "a file for a folder", ["run", "started/config.yaml"], "is a file, but a study is a folder"
    yield "settings that are no mapping", ["run", "broken"], "must hold settings"


@pytest.mark.parametrize(
    ("arguments", "said"), [case[1:] for case in _bad_inputs()], ids=[case[0] for case in _bad_inputs()]
)
def test_bad_input_is_one_sentence_and_nothing_written(arguments, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    sine_file(tmp_path / "record")
    shutil.copy(ROOT / "records" / "synthetic_strong_pulse.AT2", "two")
    Path("empty").touch()
    Path("letter").write_text("Dear Sir or Madam\n", encoding="utf-8")
    Path("list").write_text(BLOCKS, encoding="utf-8")
    for name in ("nothing", "started", "broken", "empty_study"):
        Path(name).mkdir()
    Path("started/config.yaml").write_text(
        f"catalogue: {ROOT / 'records' / 'catalogue.csv'}\nstructures: structure.yml\n"
    )
    Path("empty_study/config.yaml").write_text("structures: ../list\n")
    Path("broken/config.yaml").write_text("- catalogue\n", encoding="utf-8")
    Path("misspelt/records").mkdir(parents=True)
    Path("misspelt/records/catalogue.csv").touch()
    Path("misspelt/config.yaml").write_text("catalogue: records/catalog.csv\nstructures: ../list\n")
    before = files(tmp_path)
    assert main(arguments) in (1, 2)
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith("rocking: ") and told.err.count("\n") == 1 and said in told.err
    assert files(tmp_path) == before


@pytest.mark.parametrize("name", [".numba_config.yaml", "matplotlibrc"])
@pytest.mark.parametrize("verb", [["read", "x.AT2"], ["run", "study"], ["run"]])
def test_a_folder_brings_no_settings_for_a_library(tmp_path, monkeypatch, capsys, name, verb):
    """numba would unpickle what its file names, before anything else is asked."""
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "config.yaml").touch()
    monkeypatch.chdir(tmp_path)
    path = tmp_path / ("study" if "study" in verb else "") / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("cache_dir: nc\n")
    assert main(verb) == 2
    assert name in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--trust-io-cache", "--trust"])
def test_an_option_that_brings_code_is_refused(tmp_path, capsys, option):
    """snakemake would unpickle its cache."""
    assert main(["start", str(tmp_path)]) == 0
    shutil.copy(ROOT / "records" / "synthetic_strong_pulse.AT2", tmp_path / "records")
    assert main(["catalogue", str(tmp_path / "records")]) == 0
    assert main(["run", str(tmp_path), "--", option]) == 2
    told = capsys.readouterr().err
    assert told.endswith("leave it out.\n") and told.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (BOMB, "an anchor or an alias"),
        ("tolerance: " + "[" * 3000, "nested too deeply"),
        ("tolerance: " + "1" * 5000, "not valid YAML"),
        ("results: " + "x" * 5_000_000, "larger than"),
        ("tolerance: 1e-6\ntolerance: 1e-3", "given twice"),
        ("? [tolerance]\n: 1e-3", "a key must be a text"),
        ("\n".join(f"k{n}: 1" for n in range(70_000)), "larger than"),
        ("results: !!python/object/apply:os.getcwd []", "not valid YAML"),
    ],
    ids=["aliases", "brackets", "digits", "size", "twice", "list", "many keys", "tag"],
)
def test_a_config_that_hangs_or_is_read_in_silence_is_refused(tmp_path, text, words):
    (tmp_path / "config.yaml").write_text(text)
    with pytest.raises(ConfigurationError, match=words):
        check_config_file(tmp_path / "config.yaml")


@pytest.mark.parametrize("text", ["1:30", "011", "0x1f", "1_000", "yes", "2020-01-01"])
def test_what_yaml_1_1_would_turn_into_something_else_is_a_text(tmp_path, text):
    assert scalar_value(text) == text and scalar_value(f"[{text}") == f"[{text}"
    (tmp_path / "config.yaml").write_text(f"friction_coefficient: {text}\r\nresults: out\r\n")
    config = check_config_file(tmp_path / "config.yaml")
    with pytest.raises(ConfigurationError, match="setting friction_coefficient is"):
        make_plan(config)


@pytest.mark.parametrize(("error", "status", "said"), [
    (KeyboardInterrupt(), 130, "rocking: stopped.\n"),
    (ModuleNotFoundError("No module named 'fcntl'", name="fcntl"), 1, "rocking: this command needs Linux or macOS;"),
    (OSError(28, "No space left", "a.csv"), 1, "rocking: a.csv: No space left.\n"),
])  # fmt: skip
def test_what_stops_a_command_is_one_line(record, monkeypatch, capsys, error, status, said):
    monkeypatch.setattr("rocking.study.own_files.read_files", Mock(side_effect=error))
    assert main(["read", str(record)]) == status
    assert capsys.readouterr().err.startswith(said)


def test_without_a_verb_the_usage_says_that_one_is_missing(capsys):
    with pytest.raises(SystemExit) as ended:
        main([])
    assert ended.value.code == 2
    assert "required: verb" in capsys.readouterr().err
