"""The compilation at the first use on a machine: everything that an assessment needs, in two processes."""

import contextlib
import fcntl
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np
from llvmlite import binding

from rocking.contacts.dynamics import follow_stack
from rocking.errors import RockingError
from rocking.hashes import sha256_of_bytes, sha256_of_sources
from rocking.motion import Members, integrate, integrate_batch, integrate_members
from rocking.motion.batch import rocking_spectrum
from rocking.motion.nonlinear_kernel import rock
from rocking.pulses import Pulse, extract_pulses
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.measures import response_spectrum
from rocking.signal.processing import Processing, process
from rocking.sine_pulse import overturning_amplitudes, predict_maxima, predict_maximum
from rocking.structures import Block, Spire

PARTS = ("contacts", "motion", "pulses", "sine_pulse")
"""The folders of the kernels."""
_PATIENCE = 3.0
"""Seconds from which on it is said how long it took, as what is compiled already is loaded in less."""


def compile_all() -> None:
    """Compile what filters, finds pulses, predicts, integrates and makes spectra, where that is not done already.

    Next to what numba keeps, a file for each processor names what was compiled; who finds it locked waits for the other
    process. Prints how long it took. Raises RockingError when it fails.
    """
    folder = Path(rock.stats.cache_path)
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / f"{_processor()}.compiled").open("a+", encoding="utf-8") as stamp:
        with contextlib.suppress(OSError):  # of a file system without locks
            fcntl.flock(stamp, fcntl.LOCK_EX)
        stamp.seek(0)
        if stamp.read() != (source := _source()):
            _compile()
            stamp.truncate(0)
            stamp.write(source)


def load_all() -> None:
    """Load what `compile_all` compiles, where it is compiled."""
    with contextlib.suppress(OSError):
        if (Path(rock.stats.cache_path) / f"{_processor()}.compiled").read_text(
            encoding="utf-8"
        ) == _source():
            compile_mechanisms()
            compile_blocks()


def _processor() -> str:
    """The processor and the Python for which numba keeps what it compiled."""
    features = sha256_of_bytes(binding.get_host_cpu_features().flatten().encode())
    return f"{binding.get_host_cpu_name()}-{features[:8]}.{sys.implementation.cache_tag}"


def _source() -> str:
    """One hash for numba and for what all files next to the kernels say."""
    package = Path(__file__).parents[1]
    files = [path for part in PARTS for path in (package / part).glob("*.py")]
    return sha256_of_sources(package, files, version("numba"))


def _compile() -> None:
    started = time.monotonic()
    command = "from rocking.assessment import compilation; compilation.{}()"
    calls = [
        [sys.executable, "-c", command.format(part)] for part in ("compile_mechanisms", "compile_blocks")
    ]
    running = [subprocess.Popen(call, stderr=subprocess.PIPE, text=True) for call in calls]
    said = [worker.communicate()[1] for worker in running]
    for worker, errors in zip(running, said, strict=True):
        if worker.returncode:
            raise RockingError(f"the numerical parts do not compile: {errors.strip().splitlines()[-1:]}")
    if (spent := time.monotonic() - started) >= _PATIENCE:
        print(f"Compiled in {spent:.0f} s; it is cached for every later run.")


def compile_mechanisms() -> None:
    """Compile the search for pulses, the integration of mechanisms, filters and spectra."""
    record = _record()
    block = Block(2.0, 0.2)
    integrate(block, record)
    integrate_members(block, record, Members([1.0]))
    extract_pulses(record)
    response_spectrum(record)
    process(record, Processing(high_pass=0.5))


def compile_blocks() -> None:
    """Compile what is exact of equivalent blocks, under a record and under a sine pulse, and contact dynamics."""
    record = _record()
    block = Block(2.0, 0.2).mechanism().equivalent_block()
    pulse = Pulse(amplitude=3.0, circular_frequency=6.0)
    integrate(block, record)
    integrate_members(block, record, Members([1.0]))
    integrate_batch([block, block], record)
    rocking_spectrum(record, np.array([2.0]), np.array([0.2]), 0.9)
    predict_maximum(block, pulse)
    predict_maxima([block], [pulse])
    overturning_amplitudes([block], [6.0])
    follow_stack(Spire(width=3.0, height=15.0).stack(), record)


def _record() -> Accelerogram:
    return Accelerogram(5 * np.sin(np.arange(1000) * 0.06), 0.01)
