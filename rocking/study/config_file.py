"""config.yaml: read and checked as a whole, and written, with its JSON schema, from the settings.

After a change of the settings: python -m rocking.study.config_file workflow
"""

import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

from rocking.described import Described, described_values, parts_of, read_described
from rocking.errors import ConfigurationError
from rocking.study.settings import EXAMPLE, Settings
from rocking.tables import write_whole

LAYOUT = {
    "Records and structures": ("catalogue", "structures", "results", "mirror"),
    "Processing, told in every report": ("processing",),
    "Method": (
        *("acceleration_scale", "tolerance", "vertical", "friction_coefficient", "pulse", "candidates"),
        *("processing_variants", "fidelity", "fidelity_risk"),
    ),
    "Ensemble: what is not known of a case varies within these ranges": ("ensemble",),
    "Fragility from all records of the study: snakemake fragility": ("fragility",),
    "Trade of error for time: snakemake trade": ("trade",),
    "Output": ("reports", "histories", "records_per_job"),
}
"""The settings in the order of config.yaml, below their headings."""


def read_settings(config: Mapping[str, Any]) -> Settings:
    """Return the settings in `config`, the mapping of a config.yaml; one that is left out gets its default.

    Raises ConfigurationError with every defect, one a line: the setting, its value, and what is allowed.
    """
    defects: list[str] = []
    made = read_described(Settings(), config, defects, "setting ", _as_said)
    if defects:
        raise ConfigurationError("\n".join(defects))
    return made


def named_files(config: Mapping[str, Any]) -> Settings:
    """Return the default settings but for the files and folders that a defective `config` names all the same."""
    names = ("catalogue", "structures", "results")
    return Settings(
        **{name: config[name] for name in names if isinstance(config.get(name), str) and config[name]}
    )


def _as_said(text: str) -> object:
    """What a text says. snakemake --config hands on "true" and inner numbers as text, and for YAML 1.1 1e-6 is one."""
    if re.fullmatch(r"[+-]?\d+[eE][+-]?\d+", text):
        return float(text)
    try:
        return yaml.safe_load(text) if text.strip() else text  # nothing is no null
    except yaml.YAMLError:
        return text


def json_schema(section: Any = None) -> dict[str, Any]:
    """Return the JSON schema of config.yaml, for editors and for other programs."""
    made = section or Settings()
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": "Settings of a study"}
    return {
        **({"description": " ".join((made.__doc__ or "").split())} if section else head),
        "type": "object",
        "additionalProperties": False,
        "properties": {
            key: json_schema(value)
            if said is None
            else {**said.schema, "description": _meaning(said), "default": value}
            for key, said, value in _entries(made)
        },
    }


def commented_yaml(settings: Settings) -> str:
    """Return `settings` as a config.yaml in which every line says what it sets."""
    head = "# Every setting with its unit. What is left out keeps the value that it has here.\n"
    head += "# Paths are relative to the folder in which the study runs.\n"
    entries = {entry[0]: entry for entry in _entries(settings)}
    for heading, names in LAYOUT.items():
        head += f"\n# {heading} ".ljust(106, "-") + "\n"
        head += "".join(f"{line}\n" for name in names for line in _yaml_lines(*entries[name]))
    return head


def _entries(section: Any) -> Iterator[tuple[str, Described | None, Any]]:
    """Each key of a section, what is said of it (None: it is a section of its own), and its value."""
    for name in parts_of(section.__class__):
        yield name, None, getattr(section, name)
    for name, said in described_values(section.__class__).items():
        yield said.key, said, getattr(section, name)


def _yaml_lines(key: str, said: Described | None, value: Any, indent: str = "") -> Iterator[str]:
    if said is not None:
        null = ", or null" if "or null" in said.must and "null" not in said.meaning else ""
        yield f"{indent}{key}: {_scalar(value)} ".ljust(48) + f"# {_meaning(said)}{null}"
    else:
        yield f"{indent}{key}:"
        for entry in _entries(value):
            yield from _yaml_lines(*entry, indent + "  ")


def _meaning(said: Described) -> str:
    return f"{said.meaning}, {said.unit}" if said.unit else said.meaning


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
