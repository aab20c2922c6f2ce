"""The files of each product of a study: the one table that says what a run writes, and when.

The rules declare these files as their output, all of them are targets of a study, and a file of such a name that no
product of the plan owns any more is removed.
"""

import re
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES, TimingRow
from rocking.catalogue.catalogue import is_safe_id
from rocking.hashes import sha256_of_file
from rocking.study.product import KEPT, Output, draws
from rocking.study.products import PRODUCTS
from rocking.study.settings import Settings

CASES = f"{KEPT}/cases"
"""Where the results of the cases of each record are kept."""
SUMS = "SHA256SUMS"
"""In the folder of the results: the hashes of the pages to sign and of the tables, for sha256sum -c."""
PROVENANCE = "provenance.json"
"""In the folder of the summary: what the results were made from and with."""


def _reports(settings: Settings) -> bool:
    return settings.reports


def _histories(settings: Settings) -> bool:
    return settings.histories


def _draws_reports(settings: Settings) -> bool:
    return settings.reports and draws(settings)


OUTPUTS: Mapping[str, tuple[Output, ...]] = {
    "record": (
        *(
            Output(f"{{name}}/{row_class.table.file_name}", is_measured=row_class is TimingRow)
            for row_class in RECORD_TABLES
        ),
        Output("{name}/histories.csv", _histories),
        Output("{name}/report.pdf", _reports, label="report", caption="record", category="Records"),
        Output("{name}/explore.js", _reports),
        Output("{name}/report_figures.zip", _draws_reports),
        Output(f"{KEPT}/outcomes/{{name}}.json"),
        Output(f"{CASES}/{{name}}.json", is_store=True),
    ),
    "batch": (Output(f"{KEPT}/outcomes/{{name}}.zip"),),
    "summary": (
        *(
            Output(
                f"summary/{row_class.table.file_name}",
                is_measured=row_class is TimingRow,
                label=row_class.table.description,
                caption="table",
                category="Tables",
            )
            for row_class in SUMMARY_TABLES
        ),
        Output(
            "summary/summary.pdf",
            _reports,
            label="report on all records",
            caption="summary",
            category="Study",
        ),
        Output(
            "summary/prediction_against_integration.svg",
            _reports,
            label="prediction against integration",
            caption="scatter",
            category="Study",
        ),
        Output(
            "summary/study.html",
            _reports,
            label="page to explore the study",
            caption="explore",
            category="Study",
        ),
        Output("summary/study.xlsx", _reports),
        Output("summary/summary_figures.zip", _draws_reports),
        Output(f"summary/{PROVENANCE}"),
        Output("summary/datapackage.json"),
        Output(SUMS),
    ),
    **{product.name: product.outputs for product in PRODUCTS},
}
"""By the kind of product, which is the name of its rule."""


def log_of(product: str) -> str:
    """Return the log of the job of a product, from the folder of the results."""
    return f"summary/logs/{product}.log"


def outputs_of(product: str, settings: Settings) -> dict[Output, Path]:
    """Return the files of a product, such as "record/a" or "summary", that the settings ask for."""
    kind, _, name = product.partition("/")
    asked = (output for output in OUTPUTS[kind] if output.when(settings))
    return {output: Path(settings.results, output.path.replace("{name}", name)) for output in asked}


def sums_of(product: str, settings: Settings) -> dict[str, str]:
    """Return the sha256 of the pages and the tables of a product that stand, by their paths in the results.

    But for those of measured times, which differ between two runs of the same input.
    """
    results = Path(settings.results)
    outputs = outputs_of(product, settings).items()
    paths = [path for output, path in outputs if path.suffix in (".csv", ".pdf") and not output.is_measured]
    return {path.relative_to(results).as_posix(): sha256_of_file(path) for path in paths if path.is_file()}


def kept_of(results: Path, product: str) -> Path:
    """Return the file that keeps the rows of a product over all records."""
    return results / KEPT / "rows" / f"{product}.json"


def outcome_of(results: Path, record: str, batch: str = "") -> Path:
    """Return the file that keeps the outcome of a record; batch: the name of that which it is made in, if any."""
    return results / KEPT / "outcomes" / (f"{batch}.zip" if batch else f"{record}.json")


def cases_of(results: Path, record: str) -> Path:
    """Return the file that keeps the results of the cases of a record, for the next run."""
    return results / CASES / f"{record}.json"


def case_timings_of(results: Path, record: str) -> Path:
    """Return the file that keeps how long those results took, beside the other measurements of a run."""
    return results / "summary" / "benchmarks" / "cases" / f"{record}.json"


def former_files(settings: Settings, products: Iterable[str], records: Iterable[str]) -> list[Path]:
    """Return the files in the folder of the results that a product of a study may have, but none of `products` has.

    records: those whose cases are kept. A file of another name is the user's.
    """
    results = Path(settings.results)
    products = tuple(products)
    owned = {path for product in products for path in outputs_of(product, settings).values()}
    owned |= {results / log_of(product) for product in products}
    for record in records:
        owned |= {cases_of(results, record), case_timings_of(results, record)}
    return [
        path
        for path in sorted(results.rglob("*"))
        if path.is_file() and not (owned & {path, *path.parents}) and _may_be_ours(path.relative_to(results))
    ]


def _may_be_ours(path: Path) -> bool:
    """Whether a product of a study can have a file of this path, from the folder of the results."""
    for pattern in _names():
        if (found := pattern.fullmatch(path.as_posix())) and all(map(is_safe_id, found.groups())):
            return True
    return False


@cache
def _names() -> tuple[re.Pattern[str], ...]:
    """The paths of all files that products of a study can have.

    A group holds the name of a record or of a batch.
    """
    outputs = [output for of_kind in OUTPUTS.values() for output in of_kind]
    paths = [output.path for output in outputs]
    paths += [log_of(f"{kind}/{{name}}") for kind in ("record", "batch", "records", "batches")]
    paths += [log_of(kind) for kind in OUTPUTS]
    paths.append(case_timings_of(Path(), "{name}").as_posix())
    name = re.escape("{name}")
    return tuple(re.compile(re.escape(path).replace(name, "([^/]+)")) for path in paths)


def remove(results: Path, files: Iterable[Path]) -> None:
    """Remove `files`, and the folders in `results` that are then empty."""
    for file in files:
        file.unlink(missing_ok=True)
        for folder in file.parents:
            if folder == results or any(folder.iterdir()):
                break
            folder.rmdir()
