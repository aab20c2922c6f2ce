"""From the pages to HTML that opens without a network: no script, no font, no address in it."""

from html import escape
from pathlib import Path

from docs.site.pages import PAGES, Page, read_page
from rocking.errors import ConfigurationError
from rocking.tables import write_whole

_STYLE = """
:root { color-scheme: light dark; }
body { margin: 0; font: 16px/1.5 system-ui, sans-serif; display: grid; grid-template-columns: 15rem minmax(0, 1fr); }
nav { padding: 1.5rem; border-right: 1px solid #8884; }
nav a { display: block; padding: .2rem 0; color: inherit; text-decoration: none; }
nav a:hover, main a:hover { text-decoration: underline; }
nav a[aria-current] { font-weight: 600; }
main { padding: 1.5rem 2rem 4rem; max-width: 64rem; }
h1, h2, h3, h4 { line-height: 1.25; margin: 1.6em 0 .5em; }
h1 { margin-top: 0; }
pre { padding: .7rem 1rem; overflow-x: auto; background: #8881; border-radius: 4px; font-size: .85rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .92rem; }
th, td { border-bottom: 1px solid #8884; padding: .3rem .8rem .3rem 0; text-align: left; vertical-align: top; }
li code { overflow-wrap: anywhere; }
.docstring { white-space: pre-wrap; border-left: 3px solid #8884; padding-left: 1rem; font-size: .92rem; }
@media (max-width: 50rem) { body { display: block; } nav { border-right: 0; border-bottom: 1px solid #8884; } }
"""


def write_site(target: Path, workflow: Path) -> list[Path]:
    """Write every page as HTML into the folder `target` and return the files.

    workflow: the folder with the schemas. Raises ConfigurationError when the package that sets Markdown is missing.
    """
    try:
        import markdown
    except ImportError:
        raise ConfigurationError(
            "the package markdown is missing, but the documentation needs it; install rocking with its extra docs."
        ) from None
    written = []
    for page in PAGES:
        converter = markdown.Markdown(extensions=["tables", "fenced_code", "toc"])
        body = converter.convert(read_page(page, workflow))
        body = body.replace("<table>", '<div class="scroll"><table>').replace("</table>", "</table></div>")
        for other in PAGES:
            body = body.replace(f'href="{other.name}.md', f'href="{other.name}.html')
        path = target / f"{page.name}.html"
        write_whole(path, _document(page, body).encode())
        written.append(path)
    return written


def _document(page: Page, body: str) -> str:
    links = "\n".join(
        f'<a href="{other.name}.html"{" aria-current=page" if other is page else ""}>{escape(other.title)}</a>'
        for other in PAGES
    )
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(page.title)} · rocking</title>\n<style>{_STYLE}</style>\n</head>\n"
        f"<body>\n<nav>\n{links}\n</nav>\n<main>\n{body}\n</main>\n</body>\n</html>\n"
    )
