"""Each template reads every field of its page, and no other: what a template is given is a type, and not a guess.

A variable of a template has the name of the class that it holds (`row` a Row, `table_cell` a TableCell, `data` the page
itself), so that each place where it is bound, read or handed on can be held against the class.
"""

import re
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any, get_args, get_origin, get_type_hints

import pytest

import rocking
from rocking.products.checks.pages import StructuresPage
from rocking.reports.pages import FOLDER, Page, PlainPage, RecordPage, SummaryPage, Table

TEMPLATES = set(Path(rocking.__file__).parent.rglob("*.typ"))
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
        ("page_one.legend", "page_one.legends"),
    ],
)
def test_a_mistake_in_a_template_is_found(before: str, after: str) -> None:
    page = RecordPage
    source = source_of(page)
    assert before in source
    assert faults(page, source.replace(before, after))


KEYWORDS = {
    "let",
    "set",
    "show",
    "if",
    "else",
    "for",
    "in",
    "import",
    "include",
    "while",
    "not",
    "and",
    "or",
    "return",
    "context",
    "as",
    "none",
    "auto",
}
"""Of Typst, which stand between words of code."""
LABELS = {
    "record.typ": set(),
    "structures.typ": set(),
    "plain.typ": set(),
    "layout.typ": set(),
    "against.typ": {
        "rotation over critical rotation": "of the axis that the template draws",
        "time s": "of the axis below, with its unit",
        "cr": "index of a symbol",
    },
    "page_one.typ": {
        "of energy in one sine": "of the figure beside it",
        "share that overturns": "heads a column",
        "rotation over critical rotation": "of the scale that the template draws",
        "falls": "of the grey zone of the scale",
        "falls at the record times": "heads a column",
        "to do or know": "heads a column",
        "closed form": "of the ring that the template draws",
        "block under record": "of its diamond",
        "full motion; line: 5–95 % of members": "of its dot and line",
    },
    "summary.typ": {"to know": "heads a column", "% that overturns": "of the legend of the colours"},
}
"""What templates say themselves, with what it stands at: no sentence, of whose fact another place would know."""


FONTS = {"Libertinus Serif", "DejaVu Sans"}


def words_of_a_template(text: str) -> set[str]:
    """What a template itself says: the words of its content, and texts of several words in its code."""
    text = re.sub(r"^\s*//.*$|\s//\s.*$|^#import .*$", "", text, flags=re.M)
    text = text.replace("\\[", "").replace("\\]", "")
    code = re.sub(r'"[^"\n]*"', '""', text)
    said = set()
    for content in re.findall(r"\[([^\[\]]*)\]", code):
        # a line that begins with a # is code, as is what follows one up to a blank, or to the end of its brackets
        plain = re.sub(r"^\s*#.*$|#\w+\([^()]*\)|#\S+", "", content, flags=re.M).strip()
        if re.search(r"[A-Za-z]{2}", plain) and not re.search(r"[{}=]|^\w+[(.]|\.\w+\(", plain):
            said.add(plain)
    for literal in re.findall(r'"([^"\n]*)"', text):
        if re.search(r"[A-Za-z]{2,} [A-Za-z]{2,}", literal) and literal not in FONTS:
            said.add(literal)
    for run in re.findall(r"(?<![\w.#-])[A-Za-z]{2,}(?: [A-Za-z]{2,})+(?![\w-])", code):
        pairs = zip(run.split(), run.split()[1:], strict=False)
        if any(not {one, other} & KEYWORDS for one, other in pairs) and not any(run in each for each in said):
            said.add(run)
    return said


@pytest.mark.parametrize("path", sorted(TEMPLATES), ids=lambda path: path.name)
def test_a_template_holds_layout_and_no_prose(path: Path) -> None:
    """Its sentences are data: each stands where its fact is known, or beside the page that alone prints it."""
    assert words_of_a_template(path.read_text(encoding="utf-8")) == set(LABELS[path.name])


@pytest.mark.parametrize(
    "prose",
    [
        "  small[Black: the mechanism under the whole record.]",
        "= What to know",
        '  #let note = text(8pt, "None of them.")',
        "[Failures]",
    ],
)
def test_prose_in_a_template_is_found(prose: str) -> None:
    template = PlainPage.template.read_text(encoding="utf-8")
    assert len(words_of_a_template(f"{template}\n{prose}\n")) == 1


def test_a_field_that_no_template_reads_is_found() -> None:
    source = source_of(PlainPage)
    assert faults(PlainPage, source.replace("part.notice", "part.text")) == ["Part.notice is never read"]
    assert Table in classes(PlainPage).values()
