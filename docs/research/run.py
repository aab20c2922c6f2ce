"""Run one target of the research: snakemake.* onto docs.research."""

import sys
from itertools import chain
from pathlib import Path


def main(target, catalogues, mirror, structures, folder, tell):
    """Write the tables and the report of `target` into `folder`."""
    from docs.research import cracks, ensembles, fragilities, screening, tiers, validation
    from docs.research.comparison import cases, table
    from rocking.records import load_catalogue, open_record
    from rocking.structures import load_structures

    if target == "validate":
        validation.write_validation(Path(catalogues[0]), mirror and Path(mirror), folder, tell)
        return
    listed = [load_catalogue(Path(each)) for each in catalogues]
    of_catalogue = [motions_of(each, mirror, tell) for each in listed]
    records = chain.from_iterable(of_catalogue)
    made = load_structures(Path(structures))
    if target == "calibrate":
        tiers.write_tiers(records, folder)
    elif target == "calibrate_ensemble":
        ensembles.write_ensemble_accuracy(*of_catalogue, made, folder)
    elif target == "trade_fragility":
        fragilities.write_fragilities(records, made, folder, tell)
    elif target == "cover":
        fragilities.write_coverage(records, folder, tell)
    elif target == "govern":
        cracks.write_cracks(records, folder, tell)
    elif target == "screen":
        screening.write_screening(records, made, folder, tell)
    elif target == "compare":
        first = [open_record(each, mirror=mirror)[0] for each in listed[0][: cases.RECORDS // 3]]
        table.write_comparison(first, folder, tell)


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
