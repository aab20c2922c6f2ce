"""How far one pulse may be trusted, measured: predictions against integrations of real records, and what follows.

The thresholds of the lights and the reliability table that the package ships are made here, by a rule that is
written down, from records that are listed in a catalogue.
"""

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rocking.assessment.assess import AssessmentSettings, predict
from rocking.assessment.verdict import ratio, within_factor_two
from rocking.errors import PulseError
from rocking.motion.integration import integrate
from rocking.pulses import Light, PulseAnalysis, extract_pulses, light, pulse_method
from rocking.pulses.evidence import Thresholds
from rocking.pulses.reliability import Reliability
from rocking.records import Accelerogram
from rocking.structures import Block, Structure
from rocking.tables import Row, column, row, write_rows

SCALES = (0.5, 1.0, 2.0)
"""Factors on each record, so that a record speaks for weaker and stronger shaking of the same shape."""
FREQUENCY_RATIOS = (0.0, 3.0, 4.5, 6.5, 10.0, math.inf)
"""Edges of the classes of ω_g/p."""
GREEN = (0.90, 0.85)
AMBER = (0.70, 0.75)
"""Least share within a factor 2, and least share of overturnings found, that earn a light."""
_ENERGIES = np.round(np.arange(0.10, 0.61, 0.05), 2)
_RATIOS = (1.1, 1.2, 1.3, 1.5, 2.0)


@row(
    "comparisons",
    "One row per record, structure and scale: prediction by the dominant pulse beside the integrations",
)
class Comparison(Row):
    """One prediction beside its integrations."""

    record: str = column("Identifier of the record in the catalogue")
    site: str = column("Event and station; what counts as one independent record")
    structure: str = column("Name of the structure")
    scale_factor: float = column("Factor on the record")
    explained_energy: float = column("Share of the record's energy that the pulse explains")
    amplitude_ratio: float = column("Pulse amplitude over g times uplift multiplier")
    frequency_ratio: float = column("Circular frequency of the pulse over frequency parameter")
    predicted_rotation_ratio: float = column("Closed form on the equivalent block under the pulse")
    pulse_rotation_ratio: float = column("Mechanism under the pulse")
    integrated_rotation_ratio: float = column("Mechanism under the record")


@dataclass(frozen=True)
class Score:
    """What a set of comparisons says: counts, share within a factor 2, median ratio, overturnings found."""

    comparisons: int
    records: int
    both_rock: int
    within_factor_2: float
    median_ratio: float
    overturnings: int
    overturnings_found: int

    @property
    def found(self) -> float:
        """Share of the overturnings that the prediction finds; 1 where there are none."""
        return self.overturnings_found / self.overturnings if self.overturnings else 1.0

    def earns(self, least: tuple[float, float]) -> bool:
        """Whether both shares reach what a light asks; nothing is earned without a comparison of both kinds."""
        return self.both_rock > 0 and self.within_factor_2 >= least[0] and self.found >= least[1]


def grid_of_blocks() -> dict[str, Structure]:
    """Blocks of semi-diagonal 1–10 m and slenderness 0.08–0.25 rad: p from 0.86 to 2.7 rad/s, λ from 0.08 to 0.26."""
    sizes = itertools.product((1.0, 2.0, 5.0, 10.0), (0.08, 0.12, 0.18, 0.25))
    return {f"block R {R:g} m, alpha {alpha:g} rad": Block(R, alpha) for R, alpha in sizes}


def compare(
    record: str,
    accelerogram: Accelerogram,
    structures: Mapping[str, Structure],
    settings: AssessmentSettings | None = None,
) -> Iterator[Comparison]:
    """Yield a comparison for each structure and scale; the pulse is sought once, for it scales with the record."""
    settings = settings or AssessmentSettings()
    analysis = extract_pulses(accelerogram, settings=settings.pulse)
    site = f"{accelerogram.event}, {accelerogram.station}"
    for scale, (name, structure) in itertools.product(SCALES, structures.items()):
        mechanism, scaled = structure.mechanism(), accelerogram.scaled(scale)
        analysed: PulseAnalysis = analysis if scale == 1 else extract_pulses(scaled, settings=settings.pulse)
        prediction = predict(
            mechanism, pulse_method(settings.pulse_choice).candidates(analysed), None, settings
        )
        yield Comparison(
            record=record,
            site=site,
            structure=name,
            scale_factor=scale,
            explained_energy=analysed.explained_energy,
            amplitude_ratio=prediction.amplitude_ratio,
            frequency_ratio=prediction.frequency_ratio,
            predicted_rotation_ratio=prediction.maximum.rotation_ratio,
            pulse_rotation_ratio=integrate(mechanism, prediction.pulse, settings.tolerance).rotation_ratio,
            integrated_rotation_ratio=integrate(mechanism, scaled, settings.tolerance).rotation_ratio,
        )


def score(comparisons: Sequence[Comparison]) -> Score:
    """Count what `comparisons` say."""
    pairs = [(c.predicted_rotation_ratio, c.integrated_rotation_ratio) for c in comparisons]
    ratios = [found for pair in pairs if not math.isnan(found := ratio(*pair))]
    overturnings = [predicted for predicted, integrated in pairs if math.isinf(integrated)]
    return Score(
        comparisons=len(comparisons),
        records=len({c.site for c in comparisons}),
        both_rock=len(ratios),
        within_factor_2=sum(bool(within_factor_two(*pair)) for pair in pairs) / len(ratios)
        if ratios
        else math.nan,
        median_ratio=float(np.median(ratios)) if ratios else math.nan,
        overturnings=len(overturnings),
        overturnings_found=sum(map(math.isinf, overturnings)),
    )


def choose_thresholds(comparisons: Sequence[Comparison]) -> Thresholds:
    """Return the lowest thresholds whose lights keep their promise.

    Green: of the pairs (explained energy, amplitude ratio) that earn it whichever one site is left out, the one that
    covers most comparisons. Amber: the lowest explained energy between which and green's it is earned over all sites.
    Raises PulseError when no pair earns green.
    """
    pairs = [pair for pair in itertools.product(_ENERGIES, _RATIOS) if _earns_green(comparisons, *pair)]
    if not pairs:
        raise PulseError(
            "comparisons hold no pair of thresholds that earns green; add records or refuse the pulse."
        )
    energy, least = max(pairs, key=lambda pair: len(_covered(comparisons, pair[0], math.inf, pair[1])))
    ambers = [
        low
        for low in _ENERGIES
        if low < energy and score(_covered(comparisons, low, energy, least)).earns(AMBER)
    ]
    return Thresholds(
        green_explained_energy=float(energy),
        amber_explained_energy=float(min(ambers, default=energy)),
        amplitude_ratio=float(least),
        evidence=_evidence(comparisons),
    )


def reliability(comparisons: Sequence[Comparison], thresholds: Thresholds) -> list[Reliability]:
    """Return the reliability table: a row for each light and class of ω_g/p that holds a comparison."""
    rows = []
    for colour, (low, high) in itertools.product(Light, itertools.pairwise(FREQUENCY_RATIOS)):
        chosen = [
            c
            for c in comparisons
            if low <= c.frequency_ratio < high
            and light(c.explained_energy, c.amplitude_ratio, thresholds) is colour
            and c.integrated_rotation_ratio > 0
        ]
        if not chosen:
            continue
        found = score(chosen)
        rows.append(
            Reliability(
                light=colour,
                frequency_ratio_from=low,
                frequency_ratio_to=high,
                records=found.records,
                comparisons=found.comparisons,
                within_factor_2=found.within_factor_2,
                median_ratio=found.median_ratio,
                overturnings_found=found.overturnings_found,
                overturnings_missed=found.overturnings - found.overturnings_found,
            )
        )
    return rows


def _covered(
    comparisons: Iterable[Comparison], low: float, high: float, least: float, without: str = ""
) -> list[Comparison]:
    return [
        c
        for c in comparisons
        if low <= c.explained_energy < high and c.amplitude_ratio >= least and c.site != without
    ]


def _earns_green(comparisons: Sequence[Comparison], energy: float, least: float) -> bool:
    covered = _covered(comparisons, energy, math.inf, least)
    sites = {c.site for c in covered}
    return len(sites) > 1 and all(
        score(_covered(covered, energy, math.inf, least, site)).earns(GREEN) for site in sites
    )


def _evidence(comparisons: Sequence[Comparison]) -> str:
    found = score(comparisons)
    return (
        f"{found.comparisons} comparisons of {len({c.record for c in comparisons})} components recorded at "
        f"{found.records} sites; green keeps its promise whichever one site is left out."
    )


def write_calibration(
    records: Iterable[tuple[str, Accelerogram]], structures: Mapping[str, Structure], folder: Path
) -> Thresholds:
    """Compare every record with a grid of blocks and `structures`; write what follows into `folder`.

    records: identifier and accelerogram; of two files of one component at one site the first counts.
    Writes comparisons.csv, thresholds.csv and reliability.csv, and returns the thresholds.
    """
    everything = grid_of_blocks() | dict(structures)
    comparisons = [
        c for name, record in distinct_components(records) for c in compare(name, record, everything)
    ]
    thresholds = choose_thresholds(comparisons)
    write_rows(Comparison, comparisons, folder / Comparison.table.file_name)
    write_rows(Thresholds, [thresholds], folder / Thresholds.table.file_name)
    write_rows(Reliability, reliability(comparisons, thresholds), folder / Reliability.table.file_name)
    return thresholds


def distinct_components(records: Iterable[tuple[str, Accelerogram]]) -> Iterator[tuple[str, Accelerogram]]:
    """Yield the first record of each component of each site.

    Two opposite directions are one component: rocking of a symmetric structure does not tell them apart.
    """
    seen = set()
    for name, record in records:
        direction = record.component if record.azimuth is None else round(record.azimuth) % 180
        key = (record.event, record.station, direction)
        if key not in seen:
            seen.add(key)
            yield name, record
