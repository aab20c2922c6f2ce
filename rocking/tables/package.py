"""The description of tables for a machine."""

import json
from collections.abc import Mapping

from rocking.tables.row import Column, Table


def data_package(name: str, resources: Mapping[str, tuple[Table, str | list[str]]]) -> bytes:
    """Return a Frictionless datapackage.json: for each resource its table and the file, or files, that hold it."""
    described = [_resource(resource, table, path) for resource, (table, path) in resources.items()]
    content = {"profile": "tabular-data-package", "name": name, "resources": described}
    return (json.dumps(content, indent=1) + "\n").encode()


def _resource(name: str, table: Table, path: str | list[str]) -> dict[str, object]:
    return {
        "name": name,
        "path": path,
        "profile": "tabular-data-resource",
        "description": table.description,
        "schema": {"fields": [_field(each) for each in table.columns], "missingValues": ["", "nan"]},
    }


def _field(described: Column) -> dict[str, str]:
    known = {"name": described.name, "type": described.type, "description": described.description}
    more = {"unit": described.unit, "equation": described.equation}
    return known | {key: value for key, value in more.items() if value}
