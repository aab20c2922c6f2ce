"""What each template is given: one frozen dataclass a page, of which it reads every field and no other.

A class of a page names the variable of the template that holds it: a `TableCell` is `table_cell` there.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal

Language = Literal["en", "it"]
"""The languages of the pages to sign; everything else is English."""

FOLDER = Path(__file__).parent
"""Of the templates of the reports."""


@dataclass(frozen=True, kw_only=True)
class Fact:
    """What the settings say of the study: a label and its text."""

    label: str
    text: str


@dataclass(frozen=True, kw_only=True)
class PageSettings:
    """What the settings of a study say of its pages. about: what every report says of the study."""

    about: tuple[Fact, ...]
    language: Language
    date: str | None
    display_units: str
    tolerance: float
    acceleration_scale: str


# What several pages hold ---------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Picture:
    """A figure as SVG, and its alternative text."""

    svg: str
    alt: str


@dataclass(frozen=True)
class TableCell:
    """A cell of a table that is set in bold, where it is `strong`, or has a grey line `below`."""

    text: str
    strong: bool = False
    below: str = ""


Cell = str | TableCell


@dataclass(frozen=True)
class PageTable:
    """A table. widths: "auto" or a number of fractions; alignments: "l", "c" or "r"."""

    heads: tuple[str, ...] = ()
    widths: tuple[str, ...] = ()
    alignments: tuple[str, ...] = ()
    rows: tuple[tuple[Cell, ...], ...] = ()


@dataclass(frozen=True)
class CaptionedTable:
    """A table and what it is."""

    table: PageTable
    caption: str


@dataclass(frozen=True, kw_only=True)
class Chip:
    """A verdict on its colour, with a share at its right; hatched: within a dashed edge."""

    verdict: str
    share: str
    fill: str
    ink: str
    hatched: bool


@dataclass(frozen=True)
class Notice:
    """A sentence that stands above everything; strong: it warns, and is set so."""

    text: str
    strong: bool = True


@dataclass(frozen=True)
class Footer:
    """What the foot of each page says; {page} and {pages} are numbers."""

    made: str = "Made with the Python package rocking"
    page: str = "Page {page} of {pages}"
    continued: str = "Continued from page {page}"
    units: str = "SI units and radians"


@dataclass(frozen=True, kw_only=True)
class Page:
    """What every document has. template: the file that sets it, as if it stood in their folder."""

    template: ClassVar[Path]
    title: str
    language: Language = "en"
    about: tuple[Fact, ...] = ()
    footer: Footer = Footer()


@dataclass(frozen=True)
class VariantCell:
    """One variant of a structure: its drawing, its verdict and what else is known of it, each "" where it is not."""

    drawing: Picture
    name: str
    chip: Chip
    reserve: str
    notes: tuple[str, ...]
    difference: str


@dataclass(frozen=True)
class Strip:
    """The variants of a structure on one scale."""

    name: str
    cells: tuple[VariantCell, ...]


@dataclass(frozen=True)
class Topic:
    """What there is to know of one thing."""

    topic: str
    texts: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Section:
    """One part of a document: what of this there is stands in this order, the caption under picture or table.

    level: of the heading. size: of the letters of the table, pt. last: rows that stay together at its end.
    """

    heading: str = ""
    level: int = 1
    notice: str = ""
    text: str = ""
    sentences: tuple[str, ...] = ()
    pictures: tuple[Picture, ...] = ()
    table: PageTable = PageTable()
    caption: str = ""
    size: float = 7.5
    last: int = 4
    topics: tuple[Topic, ...] = ()
    strips: tuple[Strip, ...] = ()


# A plain document ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Panel:
    """What the summary shows of another product over all records.

    caveat: what to know of its conclusion, which stands below that on page one.
    """

    title: str
    parts: tuple[Section, ...]
    caveat: str = ""


@dataclass(frozen=True, kw_only=True)
class PlainPage(Page):
    """A plain document."""

    template = FOLDER / "plain.typ"

    subtitle: str = ""
    parts: tuple[Section, ...] = ()


# The report of a record ----------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Peak:
    """A measure of the motion."""

    value: str
    name: str


@dataclass(frozen=True, kw_only=True)
class Sine:
    """The dominant sine: its share of the energy, and what follows from it."""

    share: str
    clause: str


@dataclass(frozen=True, kw_only=True)
class Marks:
    """Where the marks of a row stand on its scale, mm: closed form, block, whole motion, and the line of members."""

    form: float | None
    block: float | None
    whole: float | None
    line: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class PageOneRow:
    """The row of a structure on page one. below: its sizes, and λ with its crack and the least one. odds: the share in
    tenths. alone: its reserve is that of the mechanism alone."""

    name: str
    below: str
    drawing: tuple[Picture, ...]
    chip: Chip
    odds: str
    marks: Marks
    reserve: str
    alone: bool
    warning: str


@dataclass(frozen=True, kw_only=True)
class Others:
    """The structures of one verdict that have no row."""

    verdict: str
    names: str


@dataclass(frozen=True, kw_only=True)
class PageOne:
    """The page to look at, below its title: the record as a strip, and a row for each structure."""

    trace: tuple[Picture, ...]
    peaks: tuple[Peak, ...]
    sine: Sine
    rows: tuple[PageOneRow, ...]
    others: tuple[Others, ...]
    uncertain: tuple[str, ...]
    legend: str


@dataclass(frozen=True)
class Tick:
    """A mark of an axis: where it stands, mm, and what it says."""

    at: float
    label: str


@dataclass(frozen=True, kw_only=True)
class Ground:
    """The accelerogram of a component with its axes and its sine. levels: of the accelerations, from above."""

    name: str
    peak: str
    facts: tuple[str, ...]
    picture: Picture
    levels: tuple[Tick, ...]


@dataclass(frozen=True, kw_only=True)
class ComparedWords:
    """The texts at the strip of a structure: the largest rotation by paper, closed form and integration.

    below: its sizes. constants: λ, p, φ_cr and η. note: component, support and crack. outside: whether the paper's
    equation is asked outside of its regime.
    """

    name: str
    below: str
    constants: tuple[str, ...]
    note: str
    printed: str
    outside: bool
    form: str
    whole: str


@dataclass(frozen=True, kw_only=True)
class Compared(ComparedWords):
    """The strip of a structure that moves, and its texts."""

    picture: Picture


@dataclass(frozen=True)
class AgainstHead:
    """A method of prediction or integration, and in brief what it is."""

    name: str
    below: str


@dataclass(frozen=True, kw_only=True)
class Against:
    """Prediction against integration: the ground, and a strip for each structure that moves, the worst first."""

    title: str
    heads: tuple[AgainstHead, ...]
    legend: str
    grounds: tuple[Ground, ...]
    compared: tuple[Compared, ...]
    ticks: tuple[Tick, ...]
    at_rest: str
    more: str


@dataclass(frozen=True, kw_only=True)
class RecordPage(Page):
    """The report of one record."""

    template = FOLDER / "record.typ"

    subtitle: str
    running: str
    conclusion: str
    at_design_level: str
    notices: tuple[Notice, ...]
    page_one: PageOne
    against: tuple[Against, ...]
    variants: Section
    advice: Section
    known: Section
    assumed: Section


# The report over all records -----------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class MatrixHead:
    """A record above a column of the matrix."""

    name: str
    below: str


@dataclass(frozen=True)
class MatrixRow:
    """What becomes of a structure under each record."""

    name: str
    cells: tuple[Chip, ...]
    warning: str


@dataclass(frozen=True)
class Matrix:
    """A column for each record, a row for each structure, both the worst first. note: what its cells mean, and what has
    no row."""

    heads: tuple[MatrixHead, ...] = ()
    rows: tuple[MatrixRow, ...] = ()
    legend: tuple[Chip, ...] = ()
    upright: bool = False
    note: str = ""


@dataclass(frozen=True, kw_only=True)
class MapCell:
    """Sign and share of one case on the colour of its verdict."""

    text: str
    fill: str
    ink: str


@dataclass(frozen=True)
class MapRow:
    """One record of the map: its peaks, and a cell for each structure."""

    record: str
    peaks: tuple[str, ...]
    cells: tuple[MapCell, ...]


@dataclass(frozen=True)
class SeverityMap:
    """A line for each record, a column for each structure. record_heads: of the record and its peaks. words: what its
    cells mean, and what has no row."""

    record_heads: tuple[str, ...]
    heads: tuple[str, ...]
    rows: tuple[MapRow, ...]
    words: str


@dataclass(frozen=True)
class Scatter:
    """The closed form against the integration, and what it saw of the falls.

    counted: which cases those are, of a study with a structure on a support; "" of another one.
    """

    heading: str
    picture: Picture
    counted: str = ""


@dataclass(frozen=True, kw_only=True)
class SummaryPage(Page):
    """The report over all records."""

    template = FOLDER / "summary.typ"

    subtitle: str
    conclusion: str
    falls: str
    conclusions: tuple[str, ...]
    notices: tuple[Notice, ...]
    matrix: Matrix
    map: SeverityMap
    whole_map: SeverityMap
    scatter: tuple[Scatter, ...]
    outcomes: Section
    structures: Section
    strips_title: str
    strips: tuple[Strip, ...]
    supports: Section
    design: Section
    panels: tuple[Panel, ...]
    failures: Section
    agreement: Section
    lists: Section
    methods: Section
    unsafe: Section
    records: Section


# What a template receives --------------------------------------------------------------------------------


def as_data(thing: Any) -> Any:
    """Return a page as JSON holds it: a dataclass by the names of its fields."""
    if is_dataclass(thing) and not isinstance(thing, type):
        return {field.name: as_data(getattr(thing, field.name)) for field in fields(thing)}
    return [as_data(item) for item in thing] if isinstance(thing, list | tuple) else thing


def pictures_in(thing: Any) -> Iterator[Picture]:
    """Yield every picture of a page, in its order."""
    if isinstance(thing, Picture):
        yield thing
    elif is_dataclass(thing) and not isinstance(thing, type):
        for field in fields(thing):
            yield from pictures_in(getattr(thing, field.name))
    elif isinstance(thing, list | tuple):
        for value in thing:
            yield from pictures_in(value)
