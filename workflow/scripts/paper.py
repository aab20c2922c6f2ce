"""Redraw the figures of the paper: snakemake.* onto docs.paper."""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path.append(str(Path(snakemake.scriptdir).parents[1]))  # docs/ lies beside workflow/
    from docs.paper.write import write_paper
    from rocking.study.settings import read_settings

    files, mirror = snakemake.input, read_settings(snakemake.config).mirror
    message = write_paper(Path(files.catalogue), mirror, Path(snakemake.output[0]))
    Path(snakemake.log[0]).write_text(f"{message}\n", encoding="utf-8")
