"""The sentences of the pages to sign: sentences.csv, from key to text in every language."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import get_args

from rocking.remarks import Language, Remark, filled
from rocking.reports.sentences import Sentences


@dataclass(frozen=True)
class SignSentences(Sentences):
    """What the pages to sign say in one language."""

    def __call__(self, key: str, **values: str | int | float) -> str:
        """Return the sentence of a key with its values. Raises KeyError for one that the catalogue does not hold."""
        return filled(catalogue()[key][self.language], self.language, values)

    def counted(self, number: int, what: str) -> str:
        """Return "1 record", "2 records"."""
        one, many = catalogue()[f"count {what}"][self.language].split("|")
        return (one if number == 1 else many).format(n=number)

    def reason(self, why: str | Remark) -> str:
        """Return why something was refused. What is no remark is English, and an Italian page says so."""
        if isinstance(why, Remark):
            return self.of(why) if not (why.about and self.language == "en") else why.sentence_in("en")
        return why if self.language == "en" else self("in english", text=why)

    def listed(self, texts: Sequence[str]) -> str:
        """Return the texts in a row, with "and" before the last one."""
        return f" {self('and')} ".join(filter(None, [", ".join(texts[:-1]), *texts[-1:]]))


@cache
def catalogue() -> Mapping[str, Mapping[str, str]]:
    """Return the texts by key and language. Raises ValueError for a key that lacks one."""
    with Path(__file__).with_suffix(".csv").open(encoding="utf-8", newline="") as stream:
        texts = {row.pop("key"): row for row in csv.DictReader(stream)}
    for key, row in texts.items():
        if lacking := [language for language in get_args(Language) if not row[language]]:
            raise ValueError(f"sentences.csv: {key} has no text in {', '.join(lacking)}.")
    return texts
