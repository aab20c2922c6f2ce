"""config.yaml: read and checked as a whole, and written, with its JSON schema, from the tree of settings.

After a change of the tree: python -m rocking.study.config_file workflow
"""

import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import Field, fields, is_dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any, get_type_hints

import yaml

from rocking.errors import ConfigurationError, RockingError
from rocking.quantities import allowed, as_typed, choices, is_allowed
from rocking.study.settings import EXAMPLE, Settings
from rocking.tables import write_whole


def read_settings(config: Mapping[str, Any]) -> Settings:
    """Return the settings in `config`, the mapping of a config.yaml; one that is left out gets its default.

    Raises ConfigurationError with every defect, one a line: the setting, its value, and what is allowed.
    """
    defects: list[str] = []
    made: Settings = _read(Settings, config, "", defects)
    if not defects:
        for part in ("assessment", "raw_processing"):
            try:
                getattr(made, part)
            except RockingError as error:
                defects.append(f"setting {error}")
    if defects:
        raise ConfigurationError("\n".join(defects))
    return made


def named_files(config: Mapping[str, Any]) -> Settings:
    """Return the default settings but for the files and folders that a defective `config` names all the same."""
    names = ("catalogue", "structures", "results")
    return Settings(**{name: config[name] for name in names if isinstance(config.get(name), str)})


def _read(kind: Any, config: object, above: str, defects: list[str]) -> Any:
    hints = get_type_hints(kind)
    if not isinstance(config, Mapping):
        where = above.rstrip(".") or "(top)"
        defects.append(f"setting {where} is {config!r}, but must be a mapping of {', '.join(hints)}.")
        return kind()
    for key in config:
        if key not in hints:
            unknown = f"setting {above}{key} is {config[key]!r}, but no setting has this name"
            defects.append(f"{unknown}; {_hint(key, hints)}")
    values = {}
    for each in (each for each in fields(kind) if each.name in config):
        value, expected = config[each.name], hints[each.name]
        if is_dataclass(expected):
            values[each.name] = _read(expected, value, f"{above}{each.name}.", defects)
        else:
            values[each.name] = _read_one(expected, each, value, above, defects)
    return kind(**values)


def _read_one(expected: Any, described: Field[Any], value: Any, above: str, defects: list[str]) -> Any:
    for said in (value, _as_said(value) if isinstance(value, str) else value):
        if is_allowed(expected, described, said):
            return as_typed(expected, said)
    unit, must = described.metadata["unit"], allowed(expected, described)
    shown = f"{value!r} {unit}" if unit and isinstance(value, int | float) else repr(value)
    defects.append(f"setting {above}{described.name} is {shown}, but must be {must}.")
    return value


def _hint(key: object, known: Mapping[str, Any]) -> str:
    near = get_close_matches(str(key), known, n=1, cutoff=0.6)
    return f"did you mean {near[0]}?" if near else f"the names are {', '.join(known)}."


def _as_said(text: str) -> object:
    """What a text says. snakemake --config hands on "true" and inner numbers as text, and for YAML 1.1 1e-6 is one."""
    if re.fullmatch(r"[+-]?\d+[eE][+-]?\d+", text):
        return float(text)
    try:
        return yaml.safe_load(text) if text.strip() else text  # nothing is no null
    except yaml.YAMLError:
        return text


def json_schema(kind: type = Settings) -> dict[str, Any]:
    """Return the JSON schema of config.yaml, for editors and for other programs."""
    hints, made = get_type_hints(kind), kind()
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": "Settings of a study"}
    properties = {
        each.name: json_schema(hints[each.name])
        if is_dataclass(hints[each.name])
        else _leaf_schema(hints[each.name], each, getattr(made, each.name))
        for each in fields(kind)
    }
    return {
        **(head if kind is Settings else {"description": " ".join((kind.__doc__ or "").split())}),
        "type": "object",
        "additionalProperties": False,
        "properties": properties,
    }


def _leaf_schema(kind: Any, described: Field[Any], default: object) -> dict[str, Any]:
    said, options = described.metadata, choices(kind, described)
    types = [_JSON_TYPES[option] for option in options if option in _JSON_TYPES]
    meaning = f"{said['meaning']}{', ' + said['unit'] if said['unit'] else ''}"
    return {
        **({"type": types[0] if len(types) == 1 else types} if types else {"enum": options}),
        **({"minLength": 1} if str in options else {}),
        **{_JSON_BOUNDS[name]: bound for name, bound in said["bounds"].items()},
        "description": meaning,
        "default": default,
    }


_JSON_TYPES = {bool: "boolean", int: "integer", float: "number", str: "string", None: "null"}
_JSON_BOUNDS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}


def commented_yaml(settings: Settings) -> str:
    """Return `settings` as a config.yaml in which every line says what it sets."""
    head = "# Every setting with its unit. What is left out keeps the value that it has here.\n"
    head += "# Paths are relative to the folder in which the study runs.\n"
    return head + "\n".join(_yaml_lines(settings)) + "\n"


def _yaml_lines(section: Any, indent: str = "") -> Iterator[str]:
    hints = get_type_hints(type(section))
    for each in fields(section):
        value, said = getattr(section, each.name), each.metadata
        if said.get("heading"):
            yield f"\n# {said['heading']} ".ljust(106, "-")
        if is_dataclass(value):
            yield f"{indent}{each.name}:"
            yield from _yaml_lines(value, indent + "  ")
        else:
            yield (
                f"{indent}{each.name}: {_scalar(value)} ".ljust(48) + f"# {_comment(hints[each.name], each)}"
            )


def _comment(kind: Any, described: Field[Any]) -> str:
    said = described.metadata
    null = None in choices(kind, described) and "null" not in said["meaning"]
    return ", ".join(filter(None, (said["meaning"], said["unit"], "or null" if null else "")))


def _scalar(value: object) -> str:
    if isinstance(value, float) and value and not 1e-4 <= abs(value) < 1e6:
        mantissa, exponent = f"{value:e}".split("e")
        return f"{float(mantissa)}e{int(exponent)}"
    return yaml.safe_dump(value).splitlines()[0]


def write_settings(workflow: Path) -> None:
    """Write config.yaml and schemas/config.schema.yaml of the shipped workflow into its folder."""
    schema = yaml.safe_dump(json_schema(), sort_keys=False, allow_unicode=True, width=117)
    head = "# Written from rocking.study.settings; edit that, then: python -m rocking.study.config_file workflow\n"
    write_whole(workflow / "config.yaml", commented_yaml(EXAMPLE).encode())
    write_whole(workflow / "schemas" / "config.schema.yaml", (head + schema).encode())


if __name__ == "__main__":
    write_settings(Path(sys.argv[1]))
