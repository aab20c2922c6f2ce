"""Set the documentation: snakemake.* onto docs.site."""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path.append(str(Path(snakemake.scriptdir).parents[1]))  # docs/ lies beside workflow/
    from docs.site.pages import write_site

    written = write_site(Path(snakemake.output[0]))
    Path(snakemake.log[0]).write_text("\n".join(map(str, written)) + "\n", encoding="utf-8")
