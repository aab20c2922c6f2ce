"""The table of a comparison of codes."""

from rocking.tables import Row, column, row


@row(
    "codes",
    "One row per case and code: error against scipy's DOP853 at 1e-12, and work; times differ between runs",
)
class CodeRow(Row):
    case: str = column("Name of the case: structure, kind of motion and number")
    structure: str = column("block, frame or arch")
    motion: str = column("pulse or record")
    code: str = column("Code and setting")
    another_model: bool = column(
        "Whether the code solves a motion other than the reference's, so that a difference is no error"
    )
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")
    rotation_ratio_error: float = column(
        "Half width of the error bar that the code's own extrapolation gives it"
    )
    reference_rotation_ratio: float = column(
        "The same by DOP853 at 1e-12, restarted at each sample and impact"
    )
    error: float = column(
        "Magnitude of the relative error where both rock; 0 where neither does; empty for another model"
    )
    verdict_agrees: bool | None = column("Whether it rocks, overturns or stays as the reference says")
    duration_s: float = column("Processor time of one response")
    reference_impacts: int = column(
        "Impacts of the reference while the ground moves, faster than p φ_cr/1000"
    )
    missed_impacts: int | None = column(
        "Those without an impact of the code within 0.02/p; empty where it does not tell its impacts"
    )
    reference_restitution: float = column("Restitution of the reference")
    restitution: float = column(
        "What the code keeps at a reversal on still ground: root of the ratio of energies of two excursions"
    )
    restitution_error: float = column("Half width of its error bar by the code's own extrapolation")
    same_restitution_rotation_ratio: float = column("Rotation ratio by this package with that restitution")
    outside_hinges: float = column(
        "Share of all joint rotation outside the hinges of the mechanism, at the largest rotation"
    )
    reason: str = column("Why there is no number")
