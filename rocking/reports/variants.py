"""The strip of the variants of a structure: on one scale, with verdict, reserve, notes, and difference to the first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING

from rocking.errors import FaultError, one_structure
from rocking.reports.drawings import drawn_by_hand, room, sketch
from rocking.reports.kinds import ReportKind
from rocking.reports.pages import Chip, Strip, VariantCell
from rocking.reports.printing import chip
from rocking.reports.sentences import Sentences
from rocking.warnings import RockingWarning

if TYPE_CHECKING:
    from rocking.assessment.variants import VariantRow
    from rocking.structures import Structure

_WIDTH, _HEIGHT = 30.0, 24.0
"""Size of a drawing, mm."""
_DRAWN = 0.5
"""Share of the critical rotation at which it is drawn."""


def strips(
    made: Mapping[str, Sequence[VariantRow]],
    structures: Mapping[str, Structure],
    words: Sentences | None = None,
    notes: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> list[Strip]:
    """Return a strip for each structure that has variants, with a cell for each of these.

    made: the variants of each. structures: by the names of the scenes. words: the language. notes: what else
    there is to say of a scene, by its name.
    """
    said = words or Sentences()
    return [
        Strip(
            name, _cells([variant for variant in row if variant.name in structures], structures, said, notes)
        )
        for name, row in made.items()
    ]


def _cells(
    row: Sequence[VariantRow],
    structures: Mapping[str, Structure],
    words: Sentences,
    notes: Mapping[str, Sequence[str]],
) -> tuple[VariantCell, ...]:
    turned = {}
    scales = []
    for variant in row:
        # One that cannot be drawn costs no other; its checks and its reports say why.
        with suppress(FaultError), one_structure(variant.name):
            structure = structures[variant.name]
            side = structure.mechanism().positive
            rotation = _DRAWN * side.critical_rotation if side.can_overturn else 0.0
            scales.append(room(structure, rotation, _WIDTH, _HEIGHT)[0])
            turned[variant.name] = rotation
    return tuple(
        _cell(
            variant,
            structures[variant.name],
            turned[variant.name],
            min(scales),
            words,
            [
                *notes.get(variant.name, ()),
                *_changes(structures.get(variant.structure), structures[variant.name], words),
            ],
        )
        for variant in row
        if variant.name in turned
    )


def _cell(
    variant: VariantRow,
    structure: Structure,
    rotation: float,
    scale: float,
    words: Sentences,
    notes: Sequence[str],
) -> VariantCell:
    conclusion = variant.conclusion
    shapes = sketch(structure, rotation, _WIDTH, _HEIGHT, scale)
    verdict = Chip(
        verdict=words.of(RockingWarning(ReportKind.NOT_JUDGED)),
        share="",
        fill="#ffffff",
        ink="#000000",
        hatched=False,
    )
    reserve = ""
    if conclusion is not None:
        decision = conclusion.row.decision
        share = words.decimal(decision.share_in_words) if not math.isnan(decision.share) else ""
        verdict = chip(decision.verdict, share, words.verdict(decision.verdict))
        figures = words.decimal(conclusion.row.reserve.in_figures if conclusion.row.reserve else "")
        if figures:
            alone = bool(conclusion.row.reserve_warnings)
            kind = ReportKind.RESERVE_OF_MECHANISM if alone else ReportKind.RESERVE_OF_VARIANT
            reserve = words.of(RockingWarning.of(kind, reserve=figures))
    return VariantCell(
        drawing=drawn_by_hand(shapes, _WIDTH, _HEIGHT, f"{variant.name}, turned, and at rest."),
        name=variant.variant,
        chip=verdict,
        reserve=reserve,
        notes=tuple(notes),
        difference=_difference(variant, words),
    )


def _changes(first: Structure | None, own: Structure, words: Sentences) -> Iterator[str]:
    """Yield what a variant changes of the first, as it was typed; nothing of the first itself."""
    if first is None or first is own:
        return
    before = {given.field.key: given.text for given in first.described.values}
    now = {given.field.key: given for given in own.described.values}
    changed = [words.described(given) for key, given in now.items() if before.get(key) != given.text]
    left = [words("no {key}", key=key) for key in before if key not in now]
    if changed or left:
        yield ", ".join([*changed, *left])


def _difference(variant: VariantRow, words: Sentences) -> str:
    """By how much the share and the reserve differ from those of the first, where both are known."""
    if variant.name == variant.structure:
        return words.of(RockingWarning(ReportKind.THE_FIRST))
    differences = []
    if not math.isnan(variant.reserve_ratio):
        ratio = words.number(variant.reserve_ratio, 2)
        differences.append(RockingWarning.of(ReportKind.RESERVE_DIFFERS, ratio=ratio))
    if not math.isnan(variant.share_difference):
        points = round(100 * variant.share_difference)
        signed = f"{points:+d}".replace("-", "−")
        is_shown = points and variant.shows_difference
        differences.append(
            RockingWarning.of(ReportKind.SHARE_DIFFERS, points=signed)
            if is_shown
            else RockingWarning(ReportKind.SAME_SHARE)
        )
    return ", ".join(map(words.of, differences or [RockingWarning(ReportKind.NO_DIFFERENCE)]))


def strips_in_html(made: Sequence[Strip]) -> str:
    """Return the strips as HTML."""
    parts = []
    for strip in made:
        parts.append(f'<h3>{escape(strip.name)}</h3><div class="strip">')
        for cell in strip.cells:
            verdict = cell.chip.verdict
            css = verdict.removeprefix("? ").replace(" ", "-")
            lines = [cell.reserve, *cell.notes, cell.difference]
            texts = "".join(f"<p>{escape(line)}</p>" for line in lines if line)
            parts.append(
                f"<figure>{cell.drawing.svg}<figcaption><strong>{escape(cell.name)}</strong>"
                f'<p><span class="cell {css}">{escape(verdict)} {escape(cell.chip.share)}</span></p>{texts}'
                "</figcaption></figure>"
            )
        parts.append("</div>")
    return "".join(parts)
