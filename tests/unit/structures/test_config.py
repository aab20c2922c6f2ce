"""Structures from mappings and files: degrees at the door, nearest key named, all defects at once."""

from pathlib import Path

import jsonschema
import numpy as np
import pytest
import yaml

from rocking.errors import ConfigurationError, StructureError
from rocking.structures import (
    Arch,
    Block,
    Frame,
    RigidBody,
    Spire,
    Wall,
    load_structures,
    structure_from_config,
)
from rocking.structures.config import FORMS

WORKFLOW = Path(__file__).parents[3] / "workflow"
SCHEMA = yaml.safe_load((WORKFLOW / "schemas" / "structures.schema.yaml").read_text(encoding="utf-8"))

CASES = [
    ({"type": "block", "breadth_m": 1, "height_m": 4}, Block.of_size(1, 4)),
    ({"type": "block", "semi_diagonal_m": 2, "slenderness_deg": 15}, Block(2, np.radians(15))),
    ({"type": "wall", "height_m": 3, "hinge_height_m": 2, "thickness_m": 0.3}, Wall(2, 1, 0.3)),
    ({"type": "wall", "lower_height_m": 2, "upper_height_m": 1, "thickness_m": 0.3}, Wall(2, 1, 0.3)),
    (
        {
            "type": "arch",
            "name": "a",
            "radius_m": 10,
            "thickness_m": 1.5,
            "embrace_angle_deg": 157.5,
            "voussoirs": 7,
        },
        Arch(10, 1.5, np.radians(157.5), 7),
    ),
    (
        {"type": "frame", "column_breadth_m": 1, "column_height_m": 6, "columns": 3, "beam_mass_ratio": 0.4},
        Frame(Block.of_size(1, 6), 3, 0.4),
    ),
    (
        {
            "type": "spire",
            "width_m": 3,
            "height_m": 12,
            "plan": "square",
            "wall_thickness_m": 0.3,
            "restitution": 0.8,
        },
        Spire(3, 12, 0.3, "square", restitution=0.8),
    ),
    (
        {"type": "rigid_body", "left_m": 0.4, "right_m": 0.6, "centre_height_m": 2, "inertia_m2": 1.5},
        RigidBody(0.4, 0.6, 2, 1.5),
    ),
]


@pytest.mark.parametrize("mapping, structure", CASES, ids=lambda value: getattr(value, "type", ""))
def test_every_form_makes_its_structure(mapping, structure):
    assert structure_from_config(mapping) == structure


def test_every_form_is_tested_and_stands_in_the_schema():
    tried = {frozenset(form.required) for kind in FORMS.values() for form in kind}
    given = [set(mapping) for mapping, _ in CASES]
    assert all(any(keys <= mapping for mapping in given) for keys in tried)
    objects = [entry for entry in SCHEMA["definitions"].values() if "properties" in entry]
    in_schema = {
        (entry["properties"]["type"]["const"], frozenset(entry["required"]), frozenset(entry["properties"]))
        for entry in objects
    }
    always = {"name", "type"}
    in_code = {
        (kind, frozenset(form.required) | always, frozenset(form.keys) | always)
        for kind, forms in FORMS.items()
        for form in forms
    }
    assert in_schema == in_code
    assert len(SCHEMA["items"]["oneOf"]) == len(objects)


def test_shipped_structures_stand_and_pass_the_schema():
    path = WORKFLOW / "structures.yaml"
    jsonschema.validate(yaml.safe_load(path.read_text(encoding="utf-8")), SCHEMA)
    structures = load_structures(path)
    assert len(structures) == 10
    assert {type(structure) for structure in structures.values()} == {Arch, Block, Frame, Spire, Wall}
    assert all(structure.mechanism().uplift_multiplier > 0 for structure in structures.values())
    assert structures["arch 10 m"] == Arch(10, 1.5, np.radians(157.5), restitution=0.9)


@pytest.mark.parametrize(
    "mapping, message",
    [
        ({"type": "arc"}, r"type is 'arc', but must be one of block, wall, arch.*did you mean arch\?"),
        ({}, "type is None"),
        ([1], "must be a mapping"),
        (
            {"type": "arch", "radius": 1, "thickness_m": 0.2},
            r"radius is not a key of an arch \(did you mean radius_m\?",
        ),
        ({"type": "wall", "height_m": 3, "thickness_m": 0.3}, "a wall needs hinge_height_m; give it"),
        (
            {"type": "block", "breadth_m": 1, "height_m": 4, "slenderness_deg": 3},
            "slenderness_deg beside breadth_m",
        ),
        ({"type": "block", "breadth_m": 1, "height_m": 4, "one_sided": "yes"}, "one_sided is 'yes'"),
    ],
)
def test_a_bad_mapping_is_refused_in_one_sentence(mapping, message):
    with pytest.raises(ConfigurationError, match=message):
        structure_from_config(mapping)


def test_an_angle_that_is_no_number_is_refused():
    with pytest.raises(StructureError, match="embrace_angle_deg is 'wide', but must be a number"):
        structure_from_config(
            {"type": "arch", "radius_m": 1, "thickness_m": 0.2, "embrace_angle_deg": "wide"}
        )


def test_all_defects_of_a_list_stand_in_one_message(tmp_path):
    path = tmp_path / "structures.yaml"
    path.write_text(
        "- {name: a, type: block, breadth_m: 1, height_m: 4}\n"
        "- {name: a, type: block, breadth_m: 1, height_m: 5}\n"
        "- {type: block, breadth_m: 1, height_m: 5}\n"
        "- {name: thin, type: arch, radius_m: 10, thickness_m: 1, embrace_angle_deg: 180}\n"
        "- {name: typo, type: wall, height_m: 3, hinge_heigth_m: 1, thickness_m: 0.3}\n",
        encoding="utf-8",
    )
    with pytest.raises(ConfigurationError) as caught:
        load_structures(path)
    lines = str(caught.value).splitlines()
    assert [line.split(": ")[1].split(" (")[0] for line in lines] == [f"structure {n}" for n in (2, 3, 4, 5)]
    assert "already taken" in lines[0]
    assert "name is None" in lines[1]
    assert "1.07478038 m" in lines[2]
    assert "did you mean hinge_height_m?" in lines[3]


@pytest.mark.parametrize(
    "text, message",
    [
        ("{a: 1", "not valid YAML"),
        ("", "must hold a list"),
        ("a: 1", "must hold a list"),
        ("- {name: a, type: block, height_m: 1, height_m: 4}", "key 'height_m' is given twice"),
        ("- !!python/object/apply:os.getcwd []", "not valid YAML"),
    ],
)
def test_a_file_that_is_no_list_is_refused(tmp_path, text, message):
    path = tmp_path / "structures.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError, match=message):
        load_structures(path)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(ConfigurationError, match="cannot be read"):
        load_structures(tmp_path / "none.yaml")
