"""Scenes: the supports of a list, what stands on them, and what is said over their periods."""

import csv
import pickle
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import yaml

import rocking
from rocking.assessment.assessor import Assessor
from rocking.assessment.case import CaseResult
from rocking.assessment.decide import Verdict
from rocking.assessment.scene import load_scenes, periods_in_words, placed
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import ConfigurationError
from rocking.floors.kinds import FloorKind
from rocking.floors.place import GROUND, PERIODS, place_from_config
from rocking.hashes import sha256_of
from rocking.structures.kinds import StructureKind
from rocking.study.settings import structure_hashes

BLOCK = "type: block, breadth_m: 0.4, height_m: 1.6"


def listed(tmp_path, *lines):
    path = tmp_path / "structures.yaml"
    path.write_text("\n".join(f"- {{{line}}}" for line in lines) + "\n", encoding="utf-8")
    return load_scenes(path)


def test_a_range_of_periods_is_an_axis_of_one_scene(tmp_path):
    scenes = listed(
        tmp_path,
        f"name: parapet, {BLOCK}, stands_on: roof",
        f"name: pier, {BLOCK}",
        f"name: wall, {BLOCK}, stands_on: ground",
        f"name: statue, {BLOCK}, stands_on: roof",
        "name: roof, type: support, period_s: [0.15, 0.6], damping_ratio: 0.1, participation: 1.3",
    )
    assert list(scenes) == ["parapet", "pier", "wall", "statue"]
    roof = scenes["parapet"].place
    assert roof is scenes["statue"].place
    ground, *supports = roof.axis
    assert ground is None and len(supports) == PERIODS
    periods = [roof.period_of(value) for value in roof.axis]
    assert periods[0] == 0
    assert (periods[1], periods[-1]) == pytest.approx((0.15, 0.6))
    assert [b / a for a, b in pairwise(periods[1:])] == pytest.approx([4 ** (1 / 8)] * 8)
    assert all(support.modes[0].participation == 1.3 for support in supports)
    for name in ("pier", "wall"):
        assert scenes[name].place is GROUND
        assert scenes[name].place.axis == (None,) and scenes[name].place.period_of(None) is None


def test_a_scene_is_the_same_after_it_went_to_another_process(tmp_path):
    (parapet,) = listed(
        tmp_path,
        f"name: parapet, {BLOCK}, stands_on: roof, elastic_period_s: 0.1",
        "name: roof, type: support, period_s: 0.3, participation: 1.3",
    ).values()
    assert pickle.loads(pickle.dumps(parapet)) == parapet
    assert parapet.terms.elastic_period == 0.1


def test_the_codes_participation_and_damping():
    floor = {"name": "floor", "period_s": 0.3, "storeys": 3, "height_m": 6.0, "building_height_m": 9.0}
    (mode,) = place_from_config(floor).supports[0].modes
    # Γ = 3n/(2n + 1) = 9/7, ψ = 2/3
    assert mode.participation == pytest.approx(9 / 7 * 2 / 3)
    assert mode.damping_ratio == 0.05
    yielding = place_from_config(floor | {"yielding_masonry": True}).supports
    assert [yielding[0].modes[0].period, yielding[-1].modes[0].period] == pytest.approx([0.45, 0.6])
    assert {tie.modes[0].damping_ratio for tie in yielding} == {0.10}


def test_several_modes_move_together():
    modes = [{"period_s": [0.5, 2.0], "participation": 1.5}, {"period_s": 0.2, "participation": -0.5}]
    tower = place_from_config({"name": "tower", "modes": modes}).supports
    assert len(tower) == PERIODS
    assert tower[4].modes[0].period == pytest.approx(1.0)
    assert {mode.modes[1].period for mode in tower} == {0.2}


ROOF = {"name": "roof", "period_s": 0.3, "participation": 1.3}
STOREYS = {"name": "roof", "period_s": 0.3, "storeys": 3, "height_m": 6.0, "building_height_m": 9.0}


@pytest.mark.parametrize(
    ("entry", "sentence"),
    [
        ({"name": "roof", "period_s": 0.3}, "a support needs participation, Γψ of the mode"),
        ({"name": "roof", "participation": 1.0}, "a support needs period_s, a number of seconds or a range"),
        (ROOF | {"period_s": [0.6, 0.3]}, "period_s is [0.6, 0.3] s, but must be above 0"),
        (ROOF | {"period_s": 0}, "period_s is 0 s, but must be above 0"),
        (
            ROOF | {"period_s": [0.1, 0.2, 0.3]},
            "period_s is [0.1, 0.2, 0.3], but must be a number or a range",
        ),
        (ROOF | {"damping_ratio": 1.0}, "damping_ratio is 1.0, but must be a share of the critical one"),
        (ROOF | {"damping_ratio": -0.1}, "damping_ratio is -0.1, but must be a share of the critical one"),
        (ROOF | {"mass_ratio": -1}, "mass_ratio is -1, but must be 0 or more"),
        (ROOF | {"perod_s": 1}, "perod_s is not a key of a support; did you mean period_s?"),
        (ROOF | {"mass": 1}, "mass is not a key of a support; did you mean mass_ratio?"),
        (ROOF | {"modes": []}, "a support is given participation, period_s together with modes"),
        ({"name": "roof", "modes": []}, "modes is [], but must be a list of at least one mode"),
        (STOREYS | {"height_m": 9.5}, "height_m is 9.5 m, but must lie between 0 and building_height_m, 9 m"),
        (STOREYS | {"storeys": 2.5}, "storeys is 2.5, but must be a whole number from 1 on"),
        (STOREYS | {"participation": 1.0}, "a support is given participation together with storeys"),
        (ROOF | {"storeys": 3}, "a support with storeys needs building_height_m and height_m"),
        (ROOF | {"yielding_masonry": "yes"}, "yielding_masonry is 'yes', but must be true or false"),
    ],
)
def test_supports_that_cannot_be(entry, sentence):
    with pytest.raises(ConfigurationError) as raised:
        place_from_config(entry)
    assert str(raised.value).startswith(sentence)
    assert str(raised.value).endswith((".", "?"))


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        ([f"name: a, {BLOCK}, stands_on: rof", "name: roof, type: support, period_s: 0.3, participation: 1.3"],
         "stands_on is 'rof', but no support of the list has this name (did you mean roof?)"),
        ([f"name: a, {BLOCK}", "name: roof, type: support, period_s: 0.3, participation: 1.3"],
         "support roof carries nothing; name it by stands_on, or remove it."),
        (["name: roof, type: support, period_s: 0.3, participation: 1.3"], "support roof carries nothing"),
        ([f"name: a, {BLOCK}, stands_on: a", f"name: b, {BLOCK}"], "stands_on is 'a', but no support"),
        ([f"name: a, {BLOCK}, stands_on: roof", "name: roof, type: support, period_s: 0.3"],
         "structure 2 (roof): a support needs participation"),
    ],
)  # fmt: skip
def test_lists_that_cannot_be(tmp_path, lines, sentence):
    with pytest.raises(ConfigurationError) as raised:
        listed(tmp_path, *lines)
    assert sentence in str(raised.value)
    assert len(str(raised.value).splitlines()) == (2 if "'rof'" in sentence else 1)


@pytest.mark.parametrize("place", ["[roof]", "{roof: 1}", "3", "true"])
def test_a_structure_stands_on_a_name(tmp_path, place):
    with pytest.raises(ConfigurationError, match=r"structure 1 \(a\): stands_on is "):
        listed(tmp_path, f"name: a, {BLOCK}, stands_on: {place}")


@pytest.mark.parametrize(
    "lines",
    [
        [f"name: a, {BLOCK}, stands_on: {'y' * 9000}"],
        [f"name: [{'y, ' * 3000}y], {BLOCK}"],
        [f"name: {'y' * 9000}, {BLOCK}, breadth: 1"],
        [f"name: a, {BLOCK}", f"name: {'y' * 9000}, type: support, period_s: 0.3, participation: 1.3"],
        [
            f"name: a, {BLOCK}, stands_on: attic",
            f"name: {'y' * 9000}, type: support, period_s: 0.3, participation: 1.3",
        ],
    ],
    ids=["place", "list as name", "name", "idle support", "supports to choose from"],
)
def test_a_sentence_repeats_the_begin_of_a_long_name(tmp_path, lines):
    with pytest.raises(ConfigurationError, match=r"… \(\d+ characters\)") as raised:
        listed(tmp_path, *lines)
    for sentence in str(raised.value).splitlines():
        assert len(sentence) < 1000


def test_a_heavy_structure_is_warned_of(tmp_path):
    roof = "name: roof, type: support, period_s: 0.3, participation: 1.3, mass_ratio: {}"
    (heavy,) = listed(tmp_path, f"name: a, {BLOCK}, stands_on: roof", roof.format(0.05))["a"].warnings
    assert (heavy.kind, heavy.about, heavy["ratio"]) == (FloorKind.HEAVY_ON_SUPPORT, "a", 0.05)
    assert not listed(tmp_path, f"name: a, {BLOCK}, stands_on: roof", roof.format(0.01))["a"].warnings


FRONT = (
    "name: front, type: facade, storey_heights_m: [4.0], thicknesses_m: [0.4], unit_weight_kN_m3: 18, "
    "restitution: 0.8, tie_heights_m: [3.8], tie_stiffness_kN_m2: 5000, tie_strength_kN_m: 5.0"
)


def test_a_variant_is_the_structure_with_its_values_changed(tmp_path):
    """It equals one that is typed out, stands behind its own, and describes itself as it was typed."""
    scenes = listed(
        tmp_path,
        f"{FRONT}, variants: [{{name: tie 8 kN/m, tie_strength_kN_m: 8.0}}, "
        "{name: no tie, tie_heights_m: null, tie_stiffness_kN_m2: null, tie_strength_kN_m: null}, "
        "{name: upstairs, stands_on: roof}]",
        f"name: pier, {BLOCK}",
        "name: roof, type: support, period_s: 0.3, participation: 1.3",
    )
    assert list(scenes) == ["front", "front: tie 8 kN/m", "front: no tie", "front: upstairs", "pier"]
    (alone,) = listed(tmp_path, FRONT.replace("strength_kN_m: 5.0", "strength_kN_m: 8.0")).values()
    stronger = scenes["front: tie 8 kN/m"].structure
    assert stronger == alone.structure
    assert stronger.described.entry == alone.structure.described.entry
    assert "8.0 kN/m" in stronger.description
    assert scenes["front: no tie"].structure.tie_heights == ()
    assert scenes["front: upstairs"].structure == scenes["front"].structure
    assert scenes["front: upstairs"].place.supports and scenes["front"].place is GROUND


@pytest.mark.parametrize(
    ("variants", "sentence"),
    [
        ("[{name: same, tie_strength_kN_m: 5}]", "variant 1 (same): it changes nothing"),
        ("[{name: same}]", "variant 1 (same): it changes nothing"),
        ("[{tie_strength_kN_m: 8}]", "must have a name of its own"),
        ("[8]", "variant 1: it is 8, but must have a name"),
        ("[]", "variants is [], but must be a list"),
        ("8", "variants is 8, but must be a list"),
        ("[{name: odd, breadth_m: 3}]", "variant 1 (odd): breadth_m is not a key of a facade"),
        ("[{name: weak, tie_strength_kN_m: 8}, {name: weak, tie_strength_kN_m: 9}]", "name is already taken"),
    ],
)
def test_what_is_no_variant_is_refused_in_one_sentence(tmp_path, variants, sentence):
    with pytest.raises(ConfigurationError) as refusal:
        listed(tmp_path, f"{FRONT}, variants: {variants}")
    assert sentence in str(refusal.value)
    assert "\n" not in str(refusal.value)
    assert "structure 1 (front)" in str(refusal.value)


def test_of_variants_each_that_is_none_is_told(tmp_path):
    with pytest.raises(ConfigurationError, match=r"(?s)variant 1: it is 8, .*variant 2: it is 9, "):
        listed(tmp_path, f"{FRONT}, variants: [8, 9]")


def test_a_variant_that_is_added_computes_no_other_case_again(tmp_path):
    class Counting(dict):
        """A store that says what was computed."""

        def find(self, kind, fingerprint):
            return self.get(fingerprint)

        def durations(self, fingerprint):
            return {}

        def keep(self, fingerprint, result, durations):
            self[fingerprint] = result

    store = Counting()
    pulse = rocking.Pulse(amplitude=2.0, circular_frequency=6.0, start_time=0.5)
    record = rocking.Accelerogram(pulse.acceleration(np.arange(400) * 0.01), 0.01, component="EW")
    pier = f"name: pier, {BLOCK}, variants: [{{name: broad, breadth_m: 0.8}}"
    settings = AssessmentSettings()
    Assessor(settings, store=store).assess("", [record], listed(tmp_path, f"{pier}]"))
    before = dict(store)
    more = listed(tmp_path, f"{pier}, {{name: high, height_m: 2.4}}]")
    assert list(more) == ["pier", "pier: broad", "pier: high"]
    Assessor(settings, store=store).assess("", [record], more)
    cases = [entry for key, entry in store.items() if key not in before and isinstance(entry, CaseResult)]
    # What is kept has no names, and so the same case may serve structures of two names.
    assert all(store[key] is before[key] for key in before)
    assert len(cases) == sum(isinstance(item, CaseResult) for item in before.values()) / 2


def test_a_restitution_above_that_of_the_geometry_is_told(tmp_path):
    """Of a block 1 − 1.5 sin²α = .942: more than that no rigid bodies keep."""
    path = tmp_path / "list.yaml"
    sizes = "type: block, breadth_m: 0.6, height_m: 3"
    path.write_text(f"- {{name: a, {sizes}, restitution: 0.99}}\n- {{name: b, {sizes}, restitution: 0.7}}\n")
    scenes = load_scenes(path)
    (told,) = (warning for scene in scenes.values() for warning in scene.warnings)
    assert (told.kind, told.about) == (StructureKind.RESTITUTION_ABOVE, "a")
    assert told["own"] == pytest.approx(0.9423, abs=1e-4)
    kinds = [one_scene.structure.cautions[-1].kind for one_scene in scenes.values()]
    assert kinds == [StructureKind.RESTITUTION_ABOVE, StructureKind.RESTITUTION_TYPED]
    own = scenes["b"].structure.cautions[-1]["own"]
    assert own == pytest.approx(1 - 1.5 * 0.36 / (0.36 + 9.0), rel=1e-9)


SHIPPED = Path(__file__).parents[3] / "config" / "structures.yaml"
FACADE = {
    "name": "front",
    "type": "facade",
    "storey_heights_m": [3.4, 3.0],
    "thicknesses_m": [0.5, 0.4],
    "unit_weight_kN_m3": 19,
    "tie_heights_m": [6.2],
    "tie_stiffness_kN_m2": 1e4,
    "crack_storey": 1,
    "crack": "known",
}
CURVE = {"name": "curve", "type": "capacity_curve", "weight_kN": 120, "restitution": 0.9}
CURVE |= {"displacements_m": [0, 0.1, 0.3], "multipliers": [0.1, 0.08, 0]}


@pytest.mark.parametrize(("separator", "encoding"), [(",", "utf-8"), (";", "utf-8-sig"), (";", "cp1252")])
def test_both_doors_give_the_same_structures(tmp_path, separator, encoding):
    """The shipped list with its supports, a list of one height and one of a curve: as YAML, and as a spreadsheet."""
    entries = [*yaml.safe_load(SHIPPED.read_text(encoding="utf-8")), FACADE, CURVE]
    entries = [
        {key: value for key, value in other_entry.items() if key != "variants"} for other_entry in entries
    ]
    listed = tmp_path / "structures.yaml"
    listed.write_text(yaml.safe_dump(entries), encoding="utf-8")

    def cell(value: object) -> str:
        if isinstance(value, list):
            return "; ".join(map(cell, value))
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        text = yaml.safe_dump(value).split("\n")[0] if is_number else str(value)
        return text.replace(".", ",") if is_number and separator == ";" else text

    rows = tmp_path / "structures.csv"
    with rows.open("w", encoding=encoding, newline="") as file:
        writer = csv.DictWriter(
            file, list({key: None for entry in entries for key in entry}), delimiter=separator
        )
        writer.writeheader()
        writer.writerows({key: cell(value) for key, value in one_entry.items()} for one_entry in entries)
        file.write(separator * (len(writer.fieldnames) - 1) + "\n")
    by_yaml = load_scenes(listed)
    by_csv = load_scenes(rows)
    assert list(by_csv) == list(by_yaml)
    assert by_csv == by_yaml
    for name, scene in by_yaml.items():
        assert by_csv[name].structure.described.entry == scene.structure.described.entry
        assert by_csv[name].structure.description == scene.structure.description


HEAD = "name,type,breadth_m,height_m,thickness_m"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (f"{HEAD},heigth\na,block,1,4,,", r"column 'heigth' is not known \(did you mean height_m\?\)\.$"),
        ("name,height_m\na,4", r"column 'type' is missing\.$"),
        (f"{HEAD}\n,block,1,4,", "line 2: name is missing"),
        (f"{HEAD}\na,block,1,4,\na,block,1,5,", r"line 3 \(a\): the name is already taken"),
        (f"{HEAD}\na,block,1,4,0.3", r"line 2 \(a\): thickness_m is not a key of a block"),
        (f"{HEAD}\na,blok,1,4,", r"type is 'blok'.*did you mean block\?"),
        (f"{HEAD}\na,block,1,tall,", r"height_m is 'tall', but must be a number"),
        (f'{HEAD}\na,block,1,"4,5",', r"height_m is '4,5', but must be .* written with a point, 4\.5"),
        (f"{HEAD}\na,block,1,4,5,0", "line 2 has more cells than there are columns"),
        (f"{HEAD}\na,block,1,,", "a block needs breadth_m and height_m; give it|needs height_m"),
        (HEAD, "the list is empty"),
        (
            "name,type,storey_heights_m\nf,facade,3.4 3.0",
            "must be numbers parted by semicolons, as in 3.4; 3.0",
        ),
        ("name,type,stands_on,breadth_m,height_m\na,block,roof,1,4", "no support of the list has this name"),
    ],
)
def test_rows_that_cannot_be(tmp_path, text, sentence):
    path = tmp_path / "structures.csv"
    path.write_text(text + "\n", encoding="utf-8")
    with pytest.raises(ConfigurationError, match=sentence):
        load_scenes(path)


S, O, U, X = Verdict.STANDS, Verdict.OVERTURNS, Verdict.UNCERTAIN, Verdict.CANNOT_BE_TOLD
TRIED = (0.0, 0.13, 0.218, 0.367, 0.617)


@pytest.mark.parametrize(
    ("verdicts", "sentence"),
    [
        ((S, S, S, S, S), "stands on the ground and on a building of T_b ≤ 0.617 s"),
        ((S, S, S, O, O), "stands on a building of T_b ≤ 0.218 s, overturns from 0.367 s on (tried to 0.617 s)"),
        ((S, O, O, O, O), "stands on the ground, overturns from 0.13 s on (tried to 0.617 s)"),
        ((S, S, U, O, S), "stands on a building of T_b ≤ 0.13 s, is uncertain at T_b 0.218 s, overturns at "
                          "T_b 0.367 s, stands at T_b 0.617 s"),
        ((S, O, O, S, S), "stands on the ground, overturns from 0.13 to 0.218 s, stands from 0.367 s on (tried to "
                          "0.617 s)"),
        ((S, X), "stands on the ground, cannot be told at T_b 0.13 s"),
        ((O, O, O, O, O), "overturns on the ground and on a building of T_b ≤ 0.617 s"),
    ],
)  # fmt: skip
def test_intervals(verdicts, sentence):
    pairs = list(zip(TRIED, verdicts, strict=False))
    assert periods_in_words(dict(reversed(pairs))) == sentence


def test_a_structure_is_called_with_the_period_where_it_has_one():
    assert placed("pier", None) == placed("pier", float("nan")) == "pier"
    assert placed("parapet", 0.0) == "parapet, on the ground"
    assert placed("parapet", 0.25) == "parapet, T_b 0.25 s"


def test_a_scene_is_hashed_once_and_anew_where_it_stands_elsewhere(tmp_path, monkeypatch):
    hashed = []

    def counted(*contents):
        hashed.append(contents)
        return sha256_of(*contents)

    monkeypatch.setattr("rocking.assessment.scene.sha256_of", counted)
    scenes = listed(
        tmp_path, f"name: pier, {BLOCK}", "name: statue, type: block, breadth_m: 0.4, height_m: 1.5"
    )
    assert structure_hashes(scenes) == structure_hashes(scenes)
    assert len(hashed) == len(set(structure_hashes(scenes).values())) == len(scenes)
    roof = place_from_config({"name": "roof", "period_s": 0.3, "damping_ratio": 0.05, "participation": 1.3})
    assert replace(scenes["pier"], place=roof).sha256 != scenes["pier"].sha256
