"""The parts of the pages that the code itself says: formats, settings, structures, tables, equations, names."""

import csv
import inspect
import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import rocking
from docs.site.build import TOPICS, public_names
from docs.site.drawings import forms
from docs.site.kept import scores_of
from rocking.assessment.evidence import EVIDENCE
from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES, HistoryRow, PredictionRow, SpectrumRow
from rocking.described import described_values, parts_of
from rocking.products.trade.measure import what_follows as sentences_of_trade
from rocking.products.trade.rows import TradeRow
from rocking.pulses import PULSE_METHODS
from rocking.quantities import ACCELERATION_UNITS, counted
from rocking.records.formats import FORMATS
from rocking.sine_pulse import Regime
from rocking.structures.fields import Form
from rocking.study.products import PRODUCTS
from rocking.study.results import rows_of_table
from rocking.study.settings import Settings
from rocking.study.strengthening import StrengtheningRow
from rocking.tables import data_package, read_table

MEASURED = Path(__file__).parents[1] / "measured"
"""The tables that were measured once, each with what made it in figures.csv."""
FEWEST_INTERVALS = 40
"""Intervals below which a cell of coverage says nothing: of few draws there is a rate."""


def formats() -> str:
    """The formats that are read, where each comes from, and what it is recognised by."""
    rows = ((form.name, form.origin, form.signature, "yes" if form.plugin else "") for form in FORMATS)
    return table(("format", "origin", "recognised by", "offered to obspy"), rows)


def units() -> str:
    """The units that may be declared."""
    return ", ".join(f"`{unit}`" for unit in ACCELERATION_UNITS) + "."


def settings() -> str:
    """Every setting with its meaning, what is allowed, and its default."""
    return table(("setting", "meaning", "allowed", "default"), _setting_rows(Settings()))


def structures() -> str:
    """The drawing and the keys of every form of every type of structure."""
    return "\n\n".join(_structure(*form) for form in forms())


def evidence() -> str:
    """What speaks against the word of the mechanisms, in the order of looking."""
    says = (" ".join((kind.__doc__ or "").split()).partition(": ") for kind in EVIDENCE)
    return table(("evidence", "what it says"), ((what, words) for what, _, words in says))


def tables() -> str:
    """Every column of every table."""
    of_products = [rows_of_table(product, name) for product in PRODUCTS for name in product.tables]
    classes = dict.fromkeys(
        (
            *RECORD_TABLES,
            PredictionRow,
            HistoryRow,
            *SUMMARY_TABLES,
            *of_products,
            StrengtheningRow,
            SpectrumRow,
        )
    )
    package = json.loads(
        data_package("tables", {row_class: row_class.table.file_name for row_class in classes})
    )
    return "\n\n".join(map(_table_section, package["resources"]))


def equations() -> str:
    """The equations that the paper prints with a slip, with the numbers that decide."""
    from docs.paper.equations import equation_rows  # a second to import, as that below

    head = ("Eq.", "quantity", "by the printed form", "by the corrected form", "decides")
    body = []
    for row in equation_rows():
        numbers = (row.printed_number, row.corrected_number, row.deciding_number)
        texts = (f"{number:.5g}".replace("inf", "overturns") for number in numbers)
        body.append((row.equation, row.quantity, *texts))
    return table(head, body)


def pulse_methods() -> str:
    """The pulse methods of the registry, the default first."""
    methods = ((method.name, method.description) for method in PULSE_METHODS.values())
    return table(("choice", "the pulse that predicts"), methods)


def blocks() -> str:
    """The largest error of each equivalent block over a figure of the paper, for few of its curves."""
    from docs.paper.report import equivalence_figures

    errors: dict[tuple[str, ...], float] = {}
    for figure in equivalence_figures():
        for row in figure.rows:
            block = _BLOCKS[figure.name[-1]].get(row.panel)
            if block and row.curve in _CURVES:
                key = (figure.name[-1], row.curve, row.y_quantity.partition(",")[0], block)
                errors[key] = max(errors.get(key, 0.0), abs(row.y - 1))
    head = ("figure", "structure", "quantity", "block", "largest error")
    return table(head, ((*key, f"{100 * error:.1f} %") for key, error in errors.items()))


_PERIODS = {"a": "linearised", "c": "exact at rest"}
_TIMES = {"a": "a_sc", "b": "a_sc,alt", "c": "exact at rest"}
_BLOCKS = {"3": _PERIODS, "6": _PERIODS, "4": _TIMES, "7": _TIMES}
"""Block of each panel, by the figure of the paper."""
_CURVES = ("α = 0.1 rad", "α = 0.3 rad", "t/r = 0.13", "t/r = 0.25")
"""The slender and the stocky structures; the figures show all."""


def regimes() -> str:
    """The regimes of the closed form."""
    return table(("regime", "meaning"), ((regime.value, regime.sentence) for regime in Regime))


def api(topic: str) -> str:
    """The public names of a topic, each with its module and the first sentence of its docstring."""
    lines = []
    for name, module in public_names(topic):
        summary = " ".join((inspect.getdoc(getattr(rocking, name)) or "").partition("\n\n")[0].split())
        path = f"../../{module.replace('.', '/')}"
        file = (
            f"{path}/__init__.py"
            if (MEASURED.parents[1] / path.removeprefix("../../")).is_dir()
            else f"{path}.py"
        )
        lines.append(f"* [`rocking.{name}`]({file}): {summary}")
    return "\n".join(lines)


def measured_trade() -> list[TradeRow]:
    """The rows over all structures of the trade that was measured on the shipped example."""
    return [row for row in read_table(TradeRow, MEASURED) if row.structure == ""]


def what_follows() -> str:
    """What the measured trade says of the closed form against the integration, and the machine."""
    rows = measured_trade()
    lines = [f"* {sentence}" for sentence in sentences_of_trade(rows)]
    return "\n".join([*lines, f"* Measured on {rows[0].machine}."])


def trade() -> str:
    """The measured trade over all structures."""
    head = (
        "method",
        "stations",
        "cases",
        "median error",
        "wrong verdicts",
        "of them unsafe",
        "falls found",
        "false alarms",
        "ms a structure",
        "ms a record",
    )
    body = []
    for row in measured_trade():
        error = f"{100 * row.error:.2g} %"
        counts = (str(row.wrong_verdicts), str(row.unsafe_verdicts))
        found = (f"{row.falls_found} of {row.falls}", str(row.false_alarms))
        times = (f"{1e3 * row.cpu_s:.2g}", f"{1e3 * row.preparation_record_s:.2g}")
        of = f"{row.stations} of {counted(row.earthquakes, 'earthquake')}"
        body.append((row.method, of, str(row.cases), error, *counts, *found, *times))
    return table(head, body)


def earthquakes() -> str:
    """What the intervals over earthquakes hold, the least and the largest of populations or of structures."""
    rows = scores_of("cover_earthquakes")
    kinds = (
        "median",
        "annual rate",
        "share of 0.3, upper bound",
        "share of 0.3, both bounds",
        "expected falls",
    )
    columns = [(kind, is_real) for kind in kinds for is_real in (False, True)]
    body = []
    for part in dict.fromkeys(row.part for row in rows if not row.part.endswith(_ALONE)):
        cells = [part.replace(" earthquakes, ", " × ").removesuffix(" stations each")]
        for kind, is_real in columns:
            own, alone = (
                [
                    row.value
                    for row in rows
                    if row.part == called
                    and row.measure == f"{kind}: intervals that hold it"
                    and row.subject.endswith("real sites") == is_real
                    and row.cases >= FEWEST_INTERVALS
                ]
                for called in (part, part + _ALONE)
            )
            held = f"{100 * sum(own) / len(own):.0f}" if kind == "median" and own else _least_to_largest(own)
            before = f" ({_least_to_largest(alone)})" if alone and " 1 stations" not in part else ""
            cells.append(f"{held} %{before}" if held else "–")
        body.append(cells)
    names = (f"{kind}, {'real sites' if is_real else 'made'}" for kind, is_real in columns)
    return table(("earthquakes × stations", *names), body)


_ALONE = ", stations as if independent"


def _least_to_largest(shares: Iterable[float]) -> str:
    percent = [f"{100 * share:.0f}" for share in sorted(shares)]
    if not percent:
        return ""
    least, largest = min(percent, key=int), max(percent, key=int)
    return least if least == largest else f"{least}–{largest}"


def rates() -> str:
    """What the intervals of an annual rate hold: of each structure at real sites, of all populations; widest first."""
    rows = _coverage_of_rates()
    real = [row for row in rows if row["truth"] == "real"]
    stations = list(dict.fromkeys(row["stations"] for row in rows))
    widest = sorted(
        dict.fromkeys((row["subject"], row["slope"]) for row in real),
        key=lambda of: -max(float(row["reach"] or 0) for row in real if (row["subject"], row["slope"]) == of),
    )
    body = []
    for subject, slope in widest:
        own = {row["stations"]: row for row in real if (row["subject"], row["slope"]) == (subject, slope)}
        body.append((subject, slope, *(_cell_of_rate([own[count]]) for count in stations)))
    for slope in dict.fromkeys(row["slope"] for row in rows):
        made = [row for row in rows if row["truth"] == "made" and row["slope"] == slope]
        cells = (_cell_of_rate([row for row in made if row["stations"] == count]) for count in stations)
        body.append(("populations", slope, *cells))
    head = ("stations from", "slope", *(f"{count} stations" for count in stations))
    return table(head, body)


_RATES = {
    "told": "rates that are told",
    "held": "intervals that hold the rate",
    "held_by_ends": "ends that hold the rate where it is not told",
    "reach": "high end over rate",
}
"""What was measured of an annual rate, by the name of its column."""


def _coverage_of_rates() -> list[dict[str, str]]:
    """What was measured of each structure and population, at each slope and number of stations; "" of none."""
    values: dict[tuple[str, str], dict[str, str]] = {}
    for row in scores_of("cover_rate"):
        name = next((name for name, measure in _RATES.items() if measure == row.measure), None)
        if name is None:
            continue
        slope, stations = row.part.removeprefix("slope ").removesuffix(" stations").split(", ")
        subject, _, sites = row.subject.rpartition(", ")
        is_real = sites.endswith("real sites")
        names = (
            {"truth": "real", "subject": subject} if is_real else {"truth": "made", "subject": row.subject}
        )
        empty = dict.fromkeys(_RATES, "") if is_real else dict.fromkeys(_RATES, "") | {"told": "1"}
        own = values.setdefault(
            (row.subject, row.part), names | {"slope": slope, "stations": stations} | empty
        )
        own[name] = "" if math.isnan(row.value) else str(row.value)
    return list(values.values())


def _cell_of_rate(rows: Sequence[Mapping[str, str]]) -> str:
    """How often there is a rate, what its intervals hold, and their upper end over it, least to largest of rows."""

    def span(name: str, scale: float, unit: str) -> str:
        values = [scale * float(row[name]) for row in rows if row[name]]
        low, high = (f"{end:.3g}" if scale == 1 else f"{end:.0f}" for end in (min(values), max(values)))
        return f"{low}{unit}" if low == high else f"{low} to {high}{unit}"

    if not rows:
        return "–"
    told = [float(row["told"]) for row in rows]
    if max(told) == 0:
        return f"never given; ends hold {span('held_by_ends', 100, ' %')}"
    words = f"holds {span('held', 100, ' %')}, reach {span('reach', 1, '')}"
    return words if min(told) == 1 else f"given {span('told', 100, ' %')}; {words}"


def stands() -> str:
    """Of each kind of structure that stands by one of three words, how many fall as stacks of courses."""
    with (MEASURED / "stands.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    body = []
    for row in rows:
        cells = [row["structure"], f"{row['sites']} of {row['earthquakes']} earthquakes", row["trials"]]
        for word in ("mechanisms", "without", "with"):
            stand, fall = int(row[f"{word}_stand"]), int(row[f"{word}_fall"])
            if not stand:
                cells.append("none that lifts stands")
                continue
            low, high = (f"{100 * float(row[f'{word}_{end}']):.0f}" for end in ("low", "high"))
            between = f"{low}–{high} %" if fall else f"below {high} %"
            cells.append(f"{fall} of {stand} ({between})")
        body.append(cells)
    head = (
        "structure",
        "sites",
        "trials",
        "mechanisms alone",
        "the package without contact dynamics",
        "with it",
    )
    return table(head, body)


def pulse_shapes() -> str:
    """What each shape of pulse is worth on all records, with 90 % intervals."""
    scores: dict[str, dict[str, str]] = {}
    for row in scores_of("pulse_shapes"):
        if row.part == "all records":
            value, low, high = (f"{100 * end:.0f}" for end in (row.value, row.value_low, row.value_high))
            scores.setdefault(row.subject, {})[row.measure] = f"{value} % ({low}–{high})"
    measures = ("explained energy", "wrong verdicts", "unsafe verdicts", "median error of the rotation")
    rows = ((name, *(own[measure] for measure in measures)) for name, own in scores.items())
    return table(("pulse", *measures), rows)


GENERATED: Mapping[str, Callable[[], str]] = {
    part.__name__: part
    for part in (
        *(formats, units, settings, structures, evidence, tables, equations, pulse_methods, blocks, regimes),
        *(what_follows, trade, earthquakes, rates, stands, pulse_shapes),
    )
} | {f"api_{topic}": partial(api, topic) for topic in TOPICS}
"""What may stand behind `generated:` in a page."""
SLOW = frozenset({"equations", "blocks"})
"""What takes seconds to compute."""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table; a bar inside a cell is escaped."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(
        f"| {' | '.join(' '.join(cell.split()).replace('|', '&#124;') for cell in line)} |" for line in lines
    )


def _setting_rows(section: Any, above: str = "") -> Iterator[Sequence[str]]:
    for name in parts_of(type(section)):
        yield from _setting_rows(getattr(section, name), f"{above}{name}.")
    for described in described_values(type(section)).values():
        meaning = f"{described.meaning}, {described.unit}" if described.unit else described.meaning
        default = json.dumps(described.default).strip('"')
        yield f"`{above}{described.key}`", meaning, described.must, f"`{default}`"


def _structure(drawing: str, kind: str, form: Form) -> str:
    rows = []
    for key, field in form.keys.items():
        low, high = field.value.usual or (None, None)
        usual = "" if low is None else f"{low:g} to {high:g}{field.suffix}"
        required = "required" if field.required else ""
        rows.append((f"`{key}`", field.value.letter, field.meaning, field.must, usual, required))
    picture = f"![{form.meaning}](figures/{drawing}.svg)"
    keys = table(("key", "letter", "meaning", "allowed", "usual", ""), rows)
    return f"### `type: {kind}` — {form.meaning}\n\n{picture}\n\n{keys}"


def _table_section(resource: Mapping[str, Any]) -> str:
    """The columns of a table, as the data package has them."""
    keys = ("type", "unit", "description", "equation")
    rows = (
        (f"`{field['name']}`", *(field.get(key, "") for key in keys))
        for field in resource["schema"]["fields"]
    )
    body = table(("column", "type", "unit", "meaning", "equation"), rows)
    return f"## {resource['path']}\n\n{resource['description']}.\n\n{body}"
