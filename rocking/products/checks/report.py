"""The structures at the design level: of each a page that an engineer signs, and the basis of its checks behind it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields

import numpy as np

from rocking.assessment.conclusion import TO_CHECK, Conclusion
from rocking.assessment.decide import ORDER, Verdict
from rocking.assessment.reserve import Reserve
from rocking.assessment.variants import variants
from rocking.codes.check import (
    LEAST_SHARE,
    Check,
    CodeTerms,
    DynamicCheck,
    Role,
    StructureCheck,
    says_nothing,
)
from rocking.codes.code_capacity import LIMIT_STATES
from rocking.codes.design_spectrum import DesignSpectrum, NtcSpectrum, PointSpectrum
from rocking.codes.kinds import CheckKind
from rocking.codes.selection import SETS, Selection
from rocking.earthquakes.sample import interval_words
from rocking.errors import ErrorKind, RockingError, one_structure
from rocking.floors.place import GROUND, Place
from rocking.floors.support import Support
from rocking.products.checks.conclusion import CodeConclusion, code_conclusions
from rocking.products.checks.figures import bars_figure, basis_figure, selection_figure
from rocking.products.checks.pages import Answer, Basis, SetFigure, Sheet, SignWords, StructuresPage, Sure
from rocking.products.checks.rows import KINDS, code_check_rows
from rocking.quantities import GRAVITY, percent
from rocking.reports.pages import Cell, Fact, Footer, PageSettings, PageTable, Strip
from rocking.reports.printing import UNITS_IN_WORDS, displaying, stamp, strong, table, unit_of
from rocking.reports.printing import words as or_a_dash
from rocking.reports.sentences import Sentences
from rocking.reports.style import picture
from rocking.reports.variants import strips
from rocking.structures import Structure
from rocking.structures.crackable import Crackable
from rocking.structures.structure import AS_DESCRIBED, Candidate
from rocking.warnings import Kind, Phrase, RockingWarning

_OFTEN = 0.1
"""Share of the records beyond which a structure that is verified is said to contradict it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CheckedStructure:
    """The checks of one structure at one place, and what the study says of it there.

    untied: the checks of a structure with ties without them; None where it has none, or cannot stand so. variant_of:
    the structure of which it is a variant; "" of one that is none. worst: what becomes of it under its worst record.
    place, support: where it stands, and of what stands on a support one along its axis, None on the ground below it.
    checked: None where it could not be checked, and `refusal` then says why. overturning_share: mean over the stations
    of the study, of each the mean over its records, nan without any; share_interval: its 90 % interval by earthquakes;
    records, stations, earthquakes: how many there are, but for those of which that is unknown; still: stations at
    which nothing lifts it. verdicts: stations by the worst verdict on it there, and verdict_warnings: what may make
    one worse than said. reserves: under each record of the study under which one was sought; reserve_warnings: kinds
    of warning for which they may be too high. mechanisms: all in which it may fall. mechanism_shares: of each that was
    followed the share of its members that overturns, the mean over stations; largest_forces: the largest force of each
    of its holds over all records, N per metre, nan where it was not followed as recorded. peaks: the least and the
    largest peak acceleration of the records of the study as they act, m/s². warnings: on the structure and the design
    level.
    """

    name: str
    structure: Structure
    checked: StructureCheck | None
    place: Place = GROUND
    support: Support | None = None
    refusal: str | RockingWarning = ""
    untied: StructureCheck | None = None
    variant_of: str = ""
    worst: Conclusion | None = None
    overturning_share: float = math.nan
    share_interval: tuple[float, float] = (math.nan, math.nan)
    records: int = 0
    stations: int = 0
    earthquakes: int = 0
    still: int = 0
    verdicts: Mapping[Verdict, int] = field(default_factory=dict)
    verdict_warnings: Sequence[Kind] = ()
    reserves: Sequence[Reserve] = ()
    reserve_warnings: Sequence[Kind] = ()
    mechanisms: Sequence[Candidate] = ()
    mechanism_shares: Mapping[Candidate, float] = field(default_factory=dict)
    largest_forces: Mapping[Candidate, Sequence[float]] = field(default_factory=dict)
    peaks: tuple[float, float] = (math.nan, math.nan)
    warnings: Sequence[RockingWarning] = ()

    @property
    def period(self) -> float | None:
        """Its place on the axis of a support: a period, s, or 0 of the ground below it; None on the ground itself."""
        return self.place.period_of(self.support)

    @property
    def has_ties(self) -> bool:
        """Whether ties hold it."""
        return bool(getattr(self.structure, "tie_heights", ()))


def structures_data(
    structures: Sequence[CheckedStructure],
    spectrum: DesignSpectrum,
    settings: PageSettings,
    terms: CodeTerms | None = None,
    selection: Selection | None = None,
    without_sets: str | RockingWarning = "",
    unread: Sequence[str] = (),
    faults: list[RockingWarning] | None = None,
) -> StructuresPage:
    """Return the pages.

    structures: those of one name, at the periods of its support, make one page. terms: what a structure that could not
    be checked would have been checked on. selection: the sets of the dynamic check, None without; without_sets: why
    there are none. unread: the records of the pool that could not be read, each with its reason. faults: takes a
    warning on each structure whose page could not be made for a fault of this package.
    """
    words = Sentences(settings.language)
    with displaying(settings):
        spectra: tuple[SetFigure, ...] = ()
        motions = PageTable()
        if selection is not None:
            drawn = picture(
                selection_figure(selection),
                words("Spectra of the set of records and their mean with the design spectrum."),
            )
            spectra = (SetFigure(drawn, _selection_words(selection, words)),)
            motions = _motion_table(selection, words)
        said = {field.name: words(str(field.default)) for field in fields(SignWords)}
        return StructuresPage(
            title=words("Checks at the design level"),
            language=settings.language,
            about=tuple(Fact(label=words(fact.label), text=fact.text) for fact in settings.about),
            footer=Footer(
                made=f"{words('Made with the Python package rocking')} {stamp(settings)}",
                page=words("Page {page} of {pages}", page="{page}", pages="{pages}"),
                continued=words("Continued from page {page}", page="{page}"),
                units=words(UNITS_IN_WORDS[settings.display_units]),
            ),
            words=SignWords(**said),
            notices=(words("The dynamic check was not made: {why}", why=words.reason(without_sets)),)
            if without_sets
            else (),
            unread=words(
                "Not used for the sets, as they could not be read: {names}.", names="; ".join(unread)
            )
            if unread
            else "",
            spectra=spectra,
            motions=motions,
            sheets=_sheets(
                structures, spectrum, terms or CodeTerms(), words, [] if faults is None else faults
            ),
        )


def _sheets(
    structures: Sequence[CheckedStructure],
    spectrum: DesignSpectrum,
    terms: CodeTerms,
    words: Sentences,
    faults: list[RockingWarning],
) -> tuple[Sheet, ...]:
    """The page of each structure: at the worst period of its support, with the others as lines."""
    by_name: dict[str, list[CheckedStructure]] = {}
    for checked_structure in structures:
        by_name.setdefault(checked_structure.name, []).append(checked_structure)
    rows = (
        row
        for checked_structure in structures
        if checked_structure.checked
        for row in code_check_rows(
            checked_structure.name, checked_structure.checked, checked_structure.period
        )
    )
    concluded = {conclusion.structure: conclusion for conclusion in code_conclusions(rows)}
    groups: dict[str, list[str]] = {}
    for name, (page, *_) in by_name.items():
        if page.variant_of in by_name:
            groups.setdefault(page.variant_of, []).append(name)
    worst = [page.worst for page, *_ in by_name.values() if page.worst]
    compared = variants(groups, worst)
    drawn = {name: page.structure for name, (page, *_) in by_name.items()}
    notes = {name: _ratios_and_conclusion(conclusion, words) for name, conclusion in concluded.items()}
    strip_of = {strip.name: strip for strip in strips(compared, drawn, words, notes)}
    pages = []
    for name, everywhere in by_name.items():
        conclusion = concluded.get(name)
        page = next(
            (
                there
                for there in everywhere
                if conclusion and there.checked and there.period == conclusion.period
            ),
            everywhere[-1],
        )
        checked = page.checked
        level = words(
            "Design level: {spectrum} · limit state {state} · FC {factor}",
            spectrum=_spectrum_words(spectrum, words),
            state=checked.limit_state if checked else terms.limit_state,
            factor=words.plain(checked.governing.confidence_factor if checked else terms.confidence_factor),
        )
        place = _place(page, words)
        why = page.refusal
        if checked is not None and conclusion is not None:
            try:
                with one_structure(name):
                    headline, details = _conclusion(page, checked, conclusion, spectrum, words)
                    # Once, with the structure that the others vary.
                    variant_strips = (strip_of[name],) if name in strip_of else ()
                    bars = picture(
                        bars_figure(page.structure, checked, page.untied, words),
                        words(
                            "{name}: the mechanism that governs, and capacity over demand of each check.",
                            name=name,
                        ),
                    )
                    answer = Answer(
                        way=words.phrase(checked.governing.description),
                        bars=(bars,),
                        sure=_sure(page, checked.dynamic, words),
                        assumptions=tuple(_assumptions(page, checked, words)),
                        basis=_basis(page, checked, conclusion, everywhere, variant_strips, words),
                    )
                    pages.append(
                        Sheet(
                            name=name,
                            level=level,
                            place=place,
                            headline=headline,
                            met=conclusion.verified,
                            details=details,
                            answers=(answer,),
                        )
                    )
                    continue
            except RockingError as error:
                why = error.warning or str(error)
        if isinstance(why, RockingWarning) and why.kind is ErrorKind.FAULT:
            faults.append(why)
        pages.append(
            Sheet(
                name=name,
                level=level,
                place=place,
                headline=words("Not checked."),
                met=False,
                # What was typed may be why it could not be checked.
                details=(
                    words("It could not be checked: {why}", why=words.reason(why)),
                    *_to_check(page, words),
                ),
                answers=(),
            )
        )
    return tuple(pages)


def _ratios_and_conclusion(conclusion: CodeConclusion, words: Sentences) -> tuple[str, str]:
    """The ratios of the checks of a structure and what follows from them, each in a line."""
    ratios = (
        f"{words(kind)} {words('falls') if ratio == 'falls' else words.decimal(ratio)}"
        for kind, ratio in conclusion.ratios.items()
    )
    key = "verified by {clause}" if conclusion.verified else "not verified by {clause}"
    return ", ".join(ratios), words(key, clause=conclusion.decisive.clause)


def _place(page: CheckedStructure, words: Sentences) -> str:
    """Where the structure stands on this page, where that is one place of several."""
    if not page.period:
        return ""
    place = words("{name} with T_b {period} s", name=page.place.name, period=words.number(page.period))
    return words("At its worst, {place}.", place=place) if len(page.place.supports) > 1 else f"{place}."


def _conclusion(
    page: CheckedStructure,
    checked: StructureCheck,
    conclusion: CodeConclusion,
    spectrum: DesignSpectrum,
    words: Sentences,
) -> tuple[str, tuple[str, ...]]:
    """The conclusion as a headline, and what else there is to say."""
    decisive = conclusion.decisive
    also = [check.clause for check in conclusion.checks if check.part == Role.COUNTS_TOO]
    overruled = [words(f"{check.check} check") for check in conclusion.checks if check.part == Role.OVERRULED]
    needs_its_tie = page.has_ties and not (page.untied and page.untied.verified)
    if conclusion.verified:
        headline = words(
            "Verified by {clause}{also}{tied}.",
            clause=decisive.clause,
            also=words(", and by {clause}", clause=words.listed(also[::-1])) if also else "",
            tied=words(", only with its tie") if needs_its_tie else "",
        )
    else:
        headline = _refusal(checked, words)
    details = []
    if overruled:
        details.append(
            words(
                "Met: {checks}; but {clause}, which is more detailed, decides.",
                checks=words.listed(overruled),
                clause=decisive.clause,
            )
        )
    dynamic = checked.dynamic
    if conclusion.verified and dynamic:
        others = words.percents(*dynamic.interval)
        unknown = says_nothing(dynamic.interval)
        details.append(
            words(
                "The pool has too few stations to say whether sets of other stations would meet the dynamic "
                "check."
            )
            if unknown
            else words("Under sets of other stations the dynamic check is met by {share}.", share=others)
        )
    if dynamic is None:
        # Why there are no sets stands above the page.
        if checked.warning is not None and checked.warning.kind is CheckKind.NO_DISPLACEMENT:
            details.append(words("It cannot overturn, so that the linear check alone is made."))
    elif checked.part_of(dynamic) is Role.NO_ANSWER:
        details.append(
            words(
                "The dynamic check has no answer: {sets} other sets of records lie within the limits and "
                "{asked} are required.",
                sets=dynamic.sets,
                asked=SETS,
            )
        )
    if page.has_ties:
        untied = page.untied.decisive if page.untied else None
        if untied is None:
            details.append(words("Without its tie it does not stand."))
        else:
            details.append(
                words(
                    "Without its tie it is verified by {clause}."
                    if untied.passed
                    else "Without its tie {clause} is not met.",
                    clause=untied.clause,
                )
            )
    details += _were_it_unknown(checked, words)
    details += _to_check(page, words)
    if finding := _finding(page, conclusion, spectrum, words):
        details.append(finding)
    return headline, tuple(details)


def _to_check(page: CheckedStructure, words: Sentences) -> list[str]:
    """What has to be checked of what was typed, before anything else is read."""
    return [words.of(warning) for warning in page.warnings if warning.kind in TO_CHECK]


def _were_it_unknown(checked: StructureCheck, words: Sentences) -> list[str]:
    """What the kinematic check would say of a structure whose crack is known, were it not."""
    if checked.were_it_unknown is None:
        return []
    other = checked.were_it_unknown.checks[-1]
    opens = next(
        words.phrase(mechanism.description)
        for mechanism in checked.were_it_unknown.mechanisms
        if mechanism.description == other.mechanism
    )
    key = (
        "Were its crack not known, {clause} would be met as well (capacity over demand {ratio}: {mechanism})."
        if other.passed
        else "Were its crack not known, {clause} would not be met (capacity over demand {ratio}: {mechanism})."
    )
    return [words(key, clause=other.clause, ratio=ratio_words(other, words), mechanism=opens)]


def _refusal(checked: StructureCheck, words: Sentences) -> str:
    """The conclusion that it is not verified, with the finding of the check that decides."""
    decisive = checked.decisive
    assert decisive is not None
    if isinstance(decisive, DynamicCheck):
        if decisive.exceeding:
            return words(
                "Not verified: d₀ is exceeded under {exceeding} of {motions} motions ({clause}).",
                exceeding=decisive.exceeding,
                motions=decisive.motions,
                clause=decisive.clause,
            )
        if decisive.met_by_the_set:
            return words(
                "Not verified: {share} of {sets} sets of records meet {clause}, and {least} % are required.",
                share=words.percents(decisive.share),
                sets=decisive.sets,
                clause=decisive.clause,
                least=f"{100 * LEAST_SHARE:.0f}",
            )
    return words(
        "Not verified: {clause} gives {ratio}.", clause=decisive.clause, ratio=ratio_words(decisive, words)
    )


def _finding(
    page: CheckedStructure, conclusion: CodeConclusion, spectrum: DesignSpectrum, words: Sentences
) -> str:
    """What the records of the study say otherwise, and why that is no contradiction; "" where they agree."""
    low, high = (words.number(peak / GRAVITY, 2) for peak in page.peaks)
    of_records = {
        "level": words.number(float(spectrum.acceleration(0.0)) / GRAVITY, 2),
        "low": low,
        "high": high,
        "clause": conclusion.decisive.clause,
        "stations": words.counted(page.stations, "station"),
        "share": words.decimal(percent(page.overturning_share)) if page.stations else "",
    }
    if conclusion.verified and page.overturning_share > _OFTEN:
        return words(
            "Two questions, no contradiction: {clause} is met at the design level, whose peak is {level} g; "
            "the records of the study, of {stations}, act with peaks from {low} to {high} g, and {share} % "
            "of its members overturn under them.",
            **of_records,
        )
    if not conclusion.verified and page.overturning_share == 0 and math.isnan(conclusion.decisive.sets_share):
        return words(
            "Two questions, no contradiction: {clause} is not met at the design level, whose peak is {level}"
            " g; the records of the study, of {stations}, act with peaks from {low} to {high} g, and no "
            "member overturns under them.",
            **of_records,
        )
    return ""


def _sure(page: CheckedStructure, dynamic: DynamicCheck | None, words: Sentences) -> tuple[Sure, ...]:
    """How sure the conclusion is: figures, each with what it is the figure of."""
    lines: list[tuple[str, str]] = []
    if dynamic is not None:
        lines.append(
            (
                words.percents(dynamic.share),
                words("of {sets} sets of records meet the dynamic check;", sets=dynamic.sets),
            )
        )
        if not says_nothing(dynamic.interval):
            interval = words.phrase(interval_words(dynamic.earthquakes))
            lines.append(
                (
                    words.percents(*dynamic.interval),
                    words("of sets of other stations would ({interval});", interval=interval),
                )
            )
    if page.stations:
        low, high = (words.decimal(percent(bound)) for bound in page.share_interval)
        of_it = {
            "records": words.counted(page.records, "record"),
            "stations": words.counted(page.stations, "station"),
            "earthquakes": words.counted(page.earthquakes, "earthquake"),
            "interval": words.phrase(interval_words(page.earthquakes)),
            "still": words("; nothing lifts it at {still} of these stations", still=page.still)
            if page.still
            else "",
        }
        share = f"{words.decimal(percent(page.overturning_share))}\u00a0%"
        lines.append(
            (
                share,
                words(
                    "of its members overturn under the study's {records} of {stations} of {earthquakes} "
                    "({interval} by earthquakes: {low} to {high} %){still};",
                    low=low,
                    high=high,
                    **of_it,
                ),
            )
        )
    if page.reserves:
        lines.append(_reserve(page, words))
    return tuple(Sure(value=value, text=text) for value, text in lines)


def _reserve(page: CheckedStructure, words: Sentences) -> tuple[str, str]:
    """By how much the records may be stronger, and what there is to say of it: its caveat goes where it goes."""
    lows = np.array([reserve.low for reserve in page.reserves])
    reached = lows[~np.isnan(lows)]
    limit = max(reserve.limit for reserve in page.reserves)
    warnings = ""
    of_all = words.counted(lows.size, "record")
    if lows.size < page.records:  # on a support it is searched at the worst period of each record
        of_all = words(
            "{count} of {records}, of which this is the worst period", count=of_all, records=page.records
        )
    if reached.size and lows.size > 1:
        middle = float(np.quantile(np.where(np.isnan(lows), np.inf, lows), 0.5, method="lower"))
        value = f"> {limit:g}\u00a0×" if math.isinf(middle) else f"{words.number(middle, 2)}\u00a0×"
        warnings += words("; the median over {count} is {value}", count=of_all, value=value)
    if page.reserve_warnings:
        reasons = words.listed([words.of(RockingWarning(kind)) for kind in page.reserve_warnings])
        warnings += words(
            "; this is the reserve of the mechanism alone, and too high where {reasons}", reasons=reasons
        )
    if not reached.size:
        return f"{limit:g}\u00a0×", words(
            "applied to any record lets fewer than 5 % of the members overturn{warnings}.", warnings=warnings
        )
    return f"{words.number(reached.min(), 2)}\u00a0×", words(
        "applied to the most demanding record lets 5 % of the members overturn{warnings}.", warnings=warnings
    )


def _assumptions(page: CheckedStructure, checked: StructureCheck, words: Sentences) -> list[str]:
    """What the checks take for given, to be confirmed on site."""
    structure = page.structure
    mechanism = checked.governing
    given = [value for value in structure.described.values if value.value is not False]
    sizes = ", ".join(words.described(value) for value in given)
    lines = [words("{sizes}.", sizes=sizes[:1].upper() + sizes[1:])]
    restitution = min(side.restitution for side in structure.mechanism().sides)
    lines.append(
        words("Restitution η = {restitution} at each impact.", restitution=words.number(restitution, 2))
    )
    if isinstance(structure, Crackable) and structure.known_crack:
        known = words.of(structure.known_crack)
        lines.append(f"{known[:1].upper()}{known[1:]}.")
    lines += [words.of(warning) for warning in page.warnings if warning.kind not in TO_CHECK]
    lines.append(words("Joints do not slide; each part between its cracks stays one body."))
    if getattr(structure, "compressive_strength", None) is None:
        lines.append(words("The masonry does not crush at its edges."))
    lines.append(
        words(
            "FC = {factor}, as the level of knowledge requires.",
            factor=words.plain(mechanism.confidence_factor),
        )
    )
    if mechanism.elastic_period:
        lines.append(
            words(
                "It is free to vibrate with T₀ = {period} s, as given (C8.7.1.7).",
                period=words.number(mechanism.elastic_period),
            )
        )
    if math.isfinite(mechanism.support_loss):
        lines.append(
            words(
                "What it carries falls at a displacement of {displacement} of the corner that moves "
                "farthest, as given.",
                displacement=words.quantity(mechanism.support_loss, "m"),
            )
        )
    strengths = [tie.tie.strength for capacity in checked.mechanisms for tie in capacity.static.side.ties]
    strengths += [restraint.ties for restraint in checked.restraints]
    if any(map(math.isinf, strengths)):
        lines.append(
            words("A tie has no strength: it is assumed never to break, and its force is not checked.")
        )
    lines += [words.of(assumption) for assumption in structure.assumptions]
    if page.support is not None:
        modes = [
            words(
                "{period} s with Γψ = {participation}",
                period=words.number(mode.period),
                participation=words.number(mode.participation),
            )
            for mode in page.support.modes
        ]
        lines.append(
            words(
                "It stands on {name}, a support of period {modes}: the demands are those there (C7.2.5 to "
                "C7.2.10), and the dynamic check follows the motion there.",
                name=page.place.name,
                modes=words.listed(modes),
            )
        )
    return lines


def _basis(
    page: CheckedStructure,
    checked: StructureCheck,
    conclusion: CodeConclusion,
    everywhere: Sequence[CheckedStructure],
    variant_strips: tuple[Strip, ...],
    words: Sentences,
) -> Basis:
    """The page behind it: the capacity curve, the checks with their values, the other places, and the study's share."""
    others = [checked_structure for checked_structure in everywhere if checked_structure is not page]
    figure = picture(
        basis_figure(page.structure, checked, words),
        words(
            "{name}: drawing with sizes and loads, and capacity curve with limit displacements.",
            name=page.name,
        ),
    )
    return Basis(
        title=words("Basis of the checks: {name}", name=page.name),
        figure=(figure,),
        checks=_check_table(checked, words),
        mechanisms=_mechanism_table(page, words) if len(page.mechanisms) > 1 else PageTable(),
        sentences=tuple(_sentences(page, checked, words)),
        periods=_period_table(others, conclusion, words) if others else PageTable(),
        share=_share(page, words),
        strips=variant_strips,
    )


def _check_table(checked: StructureCheck, words: Sentences) -> PageTable:
    heads = [
        (words("Check"), "0.9", "l"),
        (words("Clause"), "auto", "l"),
        (words("Capacity"), "1.0", "r"),
        (words("Demand"), "1.0", "r"),
        (words("Ratio [-]"), "auto", "r"),
        (words("Result"), "1.0", "l"),
        (words("Role"), "0.9", "l"),
        (words("Mechanism that decides"), "1.5", "l"),
    ]
    governing = {mechanism.description: mechanism for mechanism in checked.mechanisms}
    lines: list[list[Cell]] = [
        [
            words(KINDS[check.clause]),
            check.clause,
            _valued(check, check.capacity, words),
            _valued(check, check.demand, words),
            ratio_words(check, words),
            strong(words(check.outcome)),
            words(checked.part_of(check).in_words),
            words.phrase(governing[check.mechanism].description),
        ]
        for check in checked.checks
    ]
    return table(heads, lines)


def _mechanism_table(page: CheckedStructure, words: Sentences) -> PageTable:
    """The weakest mechanism of each kind, and those that were followed, with what holds them back."""
    heads = [
        (words("Mechanism"), "2.2", "l"),
        ("λ [g]", "auto", "r"),
        ("p [rad/s]", "auto", "r"),
        (words("Overturns"), "auto", "r"),
        (words("Held by: force when it starts (largest in motion, without impacts)"), "2", "l"),
    ]
    weakest: dict[tuple[str, int], Candidate] = {}
    for candidate in sorted(page.mechanisms, key=lambda candidate: candidate.uplift_multiplier):
        weakest.setdefault((candidate.name, candidate.sign), candidate)
    lines: list[list[Cell]] = []
    for candidate in page.mechanisms:
        share = page.mechanism_shares.get(candidate)
        if share is None and candidate not in weakest.values():
            continue
        multiplier = candidate.uplift_multiplier
        lines.append(
            [
                _falls(candidate, words),
                words.number(multiplier) if math.isfinite(multiplier) else words("held shut"),
                "–" if candidate.refusal else words.number(candidate.side.frequency_parameter),
                "–" if share is None else words.percents(share),
                _holds(candidate, page.largest_forces.get(candidate, ()), words),
            ]
        )
    return table(heads, lines)


def _falls(candidate: Candidate, words: Sentences) -> str:
    """What falls, and where it opens."""
    opens = candidate.description
    while isinstance(opens, Phrase) and "opens" in opens.values:
        opens = opens.values["opens"]  # type: ignore[assignment]
    is_nowhere = opens == AS_DESCRIBED or (isinstance(opens, Phrase) and "part" in opens.values)
    name = words.phrase(candidate.name)
    return name if is_nowhere else f"{name}: {words.phrase(opens)}"


def _holds(candidate: Candidate, largest_forces: Sequence[float], words: Sentences) -> str:
    """The force at each height at which something holds it, as it starts and the largest over the records."""
    holds = candidate.reactions if math.isfinite(candidate.uplift_multiplier) else ()
    texts = []
    for place, hold in enumerate(holds):
        largest = largest_forces[place] if place < len(largest_forces) else math.nan
        key = (
            "{kind} at {height} m: {force} kN/m"
            if math.isnan(largest)
            else "{kind} at {height} m: {force} ({largest}) kN/m"
        )
        texts.append(
            words(
                key,
                kind=words(hold.kind),
                height=words.number(hold.height),
                force=words.number(float(hold.force[0]) / 1e3),
                **({} if math.isnan(largest) else {"largest": words.number(largest / 1e3)}),
            )
        )
    return "; ".join(texts) or "–"


def ratio_words(check: Check, words: Sentences) -> str:
    """Return capacity over demand as a page prints it."""
    return words("falls") if not check.ratio else words.decimal(check.ratio_in_words)


def _valued(check: Check, value: float, words: Sentences) -> str:
    if math.isinf(value):  # of the dynamic check alone
        return words("exceeds d₀")
    letter = "d" if check.unit == "m" else "a_g"
    return f"{letter} = {words.quantity(value, check.unit)}"


def _sentences(page: CheckedStructure, checked: StructureCheck, words: Sentences) -> list[str]:
    """The basis of the checks, in sentences."""
    mechanism = checked.governing
    static = mechanism.static
    lines = [
        words(
            "Mechanism that governs: {mechanism}; α₀ = {multiplier}, e* = {mass}, FC = {factor}, d₀ = "
            "{displacement}; it starts at a_g = {start} (SLD).",
            mechanism=words.phrase(mechanism.description),
            multiplier=words.number(mechanism.onset_multiplier),
            mass=words.number(mechanism.participating_mass_ratio),
            factor=words.plain(mechanism.confidence_factor),
            displacement=words("none")
            if math.isinf(mechanism.ultimate_displacement)
            else words.quantity(mechanism.ultimate_displacement, "m"),
            start=words.quantity(checked.damage_level, "m/s²"),
        )
    ]
    for state in LIMIT_STATES.values():
        point = mechanism.limit(state)
        if math.isinf(point.displacement):
            continue
        lines.append(
            words(
                "d_{state} = {displacement} ({reason}), a = {acceleration}, T_{state} = {period} s.",
                state=state.name,
                displacement=words.quantity(point.displacement, "m"),
                reason=words.of(point.reason),
                acceleration=words.quantity(point.acceleration, "m/s²"),
                period=words.number(point.period),
            )
        )
    x, z = static.place
    lines.append(
        words(
            "The displacements are those of the equivalent system, d = {factor} d_k (C8.7.1.4), where d_k is"
            " the displacement of the corner at x = {x} m, z = {z} m, which moves farthest.",
            x=words.number(x),
            z=words.number(z),
            factor=words.number(static.displacement_factor),
        )
    )
    letter = static.mass_ratio_of_all
    if letter < static.participating_mass_ratio * (1 - 1e-9):
        lines.append(
            words(
                "By the letter of C8.7.1.5, with the weights that something else holds sideways included in "
                "P, e* would be {letter} and every capacity in acceleration {factor} times as large; e* = "
                "{mass}, of the masses that move sideways only, is used here, on the safe side.",
                letter=words.number(letter),
                mass=words.number(static.participating_mass_ratio),
                factor=words.number(static.participating_mass_ratio / letter),
            )
        )
    if checked.warning and checked.warning.kind is CheckKind.NO_DISPLACEMENT:
        lines.append(words.of(checked.warning))
    lines += [words.of(warning) for restraint in checked.restraints for warning in restraint.warnings]
    lines += _lowered(checked, page.untied, words)
    dynamic = checked.dynamic
    if dynamic is not None:
        low, high = (words.decimal(percent(bound)) for bound in dynamic.interval)
        unknown = says_nothing(dynamic.interval)
        others = (
            words("too few stations to speak for others")
            if unknown
            else words("{low} to {high} % of sets of other stations would", low=low, high=high)
        )
        outcome = words.of(dynamic.refusal) if dynamic.refusal else words(dynamic.outcome)
        lines.append(
            words(
                "Dynamic check under {motions}: of {sets} sets drawn {share} % meet it ({others}); "
                "{outcome}.",
                motions=words.counted(dynamic.motions, "motion"),
                sets=dynamic.sets,
                share=words.decimal(percent(dynamic.share)),
                others=others,
                outcome=outcome,
            )
        )
        if dynamic.caution:
            lines.append(words.of(dynamic.caution))
    return lines


def _lowered(checked: StructureCheck, untied: StructureCheck | None, words: Sentences) -> list[str]:
    """The sentence on a tie that brings a mechanism of a lower nonlinear ratio to govern; none where it does not."""
    if untied is None or untied.nonlinear is None or checked.nonlinear is None:
        return []
    if checked.nonlinear.ratio >= untied.nonlinear.ratio * (1 - 1e-6):  # the same but for rounding
        return []
    said = words(
        "With the tie another mechanism governs, {mechanism}, with a nonlinear ratio of {tied}; without the "
        "tie it is {other}, with {untied}: the part that moves is shorter, starts at a higher acceleration "
        "and overturns at a smaller displacement.",
        tied=ratio_words(checked.nonlinear, words),
        mechanism=words.phrase(checked.governing.description),
        untied=ratio_words(untied.nonlinear, words),
        other=words.phrase(untied.governing.description),
    )
    return [said]


def _period_table(
    others: Sequence[CheckedStructure], conclusion: CodeConclusion, words: Sentences
) -> PageTable:
    """The lines of the other places of a structure on a support: the ratios, the conclusion, the study's share."""
    kinds = [check.check for check in conclusion.checks]
    heads = [(words("Place"), "1.4", "l"), *((words(kind), "0.8", "r") for kind in kinds)]
    heads += [(words("Conclusion"), "2", "l"), (words("Overturns"), "0.8", "r")]
    concluded = {at_period.period: at_period for at_period in conclusion.elsewhere}
    lines: list[list[Cell]] = []
    for page in others:
        place = (
            f"T_b {words.number(page.period)} s" if page.period else words("on the ground (for comparison)")
        )
        share = f"{words.decimal(percent(page.overturning_share))}\u00a0%" if page.stations else "–"
        there = concluded.get(page.period)
        if page.checked is None or there is None:
            lines.append(
                [
                    place,
                    *["–"] * len(kinds),
                    words("It could not be checked: {why}", why=words.reason(page.refusal)),
                    share,
                ]
            )
            continue
        ratios = {KINDS[check.clause]: ratio_words(check, words) for check in page.checked.checks}
        key = "verified by {clause}" if there.verified else "not verified by {clause}"
        text = words(key, clause=there.decisive.clause)
        lines.append([place, *(ratios.get(kind, "–") for kind in kinds), text, share])
    return table(heads, lines)


def _share(page: CheckedStructure, words: Sentences) -> str:
    """What the study says of the structure there: its words by station, with their warnings."""
    counts = ", ".join(
        words(
            "{predicate} under {count}",
            predicate=words(verdict.predicate),
            count=words.counted(page.verdicts[verdict], "station"),
        )
        for verdict in ORDER
        if page.verdicts.get(verdict)
    )
    reasons = (
        f" ({'; '.join(words.of(RockingWarning(kind)) for kind in page.verdict_warnings)})"
        if page.verdict_warnings
        else ""
    )
    if not page.stations:
        return words(
            "No record of the study shows whether it overturns{told}.",
            told=f"; {counts}{reasons}" if counts else "",
        )
    sentences = [words("by the worst record of each station it {counts}.", counts=f"{counts}{reasons}")]
    if not page.reserves:
        sentences.append(words("No reserve was searched for."))
    text = " ".join(sentences)
    return text[:1].upper() + text[1:]


def _spectrum_words(spectrum: DesignSpectrum, words: Sentences) -> str:
    damping = words.number(100 * spectrum.damping, 2)
    if isinstance(spectrum, NtcSpectrum):
        return words(
            "NTC 2018, 3.2.3.2: a_g = {ag} g, F0 = {f0}, T_C* = {tc} s, soil {soil}, S_T = {topography}, "
            "damping {damping} %",
            ag=words.plain(spectrum.ag / GRAVITY),
            f0=words.plain(spectrum.f0),
            tc=words.plain(spectrum.tc_star),
            soil=spectrum.soil,
            topography=words.plain(spectrum.topography),
            damping=damping,
        )
    assert isinstance(spectrum, PointSpectrum)
    return words(
        "{count} points from {first} to {last} s, first ordinate {level} g, damping {damping} %",
        count=len(spectrum.periods),
        first=words.plain(spectrum.periods[0]),
        last=words.plain(spectrum.periods[-1]),
        level=words.number(spectrum.level / GRAVITY),
        damping=damping,
    )


def _selection_words(selection: Selection, words: Sentences) -> str:
    """The deviations and scale factors of the chosen set."""
    low, high = selection.deviations
    factors = selection.factors[selection.chosen]
    return words(
        "{size} records of as many stations out of {names} of {stations}; the mean spectrum lies between "
        "{low} and {high} % of the target from {first} to {last} s; factors from {least} to {most}, median "
        "{median}; {sets} other sets within the limits, of {drawn} drawn.",
        size=selection.chosen.size,
        names=len(selection.names),
        stations=len(set(selection.stations)),
        low=f"{100 * low:+.0f}",
        high=f"{100 * high:+.0f}",
        first=words.number(selection.periods[0]),
        last=words.number(selection.periods[-1]),
        least=words.number(factors.min()),
        most=words.number(factors.max()),
        median=words.number(float(np.median(factors))),
        sets=len(selection.sets),
        drawn=selection.drawn,
    )


def _motion_table(selection: Selection, words: Sentences) -> PageTable:
    """The records of the chosen set, each with its factor and its peak when scaled."""
    peak = unit_of("m/s²")
    heads = [
        (words("Record"), "1.6", "l"),
        (words("Earthquake and station"), "1.6", "l"),
        (words("Components"), "auto", "r"),
        (words("Factor [-]"), "auto", "r"),
        (words("Peak when scaled [{unit}]", unit=peak.name), "auto", "r"),
    ]
    lines: list[list[Cell]] = []
    for place in selection.chosen:
        motions = selection.scaled(int(place))
        facts = [name for name in (motions[0].event, motions[0].station) if name]
        lines.append(
            [
                selection.names[place],
                or_a_dash(facts),
                words.plain(len(motions)),
                words.number(float(selection.factors[place])),
                words.number(max(motion.peak_acceleration for motion in motions) / peak.size),
            ]
        )
    return table(heads, lines)
