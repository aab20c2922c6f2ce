"""What a user does apart from the workflow: start a study, catalogue a folder, assess a single file."""

import csv
import io
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from rocking import columns, rows
from rocking.comparison import Assessment, AssessmentSettings, Case, Method, assess
from rocking.errors import ConfigurationError
from rocking.records import Accelerogram
from rocking.records.catalogue_from_folder import catalogue_from_folder
from rocking.records.catalogue_from_folder import write_catalogue as write_rows
from rocking.structures import load_structures
from rocking.summary import structure_rows
from rocking.tables import csv_cells, write_whole


def workflow_folder() -> Path:
    """Return the folder that holds Snakefile and workflow/: inside an installed package, or the clone."""
    package = Path(__file__).parent
    return package / "study" if (package / "study" / "Snakefile").is_file() else package.parent


def start(folder: Path) -> list[Path]:
    """Write config.yaml, structures.yaml and records/ into `folder` and return what was written.

    Raises ConfigurationError, before anything is written, when one of them stands there already.
    """
    workflow = workflow_folder() / "workflow"
    config = (workflow / "config.yaml").read_text(encoding="utf-8")
    contents = {
        folder / "config.yaml": config.replace("workflow/structures.yaml  ", "structures.yaml           "),
        folder / "structures.yaml": (workflow / "structures.yaml").read_text(encoding="utf-8"),
    }
    for path in contents:
        if path.exists():
            raise ConfigurationError(f"{path} exists already; choose another folder or remove it first.")
    for path, content in contents.items():
        write_whole(path, content.encode())
    (folder / "records").mkdir(exist_ok=True)
    return [*contents, folder / "records"]


def run(folder: Path, options: Sequence[str]) -> int:
    """Run the workflow on the study in `folder` and return its exit status."""
    if not (folder / "config.yaml").is_file():
        raise ConfigurationError(
            f"{folder} holds no config.yaml; start a study there first: rocking start {folder}"
        )
    snakefile, config = workflow_folder() / "Snakefile", (folder / "config.yaml").resolve()
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(snakefile), "--directory", str(folder)]
    cores = (
        []
        if any(option.startswith(("--cores", "-c", "-j", "--jobs")) for option in options)
        else ["--cores", "all"]
    )
    return subprocess.run([*command, "--configfile", str(config), *cores, *options], check=False).returncode


def write_catalogue(folder: Path, target: Path) -> tuple[int, list[tuple[str, str]]]:
    """Write a catalogue of the accelerograms in `folder` to `target`; return their number and what was not read."""
    found, unread = catalogue_from_folder(folder)
    write_rows(found, target)
    return len(found), unread


def assess_file(
    accelerograms: Sequence[Accelerogram], structures: Path, name: str | None, with_report: bool
) -> tuple[list[str], bytes]:
    """Assess the structure `name` (None: all) of a list under one file; return lines of text and, if asked, a PDF."""
    chosen = load_structures(structures)
    if name is not None and name not in chosen:
        raise ConfigurationError(f"structure is {name!r}, but {structures} lists {', '.join(chosen)}.")
    chosen = chosen if name is None else {name: chosen[name]}
    settings = AssessmentSettings()
    assessments = [assess(accelerogram, chosen, settings) for accelerogram in accelerograms]
    lines = [line for assessment in assessments for line in _lines(assessment)]
    return lines, _report(assessments, chosen, settings) if with_report else b""


def _lines(assessment: Assessment) -> list[str]:
    accelerogram = assessment.accelerogram
    head = f"component {accelerogram.component or 'not named'}, scale {accelerogram.scale_factor:g}"
    failed = [f"  {failure.structure or 'pulse'}: {failure.message}" for failure in assessment.failures]
    return [head, *(_line(case) for case in assessment.cases), *failed]


def _line(case: Case) -> str:
    response = case.responses[Method.MECHANISM_ON_RECORD]
    text = f"  {case.structure}: {response.outcome.value}, largest rotation {response.rotation_ratio:.4g} of critical"
    if case.prediction is not None:
        maximum = case.prediction.maximum
        text += f"; one pulse predicts {maximum.rotation_ratio:.4g} ({maximum.regime.value})"
        text += f", light {case.prediction.light.value}"
    return text + ("; FRAGILE: a change of 1 % flips the verdict" if response.fragile else "")


def _report(assessments: Sequence[Assessment], structures, settings: AssessmentSettings) -> bytes:
    from rocking.reports import record_report

    tables: dict[str, list[dict[str, str]]] = {table.name: [] for table in columns.RECORD_TABLES}
    accelerograms = [assessment.accelerogram for assessment in assessments]
    name = Path(accelerograms[0].source.path).stem or "record"
    for assessment in assessments:
        made = rows.all_rows(name, assessment, settings.acceleration_scale, "", "")
        for table in columns.RECORD_TABLES:
            tables[table.name] += [csv_cells(table, row) for row in made[table.name]]
    tables["structures"] = [csv_cells(columns.STRUCTURES, row) for row in structure_rows(structures)]
    shown = {
        "tolerance": settings.tolerance,
        "acceleration_scale": settings.acceleration_scale,
        "fragility_change": settings.fragility_change,
    }
    return record_report(name, accelerograms, structures, tables, shown)


def write_spectrum(accelerograms: Sequence[Accelerogram], restitution: float, target: Path) -> None:
    """Write the rocking spectrum of each component to `target` as rows of p, λ and rotation ratio."""
    from rocking.spectrum import rocking_spectrum

    frequency_parameters = np.geomspace(0.5, 10, 40)
    uplift_multipliers = np.geomspace(0.02, 1, 40)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["component", "frequency_parameter_rad_s", "uplift_multiplier", "rotation_ratio"])
    for accelerogram in accelerograms:
        ratios = rocking_spectrum(accelerogram, frequency_parameters, uplift_multipliers, restitution)
        for p, row in zip(frequency_parameters.tolist(), ratios.tolist(), strict=True):
            for multiplier, value in zip(uplift_multipliers.tolist(), row, strict=True):
                writer.writerow([accelerogram.component, p, multiplier, value])
    write_whole(target, stream.getvalue().encode())
