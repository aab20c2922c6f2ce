"""Work against precision as one document: a table and a figure."""

import math
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from rocking.assessment.rows.of_comparison import CodeRow
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.printing import number
from rocking.reports.style import new_figure, styled, svg
from rocking.tables import read_rows

SMALLEST_ERROR = 1e-15
"""Smaller errors, down to none, are drawn here."""
_COLOURS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#666666")
_MARKERS = "osD^vPXH"
_STRUCTURES = ("block", "frame", "arch")


def comparison_report(folder: Path) -> bytes:
    """Return the PDF of a comparison whose table stands in `folder`."""
    rows = list(read_rows(CodeRow, folder / CodeRow.table.file_name))
    return compile_document("comparison/comparison.typ", comparison_data(rows))


def comparison_data(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return what the template is given."""
    cases = {row.case: row for row in rows}
    pulses = sum(row.motion == "pulse" for row in cases.values())
    return {
        "title": "Work against precision: the same cases through every code",
        "subtitle": f"{pulses} pulses and {len(cases) - pulses} stretches of records on a block, a frame and an arch "
        "of seven voussoirs; the reference is DOP853 of scipy at 1e-12, restarted at every sample and impact.",
        "table": _table(rows),
        "slow": _slow_table(rows),
        "figure": svg(work_figure(rows)),
        "alt": "Median error against median processor time of every code.",
    }


@styled
def work_figure(rows: Sequence[CodeRow]) -> Figure:
    """Draw error against processor time: small marks are cases, large ones the medians of a code and structure."""
    figure = new_figure(112, margins=(17, 4, 29, 6))
    panels = figure.subplots(1, len(_STRUCTURES), sharex=True, sharey=True, gridspec_kw={"wspace": 0.06})
    names = list(dict.fromkeys(row.code for row in rows))
    for panel, structure in zip(panels, _STRUCTURES, strict=True):
        for k, name in enumerate(names):
            own = [row for row in rows if (row.structure, row.code) == (structure, name) and _rocks(row)]
            if not own or "reference" in name:
                continue
            times, errors = [r.duration_s for r in own], [max(r.error, SMALLEST_ERROR) for r in own]
            look = {"color": _COLOURS[k % 8], "marker": _MARKERS[k % 8], "linestyle": "none"}
            panel.plot(times, errors, markersize=1.8, alpha=0.35, markeredgewidth=0, **look)
            panel.plot(
                median(times), median(errors), markersize=6.5, markeredgecolor="white", label=name, **look
            )
        panel.set(xscale="log", yscale="log", title=structure, xlabel="processor time of a response (s)")
        for axis in (panel.xaxis, panel.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0e}"))
            axis.set_major_locator(LogLocator(numticks=9))
            axis.set_minor_locator(NullLocator())
        panel.tick_params(axis="x", rotation=30)
        panel.grid(True)
        panel.set_axisbelow(True)
    panels[0].set_ylabel("error of the largest rotation, relative")
    handles: dict[str, Artist] = {}
    for panel in panels:
        panel.margins(x=0.08)
        handles |= dict(zip(*panel.get_legend_handles_labels()[::-1], strict=True))
    figure.legend(list(handles.values()), list(handles), loc="lower center", ncols=3)
    return figure


def _table(rows: Sequence[CodeRow]) -> dict[str, object]:
    groups: dict[tuple[str, str], list[CodeRow]] = {}
    for row in rows:
        groups.setdefault((row.structure, row.code), []).append(row)
    return printing.table_of(
        [groups[key] for key in sorted(groups, key=lambda key: _STRUCTURES.index(key[0]))],
        ("Structure", "0.6", "l", lambda own: own[0].structure),
        ("Code", "2", "l", lambda own: own[0].code),
        ("Cases", "0.45", "r", lambda own: printing.whole(len(own))),
        ("Rock", "0.4", "r", lambda own: printing.whole(sum(map(_rocks, own)))),
        ("Median error", "0.8", "r", lambda own: _quantile(own, 0.5)),
        ("95 % error", "0.8", "r", lambda own: _quantile(own, 0.95)),
        (
            "Other verdict",
            "0.7",
            "r",
            lambda own: printing.whole(sum(r.verdict_agrees is False for r in own)),
        ),
        ("No answer", "0.6", "r", lambda own: printing.whole(sum(math.isnan(r.rotation_ratio) for r in own))),
        ("Impacts missed", "0.9", "r", _missed),
        ("Time (ms)", "0.7", "r", _time),
    )


def _slow_table(rows: Sequence[CodeRow]) -> dict[str, object]:
    slow = [row for row in rows if row.code.startswith(("LMGC90", "OpenSees"))]
    return printing.table_of(
        slow,
        ("Case", "1.2", "l", lambda row: row.case),
        ("Code", "1.8", "l", lambda row: row.code),
        ("Reference", "0.8", "r", lambda row: printing.ratio(row.reference_rotation_ratio)),
        ("Extrapolated", "0.9", "r", lambda row: printing.ratio(row.rotation_ratio)),
        ("± bar", "0.7", "r", lambda row: number(row.rotation_ratio_error, 2)),
        ("Time (s)", "0.6", "r", lambda row: number(row.duration_s, 2)),
        ("Note", "1.8", "l", lambda row: printing.words(row.reason)),
    )


def _rocks(row: CodeRow) -> bool:
    """Whether there is an error to speak of: both rock."""
    return row.error == row.error and 0 < row.reference_rotation_ratio < math.inf


def _quantile(rows: Sequence[CodeRow], share: float) -> str:
    errors = sorted(row.error for row in rows if _rocks(row))
    return number(errors[min(int(share * len(errors)), len(errors) - 1)], 2) if errors else printing.NOTHING


def _missed(rows: Sequence[CodeRow]) -> str:
    counted = [row for row in rows if row.missed_impacts is not None]
    if not counted:
        return printing.NOTHING
    return f"{sum(row.missed_impacts or 0 for row in counted)} of {sum(row.reference_impacts for row in counted)}"


def _time(rows: Sequence[CodeRow]) -> str:
    spent = [row.duration_s for row in rows if row.duration_s == row.duration_s]
    return number(1e3 * median(spent), 2) if spent else printing.NOTHING
