"""The pages as they are written, and as they read with their generated parts in place."""

import re
from dataclasses import dataclass
from pathlib import Path

from docs.site.generated import GENERATED
from rocking.errors import ConfigurationError

_GENERATED = re.compile(r"^<!-- generated: (\w+) -->$", re.M)
_PYTHON = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)


@dataclass(frozen=True)
class Page:
    """One page: the name of its file without suffix, and its title."""

    name: str
    title: str

    @property
    def path(self) -> Path:
        """The Markdown file."""
        return Path(__file__).parents[1] / "pages" / f"{self.name}.md"


PAGES = (
    Page("index", "Quick start"),
    Page("numbers", "What the numbers mean"),
    Page("theory", "Theory and corrected equations"),
    Page("structures", "Structures, and how to add one"),
    Page("formats", "Formats, and how to add one"),
    Page("settings", "Settings"),
    Page("tables", "Tables"),
    Page("api", "Python names"),
)
"""The pages in their order."""


def read_page(page: Page, workflow: Path) -> str:
    """Return the Markdown of `page`, filled from the code and from the schemas in the folder `workflow`.

    Raises ConfigurationError for a part that nothing generates.
    """

    def made(match: re.Match[str]) -> str:
        if match[1] not in GENERATED:
            names = ", ".join(GENERATED)
            raise ConfigurationError(
                f"{page.path.name}: generated part is {match[1]!r}, but must be one of {names}."
            )
        return GENERATED[match[1]](workflow)

    return _GENERATED.sub(made, page.path.read_text(encoding="utf-8"))


def python_blocks(page: Page) -> list[str]:
    """Return the Python examples of `page` in their order; each may use what those before it made."""
    return _PYTHON.findall(page.path.read_text(encoding="utf-8"))
