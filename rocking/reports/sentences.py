"""The sentences of documents that are written in English or Italian: sentences.csv, from key to text.

The law and the office that takes the pages to sign are Italian; every other document is English. A product over all
records keeps what it alone says in a file of its own.
"""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import get_args

from rocking import quantities
from rocking.remarks import Language, Remark, filled
from rocking.reports import printing
from rocking.reports.printing import unit_of
from rocking.structures.description import Given


@dataclass(frozen=True)
class Sentences:
    """The catalogue in one language, with the numbers as that language writes them. own: the file of a product."""

    language: Language = "en"
    own: Path | None = None

    def __call__(self, key: str, **values: str | int | float) -> str:
        """Return the sentence of a key with its values. Raises KeyError for one that the catalogue does not hold."""
        return filled(catalogue(self.own)[key][self.language], self.language, values)

    def counted(self, number: int, what: str) -> str:
        """Return "1 record", "2 records"."""
        one, many = catalogue(self.own)[f"count {what}"][self.language].split("|")
        return (one if number == 1 else many).format(n=number)

    def of(self, remark: Remark) -> str:
        """Return a remark in words."""
        return str(remark) if self.language == "en" else remark.sentence_in(self.language)

    def reason(self, why: str | Remark) -> str:
        """Return why something was refused. What is no remark is English, and an Italian page says so."""
        if isinstance(why, Remark):
            return self.of(why) if not (why.about and self.language == "en") else why.sentence_in("en")
        return why if self.language == "en" else self("in english", text=why)

    def number(self, value: float | None, digits: int = 3) -> str:
        """Return a number to so many significant digits."""
        return self.decimal(printing.number(value, digits))

    def plain(self, value: float) -> str:
        """Return a number that somebody chose, without trailing zeros."""
        return self.decimal(printing.plain(value))

    def quantity(self, value: float, si: str) -> str:
        """Return a value in the SI unit `si` as the report at hand shows it, with its unit."""
        unit = unit_of(si)
        return f"{self.number(value / unit.size)}\u00a0{unit.name}"

    def percents(self, *shares: float) -> str:
        """Return the range of several shares: "11–13 %"."""
        return self.decimal(quantities.percents(*shares))

    def decimal(self, text: str) -> str:
        """Return a printed number with the decimal mark of the language."""
        return text if self.language == "en" else text.replace(".", ",")

    def listed(self, texts: Sequence[str]) -> str:
        """Return the texts in a row, with "and" before the last one."""
        return f" {self('and')} ".join(filter(None, [", ".join(texts[:-1]), *texts[-1:]]))

    def described(self, given: Given) -> str:
        """Return one value of the description of a structure: "height 6.0 m"."""
        named = isinstance(given.value, str) and given.value in given.field.options
        text = self(f"value {given.value}") if named else given.text
        if self.language == "en":
            phrase: str = given.field.phrased(text)
            return phrase
        name = self(f"field {given.field.name}")
        if given.value is True:
            return name
        if not isinstance(given.value, str):
            # Where commas are decimal, others part the numbers of a list.
            text = "; ".join(map(self.decimal, given.text.split(", ")))
        return f"{name} {text}{given.field.suffix}"


@cache
def catalogue(own: Path | None = None) -> Mapping[str, Mapping[str, str]]:
    """Return the texts by key and language, with those of a file `own`. Raises ValueError for a key that lacks one.

    The words of a remark stand where its kind is declared.
    """
    texts: dict[str, dict[str, str]] = {}
    for path in (Path(__file__).with_name("sentences.csv"), *([own] if own else [])):
        with path.open(encoding="utf-8", newline="") as stream:
            texts |= {row.pop("key"): row for row in csv.DictReader(stream)}
    for key, row in texts.items():
        if lacking := [language for language in get_args(Language) if not row[language]]:
            raise ValueError(f"sentences.csv: {key} has no text in {', '.join(lacking)}.")
    return texts
