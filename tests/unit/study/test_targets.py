"""Files that a user names to be written: one that this package did not write is never replaced, by any verb."""

import math

import pytest
import yaml

from rocking.study.cli import _parser, main
from rocking.study.job import Study
from tests.made_pools import DESIGN

BLOCKS = "- {name: slender, type: block, breadth_m: 0.5, height_m: 3.0}\n"
SINE = "".join(f"{step / 100:.2f} {0.5 * math.sin(step / 20):.9f}\n" for step in range(1200))
"""A record in g: time in s, acceleration."""
PLACES = {
    ("catalogue", "output"): ["catalogue", "study/records", "--output", "{}"],
    ("assess", "pdf"): ["assess", "a.txt", "--unit", "g", "--structures", "blocks.yaml", "--pdf", "{}"],
    ("assess", "output"): [
        "assess",
        "a.txt",
        "--unit",
        "g",
        "--structures",
        "blocks.yaml",
        "--output",
        "out",
    ],
    ("spectrum", "output"): ["spectrum", "a.txt", "--unit", "g", "--output", "{}"],
    ("select", "output"): ["select", "study", "--output", "{}"],
    ("strengthen", "output"): ["strengthen", "study", "slender", "breadth_m", "0.2..2", "--output", "out"],
}
"""A command line for each option that names what is written; {}: the file."""
IN_FOLDER = {
    "assess": ["a/report.pdf", "a/comparison.csv", "summary/structures.csv"],
    "strengthen": ["slender_breadth_m.csv", "slender_breadth_m.svg", "slender_breadth_m.cases"],
}
"""What a verb writes into the folder that is named."""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Two records, a list of structures, and a study at a design level."""
    monkeypatch.chdir(tmp_path)
    for name in ("a.txt", "b.txt"):
        (tmp_path / name).write_text(SINE)
    (tmp_path / "blocks.yaml").write_text(BLOCKS)
    records = tmp_path / "study" / "records"
    records.mkdir(parents=True)
    (records / "own.txt").write_text(SINE)
    (records / "catalogue.csv").write_text("id,file,unit\nown,own.txt,g\n")
    (tmp_path / "study" / "structures.yaml").write_text(BLOCKS)
    (tmp_path / "study" / "config.yaml").write_text(yaml.safe_dump(DESIGN))
    return tmp_path


def _options_that_name_a_file():
    (verbs,) = (action for action in _parser()._actions if isinstance(action.choices, dict))
    return {
        (verb, action.dest)
        for verb, parser in verbs.choices.items()
        for action in parser._actions
        if action.option_strings and action.type is not None and action.type.__name__ == "Path"
    }


def test_every_option_that_names_a_file_to_write_is_tried_here():
    assert _options_that_name_a_file() == set(PLACES)


def _foreign():
    """Yield for each verb the targets at which a file of the user's lies: a record, a list or a name of its own."""
    for (verb, option), arguments in PLACES.items():
        if "out" in arguments:
            yield from ((verb, option, f"out/{name}") for name in IN_FOLDER[verb])
        else:
            ending = "pdf" if option == "pdf" else "csv"
            beside = "study/records/" if verb == "select" else ""
            yield from (
                (verb, option, f"{beside}{name}") for name in ("a.txt", "blocks.yaml", f"theirs.{ending}")
            )


@pytest.mark.parametrize(("verb", "option", "target"), list(_foreign()))
def test_a_file_of_the_user_is_refused_before_any_work(folder, monkeypatch, capsys, verb, option, target):
    monkeypatch.setattr(Study, "open", lambda *_: pytest.fail("a record was read first"))
    path = folder / target
    path.parent.mkdir(exist_ok=True, parents=True)
    if not path.exists():
        path.write_bytes(b"%PDF-1.7\n of another program" if path.suffix == ".pdf" else b"id,name\n1,mine\n")
    before = {one_path: one_path.read_bytes() for one_path in folder.rglob("*") if one_path.is_file()}
    assert main([argument.format(target) for argument in PLACES[verb, option]]) == 2
    assert path.name in capsys.readouterr().err
    assert {
        other_path: other_path.read_bytes() for other_path in folder.rglob("*") if other_path.is_file()
    } == before


@pytest.mark.parametrize(("verb", "option"), [key for key, line in PLACES.items() if "out" not in line])
def test_a_new_file_has_the_ending_of_its_kind(folder, capsys, verb, option):
    target = "study/records/new.txt" if verb == "select" else "new.txt"
    assert main([argument.format(target) for argument in PLACES[verb, option]]) == 2
    assert "give a name that ends in ." in capsys.readouterr().err
    assert not (folder / target).exists()


@pytest.mark.parametrize("pattern", [["--pdf", "a.txt", "b.txt"], ["a.txt", "--pdf", "blocks.yaml"]])
def test_a_pattern_behind_pdf_costs_no_record(folder, capsys, pattern):
    before = (folder / "a.txt").read_bytes()
    assert main(["assess", "--unit", "g", "--structures", "blocks.yaml", *pattern]) == 2
    assert "is not replaced" in capsys.readouterr().err
    assert (folder / "a.txt").read_bytes() == before and (folder / "blocks.yaml").read_text() == BLOCKS


@pytest.mark.process
@pytest.mark.parametrize(("verb", "target"), [("assess", "r.pdf"), ("assess", "out"), ("spectrum", "s.csv")])
def test_what_was_written_is_replaced(folder, verb, target):
    option = "pdf" if target == "r.pdf" else "output"
    arguments = [argument.format(target) for argument in PLACES[verb, option]]
    assert main(arguments) == 0
    assert main(arguments) == 0
