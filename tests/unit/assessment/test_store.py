"""The store: what was computed comes back to the last digit, only what changed is computed, damage counts as none."""

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.assessment import assessor as assessing
from rocking.assessment import store
from rocking.assessment.assessor import Assessor, with_histories
from rocking.assessment.case import CaseResult, RecordResult
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.one_case import Clock, compute_case
from rocking.assessment.rows import TimingRow, rows_of_record
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.store import RecordStore
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Arch, Block, LoadedWall, Wall
from rocking.tables import cell

TIMES = np.arange(0, 6, 0.01)
PAIR = [
    Accelerogram(
        Pulse(amplitude=amplitude, circular_frequency=7.0, start_time=1.0).acceleration(TIMES),
        0.01,
        name,
        azimuth=azimuth,
    )
    for amplitude, name, azimuth in ((3.0, "N", 0.0), (4.0, "E", 90.0))
]
STRUCTURES = {
    "block": Block(2.0, 0.2),
    "wall": Wall.of_size(6.0, 0.4, 3.0, crack="known"),
    "arch": Arch(5.0, 0.3, np.radians(150)),
}
ONE = {"block": STRUCTURES["block"]}
ASSESSOR = Assessor(
    AssessmentSettings(ensemble=EnsembleSettings(members=16)),
    crack_heights=5,
    processing_variants=True,
    motion_measures=True,
)


def computed(path: Path, records=PAIR, structures=STRUCTURES, assessor=ASSESSOR, tell=print) -> RecordResult:
    kept = RecordStore(path, tell, path.with_name("timings.json"))
    fresh = replace(assessor, store=kept, clock=Clock())
    result = fresh.assess("made", records, on_the_ground(structures))
    kept.save()
    return result


def cells(result: RecordResult) -> list[list[str]]:
    """Every cell of every table but the times."""
    return [
        [cell(getattr(row, name)) for name in kind.table.column_names]
        for kind, rows in rows_of_record(result).tables.items()
        if kind is not TimingRow
        for row in rows
    ]


@pytest.fixture
def cases(monkeypatch) -> list[str]:
    """The types of the structures whose cases are computed, in their order."""
    names: list[str] = []

    def counted(inputs: CaseInputs, clock: Clock) -> CaseResult:
        names.append(inputs.structure.type_name)
        return compute_case(inputs, clock)

    monkeypatch.setattr(assessing, "compute_case", counted)
    return names


@pytest.mark.parametrize("records", [PAIR, PAIR[:1]], ids=["pair", "alone"])
def test_what_is_kept_comes_back_to_the_last_digit(tmp_path, cases, records):
    first = computed(tmp_path / "made.json", records)
    assert cases
    cases.clear()
    again = computed(tmp_path / "made.json", records)
    assert cases == []
    assert cells(again) == cells(first)
    whole = with_histories(again, ASSESSOR.settings.tolerance)
    for name, response in first.responses.items():
        assert np.array_equal(whole.responses[name].rotation, response.rotation)


def test_what_is_kept_keeps_the_times_that_it_took(tmp_path):
    """A run from the store told that all responses take 7e-5 s."""
    first = computed(tmp_path / "made.json").durations
    again = computed(tmp_path / "made.json").durations
    assert set(first) > {"velocity pulse", "pulses", "responses", "variations", "directions", "reserve"}
    # What is no part of a case is measured in each run: making the pair, and the closed form, which no store keeps.
    not_kept = {"directions", "closed form"}
    for stage in set(first) - not_kept:
        assert again[stage] == pytest.approx(first[stage], rel=1e-12), stage
    assert again["directions"] == pytest.approx(first["directions"], rel=0.2)
    (tmp_path / "timings.json").write_text("{")
    assert "responses" not in computed(tmp_path / "made.json").durations, "what is not known is not told"


def test_only_what_changed_is_computed(tmp_path, cases):
    first = computed(tmp_path / "made.json")
    cases.clear()
    changed = STRUCTURES | {"block": Block(2.0, 0.21)}
    assert cells(computed(tmp_path / "made.json", structures=changed)) != cells(first)
    assert cases == ["block", "block", "block"], "under both components, and under all directions"
    cases.clear()
    renamed = {f"the {name}": structure for name, structure in changed.items()}
    computed(tmp_path / "made.json", structures=renamed)
    assert cases == [], "a name changes no number"
    for assessor, number in (
        (replace(ASSESSOR, crack_heights=3), 6),  # which the ensemble over all directions does not ask for
        (replace(ASSESSOR, processing_variants=False), 6),
        (replace(ASSESSOR, settings=replace(ASSESSOR.settings, tolerance=1e-7)), 9),
        (replace(ASSESSOR, version="other"), 9),
    ):
        cases.clear()
        again = computed(tmp_path / "made.json", structures=renamed, assessor=assessor)
        assert len(cases) == number, "three structures under two components, and over all directions"
        assert cells(again) == cells(
            computed(tmp_path / f"{number}.json", structures=renamed, assessor=assessor)
        )
    cases.clear()
    computed(tmp_path / "made.json", [PAIR[0], PAIR[1].scaled(1 + 1e-12)], renamed, assessor)
    assert sorted(set(cases)) == ["arch", "block", "wall"] and len(cases) == 6, "the first component stays"


def test_what_is_not_asked_for_any_more_is_dropped(tmp_path):
    computed(tmp_path / "made.json")
    whole = (tmp_path / "made.json").stat().st_size
    computed(tmp_path / "made.json", structures=ONE)
    assert (tmp_path / "made.json").stat().st_size < 0.7 * whole


@pytest.mark.parametrize(
    ("damage", "reason"),
    [
        (lambda content: content[:-10], "not what was written"),
        (lambda content: content.replace(b"0.", b"1.", 1), "not what was written"),
        (lambda content: b"0" * 64 + content[64:], "another version"),
        (lambda content: b"", "another version"),
        (lambda content: b"\xff\xfe" * 50, "another version"),
    ],
    ids=["cut", "edited", "another version", "empty", "no text"],
)
def test_a_damaged_file_is_ignored_with_a_line(tmp_path, cases, damage, reason):
    path = tmp_path / "made.json"
    first = computed(path, structures=ONE)
    path.write_bytes(damage(path.read_bytes()))
    cases.clear()
    lines: list[str] = []
    assert cells(computed(path, structures=ONE, tell=lines.append)) == cells(first)
    assert len(cases) == 3
    (line,) = lines
    assert reason in line and str(path) in line
    cases.clear()
    computed(path, structures=ONE)
    assert cases == [], "it was written anew"


def test_an_entry_that_is_no_result_is_computed_anew(tmp_path, cases):
    """Whoever can write a checksum can write numbers, but nothing else than numbers and texts comes of them."""
    path = tmp_path / "made.json"
    computed(path, structures=ONE)
    version = store.computation_version()
    names = list(json.loads(path.read_bytes().partition(b"\n")[2]))
    entries = ({"structure": 1}, [], "text", None, {"": {"__class__": "os"}})
    for holds in (names, *(dict.fromkeys(names, entry) for entry in entries)):
        content = json.dumps(holds).encode()
        path.write_bytes(f"{version} {hashlib.sha256(content).hexdigest()}\n".encode() + content)
        cases.clear()
        computed(path, structures=ONE)
        assert len(cases) == 3


def test_numbers_of_every_kind_come_back():
    for kind, value in (
        (float, 0.1 + 0.2),
        (float, math.inf),
        (int, 2**60),
        (str, 'quote " and \\ and Ω'),
        (tuple[float, ...], (1.0, -0.0)),
        (float | None, None),
        (int | str, 3),
        (Mapping[str, tuple[int, str]], {"a": (1, "one")}),
        (float, np.float64(0.5)),
    ):
        assert store.decoded(kind, store.encoded(value)) == value
    assert math.isnan(store.decoded(float, store.encoded(math.nan)))
    assert type(store.encoded(np.int64(3))) is int
    for kind, value in ((int | str, 0.5), (tuple[int, str], [1])):
        with pytest.raises(ValueError):
            store.decoded(kind, value)
    with pytest.raises(TypeError, match="a range cannot be kept"):
        store.encoded(range(3))


def test_each_mechanism_of_a_wall_is_kept_by_itself(tmp_path, cases):
    """No file says in which of them it opens, so that their entries are alike."""
    wall = LoadedWall.of_size(3.2, 0.35, 20e3, tie_heights=(2.0,), tie_stiffness=5e4, tie_strength=8e3)
    opened = [
        mechanism.structure
        for mechanism in wall.mechanisms()
        if mechanism.structure.opening and not mechanism.refusal
    ]
    first, *_, last = opened
    assert first != last and first.described.entry == last.described.entry
    few = Assessor(AssessmentSettings(ensemble=EnsembleSettings(members=8, reserve=0)))
    of_first = computed(tmp_path / "made.json", PAIR[1:], {"wall": first}, few)
    cases.clear()
    of_last = computed(tmp_path / "made.json", PAIR[1:], {"wall": last}, few)
    assert cases and cells(of_first) != cells(of_last)
