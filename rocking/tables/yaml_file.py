"""YAML as data only, by the rules of YAML 1.2: what looks like a number to some and a text to others is a text."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml

from rocking.errors import RockingError
from rocking.quantities import UNPRINTABLE, shown
from rocking.tables.files import read_whole

LARGEST_YAML = 1_000_000
"""Bytes; a thousand structures take about a tenth of it."""
_DEEPEST = 8
"""Levels of nesting; a list of mappings has three."""


def read_yaml(
    path: Path,
    error: type[RockingError],
    what: str,
    largest: int = LARGEST_YAML,
    content: bytes | None = None,
) -> tuple[Any, Any]:
    """Return what the YAML file at `path` holds, and its node, None for an empty file. what: "structure list".

    content: of a list that lies in no file, and is called as `path` says.

    1:30 and 011 are texts, and so are yes and no; 1e-6 is a number. Raises `error` for what no such file needs: another
    kind of file, more than `largest` bytes, anchors and aliases, deep nesting, a key given twice, tags.
    """
    content = read_whole(path, largest, error) if content is None else content
    try:
        loader = _StrictLoader(content.decode("utf-8-sig"))
        node = loader.get_single_node()
        return (None if node is None else loader.construct_document(node)), node
    except (yaml.YAMLError, ValueError) as defect:
        raise error(f"{path}: the {what} is not valid YAML{_where_and_why(defect)}.") from None


_OF_AN_INDENT = (
    "mapping values are not allowed here",
    "did not find expected",
    "expected <block end>",
    "could not find expected ':'",
)
"""How yaml reports a line that is indented otherwise than the entry to which it belongs."""


def _where_and_why(defect: yaml.YAMLError | ValueError) -> str:
    """Return the line of a defect and the defect itself, as the end of a sentence."""
    mark = getattr(defect, "problem_mark", None)
    problem = getattr(defect, "problem", None) or " ".join(str(defect).split())
    where = "" if mark is None else f" in line {mark.line + 1}"
    if r"'\t'" in problem:
        return f"{where}: a tab stands where only blanks may; write blanks"
    if problem.startswith(_OF_AN_INDENT):
        return (
            f"{where}: it does not begin where the lines around it do; begin all keys of one entry in the same column, "
            "each behind blanks, and put a text that holds a colon into quotation marks"
        )
    if "codec can't decode" in problem:
        return ": its letters are not those of UTF-8; save it as UTF-8"
    if "<stream end>" in problem:
        return f"{where}: the file ends within braces, brackets or quotation marks; close them"
    if "constructor for the tag" in problem:
        return f"{where}: a tag, a word with an exclamation mark before it, is not read here; write the value alone"
    return f"{where}: {problem}"


def scalar_value(text: str) -> Any:
    """Return the value that a scalar in YAML says, the text itself where it is none."""
    try:
        return _StrictLoader(text).get_single_data() if text.strip() else text
    except (yaml.YAMLError, ValueError):
        return text


class _StrictLoader(yaml.SafeLoader):  # type: ignore[misc]
    """The safe loader without aliases, deep nesting, keys given twice and the traps of YAML 1.1."""

    depth = 0
    yaml_implicit_resolvers: dict[str, Sequence[tuple[str, re.Pattern[str]]]] = {}  # noqa: RUF012 as its root has it

    def compose_node(self, parent: yaml.Node | None, index: object) -> yaml.Node | None:
        event = self.peek_event()
        if getattr(event, "anchor", None) is not None:
            raise _refused("an anchor or an alias is not read here; write every value out", event.start_mark)
        self.depth += 1
        if self.depth > _DEEPEST:
            raise _refused("it is nested too deeply", event.start_mark)
        node = super().compose_node(parent, index)
        self.depth -= 1
        # Of a text of several lines, the ends of lines and the tabs may stay.
        if isinstance(node, yaml.ScalarNode) and UNPRINTABLE.search(
            node.value.translate({9: None, 10: None})
        ):
            raise _refused(
                f"the text {shown(node.value)} must hold printable characters only", node.start_mark
            )
        return node

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[object, object]:
        keys: set[str] = set()
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise _refused("a key must be a text", key.start_mark)
            if key.value in keys:
                raise _refused(f"key {shown(key.value)} is given twice; give it once", key.start_mark)
            keys.add(key.value)
        result: dict[object, object] = super().construct_mapping(node, deep)
        return result


_NUMBER = r"[-+]?(0|[1-9][0-9]*)"
_FLOAT = rf"{_NUMBER}(\.[0-9]*)?([eE][-+]?[0-9]+)?|[-+]?\.[0-9]+([eE][-+]?[0-9]+)?"
for _tag, _pattern, _first in (
    ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
    ("bool", r"true|True|TRUE|false|False|FALSE", list("tTfF")),
    ("int", _NUMBER, list("-+0123456789")),
    ("float", _FLOAT, list("-+.0123456789")),
    ("float", r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)", list("-+.")),
):
    _StrictLoader.add_implicit_resolver(f"tag:yaml.org,2002:{_tag}", re.compile(rf"^(?:{_pattern})$"), _first)


def _refused(reason: str, mark: yaml.Mark) -> yaml.MarkedYAMLError:
    return yaml.constructor.ConstructorError(None, None, reason, mark)
