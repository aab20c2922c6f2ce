"""The report of the validation, from its tables."""

from collections.abc import Sequence
from pathlib import Path

from docs.research.validation.figures import (
    PARAMETERS,
    by_specimen,
    confusion_figure,
    identified_figure,
    reliability_figure,
    score_figure,
)
from docs.research.validation.rows import (
    ConfusionRow,
    FailureRow,
    IdentifiedRow,
    MemberRow,
    ReliabilityRow,
    ScoreRow,
    TimingRow,
)
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.printing import number
from rocking.reports.style import picture
from rocking.tables import read_table


def validation_report(folder: Path) -> bytes:
    """Return the PDF of a validation whose tables stand in `folder`."""
    return compile_document(Path(__file__).with_name("validation.typ"), validation_data(folder))


def validation_data(folder: Path) -> dict[str, object]:
    """Return what the template is given: texts, tables and figures."""
    scores, failures = read_table(ScoreRow, folder), read_table(FailureRow, folder)
    identified, members = read_table(IdentifiedRow, folder), read_table(MemberRow, folder)
    timing = read_table(TimingRow, folder)
    first = scores[0]
    return {
        "title": "Validation against shake-table tests",
        "subtitle": f"{first.tests} tests of two granite specimens under {first.motions} input motions, each motion "
        "left out of the fit that predicts it.",
        "verdicts": [_verdict(own, timing) for own in by_specimen(scores).values()],
        "scores": [_score_table(own) for own in by_specimen(scores).values()],
        "score-figure": picture(
            score_figure(scores), "Accuracy and Brier score of every method with 95 % intervals."
        ),
        "reliability": picture(
            reliability_figure(read_table(ReliabilityRow, folder)),
            "Share that overturned against predicted probability.",
        ),
        "confusion": picture(
            confusion_figure(read_table(ConfusionRow, folder)),
            "Right and wrong verdicts by class of peak velocity.",
        ),
        "identified-figure": picture(
            identified_figure(identified), "Ranges of the identified parameters beside those of the mesh."
        ),
        "identified": _identified_table(identified),
        "why": [_why(own) for own in by_specimen(failures).values()],
        "failures": _failure_table(failures),
        "members": [_members(own) for own in by_specimen(members).values()],
    }


def _verdict(rows: Sequence[ScoreRow], timing: Sequence[TimingRow]) -> str:
    """Say plainly whether the identified population beats the baselines, and by how much."""
    ours, others = rows[0], rows[1:]
    nearest = min(others, key=lambda row: row.brier)
    most = max(others, key=lambda row: row.accuracy)
    spent = next(row for row in timing if row.specimen == ours.specimen)
    sure = [row for row in others if row.brier_gain_low > 0]
    lost = [row.method for row in others if row.accuracy > ours.accuracy or row.brier < ours.brier]
    said = (
        f"Specimen {ours.specimen}: accuracy {number(ours.accuracy)} ({_span(ours.accuracy_low, ours.accuracy_high)}), "
        f"Brier score {number(ours.brier)} ({_span(ours.brier_low, ours.brier_high)}), calibration slope "
        f"{number(ours.calibration_slope)} (of the logit {number(ours.logit_slope)}), {ours.missed} missed and "
        f"{ours.false} false overturnings. Of the others, {most.method} is right most often ({number(most.accuracy)}) "
        f"and {nearest.method} has the least Brier score ({number(nearest.brier)}). "
    )
    said += (
        f"The gain in Brier score is sure at 95 % over {len(sure)} of {len(others)} others. "
        if not lost
        else f"It does not win everywhere: as good or better in one of the two scores: {', '.join(lost)}. "
    )
    return (
        said
        + f"A prediction follows {spent.members} blocks in {number(1e3 * spent.duration_s, 2)} ms of processor time."
    )


def _score_table(rows: Sequence[ScoreRow]) -> dict[str, object]:
    return printing.table_of(
        rows,
        ("Method", "2.2", "l", lambda row: printing.strong(row.method, row is rows[0])),
        ("Accuracy", "0.7", "r", lambda row: number(row.accuracy)),
        ("Brier", "0.7", "r", lambda row: number(row.brier)),
        ("Missed", "0.6", "r", lambda row: printing.whole(row.missed)),
        ("False", "0.5", "r", lambda row: printing.whole(row.false)),
        ("Slope", "0.55", "r", lambda row: number(row.calibration_slope)),
        ("Gain in accuracy (95 %)", "1.75", "r", lambda row: _gain(row, "accuracy", rows[0])),
        ("Gain in Brier (95 %)", "1.75", "r", lambda row: _gain(row, "brier", rows[0])),
    )


def _gain(row: ScoreRow, which: str, ours: ScoreRow) -> str:
    if row is ours:
        return printing.NOTHING
    low, high = (getattr(row, f"{which}_gain_{end}") for end in ("low", "high"))
    return f"{_signed(getattr(row, f'{which}_gain'))} ({_signed(low)}, {_signed(high)})"


def _signed(value: float) -> str:
    return f"{value:+.3f}".replace("-", "−")


def _span(low: float, high: float) -> str:
    return f"95 %: {number(low)} to {number(high)}"


def _identified_table(rows: Sequence[IdentifiedRow]) -> dict[str, object]:
    return printing.table_of(
        rows,
        ("Specimen", "0.6", "l", lambda row: printing.whole(row.specimen)),
        ("Parameter", "1.2", "l", lambda row: PARAMETERS[row.parameter]),
        ("Median", "0.7", "r", lambda row: number(row.median)),
        ("90 % range", "1", "r", lambda row: f"{number(row.low)} to {number(row.high)}"),
        ("From the mesh", "1", "r", lambda row: f"{number(row.mesh_low)} to {number(row.mesh_high)}"),
        ("Tried", "1", "r", lambda row: f"{number(row.prior_low)} to {number(row.prior_high)}"),
    )


def _why(rows: Sequence[FailureRow]) -> str:
    sure = sum(abs(row.probability - 0.5) > 0.3 for row in rows)
    contradicted = sum(row.contradicted for row in rows)
    slow = sum(row.peak_velocity_m_s < 0.3 for row in rows)
    lost = sum(row.candidates_right < 0.1 for row in rows)
    return (
        f"Specimen {rows[0].specimen}: {len(rows)} verdicts are wrong. In {len(rows) - sure} of them the probability "
        f"was between 0.2 and 0.8, so the prediction said that it did not know; {sure} were wrong and sure. {slow} lie "
        f"below a peak velocity of 0.3 m/s. {contradicted} belong to a pair in which the weaker play of one motion "
        f"overturned the specimen and the stronger one left it standing. Fewer than one in ten of all candidates end "
        f"as the specimen did in {lost}, where no planar block tried can say why."
    )


def _failure_table(rows: Sequence[FailureRow]) -> dict[str, object]:
    return printing.table_of(
        rows,
        ("Specimen", "0.6", "l", lambda row: printing.whole(row.specimen)),
        ("Test", "0.4", "r", lambda row: printing.whole(row.test)),
        ("Motion", "1.9", "l", lambda row: row.motion),
        ("Peak velocity (m/s)", "0.9", "r", lambda row: number(row.peak_velocity_m_s)),
        ("Probability", "0.8", "r", lambda row: number(row.probability, 2)),
        ("It", "0.8", "l", lambda row: "overturned" if row.overturned else "stood"),
        ("Contradicted", "0.8", "l", lambda row: printing.yes_or_no(row.contradicted)),
        ("Candidates right", "0.9", "r", lambda row: f"{100 * row.candidates_right:.0f} %"),
    )


def _members(rows: Sequence[MemberRow]) -> str:
    first = rows[0]
    return (
        f"Specimen {first.specimen}: {len(rows)} distinct blocks, {first.iterations} steps, "
        f"ε = {printing.given(first.unexplained)}, b = {printing.given(first.sharpness)}."
    )
