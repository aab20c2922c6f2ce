"""EnsembleSettings: what is not known of a case."""

from dataclasses import dataclass

from rocking.assessment.ensemble.design import SIZES
from rocking.described import check_described, described
from rocking.errors import ConfigurationError


@dataclass(frozen=True)
class EnsembleSettings:
    """What is not known of a case, and how much of it a verdict bears. Raises ConfigurationError."""

    members: int = described(
        64,
        "members of an ensemble, taken up to the next of 16, 64, 256, 1024 and 4096; 0: none",
        ge=0,
        le=4096,
    )
    amplitude_range: float = described(
        0.05, "the ground motion is known to plus or minus this share", ge=0, le=0.9
    )
    restitution_range: float = described(
        0.05,
        "the restitution is known to plus or minus this much, where a structure does not say its own",
        ge=0,
        le=1,
    )
    polarity: bool = described(
        True, "whether the sign of the motion is unknown to a structure with unlike sides"
    )
    processing: bool = described(
        True, "whether baseline and corner frequency of a record are unknown whose file says that it is raw"
    )
    risk: float = described(
        0.05, "largest probability of the opposite under which a structure stands or overturns", gt=0, le=0.45
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)

    @property
    def size(self) -> int:
        """Members of the design that is used; 0 for none."""
        return next(size for size in (0, *SIZES) if size >= self.members)
