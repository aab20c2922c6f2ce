"""Draw prediction against integration over all records: snakemake.* onto rocking.reporting."""

from pathlib import Path

from rocking.reporting import draw_summary

if __name__ == "__main__":
    draw_summary(Path(snakemake.input[0]), Path(snakemake.output[0]))
