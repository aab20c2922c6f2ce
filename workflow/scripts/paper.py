"""Redraw the figures of the paper: snakemake.* onto docs.paper."""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path.append(str(Path(snakemake.scriptdir).parents[1]))  # docs/ lies beside workflow/
    from docs.paper.write import write_paper

    files, mirror = snakemake.input, snakemake.params.mirror
    message = write_paper(Path(files.catalogue), mirror, Path(snakemake.output[0]))
    Path(snakemake.log[0]).write_text(f"{message}\n", encoding="utf-8")
