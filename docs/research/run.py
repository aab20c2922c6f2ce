"""Run one target of the research: snakemake.* onto docs.research."""

import sys
from pathlib import Path


def main(target, catalogues, mirror, structures, folder, tell):
    """Write the tables and the report of `target` into `folder`."""
    from rocking.records import load_catalogue, open_record, open_records
    from rocking.structures import load_structures

    def records():
        return [open_records(load_catalogue(Path(each)), mirror, tell) for each in catalogues]

    if target == "calibrate":
        from docs.research.tiers import write_tiers

        write_tiers((record for each in records() for record in each), folder)
    elif target == "calibrate_ensemble":
        from docs.research.ensembles import write_ensemble_accuracy

        write_ensemble_accuracy(*records(), load_structures(Path(structures)), folder)
    elif target == "trade_fragility":
        from docs.research.fragilities import write_fragilities

        motions = [record for each in records() for _, record in each]
        write_fragilities(motions, load_structures(Path(structures)), folder, tell)
    elif target == "validate":
        from docs.research.validation import write_validation

        write_validation(Path(catalogues[0]), Path(mirror) if mirror else None, folder, tell=tell)
    elif target == "compare":
        from docs.research.comparison.cases import RECORDS
        from docs.research.comparison.table import write_comparison

        listed = load_catalogue(Path(catalogues[0]))[: RECORDS // 3]
        write_comparison([open_record(record, mirror=mirror)[0] for record in listed], folder, tell)


if __name__ == "__main__":
    sys.path.append(str(Path(snakemake.scriptdir).parents[1]))  # docs/ lies beside rocking/
    from rocking.study.progress import line_writer

    main(
        snakemake.rule,
        snakemake.input.catalogues,
        snakemake.params.mirror,
        snakemake.params.structures,
        Path(snakemake.output[0]).parent,
        line_writer(Path(snakemake.log[0])),
    )
