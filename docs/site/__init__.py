"""Documentation: Markdown pages, filled from the code they describe, and the site they make.

A line `<!-- generated: NAME -->` in a page is replaced by what the function NAME of `generated` returns.
"""

from docs.site.pages import PAGES, Page, python_blocks, read_page
from docs.site.site import write_site

__all__ = ["PAGES", "Page", "python_blocks", "read_page", "write_site"]
