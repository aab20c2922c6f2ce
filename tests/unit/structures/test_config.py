"""Structures from mappings and files: degrees at the door, nearest key named, all defects at once."""

import dataclasses
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import yaml

from rocking.assessment.scene import load_scenes, scenes_schema, scenes_schema_file
from rocking.errors import ConfigurationError, StructureError
from rocking.floors.place import PERIODS
from rocking.structures import Arch, Block, Facade, Frame, Spire, Wall, structure_from_config
from rocking.structures.building_parts import FreeWall
from rocking.structures.kinds import StructureKind
from tests.refusals import refused

WORKFLOW = Path(__file__).parents[3] / "workflow"
SCHEMA = yaml.safe_load((WORKFLOW / "schemas" / "structures.schema.yaml").read_text(encoding="utf-8"))


def test_degrees_and_kilonewtons_stay_at_the_door():
    block = {"type": "block", "semi_diagonal_m": 2, "slenderness_deg": 15}
    assert structure_from_config(block) == Block(2, np.radians(15))
    facade = {
        "type": "facade",
        "storey_heights_m": [3.5, 3],
        "thicknesses_m": [0.6, 0.5],
        "unit_weight_kN_m3": 20,
    }
    facade |= {"floor_loads_kN_m": [12, 6], "tie_heights_m": [3.4], "tie_stiffness_kN_m2": 100}
    made = Facade((3.5, 3), (0.6, 0.5), 20e3, (12e3, 6e3), tie_heights=(3.4,), tie_stiffness=1e5)
    assert structure_from_config(facade) == made


def test_the_schema_of_the_workflow_is_the_fields_own():
    written = (WORKFLOW / "schemas" / "structures.schema.yaml").read_text(encoding="utf-8")
    assert written == scenes_schema_file(), "run `make schema`"
    assert scenes_schema() == SCHEMA


def test_shipped_structures_stand_and_pass_the_schema():
    path = WORKFLOW.parent / "config" / "structures.yaml"
    jsonschema.validate(yaml.safe_load(path.read_text(encoding="utf-8")), SCHEMA)
    scenes = load_scenes(path)
    carried = [len(one_scene.place.supports) for one_scene in scenes.values() if one_scene.place.supports]
    assert len(scenes) == 10 + 2
    assert sorted(carried) == [1, PERIODS]
    structures = {name: scene.structure for name, scene in scenes.items()}
    assert {type(structure) for structure in structures.values()} == {
        Arch,
        Block,
        Facade,
        FreeWall,
        Frame,
        Spire,
        Wall,
    }
    front = structures["facade"]
    assert front.tie_heights and front.anchor_height and front.floor_loads and front.leaves and front.bonders
    assert all(structure.mechanism().uplift_multiplier > 0 for structure in structures.values())
    assert structures["arch 10 m"] == Arch(10, 1.5, np.radians(157.5), restitution=0.9)


SLIM = {"type": "block", "breadth_m": 1, "height_m": 4}


@pytest.mark.parametrize(
    "mapping, key, value, hint",
    [
        ({"type": "arc"}, "type", "arc", "(did you mean arch?)"),
        ({}, "type", None, ""),
        ([1], "structure", [1], ""),
        ({"type": "arch", "radius": 1}, "radius", 1, "(did you mean radius_m?)"),
        ({"type": "wall", "height_m": 3, "hinge_height_m": 1}, "thickness_m", None, ""),
        (SLIM | {"slenderness_deg": 3}, "slenderness_deg", 3, ""),
        (SLIM | {25: None}, "25", None, "write a number with a point, as in 3.25."),
        (SLIM | {25: 1}, "25", 1, "25 is not a key of a block; use "),
        (SLIM | {"one_sided": "yes"}, "one_sided", "'yes'", ""),
    ],
)
def test_a_bad_mapping_is_refused_by_its_key(mapping, key, value, hint):
    with refused((ConfigurationError, StructureError), key, value) as caught:
        structure_from_config(mapping)
    assert hint in str(caught.value)


@pytest.fixture
def load(tmp_path):
    """Load the structures of a text."""

    def loaded(text):
        path = tmp_path / "structures.yaml"
        path.write_text(text, encoding="utf-8")
        return {name: scene.structure for name, scene in load_scenes(path).items()}

    return loaded


def test_a_list_of_a_number_beyond_all_floats_is_refused(load):
    with pytest.raises(ConfigurationError, match=r"storey_heights_m is 9{90}.*, but must be a list"):
        load(
            f"- {{name: f, type: facade, storey_heights_m: {'9' * 400}, thicknesses_m: [0.5], unit_weight_kN_m3: 18}}"
        )


def test_an_entry_without_a_name_is_told_of_that_alone(load):
    with pytest.raises(ConfigurationError) as caught:
        load("- {name: '', type: block, breadth_m: 1, height_m: 4}")
    assert len(str(caught.value).splitlines()) == 1


def test_all_defects_of_a_list_stand_in_one_message(load):
    text = (
        "- {name: a, type: block, breadth_m: 1, height_m: 4}\n"
        "- {name: a, type: block, breadth_m: 1, height_m: 5}\n"
        "- {type: block, breadth_m: 1, height_m: 5}\n"
        "- {name: thick, type: arch, radius_m: 10, thickness_m: 21, embrace_angle_deg: 115}\n"
        "- {name: typo, type: wall, height_m: 3, hinge_heigth_m: 1, thickness_m: 0.3}\n"
    )
    with pytest.raises(ConfigurationError) as caught:
        load(text)
    lines = str(caught.value).splitlines()
    assert [line.split(": ")[1].split(" (")[0] for line in lines] == [f"structure {n}" for n in (2, 3, 4, 5)]
    assert "already taken" in lines[0]
    assert "name is missing" in lines[1]
    assert "less than twice the radius" in lines[2]
    assert "did you mean hinge_height_m?" in lines[3]


@pytest.mark.parametrize(
    "text, message",
    [
        ("{a: 1", "in line 1: the file ends within braces, brackets or quotation marks; close them"),
        ("a: 1", r"must hold a list of structures, each behind a dash, as in - {name: pier"),
        (
            "- {name: 12, type: block}",
            "name is 12, but must be a text of its own; write it in quotation marks",
        ),
        ("- {type: block}", "name is missing, but must be a text of its own; give it"),
        ("[]", "the list is empty, but must hold one structure at least"),
        (
            "- {name: hollow, type: cavity_wall, height_m: 3, thickness_m: 0.3, leaves_m: []}",
            "a cavity wall needs leaves_m; give it",
        ),
        (
            "- {name: front, type: facade, storey_heights_m: [3], thicknesses_m: [0.5], unit_weight_kN_m3: 18, "
            "anchor_width_m: 1}",
            "tie_spacing_m is missing, but anchor_width_m needs",
        ),
        ("", "holds nothing, but must hold a list"),
        ("- {name: a, type: block, height_m: 1, height_m: 4}", "key 'height_m' is given twice"),
        ("- !!python/object/apply:os.getcwd []", "line 1: a tag, .* is not read here; write the value alone"),
        ("- &a {name: a, type: block, breadth_m: 1, height_m: 4}", "an anchor or an alias is not read here"),
        (
            "- {name: a,\n   type: block, height_m: 1,\n   height_m: 4}",
            "in line 3: key 'height_m' is given twice",
        ),
        (
            "- name: a\n   type: block\n",
            "in line 2: it does not begin where the lines around it do; begin all",
        ),
        (
            "- name: a\n  type: block\n height_m: 4\n",
            "in line 3: it does not begin where the lines around it do",
        ),
        (
            "- name: a\n  note: wall: old\n",
            "in line 2: .* put a text that holds a colon into quotation marks",
        ),
        ("- name: a\n\ttype: block\n", "in line 2: a tab stands where only blanks may; write blanks"),
        ("[" * 1000 + "]" * 1000, "nested too deeply"),
        *((f'- {{name: "a{mark}b"}}', "printable") for mark in ("\u202e", r"\u202e", r"\0", r"\ud800")),
        ("# " + "x" * 1_000_000, "larger than 1000000 bytes"),
        ("- {name: a, type: block, breadth_m: " + "1" * 5000 + ", height_m: 4}", "not valid YAML"),
    ],
)
def test_a_file_that_is_no_list_is_refused(load, text, message):
    with pytest.raises(ConfigurationError, match=message):
        load(text)


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (
            "3.9 m",
            "height_m is '3.9 m', but must be a number .*; write the number alone, without 'm', in the unit",
        ),
        (
            "390 cm",
            "height_m is '390 cm', but must be a number .*; write the number alone, without 'cm', in the unit",
        ),
        (
            "'3.9'",
            "height_m is '3.9', but must be a number .*; write the number without quotation marks",
        ),
        ("[3.9]", r"height_m is \[3.9\], but must be a number"),
        ("-3.9", "height_m is -3.9 m, but must be a number"),
    ],
)
def test_a_value_is_refused_by_the_key_and_as_it_was_typed(load, value, said):
    with pytest.raises(ConfigurationError, match=rf"structure 1 \(w\): {said}"):
        load(f"- {{name: w, type: wall, height_m: {value}, thickness_m: 0.4}}")


def test_a_list_is_asked_for_in_brackets_and_an_angle_by_its_key(load):
    facade = "thicknesses_m: [0.5], unit_weight_kN_m3: 18"
    with pytest.raises(
        ConfigurationError, match=r"storey_heights_m is 3\.5 m, but must be a list.*; write \[3\.5\]"
    ):
        load(f"- {{name: f, type: facade, storey_heights_m: 3.5, {facade}}}")
    with pytest.raises(
        ConfigurationError, match=r"embrace_angle_deg is 2\.75 °, but must be a number from 5"
    ):
        load("- {name: a, type: arch, radius_m: 10, thickness_m: 1.5, embrace_angle_deg: 2.75}")


@pytest.mark.parametrize(
    ("sizes", "told"),
    [
        (
            "type: block, breadth_m: 6, height_m: 1",
            "breadth_m is 6 m and height_m 1 m: a body this",
        ),
        ("type: block, breadth_m: 1, height_m: 1", None),
        ("type: free_wall, thickness_m: 0.3, height_m: 2, breadth_m: 10", None),
        ("type: parapet, thickness_m: 0.9, height_m: 0.8", "thickness_m is 0.9 m and height_m 0.8 m"),
        ("type: wall, height_m: 0.6, thickness_m: 0.7", "thickness_m is 0.7 m and height_m 0.6 m"),
    ],
)
def test_a_body_that_is_broader_than_tall_gets_a_warning(tmp_path, sizes, told):
    path = tmp_path / "list.yaml"
    path.write_text(f"- {{name: w, {sizes}}}\n")
    said = [
        str(warning)
        for warning in load_scenes(path)["w"].warnings
        if warning.kind is StructureKind.BROADER_THAN_TALL
    ]
    assert [told in item for item in said] == ([True] if told else [])


def test_a_file_in_other_letters_says_how_to_save_it(tmp_path):
    path = tmp_path / "structures.yaml"
    for content in ("- {name: südwand, type: wall}".encode("latin-1"), "- {name: wall}".encode("utf-16")):
        path.write_bytes(content)
        with pytest.raises(ConfigurationError, match="its letters are not those of UTF-8; save it as UTF-8"):
            load_scenes(path)


def test_no_storey_is_lower_than_other_sizes_may_be(load):
    sizes = "storey_heights_m: [3.5, 1.0e-300], thicknesses_m: [0.6, 0.5], unit_weight_kN_m3: 20"
    with pytest.raises(ConfigurationError, match=r"storey_heights.* 1e-300.*from 0\.0001 to 1000"):
        load(f"- {{name: f, type: facade, {sizes}}}")


def test_a_name_ends_somewhere(load):
    text = "- {{name: {name}, type: block, breadth_m: 1, height_m: 4}}"
    assert list(load(text.format(name="a" * 200))) == ["a" * 200]
    with pytest.raises(ConfigurationError, match="name has 201 characters, but may have 200; shorten it"):
        load(text.format(name="a" * 201))


def test_sizes_are_said_as_they_were_typed(load):
    structures = load(
        "- {name: f, type: block, breadth_m: 0.60, height_m: 6.0, one_sided: true, restitution: 0.5}\n"
        "- {name: a, type: arch, radius_m: 10.00, thickness_m: 1.50, embrace_angle_deg: 157.5, voussoirs: 7}\n"
    )
    facade, arch = structures.values()
    assert facade.description == "breadth 0.60 m, height 6.0 m, restitution 0.5, one-sided"
    assert facade.described.size == "0.60 × 6.0 m"
    assert arch.described.size == "10.00 × 1.50 m, 157.5°"
    assert [f"{d.letter} {d.text}" for d in arch.dimensions()] == ["r 10.00 m", "t 1.50 m", "β 157.5°"]
    moved = dataclasses.replace(facade, slenderness=0.2)
    assert moved.description.startswith("breadth 1.19"), "a copy with other sizes is described anew"


def test_what_is_not_usual_is_a_warning_and_not_a_refusal(tmp_path):
    text = "- {name: w, type: wall, height_m: 3200, hinge_height_m: 1600, thickness_m: 250}"
    path = tmp_path / "list.yaml"
    path.write_text(text)
    said = [
        str(warning)
        for warning in load_scenes(path)["w"].warnings
        if warning.kind is StructureKind.SIZE_UNUSUAL
    ]
    assert len(said) == 3
    assert "w: height_m is 3200 m, but is usually between 0.5 and 60 m" in said[0]


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        (
            "{name:a, type: block, breadth_m: 1, height_m: 6}",
            "name:a has no blank behind its colon; write name: a.",
        ),
        (
            "{name: a, type:block, breadth_m: 1, height_m: 6}",
            "type:block has no blank behind its colon; write type: b",
        ),
        ("{name: a, breadth_m: 1, height_m: 6}", "type is missing, but must be one of"),
    ],
)
def test_a_blank_that_was_forgotten_and_what_is_missing_are_one_sentence(load, entry, said):
    with pytest.raises(ConfigurationError) as refused:
        load(f"- {entry}")
    assert said in str(refused.value) and str(refused.value).count("\n") == 0
