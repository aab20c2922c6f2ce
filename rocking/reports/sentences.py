"""The sentences of the pages to sign, in English or Italian: one catalogue, sentences.csv, from key to text.

The law and the office that takes the pages are Italian; every other document is English.
"""

import csv
import string
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

from rocking import quantities
from rocking.remarks import Remark
from rocking.reports import printing
from rocking.reports.printing import unit_of
from rocking.structures.fields import Given

Language = Literal["en", "it"]


class _Commas(string.Formatter):
    """Formats numbers with a decimal comma."""

    def format_field(self, value: Any, format_spec: str) -> str:
        text = str(super().format_field(value, format_spec))
        return text.replace(".", ",") if isinstance(value, float) else text


@dataclass(frozen=True)
class Sentences:
    """The catalogue in one language, with the numbers as that language writes them."""

    language: Language = "en"

    def __call__(self, key: str, **values: str | int | float) -> str:
        """Return the sentence of a key with its values. Raises KeyError for one that the catalogue does not hold."""
        return self._formatted(catalogue()[key][self.language], values)

    def counted(self, number: int, what: str) -> str:
        """Return "1 record", "2 records"."""
        one, many = catalogue()[f"count {what}"][self.language].split("|")
        return (one if number == 1 else many).format(n=number)

    def of(self, remark: Remark) -> str:
        """Return a remark in words."""
        if self.language == "en":
            return str(remark)
        return self._formatted(
            catalogue()[f"kind {remark.kind}"][self.language], {**dict(remark.values), "about": remark.about}
        )

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
        if self.language == "en":
            phrase: str = given.field.phrased(given.text)
            return phrase
        name = catalogue()[f"field {given.field.name}"][self.language]
        if given.value is True:
            return name
        # Where commas are decimal, others part the numbers of a list.
        text = "; ".join(map(self.decimal, given.text.split(", ")))
        if isinstance(given.value, str):
            text = f"«{given.text}»"
        return f"{name} {text}{given.field.suffix}"

    def _formatted(self, sentence: str, values: Mapping[str, Any]) -> str:
        formatter = string.Formatter() if self.language == "en" else _Commas()
        return formatter.vformat(sentence, (), values)


@cache
def catalogue() -> Mapping[str, Mapping[str, str]]:
    """Return the texts by key and language. The English one of a remark or a field stands where that is declared."""
    with Path(__file__).with_name("sentences.csv").open(encoding="utf-8", newline="") as stream:
        return {row.pop("key"): row for row in csv.DictReader(stream)}
