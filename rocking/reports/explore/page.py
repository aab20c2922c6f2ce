"""The page itself: its content as JSON between a template, a sheet of styles and a script."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from rocking.quantities import counted

_HERE = Path(__file__).parent


def explore_page(
    records: Sequence[Mapping[str, object]],
    structures: Sequence[Mapping[str, object]],
    cases: Sequence[Mapping[str, object]],
    figures: Mapping[str, str],
) -> bytes:
    """Return the page as UTF-8 HTML that loads nothing.

    records: id, failure and motions by component. structures: name, size and drawings. cases: one for each record and
    structure. figures: SVG text by the name of its place, "scatter" or "fragility"; "" where there is none.
    """
    content = json.dumps(
        {"records": records, "structures": structures, "cases": cases}, allow_nan=False, separators=(",", ":")
    )
    page = (_HERE / "explore.html").read_text(encoding="utf-8")
    pieces = {
        "style": (_HERE / "explore.css").read_text(encoding="utf-8"),
        "script": (_HERE / "explore.js").read_text(encoding="utf-8"),
        "count": f"{counted(len(records), 'record')}, {counted(len(structures), 'structure')}",
        # no text of a user can end the element that holds it
        "content": content.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029"),
        **{name: _inline(figure) for name, figure in figures.items()},
    }
    head, *rest = page.split("{{")
    filled = [head]
    for part in rest:
        name, _, text = part.partition("}}")
        filled += [pieces[name.strip()], text]
    return "".join(filled).encode()


def _inline(figure: str) -> str:
    """An SVG file as an element of a page: without the XML declaration and the document type before it."""
    return figure[figure.index("<svg") :] if figure else ""
