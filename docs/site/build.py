"""From the pages to a site that opens without a network, set by MkDocs."""

import re
import shutil
import tempfile
from functools import partial
from pathlib import Path

import rocking
from rocking.errors import ConfigurationError

FOLDER = Path(__file__).parents[1] / "pages"
ROOT = FOLDER.parents[1]
MARKED = re.compile(r"<!-- (generated|measured|measured by|score \S+): (.*?) -->(.*?)<!-- end -->", re.S)
"""What `docs.site.pages` writes into a page, between its marks."""
CONFIGURATION = FOLDER.parent / "mkdocs.yml"
BESIDE = {"CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
"""Files of the repository that are pages of the site as well."""
TOPICS = {
    "records": ("records", "catalogue", "signal"),
    "structures": ("structures", "floors"),
    "pulses": ("pulses", "sine_pulse"),
    "motion": ("motion", "contacts"),
    "assessment": ("assessment", "codes", "fragility", "strengthening"),
    "studies": ("study", "products", "reports", "warnings", "errors"),
}
"""Page of the Python names: the parts of the package from which they come."""
_LINK = re.compile(r"\]\(\.\./\.\./([^)#]+)")


def written_pages() -> list[Path]:
    """Return the pages."""
    return sorted(FOLDER.glob("*.md"))


def public_names(topic: str) -> list[tuple[str, str]]:
    """Return the public names of a topic, each with its module."""
    modules = ((name, getattr(rocking, name).__module__) for name in rocking.__all__)
    return [(name, module) for name, module in modules if module.split(".")[1] in TOPICS[topic]]


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
        write_sources(source)
        try:
            build(load_config(str(CONFIGURATION), docs_dir=str(source), site_dir=str(target.resolve())))
        except Abort as error:
            raise ConfigurationError(f"{CONFIGURATION}: {error}; its warnings say what to mend.") from None
    return sorted(target.glob("*.html"))


def write_sources(source: Path) -> None:
    """Write into the folder `source` what MkDocs sets: the pages without their marks, and what they link."""
    for part in ("assets", "figures"):
        shutil.copytree(FOLDER / part, source / part)
    for page in written_pages():
        text = MARKED.sub(_of_site, page.read_text(encoding="utf-8"))
        (source / page.name).write_text(_LINK.sub(partial(_linked, source), text), encoding="utf-8")
    for name, page_name in BESIDE.items():
        shutil.copy(ROOT / name, source / page_name)


def _of_site(match: re.Match[str]) -> str:
    """What stands between two marks; of a list of names, what mkdocstrings describes them by."""
    topic = match[2].removeprefix("api_")
    if match[2] == topic or topic not in TOPICS:
        return match[3]
    return "\n\n".join(f"::: {module}.{name}" for name, module in public_names(topic))


def _linked(source: Path, match: re.Match[str]) -> str:
    """A link to a file of the repository: to its page, or to its copy."""
    path = ROOT / match[1]
    if match[1] not in BESIDE:
        shutil.copy(path, source / "figures" / path.name)
    return f"]({BESIDE.get(match[1], f'figures/{path.name}')}"


if __name__ == "__main__":
    print(*write_site(ROOT / "results" / "documentation"), sep="\n")
