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
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")
    rotation_ratio_error: float = column(
        "Half width of the error bar that the code's own extrapolation gives it"
    )
    reference_rotation_ratio: float = column(
        "The same by DOP853 at 1e-12, restarted at each sample and impact"
    )
    error: float = column("Magnitude of the relative error where both rock; 0 where neither does")
    verdict_agrees: bool | None = column("Whether it rocks, overturns or stays as the reference says")
    duration_s: float = column("Processor time of one response")
    reference_impacts: int = column(
        "Impacts of the reference while the ground moves, faster than p φ_cr/1000"
    )
    missed_impacts: int | None = column(
        "Those without a counterpart; empty where the code does not tell its impacts"
    )
    reason: str = column("Why there is no number")
