"""Rows about how sure an answer is: the ensemble of a structure under a component, or under both."""

import numpy as np

from rocking.assessment.ensemble import Ensemble
from rocking.assessment.rows.shared import CaseRow, Identity
from rocking.assessment.verdict import Verdict
from rocking.tables import column, row

_SHARE = (
    "Share of the variance of the rotation (1 where it overturns) that {} explains; empty where it is fixed"
)


@row(
    "ensemble",
    "One row per structure: what becomes of it when what is not known varies; component 'both' for all directions",
)
class EnsembleRow(CaseRow):
    """The ensemble of one case."""

    verdict: Verdict = column("stands, overturns or undecided, from the probability and the risk beside it")
    overturning_probability: float = column("Share of the members that overturn")
    overturning_members: int = column("Members that overturn")
    members: int = column("Members that were followed")
    failed_members: int = column("Members that could not be followed")
    uplift_probability: float = column("Share of the members that lift")
    nominal_rotation_ratio: float = column(
        "Of the case as given, the worse component where there are two; INF if it overturns"
    )
    rotation_ratio_low: float = column("5 % quantile of largest rotation over critical rotation")
    rotation_ratio_median: float = column("Median of largest rotation over critical rotation")
    rotation_ratio_high: float = column(
        "95 % quantile of largest rotation over critical rotation; INF if it overturns"
    )
    risk: float = column("Largest probability of the opposite that the verdict may bear")
    amplitude_range: float = column("The motion varied by plus or minus this share")
    restitution_range: float = column(
        "The restitution varied by plus or minus this much, that of the structure or else of the settings"
    )
    amplitude_share: float = column(_SHARE.format("the amplitude"))
    restitution_share: float = column(_SHARE.format("the restitution"))
    polarity_share: float = column(_SHARE.format("the sign of the motion"))
    direction_share: float = column(_SHARE.format("the direction"))
    processing_share: float = column(_SHARE.format("the processing of the record"))
    vertical_share: float = column(_SHARE.format("the vertical motion"))
    worst_direction: str = column("Direction in which it rotates most on average; empty with one direction")
    worst_polarity: str = column(
        "Sign of the motion with which it rotates most on average: as recorded or reversed; empty where it has no part"
    )
    worst_processing: str = column(
        "Processing under which it rotates most on average; empty with one processing", default=""
    )


def ensemble_row(identity: Identity, structure: str, found: Ensemble, component: str = "") -> EnsembleRow:
    """Return the row of one ensemble. component: instead of the one of `identity`."""
    shown = identity.columns | ({"component": component} if component else {})
    shown |= {
        f"{name}_share": found.shares.get(name, float("nan"))
        for name in ("amplitude", "restitution", "polarity", "direction", "processing", "vertical")
    }
    return EnsembleRow(
        **shown,
        structure=structure,
        verdict=found.verdict,
        overturning_probability=found.overturning_probability,
        overturning_members=found.overturning,
        members=found.members,
        failed_members=found.failed,
        uplift_probability=found.uplift_probability,
        nominal_rotation_ratio=found.nominal,
        rotation_ratio_low=found.low,
        rotation_ratio_median=found.median,
        rotation_ratio_high=found.high,
        risk=found.settings.risk,
        amplitude_range=found.settings.amplitude_range,
        restitution_range=found.settings.restitution_range,
        worst_direction=_worst(found, "direction"),
        worst_polarity={"1.0": "as recorded", "-1.0": "reversed"}.get(_worst(found, "polarity"), ""),
        worst_processing=_worst(found, "processing"),
    )


def _worst(found: Ensemble, cause: str) -> str:
    values = found.causes.get(cause)
    if values is None:
        return ""
    capped = np.minimum(found.rotation_ratios, 1.0)
    means = {str(name): float(np.nanmean(capped[values == name])) for name in np.unique(values)}
    return max(means, key=means.__getitem__)
