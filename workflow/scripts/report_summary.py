"""Set the PDF of the whole study and draw its figure: snakemake.* onto rocking.study.summary_report."""

from pathlib import Path

from rocking.study.summary_report import draw_summary, report_summary

if __name__ == "__main__":
    folder = Path(snakemake.output.document).parent
    trade = folder if snakemake.input.trade else None
    fragility = folder.parent / "fragility"
    measured = fragility if (fragility / "fragility.csv").exists() else None
    report_summary(folder, snakemake.params.settings, trade, measured)
    draw_summary(folder / "comparison.csv", Path(snakemake.output.figure))
