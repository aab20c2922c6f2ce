"""The pages as they are written, and as they read with what the code knows and draws in place.

`<!-- generated: NAME -->` stands for what the function NAME of `generated` returns, `<!-- file: PATH -->` for a file
of the repository, `<!-- figure: NAME. CAPTION -->` for the figure of the axes that the examples above left in `axes`.
"""

import io
import os
import re
import tempfile
from contextlib import redirect_stdout
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

from docs.site.generated import GENERATED
from rocking.errors import ConfigurationError

FOLDER = Path(__file__).parents[1] / "pages"
ROOT = FOLDER.parents[1]
_RC: dict[str, object] = {
    "backend": "agg",
    "figure.figsize": (7.0, 3.6),
    "svg.fonttype": "path",
    "svg.hashsalt": "rocking",
}
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
    """Return a page with what its examples print and draw, and the figures, SVG by file name.

    Only a page that has a figure is run.
    """
    if "<!-- figure:" not in text:
        return text, {}
    names: dict[str, object] = {}
    figures: dict[str, str] = {}

    def made(match: re.Match[str]) -> str:
        code, name, caption = match.groups()
        if code is not None:
            with redirect_stdout(io.StringIO()) as printed:
                exec(compile(code, f"{page} (example)", "exec"), names)
            said = printed.getvalue()
            return f"{match[0]}\n\n```text\n{said}```" if said else match[0]
        file = f"{Path(page).stem}_{name}.svg"
        figures[file] = outlined(names["axes"].figure)  # type: ignore[attr-defined]
        return (
            f"<figure markdown>\n![{caption}](figures/{file})\n<figcaption>{caption}</figcaption>\n</figure>"
        )

    home = Path.cwd()
    with tempfile.TemporaryDirectory() as folder, matplotlib.rc_context(_RC):
        (Path(folder) / "records").symlink_to(ROOT / "records")
        os.chdir(folder)  # as a reader who tries the examples in a folder with the shipped records
        try:
            return _EXAMPLE.sub(made, text), figures
        finally:
            os.chdir(home)


def outlined(figure: Figure) -> str:
    """The figure with its letters as outlines, so that it looks alike on every machine; the same bytes at every run."""
    stream = io.StringIO()
    with matplotlib.rc_context(_RC):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    return stream.getvalue()
