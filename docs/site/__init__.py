"""The documentation as a site: Markdown pages, filled from the code they describe, and set by MkDocs."""
