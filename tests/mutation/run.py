"""Mutate a sample of a group's code, run the group's tests on each mutant, and list those that no test notices.

    python tests/mutation/run.py FOLDER [GROUP ...] [--again]

works in FOLDER, on a clone of the last commit, and prints counts and the survivors' diffs. --again runs only the
survivors of the last run in FOLDER, with the tests of the present commit. It needs the extra `mutation`.
"""

import argparse
import importlib
import os
import random
import resource
import shutil
import signal
import socket
import subprocess
import sys
import time
import tomllib
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from os import environ
from pathlib import Path
from typing import NoReturn

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
GROUPS = tomllib.loads((HERE / "groups.toml").read_text(encoding="utf-8"))
SEED = 1
PATIENCE = 1800
"""s of the clock for a mutant; what ends an endless loop is the group's limit of CPU time."""

LATE = "TIME-OUT"
LIBRARIES = ("numpy.testing", "scipy.integrate", "scipy.optimize", "scipy.signal", "numba", "mpmath", "yaml")

ARITHMETIC = ("Add", "Sub", "Mul", "Div")
NONSENSE = ("Is", "IsNot", "Invert", "Not")
PASSED_OVER = ("RemoveDecorator", "VariableReplacer", "VariableInserter")


def sensible(operator: str) -> bool:
    """Whether an operator makes mistakes that one makes: no `is` for `<`, no `<<` for `+`, no lost decorator."""
    name = operator.removeprefix("core/")
    kind, _, change = name.partition("_")
    if kind == "ReplaceBinaryOperator":
        old, new = change.split("_")
        return new in ARITHMETIC and old in (*ARITHMETIC, "FloorDiv", "Mod", "Pow")
    if kind in ("ReplaceComparisonOperator", "ReplaceUnaryOperator"):
        return not set(change.split("_")) & set(NONSENSE) or change == "Delete_Not"
    return name not in PASSED_OVER


def key(item) -> tuple[str, str, int]:
    mutation = item.mutations[0]
    return str(mutation.module_path), mutation.operator_name, mutation.occurrence


def session_of(folder: Path, group: str) -> Path:
    return folder / f"{group}.sqlite"


class Collected(list):
    """What cosmic-ray takes for its database when it lists all mutants: writing ten thousand takes a minute."""

    def add_work_items(self, items: Iterable) -> None:
        self.extend(items)


def prepare(folder: Path, group: str, survivors: set | None) -> None:
    """Write the session: of all mutants the sample, or the given ones."""
    from cosmic_ray.commands import init
    from cosmic_ray.work_db import use_db

    asked = GROUPS[group]
    modules = sorted(path for pattern in asked["modules"] for path in (folder / "tree").glob(pattern))
    paths = [path.relative_to(folder / "tree") for path in modules]
    every = Collected()
    init(paths, every, {})
    possible = sorted((item for item in every if sensible(item.mutations[0].operator_name)), key=key)
    chosen = random.Random(SEED).sample(possible, min(asked["sample"], len(possible)))
    if survivors is not None:
        chosen = [item for item in possible if key(item) in survivors]
    with use_db(session_of(folder, group)) as session:
        session.add_work_items(chosen)
    print(f"{group}: {len(possible)} possible mutants, {len(chosen)} to run", flush=True)


def survivors_of(folder: Path, group: str) -> set:
    from cosmic_ray.work_db import use_db

    with use_db(session_of(folder, group)) as session:
        return {key(i) for i, result in session.completed_work_items if result.test_outcome == "survived"}


def execute(folder: Path, group: str) -> None:
    """Run the tests on each mutant of the session, in the clone."""
    config = folder / f"{group}.toml"
    command = f"{sys.executable} {HERE / 'run.py'} {folder} {group} --one"
    config.write_text(
        f"[cosmic-ray]\nmodule-path = []\ntimeout = {PATIENCE}.0\nexcluded-modules = []\n"
        f'test-command = "{command}"\n[cosmic-ray.distributor]\nname = "local"\n'
    )
    cosmic_ray = str(Path(sys.executable).with_name("cosmic-ray"))
    subprocess.run([cosmic_ray, "exec", config, session_of(folder, group)], cwd=folder / "tree", check=True)


@contextmanager
def tester(folder: Path, group: str) -> Iterator[None]:
    """Keep a process that has the libraries imported, and forks for each mutant: half the cost of a quick test."""
    surroundings = environ | {
        "NUMBA_DISABLE_JIT": str(int(GROUPS[group]["interpreted"])),
        "NUMBA_CACHE_DIR": str(folder / "numba"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    python = environ.get("ROCKING_PYTHON", sys.executable)
    command = [python, str(HERE / "run.py"), str(folder), group, "--serve"]
    with subprocess.Popen(command, cwd=folder / "tree", env=surroundings) as process:
        try:
            yield
        finally:
            process.terminate()


def serve(folder: Path, group: str) -> None:
    """Fork at each connection, and answer with the output of the tests and, last, their status."""
    for library in LIBRARIES:
        importlib.import_module(library)
    place = folder / f"{group}.socket"
    place.unlink(missing_ok=True)
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(place))
        listening.listen()
        while True:
            connection = listening.accept()[0]
            child = os.fork()
            if child == 0:
                test(folder / "tree", group, connection)
            status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
            late = status in (-signal.SIGXCPU, -signal.SIGKILL)
            connection.sendall(f"\n{LATE if late else ''}\n{status}".encode())
            connection.close()


def test(tree: Path, group: str, output: socket.socket) -> NoReturn:
    """Run the group's tests in this process, which has imported nothing of the package yet, and end it."""
    import pytest

    warnings.simplefilter("ignore")  # that some libraries are imported already
    asked = GROUPS[group]
    limit = asked["cpu_seconds"]
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
    os.dup2(output.fileno(), 1)
    os.dup2(output.fileno(), 2)
    sys.path.insert(0, str(tree))
    # Plain Python divides as numpy does in compiled code, but warns.
    quiet = ["-W", "ignore::RuntimeWarning"] if asked["interpreted"] else []
    status = pytest.main(["-qx", "-m", "not slow", *quiet, *asked["tests"]])
    sys.stdout.flush()
    os._exit(status)


def ask(folder: Path, group: str) -> int:
    """Have the tests run on the tree as it stands, compiled afresh; print what they say and return their status."""
    for module in (path for pattern in GROUPS[group]["modules"] for path in (folder / "tree").glob(pattern)):
        for compiled in (folder / "numba").glob(f"*/{module.stem}.*"):
            compiled.unlink()
    with socket.socket(socket.AF_UNIX) as connection:
        until = time.monotonic() + PATIENCE
        while connection.connect_ex(
            str(folder / f"{group}.socket")
        ):  # the libraries are still being imported
            if time.monotonic() > until:
                raise SystemExit("the process that runs the tests did not start; see what it said")
            time.sleep(0.5)
        told = connection.makefile("rb").read().decode(errors="replace")
    print(told[-5000:])
    return int(told.rpartition("\n")[2] != "0")


def tell(folder: Path, group: str) -> None:
    from cosmic_ray.work_db import use_db

    with use_db(session_of(folder, group)) as session:
        done = [(i, r) for i, r in session.completed_work_items if r.worker_outcome == "normal"]
    survived = [(item, result) for item, result in done if result.test_outcome == "survived"]
    late = sum(LATE in result.output or result.output == "timeout" for _, result in done)
    killed = len(done) - len(survived) - late
    print(f"{group}: {len(done)} run, {killed} killed, {late} timed out, {len(survived)} survived")
    for item, result in survived:
        print(f"\n{item.mutations[0].operator_name} in {item.mutations[0].definition_name}\n{result.diff}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("groups", nargs="*", default=list(GROUPS))
    for flag in ("--again", "--tell", "--one", "--serve"):
        parser.add_argument(flag, action="store_true")
    options = parser.parse_args()
    folder = options.folder.resolve()
    if options.one:
        return ask(folder, options.groups[0])
    if options.serve:
        serve(folder, options.groups[0])
    folder.mkdir(parents=True, exist_ok=True)
    for group in options.groups:
        if not options.tell:
            survivors = survivors_of(folder, group) if options.again else None
            shutil.rmtree(folder / "tree", ignore_errors=True)
            subprocess.run(["git", "clone", "--quiet", ROOT, folder / "tree"], check=True)
            session_of(folder, group).unlink(missing_ok=True)
            prepare(folder, group, survivors)
            with tester(folder, group):
                if ask(folder, group):
                    raise SystemExit(f"{group}: its tests fail on the code as it is")
                execute(folder, group)
        tell(folder, group)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
