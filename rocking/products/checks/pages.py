"""What the template of the pages to sign is given; see `rocking.reports.pages`."""

from dataclasses import dataclass
from pathlib import Path

from rocking.reports.pages import Page, PageTable, Picture, Strip


@dataclass(frozen=True, kw_only=True)
class SignWords:
    """What the pages to sign say in every study: in English, which is put into their language."""

    what_governs: str = "What governs"
    capacity_over_demand: str = "Capacity over demand"
    how_sure: str = "How sure"
    assumed: str = "Assumed, to be confirmed on site"
    place_and_date: str = "Place and date"
    signature: str = "Signature"
    not_to_sign: str = "This page is not to be signed."
    next_page: str = "Circolare 7/2019 to the NTC 2018. Capacity curve and other figures: next page."
    figure: str = (
        "Left: the structure with its sizes and loads; right: its capacity curve with the limit "
        "displacements, and as dashed lines the secants whose periods the nonlinear check takes."
    )
    table_checks: str = "The checks of the Circolare 7/2019 at the design level."
    table_mechanisms: str = (
        "The mechanisms in which it may fall: the acceleration at which each starts, p, the share of its "
        "members that overturn under the records of the study where it was followed, and the forces of what "
        "holds it. mechanisms.csv lists all."
    )
    table_periods: str = (
        "The other places: ratios of capacity to demand. The page above is of the worst period; the ground "
        "is given for comparison only."
    )
    variants_title: str = (
        "The variants, drawn on one scale: verdict and share under the worst record of each, ratios at the "
        "design level."
    )
    records_title: str = "The records of the dynamic check"
    table_records: str = (
        "The set of the dynamic check: each record has the one factor that brings its spectrum nearest to "
        "the target."
    )


@dataclass(frozen=True, kw_only=True)
class Sure:
    """How sure a conclusion is: a figure, and what it is the figure of."""

    value: str
    text: str


@dataclass(frozen=True, kw_only=True)
class Basis:
    """The page behind the one to sign."""

    title: str
    figure: tuple[Picture, ...]
    checks: PageTable
    mechanisms: PageTable
    sentences: tuple[str, ...]
    periods: PageTable
    share: str
    strips: tuple[Strip, ...]


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a page to sign holds below its conclusion."""

    way: str
    bars: tuple[Picture, ...]
    sure: tuple[Sure, ...]
    assumptions: tuple[str, ...]
    basis: Basis


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """The page of one structure; without an answer where it could not be checked, and it is then not to be signed."""

    name: str
    level: str
    place: str
    headline: str
    met: bool
    details: tuple[str, ...]
    answers: tuple[Answer, ...]


@dataclass(frozen=True)
class SetFigure:
    """The set of records of the dynamic check against its target."""

    picture: Picture
    caption: str


@dataclass(frozen=True, kw_only=True)
class StructuresPage(Page):
    """The pages to sign."""

    template = Path(__file__).with_name("structures.typ")

    words: SignWords
    notices: tuple[str, ...]
    unread: str
    spectra: tuple[SetFigure, ...]
    motions: PageTable
    sheets: tuple[Sheet, ...]
