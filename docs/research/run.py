"""Run one target of the research: snakemake.* onto docs.research."""

import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from snakemake.iocontainers import Snakemake

    from docs.research.report import Target
    from docs.research.sites import NamedRecord
    from rocking.records import CatalogueRecord

    snakemake: Snakemake
    """What snakemake puts into the namespace of a script."""


def targets() -> "dict[str, Callable[[Target], None]]":
    """Return the function of each target that reads the accelerograms of catalogues, by the name of its rule."""
    from docs.research import (
        code_checks,
        cracks,
        earthquakes,
        ensembles,
        floors,
        fragilities,
        fronts,
        halves,
        held_walls,
        measures,
        rates,
        shapes,
        stability,
        stacks,
        tiers,
    )
    from docs.research.comparison import table

    return {
        "calibrate": tiers.calibrate,
        "calibrate_ensemble": ensembles.calibrate_ensemble,
        "trade_fragility": fragilities.trade_fragility,
        "cover": fragilities.cover,
        "cover_rate": rates.cover_rate,
        "cover_earthquakes": earthquakes.cover_earthquakes,
        "pulse_shapes": shapes.pulse_shapes,
        "measure_scatter": measures.measure_scatter,
        "govern": cracks.govern,
        "stand": stacks.stand,
        "hold": held_walls.hold,
        "screen": ensembles.screen,
        "stability": stability.stability,
        "floors": floors.floors,
        "fronts": fronts.fronts,
        "halves": halves.halves,
        "code_check": code_checks.code_check,
        "code_sets": code_checks.code_sets,
        "compare": table.compare,
    }


def main(
    name: str,
    catalogues: Sequence[str],
    mirror: str | None,
    structures: str,
    folder: Path,
    tell: Callable[[str], None],
) -> None:
    """Run the target of the rule `name`, and write its tables and its report into `folder`."""
    from docs.research import validation
    from docs.research.report import Target
    from docs.research.shake_table import Campaign
    from rocking.assessment.scene import load_scenes
    from rocking.records import load_catalogue

    if name == "validate":
        campaign = Campaign.open(Path(catalogues[0]), Path(mirror) if mirror else None)
        validation.validate(Target(folder, tell), campaign)
        return
    motions = [motions_of(load_catalogue(Path(each)), mirror, tell) for each in catalogues]
    listed = load_scenes(Path(structures))
    on_the_ground = {name: each.structure for name, each in listed.items() if not each.place.supports}
    targets()[name](Target(folder, tell, motions, on_the_ground))


def motions_of(
    catalogue: "Sequence[CatalogueRecord]", mirror: str | None, tell: Callable[[str], None]
) -> "Iterator[NamedRecord]":
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
        line_writer(Path(snakemake.log[0]), snakemake.rule),
    )
