"""A job in a process of its own ends as its function ends, and the error says whose it was and what ended it."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.process

RUN = "import sys\nfrom rocking.study.apart import run_apart\nfrom rocking.study.settings import Settings\n"
WARM = f"{RUN}from rocking.study.apart import warm_up\nwarm_up(Settings())\n"


def python(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False
    )


def test_an_end_that_is_none_is_an_error_which_names_the_cause(tmp_path: Path) -> None:
    """All are forked from one process, as starting that takes seconds."""
    ends = {
        ("os:_exit", 3): "its process ended with status 3",
        ("sys:exit", 4): "its process ended with status 1",
        (
            "signal:raise_signal",
            int(signal.SIGKILL),
        ): "its process was ended by SIGKILL, as a system does that",
        ("signal:raise_signal", int(signal.SIGTERM)): "its process ended with status 1",
        ("math:sqrt", -1): "its process ended with status 1",
    }
    done = python(
        f"{RUN}for work in {list(ends)}:\n"
        f"    try: run_apart(Settings(), {str(tmp_path / 'log')!r}, *work)\n"
        "    except RuntimeError as error: print(error)"
    )
    said = done.stdout.splitlines()[-len(ends) :]  # the first on a machine also says that it compiled
    assert len(said) == len(ends) and all(map(str.startswith, said, ends.values())), said
    told = [line.partition(":")[0] for line in done.stderr.splitlines()]
    assert told == ["SystemExit", "KeyboardInterrupt", "ValueError"], "a request to end is as Ctrl-C"


def test_jobs_run_side_by_side_with_all_imported_and_print_into_their_logs(tmp_path: Path) -> None:
    """Each waits for the other, and is the child of the process that has imported."""
    job = (
        "import os, sys, time; from pathlib import Path; own, other = map(Path, {names!r}); own.touch()\n"
        "while not other.exists(): time.sleep(.01)\n"
        "print('rocking.study.summary' in sys.modules, os.environ['OMP_NUM_THREADS'], os.getppid())"
    )
    names = str(tmp_path / "1"), str(tmp_path / "2")
    jobs = [job.format(names=names), job.format(names=names[::-1])]
    logs = [str(tmp_path / name) for name in ("1.log", "2.log")]
    done = python(
        f"{WARM}import os\nfrom threading import Thread\n"
        f"starts = [(Settings(), log, 'builtins:exec', job) for log, job in zip({logs!r}, {jobs!r})]\n"
        "threads = [Thread(target=run_apart, args=start) for start in starts]\n"
        "for thread in threads: thread.start()\n"
        "for thread in threads: thread.join()\n"
        "print(os.getpid())"
    )
    assert not done.stderr
    for log in logs:
        warm, threads, parent = Path(log).read_text().split()
        assert warm == "True" and threads == "1" and parent != done.stdout.strip()


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_the_process_that_jobs_are_forked_from_ends_with_its_scheduler(number: int) -> None:
    code = f"{WARM}import time\nprint(flush=True)\ntime.sleep(60)"
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, start_new_session=True
    ) as scheduler:
        scheduler.stdout.readline()
        scheduler.send_signal(number)
        scheduler.wait()
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        try:
            os.killpg(scheduler.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    pytest.fail("it is still there")
