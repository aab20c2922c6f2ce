"""From a template, data and figures to the bytes of a PDF/A, the same at every run."""

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import typst

from rocking.reports.style import FONT_FOLDER, glyphs

_FOLDER = Path(__file__).parent


def compile_document(template: str | Path, data: Mapping[str, object]) -> bytes:
    """Set `template` with `data` and return the PDF. template: a .typ file of this folder, by its name; or a path
    anywhere else, whose content then stands as if it were in this folder.

    Every text in `data` is printed as it is: it reaches the template as JSON and is never parsed as markup. The date
    of the document is fixed, because PDF/A asks for one and the same input must give the same bytes.
    """
    text = json.dumps(data, ensure_ascii=False)
    foreign = not glyphs().issuperset(map(ord, set(text)))
    carried = _fonts(False).families()
    families = [each for each in _fonts(foreign).families() if each not in carried]
    return typst.compile(  # type: ignore[call-overload,no-any-return]  # its stub wants input and root of one type
        template.read_bytes() if isinstance(template, Path) else _FOLDER / template,
        root=_FOLDER,
        font_paths=_fonts(foreign),
        ignore_system_fonts=True,
        sys_inputs={"data": text, "families": json.dumps(families)},
        pdf_standards="a-2a",
        timestamp=0,
    )


@cache
def _fonts(system: bool) -> typst.Fonts:
    """The fonts that typst and matplotlib carry, and the machine's where another script needs them."""
    return typst.Fonts(include_system_fonts=system, font_paths=[FONT_FOLDER])
