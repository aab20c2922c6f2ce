"""A script that is handed over to the fork server does what it would do in a process of its own."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.process

ADDRESS = "ROCKING_FORK_SERVER"
START = "from rocking.study.fork_server import start\nfrom rocking.study.settings import Settings\nstart(Settings())\n"
HANDED = "from rocking.study.fork_server import hand_over\nhand_over()\n"
SCRIPTS = {
    "print('one'); print('two', file=sys.stderr)": 0,
    "print(os.getcwd(), sys.argv[1:], os.environ['OF_THE_JOB'], __name__, sys.stdin.read())": 0,
    "sys.exit(3)": 3,
    "sys.exit('why not')": 1,
    "1 / 0": 1,
    "print('begun', flush=True); os.kill(os.getpid(), signal.SIGKILL)": -signal.SIGKILL,
    "signal.signal(signal.SIGINT, signal.default_int_handler); os.kill(os.getpid(), signal.SIGTERM)": -signal.SIGTERM,
    "print(len(subprocess.run(['ls', '/'], capture_output=True, check=True).stdout) > 0)": 0,
}


@pytest.fixture(scope="module")
def server():
    """A process that has started a server, as a scheduler does; gives the environment of its jobs."""
    code = f"{START}import json, os, sys\nprint(json.dumps(dict(os.environ)), flush=True)\nsys.stdin.read()"
    streams = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen([sys.executable, "-c", code], **streams) as scheduler:
        environment = json.loads(scheduler.stdout.readline())
        if ADDRESS not in environment:
            scheduler.communicate()
            pytest.skip("a fork server takes Linux with pidfd_open")
        yield environment
        scheduler.stdin.close()


def run(script: Path, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, str(script), "a", "b"],
        env=environment | {"OF_THE_JOB": "é"},
        cwd=script.parent,
        input="typed",
        capture_output=True,
        text=True,
        timeout=60,
    )


@pytest.mark.parametrize("code", SCRIPTS)
def test_a_script_ends_as_by_itself(server, tmp_path: Path, code: str) -> None:
    imports = "import os, signal, subprocess, sys\n"
    script = tmp_path / "script.py"
    script.write_text(imports + HANDED + code, encoding="utf-8")
    alone = run(script, {name: value for name, value in server.items() if name != ADDRESS})
    handed = run(script, server)
    assert alone.returncode == handed.returncode == SCRIPTS[code]
    assert handed.stdout == alone.stdout
    assert alone.stderr.splitlines()[-1:] == handed.stderr.splitlines()[-1:]


def test_it_runs_in_a_fork_that_has_imported_what_jobs_need(server, tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(f"import os, sys\n{HANDED}print('rocking.study.summary' in sys.modules, os.getpid())")
    with subprocess.Popen([sys.executable, script], env=server, stdout=subprocess.PIPE, text=True) as client:
        has_imported, process = client.communicate()[0].split()
    assert has_imported == "True" and int(process) != client.pid


def test_jobs_run_side_by_side(server, tmp_path: Path) -> None:
    """Each waits for the other."""
    script = tmp_path / "script.py"
    script.write_text(
        f"import sys, time\nfrom pathlib import Path\n{HANDED}"
        "own, other = (Path(each) for each in sys.argv[1:])\nown.touch()\n"
        "while not other.exists():\n    time.sleep(.01)\n"
    )
    files = [str(tmp_path / "1"), str(tmp_path / "2")]
    jobs = [
        subprocess.Popen([sys.executable, script, *each], env=server)
        for each in (files, list(reversed(files)))
    ]
    assert [each.wait(60) for each in jobs] == [0, 0]


def test_without_a_server_a_script_runs_by_itself(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(f"import os\n{HANDED}print(os.getpid())")
    for address in ({}, {ADDRESS: "rocking-nobody"}):
        command = subprocess.Popen(
            [sys.executable, script], env=os.environ | address, stdout=subprocess.PIPE, text=True
        )
        assert int(command.communicate()[0]) == command.pid


def test_where_the_server_ends_before_it_forks_a_script_runs_by_itself(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(f"import os\n{HANDED}print(os.getpid())")
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as listener:
        listener.bind("\0rocking-ends")
        listener.listen()
        command = subprocess.Popen(
            [sys.executable, script],
            env=os.environ | {ADDRESS: "rocking-ends"},
            stdout=subprocess.PIPE,
            text=True,
        )
        listener.accept()[0].close()
        assert int(command.communicate()[0]) == command.pid


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_the_server_ends_with_its_scheduler(number: int) -> None:
    code = f"{START}import time\nprint(flush=True)\ntime.sleep(60)"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as scheduler:
        scheduler.stdout.readline()
        children = Path(f"/proc/{scheduler.pid}/task/{scheduler.pid}/children")
        if not children.exists():
            pytest.skip("children are listed by Linux alone")
        (server,) = children.read_text().split()
        scheduler.send_signal(number)
        scheduler.wait()
    until = time.monotonic() + 30
    while (
        Path(f"/proc/{server}").exists() and "\nState:\tZ" not in Path(f"/proc/{server}/status").read_text()
    ):
        assert time.monotonic() < until
        time.sleep(0.05)
