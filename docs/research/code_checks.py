"""The formulas of the Italian code beside the dynamics: cantilevers and walls under records of the design level.

No number is fitted: each record has the factor that brings its spectrum nearest to the target, and a wall is called
unsafe where it overturns under more than a tenth of the records, without any factor of confidence.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from docs.research.report import Target
from docs.research.scores import Measure, Score, scored
from docs.research.sites import independent
from rocking import (
    Accelerogram,
    Block,
    DesignSpectrum,
    Wall,
    check,
    integrate_batch,
    response_spectrum,
    select,
)
from rocking.codes.check import LEAST_OTHERS, LEAST_SHARE, CodeTerms
from rocking.codes.selection import SETS, Selection
from rocking.codes.static_check import kinematic_check
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import ConfigurationError, RockingError
from rocking.quantities import GRAVITY
from rocking.structures import Structure
from rocking.tables import Row, column, row

SPECTRUM = DesignSpectrum.ntc(0.25 * GRAVITY, 2.45, 0.35, "B")
PERIODS = np.geomspace(0.15, 2.0, 30)
HEIGHTS = {"cantilever": np.geomspace(1.5, 12.0, 11), "wall": np.geomspace(2.5, 9.0, 11)}
SLENDERNESSES = {"cantilever": np.geomspace(2.5, 12.0, 13), "wall": np.geomspace(6.0, 24.0, 13)}
"""Height over thickness."""
OFTEN = 0.1
"""Share of the records from which on a wall that overturns is called unsafe."""
CONFIDENCE = (1.35, 1.0)


@row("walls")
class WallRow(Row):
    """One row per wall: what the formulas say of it, and under how many records it overturns."""

    kind: str = column(
        "cantilever, or wall between floors, hinged where statics puts the hinge or at mid-height"
    )
    height_m: float = column("Height")
    thickness_m: float = column("Thickness")
    linear_ratio: float = column("Ratio of the linear check, FC 1.35, q 2")
    nonlinear_ratio: float = column("Ratio of the nonlinear check, FC 1.35")
    damage_level_m_s2: float = column("a_g at which it starts, FC 1")
    records: int = column("Number of records")
    overturning: int = column("Number of these under which it overturns")


def made_walls() -> dict[tuple[str, float, float], Structure]:
    """Return the cantilevers, and the walls hinged where statics puts the hinge and at mid-height."""
    made: dict[tuple[str, float, float], Structure] = {}
    for kind, heights in HEIGHTS.items():
        for height in map(float, heights):
            for slenderness in SLENDERNESSES[kind]:
                thickness = float(height / slenderness)
                if kind == "cantilever":
                    made[kind, height, thickness] = Block.of_size(thickness, height)
                    continue
                made["wall, hinge of statics", height, thickness] = Wall.of_size(height, thickness)
                half = height / 2
                made["wall, hinge at mid-height", height, thickness] = Wall(
                    half, half, thickness, crack="known"
                )
    return made


def at_design_level(record: Accelerogram) -> Accelerogram:
    """Return the record with the factor that brings the logarithms of its spectrum nearest to the target."""
    own = response_spectrum(record, PERIODS).pseudo_acceleration
    return record.scaled(float(np.exp(np.log(SPECTRUM.acceleration(PERIODS) / own).mean())))


def code_check(target: Target) -> None:
    """Hold the linear and the nonlinear check beside what overturns under records of the design level."""
    walls = made_walls()
    bodies = list(walls.values())
    falls: list[np.ndarray] = []
    sites: list[tuple[str, str]] = []
    for component in independent(target.records):
        ratios = integrate_batch(bodies, at_design_level(component.accelerogram))
        falls.append(np.isinf(ratios[:, 0]))
        sites.append((component.site, component.earthquake))
        target.tell(f"{component.identifier}: {int(falls[-1].sum())} of {len(bodies)} overturn")
    fallen = np.array(falls)  # (records, walls)
    checks = {
        factor: [kinematic_check(body, SPECTRUM, CodeTerms(confidence_factor=factor)) for body in bodies]
        for factor in CONFIDENCE
    }
    ratios_of = {
        (formula, factor): np.array([getattr(row, formula).ratio for row in of_factor])
        for factor, of_factor in checks.items()
        for formula in ("linear", "nonlinear")
    }
    onset = np.array([check.damage_level for check in checks[1.0]])
    rows = [
        WallRow(
            kind=kind,
            height_m=height,
            thickness_m=thickness,
            linear_ratio=float(ratios_of["linear", 1.35][place]),
            nonlinear_ratio=float(ratios_of["nonlinear", 1.35][place]),
            damage_level_m_s2=float(onset[place]),
            records=len(fallen),
            overturning=int(fallen[:, place].sum()),
        )
        for place, (kind, height, thickness) in enumerate(walls)
    ]
    kinds = np.array([row.kind for row in rows])
    scores = list(_scores(fallen, kinds, ratios_of, ClusterSample.named(sites)))
    subtitle = (
        f"{len(bodies)} walls under {len(fallen)} components of {len(set(sites))} sites, {SPECTRUM.words}."
    )
    target.publish("Code and dynamics", subtitle, {WallRow: rows, Score: scores})


@row("sets")
class SetTrial(Row):
    """One row per wall and pool of stations: what its sets say, and those of the stations that were left out."""

    wall: str = column("Cantilever, by height and thickness")
    split: int = column("Number of the split of the stations into two halves; each half is a pool once")
    pool: str = column("first or second half")
    stations: int = column("Stations of the pool")
    earthquakes: int = column("Earthquakes of these stations")
    share: float = column("Share of the sets of this pool that meet the dynamic check")
    share_low: float = column("Lower end of its 90 % interval")
    share_high: float = column("Upper end of that interval")
    other_share: float = column("Share of the sets of the other half that meet it")

    @property
    def covered(self) -> bool:
        """Whether the interval holds what the stations left out say, but for the coarseness of a share of 200."""
        return self.share_low - _ONE_SET <= self.other_share <= self.share_high + _ONE_SET

    @property
    def sets_disagree(self) -> bool:
        """Whether the sets of either half disagree among themselves, so that there is a share to cover."""
        return 0 < self.share < 1 or 0 < self.other_share < 1 or self.share != self.other_share


_ONE_SET = 1 / SETS
SET_STATIONS = 10
SPLITS = 8
"""Partings of the earthquakes into two pools: more would be the same stations anew."""
SET_WALLS = {
    f"{height:g} × {height / slenderness:.3g} m": Block.of_size(height / slenderness, height)
    for height in (3.0, 6.0, 9.0)
    for slenderness in (3.0, 4.0, 5.0, 6.0)
}
"""Cantilevers from such as all sets pass to such as none does."""


def code_sets(target: Target) -> None:
    """Hold the share of sets that meet the dynamic check beside that of a pool of other earthquakes."""
    pairs: dict[str, list[Accelerogram]] = {}
    of_event: dict[str, list[str]] = {}
    for component in independent(target.records):
        if component.site not in pairs:
            of_event.setdefault(component.earthquake, []).append(component.site)
        pairs.setdefault(component.site, []).append(component.accelerogram)
    sites = sorted(pairs)
    rng = np.random.default_rng(40)
    trials: list[SetTrial] = []
    for split in range(SPLITS):
        halves: list[list[str]] = [[], []]
        for event in rng.permutation(sorted(of_event)).tolist():
            min(halves, key=len).extend(of_event[event])
        pools = [{site: pairs[site] for site in half} for half in halves]
        try:
            selections = [select(pool, SPECTRUM, SET_STATIONS, seed=split) for pool in pools]
        except RockingError as error:
            target.tell(f"split {split}: {error}")
            continue
        trials += _trials(selections, split)
        target.tell(f"split {split}: {sum(trial.covered for trial in trials)} of {len(trials)} covered")
    if not trials:
        raise ConfigurationError(
            f"no half of {len(sites)} sites gave sets of {SET_STATIONS} stations at the design level; give more "
            "records.",
            sites=len(sites),
        )
    scores = list(_set_scores(trials))
    subtitle = (
        f"{len(SET_WALLS)} cantilevers, sets of {SET_STATIONS} of half of {len(sites)} sites, "
        f"{len({trial.split for trial in trials})} splits by earthquake, {SPECTRUM.words}; intervals by wall."
    )
    target.publish("What another set would have said", subtitle, {SetTrial: trials, Score: scores})


def _set_scores(trials: Sequence[SetTrial]) -> Iterator[Score]:
    """How often the interval holds what the other half says, and how often both call a wall met; by wall."""
    parts = {
        "all": list(trials),
        "sets disagree": [trial for trial in trials if trial.sets_disagree],
        "met by all that a pool's own sets say": [trial for trial in trials if trial.share >= LEAST_SHARE],
    }
    for part, own in parts.items():
        measures = {
            "covered": [float(row.covered) for row in own],
            "fewer meet it than the lower end": [
                float(row.other_share < row.share_low - _ONE_SET) for row in own
            ],
            "width of the interval": [row.share_high - row.share_low for row in own],
            "the other half calls it met": [float(row.other_share >= LEAST_SHARE) for row in own],
            "the lower end reaches what is asked": [float(row.share_low >= LEAST_OTHERS) for row in own],
        }
        if own:
            yield from scored("share of sets that pass", part, measures, [row.wall for row in own])


def _trials(selections: Sequence[Selection], split: int) -> Iterator[SetTrial]:
    """What the sets of two halves say of each wall, one beside the other."""
    for name, wall in SET_WALLS.items():
        checks = [check(wall, SPECTRUM, records=selection).dynamic for selection in selections]
        for place, which in enumerate(("first", "second")):
            own, other = checks[place], checks[1 - place]
            assert own is not None
            assert other is not None
            low, high = own.interval
            yield SetTrial(
                wall=name,
                split=split,
                pool=which,
                stations=selections[place].sample.count,
                earthquakes=selections[place].sample.earthquakes,
                share=own.share,
                share_low=low,
                share_high=high,
                other_share=other.share,
            )


def _scores(
    fallen: np.ndarray,
    kinds: np.ndarray,
    ratios_of: Mapping[tuple[str, float], np.ndarray],
    sample: ClusterSample,
) -> Iterator[Score]:
    parts = {
        "cantilevers": kinds == "cantilever",
        "walls hinged where statics puts it": kinds == "wall, hinge of statics",
        "walls hinged at mid-height": kinds == "wall, hinge at mid-height",
    }
    parts["all, by the mechanism that governs"] = ~parts["walls hinged at mid-height"]
    for (formula, factor), ratios in ratios_of.items():
        for part, own in parts.items():
            passed = own & (ratios >= 1)
            failed = own & (ratios < 1)
            measures: dict[str, Measure] = {
                f"unsafe of the {passed.sum()} that pass": _share(fallen[:, passed], lambda p: p > OFTEN),
                f"never falls of the {failed.sum()} that fail": _share(fallen[:, failed], lambda p: p == 0),
            }
            yield from scored(f"{formula}, FC {factor:g}", part, measures, sample)


def _share(fallen: np.ndarray, says: Callable[[np.ndarray], np.ndarray]) -> Measure:
    """The share of walls of which `says` holds, by the share of the records under which each overturns."""

    def measure(rows: np.ndarray) -> float:
        if not fallen.shape[1]:
            return float("nan")
        return float(np.mean(says(fallen[rows].mean(axis=0))))

    return measure
