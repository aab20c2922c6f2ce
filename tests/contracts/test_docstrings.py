"""A docstring of the package names its thing by a noun."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import rocking

PACKAGE = Path(rocking.__file__).parent
REFUSED = {"What", "Of", "Where", "Which", "How", "By"}
"""First words that describe a thing without naming it."""


def strings(source: str) -> Iterator[tuple[int, str]]:
    """Line and text of each docstring, and of each string that stands under an assignment or a field."""
    for node in ast.walk(ast.parse(source)):
        for statement in getattr(node, "body", []) if not isinstance(node, ast.Lambda | ast.IfExp) else []:
            if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
                text = statement.value.value
                if isinstance(text, str):
                    yield statement.lineno, text


def nameless(source: str) -> list[str]:
    """The strings whose first word is refused, each with its line."""
    return [
        f"{line}: {text}" for line, text in strings(source) if text.split()[0].strip("'\",.:;") in REFUSED
    ]


@pytest.mark.parametrize(
    "path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE))
)
def test_docstrings_begin_with_a_noun(path):
    assert nameless(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    "source",
    [
        '"""What a file holds."""',
        'STEP = 0.01\n"""Of the samples, s."""',
        'class Block:\n    """Where it stands."""',
        'class Block:\n    height: float\n    """By the drawing, m."""',
        'def step():\n    """\n    How long a sample lasts.\n    """',
        'if True:\n    async def step():\n        """Which step."""',
    ],
)
def test_a_nameless_docstring_is_seen_wherever_it_stands(source):
    assert len(nameless(source)) == 1


def test_a_noun_and_the_same_words_further_on_are_allowed():
    assert (
        nameless('"""The step of a record: how long, of what, by which rule. What follows is free."""') == []
    )
