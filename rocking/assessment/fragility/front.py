"""rocking.fragility: the curve of one structure, from every case or from few runs of its mechanism."""

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility.analysis import incremental_dynamic_analysis
from rocking.assessment.fragility.curve import Fragility
from rocking.assessment.fragility.multifidelity import multi_fidelity_analysis
from rocking.errors import ConfigurationError
from rocking.motion.integration import Rocking
from rocking.records import Accelerogram


def fragility(
    records: Sequence[Accelerogram],
    structure: Rocking,
    *,
    intensity_measure: str = "pga",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    threshold: float = np.inf,
    method: Literal["scaling", "cloud", "multi-fidelity"] = "scaling",
    mechanism_runs: int | None = None,
    ensemble: EnsembleSettings | None = None,
    tolerance: float = 1e-6,
) -> Fragility:
    """Return the fragility of `structure` under `records`.

    threshold: rotation ratio that is exceeded; inf: overturning. method: scaling or cloud, as for
    `incremental_dynamic_analysis`, or multi-fidelity: scaling, but with `mechanism_runs` runs of the mechanism only,
    drawn where the equivalent block is in doubt; `multi_fidelity_analysis` says how. What else it takes, and the errors
    that it raises, are those of these two.
    """
    if (method == "multi-fidelity") != (mechanism_runs is not None):
        raise ConfigurationError(
            f"mechanism_runs is {mechanism_runs} with the method {method}, but must be given with multi-fidelity, and "
            "with no other method."
        )
    shared: dict[str, Any] = {
        "intensity_measure": intensity_measure,
        "levels": levels,
        "stations": stations,
        "ensemble": ensemble,
        "tolerance": tolerance,
    }
    if mechanism_runs is not None:
        return multi_fidelity_analysis(records, structure, mechanism_runs, **shared).fragility(threshold)
    return incremental_dynamic_analysis(records, structure, method=method, **shared).fragility(threshold)  # type: ignore[arg-type]
