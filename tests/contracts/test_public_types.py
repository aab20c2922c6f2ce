"""The public names carry their types, are as cheap to import as promised, and can be read when they are printed."""

import doctest
import inspect
import math
import os
import re
import subprocess
import sys
from enum import Enum
from pathlib import Path

import numpy as np
import pytest

import rocking

ROOT = Path(rocking.__file__).parents[1]

LIBRARIES = re.compile(r"dtype\[(typing\.)?Any\]|tuple\[(typing\.)?Any, \.\.\.\]|\*\*options: Any")
"""How numpy shows a number type and a shape, which the docstring states, and options handed on to matplotlib."""
HANDED_ON = {f"rocking.{wall}.{name}" for wall in ("Wall", "LoadedWall") for name in ("of_size", "hinged_at")}
HANDED_ON |= {"rocking.Accelerogram.processed_by"}
"""Names whose further values and keywords are those of another, which their docstring names."""
OF_OBSPY = {"rocking.from_obspy", "rocking.Accelerogram.from_obspy", "rocking.Accelerogram.to_obspy"}
UNTYPED = OF_OBSPY | HANDED_ON
"""And names that take or give what obspy has, which carries no types of its own."""


def members() -> list[str]:
    """Every public name, and every public attribute of the classes among them, as an expression.

    Not the frames: pandas carries no types of its own.
    """
    expressions = []
    for name in rocking.__all__:
        value = getattr(rocking, name)
        expressions.append(f"rocking.{name}")
        if inspect.isclass(value) and not issubclass(value, Exception | Enum):
            own = (
                name for base in value.__mro__ if base.__module__.startswith("rocking") for name in vars(base)
            )
            public = (member for member in dict.fromkeys(own) if not member.startswith("_"))
            expressions += [
                f"rocking.{name}.{member}" for member in public if not gives_frame(getattr(value, member))
            ]
    return expressions


def gives_frame(member: object) -> bool:
    return "DataFrame" in str(getattr(member, "__annotations__", {}).get("return", ""))


@pytest.mark.slow
def test_mypy_knows_the_type_of_every_public_name(tmp_path):
    pytest.importorskip("mypy", reason="mypy checks the types, of the extra test")
    expressions = members()
    surface = "\n".join(["import rocking", *(f"reveal_type({name})" for name in expressions)])
    (tmp_path / "surface.py").write_text(surface, encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--cache-dir=cache", "surface.py"]
    surroundings = os.environ | {"MYPYPATH": str(ROOT)}
    done = subprocess.run(command, cwd=tmp_path, env=surroundings, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    notes = re.findall(r'surface\.py:(\d+): note: Revealed type is "(.*)"', done.stdout)
    types = {expressions[int(line) - 2]: LIBRARIES.sub("", kind) for line, kind in notes}
    untyped = {name for name in expressions if re.search(r"\bAny\b", types.get(name, "Any"))}
    assert untyped <= UNTYPED


def test_every_name_of_the_stub_is_there():
    assert len(rocking.__all__) > 30
    for name in rocking.__all__:
        assert getattr(rocking, name).__doc__, name
    with pytest.raises(AttributeError):
        _ = rocking.nonsense


@pytest.mark.parametrize("name", rocking.__all__)
def test_the_example_of_a_public_name_runs(name, monkeypatch):
    """At the top of the repository, so that an example may read records/, with numpy as np and the package."""
    monkeypatch.chdir(ROOT)
    value = getattr(rocking, name)
    finder = doctest.DocTestFinder()
    given = {"np": np, "rocking": rocking}
    examples = [item for item in finder.find(value, name, globs=given) if item.examples]
    assert examples or (inspect.isclass(value) and issubclass(value, rocking.RockingError)), "has no example"
    for example in examples:
        shown: list[str] = []
        doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(example, out=shown.append)
        assert not shown, "".join(shown)


@pytest.mark.process
def test_importing_the_package_imports_nothing_heavy():
    """What costs time: numpy a tenth of a second, numba and obspy several."""
    heavy = ("numpy", "scipy", "obspy", "numba", "matplotlib", "pandas", "typst")
    code = f"import sys, rocking; print([name for name in {heavy!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def results() -> dict[str, object]:
    """One of each thing that a notebook shows."""
    arch = rocking.Arch(15.0, 2.25, math.radians(157.5), restitution=0.9)
    mechanism = arch.mechanism()
    pulse = rocking.Pulse(amplitude=0.67 * 9.80665, circular_frequency=2 * math.pi / 0.81, start_time=2.05)
    record = rocking.Accelerogram(pulse.acceleration(np.arange(4000) * 0.005), 0.005, "NS", "Rinaldi")
    maximum = rocking.predict_maximum(mechanism.equivalent_block("uplift"), pulse)
    response = rocking.integrate(mechanism, record, history=True)
    unlike = rocking.RigidBody(left=0.3, right=0.5, centre_height=1.5, inertia=1.0, restitution=0.9)
    analysis = rocking.extract_pulses(record)
    one_sided = rocking.Block.of_size(0.5, 3.0, 0.4, True)
    sides = (mechanism.positive, mechanism, unlike.mechanism(), one_sided.mechanism())
    shown = [record, pulse, analysis, *sides, maximum, response, rocking.integrate(arch, record.scaled(1e-3))]
    return {f"{type(value).__name__} {place}": value for place, value in enumerate(shown)}


def test_a_person_can_read_what_a_notebook_shows():
    """No function, no object address, no array, no digits that nobody can use; one or two lines."""
    for name, value in results().items():
        text = repr(value)
        assert text.startswith(f"{type(value).__name__}("), name
        assert len(text) < 200 and "\n" not in text, text
        for unreadable in ("lambda", "<", " at 0x", "array", "..."):
            assert unreadable not in text, text
        assert not re.search(r"\d\.\d{6,}", text), text
