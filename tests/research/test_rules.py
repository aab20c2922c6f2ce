"""The rules of the research and the functions that they run are the same names."""

import ast
import re
from pathlib import Path

import pytest

from rocking.catalogue import load_catalogue
from rocking.errors import CatalogueError
from tests.refusals import refused

ROOT = Path(__file__).parents[2]
RULES = ROOT / "docs" / "research" / "research.smk"
OF_ITS_OWN = "validate"
"""The target that reads no accelerograms, and that `main` runs before it asks for the others."""


def _names_of_rules() -> set[str]:
    table = re.search(r"^TARGETS_OF_RESEARCH = (\{.*?^\})", RULES.read_text(encoding="utf-8"), re.M | re.S)
    assert table, "the table of the rules is written otherwise"
    keys = ast.parse(table[1], mode="eval").body
    assert isinstance(keys, ast.Dict)
    return {ast.literal_eval(key) for key in keys.keys if key is not None}


def test_each_rule_runs_a_function_and_each_function_has_a_rule(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    from docs.research.run import targets

    assert {*targets(), OF_ITS_OWN} == _names_of_rules()
    assert all(callable(function) for function in targets().values())


@pytest.mark.parametrize("name", sorted(_names_of_rules()))
def test_no_record_has_the_name_of_a_target(tmp_path, name):
    """The folder of a target stands beside those of the records."""
    catalogue = tmp_path / "catalogue.csv"
    catalogue.write_text(f"id,file\n{name},a.AT2\n", encoding="utf-8")
    with refused(CatalogueError, "catalogue"):
        load_catalogue(catalogue)
