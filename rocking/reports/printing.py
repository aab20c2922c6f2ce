"""Printing: the printed form of a value of a row, of a unit and of a verdict; the PDF of a document, and its figures.

A number is rounded and gets a real minus, and is never changed otherwise.
"""

import csv
import io
import json
import math
import re
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache, partial
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol

import typst

from rocking.assessment.decide import Verdict
from rocking.assessment.methods import NEGLIGIBLE, Method, rests
from rocking.assessment.rows import FailureRow
from rocking.quantities import GRAVITY, counted
from rocking.reports.pages import (
    FOLDER,
    Cell,
    Chip,
    Footer,
    Page,
    PageSettings,
    PageTable,
    TableCell,
    as_data,
    pictures_in,
)
from rocking.reports.style import COMMON, FONT_FOLDER, glyphs
from rocking.structures import Structure
from rocking.structures.crackable import Crackable
from rocking.tables import Row, rows_of, write_whole

if TYPE_CHECKING:
    from rocking.assessment.decide import Decision

Column = tuple[str, str, str, Callable[[Any], Cell]]
"""Heading, width (fractions of what is left, or "auto"), alignment, and what it shows of a row."""

NOTHING = "–"
"""Printed where a cell is empty."""
LOOKS: dict[Verdict, tuple[str, str, str, str]] = {
    Verdict.OVERTURNS: ("▲", "#470F05", "#ffffff", ""),
    Verdict.PROBABLY_OVERTURNS: ("△", "#A44517", "#ffffff", ""),
    Verdict.CANNOT_BE_TOLD: ("?", "#ffffff", "#000000", "////"),
    Verdict.UNCERTAIN: ("≈", "#DD8830", "#000000", ""),
    Verdict.PROBABLY_STANDS: ("○", "#F4CC6E", "#000000", ""),
    Verdict.STANDS: ("●", "#EEF4FA", "#000000", ""),
    Verdict.CANNOT_OVERTURN: ("■", "#fffffe", "#000000", ""),
}
"""Sign, colour, colour of letters on it, and hatch of each verdict.

The worse, the darker (L* 14, 42, 64, 84, 96), also in print without colour and to eyes that distinguish few of them;
what cannot be told is hatched.
"""
LEGEND = ", ".join(f"{sign} {verdict}" for verdict, (sign, *_) in LOOKS.items())
"""The signs of a map."""
SHARES = (
    "The number is the share of the ensemble that overturns, in %: a range where cracks, or the members and contact "
    "dynamics, disagree; ≥ where something doubtful or missing may add to it."
)
"""What the numbers at these signs are."""
METHODS = {
    Method.CLOSED_FORM: "Closed form, block",
    Method.MECHANISM_ON_PULSE: "Mechanism, pulse",
    Method.BLOCK_ON_RECORD: "Block, record",
    Method.MECHANISM_ON_RECORD: "Mechanism, record",
}
"""Headings of the methods, from the plainest to the full integration."""
_LARGEST_PLAIN = 1e6
"""Numbers up to here are printed without a power of ten."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_CHOSEN = ("scale_factor", "time_step_s", "high_pass_frequency_hz")
"""Fields that somebody chose, which are printed as they were given."""


class Banded(Protocol):
    """A result, or the row that it was written into, with the band of its members."""

    @property
    def rotation_ratio_low(self) -> float:
        """5 % quantile of the rotation ratio of the members."""

    @property
    def rotation_ratio_high(self) -> float:
        """95 % quantile of the rotation ratio of the members."""


def faults_in_words(tables: Mapping[type[Row], Iterable[Row]]) -> list[str]:
    """Return a sentence for each row of what gave no result, with what it is about."""
    return [
        ": ".join(filter(None, (row.record, row.structure, row.message)))
        for row in rows_of(FailureRow, tables)
    ]


def number(value: float | None, digits: int = 3) -> str:
    """Return `value` to `digits` significant digits; ∞ for inf, a dash for nan or None."""
    if value is None or math.isnan(value):
        return NOTHING
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if 10**digits <= abs(value) < _LARGEST_PLAIN:
        return _typeset(f"{value:.0f}")
    return _typeset(f"{value:#.{digits}g}".rstrip("."))


def plain(value: float | None) -> str:
    """Return a number that somebody chose (a factor, a tolerance) or counted, without trailing zeros."""
    if value is None or math.isnan(value):
        return NOTHING
    return _typeset(str(value) if isinstance(value, int) else f"{value:.6g}")


def words(text: str | Sequence[str] | None) -> str:
    """Return the text, or several in a row, as it stands; a dash for none."""
    whole_text = text if isinstance(text, str) else "; ".join(text or ())
    return whole_text.strip() or NOTHING


def ratio(value: float | None, digits: int = 3) -> str:
    """Return a rotation ratio: a number, "overturns" for inf, "rests" up to a thousandth, a dash for nan or None."""
    if value is None or NEGLIGIBLE < value < math.inf:
        return number(value, digits)
    return NOTHING if math.isnan(value) else "rests" if rests(value) else "overturns"


def chip(verdict: Verdict, share: str = "", text: str = "") -> Chip:
    """Return a verdict on its colour with a share at its right, as the templates set it. text: in another language."""
    _, fill, ink, hatch = LOOKS[verdict]
    shown = f"{'? ' * bool(hatch)}{text or verdict}"
    return Chip(verdict=shown, share=share, fill=fill, ink=ink, hatched=bool(hatch))


def cell_text(decision: "Decision | None") -> str:
    """Return a case in a map: its sign and the share behind it; "≥ 12 %" where that is only the least."""
    sign = LOOKS[decision.verdict if decision else Verdict.CANNOT_BE_TOLD][0]
    share = decision.share_in_a_cell if decision else ""
    return f"{sign} {share}".strip()


def band_text(result: Banded, to: str) -> str:
    """Return the rotation ratios that 5 and 95 % of the members do not exceed, with `to` between them; one if equal."""
    low = ratio(result.rotation_ratio_low, 2)
    high = ratio(result.rotation_ratio_high, 2)
    return low if low == high else f"{low}{to}{high}"


def footer_of(settings: PageSettings) -> Footer:
    """Return the foot of each page of a document in English."""
    return Footer(made=f"{Footer().made} {stamp(settings)}", units=UNITS_IN_WORDS[settings.display_units])


def stamp(settings: PageSettings) -> str:
    """Return version and, where the settings state one, date, which stand on every page."""
    return " · ".join(filter(None, (version("rocking"), settings.date)))


def remainder(more: int, noun: str, place: str) -> str:
    """Return the sentence that says where `more` of a thing stand, or nothing where there are none."""
    return f" Another {counted(more, noun)} in {place}." if more > 0 else ""


def of(part: float, whole: float) -> str:
    """Return "n of m" on one line, NOTHING where there are none."""
    return f"{int(part)}\u00a0of\u00a0{int(whole)}" if whole > 0 else NOTHING


def sentence(text: str) -> str:
    """Return the text with a capital first letter."""
    return text[:1].upper() + text[1:]


def known_crack(structure: Structure | None) -> str:
    """Return that the crack of a structure is known, and at what height; "" where it is not."""
    warning = structure.known_crack if isinstance(structure, Crackable) else None
    return str(warning) if warning else ""


def strong(text: str, really: bool = True) -> TableCell:
    """Return a table cell whose text is set in bold, where it is `really` meant to be."""
    return TableCell(text, really)


def table(columns: Sequence[tuple[str, str, str]], rows: Iterable[Sequence[Cell]]) -> PageTable:
    """Return a table as the templates set it; a column is (heading, width, alignment)."""
    heads, widths, alignments = zip(*columns, strict=True)
    return PageTable(heads, widths, alignments, tuple(map(tuple, rows)))


def table_of(rows: Iterable[Any], *columns: Column) -> PageTable:
    """Return a table with a line for each row."""
    return table([column[:3] for column in columns], [[show(row) for *_, show in columns] for row in rows])


def columns_of(kind: type[Row], fields: str, width: str = "") -> list[Column]:
    """Return columns that show fields of rows of one `kind`, with heading and unit as the row class has them.

    fields: their names, separated by spaces, each with its width where that is not that of all: "stage message=3".
    width: of all; if empty, by their type.
    """
    described = {column.name: column for column in kind.table.columns}
    columns: list[Column] = []
    for name, _, own_width in (field.partition("=") for field in fields.split()):
        column = described[name]
        usual, side = ("0.8", "r") if column.holds in (float, int) else ("1", "l")
        unit = unit_of(column.unit).name or ("-" if column.holds is float else "")
        heading = sentence(column.attribute.replace("_", " ").replace("rotd", "RotD"))
        heading += f" [{unit}]" if unit else ""
        columns.append((heading, own_width or width or usual, side, partial(field_of, name, si=column.unit)))
    return columns


def quantity(value: float, si: str) -> str:
    """Return a value in the SI unit `si` as the report at hand shows it, with its unit."""
    unit = unit_of(si)
    return f"{number(value / unit.size)} {unit.name}"


def field_of(name: str, row: Row | None, si: str = "") -> str:
    """Return the field `name` of a row as it is printed: by its type, rotation ratios in words where they are none.

    si: the unit that it has in the row.
    """
    value = getattr(row, name, None)
    if isinstance(value, float) and name not in _CHOSEN:
        return ratio(value) if name.endswith("rotation_ratio") else number(value / unit_of(si).size)
    return plain(value) if isinstance(value, float | int) else words(value)


def _typeset(text: str) -> str:
    mantissa, _, exponent = text.partition("e")
    mantissa = mantissa.replace("-", "−")
    return f"{mantissa}×10{str(int(exponent)).translate(_SUPERSCRIPTS)}" if exponent else mantissa


SI = "SI"


@dataclass(frozen=True)
class Unit:
    """A unit as it is printed; size: one of it, in SI units."""

    name: str
    size: float


UNITS_IN_WORDS = {
    SI: "SI units and radians",
    "g and cm": "Accelerations in g, velocities in cm/s, displacements in cm; sizes in m, angles in radians",
}
_IN_PLACE_OF: dict[str, dict[str, Unit]] = {
    SI: {},
    "g and cm": {
        "m/s²": Unit("g", GRAVITY),
        "m/s": Unit("cm/s", 0.01),
        "m": Unit("cm", 0.01),
    },
}
_DISPLAYED: ContextVar[str] = ContextVar("display units", default=SI)


def unit_of(si: str) -> Unit:
    """Return the unit that the report at hand shows in place of the SI unit "m/s²", "m/s", "m", or any other."""
    return _IN_PLACE_OF[_DISPLAYED.get()].get(si, Unit(si, 1.0))


@contextmanager
def displaying(settings: PageSettings) -> Iterator[None]:
    """Show in the units that the settings of a study name."""
    token = _DISPLAYED.set(settings.display_units)
    try:
        yield
    finally:
        _DISPLAYED.reset(token)


@dataclass(frozen=True)
class Measured:
    """A figure as it is printed. page: of the documents, that explains it. source: the campaign that measured it.

    commit: of the package at which it was measured; "" of what needs no campaign.
    """

    figure: str
    commit: str
    page: str
    source: str

    @property
    def words(self) -> str:
        """The figure with its age."""
        return f"{self.figure} (measured at {self.commit})" if self.commit else self.figure


with (FOLDER / "measured.csv").open(encoding="utf-8", newline="") as _stream:
    MEASURED = {row.pop("name"): Measured(**row) for row in csv.DictReader(_stream)}
"""The figures that campaigns measured and that reports print, of measured.csv, by name."""


def compile_document(page: Page) -> bytes:
    """Set a page and return the PDF. The content of its template stands as if it were in this folder.

    Every text of the page is printed as it is: it reaches the template as JSON and is never parsed as markup. The date
    of the document is fixed, because PDF/A asks for one and the same input must give the same bytes.
    """
    text = json.dumps(as_data(page), ensure_ascii=False)
    rare = set(map(ord, text)) - COMMON
    foreign = bool(rare) and not glyphs().issuperset(rare)
    carried = document_fonts(False).families()
    families = [family for family in document_fonts(foreign).families() if family not in carried]
    return typst.compile(  # type: ignore[call-overload,no-any-return]  # its stub wants input and root of one type
        page.template.read_bytes(),
        root=FOLDER,
        font_paths=document_fonts(foreign),
        ignore_system_fonts=True,
        sys_inputs={"data": text, "families": json.dumps(families)},
        pdf_standards="a-2a",
        timestamp=0,
    )


@cache
def document_fonts(system: bool) -> typst.Fonts:
    """The fonts that typst and matplotlib carry, and the machine's where another script needs them."""
    return typst.Fonts(include_system_fonts=system, font_paths=[FONT_FOLDER])


Figures = Literal["none", "svg", "png", "svg and png"]
_PAGE_OF_FIGURE = b"""#set page(width: auto, height: auto, margin: 4pt)
#image(bytes(sys.inputs.svg), format: "svg")
"""
_PIXELS_PER_INCH = 200.0
_MADE = (2000, 1, 1, 0, 0, 0)
"""Stands in the archive as the date of each file, so that two runs of a study give the same bytes."""
_LONGEST_NAME = 60
"""Letters of the name of a file behind its number."""


def write_document(pdf: Path, page: Page, kinds: Figures) -> list[Path]:
    """Write the document of a page and, where asked for, its figures; return the files.

    The figures of summary.pdf stand in the same folder in summary_figures.zip.
    """
    write_whole(pdf, compile_document(page))
    if kinds == "none":
        return [pdf]
    archive = pdf.with_name(f"{pdf.stem}_figures.zip")
    write_whole(archive, figures_archive(page, kinds))
    return [pdf, archive]


def figures_archive(page: Page, kinds: Figures) -> bytes:
    """Return the figures of a page as a ZIP archive, in the order of the report.

    Each is named by its number and what it shows: "03_scatter-of-the-rotation-ratio.svg".
    """
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, figure in enumerate(pictures_in(page), start=1):
            words = "-".join(re.findall(r"\w+", figure.alt.lower()))[:_LONGEST_NAME].strip("-")
            name = f"{number:02d}_{words}"
            if "svg" in kinds:
                archive.writestr(zipfile.ZipInfo(f"{name}.svg", _MADE), figure.svg)
            if "png" in kinds:
                archive.writestr(zipfile.ZipInfo(f"{name}.png", _MADE), _png(figure.svg))
    return content.getvalue()


def _png(svg: str) -> bytes:
    made = typst.compile(
        _PAGE_OF_FIGURE,
        format="png",
        ppi=_PIXELS_PER_INCH,
        font_paths=document_fonts(system=False),
        ignore_system_fonts=True,
        sys_inputs={"svg": svg},
    )
    return made if isinstance(made, bytes) else made[0]
