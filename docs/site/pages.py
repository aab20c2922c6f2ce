"""The pages as they are written, and as they read with what the code knows and draws in place.

`<!-- generated: NAME -->` stands for what the function NAME of `generated` returns, `<!-- file: PATH -->` for a file
of the repository, `<!-- figure: NAME. CAPTION -->` for the figure of the axes that the examples above left in `axes`.
"""

import io
import os
import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from docs.site.generated import GENERATED
from rocking.errors import ConfigurationError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FOLDER = Path(__file__).parents[1] / "pages"
ROOT = FOLDER.parents[1]
_MARK = re.compile(r"^<!-- (generated|file): (\S+) -->$", re.M)
_EXAMPLE = re.compile(r"^```python\n(.*?)^```$|^<!-- figure: (\w+)\. (.*?) -->$", re.M | re.S)


def written_pages() -> list[Path]:
    """Return the pages as they are written."""
    return sorted(FOLDER.glob("*.md"))


def python_blocks(text: str) -> list[str]:
    """Return the Python examples of a page in their order; each may use what those before it made."""
    return [match[1] for match in _EXAMPLE.finditer(text) if match[1]]


def filled(text: str, name: str, workflow: Path) -> str:
    """Return a page with its generated parts and files in place. workflow: the folder with the schemas.

    Raises ConfigurationError for a part that nothing generates.
    """

    def made(match: re.Match[str]) -> str:
        kind, part = match.groups()
        if kind == "file":
            return (ROOT / part).read_text(encoding="utf-8")
        if part not in GENERATED:
            names = ", ".join(GENERATED)
            raise ConfigurationError(f"{name}: generated part is {part!r}, but must be one of {names}.")
        return GENERATED[part](workflow)

    return _MARK.sub(made, text)


def illustrated(text: str, page: str) -> tuple[str, dict[str, str]]:
    """Return a page with images for its figures, and the figures, SVG by file name, made by running its examples."""
    if "<!-- figure:" not in text:
        return text, {}
    names: dict[str, object] = {}
    figures: dict[str, str] = {}

    def made(match: re.Match[str]) -> str:
        code, name, caption = match.groups()
        if code is not None:
            exec(compile(code, f"{page} (example)", "exec"), names)
            return match[0]
        file = f"{Path(page).stem}_{name}.svg"
        figures[file] = _svg(names["axes"].figure)  # type: ignore[attr-defined]
        return (
            f"<figure markdown>\n![{caption}](figures/{file})\n<figcaption>{caption}</figcaption>\n</figure>"
        )

    home = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # as a reader who tries the examples in a folder of their own
        try:
            return _EXAMPLE.sub(made, text), figures
        finally:
            os.chdir(home)


def _svg(figure: "Figure") -> str:
    """The figure with its letters as outlines, so that it looks alike on every machine; the same bytes at every run."""
    import matplotlib

    stream = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": "rocking"}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    return stream.getvalue()
