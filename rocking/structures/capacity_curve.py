"""A capacity curve from another program as a structure: the load multiplier that it bears against its displacement."""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import Annotated, ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY, shown
from rocking.structures.capacity import StaticCapacity, StaticCurve
from rocking.structures.description import Description
from rocking.structures.drawing import rectangle
from rocking.structures.fields import OneSided, RestitutionNumber, Value, stated
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import Parts, Turning
from rocking.structures.mechanism import Side
from rocking.structures.structure import Structure
from rocking.tables.files import read_whole
from rocking.warnings import RockingWarning

_LARGEST = 1_000_000
"""Bytes of a file; a curve of a hundred points takes about two thousand."""
_DISPLACEMENTS = {"displacement_m": 1.0, "displacement_cm": 0.01, "displacement_mm": 0.001}
"""The heads of a column of displacements, and their unit in m."""
_FORCES = {"multiplier", "acceleration_g", "acceleration_m_s2", "force_kN"}
"""The heads of a column of what is borne there."""

MassRatio = Annotated[
    float,
    Value(
        "Participating over whole mass, e*, where the file holds accelerations of the equivalent system",
        0.85,
        usual=(0.3, 1),
        phrase="e* {value}",
        bounds={"gt": 0, "le": 1},
    ),
]
Weight = Annotated[float, Value("Weight of all that moves", 100.0, "kN", (0.1, 1e6), bounds={"gt": 0})]


@stated
@dataclass(frozen=True, repr=False)
class CapacityCurve(Structure):
    """A structure of which another program gives the curve alone: it is followed from point to point along lines.

    By virtual work Σ m δ² q'' = −(α (g + ü_v) + ü_g) Σ m δ, so that d* = q Σ m δ²/Σ m δ has d*'' = −α(d*) (g
    + ü_v) − ü_g, as long as the virtual displacements δ stay those at rest.

    Its rotation is d*/h with h = d*_u/α_0, at which the slender rigid body is drawn that has the same λ and
    the same displacement capacity d*_u. Beyond d*_u the curve goes on with the slope that it ends with.

    Raises
    ------
    StructureError
        For a curve that is not sorted, begins elsewhere or never comes down to 0.

    Examples
    --------
    >>> curve = rocking.CapacityCurve((0.0, 0.05, 0.4), (0.2, 0.15, 0.0), weight=50e3, restitution=0.9)
    >>> curve.mechanism()
    Mechanism(λ = 0.2, φ_cr = 0.2 rad, p = 2.05 rad/s, η = 0.9)
    """

    type_name: ClassVar[str] = "capacity_curve"
    _usual_restitution: ClassVar[float | str] = math.nan
    _contacts_unknown: ClassVar[str] = "a capacity curve has no contacts that are known"
    _described_as: ClassVar[dict[str, str]] = {
        "": "Capacity curve of another program, point by point",
        "read": "Capacity curve of another program, in a CSV file",
    }

    displacements: Annotated[
        tuple[float, ...], Value("Displacements d* of the curve, from 0 on", [0.0, 0.05, 0.4], "m", (0, 5))
    ]
    multipliers: Annotated[
        tuple[float, ...],
        Value("Load multipliers borne there, down to 0", [0.2, 0.15, 0.0], bounds={"ge": -100, "le": 100}),
    ]
    weight: Weight
    restitution: RestitutionNumber
    one_sided: OneSided = False

    def __post_init__(self) -> None:
        super().__post_init__()
        displacements = self.displacements
        multipliers = self.multipliers
        if len(displacements) != len(multipliers) or len(displacements) < 2:
            raise StructureError(
                f"the curve has {len(displacements)} displacements and {len(multipliers)} multipliers, but must have "
                "as many of both, and two at least.",
                displacements=displacements,
            )
        if displacements[0] != 0:
            raise StructureError(
                f"the curve begins at a displacement of {displacements[0]!r} m, but must begin at 0.",
                displacements=displacements[0],
            )
        for before, after in pairwise(displacements):
            if after <= before:
                raise StructureError(
                    f"the curve has a displacement of {after!r} m after {before!r} m, but they must ascend; sort the "
                    "points, and leave one of two at the same displacement out.",
                    displacements=after,
                )
        if not multipliers[0] > 0:
            raise StructureError(
                f"the curve begins with a multiplier of {multipliers[0]!r}, but must begin above 0, with the one at "
                "which the mechanism opens; leave its elastic branch out.",
                multipliers=multipliers[0],
            )
        if min(multipliers) > 0:
            raise StructureError(
                f"the curve ends with a multiplier of {multipliers[-1]!r} at {displacements[-1]!r} m and never reaches "
                "0, but must, for that is where it overturns; give its points up to there.",
                multipliers=multipliers[-1],
            )
        if not self._reach > 0:
            raise StructureError(
                f"the curve begins with a multiplier of {multipliers[0]!r} and comes down to 0 at once, but must bear "
                "something up to a displacement above 0; give it as it is there.",
                multipliers=multipliers[0],
            )

    @classmethod
    def read(
        cls,
        file: Annotated[str, Value("CSV file of the curve, in the folder of the study", "curve.csv")],
        *,
        weight: Weight,
        restitution: RestitutionNumber,
        one_sided: bool = False,
        mass_ratio: MassRatio = 1.0,
        restitution_range: float | None = None,
    ) -> "CapacityCurve":
        """Return the curve of a CSV file; the others as for the class.

        One column is displacement_m, displacement_cm or displacement_mm; another one multiplier, force_kN over the
        weight, or acceleration_g or acceleration_m_s2 of the equivalent system, a* = α g/e* (Circolare, C8.7.1.1), of
        which mass_ratio is the e*.
        Raises StructureError naming what is missing or no number.
        """
        if not isinstance(file, str | Path):
            raise StructureError(f"file is {file!r}, but must be a text, the name of a CSV file.", file=file)
        displacements, loads, head = _points(Path(file))
        units = {
            "force_kN": 1e3 / weight,
            "acceleration_g": mass_ratio,
            "acceleration_m_s2": mass_ratio / GRAVITY,
        }
        if mass_ratio != 1 and not head.startswith("acceleration"):
            raise StructureError(
                f"mass_ratio is {mass_ratio!r}, but a {head} takes none, as it stands before the division by e*; leave "
                "it out.",
                mass_ratio=mass_ratio,
            )
        return cls(
            tuple(displacements),
            tuple(units.get(head, 1.0) * load for load in loads),
            weight,
            restitution,
            one_sided,
            restitution_range=restitution_range,
        )

    @property
    def description(self) -> str:
        """The curve in a few words, as a page has no room for its points."""
        others = [
            given.field.phrased(given.text)
            for given in self.described.values
            if given.field.name not in ("displacements", "multipliers") and given.value is not False
        ]
        points = len(self.displacements)
        curve = f"curve of {points} points from α {self.multipliers[0]:.4g} to 0 at {self._reach:.4g} m"
        return ", ".join([curve, *others])

    @cached_property
    def described(self) -> Description:
        """What it says of itself: the points, so that they count, and not the name of their file."""
        return Description.of(self)

    @property
    def _leaves_out(self) -> RockingWarning:
        """What a curve leaves out."""
        return RockingWarning(StructureKind.CURVE_ALONE)

    @cached_property
    def _reach(self) -> float:
        """d*_u, at which the multiplier comes down to 0 for the first time, m."""
        place = self._vanishes
        (start, end), (high, low) = (
            self.displacements[place - 1 : place + 1],
            self.multipliers[place - 1 : place + 1],
        )
        if low == 0:
            return end  # which the quotient may miss by a rounding
        return min(start + (end - start) * high / (high - low), end)

    @cached_property
    def _vanishes(self) -> int:
        """Place of the first point whose multiplier is 0 or below."""
        return next(place for place, multiplier in enumerate(self.multipliers) if multiplier <= 0)

    @property
    def _to_the_end(self) -> tuple[np.ndarray, np.ndarray]:
        """The displacements [m] and multipliers up to d*_u, where the last one is 0."""
        inside = self._vanishes
        # d*_u may round onto a point whose multiplier is next to nothing.
        while self.displacements[inside - 1] >= self._reach:
            inside -= 1
        displacements = np.array([*self.displacements[:inside], self._reach])
        return displacements, np.array([*self.multipliers[:inside], 0.0])

    @property
    def height(self) -> float:
        """h of the slender rigid body of the same λ and d*_u, m."""
        return self._reach / self.multipliers[0]

    @property
    def _sides(self) -> tuple[Side]:
        """In d* = h φ: I = h, G = α, B = 1."""
        height = self.height
        displacements, gravity = self._to_the_end
        points = displacements / height
        critical = float(points[-1])
        slopes = np.diff(gravity) / np.diff(points)

        def segment(rotation: np.ndarray) -> np.ndarray:
            place = np.searchsorted(points, rotation, side="right") - 1
            return np.asarray(np.minimum(place, slopes.size - 1))

        def of_gravity(rotation: np.ndarray) -> np.ndarray:
            place = segment(rotation)
            return np.asarray(gravity[place] + slopes[place] * (rotation - points[place]))

        constant = partial(np.full_like, dtype=float)
        side = Side(
            inertia=lambda rotation: constant(rotation, height),
            inertia_slope=lambda rotation: constant(rotation, 0.0),
            gravity=of_gravity,
            gravity_slope=lambda rotation: slopes[segment(rotation)],
            ground=lambda rotation: constant(rotation, 1.0),
            critical_rotation=critical,
            end_rotation=max(math.pi / 2, 2 * critical),
            restitution=self.restitution,
            kinks=tuple(points[1:-1].tolist()),
        )
        return (side,)

    def capacity_curve(self, side: int = 1, count: int = 41) -> StaticCurve:
        """Return the curve itself; `count` is what a structure with a geometry takes."""
        displacement, multiplier = self._to_the_end
        return StaticCurve(
            rotation=displacement / self.height,
            multiplier=multiplier,
            displacement=displacement,
            effective_displacement=displacement,
            control_point=(0.0, self.height),
            participating_mass_ratio=math.nan,  # which no curve gives
        )

    def static_capacity(self, side: int = 1) -> StaticCapacity:
        """Raise StructureError: no virtual displacements are known."""
        raise StructureError.saying(RockingWarning(StructureKind.CURVE_HAS_NO_GEOMETRY))

    def _linkage(self, mirrored: bool) -> Turning:
        """The slender body as which it is drawn."""
        half = self._reach / 2
        inertia = (4 * half**2 + self.height**2) / 12
        return Turning(half, Parts([1.0], [0.5j * self.height], [inertia]))

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        return [(0, rectangle(-self._reach / 2, self._reach / 2, 0.0, self.height))]


def _points(path: Path) -> tuple[list[float], list[float], str]:
    """The displacements [m] and what is borne there, as they stand in a file, with the head of the latter."""
    text = read_whole(path, _LARGEST, StructureError).decode("utf-8-sig", errors="replace")
    lines = list(csv.reader(text.splitlines(), delimiter=";" if ";" in text.partition("\n")[0] else ","))
    heads = [head.strip() for head in lines[0]] if lines else []
    place = _only(path, heads, _DISPLACEMENTS)
    other = _only(path, heads, _FORCES)
    displacements, loads = [], []
    for number, cells in enumerate(lines[1:], start=2):
        if not any(cell.strip() for cell in cells):
            continue
        try:
            displacements.append(_DISPLACEMENTS[heads[place]] * float(cells[place]))
            loads.append(float(cells[other]))
        except (IndexError, ValueError):
            raise StructureError(
                f"{path}, line {number}, holds {shown(','.join(cells))}, but must hold a number under {heads[place]} "
                f"and under {heads[other]}.",
                **{heads[place]: cells},
            ) from None
    return displacements, loads, heads[other]


def _only(path: Path, heads: Sequence[str], allowed: Sequence[str] | set[str] | dict[str, float]) -> int:
    """The place of the one head that is allowed."""
    found = [place for place, head in enumerate(heads) if head in allowed]
    if len(found) != 1:
        raise StructureError(
            f"{path} has the columns {shown(', '.join(heads))}, but must have one of {', '.join(sorted(allowed))}.",
            columns=heads,
        )
    return found[0]
