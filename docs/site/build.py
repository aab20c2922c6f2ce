"""From the pages to a site that opens without a network: filled and illustrated, then set by MkDocs."""

import shutil
import tempfile
from pathlib import Path

from docs.paper.report import equivalence_figures
from docs.site.drawings import drawings
from docs.site.pages import FOLDER, filled, illustrated, outlined, written_pages
from rocking.errors import ConfigurationError

CONFIGURATION = FOLDER.parent / "mkdocs.yml"


def write_site(target: Path, workflow: Path) -> list[Path]:
    """Write the site into the folder `target` and return its pages.

    workflow: the folder with the schemas. Raises ConfigurationError when a package of the extra docs is missing, or
    when MkDocs finds a defect, such as a link that leads nowhere.
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
        write_pages(source, workflow)
        try:
            build(load_config(str(CONFIGURATION), docs_dir=str(source), site_dir=str(target.resolve())))
        except Abort as error:
            raise ConfigurationError(f"{CONFIGURATION}: {error}; its warnings say what to mend.") from None
    return sorted(target.glob("*.html"))


def write_pages(target: Path, workflow: Path) -> None:
    """Write the pages, complete, with their figures and assets, into the folder `target`."""
    shutil.copytree(FOLDER / "assets", target / "assets")
    (target / "figures").mkdir()
    figures = {f"{name}.svg": outlined(figure) for name, figure in drawings().items()}
    for page in written_pages():
        text, made = illustrated(page.read_text(encoding="utf-8"), page.name)
        (target / page.name).write_text(filled(text, page.name, workflow), encoding="utf-8")
        figures |= made
    figures |= {f"paper_{each.name}.svg": outlined(each.figure) for each in equivalence_figures()}
    for name, content in figures.items():
        (target / "figures" / name).write_text(content, encoding="utf-8")
