"""A Markdown extension: equations that pymdownx.arithmatex finds become MathML; examples of docstrings become code."""

import re
from html import unescape

from latex2mathml.converter import convert
from markdown import Markdown
from markdown.extensions import Extension
from markdown.postprocessors import Postprocessor
from markdown.preprocessors import Preprocessor

_EQUATION = re.compile(r'<(span|div) class="arithmatex">\s*\\[(\[](.*?)\\[)\]]\s*</\1>', re.S)
_EXAMPLE = re.compile(r"^>>> .*?(?=^\s*$|\Z)", re.M | re.S)


class MathPostprocessor(Postprocessor):
    """Equations between \\( \\) and \\[ \\] become inline and display MathML."""

    def run(self, text: str) -> str:
        return _EQUATION.sub(_set, text)


class ExamplePreprocessor(Preprocessor):
    """An example, from its first prompt to the next blank line, becomes a fenced block."""

    def run(self, lines: list[str]) -> list[str]:
        return _EXAMPLE.sub(lambda match: f"```pycon\n{match[0].rstrip()}\n```\n", "\n".join(lines)).split(
            "\n"
        )


class Markup(Extension):
    """Examples are fenced before any other step, and equations set after everything is in its place."""

    def extendMarkdown(self, md: Markdown) -> None:
        md.preprocessors.register(ExamplePreprocessor(md), "examples", 100)
        md.postprocessors.register(MathPostprocessor(md), "mathml", -10)


def _set(match: re.Match[str]) -> str:
    return convert(unescape(match[2]).strip(), display="block" if match[1] == "div" else "inline")


def makeExtension(**options: object) -> Markup:
    """Return the extension; the name is what Markdown looks for."""
    return Markup(**options)
