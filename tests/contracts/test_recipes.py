"""The recipes of CONTRIBUTING.md, followed to the letter in a copy of the tree."""

import os
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import rocking

PACKAGE = Path(rocking.__file__).parent
ROOT = PACKAGE.parent
_RECIPE = re.compile(r"^### ([^\n]*)\n(.*?)(?=^#|\Z)", re.M | re.S)
_BLOCK = re.compile(r"^( *)```(python|diff|sh)\n(.*?)^ *```$", re.M | re.S)
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
RECIPES = dict(_RECIPE.findall(TEXT))
LEFT_OUT = {".git", ".venv", "results", ".snakemake"}


def blocks(recipe: str) -> list[tuple[str, str]]:
    """The blocks of a recipe in their order: language and text."""
    return [(language, textwrap.dedent(text)) for _, language, text in _BLOCK.findall(recipe)]


def own(tree: Path, place: str) -> Path:
    """Return the file at `place` in `tree`, to be written: it is no longer a link."""
    path = tree / place
    if path.is_symlink():
        text = path.read_text(encoding="utf-8")
        path.unlink()
        path.write_text(text, encoding="utf-8")
    return path


def change(path: Path, text: str) -> None:
    """Change a file as a diff says, whose lines without a sign stand there already, once."""
    lines = text.splitlines()
    before = "\n".join(line[1:] for line in lines if line[:1] != "+")
    after = "\n".join(line[1:] for line in lines if line[:1] != "-")
    content = path.read_text(encoding="utf-8")
    assert content.count(before) == 1, f"{path.name} holds {content.count(before)} times:\n{before}"
    path.write_text(content.replace(before, after), encoding="utf-8")


def follow(tree: Path, language: str, text: str) -> None:
    """Do what one block says."""
    if language == "sh":
        command = [sys.executable, "-m", *shlex.split(text), "-q", "-p", "no:cacheprovider"]
        environment = os.environ | {"PYTHONPATH": str(tree)}
        done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr
        assert not re.search(r"\b0 passed|no tests ran", done.stdout), done.stdout
        return
    head, _, body = text.partition("\n")
    path = own(tree, head.removeprefix("# "))
    if language == "diff":
        change(path, body.rstrip("\n"))
    else:
        assert not path.exists(), f"{path.name} is there already"
        path.parent.mkdir(exist_ok=True)
        path.write_text(body, encoding="utf-8")


@pytest.fixture
def tree(tmp_path) -> Path:
    """The repository, each file a link, so that what is compiled is found and nothing of it is changed."""
    left_out = shutil.ignore_patterns(*LEFT_OUT)
    return Path(shutil.copytree(ROOT, tmp_path / "tree", ignore=left_out, copy_function=os.symlink))


@pytest.mark.parametrize("name", RECIPES)
def test_a_recipe_changes_lines_that_stand_there(tmp_path, name):
    """The same without what starts processes, so that each run of the unmarked tests sees a line that was edited."""
    for language, text in blocks(RECIPES[name]):
        if language == "diff":
            place, _, body = text.removeprefix("# ").partition("\n")
            copy = tmp_path / place
            if not copy.exists():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(ROOT / place, copy)
            change(copy, body.rstrip("\n"))


@pytest.mark.slow
@pytest.mark.parametrize("name", RECIPES)
def test_a_recipe_can_be_followed_to_the_letter(tree, name):
    steps = blocks(RECIPES[name])
    assert {"diff", "sh"} <= {language for language, _ in steps} <= {"python", "diff", "sh"}
    for language, text in steps:
        follow(tree, language, text)
    written = [own(tree, text.partition("\n")[0][2:]) for language, text in steps if language == "python"]
    if not written:
        return
    command = [sys.executable, "-m", "ruff", "check", *map(str, written)]
    check = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=False)
    assert check.returncode == 0, check.stdout


def test_the_path_of_a_record_names_files_that_there_are():
    path = TEXT.partition("the path of a record")[2].partition("\n* A **Mechanism**")[0]
    named = re.findall(r"`([\w/]+(?:/|\.\w+))`", path)
    assert len(named) > len(re.findall(r"^\d+\. ", path, re.M)) > 0
    assert not [name for name in named if not any((folder / name).exists() for folder in (ROOT, PACKAGE))]


def test_the_map_names_every_wing():
    drawn = TEXT.partition("## Layout")[2].partition("```text\n")[2].partition("```")[0]
    wings = {path.stem for path in PACKAGE.iterdir() if path.suffix in ("", ".py")}
    assert wings - {"__init__", "__pycache__", "shipped"} <= set(re.findall(r"\w+", drawn))
