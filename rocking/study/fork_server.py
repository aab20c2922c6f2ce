"""The fork server of a run: one process that has imported what every job needs, and from which each job is forked.

A job of one record would otherwise import libraries and load kernels for longer than it computes. Snakemake starts the
script of each job as it always does; the script hands itself over, waits, and ends as its fork ends. Where no server
answers (not on Linux, or a script started by hand), the script goes on by itself: nothing depends on the server.
"""

import atexit
import contextlib
import json
import os
import runpy
import secrets
import select
import signal
import socket
import struct
import subprocess
import sys
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from rocking.study.settings import Settings

_ADDRESS = "ROCKING_FORK_SERVER"
"""The variable of the environment that names the socket of the server, one without a file."""
_STATUS = struct.Struct("i")
_LENGTH = struct.Struct("q")
_BLAS_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""What snakemake sets to the threads of a job, 1; besides, a process with further threads must not be forked."""


def start(settings: "Settings") -> None:
    """Start the server of this process, unless there is one; it ends with this process, and prepares itself beside it.

    settings: of the study in this folder, whose structures it prepares.
    """
    try:  # Linux alone lets one wait for processes by these, and not each sandbox does
        os.close(os.pidfd_open(os.getpid()))
    except (AttributeError, OSError):
        return
    if _ADDRESS in os.environ:
        return
    # Not above: a script that is handed over imports this module, and is to begin at once.
    from rocking.study.settings import commented_yaml

    name = f"rocking-{secrets.token_hex(16)}"
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as listener:
        listener.bind(f"\0{name}")
        listener.listen(128)  # a job that comes before the server is ready waits here
        server = subprocess.Popen(
            [sys.executable, "-m", __name__, str(listener.fileno())],
            text=True,
            stdin=subprocess.PIPE,  # its end tells the server that this process has ended
            pass_fds=[listener.fileno()],
            env=os.environ | dict.fromkeys(_BLAS_THREADS, "1"),
        )
    with contextlib.suppress(OSError):
        server.stdin.write(f"{json.dumps(commented_yaml(settings))}\n")  # type: ignore[union-attr]
        server.stdin.flush()  # type: ignore[union-attr]
    os.environ[_ADDRESS] = name

    def end() -> None:
        server.terminate()  # it may still be importing
        server.communicate()

    atexit.register(end)


def leave() -> None:
    """Do without the server that the environment names, if any: it is that of another process."""
    os.environ.pop(_ADDRESS, None)


def hand_over() -> None:
    """Let a fork of the server run the script of this process, and end as it ends; return where there is no server."""
    if _ADDRESS not in os.environ:
        return
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    task = json.dumps([sys.argv, os.getcwd(), dict(os.environ)]).encode()
    try:
        connection.connect(f"\0{os.environ[_ADDRESS]}")
        socket.send_fds(connection, [_LENGTH.pack(len(task))], [0, 1, 2])
        connection.sendall(task)
        if not connection.recv(1):  # of the fork, once there is one
            return
    except OSError:
        return
    # Who stops the run tells the fork, and its end this process.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    try:
        (status,) = _STATUS.unpack(connection.recv(_STATUS.size, socket.MSG_WAITALL))
    except (OSError, struct.error):
        sys.exit("The process that jobs are forked from has ended; start the study again.")
    if status < 0:  # the number of a signal
        with contextlib.suppress(OSError):  # nobody changes what SIGKILL does
            signal.signal(-status, signal.SIG_DFL)
        os.kill(os.getpid(), -status)
    os._exit(status)


def serve(listener: socket.socket) -> None:
    """Fork a process for each task that comes to `listener`, until standard input ends, or the one that holds it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of a terminal; the scheduler tells whom it concerns
    _import_all()
    with contextlib.suppress(Exception):  # which every job tells that meets it
        _prepare(json.loads(sys.stdin.readline()))
    jobs: dict[int, tuple[int, socket.socket]] = {}
    while 0 not in (ready := select.select([0, listener.fileno(), *jobs], [], [])[0]):
        for ended in jobs.keys() & set(ready):
            process, connection = jobs.pop(ended)
            status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
            with connection, contextlib.suppress(OSError):
                connection.sendall(_STATUS.pack(status))
            os.close(ended)
        if listener.fileno() not in ready:
            continue
        connection, _ = listener.accept()
        peer = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i"))
        if struct.unpack("3i", peer)[1] != os.getuid():
            connection.close()
        elif process := os.fork():
            jobs[os.pidfd_open(process)] = process, connection
        else:
            listener.close()
            for held, (_, other) in jobs.items():
                os.close(held)
                other.close()
            _run(connection)


def _import_all() -> None:
    """Import and load what jobs need."""
    import snakemake.script  # noqa: F401

    import rocking.reports.design_figure
    import rocking.reports.explore
    import rocking.reports.printing
    import rocking.reports.record
    import rocking.study.checks
    import rocking.study.job
    import rocking.study.summary  # noqa: F401
    from rocking.assessment.compilation import load_all

    load_all()


def _prepare(settings: str) -> None:
    """Compute what the structures of a study with these settings, as YAML, need under every record."""
    import yaml

    from rocking.study.job import prepare
    from rocking.study.settings import read_settings

    prepare(read_settings(yaml.safe_load(settings)))


def _run(connection: socket.socket) -> NoReturn:
    """Run the script of a task in this process, as the one that handed it over would, and end."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    length, streams, *_ = socket.recv_fds(connection, _LENGTH.size, 3)
    (size,) = _LENGTH.unpack(length)
    task = connection.recv(size, socket.MSG_WAITALL)
    connection.sendall(b"\0")
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    sys.argv, folder, environment = json.loads(task)
    os.environ.clear()
    os.environ.update(environment)
    leave()
    os.chdir(folder)

    status = 0
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException as error:
        sys.excepthook(type(error), error, error.__traceback__)
        status = 1
    for text in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, AttributeError):  # a closed stream is None
            text.flush()
    os._exit(status)


if __name__ == "__main__":
    serve(socket.socket(fileno=int(sys.argv[1])))
