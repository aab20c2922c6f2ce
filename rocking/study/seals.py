"""The seal of a product: beside it stands what it was made from, and what it wrote.

A product is computed again where its seal does not hold: none stands, it was made from something else, or a file was
cut, edited or removed since. Nothing else decides, and to ask writes nothing.
"""

import json
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from rocking.errors import ConfigurationError, RockingError
from rocking.hashes import sha256_of, sha256_of_file
from rocking.study.contents import mark_of
from rocking.tables import read_whole, write_whole

MADE_FROM = ".made_from"
"""The folder in the results that holds the seals, and what is kept of each record for the next run."""
_LARGEST = 10_000_000
"""Bytes of a seal that are read; one of a thousand files takes two hundred thousand."""


class Seals:
    """The seals of a study, in the folder of its `results`; things: what a product is made from now, by its name."""

    def __init__(self, results: Path, things: Callable[[str], Mapping[str, str]]) -> None:
        self._results = results
        self._things = things

    def path(self, product: str) -> Path:
        """Return the file that is the seal of a product, one of `made_from.TABLE`."""
        return self._results / MADE_FROM / f"{product}.json"

    def key(self, product: str) -> str:
        """Return one hash for all that a product is made from."""
        return sha256_of(*sorted(self._things(product).items()))

    def why_again(self, product: str) -> str:
        """Return why a product is to be computed again, as a clause; "" where its seal holds."""
        path = self.path(product)
        if not path.exists():
            return "it is not there"
        try:
            seal = _opened(path)
            before = dict(seal["made_from"])
            written = {str(name): (list(mark), str(sha256)) for name, (mark, sha256) in seal["files"].items()}
        except (RockingError, ValueError, KeyError, TypeError, RecursionError):
            return f"{path} cannot be read"
        now = self._things(product)
        # A mapping has no order, so that a thing that came or went is a change as well.
        changed = [name for name in {**now, **before} if now.get(name) != before.get(name)]
        if changed:
            return f"changed: {', '.join(changed)}"
        for name, (mark, sha256) in written.items():
            file = self._results / name
            try:
                touched = mark_of(file.stat()) != mark
                if touched and sha256_of_file(file) != sha256:
                    return f"{file} is not as it was written"
            except OSError:
                return f"{file} is not there any more"
        return ""

    def write(self, product: str, key: str, files: Iterable[Path]) -> None:
        """Seal the `files` of a product, of which those that do not stand are left out.

        key: what was planned. Raises ConfigurationError, and writes no seal, where it was made from something else.
        """
        things = self._things(product)
        if sha256_of(*sorted(things.items())) != key:
            raise ConfigurationError(
                f"{product}: a file or a setting changed while the study ran; start the study again."
            )
        written = {}
        for file in sorted(set(files)):
            if file.is_file() and file != self.path(product):
                name = file.relative_to(self._results).as_posix()
                written[name] = [mark_of(file.stat()), sha256_of_file(file)]
        content = {"made_from": dict(things), "files": written}
        write_whole(self.path(product), (json.dumps(content, indent=1) + "\n").encode())

    def contents_of(self, product: str) -> str:
        """Return one hash for the contents of the files of a product; "" where it has no seal."""
        try:
            files = _opened(self.path(product))["files"]
            return sha256_of(*sorted((name, sha256) for name, (_, sha256) in files.items()))
        except (RockingError, OSError, ValueError, KeyError, TypeError, RecursionError, AttributeError):
            return ""


def _opened(path: Path) -> dict[str, Any]:
    """The content of a seal. Raises RockingError or ValueError where it is none."""
    content = json.loads(read_whole(path, _LARGEST, RockingError))
    if not isinstance(content, dict):
        raise ValueError("it is no seal")
    return content
