"""From the pages to a site that opens without a network: filled and illustrated by the code, then set by MkDocs.

`<!-- generated: NAME -->` stands for what the function NAME of `generated` returns, `<!-- file: PATH -->` for a file
of the repository, `<!-- measured: NAME -->` within a line for a figure of docs/measured/figures.csv with its age,
`<!-- measured by: NAME -->` for what made it, `<!-- score FORM: TARGET; SUBJECT; PART; MEASURE -->` for a score that a
target of the research left in docs/measured/scores, and `<!-- figure: NAME. CAPTION -->` for the figure of the axes
that the examples above left in `axes`.
"""

import io
import os
import re
import shutil
import tempfile
from contextlib import redirect_stdout
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

from docs.paper.report import equivalence_figures
from docs.site.drawings import drawing, forms
from docs.site.generated import GENERATED
from docs.site.kept import printed_score
from docs.site.measured import measured
from rocking.errors import ConfigurationError

FOLDER = Path(__file__).parents[1] / "pages"
ROOT = FOLDER.parents[1]
PAGE_TWO = ROOT / "workflow" / "report" / "example.png"
"""The picture of the README, which the gallery shows as well."""
CONFIGURATION = FOLDER.parent / "mkdocs.yml"
_RC: dict[str, object] = {
    "backend": "agg",
    "figure.figsize": (7.0, 3.6),
    "svg.fonttype": "path",
    "svg.hashsalt": "rocking",
}
_MARK = re.compile(r"^<!-- (generated|file): (\S+) -->$", re.M)
_MEASURED = re.compile(r"<!-- measured( by)?: (\S+) -->")
_SCORE = re.compile(r"<!-- score (\S+): (.*?) -->")
_EXAMPLE = re.compile(r"^```python\n(.*?)^```$|^<!-- figure: (\w+)\. (.*?) -->$", re.M | re.S)


def documentation(target: str, log: str) -> None:
    """Do the job of the rule documentation."""
    pages = write_site(Path(target))
    Path(log).write_text("\n".join(map(str, pages)) + "\n", encoding="utf-8")


def write_site(target: Path) -> list[Path]:
    """Write the site into the folder `target` and return its pages.

    Raises ConfigurationError when a package of the extra docs is missing, or when MkDocs finds a defect, such as a link
    that leads nowhere.
    """
    try:
        import latex2mathml  # noqa: F401
        import material  # noqa: F401
        import mkdocstrings_handlers.python  # noqa: F401
        from mkdocs.commands.build import build
        from mkdocs.config import load_config
        from mkdocs.exceptions import Abort
    except ImportError as error:
        raise ConfigurationError(
            f"the package {error.name} is missing, but the documentation needs it; make documentation installs it."
        ) from None
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "pages"
        write_pages(source)
        try:
            build(load_config(str(CONFIGURATION), docs_dir=str(source), site_dir=str(target.resolve())))
        except Abort as error:
            raise ConfigurationError(f"{CONFIGURATION}: {error}; its warnings say what to mend.") from None
    return sorted(target.glob("*.html"))


def write_pages(target: Path) -> None:
    """Write the pages, complete, with their figures and assets, into the folder `target`."""
    shutil.copytree(FOLDER / "assets", target / "assets")
    (target / "figures").mkdir()
    figures = {f"{name}.svg": outlined(drawing(kind, form)) for name, kind, form in forms()}
    figures |= {f"paper_{drawn.name}.svg": outlined(drawn.figure) for drawn in equivalence_figures()}
    for page in written_pages():
        text, of_page = illustrated(page.read_text(encoding="utf-8"), page.name)
        (target / page.name).write_text(filled(text, page.name), encoding="utf-8")
        figures |= of_page
    shutil.copy(PAGE_TWO, target / "figures" / PAGE_TWO.name)
    for name, content in figures.items():
        (target / "figures" / name).write_text(content, encoding="utf-8")


def written_pages() -> list[Path]:
    """Return the pages as they are written."""
    return sorted(FOLDER.glob("*.md"))


def python_blocks(text: str) -> list[str]:
    """Return the Python examples of a page in their order; each may use what those before it made."""
    return [match[1] for match in _EXAMPLE.finditer(text) if match[1]]


def filled(text: str, name: str) -> str:
    """Return a page with its generated parts and files in place.

    Raises ConfigurationError for a part that nothing generates.
    """

    def content(match: re.Match[str]) -> str:
        kind, part = match.groups()
        if kind == "file":
            return (ROOT / part).read_text(encoding="utf-8")
        if part not in GENERATED:
            names = ", ".join(GENERATED)
            raise ConfigurationError(f"{name}: generated part is {part!r}, but must be one of {names}.")
        return GENERATED[part]()

    def figure(match: re.Match[str]) -> str:
        found = measured(match[2])
        return found.origin if match[1] else found.words

    printed = _SCORE.sub(lambda match: printed_score(*match.groups()), _MEASURED.sub(figure, text))
    return _MARK.sub(content, printed)  # a file is shown as it stands


def illustrated(text: str, page: str) -> tuple[str, dict[str, str]]:
    """Return a page with what its examples print and draw, and the figures, SVG by file name.

    Only a page that has a figure is run.
    """
    if "<!-- figure:" not in text:
        return text, {}
    names: dict[str, object] = {}
    figures: dict[str, str] = {}

    def content(match: re.Match[str]) -> str:
        code, name, caption = match.groups()
        if code is not None:
            with redirect_stdout(io.StringIO()) as printed:
                exec(compile(code, f"{page} (example)", "exec"), names)
            output = printed.getvalue()
            return f"{match[0]}\n\n```text\n{output}```" if output else match[0]
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
            return _EXAMPLE.sub(content, text), figures
        finally:
            os.chdir(home)


def outlined(figure: Figure) -> str:
    """The figure with its letters as outlines, so that it looks alike on every machine; the same bytes at every run."""
    stream = io.StringIO()
    with matplotlib.rc_context(_RC):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    return stream.getvalue()
