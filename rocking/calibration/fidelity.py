"""What the choice of the cheapest method rests on: limits chosen on half of the sites and reported on the other half.

An answer is right when its verdict is the mechanism's and its rotation within the tolerance. It is unsafe when it is
wrong and too low: overturning or uplift missed, or a rotation too small by more than the tolerance.
"""

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rocking.assessment.fidelity import LADDER, Limits
from rocking.assessment.method import Method
from rocking.assessment.verdict import Agreement, agreement, rocks
from rocking.calibration.lights import distinct_components, grid_of_blocks
from rocking.calibration.trials import Trial, trials
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.tables import Row, column, row, write_rows

TOLERANCES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
RISKS = (0.001, 0.01, 0.05)
RIGHT = 0.95
"""Least share of right answers among the cheap ones, whichever one site is left out."""
CHEAP = (Method.CLOSED_FORM, Method.BLOCK_ON_RECORD)
FEWEST = 20
"""Fewest answers on which a limit may rest."""
_MARGINS = (0.0, 0.5, 1.0, 2.0, 5.0, 10.0)
_SENSITIVITIES = (2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
_ROTATION_RATIOS = (0.1, 0.2, 0.3, 0.5, 0.7)
_SHARES_OF_TOLERANCE = (1.0, 0.8, 0.6)
"""Largest known error over tolerance."""


@row(
    "fidelity_held_out",
    "One row per tolerance, risk and half of the sites: what the choice did; times differ between runs",
)
class HeldOut(Row):
    """What one row of limits did on one half of the sites."""

    half: str = column("chosen on: the limits were chosen here; held out: they were not")
    tolerance: float = column("Relative error of the rotation that counts as right")
    risk: float = column("Largest share of unsafe answers asked for")
    sites: int = column("Recording sites")
    trials: int = column("Records times structures times factors on the record")
    at_rest: float = column("Share of trials without uplift")
    closed_form: float = column("Share of trials answered by the closed form")
    block: float = column("Share of trials answered by the equivalent block")
    mechanism: float = column("Share of trials integrated in full")
    right: float = column("Share of right answers")
    unsafe: float = column("Share of unsafe answers")
    right_of_cheap: float = column("Share of right answers among those of the closed form and the block")
    unsafe_of_cheap: float = column("Share of unsafe answers among those of the closed form and the block")
    unsafe_verdicts: float = column("Share of trials in which overturning or uplift was missed")
    time_saved: float = column("Share saved of integrating every mechanism once")
    time_saved_full: float = column("The same, with sensitivity and fragility wherever the mechanism answers")


def halves(everything: Sequence[Trial]) -> tuple[list[Trial], list[Trial]]:
    """Return the trials of every other site by name, and those of the others."""
    even = set(sorted({trial.site for trial in everything})[::2])
    return [t for t in everything if t.site in even], [t for t in everything if t.site not in even]


def is_right(answer: float, truth: float, tolerance: float) -> bool:
    """Whether the verdict agrees and the rotation is within the tolerance."""
    if agreement(answer, truth) is not Agreement.SAME:
        return False
    return not rocks(truth) or abs(answer / truth - 1) <= tolerance


def is_unsafe(answer: float, truth: float, tolerance: float) -> bool:
    """Whether the answer is wrong and too low."""
    return not is_right(answer, truth, tolerance) and answer < truth


def choose_limits(chosen_on: Sequence[Trial], tolerance: float, risk: float) -> Limits:
    """Return the limits under which most of `chosen_on` is answered cheaply and every promise is kept.

    The closed form and the block are right in RIGHT of their answers. One unsafe rotation of the block more than was
    counted would still be at most `risk` of them. Both hold whichever one site is left out.
    """
    lifted = [trial for trial in chosen_on if not trial.at_rest]
    nothing = Limits(
        tolerance=tolerance,
        risk=risk,
        closed_form_margin=math.inf,
        known_error=0.0,
        rotation_ratio=0.0,
        sensitivity=0.0,
        answers=0,
        right=math.nan,
        unsafe=math.nan,
    )
    margins = (replace(nothing, closed_form_margin=margin) for margin in _MARGINS)
    best = next((each for each in margins if _mostly_right(lifted, each)), nothing)
    most, errors = 0, (share * tolerance for share in _SHARES_OF_TOLERANCE)
    reaches = [(0.0, 0.0), *itertools.product(_ROTATION_RATIOS, _SENSITIVITIES)]
    for error, (ratio, sensitivity) in itertools.product(errors, reaches):
        tried = replace(best, known_error=error, rotation_ratio=ratio, sensitivity=sensitivity)
        answered = sum(trial.method(tried) is Method.BLOCK_ON_RECORD for trial in lifted)
        if answered > most and _mostly_right(lifted, tried) and _seldom_unsafe(lifted, tried):
            best, most = tried, answered
    return _with_evidence(best, chosen_on)


def held_out(half: str, trials_of_half: Sequence[Trial], limits: Limits) -> HeldOut:
    """Count what `limits` do on one half of the sites."""
    methods = [trial.method(limits) for trial in trials_of_half]
    pairs = list(zip(trials_of_half, methods, strict=True))
    right, unsafe, verdicts = _answers(pairs, limits.tolerance)
    cheap = [method in CHEAP for method in methods]
    at_rest, closed_form, block, mechanism = (
        _mean([method is each for method in methods]) for each in LADDER
    )
    return HeldOut(
        half=half,
        tolerance=limits.tolerance,
        risk=limits.risk,
        sites=len({trial.site for trial in trials_of_half}),
        trials=len(methods),
        at_rest=at_rest,
        closed_form=closed_form,
        block=block,
        mechanism=mechanism,
        right=_mean(right),
        unsafe=_mean(unsafe),
        right_of_cheap=_mean(list(itertools.compress(right, cheap))),
        unsafe_of_cheap=_mean(list(itertools.compress(unsafe, cheap))),
        unsafe_verdicts=_mean(verdicts),
        time_saved=_saved(trials_of_half, limits, full=False),
        time_saved_full=_saved(trials_of_half, limits, full=True),
    )


def write_fidelity(
    records: Iterable[tuple[str, Accelerogram]], structures: Mapping[str, Structure], folder: Path
) -> list[HeldOut]:
    """Try every record on a grid of blocks and `structures`; write the limits and what they do into `folder`."""
    everything = grid_of_blocks() | dict(structures)
    made = [t for name, record in distinct_components(records) for t in trials(name, record, everything)]
    first, second = halves(made)
    limits = [choose_limits(first, *pair) for pair in itertools.product(TOLERANCES, RISKS)]
    parts = {"chosen on": first, "held out": second}
    report = [held_out(half, part, each) for each, (half, part) in itertools.product(limits, parts.items())]
    write_rows(Limits, limits, folder / Limits.table.file_name)
    write_rows(HeldOut, report, folder / HeldOut.table.file_name)
    return report


def _with_evidence(limits: Limits, chosen_on: Sequence[Trial]) -> Limits:
    found = held_out("chosen on", chosen_on, limits)
    answers = round((found.closed_form + found.block) * found.trials)
    return replace(limits, answers=answers, right=found.right_of_cheap, unsafe=found.unsafe_of_cheap)


def _saved(found: Sequence[Trial], limits: Limits, full: bool) -> float:
    spent = sum(trial.duration(limits, full) for trial in found)
    return 1 - spent / sum(trial.mechanism_full_s if full else trial.mechanism_s for trial in found)


def _answers(pairs: Iterable[tuple[Trial, Method]], tolerance: float) -> tuple[list, list, list]:
    """Whether each answer is right, is unsafe, and misses overturning or uplift."""
    right, unsafe, verdicts = [], [], []
    for trial, method in pairs:
        answer, truth = trial.rotation_ratio(method), trial.mechanism_ratio
        right.append(is_right(answer, truth, tolerance))
        unsafe.append(is_unsafe(answer, truth, tolerance))
        verdicts.append(agreement(answer, truth) is Agreement.TOO_LOW)
    return right, unsafe, verdicts


def _mostly_right(lifted: Sequence[Trial], limits: Limits) -> bool:
    found = [(trial, method) for trial in lifted if (method := trial.method(limits)) in CHEAP]
    wrong = [
        not is_right(t.rotation_ratio(method), t.mechanism_ratio, limits.tolerance) for t, method in found
    ]
    return _share_without_one_site([trial for trial, _ in found], wrong) <= 1 - RIGHT


def _seldom_unsafe(lifted: Sequence[Trial], limits: Limits) -> bool:
    """Of the block's rotations alone, so that overturnings, which cannot be unsafe, do not hide them."""
    rocking = [
        t for t in lifted if not math.isinf(t.block_ratio) and t.method(limits) is Method.BLOCK_ON_RECORD
    ]
    unsafe = [is_unsafe(t.block_ratio, t.mechanism_ratio, limits.tolerance) for t in rocking]
    return not rocking or _share_without_one_site(rocking, unsafe, more=1) <= limits.risk


def _share_without_one_site(found: Sequence[Trial], flags: Sequence[bool], more: int = 0) -> float:
    """The largest share of flags, with `more` added, whichever one site is left out; 1 where too few are left."""
    shares = []
    for site in {trial.site for trial in found}:
        kept = [flag for trial, flag in zip(found, flags, strict=True) if trial.site != site]
        shares.append((sum(kept) + more) / (len(kept) + more) if len(kept) >= FEWEST else 1.0)
    return max(shares, default=1.0)


def _mean(flags: Sequence[bool]) -> float:
    return sum(flags) / len(flags) if flags else math.nan
