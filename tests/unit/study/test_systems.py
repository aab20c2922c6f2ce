"""What a system lacks, or a path holds, is a sentence or no hindrance, and never a traceback."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from rocking.study.cli import main

ROOT = Path(__file__).parents[3]
RECORD = ROOT / "records" / "synthetic_strong_pulse.AT2"
WITHOUT = "import sys\nsys.modules['fcntl'] = None\n"


def python(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)


@pytest.mark.process
def test_without_locks_what_runs_a_study_says_where_it_works_and_all_else_works(tmp_path: Path) -> None:
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / RECORD.name).write_bytes(RECORD.read_bytes())
    wall = "{type: free_wall, height_m: 2, thickness_m: 0.3}"
    verbs = [
        ["run", "."],
        ["trade", "."],
        ["catalogue", str(tmp_path / "records")],
        ["pulse", str(RECORD)],
        ["assess", str(RECORD), "--structures", wall],
        ["read", str(RECORD)],
    ]
    done = python(f"{WITHOUT}from rocking.study.cli import main\nprint([main(verb) for verb in {verbs}])")
    assert done.stdout.endswith("[1, 1, 0, 0, 0, 0]\n"), done.stderr
    assert done.stderr.count("\n") == done.stderr.count("WSL") == 2
    assert all(
        words in done.stdout for words in ("catalogue.csv: 1 record", "period ", "overturn", "PEER AT2")
    )


@pytest.mark.slow
@pytest.mark.process
def test_a_python_in_a_folder_with_a_blank_runs_a_study(tmp_path: Path) -> None:
    """As one in a home folder of two words is: no job needs a command line."""
    environment = tmp_path / "two words"
    environment.symlink_to(sys.prefix, target_is_directory=True)
    study = tmp_path / "study"
    assert main(["start", str(study)]) == 0
    (study / "structures.yaml").write_text("- {name: a, type: block, breadth_m: 0.5, height_m: 3.0}\n")
    (study / "records" / RECORD.name).write_bytes(RECORD.read_bytes())
    assert main(["catalogue", str(study / "records")]) == 0
    command = [str(environment / "bin" / "python"), "-m", "rocking.study.cli", "run", str(study)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    assert (study / "results" / "synthetic_strong_pulse" / "report.pdf").exists()


def test_the_package_names_the_systems_that_it_runs_on() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert "Operating System :: POSIX :: Linux" in project["classifiers"]
    assert not any("Windows" in item for item in project["classifiers"])
    for page in ("README.md", "docs/pages/installing.md"):
        text = (ROOT / page).read_text(encoding="utf-8")
        assert all(name in text for name in ("Linux", "macOS", "WSL"))
