"""Sentences, warnings, numbers and descriptions as a document prints them in English or another language.

The law and the office that takes the pages to sign are Italian; every other document is English. English is written
where it is said; what the pages to sign print is in the other language in its catalogue of messages, `it.po`, in which
the English text is the key.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from string import Formatter
from typing import Any

from rocking import quantities
from rocking.assessment.decide import Verdict
from rocking.reports import printing
from rocking.reports.pages import Language
from rocking.reports.printing import unit_of
from rocking.structures.description import Given
from rocking.warnings import Phrase, RockingWarning


@cache
def catalogue(language: Language) -> Mapping[tuple[str, str], str]:
    """Return the texts of a language by context and English text; the context is "" but where one text says two things.

    None of English, which is the key.
    """
    if language == "en":
        return {}
    import polib  # which a page in another language alone needs

    entries = polib.pofile(str(Path(__file__).with_name(f"{language}.po")))
    return {(entry.msgctxt or "", entry.msgid): entry.msgstr for entry in entries}


class _Commas(Formatter):
    """Formats numbers with a decimal comma."""

    def format_field(self, value: Any, format_spec: str) -> str:
        text = str(super().format_field(value, format_spec))
        return text.replace(".", ",") if isinstance(value, float) else text


@dataclass(frozen=True)
class Sentences:
    """What a document says in one language, with the numbers as that language writes them."""

    language: Language = "en"

    def __call__(self, text: str, /, **values: str | float) -> str:
        """Return an English text in the language, with its values in braces; in English where that has no words."""
        formatter = Formatter() if self.language == "en" else _Commas()
        return formatter.vformat(self._translated(text), (), values)

    def _translated(self, text: str, context: str = "") -> str:
        return catalogue(self.language).get((context, text), text)

    def phrase(self, words: str) -> str:
        """Return words that a structure is described with, each of their parts in the language."""
        if not isinstance(words, Phrase):
            return self._translated(words)
        values = {
            name: self.phrase(value) if isinstance(value, str) else value
            for name, value in words.values.items()
        }
        return self(words.text, **values)

    def of(self, warning: RockingWarning) -> str:
        """Return a warning in words."""
        return str(warning) if self.language == "en" else self.reason(warning)

    def reason(self, why: str | RockingWarning) -> str:
        """Return why something was refused. What is no warning is English, and a page in another language says so."""
        if isinstance(why, RockingWarning):
            return self(why.kind.sentence, about=why.about, **dict(why.values))
        return self("{text}", text=why)

    def verdict(self, verdict: Verdict) -> str:
        """Return a verdict in the room that its colour has."""
        return self._translated(str(verdict), "on its colour")

    def counted(self, number: int, what: str) -> str:
        """Return "1 record", "2 records"."""
        return self("{n} " + what if number == 1 else "{n} " + f"{what}s", n=number)

    def listed(self, texts: Sequence[str]) -> str:
        """Return the texts in a row, with "and" before the last one."""
        return f" {self('and')} ".join(filter(None, [", ".join(texts[:-1]), *texts[-1:]]))

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
        text = given.text
        if given.value in given.field.options:
            text = self(given.value.replace("_", " "))
        elif self.language != "en" and not isinstance(given.value, str):
            # Where commas are decimal, others part the numbers of a list.
            text = "; ".join(map(self.decimal, text.split(", ")))
        return self(given.field.phrase, value=text + given.field.suffix)
