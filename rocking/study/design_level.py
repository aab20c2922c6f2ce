"""The settings of the design level of a study and of the checks at it. A study without a level needs no code."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Literal

from rocking.described import check_described, described
from rocking.errors import ConfigurationError
from rocking.quantities import GRAVITY
from rocking.remarks import Kind, Remark

if TYPE_CHECKING:
    from rocking.codes.design_spectrum import DesignSpectrum

_LARGEST_USUAL = 0.6
"""a_g beyond which a remark asks for the unit, g: what maps of hazard give for rock lies below nearly everywhere."""


@dataclass(frozen=True)
class DesignSettings:
    """The design level of a study and the checks at it. Raises ConfigurationError when a value is out of range.

    Without ag and without points there is none.
    """

    LEVEL: ClassVar[tuple[str, ...]] = ("ag", "f0", "tc_star", "soil", "topography", "points", "damping")
    """Those that give the spectrum itself."""

    ag: float | None = described(
        None, "peak acceleration a_g on rock; null: no design level", "g", gt=0, le=3
    )
    f0: float | None = described(None, "amplification F0 of NTC 2018", gt=0, le=10)
    tc_star: float | None = described(None, "period T_C* of NTC 2018", "s", gt=0, le=3)
    soil: Literal["A", "B", "C", "D", "E"] = described(
        "A", "soil of NTC 2018, from A (rock) to B, C, D and E"
    )
    topography: float = described(1.0, "topographic factor S_T", ge=1.0, le=1.4)
    points: str | None = described(
        None, "instead: CSV of the spectrum, period_s and acceleration_m_s2 or acceleration_g"
    )
    damping: float = described(0.05, "damping of the spectrum, share of the critical one", ge=0, le=0.5)
    limit_state: Literal["SLV", "SLC"] = described(
        "SLV", "limit state of the checks: SLV (life safety) or SLC (collapse)"
    )
    confidence_factor: float = described(
        1.35, "FC of the checks; 1.35, that of LC1, unless crushing decides", ge=1, le=2
    )
    behaviour_factor: float = described(2.0, "q of the linear check", ge=1, le=5)
    stations: int = described(20, "stations of a set", ge=1, le=1000)
    least_factor: float = described(0.25, "least factor on a record of a set", gt=0)
    largest_factor: float = described(4.0, "largest factor on a record of a set", gt=0)
    shortest_period: float = described(0.15, "from which on the mean spectrum of a set counts", "s", gt=0)
    longest_period: float = described(2.0, "up to which it counts", "s", gt=0, le=10)
    seed: int = described(0, "of the draw of the sets", ge=0)

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
        given = {"f0": self.f0, "tc_star_s": self.tc_star}
        if self.ag is not None and self.points is not None:
            raise ConfigurationError(
                f"points is {self.points!r} beside ag_g = {self.ag:g}, but one of the two must be null."
            )
        for name, value in given.items():
            if self.ag is not None and value is None:
                raise ConfigurationError(f"{name} is missing, but must be given with ag_g.")
            if self.ag is None and value is not None:
                raise ConfigurationError(f"ag_g is missing, but must be given with {name}.")
        if self.shortest_period >= self.longest_period:
            raise ConfigurationError(
                f"shortest_period_s is {self.shortest_period:g} s, but must be below longest_period_s, "
                f"{self.longest_period:g} s."
            )
        if self.least_factor >= self.largest_factor:
            raise ConfigurationError(
                f"least_factor is {self.least_factor:g}, but must be below largest_factor, "
                f"{self.largest_factor:g}."
            )

    @property
    def remark(self) -> Remark | None:
        """A remark on an a_g beyond what codes map, as one that was typed in m/s² is; None within."""
        if self.ag is None or self.ag <= _LARGEST_USUAL:
            return None
        return Remark.of(
            Kind.SIZE_UNUSUAL,
            "design_spectrum.ag_g",
            value=self.ag,
            low=0.0,
            high=_LARGEST_USUAL,
            unit=" g",
            type="a design level",
        )

    def spectrum(self) -> "DesignSpectrum | None":
        """Return the spectrum; None where there is no design level. Raises ConfigurationError for its points."""
        if self.points is None and self.ag is None:
            return None
        from rocking.codes.design_spectrum import DesignSpectrum

        if self.points is not None:
            return DesignSpectrum.read(Path(self.points), self.damping)
        assert self.ag is not None and self.f0 is not None and self.tc_star is not None  # checked at birth
        return DesignSpectrum.ntc(
            self.ag * GRAVITY, self.f0, self.tc_star, self.soil, self.topography, self.damping
        )
