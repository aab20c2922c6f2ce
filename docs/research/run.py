"""Run one target of the research, as its rule asks.

Where RESEARCH_SITES is set, on at most so many sites, of as many earthquakes as can be: for a target whose whole takes
hours. `docs/measured/figures.csv` says which figures are of such a share.
"""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from docs.research.report import Target
    from docs.research.sites import NamedRecord, Records
    from rocking.catalogue import CatalogueRecord


def targets() -> "dict[str, Callable[[Target], None]]":
    """Return the function of each target that reads the accelerograms of catalogues, by the name of its rule."""
    from docs.research import (
        anchors,
        between_ties,
        code_checks,
        cracks,
        diaphragms,
        earthquakes,
        ensembles,
        floors,
        fragilities,
        fronts,
        halves,
        held_walls,
        leaves,
        measures,
        rates,
        shapes,
        stability,
        stacks,
        tie_forces,
        voussoirs,
        worth,
    )
    from docs.research.comparison import table

    return {
        "calibrate_ensemble": ensembles.calibrate_ensemble,
        "cover": fragilities.cover,
        "cover_rate": rates.cover_rate,
        "cover_earthquakes": earthquakes.cover_earthquakes,
        "pulse_shapes": shapes.pulse_shapes,
        "worth": worth.worth,
        "measure_scatter": measures.measure_scatter,
        "govern": cracks.govern,
        "stand": stacks.stand,
        "hold": held_walls.hold,
        "tie_forces": tie_forces.tie_forces,
        "between_ties": between_ties.between_ties,
        "anchors": anchors.anchors,
        "diaphragms": diaphragms.diaphragms,
        "leaves": leaves.leaves,
        "voussoirs": voussoirs.voussoirs,
        "screen": ensembles.screen,
        "stability": stability.stability,
        "floors": floors.floors,
        "fronts": fronts.fronts,
        "halves": halves.halves,
        "code_check": code_checks.code_check,
        "code_sets": code_checks.code_sets,
        "compare": table.compare,
    }


def run(name: str, catalogues: Sequence[str], config: Mapping[str, Any], folder: str) -> None:
    """Do the job of the rule `name`: write the tables and the report of a target into `folder`."""
    from docs.research import validation
    from docs.research.report import Target
    from docs.research.shake_table import Campaign
    from docs.research.sites import spread
    from rocking.assessment.scene import load_scenes
    from rocking.catalogue import load_catalogue
    from rocking.study.apart import tell as tell_line
    from rocking.study.settings import read_settings

    settings = read_settings(config)
    mirror = settings.mirror

    def tell(line: str, _done: int = 0, _total: int = 0) -> None:
        tell_line(f"{name}: {line}")

    if name == "validate":
        campaign = Campaign.open(Path(catalogues[0]), Path(mirror) if mirror else None)
        validation.validate(Target(Path(folder), tell), campaign)
        return
    motions: Sequence[Records] = [
        motions_of(load_catalogue(Path(catalogue)), mirror, tell) for catalogue in catalogues
    ]
    listed = load_scenes(Path(settings.structures))
    on_the_ground = {name: scene.structure for name, scene in listed.items() if not scene.place.supports}
    if most := os.environ.get("RESEARCH_SITES"):
        motions = spread(motions, int(most))
    targets()[name](Target(Path(folder), tell, motions, on_the_ground))


def motions_of(
    catalogue: "Sequence[CatalogueRecord]", mirror: str | None, tell: Callable[[str], None]
) -> "Iterator[NamedRecord]":
    """Yield identifier and accelerogram of every component of the records, after a line for each record."""
    from rocking.catalogue import open_station

    for count, record in enumerate(catalogue, start=1):
        tell(f"{count} of {len(catalogue)}: {record.id}")
        yield from ((record.id, accelerogram) for accelerogram in open_station(record, mirror).horizontal)
