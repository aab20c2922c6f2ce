"""The files of each rule of a study: the one table that says what a run writes, and when.

The rules declare these files as their output, all of them are targets of a study, and a file of such a name that no
rule of the study gives any more is removed.
"""

import re
from collections.abc import Iterable, Mapping
from operator import attrgetter
from pathlib import Path

from rocking.assessment.rows import (
    RECORD_TABLES,
    SUMMARY_TABLES,
    PredictionRow,
    PulseRow,
    RecordRow,
    TimingRow,
)
from rocking.catalogue.catalogue import NAME_OF_RECORD
from rocking.hashes import sha256_of_file
from rocking.study.product import KEPT, KEPT_ROWS, Output, draws
from rocking.study.products import PRODUCTS
from rocking.study.settings import Settings
from rocking.tables import Row

SUMS = "SHA256SUMS"
"""In the folder of the results: the hashes of the pages to sign and of the tables, for sha256sum -c."""


_reports = attrgetter("reports")


def _draws_reports(settings: Settings) -> bool:
    return settings.reports and draws(settings)


STEPS = ("read", "pulses", "predict", "integrate", "report")
"""The rules of a record, each of which takes up the files of all before it."""
TABLES: Mapping[str, tuple[type[Row], ...]] = {
    "read": (),
    "pulses": (RecordRow, PulseRow),
    "predict": (PredictionRow,),
    "integrate": (),
    "report": tuple(row_class for row_class in RECORD_TABLES if row_class not in (RecordRow, PulseRow)),
}
"""The tables of each step."""


def _tables(step: str) -> list[Output]:
    return [
        Output(f"{{record}}/{row_class.table.file_name}", is_measured=row_class is TimingRow)
        for row_class in TABLES[step]
    ]


def _times(step: str, is_store: bool = False) -> Output:
    return Output(_TIMES.format(step=step, record="{record}"), is_store=is_store)


_OUTCOME = f"{KEPT}/outcomes/{{record}}.json"
_TIMES = f"{KEPT}/times/{{step}}/{{record}}.json"
_STORES = {
    "pulses": "{record}/pulses.json",
    "predict": "{record}/predictions.json",
    "integrate": f"{KEPT}/cases/{{record}}.json",
}
"""The results of a step, by its name, which later steps and the next run look up."""
OUTPUTS: Mapping[str, tuple[Output, ...]] = {
    "read": (Output("{record}/motion.mseed"), Output("{record}/motion.json"), _times("read")),
    "pulses": (*_tables("pulses"), Output(_STORES["pulses"]), _times("pulses")),
    "predict": (*_tables("predict"), Output(_STORES["predict"]), _times("predict")),
    "integrate": (Output(_STORES["integrate"], is_store=True), _times("integrate", is_store=True)),
    "report": (
        *_tables("report"),
        Output("{record}/histories.csv", attrgetter("histories")),
        Output("{record}/report.pdf", _reports, label="report", category="Records"),
        Output("{record}/explore.js", _reports),
        Output("{record}/report_figures.zip", _draws_reports),
        Output(_OUTCOME),
    ),
    "summary": (
        *(
            Output(
                f"summary/{row_class.table.file_name}",
                is_measured=row_class is TimingRow,
                label=row_class.table.description,
                category="Tables",
            )
            for row_class in SUMMARY_TABLES
        ),
        Output("summary/summary.pdf", _reports, label="report on all records", category="Study"),
        Output(
            "summary/prediction_against_integration.svg",
            _reports,
            label="prediction against integration",
            category="Study",
        ),
        Output("summary/study.html", _reports, label="page to explore the study", category="Study"),
        Output("summary/study.xlsx", _reports),
        Output("summary/summary_figures.zip", _draws_reports),
        Output("summary/provenance.json"),
        Output("summary/datapackage.json"),
        Output(KEPT_ROWS.format(rule="summary")),
        Output(SUMS),
    ),
    **{product.name: product.outputs for product in PRODUCTS},
}
"""By the name of the rule."""


def outputs_of(rule: str, settings: Settings, record: str = "{record}") -> dict[Output, Path]:
    """Return the files of a rule that the settings ask for, those of a record by its name."""
    asked = (output for output in OUTPUTS[rule] if output.when(settings))
    return {output: Path(settings.results, output.path.replace("{record}", record)) for output in asked}


def sums_of(rule: str, settings: Settings, record: str = "") -> dict[str, str]:
    """Return the sha256 of the pages and the tables of a rule that exist, by their paths in the results.

    But for those of measured times, which differ between two runs of the same input.
    """
    results = Path(settings.results)
    outputs = outputs_of(rule, settings, record).items()
    paths = [path for output, path in outputs if path.suffix in (".csv", ".pdf") and not output.is_measured]
    return {path.relative_to(results).as_posix(): sha256_of_file(path) for path in paths if path.is_file()}


def log_of(rule: str, record: str = "") -> str:
    """Return the log of the job of a rule, from the folder of the results."""
    return f"summary/logs/{f'{rule}/{record}' if record else rule}.log"


def kept_of(results: Path, product: str) -> Path:
    """Return the file of what summary and terminal show of a product over all records, or of the summary."""
    return results / KEPT_ROWS.format(rule=product)


def outcome_of(results: Path, record: str) -> Path:
    """Return the file of the outcome of a record."""
    return results / _OUTCOME.format(record=record)


def store_of(results: Path, step: str, record: str) -> Path:
    """Return the file of the results of a step of a record."""
    return results / _STORES[step].format(record=record)


def times_of(results: Path, step: str, record: str) -> Path:
    """Return the file of how long those results took."""
    return results / _TIMES.format(step=step, record=record)


def former_files(settings: Settings, products: Iterable[str], records: Iterable[str]) -> list[Path]:
    """Return the files in the results that a rule may give, but none does for these products and records; also logs.

    A file of another name is the user's.
    """
    results = Path(settings.results)
    rules = {"summary", *products, *(product.name for product in PRODUCTS if product.stays)}
    owned = {path for rule in rules for path in outputs_of(rule, settings).values()}
    owned |= {results / log_of(rule) for rule in rules}
    for record in records:
        for step in STEPS:
            owned |= {*outputs_of(step, settings, record).values(), results / log_of(step, record)}
    return [
        path
        for path in sorted(results.rglob("*"))
        if path.is_file() and path not in owned and _may_be_ours(path.relative_to(results).as_posix())
    ]


def _may_be_ours(path: str) -> bool:
    """Whether a rule can give a file of this path, from the folder of the results."""
    names = [output.path for outputs in OUTPUTS.values() for output in outputs]
    names += [log_of(rule, "{record}" if rule in STEPS else "") for rule in OUTPUTS]
    patterns = (re.escape(name).replace(r"\{record\}", NAME_OF_RECORD) for name in names)
    return any(re.fullmatch(pattern, path) for pattern in patterns)


def remove(results: Path, files: Iterable[Path]) -> None:
    """Remove `files`, and the folders in `results` that are then empty."""
    for file in files:
        file.unlink(missing_ok=True)
        for folder in file.parents:
            if folder == results or any(folder.iterdir()):
                break
            folder.rmdir()
