"""Set the PDF of the whole study: snakemake.* onto rocking.reporting."""

from pathlib import Path

from rocking.reporting import report_summary

if __name__ == "__main__":
    report_summary(Path(snakemake.config["results"]) / "summary", snakemake.config)
