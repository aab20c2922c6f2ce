"""Starts of snakemake without its imports, which take longer than all else that a small study does in that process."""

import atexit
import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

_TIMEOUT_S = 900
PLANNING = (
    "rocking.study.run",
    "rocking.study.plan",
    "rocking.study.apart",
    "scipy.optimize",
    "pandas",
    "smart_open",
)
"""What a plan alone imports besides snakemake."""


def _serve(*modules: str) -> None:
    """Answer each line of a request by the exit status of a child that is a fork of this process.

    What is imported here is snakemake, with its plugins, and `modules`; no library with threads.
    """
    import importlib

    import snakemake.cli

    snakemake.cli.get_argument_parser()  # which imports every plugin
    for module in modules:
        importlib.import_module(module)
    for line in sys.stdin:
        request = json.loads(line)
        child = os.fork()
        if not child:
            _become(**request)
        _, status = os.waitpid(child, 0)
        print(os.waitstatus_to_exitcode(status), flush=True)


def _become(arguments: list[str], cwd: str, env: dict[str, str], output: str) -> None:
    """Run `python -m snakemake` with these arguments in this process, which ends by that."""
    import runpy
    import signal

    signal.alarm(_TIMEOUT_S)
    for descriptor, (path, mode) in enumerate([(os.devnull, os.O_RDONLY), (output, os.O_WRONLY)]):
        opened = os.open(path, mode)
        os.dup2(opened, descriptor)
        os.close(opened)
    os.dup2(1, 2)
    os.chdir(cwd)
    os.environ.clear()
    os.environ.update(env)
    # As `python -m` has it: the folder it stands in, then PYTHONPATH.
    sys.path[:0] = [cwd, *filter(None, env.get("PYTHONPATH", "").split(os.pathsep))]
    sys.argv = ["snakemake", *arguments]
    runpy.run_module("snakemake", run_name="__main__", alter_sys=True)
    sys.exit(0)


@cache
def _server(modules: tuple[str, ...]) -> subprocess.Popen[str]:
    """The process that is forked, of which each worker has one for some `modules`; it ends with its standard input."""
    names = ", ".join(map(repr, modules))
    command = [sys.executable, "-c", f"from tests.workflow.forked import _serve; _serve({names})"]
    root = Path(__file__).parents[2]
    # Not by the folder it stands in, which a test may have closed (PYTHONSAFEPATH).
    surroundings = os.environ | {"PYTHONPATH": str(root), "OPENBLAS_NUM_THREADS": "1"}
    streams = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    server = subprocess.Popen(command, cwd=root, env=surroundings, start_new_session=True, **streams)
    atexit.register(server.communicate)
    return server


def run_snakemake(
    arguments: Sequence[str],
    output: Path,
    *,
    cwd: Path,
    env: Mapping[str, str],
    modules: tuple[str, ...] = (),
) -> tuple[int, str]:
    """Return exit status and text (output and errors) of snakemake with `arguments`.

    output: a new file, which keeps the text. modules: of this project, whose workflow is not that of an edited copy,
    that are imported already.
    """
    server = _server(modules)
    output.touch()
    request = {"arguments": list(arguments), "cwd": str(cwd), "env": dict(env), "output": str(output)}
    server.stdin.write(json.dumps(request) + "\n")
    server.stdin.flush()
    return int(server.stdout.readline()), output.read_text(encoding="utf-8")
