"""The public names are as cheap to import as promised, and can be read when they are printed."""

import doctest
import inspect
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rocking

ROOT = Path(rocking.__file__).parents[1]


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
    shown.append(rocking.Response(rotation_ratio=math.nan, outcome=rocking.Outcome.FAILED, reason="no room"))
    shown += [rocking.Frame(rocking.Block.of_size(1.1, 8.0), 4, 0.3), rocking.Facade([3.0], [0.5], 2e4)]
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
    assert "array" not in repr(rocking.Arch(15.0, 2.25, math.radians(157.5)).capacity_curve())
