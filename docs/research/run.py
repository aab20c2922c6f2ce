"""Run one target of the research: snakemake.* onto docs.research."""

import sys
from pathlib import Path


def main(target, catalogues, mirror, structures, folder, tell):
    """Write the tables and the report of `target` into `folder`."""
    from docs.research import coverage, cracks, ensembles, fragilities, screening, tiers, validation
    from docs.research.comparison import table
    from docs.research.comparison.cases import RECORDS
    from rocking.records import load_catalogue, open_record
    from rocking.structures import load_structures

    listed = [load_catalogue(Path(each)) for each in catalogues if target != "validate"]
    records = (motions_of(each, mirror, tell) for each in listed)
    if target == "calibrate":
        tiers.write_tiers((record for each in records for record in each), folder)
    elif target == "calibrate_ensemble":
        ensembles.write_ensemble_accuracy(*records, load_structures(Path(structures)), folder)
    elif target == "trade_fragility":
        motions = [record for each in records for _, record in each]
        fragilities.write_fragilities(motions, load_structures(Path(structures)), folder, tell)
    elif target == "cover":
        coverage.write_coverage((record for each in records for record in each), folder, tell)
    elif target == "govern":
        cracks.write_cracks((record for each in records for record in each), folder, tell)
    elif target == "screen":
        motions = (record for each in records for record in each)
        screening.write_screening(motions, load_structures(Path(structures)), folder, tell)
    elif target == "compare":
        motions = [open_record(each, mirror=mirror)[0] for each in listed[0][: RECORDS // 3]]
        table.write_comparison(motions, folder, tell)
    elif target == "validate":
        validation.write_validation(Path(catalogues[0]), mirror and Path(mirror), folder, tell=tell)


def motions_of(listed, mirror, tell):
    """Yield identifier and accelerogram of every component of the records, after a line for each record."""
    from rocking.records import open_record

    for count, record in enumerate(listed, start=1):
        tell(f"{count} of {len(listed)}: {record.id}")
        yield from ((record.id, accelerogram) for accelerogram in open_record(record, mirror))


if __name__ == "__main__":
    sys.path.append(str(Path(snakemake.scriptdir).parents[1]))  # docs/ lies beside rocking/
    from rocking.study.terminal import line_writer

    main(
        snakemake.rule,
        snakemake.input.catalogues,
        snakemake.params.mirror,
        snakemake.params.structures,
        Path(snakemake.output[0]).parent,
        line_writer(Path(snakemake.log[0])),
    )
