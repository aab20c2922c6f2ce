"""Imports run one way, floor by floor and without a circle, and heavy libraries stay where they belong.

Every import of the package counts: at the top of a file, within a function and for a type checker alone.
"""

import ast
import shutil
import subprocess
import sys
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import rocking

PACKAGE = Path(rocking.__file__).parent
FLOORS = [
    {"warnings"},
    {"errors"},
    {"quantities", "drawn", "hashes", "progress"},
    {"described"},
    {"tables"},
    {"signal", "earthquakes"},
    {"records"},
    {"catalogue"},
    {"floors"},
    {"structures"},
    {"pulses"},
    {"sine_pulse", "motion"},
    {"contacts"},
    {"assessment"},
    {"codes", "fragility"},
    {"strengthening"},
    {"reports"},
    {"study"},
    {"products"},
]
ONLY_IN = {
    "pydantic": ("described.py", "catalogue/readings.py"),
    "obspy": ("records/", "signal/accelerogram.py", "catalogue/files.py", "study/miniseed.py"),
    "numba": ("motion/", "pulses/", "sine_pulse/", "contacts/"),
    "matplotlib": ("reports/", "products/"),
    "typst": ("reports/",),
    "snakemake": ("study/",),
    "xlsxwriter": ("tables/",),
}
DRAWN = ("matplotlib.axes.Axes",)
"""What the methods plot() return, for a type checker."""
UPWARDS = {
    ("rocking.drawn", "rocking.reports.panels"),
    ("rocking.structures.structure", "rocking.reports.panels"),
    ("rocking.signal.accelerogram", "rocking.signal.measures"),
}
"""Methods that a person calls on an object and that a module above it does: `wall.plot()`, `record.measures`.

Each imports within the method, through the package root, when it is called; nothing else may.
"""
MODULES = {
    ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts).removesuffix(".__init__"): path
    for path in sorted(PACKAGE.rglob("*.py"))
    if path.parent != PACKAGE or path.name != "__init__.py"
}


def homes() -> dict[str, str]:
    """The module in which each public name of the package root stands, by `__init__.pyi`."""
    stub = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    return {
        f"rocking.{alias.asname or alias.name}": f"rocking.{node.module}.{alias.name}"
        for node in stub.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


HOMES = homes()


@cache
def imported(module: str) -> frozenset[str]:
    """Names of everything that a module imports, of the package's own the modules, through its root or not."""
    return frozenset(map(owner, names_in(MODULES[module]))) - set(DRAWN)


@cache
def names_in(path: Path) -> frozenset[str]:
    """What a file imports, each name with that of its module."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level or not path.is_relative_to(PACKAGE), f"{path}: relative import"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return frozenset(names)


def owner(name: str) -> str:
    """The module of the package in which an imported name stands, or the name where it is of a library."""
    name = HOMES.get(name, name)
    return name.rpartition(".")[0] if name.startswith("rocking.") and name not in MODULES else name


def downwards(module: str) -> frozenset[str]:
    """The modules of the package that a module imports, but for those that its methods call upwards."""
    return frozenset(other for other in imported(module) & MODULES.keys() if (module, other) not in UPWARDS)


def floor(module: str) -> int:
    part = module.split(".")[1]
    return next(level for level, parts in enumerate(FLOORS) if part in parts)


def test_imports_run_downwards():
    assert any(downwards(module) for module in MODULES)
    for module in MODULES:
        for other in downwards(module):
            same_part = other.split(".")[1] == module.split(".")[1]
            assert same_part or floor(other) < floor(module), f"{module} imports {other}"


def test_no_module_leads_back_to_itself():
    """static_order raises CycleError, which names the circle."""
    graph = {module: downwards(module) - {module} for module in MODULES}
    assert len(list(TopologicalSorter(graph).static_order())) == len(MODULES)


def test_what_is_imported_upwards_is_so_within_methods_and_through_the_root():
    for module, other in UPWARDS:
        assert other in imported(module), f"{module} no longer imports {other}: take it off the list"
        tree = ast.parse(MODULES[module].read_text(encoding="utf-8"))
        within = {
            node
            for function in ast.walk(tree)
            if isinstance(function, ast.FunctionDef | ast.If)
            for node in ast.walk(function)
        }
        at_root = [
            node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module == "rocking"
        ]
        assert at_root and within.issuperset(at_root), f"{module} imports the package root at its top"


def test_an_assessment_knows_a_place_and_no_support():
    of_assessment = [module for module in MODULES if module.startswith("rocking.assessment")]
    floors = {other for module in of_assessment for other in downwards(module) if "floors" in other}
    assert floors == {"rocking.floors.place"}


def test_heavy_libraries_stay_in_their_place():
    libraries = {name.split(".")[0] for module in MODULES for name in imported(module)}
    assert set(ONLY_IN) <= libraries, "a library of the list is imported nowhere"
    for module, path in MODULES.items():
        place = path.relative_to(PACKAGE).as_posix()
        for name in imported(module):
            homes = ONLY_IN.get(name.split(".")[0], "")
            assert place.startswith(homes), f"{place} imports {name}"


@pytest.mark.process
def test_reading_a_text_file_assessing_a_structure_and_reporting_it_import_no_more_than_they_use():
    """In a process of its own, for this one has imported everything."""
    code = """
import sys, rocking
(record,) = rocking.read("records/synthetic_strong_pulse.AT2")
structures = {"block": rocking.Block.of_size(breadth=1, height=4), "wall": rocking.Wall(1.6, 1.4, 0.4)}
rocking.assess(record, structures["block"])
heavy = {"obspy", "matplotlib", "pandas", "typst", "xlsxwriter", "snakemake"}
print(sorted(heavy & set(sys.modules)))
from rocking.assessment.assessor import Assessor
from rocking.assessment.rows import rows_of_record
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings
from rocking.reports.record import RecordReport
result = Assessor(AssessmentSettings()).assess("a", [record], on_the_ground(structures))
from rocking.study.settings import Settings
RecordReport(result, rows_of_record(result), structures, Settings().for_pages).pdf()
print(sorted(heavy & set(sys.modules)))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=PACKAGE.parent, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n['typst']\n"


@pytest.mark.process
@pytest.mark.parametrize(
    "code",
    [
        "from rocking.study.plan import make_plan\n"
        "assert make_plan({'structures': 'config/structures.yaml'}).records",
        "from rocking.study.cli import main\n"
        "assert not main(['catalogue', RECORDS, '--output', RESULTS + '/catalogue.csv'])",
        "import os, rocking\nos.makedirs(RESULTS + '/summary')\nrocking.open_results(RESULTS)",
    ],
    ids=["plan", "catalogue", "open_results"],
)
def test_what_computes_nothing_loads_neither_what_compiles_nor_what_draws(code, tmp_path):
    """Half a second each, of a command that takes as long."""
    records = tmp_path / "records"
    records.mkdir()
    shutil.copy(PACKAGE.parent / "records" / "synthetic_strong_pulse.AT2", records)
    places = f"RESULTS = {str(tmp_path)!r}\nRECORDS = {str(records)!r}\n"
    heavy = f"import sys\nprint(*sorted({HEAVY!r} & set(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", f"{places}{code}\n{heavy}"],
        cwd=PACKAGE.parent,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines()[-1] == ""


HEAVY = {"numba", "matplotlib", "pandas", "obspy", "snakemake"}
