"""The JSON schema of a structure list, from the forms of every registered type."""

import yaml

from rocking.structures.fields import Field, Form
from rocking.structures.registry import TYPES

_HEAD = "# Written from rocking/structures by `make schema`; edit the structure's own file instead.\n"
_NAME = {
    "type": "string",
    "minLength": 1,
    "description": "Name of the structure in every table; each its own",
}


def structures_schema() -> dict[str, object]:
    """Return the schema (draft 7); a definition for each form of each type."""
    definitions = {
        kind if len(each.forms) == 1 else f"{kind}_{number}": _definition(kind, form)
        for kind, each in TYPES.items()
        for number, form in enumerate(each.forms, start=1)
    }
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Structures to assess",
        "type": "array",
        "minItems": 1,
        "items": {"oneOf": [{"$ref": f"#/definitions/{name}"} for name in definitions]},
        "definitions": definitions,
    }


def structures_schema_file() -> str:
    """Return the schema as the YAML file of the workflow."""
    return _HEAD + yaml.dump(
        structures_schema(), Dumper=_PlainDumper, sort_keys=False, allow_unicode=True, width=110
    )


class _PlainDumper(yaml.SafeDumper):
    """Every value in its place, without anchors."""

    def ignore_aliases(self, data: object) -> bool:
        return True


def _definition(kind: str, form: Form) -> dict[str, object]:
    properties = {each.key: _property(each) for each in form.fields}
    return {
        "description": form.meaning,
        "type": "object",
        "additionalProperties": False,
        "required": ["name", "type", *form.required],
        "properties": {"name": dict(_NAME), "type": {"const": kind}, **properties},
        "examples": [
            {"name": f"my {kind}", "type": kind, **{each.key: each.example for each in form.fields}}
        ],
    }


def _property(each: Field) -> dict[str, object]:
    usual = f"; usually {each.usual[0]:g} to {each.usual[1]:g}" if each.usual and each.unit else ""
    unit = f", {each.unit}" if each.unit else ""
    return {**each.schema, "description": f"{each.meaning}{unit}{usual}"}
