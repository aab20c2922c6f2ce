"""Structures from a YAML list: read safely, all defects in one message, each size remembered as it was typed."""

import warnings
from collections.abc import Mapping
from pathlib import Path

import yaml

from rocking.errors import ConfigurationError, StructureError, StructureWarning
from rocking.structures.config import structure_from_config
from rocking.structures.structure import Structure

LARGEST_FILE = 1_000_000
"""Bytes; a thousand structures take about a tenth of it."""
_DEEPEST = 8
"""Levels of nesting; a list of mappings has three."""


def load_structures(path: str | Path) -> dict[str, Structure]:
    """Return the structures listed in a YAML file, by name, in its order.

    The file is a list of mappings, each with a `name` of its own. Raises ConfigurationError with every defect at once,
    one a line; warns with a StructureWarning of a size beyond its plausible range.
    """
    structures: dict[str, Structure] = {}
    names: list[object] = []
    defects = []
    for number, (entry, texts) in enumerate(_entries(Path(path)), start=1):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        where = f"{path}: structure {number}" + (f" ({name})" if name else "")
        if not isinstance(name, str) or not name.strip():
            defects.append(f"{where}: name is {name!r}, but must be a text of its own.")
        elif name in names:
            defects.append(f"{where}: the name is already taken by another structure; give each its own.")
        names.append(name)
        try:
            structure = structures[str(name)] = structure_from_config(entry, texts)  # type: ignore[arg-type]
        except (ConfigurationError, StructureError) as error:
            defects.append(f"{where}: {error}")
            continue
        for remark in structure.remarks:
            warnings.warn(f"{where}: {remark}", StructureWarning, stacklevel=2)
    if defects:
        raise ConfigurationError("\n".join(defects))
    return structures


def _entries(path: Path) -> list[tuple[object, dict[str, str]]]:
    """Each entry of the list, with the values of its keys as they were typed."""
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise ConfigurationError(f"{path}: the structure list cannot be read ({error.strerror}).") from None
    if len(content) > LARGEST_FILE:
        raise ConfigurationError(
            f"{path}: the structure list is larger than {LARGEST_FILE} bytes; split it into several."
        )
    try:
        loader = _StrictLoader(content.decode())
        node = loader.get_single_node()
        entries = None if node is None else loader.construct_document(node)
    except (yaml.YAMLError, ValueError) as error:
        raise ConfigurationError(
            f"{path}: the structure list is not valid YAML ({' '.join(str(error).split())})."
        ) from None
    if not isinstance(entries, list) or not entries:
        raise ConfigurationError(
            f"{path}: the file holds {type(entries).__name__}, but must hold a list of structures."
        )
    return list(zip(entries, map(_texts, node.value), strict=True))


def _texts(node: yaml.Node) -> dict[str, str]:
    """The scalars and the lists of scalars of a mapping, as they were typed."""
    pairs = node.value if isinstance(node, yaml.MappingNode) else ()
    texts = {key.value: value.value for key, value in pairs if isinstance(value, yaml.ScalarNode)}
    for key, value in pairs:
        if isinstance(value, yaml.SequenceNode):
            texts[key.value] = ", ".join(
                each.value for each in value.value if isinstance(each, yaml.ScalarNode)
            )
    return texts


class _StrictLoader(yaml.SafeLoader):
    """The safe loader without aliases, deep nesting and keys given twice, each of which a list never needs."""

    depth = 0

    def compose_node(self, parent: yaml.Node | None, index: object) -> yaml.Node | None:
        event = self.peek_event()
        if getattr(event, "anchor", None) is not None:
            raise _refused(
                "an anchor or an alias is not read here; write every structure out", event.start_mark
            )
        self.depth += 1
        if self.depth > _DEEPEST:
            raise _refused("it is nested too deeply for a list of structures", event.start_mark)
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[object, object]:
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        for key in keys:
            if keys.count(key) > 1:
                raise _refused(f"key {key!r} is given twice", node.start_mark)
        return super().construct_mapping(node, deep)


def _refused(reason: str, mark: yaml.Mark) -> yaml.MarkedYAMLError:
    return yaml.constructor.ConstructorError(None, None, reason, mark)
