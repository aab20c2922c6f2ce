"""Each product of the table keeps what its face says of it: that it is light, its work, its tables, and its files."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from rocking import Block
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import EnsembleSettings
from rocking.catalogue import CatalogueRecord
from rocking.catalogue.catalogue import is_safe_id
from rocking.study.job import Study
from rocking.study.product import Product
from rocking.study.products import PRODUCTS
from rocking.study.results import open_results, rows_of_table
from rocking.study.settings import Settings, StudyDesign
from rocking.study.work import Work, work_of
from rocking.tables import write_rows
from tests.synthetic import SyntheticRecord, at2_text
from tests.unit.study.made_jobs import worked

HEAVY = {"numpy", "yaml", "pandas", "matplotlib", "numba", "scipy", "pydantic"}
IDS = [product.name for product in PRODUCTS]


@pytest.mark.process
def test_the_table_loads_no_library_and_no_work() -> None:
    """In a process of its own: an import in a face costs every command, its help too, a third of a second."""
    code = "import sys\nimport rocking.study.products\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert not HEAVY & loaded
    own = {name for name in loaded if re.match(r"rocking\.\w+\.\w", name)}
    assert own == {"rocking.study.product", "rocking.study.products"}


def test_names_of_products_tables_and_files_are_taken_once() -> None:
    paths = [output.path for product in PRODUCTS for output in product.outputs]
    tables = [table for product in PRODUCTS for table in product.tables]
    for names in (IDS, paths, tables):
        assert len(names) == len(set(names))
    assert not any(is_safe_id(product.folder) for product in PRODUCTS), "no record has such a folder"


@pytest.mark.parametrize("product", PRODUCTS, ids=IDS)
def test_a_face_names_a_work_and_tables_that_there_are(product: Product) -> None:
    """Which mypy does not see in a text; nor a method of a work that nobody calls, as one that is misspelt."""
    work = work_of(product)
    assert {name for name in vars(type(work)) if name[:1] != "_"} <= set(vars(Work))
    classes = {rows_of_table(product, name) for name in product.tables}
    assert {*work.sheets} <= {*work.shown} & classes
    assert {row_class.__module__ for row_class in classes} == {product.rows}
    assert product.does


OPENING, AFTER, MEASURED, STAYS = "opens_records", "after_records", "is_measured", "stays"
FACES = {
    "checks": {AFTER},
    "fragility": {OPENING, STAYS},
    "trade": {OPENING, AFTER, MEASURED, STAYS},
    "map": {AFTER},
}
"""What is said of each product, as docs/using/results.md tells: what it reads, and whether it stays where it is off."""


@pytest.mark.parametrize("product", PRODUCTS, ids=IDS)
def test_a_product_opens_records_follows_them_and_stays_as_its_face_says(product: Product) -> None:
    assert {flag for flag in (OPENING, AFTER, MEASURED, STAYS) if getattr(product, flag)} == FACES[
        product.name
    ]
    assert (product.folder, product.pool) == {
        "checks": ("summary", "checks.pool"), "fragility": ("fragility", ""),
    }.get(product.name, ("summary", ""))  # fmt: skip


@pytest.mark.parametrize("product", PRODUCTS, ids=IDS)
def test_it_names_settings_that_there_are(product: Product) -> None:
    told = Settings().values_of(product.settings)
    assert {*filter(None, [product.pool])} <= {*told}


@pytest.mark.parametrize("product", PRODUCTS, ids=IDS)
def test_its_tables_are_read_back_by_their_names(product: Product, tmp_path: Path) -> None:
    (tmp_path / "summary").mkdir()
    for name in product.tables:
        row = rows_of_table(product, name)
        write_rows(row, [], tmp_path / product.folder / row.table.file_name)
        assert list(getattr(open_results(tmp_path), name).columns) == list(row.table.column_names)


@pytest.fixture(scope="module")
def assessed(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[CatalogueRecord], Study, Path]:
    """Two records under which one block is assessed, of a study at a design level."""
    folder = tmp_path_factory.mktemp("assessed")
    records = []
    for seed in range(2):
        name = f"made{seed}"
        (folder / f"{name}.AT2").write_text(at2_text(SyntheticRecord(name=name, seed=seed)))
        cells = {"unit": "g", "event": name, "station": name, "folder": folder}
        records.append(CatalogueRecord(name, f"{name}.AT2", **cells))
    settings = Settings(
        catalogue=str(folder / "catalogue.csv"),
        reports=False,
        histories=True,
        candidates=0,
        processing_variants=False,
        ensemble=EnsembleSettings(members=16, reserve=0),
        design_spectrum=StudyDesign(ag=0.2, f0=2.5, tc_star=0.4),
        figures="svg",
    )
    study = Study(on_the_ground({"block": Block.of_size(0.5, 3.0)}), settings, "made")
    worked(records, study, folder / "results")
    return records, study, folder
