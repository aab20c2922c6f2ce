"""Run one target of the research: snakemake.* onto docs.research."""

import sys
from pathlib import Path


def main(name, catalogues, mirror, structures, folder, tell):
    """Run the target `name`, which is a function of that name, and write its tables and its report into `folder`."""
    from docs.research import (
        code_checks,
        cracks,
        ensembles,
        floors,
        fragilities,
        fronts,
        rates,
        stacks,
        tiers,
        validation,
    )
    from docs.research.comparison import table
    from docs.research.report import Target
    from docs.research.shake_table import Campaign
    from rocking.records import load_catalogue
    from rocking.structures import load_structures

    if name == "validate":
        campaign = Campaign.open(Path(catalogues[0]), mirror and Path(mirror))
        validation.validate(Target(folder, tell), campaign)
        return
    modules = (tiers, ensembles, fragilities, rates, cracks, code_checks, stacks, floors, fronts, table)
    run = next(getattr(each, name) for each in modules if hasattr(each, name))
    motions = [motions_of(load_catalogue(Path(each)), mirror, tell) for each in catalogues]
    listed = load_structures(Path(structures))
    on_the_ground = {name: each for name, each in listed.items() if each.standing is None}
    run(Target(folder, tell, motions, on_the_ground))


def motions_of(catalogue, mirror, tell):
    """Yield identifier and accelerogram of every component of the records, after a line for each record."""
    from rocking.records import open_record

    for count, record in enumerate(catalogue, start=1):
        tell(f"{count} of {len(catalogue)}: {record.id}")
        yield from ((record.id, accelerogram) for accelerogram in open_record(record, mirror))


if __name__ == "__main__":
    sys.path.append(str(Path(snakemake.scriptdir).parents[1]))  # docs/ lies beside rocking/
    from rocking.study.settings import read_settings
    from rocking.study.terminal import line_writer

    settings = read_settings(snakemake.config)
    main(
        snakemake.rule,
        snakemake.input.catalogues,
        settings.mirror,
        settings.structures,
        Path(snakemake.output[0]).parent,
        line_writer(Path(snakemake.log[0])),
    )
