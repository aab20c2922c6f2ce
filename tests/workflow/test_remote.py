"""A study on machines that share no file system: each job in an empty folder, with its sources and declared inputs."""

import shutil
import stat
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
import yaml

from rocking.study.flow import OWN_SNAKEFILE
from tests.workflow.conftest import ROOT, STRUCTURES, SmallStudy

pytestmark = [
    pytest.mark.process,
    pytest.mark.skipif(
        not all(map(find_spec, ("snakemake_executor_plugin_cluster_generic", "snakemake_storage_plugin_fs")))
        or not shutil.which("rsync")
        or not shutil.which("git"),
        reason="the plug-ins cluster-generic and fs of development.lock, rsync or git are not installed",
    ),
]
SUBMIT = """#!/bin/sh
# The job runs in a new folder, which holds nothing; its identifier is that folder.
PATH={python}:$PATH
export PATH
node=$(mktemp -d {nodes}/XXXXXX)
cp "$1" "$node.sh"
(cd "$node" && sh "$node.sh" > "$node.log" 2>&1; echo $? > "$node.status") < /dev/null > /dev/null 2>&1 &
echo "$node"
"""
STATUS = """#!/bin/sh
if [ ! -f "$1.status" ]; then echo running
elif [ "$(cat "$1.status")" = 0 ]; then echo success
else echo failed
fi
"""


class Machines:
    """A queue of machines, and the storage through which files go to them and come back."""

    def __init__(self, folder: Path) -> None:
        self.storage = folder / "storage"
        self.nodes = folder / "nodes"
        self.nodes.mkdir(parents=True)
        self._scripts = folder
        for name, text in {"submit": SUBMIT, "status": STATUS}.items():
            script = folder / name
            python = str(Path(sys.executable).parent)
            script.write_text(text.replace("{nodes}", str(self.nodes)).replace("{python}", python))
            script.chmod(script.stat().st_mode | stat.S_IEXEC)

    def run(self, study: SmallStudy, *options: str) -> str:
        """Run the study, whose files are in the storage, by its own Snakefile; what snakemake says."""
        command = [
            *(sys.executable, "-m", "snakemake", "--executor", "cluster-generic", "--jobs", "4", "--nocolor"),
            *("--cluster-generic-submit-cmd", str(self._scripts / "submit")),
            *("--cluster-generic-status-cmd", str(self._scripts / "status")),
            *("--shared-fs-usage", "none", "--job-deploy-sources", "--seconds-between-status-checks", "1"),
            *("--default-storage-provider", "fs", "--default-storage-prefix", str(self.storage)),
            *options,
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=False, **study.surroundings)
        told = done.stdout + done.stderr
        logs = "".join(log.read_text() for log in sorted(self.nodes.glob("*.log")))
        assert done.returncode == 0, told + logs
        return told


def _by_git(study: SmallStudy) -> None:
    """Put what a plan reads under git, and not the records: sources are the files that git names."""
    (study.folder / "Snakefile").write_text(OWN_SNAKEFILE)
    (study.folder / ".gitignore").write_text(
        "results\n.snakemake\nrecords/*.txt\nrecords/*.V2A\nrecords/*.AT2\n"
    )
    for command in (["init", "--quiet"], ["add", "--all"]):
        subprocess.run(["git", *command], cwd=study.folder, check=True)


def _to_storage(study: SmallStudy, machines: Machines, names: tuple[str, ...]) -> None:
    for name in names:
        source, target = study.folder / name, machines.storage / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if source.is_dir() else shutil.copy)(source, target)


def _compared(study: SmallStudy, machines: Machines) -> None:
    """Every table of the storage is that of a run in which all files lie beside each other."""
    study.run()
    local = study.tables()
    remote = SmallStudy(machines.storage, study.tree).tables()
    assert local and sorted(local) == sorted(remote)
    assert [name for name in local if local[name] != remote[name]] == []


@pytest.mark.slow
def test_jobs_that_share_no_folder_make_the_same_tables(start, tmp_path: Path) -> None:
    """Every file that a job reads is an input of its rule: those of the record, the list, a curve, the design level."""
    study = SmallStudy(start.copy_to(tmp_path / "study").folder, ROOT)
    study.write_catalogue(study.rows()[:1])
    tower = {
        "name": "tower",
        "type": "capacity_curve",
        "file": "push.csv",
        "weight_kN": 100,
        "restitution": 0.9,
    }
    (study.folder / "structures.yaml").write_text(yaml.safe_dump([STRUCTURES[0], tower]))
    (study.folder / "push.csv").write_text("displacement_m,force_kN\n0,10\n0.1,8\n0.5,0\n")
    (study.folder / "records" / "layouts.csv").write_text("answer\n")
    (study.folder / "design.csv").write_text("period_s,acceleration_g\n0,0.2\n0.1,0.5\n0.5,0.5\n4,0.06\n")
    settings = {
        "ensemble": {"members": 16, "reserve": 0},
        "processing_variants": False,
        "design_spectrum": {"points": "design.csv"},
        "checks": {"stations": 1},
    }
    (study.folder / "config.yaml").write_text(yaml.safe_dump(settings))
    _by_git(study)
    machines = Machines(tmp_path / "machines")
    _to_storage(study, machines, ("records", "structures.yaml", "design.csv", "push.csv"))
    machines.run(study)
    assert not study.results.exists(), "nothing was made in the folder of the study"
    assert "report" not in machines.run(study, "-n").partition("Job stats:")[2].partition("total")[0]
    _compared(study, machines)
