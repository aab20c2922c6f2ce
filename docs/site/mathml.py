"""A Markdown extension: the equations that pymdownx.arithmatex finds become MathML, which needs no script."""

import re
from html import unescape

from latex2mathml.converter import convert
from markdown import Markdown
from markdown.extensions import Extension
from markdown.postprocessors import Postprocessor

_EQUATION = re.compile(r'<(span|div) class="arithmatex">\s*\\[(\[](.*?)\\[)\]]\s*</\1>', re.S)


class MathPostprocessor(Postprocessor):
    """Equations between \\( \\) and \\[ \\] become inline and display MathML."""

    def run(self, text: str) -> str:
        return _EQUATION.sub(_set, text)


class MathExtension(Extension):
    """Runs after everything else has been put in its place."""

    def extendMarkdown(self, md: Markdown) -> None:
        md.postprocessors.register(MathPostprocessor(md), "mathml", -10)


def _set(match: re.Match[str]) -> str:
    return convert(unescape(match[2]).strip(), display="block" if match[1] == "div" else "inline")


def makeExtension(**options: object) -> MathExtension:
    """Return the extension; the name is what Markdown looks for."""
    return MathExtension(**options)
