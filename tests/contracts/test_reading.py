"""How much a reader of the code has to hold at once, by count."""

import ast
import sys
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

import rocking
from rocking.structures import Structure
from rocking.study.cli import main

PACKAGE = Path(rocking.__file__).parent
MOST_PARAMETERS = 6
"""Parameters of a function, beside itself, from which on most would travel better as one thing."""
MOST_MEMBERS = 30
"""Public methods and properties of a structure."""
MOST_FILES = 62
MOST_FUNCTIONS = 672


def parameters(function: ast.FunctionDef) -> int:
    """How many parameters a function has beside self and cls; *more and **more count as one each."""
    own = function.args
    names = [
        each.arg for each in (*own.posonlyargs, *own.args, *own.kwonlyargs, own.vararg, own.kwarg) if each
    ]
    return len([name for name in names if name not in ("self", "cls")])


@pytest.mark.process
def test_few_functions_take_more_than_six_parameters():
    """The doors for Python, constructors that are forms of a file, and declarations; none beside them."""
    many = []
    for path in sorted(PACKAGE.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        if path.stem.endswith("kernel") or "from numba import" in text:  # which compiles no dataclasses
            continue
        functions = [each for each in ast.walk(ast.parse(text)) if isinstance(each, ast.FunctionDef)]
        found = [each for each in functions if parameters(each) > MOST_PARAMETERS]
        many += [f"{path.relative_to(PACKAGE)}: {each.name} ({parameters(each)})" for each in found]
    assert 0 < len(many) <= 15, "\n".join(many)


def test_a_structure_shows_few_members():
    """What a reader of any structure has to know, beside the values that its class declares."""
    shown = [
        name
        for name, each in vars(Structure).items()
        if not name.startswith("_") and (callable(each) or hasattr(type(each), "__get__"))
    ]
    assert 20 < len(shown) <= MOST_MEMBERS, shown


@pytest.mark.process
def test_the_main_job_enters_few_files_and_functions(tmp_path, capsys):
    """One record under one wall, from the file to the PDF; lambdas and comprehensions are no functions to jump to.

    Asked were 66 files and 650 functions, those of the first wall without what holds its top, slides or opens. What is
    computed, imported or remembered before is not counted, so that other tests change nothing.
    """
    entered: set[tuple[str, str]] = set()

    def note(frame: FrameType, event: str, _: Any) -> None:
        code = frame.f_code
        if event == "call" and code.co_filename.startswith(str(PACKAGE)) and not code.co_name.startswith("<"):
            entered.add((code.co_filename, code.co_qualname))

    wall = tmp_path / "wall.yaml"
    wall.write_text("- {name: wall, type: wall, height_m: 3.2, thickness_m: 0.25}\n")
    record = PACKAGE.parent / "records" / "20161113_110259_WTMC_20.V2A"
    job = ["assess", str(record), str(wall), "--output", str(tmp_path / "results")]
    main(job)  # imports
    sys.setprofile(note)
    try:
        main(job)
    finally:
        sys.setprofile(None)
    assert list(tmp_path.rglob("report.pdf"))
    assert len({file for file, _ in entered}) <= MOST_FILES
    assert 400 < len(entered) <= MOST_FUNCTIONS
