"""Listing: what a folder's files are, as a table a person reads before trusting them."""

from collections.abc import Sequence

from rocking.quantities import GRAVITY
from rocking.records.folder import ListedChannel, ListedFile

_HEAD = ("file", "component", "format", "step s", "samples", "PGA g", "PGV m/s", "status")
_WIDEST = (40, 16, 24, 9, 9, 9, 9, 400)
_RIGHT = range(3, 7)


def listing_text(listed: Sequence[ListedFile]) -> str:
    """Return one line for each channel of each file: format, step, samples, PGA, PGV, component and status."""
    rows = [_HEAD, *(line for file in listed for line in _lines(file))]
    cells = [[_short(text, width) for text, width in zip(row, _WIDEST, strict=True)] for row in rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(_HEAD))]
    return (
        "\n".join("  ".join(_placed(row, i, widths[i]) for i in range(len(_HEAD))).rstrip() for row in cells)
        + "\n"
    )


def _lines(file: ListedFile) -> list[tuple[str, ...]]:
    if not file.channels:
        return [(file.file, "", "", "", "", "", "", file.status)]
    return [
        (file.file if i == 0 else "", *_measures(channel), file.status if i == 0 else "")
        for i, channel in enumerate(file.channels)
    ]


def _measures(channel: ListedChannel) -> tuple[str, ...]:
    peak = channel.peak_acceleration
    return (
        channel.component,
        channel.format,
        _number(channel.time_step),
        str(channel.samples),
        "" if peak is None else f"{peak / GRAVITY:.3g}",
        _number(channel.peak_velocity, "{:.3g}"),
    )


def _number(value: float | None, form: str = "{:g}") -> str:
    return "" if value is None else form.format(value)


def _short(text: str, width: int) -> str:
    return text if len(text) <= width else text[: width - 1] + "…"


def _placed(row: Sequence[str], i: int, width: int) -> str:
    return row[i].rjust(width) if i in _RIGHT else row[i].ljust(width)
