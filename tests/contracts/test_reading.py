"""How much a reader of the code has to hold at once, by count."""

import ast
from pathlib import Path

import rocking

PACKAGE = Path(rocking.__file__).parent
MOST_PARAMETERS = 6
"""Parameters of a function, beside itself, from which on most would travel better as one thing."""


def parameters(function: ast.FunctionDef) -> int:
    """How many parameters a function has beside self and cls; *more and **more count as one each."""
    own = function.args
    names = [
        each.arg for each in (*own.posonlyargs, *own.args, *own.kwonlyargs, own.vararg, own.kwarg) if each
    ]
    return len([name for name in names if name not in ("self", "cls")])


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
