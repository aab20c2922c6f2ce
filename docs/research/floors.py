"""On supports: what one pulse says of a floor that rings, and how often an outcome turns back as the period grows.

Each structure meets a record of every site at the same peak acceleration of the ground, there and on supports of
one mode. The integration on the support is the truth that the closed form is held against.
"""

import math
from collections.abc import Iterator

import numpy as np

from docs.research import scores, sites
from docs.research.report import Target
from rocking.earthquakes.sample import ClusterSample
from rocking.floors.support import Mode, Support
from rocking.motion.integration import integrate
from rocking.pulses import extract_pulses
from rocking.quantities import GRAVITY
from rocking.sine_pulse import predict_maximum
from rocking.structures import Block, Structure
from rocking.tables import Row, column, row

PEAK = 0.26
"""Peak acceleration of the ground, g, that every record is scaled to: a level of design."""
PERIODS = np.geomspace(0.12, 0.6, 9)
"""Of the supports, s."""
PARTICIPATION, DAMPING = 1.3, 0.05
BODIES: dict[str, Structure] = {
    "parapet": Block.of_size(breadth=0.3, height=1.2),
    "chimney": Block.of_size(breadth=0.7, height=2.5),
    "statue": Block.of_size(breadth=0.6, height=1.8),
}


@row("floors")
class FloorTrial(Row):
    """One row per record, structure and period of the support: what turns it, and what one pulse says."""

    record: str = column("Identifier of the record in the catalogue")
    site: str = column("Event and station")
    earthquake: str = column("Earthquake, as the first record of it names it")
    structure: str = column("Name of the structure")
    support_period_s: float = column("Period of the support; 0 on the ground")
    amplification: float = column("Peak acceleration on the support over that of the ground")
    integrated_rotation_ratio: float = column("Rotation ratio by integration; INF if it overturns")
    predicted_rotation_ratio: float = column(
        "Rotation ratio by the closed form under the dominant pulse there"
    )


def floors(target: Target) -> None:
    """Write what the closed form is worth on supports, and how a verdict moves with their period."""
    trials: list[FloorTrial] = []
    for component in sites.one_of_each(sites.independent(target.records)):
        trials += floor_trials(component)
    count = len({trial.site for trial in trials})
    subtitle = (
        f"{count} sites at {PEAK:g} g; supports of one mode, damping {DAMPING:g}, Γψ {PARTICIPATION:g}."
    )
    rows = [*closed_form_scores(trials), *course_scores(trials)]
    target.publish("On supports", subtitle, {scores.Score: rows, FloorTrial: trials})


def floor_trials(component: sites.SiteRecord) -> Iterator[FloorTrial]:
    """Yield the trials of one component, on the ground first."""
    record = component.accelerogram
    ground = record.scaled(PEAK * GRAVITY / record.peak_acceleration)
    for period in (0.0, *PERIODS.tolist()):
        if 0 < period < 2 * ground.time_step:
            continue
        floor = Support((Mode(period=period, damping_ratio=DAMPING, participation=PARTICIPATION),)).motion(
            ground
        )
        dominant = extract_pulses(floor).dominant
        for structure, body in BODIES.items():
            block = body.mechanism().equivalent_block()
            yield FloorTrial(
                **component.named,
                structure=structure,
                support_period_s=period,
                amplification=floor.peak_acceleration / ground.peak_acceleration,
                integrated_rotation_ratio=integrate(body, floor).rotation_ratio,
                predicted_rotation_ratio=predict_maximum(block, dominant).rotation_ratio,
            )


def closed_form_scores(trials: list[FloorTrial]) -> Iterator[scores.Score]:
    """Yield how the closed form stands to the integration, on the ground and on supports."""
    for part, own in (
        ("on the ground", [trial for trial in trials if trial.support_period_s == 0]),
        ("on supports", [trial for trial in trials if trial.support_period_s > 0]),
    ):
        truth = np.array([row.integrated_rotation_ratio for row in own])
        said = np.array([row.predicted_rotation_ratio for row in own])
        falls = np.isinf(truth)
        rocks = (truth > 1e-3) & ~falls & (said > 0) & ~np.isinf(said)
        quotient = np.divide(said, truth, out=np.full(truth.shape, np.nan), where=rocks)
        measures: dict[str, scores.Measured] = {
            "share that overturns": falls.astype(float),
            "closed form overturns too, where it overturns": np.where(falls, np.isinf(said), np.nan),
            "closed form overturns, where it stands": np.where(falls, np.nan, np.isinf(said)),
            "closed form over integration, median": _median(quotient),
        }
        yield from scores.scored("closed form", part, measures, _sample_of(own))


def _median(values: np.ndarray) -> scores.Measure:
    def measure(rows: np.ndarray) -> float:
        chosen = values[rows]
        chosen = chosen[np.isfinite(chosen)]
        return float(np.median(chosen)) if chosen.size else math.nan

    return measure


def _sample_of(trials: list[FloorTrial]) -> ClusterSample:
    return ClusterSample.named((trial.site, trial.earthquake) for trial in trials)


def course_scores(trials: list[FloorTrial]) -> Iterator[scores.Score]:
    """Yield for each structure the share that overturns by period, and how often outcomes turn back over periods."""
    for structure in dict.fromkeys(trial.structure for trial in trials):
        own = [trial for trial in trials if trial.structure == structure]
        for period in sorted({trial.support_period_s for trial in own}):
            there = [trial for trial in own if trial.support_period_s == period]
            measures = {
                "share that overturns": [
                    float(math.isinf(trial.integrated_rotation_ratio)) for trial in there
                ]
            }
            part = f"T_b {period:.3g} s" if period else "on the ground"
            yield from scores.scored(structure, part, measures, _sample_of(there))
        courses: dict[tuple[str, str], list[tuple[float, bool]]] = {}
        for trial in own:
            fell = math.isinf(trial.integrated_rotation_ratio)
            courses.setdefault((trial.site, trial.earthquake), []).append((trial.support_period_s, fell))
        back = [
            float((np.diff(np.array([fell for _, fell in sorted(course)], dtype=int)) < 0).any())
            for course in courses.values()
        ]
        measures = {"outcome turns back as the period grows": back}
        yield from scores.scored(structure, "over the periods", measures, ClusterSample.named(courses))
