"""Remarks, numbers and descriptions as a document prints them in English or Italian; it holds no sentence itself.

The law and the office that takes the pages to sign are Italian; every other document is English. The words of a remark
stand where its kind is declared, the Italian names of keys in `rocking.structures.names`; a product over all records
keeps what it alone says in its folder, as sentences.csv.
"""

from dataclasses import dataclass

from rocking import quantities
from rocking.remarks import Language, Remark
from rocking.reports import printing
from rocking.reports.printing import unit_of
from rocking.structures.description import Given
from rocking.structures.names import ITALIAN, OPTIONS


@dataclass(frozen=True)
class Sentences:
    """What a document says in one language, with the numbers as that language writes them."""

    language: Language = "en"

    def of(self, remark: Remark) -> str:
        """Return a remark in words."""
        return str(remark) if self.language == "en" else remark.sentence_in(self.language)

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

    def described(self, given: Given) -> str:
        """Return one value of the description of a structure: "height 6.0 m"."""
        named = isinstance(given.value, str) and given.value in given.field.options
        text = OPTIONS[str(given.value)].text_in(self.language) if named else given.text
        if self.language == "en":
            phrase: str = given.field.phrased(text)
            return phrase
        name = ITALIAN[given.field.name]
        if given.value is True:
            return name
        if not isinstance(given.value, str):
            # Where commas are decimal, others part the numbers of a list.
            text = "; ".join(map(self.decimal, given.text.split(", ")))
        return f"{name} {text}{given.field.suffix}"
