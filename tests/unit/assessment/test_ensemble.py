"""The ensemble: its members are those that `integrate` follows one by one, and its words keep to its numbers."""

import copy
import math
import pickle
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import rocking
from rocking.assessment.assess import assess
from rocking.assessment.assessor import Assessor
from rocking.assessment.decide import Verdict
from rocking.assessment.ensemble import CAUSES, CauseValues, Ensemble, drawn, ensemble, followed_at, lattice
from rocking.assessment.methods import ratio_in_words
from rocking.assessment.motions import GroundMotions, processed
from rocking.assessment.scene import Scene
from rocking.assessment.settings import SIZES, AssessmentSettings, EnsembleSettings
from rocking.errors import ConfigurationError
from rocking.motion import integrate
from rocking.motion.integration import follow_runs
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram, read
from rocking.signal.accelerogram import Source
from rocking.signal.processing import Processing, process
from rocking.structures import Arch, Block, Wall
from tests.refusals import refused

STEP = 0.01
TIMES = np.arange(0, 4, STEP)
BLOCK = Block(2.0, 0.2, restitution=0.9)
FACADE = Block(2.0, 0.2, restitution=0.5, one_sided=True)
FIXED = EnsembleSettings(amplitude_range=0.0, restitution_range=0.0)


def _record(amplitude: float, component: str = "made") -> Accelerogram:
    """A wave that grows and fades; it overturns the block from somewhat above 5 m/s²."""
    wave = amplitude * np.sin(2 * np.pi * TIMES / 0.9) * np.exp(-((TIMES - 1.5) ** 2))
    return Accelerogram(wave, STEP, component=component)


@pytest.mark.parametrize("size", SIZES[:-1])
def test_a_lattice_holds_the_smaller_one_and_fills_each_stratum_once(size):
    points = lattice(size)
    assert np.all((points > 0) & (points < 1))
    assert np.array_equal(lattice(4 * size)[:size], points)
    for column in points.T:
        assert len(set(np.floor(column * size))) == size


def test_the_generator_is_what_its_criterion_asks_for():
    """The mean of B₂(x) B₂(y) over the points, B₂ the Bernoulli polynomial, is the squared error of a pair of them."""

    def chosen(known: list[int]) -> int:
        every, worst = np.arange(1, SIZES[-1], 2), np.ones(SIZES[-1] // 2)
        for size in SIZES:
            k = np.arange(size)
            bernoulli = (k / size) ** 2 - k / size + 1 / 6
            others = sum(bernoulli[k * part % size] for part in known)
            errors = np.array(
                [(bernoulli[k * number % size] * others).mean() for number in range(1, size, 2)]
            )
            worst = np.maximum(worst, np.sqrt(errors / errors.min())[every % size // 2])
        return int(every[worst.argmin()])

    generator = [1, 182667 % 4096, 469891 % 4096]
    while len(generator) < len(CAUSES):
        generator.append(chosen(generator))
    first = lattice(SIZES[-1])
    steps = np.round((first - first[0]) * SIZES[-1]).astype(int) % SIZES[-1]
    place = np.flatnonzero(steps[:, 0] == 1)[0]
    assert steps[place].tolist() == generator


def test_members_are_what_integrate_says_of_each():
    motions, points = GroundMotions.of(_record(5.0)), lattice(16)
    result = drawn(BLOCK, motions, points, EnsembleSettings())
    causes = result.causes["amplitude"], result.causes["restitution"]
    for ratio, factor, offset in zip(result.rotation_ratios, *causes, strict=True):
        alone = integrate(Block(2.0, 0.2, restitution=0.9 + offset), _record(5.0 * factor))
        assert ratio == pytest.approx(alone.rotation_ratio, rel=1e-6)


def test_runs_are_of_the_members_and_factors_that_ask_for_them(monkeypatch):
    """Two directions whose members take turns, three factors: the ratio that stands for a run is its own peak."""

    def noted(structure, forcing, runs, tolerance):
        peaks = runs.horizontal * forcing.excitation
        reasons = {run: f"{peak:.6g}" for run, peak in enumerate(peaks) if peak < 0}
        return SimpleNamespace(rotation_ratio=peaks, reasons=reasons)

    monkeypatch.setattr("rocking.assessment.ensemble.follow_runs", noted)
    motions = GroundMotions({("EW", ""): _record(5.0), ("NS", ""): _record(3.0)})
    amplitude, polarity = np.linspace(0.9, 1.1, 5), np.array([1.0, -1.0, 1.0, 1.0, -1.0])
    direction = np.array(["EW", "NS", "NS", "EW", "EW"])
    values = CauseValues(
        amplitude=amplitude,
        restitution=np.zeros(5),
        polarity=polarity,
        direction=direction,
        processing=np.full(5, ""),
        vertical=np.ones(5),
    )
    found = followed_at(BLOCK.mechanism(), motions, values, np.array([1.0, 2.0, 4.0]), tolerance=1e-6)
    peak = {name: motions.horizontal[name, ""].peak_acceleration for name in ("EW", "NS")}
    alone = amplitude * polarity * [peak[name] / GRAVITY for name in direction]
    assert found.rotation_ratios == pytest.approx(np.outer([1.0, 2.0, 4.0], alone))
    assert found.reasons == {member: f"{4 * alone[member]:.6g}" for member in (1, 4)}


def test_half_of_the_members_feel_the_vertical_motion():
    up = Accelerogram(2.0 * np.cos(2 * np.pi * TIMES / 0.9), STEP, component="up")
    result = drawn(
        BLOCK, GroundMotions.of(_record(5.0), vertical=up), lattice(16), EnsembleSettings(polarity=False)
    )
    causes = (result.causes[name] for name in ("amplitude", "restitution", "vertical"))
    feels = []
    for ratio, factor, offset, lifts in zip(result.rotation_ratios, *causes, strict=True):
        vertical = up.scaled(factor) if lifts else None
        block = Block(2.0, 0.2, restitution=0.9 + offset)
        assert ratio == pytest.approx(
            integrate(block, _record(5.0 * factor), vertical=vertical).rotation_ratio, rel=1e-6
        )
        feels.append(bool(lifts))
    assert sum(feels) == 8


def test_the_probability_is_the_share_of_the_range_that_overturns():
    settings = EnsembleSettings(restitution_range=0.0, amplitude_range=0.2)
    amplitudes = np.arange(3, 12, 0.1)
    falls = [math.isinf(integrate(BLOCK, _record(amplitude)).rotation_ratio) for amplitude in amplitudes]
    record = _record(amplitudes[np.flatnonzero(np.diff(falls))[0]])  # beside which it overturns and does not
    result = ensemble(BLOCK, GroundMotions.of(record), settings)
    factors = np.linspace(0.8, 1.2, 801)[1::2]
    falls = np.isinf(rocking.integrate_batch([BLOCK], record, factors)[0]).mean()
    assert 0.02 < falls < 0.98
    # two strata may be cut by the boundary
    assert result.overturning_share == pytest.approx(falls, abs=2 / 64)


def test_the_sign_of_the_motion_is_a_cause_for_unlike_sides_alone():
    wave = np.where(TIMES < 0.5, -3.0, 0.0) * np.sin(2 * np.pi * np.minimum(TIMES, 0.5))
    one_pulse = Accelerogram(wave, STEP)
    result = ensemble(FACADE, GroundMotions.of(one_pulse), EnsembleSettings())
    assert set(np.unique(result.causes["polarity"])) == {-1.0, 1.0}
    lifted = result.rotation_ratios > 0
    assert np.array_equal(lifted, result.causes["polarity"] == 1.0)
    assert "polarity" not in ensemble(BLOCK, GroundMotions.of(one_pulse), EnsembleSettings()).causes


def _raw(amplitude: float, component: str = "made") -> Accelerogram:
    """The wave on a ramp of 0.1 m/s², from a file that says it is uncorrected."""
    made = _record(amplitude, component)
    drift = np.linspace(0, 0.1, TIMES.size)
    return replace(made, acceleration=made.acceleration + drift, source=Source("raw.evt"), processed=False)


def test_the_processing_of_a_raw_record_is_a_cause():
    record = _raw(5.0)
    motions = GroundMotions.of(record, processing=True)
    assert motions.horizontal["made", "unchanged"] is record, "what is there already is not made again"
    result = drawn(BLOCK, motions, lattice(64), EnsembleSettings())
    assert set(result.causes["processing"]) == {name for _, name in motions.horizontal}
    assert set(result.causes["processing"]) == set(processed(record))
    high_passed = np.flatnonzero(result.causes["processing"] == "high-pass 0.2 Hz")
    assert high_passed.size
    for k in high_passed:
        motion = process(record, Processing(taper=0.02, high_pass=0.2)).scaled(result.causes["amplitude"][k])
        alone = integrate(Block(2.0, 0.2, restitution=0.9 + result.causes["restitution"][k]), motion)
        assert result.rotation_ratios[k] == pytest.approx(alone.rotation_ratio, rel=1e-6)
    assert list(drawn(BLOCK, motions, lattice(64), FIXED).causes) == ["processing"]


@pytest.mark.parametrize(
    ("record", "settings"),
    [
        (_record(5.0), EnsembleSettings()),  # of an array nobody says that it is raw
        (replace(_raw(5.0), processed=True), EnsembleSettings()),
        (replace(_raw(5.0), processed=None), EnsembleSettings()),
        (_raw(5.0), EnsembleSettings(processing=False)),
    ],
)
def test_the_processing_of_another_record_is_none(record, settings):
    result = assess(record, BLOCK, settings=AssessmentSettings(ensemble=settings))
    assert "processing" not in result.causes


@pytest.mark.parametrize(("stated", "most"), [(0.987, 0.999), (0.9995, 0.9995), (1.0, 1.0), (0.9, 0.95)])
def test_no_member_bounces_better_than_it_may(stated, most, monkeypatch):
    """A range of ±0.05 reaches beyond 1, where a member would rock for ever."""
    seen = []

    def note_restitution(reduced, forcing, several, tolerance):
        seen.append(several.restitution)
        return follow_runs(reduced, forcing, several, tolerance)

    monkeypatch.setattr("rocking.assessment.ensemble.follow_runs", note_restitution)
    block = Block(2.0, 0.2, restitution=stated)
    drawn(block, GroundMotions.of(_record(0.5)), lattice(64), EnsembleSettings())
    # of 64 points one stands in each 64th of the range
    assert seen[0].max() == pytest.approx(most, abs=0.1 / 64) and seen[0].max() <= most
    assert seen[0].min() == pytest.approx(stated - 0.05, abs=0.1 / 64)


def test_a_structure_may_say_how_well_its_restitution_is_known():
    motions, points = GroundMotions.of(_record(5.0)), lattice(64)
    for known in (0.0, 0.15):
        block = Block(2.0, 0.2, restitution=0.8, restitution_range=known)
        result = drawn(block, motions, points, EnsembleSettings())
        settings = EnsembleSettings(restitution_range=known)
        wide = drawn(replace(block, restitution_range=None), motions, points, settings)
        assert np.array_equal(result.rotation_ratios, wide.rotation_ratios)
        assert result.settings.restitution_range == known and ("restitution" in result.causes) == (known > 0)


def test_where_the_verdict_alone_is_asked_it_ends_early_far_from_overturning_only():
    seen = set()
    for amplitude in np.arange(2.0, 7.0, 0.5):
        motions = GroundMotions.of(_record(amplitude))
        whole, quick = (ensemble(BLOCK, motions, verdict_only=verdict_only) for verdict_only in (False, True))
        far = whole.rotation_ratios[:16].max() <= 0.3
        assert quick.members == (16 if far else whole.members)
        assert quick.facts().step(0.05) is whole.facts().step(0.05)
        seen.add(far)
    assert seen == {False, True}


def test_two_components_make_one_ensemble_over_eight_directions():
    """Of two that move together, 3 and 4 times the same, the motion along an angle is 3 cos + 4 sin of it."""
    first, second = _record(3.0, "first"), _record(4.0, "second")
    motions = GroundMotions.of(first, second)
    peaks = [motion.peak_acceleration for motion in motions.horizontal.values()]
    angles = np.radians(22.5 * np.arange(8))
    expected = np.abs(3 * np.cos(angles) + 4 * np.sin(angles)) / 3 * first.peak_acceleration
    assert peaks == pytest.approx(expected, rel=1e-12)
    directions = [name for name, _ in motions.horizontal]
    assert directions[0] == "first" and directions[4] == "second"
    result = assess([first, second], BLOCK)
    assert set(result.causes["direction"]) == set(directions)
    assert result.rotation_ratio == integrate(BLOCK, second).rotation_ratio


@pytest.mark.parametrize(
    ("predicted", "integrated", "words"),
    [
        (0.02, 0.4, "20 × too low"),
        (0.4, 0.02, "20 × too high"),
        (0.39, 0.4, "within 10 %"),
        (0.5, 0.2, "2.5 × too high"),
        (0.454, 0.001001, "450 × too high"),
        (0.4, 0.6, "1.5 × too low"),
        (1.1, 1.0, "within 10 %"),
        (1.0, 0.1, "10 × too high"),
        (0.0, 0.3, "misses the rocking"),
        (0.0, math.inf, "misses the overturning"),
        (0.3, 0.0, "rocks instead of resting"),
        (math.inf, 0.0, "overturns instead of resting"),
        (0.3, math.inf, "misses the overturning"),
        (math.inf, 0.3, "overturns instead of rocking"),
        (math.inf, math.inf, "both overturn"),
        (0.0, 0.0005, "both at rest"),
        (math.nan, 0.3, ""),
    ],
)
def test_ratio_in_words(predicted, integrated, words):
    assert ratio_in_words(predicted=predicted, integrated=integrated) == words


def test_assess_says_in_one_call_what_its_parts_say():
    record = _record(4.0)
    result = rocking.assess(record, BLOCK)
    assert result.verdict == "stands" and result.overturning_share == 0
    assert result.rotation_ratio == integrate(BLOCK, record).rotation_ratio
    assert result.rotation_ratio_low <= result.rotation_ratio_median <= result.rotation_ratio_high
    assert result.rotation_ratio_low < result.rotation_ratio < result.rotation_ratio_high
    assert "stands: 0 of 64 members overturn" in repr(result)
    frame = result.frame().set_index("method")
    assert frame.loc["mechanism on record", "rotation_ratio"] == result.rotation_ratio
    assert result.plot().get_ylabel() == "rotation / critical rotation [-]"


@pytest.mark.real_records
def test_the_slender_block_under_rinaldi_only_probably_overturns(real_records):
    """It stands at 0.994 and 0.9985 of the record, and overturns at 0.99 and 1.01."""
    (record,) = rocking.read(real_records / "northridge1994_rinaldi" / "NGA_no_1063_RRS228.AT2")
    block = Block.of_size(0.5, 3.0)
    ratios = rocking.integrate_batch([block], record, (0.99, 0.994, 0.9985, 1.01))[0]
    assert np.isinf(ratios).tolist() == [True, False, False, True]
    assert rocking.assess(record, block).verdict is Verdict.PROBABLY_OVERTURNS


def test_a_mechanism_is_assessed_as_its_structure_and_members_are_those_asked_for():
    record = _record(4.0)
    one, other = (assess(record, case, members=256) for case in (BLOCK, BLOCK.mechanism()))
    assert one.members == 256 and np.array_equal(one.rotation_ratios, other.rotation_ratios)


@pytest.mark.parametrize(
    ("record", "structure", "field"),
    [
        ("x.AT2", BLOCK, "record"),
        (np.zeros(9), BLOCK, "record"),
        (BLOCK, _record(4.0), "record"),
        ([], BLOCK, "record"),
        ([1.0, 2.0], BLOCK, "record"),
        (3, BLOCK, "record"),
        (_record(4.0), [BLOCK], "structure"),
        (_record(4.0), BLOCK.mechanism().equivalent_block("exact_at_rest"), "structure"),
    ],
)
def test_wrong_types_are_refused(record, structure, field):
    with refused(ConfigurationError, field, record if field == "record" else structure):
        assess(record, structure)


def test_a_stream_of_obspy_is_assessed_as_its_components():
    from obspy import Stream

    first, second = _record(3.0, "HNE"), _record(4.0, "HNN")
    stream = Stream([case.to_obspy() for case in (first, second)])
    ours = assess([first, second], BLOCK, members=16)
    assert np.array_equal(assess(stream, BLOCK, members=16).rotation_ratios, ours.rotation_ratios)


def test_components_without_a_name_are_numbered():
    pair = [replace(_record(value), component="") for value in (0.5, 0.6)]
    assert list(assess(pair, BLOCK, members=16).cases) == ["component 1", "component 2"]


@pytest.mark.parametrize("structure", [BLOCK, Wall.of_size(3.0, 0.4, 1.5), Arch(5.0, 0.8, np.radians(150))])
def test_an_assessment_goes_to_another_process_and_back(structure):
    result = assess(_record(4.0), structure, members=16)
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        assert again.verdict is result.verdict
        assert np.array_equal(again.rotation_ratios, result.rotation_ratios)
        assert assess(_record(4.0), again.mechanism, members=16).rotation_ratio == result.rotation_ratio


def test_an_ensemble_grows_where_more_members_may_decide():
    """With 64, a share within its error of 4/64 of one of the four edges: 8/64 may still be 1/16, 11/64 not."""
    assert ensemble(BLOCK, GroundMotions.of(_record(0.5))).members == 16, "at rest it ends early"
    few = ensemble(BLOCK, GroundMotions.of(_record(2.0)), EnsembleSettings(members=16))
    assert few.members == 16 and 0 < few.rotation_ratios.max() < 0.3, "nothing is in doubt"
    settings = EnsembleSettings(risk=1 / 16)
    grown = {}
    again = {}
    for amplitude in (*np.arange(6.25, 7.2, 0.05), *np.arange(8.0, 15.0, 0.5), *np.arange(15.1, 16.1, 0.1)):
        motions = GroundMotions.of(_record(amplitude))
        usual = drawn(BLOCK, motions, lattice(256)[:64], settings)
        falls = usual.overturning_members
        members = ensemble(BLOCK, motions, settings).members
        grown[falls] = members > 64
        of_256 = drawn(BLOCK, motions, lattice(256), settings).overturning_members
        near_by_hand = any(abs(of_256 - 256 * edge) <= 4 for edge in (1 / 16, 1 / 3, 2 / 3, 15 / 16))
        again[of_256] = members == 1024
        assert not grown[falls] or again[of_256] == (near_by_hand and 0 < of_256 < 256)
        assert ensemble(BLOCK, motions, settings, grows=False).members == 64
    assert 8 in grown and sum(56 <= falls < 64 for falls in grown), grown
    near = {*range(1, 9), *range(18, 26), *range(39, 47), *range(56, 64)}
    assert all(grew == (falls in near) for falls, grew in grown.items()), grown
    assert near & grown.keys() & {*range(18, 47)}, "one of the inner edges is met"
    assert {*again.values()} == {True, False}, "and some of 256 still lie within 4 members of an edge"


@pytest.mark.parametrize(
    ("ratios", "expected"),
    [
        ([0.3] * 16, Verdict.STANDS),
        ([0.31] * 16, Verdict.PROBABLY_STANDS),
        ([0.9] * 63 + [math.nan], Verdict.PROBABLY_STANDS),
        ([0.9] * 64, Verdict.STANDS),
    ],
)
def test_fewer_than_64_members_that_agree_decide_only_far_from_overturning(ratios, expected):
    assert Ensemble(np.array(ratios), {}, EnsembleSettings()).facts().step(0.05) is expected


def test_a_member_that_could_not_be_followed_counts_as_falling():
    assert Ensemble(np.array([math.inf, 0.5, 0.5, math.nan]), {}, FIXED).overturning_share == 0.5


def test_variants_have_as_many_members_as_the_one_that_needs_most():
    """So that shares that are compared have one error; members that all agree have none, and are left."""
    record = read(Path(rocking.__file__).parents[1] / "records" / "synthetic_strong_pulse.AT2")[0].scaled(0.6)
    walls = {f"wall: {breadth}": Scene("", Block.of_size(breadth, 4.0)) for breadth in (0.92, 0.95, 1.0)}
    walls = {"wall": Scene("", Block.of_size(0.9, 4.0)), **walls}
    apart = {name: replace(scene, name=name) for name, scene in walls.items()}
    together = {
        name: replace(scene, variant_of="" if name == "wall" else "wall") for name, scene in apart.items()
    }

    def members(scenes, **settings):
        quick = AssessmentSettings(fidelity="quick", **settings)
        result = Assessor(quick).assess("record", [record], scenes)
        return [
            (followed.members, followed.overturning_members)
            for followed in (scene.worst.ensemble for scene in result.scenes.values())
        ]

    assert members(apart) == [(256, 239), (64, 48), (64, 26), (64, 0)]
    shared = members(together)
    assert shared[:3] == members(apart, ensemble=EnsembleSettings(members=256))[:3]
    assert [number for number, _ in shared] == [256, 256, 256, 64]
