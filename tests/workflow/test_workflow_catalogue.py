"""What the Snakemake workflow catalogue and a citation ask for: files that are there and true, rules in its style."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

import rocking
from rocking.catalogue.catalogue import CatalogueRecord
from rocking.errors import CatalogueError
from rocking.structures.structure_list import TYPES
from rocking.study.outputs import OUTPUTS

ROOT = Path(rocking.__file__).parents[1]


def loaded(name: str):
    return yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))


def test_every_setting_and_type_that_the_configuration_page_names_exists():
    text = (ROOT / "config" / "README.md").read_text(encoding="utf-8")
    schema = loaded("workflow/schemas/config.schema.yaml")["properties"]
    for name in re.findall(r"^\| `([\w.]+)` \|", text, re.M):
        top, _, inner = name.partition(".")
        assert top in schema and (not inner or inner in schema[top]["properties"]), name
    (kinds,) = re.findall(r"a `type` \(such as (.*?)\)", text)
    assert set(kinds.split(", ")) <= set(TYPES)
    for entry in yaml.safe_load(re.findall(r"```yaml\n(.*?)```", text, re.S)[0]):
        rocking.structure_from_config(entry)


def test_no_record_can_take_the_name_of_a_folder_of_the_results():
    research = (ROOT / "docs" / "research" / "research.smk").read_text(encoding="utf-8")
    rules = [path.read_text(encoding="utf-8") for path in (ROOT / "workflow").rglob("*.smk")]
    folders = set(re.findall(r"\{RESULTS\}/(\w+)", "".join(rules)))
    outputs = (output.path for of_kind in OUTPUTS.values() for output in of_kind)
    folders |= {path.partition("/")[0] for path in outputs if "/" in path and not path.startswith(("{", "."))}
    # A target of the research names its folder.
    folders |= set(re.findall(r'^    "(\w+)": \(', research, re.M))
    assert {"compare", "fragility", "govern", "summary", "validate"} <= folders
    for folder in folders:
        with pytest.raises(CatalogueError, match=f"id is '{folder}'"):
            CatalogueRecord(folder, "record.txt", "0" * 64, unit="g")


def test_the_citation_is_of_this_version():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    citation = loaded("CITATION.cff")
    assert citation["version"] == citation["preferred-citation"]["version"] == project["version"]
    assert citation["license"] == project["license"]
    for reference in citation["references"]:
        assert reference["title"] and all(author["family-names"] for author in reference["authors"])
