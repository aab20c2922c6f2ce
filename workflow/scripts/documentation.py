"""Set the documentation: snakemake.* onto rocking.documentation."""

from pathlib import Path

from rocking.documentation import write_site

if __name__ == "__main__":
    workflow_folder = Path(snakemake.input.settings).parent
    written = write_site(Path(snakemake.output[0]).parent, workflow_folder)
    Path(snakemake.log[0]).write_text("\n".join(map(str, written)) + "\n", encoding="utf-8")
