"""The form of the package's passages: long functions say why, the formatter is on, one name is assigned a line."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import rocking

PACKAGE = Path(rocking.__file__).parent
PATHS = sorted(PACKAGE.rglob("*.py"))
LONGEST = 40
"""Lines of a function without its docstring beyond which a comment above it says why it is not cut."""
REASON = "# Whole on purpose: "
MOST_UNFORMATTED = 25
"""Tables of patterns and numbers that the formatter leaves as they are."""
COMPILERS = {"compiled", "entry", "part"}
"""Decorators of compiled kernels."""
LARGEST_PARALLEL_SHARE = 0.01
"""Share of the assignments that may set several names at once, such as two names that change places."""


def long_functions(source: str) -> Iterator[str]:
    """Yield the names of long functions above which no comment says why they are long."""
    lines = source.split("\n")
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        first = node.body[0]
        is_docstring = ast.get_docstring(node) is not None
        told = (first.end_lineno or 0) - first.lineno + 1 if is_docstring else 0
        size = (node.end_lineno or 0) - node.lineno + 1 - told
        top = min(each.lineno for each in (node, *node.decorator_list))
        if size > LONGEST and not lines[top - 2].strip().startswith(REASON):
            yield node.name


def is_compiled(node: ast.AST) -> bool:
    """Whether a function is a compiled kernel, in which statements stand as densely as its equations."""
    if not isinstance(node, ast.FunctionDef):
        return False
    return any(ast.unparse(each).partition("(")[0] in COMPILERS for each in node.decorator_list)


def assignments(node: ast.AST) -> Iterator[ast.stmt]:
    """Yield the assignments within `node`, but for those of compiled kernels."""
    if is_compiled(node):
        return
    if isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
        yield node
    for child in ast.iter_child_nodes(node):
        yield from assignments(child)


def is_parallel(statement: ast.stmt) -> bool:
    """Whether an assignment sets several names to as many values; one that takes a result apart does not."""
    return (
        isinstance(statement, ast.Assign)
        and isinstance(statement.targets[0], ast.Tuple)
        and isinstance(statement.value, ast.Tuple)
    )


@pytest.mark.parametrize("path", PATHS, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_a_long_function_says_why_it_is_whole(path):
    assert list(long_functions(path.read_text(encoding="utf-8"))) == []


def test_the_reason_is_asked_of_long_functions_alone():
    body = "\n".join(["    x = 1"] * LONGEST)
    assert list(long_functions(f"def short():\n{body[:-10]}")) == []
    assert list(long_functions(f'def told():\n    """{body}"""\n    return 1')) == []
    assert list(long_functions(f"def long():\n{body}")) == ["long"]
    assert list(long_functions(f"{REASON}a list.\ndef long():\n{body}")) == []
    assert list(long_functions(f"{REASON}a list.\n@cache\ndef long():\n{body}")) == []


def test_the_formatter_is_switched_off_for_a_few_tables_alone():
    texts = [path.read_text(encoding="utf-8") for path in PATHS]
    assert not any("# fmt: off" in text for text in texts)
    assert sum(text.count("# fmt: skip") for text in texts) <= MOST_UNFORMATTED


def test_a_line_assigns_one_name():
    every = [
        statement for path in PATHS for statement in assignments(ast.parse(path.read_text(encoding="utf-8")))
    ]
    parallel = [ast.unparse(statement) for statement in every if is_parallel(statement)]
    assert len(parallel) < LARGEST_PARALLEL_SHARE * len(every), parallel


def test_what_takes_a_result_apart_is_not_parallel():
    source = "a, b = 1, 2\nc, d = divmod(7, 2)\nz = 1, 2\n@compiled\ndef kernel():\n    a, b = 1, 2"
    assert [is_parallel(each) for each in assignments(ast.parse(source))] == [True, False, False]
