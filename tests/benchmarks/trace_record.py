"""Print which files and functions of the package the job of one record enters, in their order: no limit, only to read.

    python tests/benchmarks/trace_record.py

Snakemake starts `workflow/scripts/record.py` as in a study, on one record and one wall, with every document. What a
process does as it imports is left out, and lambdas and comprehensions are no functions to jump to.
"""

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.workflow.write_study import write_study  # noqa: E402

_IN_THE_JOB = """
import atexit, sys

entered = {}

def imports(frame):
    while frame is not None:
        if "importlib" in frame.f_code.co_filename:
            return True
        frame = frame.f_back
    return False

def note(frame, event, _):
    code = frame.f_code
    if event != "call" or not code.co_filename.startswith(PACKAGE) or code.co_name.startswith("<"):
        return
    if code not in entered and not imports(frame):
        entered[code] = code.co_filename[len(PACKAGE) + 1:]

def write():
    sys.setprofile(None)
    with open(TRACE, "w", encoding="utf-8") as stream:
        for file in dict.fromkeys(entered.values()):
            functions = [f"    {code.co_qualname}\\n" for code, place in entered.items() if place == file]
            stream.write("".join([file, "\\n", *functions]))

if sys.orig_argv[-1].endswith("record.py"):
    sys.setprofile(note)
    atexit.register(write)
"""
"""What Python runs first, as `sitecustomize`, in each process that snakemake starts."""


def traced(folder: Path) -> str:
    """Return the files of the package that the job enters, each with its functions on the lines below it.

    folder: an empty one. Raises CalledProcessError where the job does not finish.
    """
    study = folder / "study"
    write_study(study, records=1)
    (study / "structures.yaml").write_text(
        "- {name: wall, type: wall, height_m: 3.2, thickness_m: 0.25}\n", encoding="utf-8"
    )
    settings = yaml.safe_load((study / "config.yaml").read_text(encoding="utf-8"))
    (study / "config.yaml").write_text(yaml.safe_dump(settings | {"reports": True}), encoding="utf-8")
    trace = folder / "trace.txt"
    places = f"PACKAGE = {str(ROOT / 'rocking')!r}\nTRACE = {str(trace)!r}\n"
    (folder / "sitecustomize.py").write_text(places + _IN_THE_JOB, encoding="utf-8")
    report = f"{settings['results']}/synthetic_00000/report.pdf"
    subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1", "--directory", study, "--configfile",
         study / "config.yaml", "--snakefile", ROOT / "Snakefile", "--quiet", "all", "--", report],
        # No server answers by this name, so that the process that is started does the work itself.
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)]), "ROCKING_FORK_SERVER": "-"},
        cwd=study,
        check=True,
    )  # fmt: skip
    return trace.read_text(encoding="utf-8")


if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        lines = traced(Path(folder)).splitlines()
    functions = [line for line in lines if line.startswith(" ")]
    print(*lines, f"{len(lines) - len(functions)} files, {len(functions)} functions", sep="\n")
