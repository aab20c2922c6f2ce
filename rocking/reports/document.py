"""From a template, data and figures to the bytes of a PDF/A, the same at every run."""

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import matplotlib
import typst

_FOLDER = Path(__file__).parent
_STANDARD = "a-2a"


def compile_document(template: str, data: Mapping[str, object]) -> bytes:
    """Set `template` (a .typ file of this package) with `data` and return the PDF.

    Every text in `data` is printed as it is: it reaches the template as JSON and is never parsed as markup. The date
    of the document is fixed, because PDF/A asks for one and the same input must give the same bytes.
    """
    return typst.compile(
        _FOLDER / template,
        root=_FOLDER,
        font_paths=_fonts(),
        ignore_system_fonts=True,
        sys_inputs={"data": json.dumps(data, ensure_ascii=False)},
        pdf_standards=[_STANDARD],
        timestamp=0,
        format="pdf",
    )


@cache
def _fonts() -> typst.Fonts:
    """The fonts that typst and matplotlib carry, and none of the machine's: pages look alike everywhere."""
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    return typst.Fonts(include_system_fonts=False, font_paths=[folder])
