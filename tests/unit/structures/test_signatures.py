"""What `help` shows of a structure fits on a screen, and a list is read from Python as the workflow reads it."""

import inspect
from pathlib import Path

import pytest

import rocking
from rocking.assessment.scene import load_scenes
from rocking.errors import RockingError, StructureWarning
from rocking.floors.place import GROUND
from rocking.structures.structure import Structure
from rocking.structures.structure_list import TYPES, structure_from_config
from tests.refusals import refused

KINDS = [
    kind
    for name in dir(rocking)
    if inspect.isclass(kind := getattr(rocking, name)) and issubclass(kind, Structure)
]
LIST = "config/structures.yaml"


@pytest.mark.parametrize("kind", KINDS)
def test_the_signature_of_a_structure_is_its_parameters_and_their_types(kind: type[Structure]) -> None:
    shown = inspect.signature(kind)
    assert "Annotated" not in str(shown) and "Value(" not in str(shown)
    assert all(len(str(parameter)) < 120 for parameter in shown.parameters.values())  # a line each
    _, *every = inspect.signature(kind.__init__).parameters.values()
    true = [parameter for parameter in every if parameter.name != "joints"]  # which `on_joints` gives
    assert [
        (one_parameter.name, one_parameter.default, one_parameter.kind)
        for one_parameter in shown.parameters.values()
    ] == [(other_parameter.name, other_parameter.default, other_parameter.kind) for other_parameter in true]
    assert "meaning=" not in str(inspect.signature(kind.__init__))


def test_a_parameter_is_stated_with_its_letter_and_its_unit_in_si() -> None:
    assert "    thickness : float\n        Thickness, t, m.\n" in (rocking.Wall.__doc__ or "")


def test_a_list_is_read_from_python_without_what_stands_on_a_support() -> None:
    scenes = load_scenes(LIST)
    with pytest.warns(StructureWarning, match="structures on a support are left out, parapet"):
        structures = rocking.read_structures(LIST)
    assert structures == {name: scene.structure for name, scene in scenes.items() if scene.place == GROUND}
    assert len(scenes) > len(structures) > 3


def test_a_list_in_csv_may_have_notes(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(
        "name,type,height_m,thickness_m,note\nwall 1,free_wall,2.2,0.3,see photo 12\n,,,,only a note\n"
    )
    assert list(rocking.read_structures(tmp_path / "a.csv")) == ["wall 1"]


def test_a_wrong_folder_of_results_is_refused_at_once(tmp_path: Path) -> None:
    (tmp_path / "results" / "summary").mkdir(parents=True)
    with refused(RockingError, "folder", tmp_path) as caught:
        rocking.open_results(tmp_path)
    assert f"name {tmp_path / 'results'}." in str(caught.value)
    assert rocking.open_results(tmp_path / "results")
    with refused(RockingError, "folder", tmp_path / "results" / "summary"):
        rocking.open_results(tmp_path / "results" / "summary")


def test_nothing_rocks_to_one_side_alone_unless_it_is_said():
    forms = ((name, form) for name, of_type in TYPES.items() for form in of_type if "file" not in form.keys)
    made = [
        structure_from_config(
            {"type": name} | {key: field.value.example for key, field in form.keys.items() if field.required}
        )
        for name, form in forms
    ]
    made += [rocking.Block(2.0, 0.2), rocking.Block.of_size(0.5, 3.0)]
    made.append(rocking.CapacityCurve((0.0, 0.1), (0.2, 0.0), 1e4, 0.9))
    assert len(made) > 15
    for structure in made:
        assert not structure.one_sided and not structure.mechanism().one_sided, structure
        assert not structure.mechanism().equivalent_block().one_sided
