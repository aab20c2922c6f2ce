"""Each template reads every field of its page, and no other: what a template is given is a type, and not a guess.

A variable of a template has the name of the class that it holds (`row` a Row, `table_cell` a TableCell, `data` the page
itself), so that each place where it is bound, read or handed on can be held against the class.
"""

import re
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, get_args, get_origin, get_type_hints

import pytest

from rocking.products.checks.pages import StructuresPage
from rocking.reports.pages import FOLDER, Page, PlainPage, RecordPage, SummaryPage, Table

PATH = r"[a-z_]+(?:\.[a-z_]+)+"


@cache
def classes(root: type) -> dict[str, type]:
    """The classes that a page holds, by the names of their variables."""
    found: dict[str, type] = {}

    def visit(kind: Any) -> None:
        if is_dataclass(kind):
            name = re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__).lower()
            if found.setdefault(name, kind) is kind:
                for hint in get_type_hints(kind).values():
                    if (name, hint) not in seen:
                        seen.add((name, hint))
                        visit(hint)
        for part in get_args(kind):
            visit(part)

    seen: set[Any] = set()
    for hint in get_type_hints(root).values():
        visit(hint)
    return {"data": root, **found}


def held(kind: Any) -> list[type]:
    """The dataclasses that a value of a type may be, or of a list its elements."""
    one = get_args(kind)[0] if get_origin(kind) is tuple else kind
    return [each for each in (one, *get_args(one)) if is_dataclass(each) and get_origin(one) is not tuple]


def source_of(root: type[Page]) -> str:
    """The template with what it imports, of layout.typ the definitions that it uses."""
    text = root.template.read_text(encoding="utf-8")
    for name in re.findall(r'#import "(\w+\.typ)"', text):
        if name != "layout.typ":
            text += (FOLDER / name).read_text(encoding="utf-8")
    layout = (FOLDER / "layout.typ").read_text(encoding="utf-8")
    blocks = dict(re.findall(r"^#let ([\w-]+)(.*?)(?=^#let |\Z)", layout, flags=re.M | re.S))
    used: set[str] = set()
    queue = set(re.findall(r"[\w-]+", " ".join(re.findall(r'#import "layout.typ": (.*)', text))))
    while queue:
        name = queue.pop()
        if name in blocks and name not in used:
            used.add(name)
            queue |= set(re.findall(r"[a-z][\w-]*", blocks[name]))
    text += "".join(f"#let {name}{blocks[name]}" for name in sorted(used))
    return re.sub(r"^\s*//.*$|^#import .*$", "", text, flags=re.M)


def typed(path: str, known: dict[str, type], read: set[tuple[type, str]]) -> Any:
    """The type of what a path of a template holds; a method of Typst ends it. Fields on its way are `read`."""
    name, *parts = path.split(".")
    kind: Any = known[name]
    for part in parts:
        if not is_dataclass(kind):
            return kind
        hints = get_type_hints(kind)
        assert part in hints, f"{path}: {kind.__name__} has no {part}"
        read.add((kind, part))
        kind = hints[part]
    return kind


def faults(root: type[Page], source: str) -> list[str]:
    """What a template reads that its page does not hold, what it binds wrongly, and what it leaves unread."""
    known = classes(root)
    read: set[tuple[type, str]] = set()
    found: list[str] = []

    def kind_of(path: str) -> Any:
        try:
            return typed(path, known, read)
        except AssertionError as fault:
            found.append(str(fault))
        return None

    for path in re.findall(rf"(?:(?<![\w.-])|(?<=\.\.)){PATH}", source):
        if path.partition(".")[0] in known:
            kind_of(path)
        elif re.search(r"\.(?!len|at|map|filter|first|join|words|text|flatten|slice)", path) and "_" in path:
            found.append(f"{path}: no class of the page is called so")
    bound = [
        *re.findall(rf"for (?:\(\w+, )?(\w+)\)? in ({PATH})", source),
        *((name, path) for path, name in re.findall(rf"({PATH})\.(?:map|filter)\((\w+) =>", source)),
    ]
    for name, path in bound:
        if path.partition(".")[0] not in known:
            continue
        kinds = held(kind_of(re.sub(r"\.(enumerate|filter)$", "", path)))
        if kinds and known.get(name) not in kinds:
            found.append(f"{name} is bound to {path}, which holds {[each.__name__ for each in kinds]}")
        if not kinds and name in known:
            found.append(f"{name} is bound to {path}, which holds no page's class")
    for function, parameters in re.findall(r"#let ([\w-]+)\(([^)]*)\)", source):
        first = parameters.split(",")[0].strip()
        for path in re.findall(rf"(?<![\w-]){re.escape(function)}\(({PATH}|[a-z_]+)[,)]", source):
            kinds = held(kind_of(path)) if path.partition(".")[0] in known else []
            if first in known and kinds and known[first] not in kinds:
                found.append(f"{function}({path}) is given another class than {known[first].__name__}")
    unread = [
        f"{kind.__name__}.{each.name} is never read"
        for kind in known.values()
        for each in fields(kind)
        if (kind, each.name) not in read
    ]
    return found + unread


@pytest.mark.parametrize("page", [PlainPage, RecordPage, SummaryPage, StructuresPage])
def test_a_template_reads_each_field_of_its_page_and_no_other(page: type[Page]) -> None:
    assert faults(page, source_of(page)) == []


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("data.conclusion", "data.conclusions"),
        ("row.marks.whole", "row.marks.hole"),
        ("row.remark", "row.name"),
        ("for picture in page_one.trace", "for row in page_one.trace"),
        ("page_one.rows.map(row =>", "page_one.others.map(row =>"),
        ("tabled(data.components)", "tabled(data.known)"),
        ("assumed.friction", "assumed.frictions"),
    ],
)
def test_a_mistake_in_a_template_is_found(before: str, after: str) -> None:
    page = RecordPage
    source = source_of(page)
    assert before in source
    assert faults(page, source.replace(before, after))


def test_a_field_that_no_template_reads_is_found() -> None:
    source = source_of(PlainPage)
    assert faults(PlainPage, source.replace("part.notice", "part.text")) == ["Part.notice is never read"]
    assert Table in classes(PlainPage).values()
