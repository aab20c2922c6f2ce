"""The tables of a validation."""

from rocking.tables import Row, column, row


@row(
    "predictions",
    "One row per specimen, method and test: what a fit to the other motions said, and what happened",
)
class PredictionRow(Row):
    specimen: int = column("Number of the specimen")
    method: str = column("How the prediction was made")
    test: int = column("Number of the test")
    motion: str = column("Input motion, which the table played scaled")
    peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration of the table, low-passed")
    peak_velocity_m_s: float = column("Largest magnitude of the velocity of the table")
    probability: float = column("Predicted probability of overturning; 0 or 1 where the method knows no more")
    overturned: bool = column("Whether it overturned")


@row("scores", "One row per specimen and method, over the tests of all motions, each left out of its fit")
class ScoreRow(Row):
    specimen: int = column("Number of the specimen")
    method: str = column("How the predictions were made")
    tests: int = column("Number of tests")
    motions: int = column("Number of input motions, which are what is left out and resampled")
    accuracy: float = column("Share of verdicts that were right")
    accuracy_low: float = column("Its 95 % interval by resampling motions, lower end")
    accuracy_high: float = column("Its 95 % interval by resampling motions, upper end")
    brier: float = column("Mean square of probability less outcome")
    brier_low: float = column("Its 95 % interval by resampling motions, lower end")
    brier_high: float = column("Its 95 % interval by resampling motions, upper end")
    missed: int = column("Overturnings that were not predicted: the unsafe side")
    false: int = column("Overturnings that were predicted and did not happen")
    accuracy_gain: float = column("Accuracy of the identified population less this one, paired")
    accuracy_gain_low: float = column("Its 95 % interval by resampling motions, lower end")
    accuracy_gain_high: float = column("Its 95 % interval by resampling motions, upper end")
    brier_gain: float = column("This Brier score less the identified population's, paired")
    brier_gain_low: float = column("Its 95 % interval by resampling motions, lower end")
    brier_gain_high: float = column("Its 95 % interval by resampling motions, upper end")
    calibration_slope: float = column("Slope of the outcomes over the probability, least squares; 1 at best")
    logit_slope: float = column(
        "Slope of the outcomes over the logit of the probability, logistic; 1 at best"
    )


@row("reliability", "One row per specimen and class of the predicted probability, identified population")
class ReliabilityRow(Row):
    specimen: int = column("Number of the specimen")
    tests: int = column("Number of tests in the class")
    stated: float = column("Mean predicted probability")
    observed: float = column("Share that overturned")
    observed_low: float = column("Its 90 % interval by resampling motions, lower end")
    observed_high: float = column("Its 90 % interval by resampling motions, upper end")


@row("confusion", "One row per specimen and class of peak velocity, identified population")
class ConfusionRow(Row):
    specimen: int = column("Number of the specimen")
    lowest_peak_velocity_m_s: float = column("Lowest peak velocity of the class")
    highest_peak_velocity_m_s: float = column("Highest peak velocity of the class")
    stood: int = column("Tests that stood, and were said to")
    overturned: int = column("Tests that overturned, and were said to")
    missed: int = column("Tests that overturned, and were said to stand")
    false: int = column("Tests that stood, and were said to overturn")


@row("identified", "One row per specimen and parameter: what the tests say beside what the mesh says")
class IdentifiedRow(Row):
    specimen: int = column("Number of the specimen")
    parameter: str = column(
        "Parameter of the block with two sides; frequency_parameter in rad/s, the others without unit"
    )
    low: float = column("5 % of the identified population, all motions")
    median: float = column("50 % of the identified population, all motions")
    high: float = column("95 % of the identified population, all motions")
    prior_low: float = column("Lowest value that was tried")
    prior_high: float = column("Highest value that was tried")
    mesh_low: float = column("Least value that the mesh allows, over the azimuths of shaking")
    mesh_high: float = column("Largest value that the mesh allows, over the azimuths of shaking")


@row("failures", "One row per specimen and test whose verdict was wrong, identified population")
class FailureRow(Row):
    specimen: int = column("Number of the specimen")
    test: int = column("Number of the test")
    motion: str = column("Input motion")
    peak_velocity_m_s: float = column("Largest magnitude of the velocity of the table")
    probability: float = column("Predicted probability of overturning")
    overturned: bool = column("Whether it overturned")
    contradicted: bool = column(
        "Whether a weaker test of the same motion overturned that specimen while a stronger one left it standing, "
        "this test being one of the two"
    )
    candidates_right: float = column("Share of all candidates that get this test right")


@row("members", "One row per specimen and block that predictions follow, fitted to all motions")
class MemberRow(Row):
    specimen: int = column("Number of the specimen")
    share: float = column("Weight of the block among the members")
    uplift_multiplier_positive: float = column("λ of the positive side")
    uplift_multiplier_negative: float = column("λ of the negative side")
    frequency_parameter_rad_s: float = column("p of both sides")
    restitution: float = column("η of both sides")
    unexplained: float = column("ε, the share of outcomes that no candidate explains")
    iterations: int = column("Steps of expectation and maximisation")
    sharpness: float = column("b, by which the log odds of a share are multiplied")


@row("timing", "One row per specimen: what a prediction takes; differs between runs")
class TimingRow(Row):
    specimen: int = column("Number of the specimen")
    tests: int = column("Tests on which it was measured")
    members: int = column("Distinct blocks that are followed")
    duration_s: float = column(
        "Processor time per test, all members together, without the processing of the record"
    )


ROW_CLASSES = (
    ScoreRow,
    ReliabilityRow,
    ConfusionRow,
    FailureRow,
    IdentifiedRow,
    MemberRow,
    TimingRow,
    PredictionRow,
)
"""Every table of a validation, in the order of the report."""
