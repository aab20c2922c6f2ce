"""Imports run one way, floor by floor, and heavy libraries stay where they belong."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import rocking

PACKAGE = Path(rocking.__file__).parent
FLOORS = [
    {"errors"},
    {"quantities"},
    {"tables"},
    {"records", "structures"},
    {"pulses"},
    {"sine_pulse", "motion"},
    {"assessment"},
    {"calibration", "reports"},
    {"study"},
]
ONLY_IN = {
    "obspy": ("records/",),
    "numba": (
        "motion/linear_kernel.py",
        "motion/nonlinear_kernel.py",
        "pulses/refinement.py",
        "pulses/scan.py",
        "sine_pulse/kernel.py",
    ),
    "matplotlib": ("reports/",),
    "typst": ("reports/",),
    "snakemake": (),
}
ALLOWED_IN_PLOT = {"rocking.reports.plots"}
"""A method plot() may reach up to the drawing, at its call: whoever plots nothing pays for nothing."""


def _modules() -> list[Path]:
    return sorted(
        path for path in PACKAGE.rglob("*.py") if path.name != "__init__.py" or path.parent != PACKAGE
    )


def _nodes(node: ast.AST) -> Iterator[ast.AST]:
    """All below `node`, without what only a type checker reads and without the bodies of methods called plot."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and ast.unparse(child.test) == "TYPE_CHECKING":
            continue
        if isinstance(child, ast.FunctionDef) and child.name == "plot":
            assert _named(child) <= ALLOWED_IN_PLOT, f"{child.lineno}: plot() imports more than the drawing"
            continue
        yield child
        yield from _nodes(child)


def _named(node: ast.AST) -> set[str | None]:
    return {each.module for each in ast.walk(node) if isinstance(each, ast.ImportFrom)}


def _imports(path: Path) -> set[str]:
    names = set()
    for node in _nodes(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level:
            raise AssertionError(f"{path}: relative import")
    return names


def _part(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def _floor(part: str) -> int:
    return next(level for level, parts in enumerate(FLOORS) if part in parts)


def test_every_module_has_a_floor():
    assert {_part(path) for path in _modules()} <= set().union(*FLOORS)


@pytest.mark.parametrize("path", _modules(), ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_imports_run_downwards(path):
    part = _part(path)
    for name in _imports(path):
        if not name.startswith("rocking."):
            continue
        other = name.split(".")[1]
        allowed = other == part or _floor(other) < _floor(part)
        assert allowed, f"{part} imports {other}"


@pytest.mark.parametrize("path", _modules(), ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_heavy_libraries_stay_in_their_place(path):
    place = path.relative_to(PACKAGE).as_posix()
    for name in _imports(path):
        homes = ONLY_IN.get(name.split(".")[0])
        assert homes is None or place.startswith(homes), f"{place} imports {name}"
