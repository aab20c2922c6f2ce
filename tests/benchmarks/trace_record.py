"""Print which files and functions of the package the job of one record enters, in their order: no limit, only to read.

    python tests/benchmarks/trace_record.py

The job is done as in a study, on one record and one wall, with every document, but in the process that starts it. What
a process does as it imports is left out, and lambdas and comprehensions are no functions to jump to.
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

_THE_JOB = """
import sys
from pathlib import Path

from rocking.study import jobs
from rocking.study.outputs import STEPS
from rocking.study.plan import check_config_file, make_plan

package, record = sys.argv[1:]
entered = {}

def imports(frame):
    while frame is not None:
        if "importlib" in frame.f_code.co_filename:
            return True
        frame = frame.f_back
    return False

def note(frame, event, _):
    code = frame.f_code
    if event != "call" or not code.co_filename.startswith(package) or code.co_name.startswith("<"):
        return
    if code not in entered and not imports(frame):
        entered[code] = code.co_filename[len(package) + 1:]

plan = make_plan(check_config_file(Path("config.yaml"))).of(record)
sys.setprofile(note)
for step in STEPS:
    jobs.run(step, plan, "record.log", 1, "")
sys.setprofile(None)
for file in dict.fromkeys(entered.values()):
    print(file, *(f"    {code.co_qualname}" for code, place in entered.items() if place == file), sep="\\n")
"""
"""What the process does that is traced; its arguments are the folder of the package and the product."""


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
    command = [sys.executable, "-c", _THE_JOB, str(ROOT / "rocking"), "synthetic_00000"]
    surroundings = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=study, env=surroundings, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        lines = traced(Path(folder)).splitlines()
    functions = [line for line in lines if line.startswith(" ")]
    print(*lines, f"{len(lines) - len(functions)} files, {len(functions)} functions", sep="\n")
