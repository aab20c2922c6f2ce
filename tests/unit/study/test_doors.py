"""What a study folder may not bring, and a config.yaml that would hang or be read in silence."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rocking.errors import ConfigurationError
from rocking.study.cli import main
from rocking.study.plan import check_config_file, make_plan
from rocking.tables.yaml_file import scalar_value

ROOT = Path(__file__).parents[3]
BOMB = "\n".join(
    ["a0: &a0 [x, x]", *(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12))]
)


@pytest.mark.parametrize("name", [".numba_config.yaml", "matplotlibrc", "profiles/default"])
@pytest.mark.parametrize("verb", [["read", "x.AT2"], ["run", "study"], ["run"]])
def test_a_folder_brings_no_settings_for_a_library(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    name: str,
    verb: list[str],
) -> None:
    """numba would unpickle what its file names, before anything else is asked."""
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "config.yaml").touch()
    monkeypatch.chdir(tmp_path)
    path = tmp_path / ("study" if "study" in verb else "") / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("cache_dir: nc\n")
    assert main(verb) == 2
    assert name in capsys.readouterr().err


@pytest.mark.parametrize(
    "option", ["--trust-io-cache", "--trust", "--configfile", "--configfiles=x.yaml", "--configf"]
)
def test_options_that_bring_code_or_other_settings_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], option: str
) -> None:
    """snakemake would unpickle its cache, and read a file of settings before anybody looks at it."""
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
        ("\n".join(f"k{n}: 1" for n in range(70_000)), "larger than"),
        ("results: !!python/object/apply:os.getcwd []", "not valid YAML"),
    ],
    ids=["aliases", "brackets", "digits", "size", "twice", "many keys", "tag"],
)
def test_a_config_that_hangs_or_is_read_in_silence_is_refused(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "config.yaml").write_text(text)
    with pytest.raises(ConfigurationError, match=words):
        check_config_file(tmp_path / "config.yaml")


@pytest.mark.parametrize(("text", "words"), [(BOMB, "an anchor or an alias"), ("", "no regular file")])
def test_plain_snakemake_refuses_it_too(tmp_path: Path, text: str, words: str) -> None:
    """Its own reader would expand an alias bomb, and wait at a pipe for ever."""
    path = tmp_path / "config.yaml"
    path.write_text(text) if text else os.mkfifo(path)
    command = [sys.executable, "-m", "snakemake", "-s", str(ROOT / "Snakefile"), "--directory", str(tmp_path)]
    done = subprocess.run([*command, "-n"], capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode == 1 and words in done.stdout + done.stderr


@pytest.mark.parametrize("text", ["1:30", "011", "0x1f", "1_000", "yes", "2020-01-01"])
def test_what_yaml_1_1_would_turn_into_something_else_is_a_text(tmp_path: Path, text: str) -> None:
    assert scalar_value(text) == text
    (tmp_path / "config.yaml").write_text(f"friction_coefficient: {text}\r\nresults: out\r\n")
    config = check_config_file(tmp_path / "config.yaml")
    with pytest.raises(ConfigurationError, match="setting friction_coefficient is"):
        make_plan(config)
