"""The pages of the documentation: what the code says of itself is written between marks in them, and read as it stands.

Between `<!-- generated: NAME -->` and `<!-- end -->` stands what the function NAME of `generated` returns, between
`<!-- measured: NAME -->` and the end mark a figure of docs/measured/figures.csv, `<!-- measured by: NAME -->` what made
it, `<!-- score FORM: TARGET; SUBJECT; PART; MEASURE -->` a score that a target of the research left in
docs/measured/scores. A page with figures of its own, `![CAPTION](figures/PAGE_NAME.svg)`, is run: a block of text below
an example is what it prints, and a figure that of the `axes` which the examples above left.

    python -m docs.site.pages [--figures] [--check]

writes the marked parts; with --figures also runs the examples and draws, which takes minutes; with --check writes
nothing, and fails where a page differs.
"""

from __future__ import annotations

import argparse
import io
import os
import re
import sys
import tempfile
from collections.abc import Sequence
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

from docs.site.build import FOLDER, MARKED, ROOT, written_pages
from docs.site.drawings import drawing, forms
from docs.site.generated import GENERATED, SLOW
from docs.site.kept import printed_score
from docs.site.measured import measured
from rocking.errors import ConfigurationError
from rocking.tables import write_whole

_RC: dict[str, object] = {
    "backend": "agg",
    "figure.figsize": (7.0, 3.6),
    "svg.fonttype": "path",
    "svg.hashsalt": "rocking",
}
_EXAMPLE = re.compile(
    r"^```python\n(?P<code>.*?)^```\n(?:\n```text\n.*?^```\n)?|^!\[[^\]\n]*\]\(figures/(?P<figure>\w+)\.svg\)$",
    re.M | re.S,
)


def python_blocks(text: str) -> list[str]:
    """Return the Python examples of a page in their order; each may use what those before it made."""
    return [match["code"] for match in _EXAMPLE.finditer(text) if match["code"]]


def filled(text: str, page: str, passed_over: frozenset[str] = frozenset()) -> str:
    """Return a page with what the code says now between its marks, but for the generated parts that are passed over.

    Raises ConfigurationError for a part, a figure or a score that there is not.
    """

    def content(match: re.Match[str]) -> str:
        kind, name, before = match.groups()
        if kind == "generated" and name not in GENERATED:
            names = ", ".join(GENERATED)
            raise ConfigurationError(f"{page}: generated part is {name!r}, but must be one of {names}.")
        if name in passed_over:
            return match[0]
        if kind == "generated":
            own = GENERATED[name]()
            inside = f"\n\n{own}\n\n" if "\n" in before else own
        elif kind.startswith("score "):
            inside = printed_score(kind.removeprefix("score "), name)
        else:
            figure = measured(name)
            inside = figure.words if kind == "measured" else figure.origin
        return f"<!-- {kind}: {name} -->{inside}<!-- end -->"

    return MARKED.sub(content, text)


def illustrated(text: str, page: str) -> tuple[str, dict[str, str]]:
    """Return a page with what its examples print, and its own figures, SVG by file name.

    Only a page that has such a figure is run.
    """
    stem = page.removesuffix(".md")
    if f"(figures/{stem}_" not in text:
        return text, {}
    names: dict[str, object] = {}
    figures: dict[str, str] = {}

    def content(match: re.Match[str]) -> str:
        code, figure = match["code"], match["figure"]
        if code is None:
            if figure.startswith(f"{stem}_"):
                figures[f"{figure}.svg"] = outlined(names["axes"].figure)  # type: ignore[attr-defined]
            return match[0]
        with redirect_stdout(io.StringIO()) as printed:
            exec(compile(code, f"{page} (example)", "exec"), names)
        output = printed.getvalue()
        return f"```python\n{code}```\n" + (f"\n```text\n{output}```\n" if output else "")

    from matplotlib import rc_context

    home = Path.cwd()
    with tempfile.TemporaryDirectory() as folder, rc_context(_RC):
        (Path(folder) / "records").symlink_to(ROOT / "records")
        os.chdir(folder)  # as a reader who tries the examples in a folder with the shipped records
        try:
            return _EXAMPLE.sub(content, text), figures
        finally:
            os.chdir(home)


def outlined(figure: Figure) -> str:
    """The figure with its letters as outlines, so that it looks alike on every machine; the same bytes at every run."""
    from matplotlib import rc_context

    stream = io.StringIO()
    with rc_context(_RC):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    return stream.getvalue()


def written(draws: bool, passed_over: frozenset[str] = frozenset()) -> dict[Path, str]:
    """Return what the pages hold, and where asked for the figures, by path."""
    contents = {
        page: filled(page.read_text(encoding="utf-8"), page.name, passed_over) for page in written_pages()
    }
    if not draws:
        return contents
    from docs.paper.report import equivalence_figures

    figures = {f"{name}.svg": outlined(drawing(kind, form)) for name, kind, form in forms()}
    figures |= {f"paper_{drawn.name}.svg": outlined(drawn.figure) for drawn in equivalence_figures()}
    for page in contents:
        contents[page], of_page = illustrated(contents[page], page.name)
        figures |= of_page
    return contents | {FOLDER / "figures" / name: content for name, content in figures.items()}


def main(arguments: Sequence[str] | None = None) -> int:
    """Write what has changed in the pages and print its paths; with --check return 1 where something has."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--figures", action="store_true", help="run the examples and draw as well")
    parser.add_argument("--check", action="store_true", help="write nothing; pass over what takes seconds")
    options = parser.parse_args(arguments)
    contents = written(options.figures, SLOW if options.check and not options.figures else frozenset())
    changed = {
        path: text
        for path, text in contents.items()
        if not path.is_file() or path.read_text(encoding="utf-8") != text
    }
    for path, text in changed.items():
        if not options.check:
            write_whole(path, text.encode())
        print(path.relative_to(ROOT))
    if options.check and changed:
        print("These are not what the code says; make pages writes them.", file=sys.stderr)
    return 1 if options.check and changed else 0


if __name__ == "__main__":
    sys.exit(main())
