"""What the tiers are calibrated on: real records by structures by factors, each with what every tier knows of it."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from rocking.assessment import intensity
from rocking.assessment.ensemble import CAUSES, EnsembleSettings, GroundMotions, drawn
from rocking.assessment.ensemble.design import lattice
from rocking.assessment.fidelity import stays_at_rest
from rocking.assessment.intensity import NUDGES, Shape
from rocking.errors import PulseError
from rocking.motion.batch import integrate_batch
from rocking.pulses import Pulse, extract_pulses
from rocking.records import Accelerogram
from rocking.structures import Arch, Block, Mechanism, Structure, Wall

FACTORS = (0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8)
"""On each record, so that it speaks for weaker and stronger shaking of the same shape."""
MOST_COMPONENTS = 2
"""Of a site that count."""
MEMBERS = 64
"""Of the ensemble of a case."""


@dataclass(frozen=True, eq=False)
class TierCase:
    """A structure under a record times a factor: what is known of it by measure, and what becomes of it.

    rotation_ratios: of the mechanism, (m,), in the members of the case's ensemble.
    """

    record: str
    site: str
    structure: str
    factor: float
    measures: Mapping[str, float]
    rotation_ratios: np.ndarray


def structures_tried() -> dict[str, Structure]:
    """Blocks, walls and arches of p from 0.8 to 2.7 rad/s, from no defect to a forcing that grows by 30 %."""
    blocks = [(1.0, 0.2), (2.0, 0.12), (2.0, 0.4), (5.0, 0.15), (10.0, 0.1)]
    walls = [(1.5, 1.5, 0.4), (2.0, 1.0, 0.3)]
    arches = [(157.5, 0.15), (140.0, 0.15), (150.0, 0.10), (120.0, 0.15)]
    made: dict[str, Structure] = {f"block R {r:g} m, {a:g} rad": Block(r, a) for r, a in blocks}
    made |= {f"wall {h:g} + {k:g} m, {t:g} m": Wall(h, k, t) for h, k, t in walls}
    for degrees, share in arches:
        made[f"arch {degrees:g}°, t/r {share:g}"] = Arch(10.0, 10.0 * share, np.radians(degrees))
    made["one-sided block"] = Block.of_size(0.6, 6.0, one_sided=True, restitution=0.5)
    return made


def independent(records: Iterable[tuple[str, Accelerogram]]) -> Iterator[tuple[str, str, Accelerogram]]:
    """Yield identifier, site and record of the components that count, none under two names.

    A site is an event and a station. Events are alike in the first four letters, stations where the words of one begin
    with all those of the other: catalogues differ in how much they add. What comes first names the site; a file of
    another catalogue for the same site, or of a direction that is there already, does not count.
    """
    sites: list[tuple[str, list[str], str, set]] = []
    for name, record in records:
        named = f"{record.event}, {record.station}"
        event, words = _letters(record.event)[:4], re.findall(r"[a-z0-9]+", record.station.lower())
        place = next(
            (k for k, site in enumerate(sites) if site[0] == event and _begins(site[1], words)), None
        )
        if place is None:
            place = len(sites)
            sites.append((event, words, named, set()))
        _, _, site_name, directions = sites[place]
        direction = name if not (record.component or record.azimuth is not None) else _direction(record)
        if named == site_name and direction not in directions and len(directions) < MOST_COMPONENTS:
            directions.add(direction)
            yield name, site_name, record


def tier_cases(
    records: Iterable[tuple[str, str, Accelerogram]], structures: Mapping[str, Structure] | None = None
) -> Iterator[TierCase]:
    """Yield the cases of each record, as `independent` gives them, but those that rest as given, which is certain."""
    mechanisms = {name: s.mechanism() for name, s in (structures or structures_tried()).items()}
    blocks = [mechanism.equivalent_block("rest") for mechanism in mechanisms.values()]
    nudged = np.outer(FACTORS, NUDGES)
    for name, site, record in records:
        shape = Shape.of(record)
        pulse = dominant_pulse(record)
        if pulse is None:
            continue
        on_block = integrate_batch(blocks, record, nudged.ravel()).reshape(len(blocks), *nudged.shape)
        for k, (structure, mechanism) in enumerate(mechanisms.items()):
            known = _known(shape, pulse, mechanism)
            for i, factor in enumerate(FACTORS):
                motion = record.scaled(factor)
                if stays_at_rest(mechanism, motion):
                    continue
                members = drawn(
                    mechanism, GroundMotions.of(motion), lattice(MEMBERS, CAUSES), EnsembleSettings()
                )
                if not members.failed:
                    measures = intensity.scaled(known, factor) | intensity.from_nudged(on_block[k, i])
                    yield TierCase(name, site, structure, factor, measures, members.rotation_ratios)


def _known(shape: Shape, pulse: Pulse, mechanism: Mechanism) -> dict[str, float]:
    block = mechanism.equivalent_block("rest")
    return (
        intensity.of_structure(mechanism)
        | intensity.of_peaks(shape, block)
        | intensity.of_pulse(pulse, block)
        | intensity.of_sines(shape, block)
        | intensity.of_pushes(shape, block)
    )


def dominant_pulse(record: Accelerogram) -> Pulse | None:
    """Return the dominant sine of a record; None where it has none."""
    try:
        return extract_pulses(record).dominant
    except PulseError:
        return None


def _letters(text: str) -> str:
    return "".join(re.findall(r"[a-z]+", text.lower()))


def _begins(one: list[str], other: list[str]) -> bool:
    few = min(len(one), len(other))
    return few > 0 and one[:few] == other[:few]


def _direction(record: Accelerogram) -> object:
    return record.component if record.azimuth is None else round(record.azimuth) % 180
