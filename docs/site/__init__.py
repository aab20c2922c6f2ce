"""The documentation as a site: Markdown pages, filled from the code they describe, and set by MkDocs."""

from docs.site.build import write_site
from docs.site.pages import filled, python_blocks, written_pages

__all__ = ["filled", "python_blocks", "write_site", "written_pages"]
