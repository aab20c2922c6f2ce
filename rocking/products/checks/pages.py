"""What the template of the pages to sign is given; see `rocking.reports.pages`."""

from dataclasses import dataclass
from pathlib import Path

from rocking.reports.pages import Page, Picture, Strip, Table


@dataclass(frozen=True, kw_only=True)
class SignWords:
    """What the pages to sign say in every study, in their language."""

    what_governs: str
    capacity_over_demand: str
    how_sure: str
    assumed: str
    place_and_date: str
    signature: str
    not_to_sign: str
    next_page: str
    figure: str
    table_checks: str
    table_mechanisms: str
    table_periods: str
    variants_title: str
    records_title: str
    table_records: str


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
    checks: Table
    mechanisms: Table
    sentences: tuple[str, ...]
    periods: Table
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
    motions: Table
    sheets: tuple[Sheet, ...]
