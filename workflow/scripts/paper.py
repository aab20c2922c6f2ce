"""Redraw the figures of the paper: snakemake.* onto rocking.study.paper."""

from pathlib import Path

from rocking.study.paper import write_paper

if __name__ == "__main__":
    files, mirror = snakemake.input, snakemake.config["mirror"]
    message = write_paper(Path(files.catalogue), mirror, Path(snakemake.output[0]))
    Path(snakemake.log[0]).write_text(f"{message}\n", encoding="utf-8")
