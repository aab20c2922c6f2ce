"""The report of the trade, from its tables: which method to buy, in one sentence, and the figures behind it."""

import math
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from rocking.assessment.rows.of_trade import (
    MultiFidelityRow,
    TradeFragilityRow,
    TradeMethod,
    TradeMethodRow,
    TradeRow,
)
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.style import picture, svg
from rocking.reports.trade.figures import duration, trade_figure
from rocking.tables import read_table, write_whole

PREDICTS = 0.1
"""Median error, and share of wrong verdicts, up to which a method is said to predict."""
_TOLERANCE = 1e-6
"""At which mechanism and scipy are compared."""
_SMALL = 1e-4
"""Below which an error is printed as less."""
_GAIN, _BIAS = 5.0, 0.1
"""Times fewer runs than without the block from which multi-fidelity pays, and bias over width up to which it may."""


def write_trade_report(folder: Path, pdf: Path, image: Path) -> None:
    """Set the tables in `folder` as the files `pdf` and `image` (SVG)."""
    write_whole(pdf, compile_document("trade/trade.typ", trade_data(folder)))
    write_whole(image, svg(trade_figure(*_rows_of_figure(folder))).encode())


def trade_data(folder: Path) -> dict[str, object]:
    """Return what the template is given: texts, tables and the figure."""
    methods, curves = _rows_of_figure(folder)
    samples = read_table(MultiFidelityRow, folder)
    return {
        "title": "What accuracy costs",
        "subtitle": _subtitle(methods, curves),
        "conclusion": conclusion(methods),
        "sentences": [
            *_preparation(methods),
            *_beside_scipy(read_table(TradeRow, folder)),
            *_fragility(methods),
            *_multi_fidelity(samples),
        ],
        "methods": _method_table(methods),
        "pays": _pays_table(methods),
        "figure": _picture(methods, curves),
        "curves": _curve_table(curves),
        "samples": _sample_table(samples),
    }


def trade_picture(folder: Path) -> list[dict[str, str]]:
    """Return figure and conclusion for another document; nothing where the trade has no case."""
    methods, curves = _rows_of_figure(folder)
    if not methods:
        return []
    return [each | {"conclusion": conclusion(methods)} for each in _picture(methods, curves)]


def conclusion(rows: Sequence[TradeMethodRow]) -> str:
    """Say in one sentence which method predicts, which only explains, and what each costs."""
    by_name = {row.method: row for row in rows if row.cases}
    if TradeMethod.MECHANISM not in by_name:
        return "No structure lifts under any of the records, so that every method agrees."
    dear = by_name[TradeMethod.MECHANISM]
    parts = [f"The mechanism on the record takes {duration(dear.cpu_s)} a response"]
    for method, name in (
        (TradeMethod.BLOCK, "the block on the record"),
        (TradeMethod.ONE_SINE, "the closed form"),
    ):
        if method in by_name:
            parts.append(_judged(name, by_name[method], dear))
    return "; ".join(parts) + "."


def _judged(name: str, row: TradeMethodRow, dear: TradeMethodRow) -> str:
    wrong = row.wrong_verdicts / row.cases
    predicts = not row.error > PREDICTS and wrong <= PREDICTS
    verdicts = f"{row.wrong_verdicts} of {row.cases} verdicts wrong"
    error = "" if math.isnan(row.error) else f"a median error of {_percent(row.error)} and "
    time = duration(row.cpu_s) + (
        f" after {duration(row.preparation_record_s)} for the pulse"
        if row.preparation_record_s > dear.cpu_s
        else ""
    )
    says = "predicts" if predicts else "explains, but does not predict"
    return f"{name} {says}: it takes {time}, with {error}{verdicts}"


def _subtitle(methods: Sequence[TradeMethodRow], curves: Sequence[TradeFragilityRow]) -> str:
    whole = sum(row.cases for row in methods if row.method == TradeMethod.MECHANISM)
    said = f"{printing.counted(whole, 'case')} that lift, whole records as they are"
    if curves:
        structures = len({row.structure for row in curves})
        said += (
            f"; fragility of {printing.counted(structures, 'structure')} from {curves[0].records} components of "
            f"{curves[0].stations} stations"
        )
    return printing.sentence(said) + ". Processor time of the machine that measured."


def _preparation(rows: Sequence[TradeMethodRow]) -> list[str]:
    """When the time spent on a pulse comes back."""
    sine = next((row for row in rows if row.method == TradeMethod.ONE_SINE and row.cases), None)
    if sine is None:
        return []
    first = (
        "never costs less than the mechanism"
        if math.isinf(sine.pays_from)
        else f"costs less than the mechanism from {sine.pays_from:.0f} structures a record"
    )
    said = f"With the search for the pulse counted ({duration(sine.preparation_record_s)} a record), one sine {first}"
    if math.isfinite(sine.pays_from_fragility):
        said += (
            f", and from {sine.pays_from_fragility:.0f} where each is followed at all levels of a fragility"
        )
    return [said + "."]


def _beside_scipy(rows: Sequence[TradeRow]) -> list[str]:
    """Mechanism and scipy at the same tolerance in the same cases."""
    said = []
    for method, name in ((TradeMethod.MECHANISM, "the mechanism"), (TradeMethod.DOP853, "DOP853")):
        own = [
            row for row in rows if row.beside_scipy and row.method == method and row.tolerance == _TOLERANCE
        ]
        known = [row for row in own if not math.isnan(row.error)]
        if not known:
            return []
        worst, time = max(row.error for row in known), median(row.cpu_s for row in known)
        most = f"at most {_percent(worst)}" if worst >= _SMALL else "less than 0.01 %"
        said.append(f"{name} errs by {most} and takes {duration(time)}")
    return [f"At a tolerance of 1e-6, on the stretches that scipy was given, {' and '.join(said)}."]


def _fragility(rows: Sequence[TradeMethodRow]) -> list[str]:
    names = (TradeMethod.ONE_SINE, TradeMethod.SINES, TradeMethod.BLOCK)
    known = [row for row in rows if row.method in names and row.fragility_structures]
    if not known:
        return []
    said = ", ".join(
        f"by {_percent(row.fragility_error)} (at worst {_percent(row.fragility_error_worst)}) with {row.method}"
        for row in known
    )
    times = {row.method: row.fragility_cpu_s for row in rows}
    taken = TradeMethod.BLOCK, TradeMethod.MULTI_FIDELITY, TradeMethod.MECHANISM, TradeMethod.ENSEMBLE
    block, few, every, ensembles = (times[name] for name in taken)
    return [
        f"The median of the fragility is off {said}.",
        f"A fragility takes {duration(block)} with the block, {duration(few)} with the mechanism in "
        f"a tenth of the cases, {duration(every)} with it in all and {duration(ensembles)} with an ensemble for each: "
        f"few runs save a factor of {every / few:.1f} where a case is one run, and of {ensembles / few:.0f} where it "
        "is one of an ensemble.",
    ]


def _multi_fidelity(rows: Sequence[MultiFidelityRow]) -> list[str]:
    """Where it pays in runs, and whether in time."""
    sentences = []
    shares = sorted({round(row.runs / row.cases, 3) for row in rows})
    for share in dict.fromkeys((*shares[:1], *shares[-1:])):
        own = [row for row in rows if round(row.runs / row.cases, 3) == share]
        curve = sum(row.curve_gain >= _GAIN and row.curve_bias <= _BIAS for row in own)
        middle = sum(row.median_gain >= _GAIN and row.median_bias <= _BIAS for row in own)
        cheaper = sum(row.cpu_gain > 1 for row in own)
        sentences.append(
            f"With the mechanism in {_percent(share)} of the cases, multi-fidelity needs at least {_GAIN:.0f} times "
            f"fewer runs for the same width on {curve} of {len(own)} structures for the curve and on {middle} for its "
            f"median (medians of the factor: {median(row.curve_gain for row in own):.1f} and "
            f"{median(row.median_gain for row in own):.1f}); with the runs of the block counted, the curve takes less "
            f"processor time on {cheaper or 'none'}."
        )
    if rows:
        sine = median(row.correlation_sine for row in rows)
        sentences.append(
            f"The closed form is no control variate: at a level its overturning correlates with the mechanism's by "
            f"{sine:.2f}, that of the block by {median(row.correlation_block for row in rows):.2f} (medians)."
        )
    return sentences


def _method_table(rows: Sequence[TradeMethodRow]) -> dict[str, object]:
    return printing.table_of(
        rows,
        ("Method", "1.6", "l", lambda row: row.method),
        ("Cases", "0.6", "r", lambda row: printing.whole(row.cases)),
        ("Median error", "0.9", "r", lambda row: _percent(row.error)),
        ("Wrong verdicts", "0.9", "r", lambda row: printing.whole(row.wrong_verdicts)),
        ("Fragility median: error", "1.1", "r", lambda row: _percent(row.fragility_error)),
        ("at worst", "0.8", "r", lambda row: _percent(row.fragility_error_worst)),
        ("A response", "0.9", "r", lambda row: duration(row.cpu_s)),
        ("A fragility", "0.9", "r", lambda row: duration(row.fragility_cpu_s)),
    )


def _pays_table(rows: Sequence[TradeMethodRow]) -> dict[str, object]:
    return printing.table_of(
        rows,
        ("Method", "1.6", "l", lambda row: row.method),
        ("Once a record", "1", "r", lambda row: _spent(row.preparation_record_s)),
        ("Once a structure", "1", "r", lambda row: _spent(row.preparation_structure_s)),
        ("Pays from, structures a record", "1.5", "r", lambda row: _from(row, row.pays_from)),
        ("The same in a fragility", "1.5", "r", lambda row: _from(row, row.pays_from_fragility)),
    )


def _curve_table(rows: Sequence[TradeFragilityRow]) -> dict[str, object]:
    structures = list(dict.fromkeys(row.structure for row in rows))
    by_case = {(row.structure, row.method): row for row in rows}
    methods = [method for method in TradeMethod if any(row.method == method for row in rows)]

    def error(method: TradeMethod, structure: str) -> str:
        row = by_case.get((structure, method))
        return printing.NOTHING if row is None else _percent(row.error, signed=True)

    def exact(structure: str) -> str:
        return printing.number(next(row.reference_median for row in rows if row.structure == structure))

    return printing.table_of(
        structures,
        ("Structure", "1.6", "l", lambda name: name),
        ("Median", "0.8", "r", exact),
        *(
            (str(method), "1", "r", lambda name, method=method: error(method, name))  # type: ignore[misc]
            for method in methods
        ),
    )


def _sample_table(rows: Sequence[MultiFidelityRow]) -> dict[str, object]:
    return printing.table_of(
        rows,
        ("Structure", "1.5", "l", lambda row: row.structure),
        ("Runs", "0.8", "r", lambda row: f"{row.runs} of {row.cases}"),
        ("Width of P", "0.7", "r", lambda row: printing.number(row.curve_width, 2)),
        ("Bias over width", "0.7", "r", lambda row: printing.number(row.curve_bias, 2)),
        ("Fewer runs", "0.7", "r", lambda row: f"{row.curve_gain:.1f} ×"),
        ("Width of median", "0.8", "r", lambda row: _percent(row.median_width)),
        ("Bias over width", "0.7", "r", lambda row: printing.number(row.median_bias, 2)),
        ("Fewer runs", "0.7", "r", lambda row: f"{row.median_gain:.1f} ×"),
        ("Other records a level", "0.8", "r", lambda row: f"{row.median_gain_cases:.1f} ×"),
        ("In time", "0.6", "r", lambda row: f"{row.cpu_gain:.1f} ×"),
        ("Two-level", "0.7", "r", lambda row: f"{row.two_level_gain:.1f} ×"),
    )


def _rows_of_figure(folder: Path) -> tuple[list[TradeMethodRow], list[TradeFragilityRow]]:
    return read_table(TradeMethodRow, folder), read_table(TradeFragilityRow, folder)


def _picture(methods: Sequence[TradeMethodRow], curves: Sequence[TradeFragilityRow]) -> list[dict[str, str]]:
    alt = "Error against processor time of every method, for one response and for the fragility of one structure."
    return [picture(trade_figure(methods, curves), alt)]


def _spent(seconds: float) -> str:
    return "nothing" if seconds == 0 else duration(seconds)


def _from(row: TradeMethodRow, number: float) -> str:
    if row.method == TradeMethod.MECHANISM or math.isnan(number):
        return printing.NOTHING
    return "never" if math.isinf(number) else f"{number:.0f}"


def _percent(value: float, signed: bool = False) -> str:
    if math.isnan(value):
        return printing.NOTHING
    said = printing.number(100 * abs(value), 2) if abs(value) >= _SMALL else "< 0.01"
    sign = ("−" if value < 0 else "+") if signed and abs(value) >= _SMALL else ""
    return f"{sign}{said} %"
