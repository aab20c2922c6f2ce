"""The report of one record: two pages for a client."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np

from rocking.assessment.case import PeriodResult, RecordResult
from rocking.assessment.conclusion import (
    TO_CHECK,
    UNSAID,
    Conclusion,
    conclusion_in_words,
    conclusions,
    fallen_in_one_run,
    to_check,
)
from rocking.assessment.cracks import crack_named, cracked, crushing_factor
from rocking.assessment.decide import ORDER, Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import Agreement, agreement
from rocking.assessment.rows import (
    ComparisonRow,
    PulseRow,
    RecordRows,
    VerdictRow,
    WarningRow,
)
from rocking.assessment.scene import TAKEN_AS, variants_of
from rocking.assessment.variants import variants
from rocking.errors import FaultError, one_structure
from rocking.floors.kinds import FloorKind
from rocking.quantities import GRAVITY, counted, listed, percent, percents
from rocking.records.formats.text import day_of
from rocking.reports import printing
from rocking.reports.against import against, comparison_of, least_uplift, sizes_of, traces_of
from rocking.reports.drawings import Trace, drawn_by_hand, sine_lines, sketch, svg_path, thinned
from rocking.reports.kinds import ReportKind
from rocking.reports.pages import (
    Against,
    Marks,
    Notice,
    Others,
    PageOne,
    PageOneRow,
    PageSettings,
    PageTable,
    Peak,
    Picture,
    PlainPage,
    RecordPage,
    Section,
    Sine,
    Strip,
    Topic,
)
from rocking.reports.printing import (
    MEASURED,
    chip,
    compile_document,
    displaying,
    footer_of,
    known_crack,
    number,
    plain,
    words,
)
from rocking.reports.supports import SupportPanel, floor_sentences, support_panels
from rocking.structures import Structure
from rocking.structures.crackable import Crackable
from rocking.structures.kinds import StructureKind
from rocking.structures.leaves import beside
from rocking.warnings import Kind, RockingWarning

if TYPE_CHECKING:
    from rocking.codes.design_spectrum import DesignSpectrum

MOST_CARRIED = 10
"""Structures on supports that page two names, the worst first; supports.csv holds all."""
MOVED = 0.1
"""Change of a share that is worth telling."""
MOST_NOTICED = 3
"""Failures that stand above everything; failures.csv holds all."""
TOLD_FIRST = (StructureKind.RESTITUTION_TYPED, ReportKind.CRUSHING_WOULD_TELL)
"""Warnings on the models that page one says briefly, before their sentences."""
MOST_ROWS = 12
"""Structures that have a row, the worst first; the others are named by their words below."""
_MOST_UNCERTAIN = 2
"""Structures of which page one says why they are uncertain."""
_MOST_NAMED = 20
"""Names of a verdict below the rows."""
_UNIT = 27.0
"""Length of a rotation ratio of 1 on the scale, mm."""
_FARTHEST = 1.2
"""Rotation ratio at the end of the scale; what came back from beyond it stands there."""
_FALLEN = 41.5
"""Where on the scale stands what falls, mm: in the middle of its grey zone, one fall no farther than another."""
_DRAWN = 0.8
"""Rotation ratio at which a structure is drawn."""
_NO_DEMAND = "A single record is not the code's demand; see structures.pdf for the check at the design level."
_ROOM = 12.0, 14.0
"""Width and height of a drawing, mm."""
_STRIP = 118.0, 20.0
"""Width and height of the strip of the record, mm."""
_POINTS = 1200
_LETTERS = 8.0
"""Of the narrower tables, pt."""


@dataclass(frozen=True, eq=False)
class RecordReport:
    """The report of one record, and what several of its pages ask for.

    Every number of a table is a cell of `tables`, the rows of `result`, or of the structures table, rounded.
    structures: by name. level: the design level; None where the study has none.
    of_study: the warnings on the study itself, besides those on the record in `tables`.
    """

    result: RecordResult
    tables: RecordRows
    structures: Mapping[str, Structure]
    settings: PageSettings
    level: "DesignSpectrum | None" = None
    of_study: Sequence[WarningRow] = ()

    def pdf(self) -> bytes:
        """Return the document."""
        return compile_document(self.page())

    def page(self) -> RecordPage:
        """Return the pages: texts, tables and figures."""
        groups = variants_of({name: scene.scene for name, scene in self.result.scenes.items()})
        strips: list[Strip] = []
        with displaying(self.settings):
            if groups:
                from rocking.reports.variants import strips as strips_of

                strips = strips_of(variants(groups, self.conclusions), self.structures)
            title, subtitle = _title(self)
            return RecordPage(
                title=title,
                about=self.settings.about,
                footer=footer_of(self.settings),
                subtitle=subtitle,
                running=f"{self.result.record}.{self.scale_note}" if self.scale_note else self.result.record,
                conclusion=conclusion_in_words(
                    {
                        conclusion.row.structure: conclusion.row.decision.verdict
                        for conclusion in self.conclusions
                    },
                    fallen=fallen_in_one_run(self.conclusions),
                ),
                at_design_level=_NO_DEMAND if self.level else "",
                notices=tuple(_notices(self)),
                page_one=page_one(self),
                against=_against(self),
                variants=Section(heading="Variants" if strips else "", strips=tuple(strips)),
                advice=_advice(self),
                known=_known(self),
                assumed=Section(heading="What was assumed", topics=tuple(_assumed(self))),
            )

    @cached_property
    def as_stones(self) -> frozenset[str]:
        """The structures that were followed as stones, which say what their contacts do, in the reason of a verdict."""
        followed = {row.structure for row in self.tables.verdicts if row.stack_runs}
        return frozenset(
            name for name in followed & set(self.structures) if self.structures[name].joints.as_stones
        )

    @cached_property
    def left_out(self) -> dict[RockingWarning, list[str]]:
        """What the models of structures that lift leave out, or take from what was typed, with the structures."""
        concerned: dict[RockingWarning, list[str]] = {}
        for period_result in self.result.worst_first:
            for caution in period_result.scene.structure.cautions if period_result.rotation_ratio > 0 else ():
                if caution.kind is StructureKind.FRAME_CONTACTS and period_result.structure in self.as_stones:
                    continue
                concerned.setdefault(caution, []).append(self.called(period_result.structure))
        would_crush = [
            period_result.structure
            for period_result in self.result.worst_first
            if _would_crush(period_result)
        ]
        if would_crush:
            concerned[RockingWarning(ReportKind.CRUSHING_WOULD_TELL)] = [
                self.called(name) for name in would_crush
            ]
        of_one_leaf = [warning for warning in concerned if warning.kind is StructureKind.ONE_LEAF]
        if len(of_one_leaf) > 1:  # one line of all thicknesses
            thicknesses = ", ".join(str(warning["thickness"]) for warning in of_one_leaf)
            names = [name for warning in of_one_leaf for name in concerned.pop(warning)]
            concerned[RockingWarning.of(StructureKind.ONE_LEAF, thickness=thicknesses)] = names
        return {warning: list(dict.fromkeys(names)) for warning, names in concerned.items()}

    @cached_property
    def scale_note(self) -> str:
        """The sentence on a declared factor, which follows every caption; "" without one."""
        factors = _unique(plain(row.scale_factor) for row in self.tables.record if row.scale_factor != 1)
        return f" Accelerations ×\u00a0{factors}, declared." if factors else ""

    @property
    def warnings(self) -> list[WarningRow]:
        """What there is to say of the study and of the record."""
        return [*self.of_study, *self.tables.warnings]

    @cached_property
    def conclusions(self) -> list[Conclusion]:
        """The conclusion on each structure, the worst first."""
        return conclusions(self.tables.verdicts, self.tables.comparison)

    def called(self, name: str) -> str:
        """Return how a sentence calls a structure: one on a support without its period, as it names many."""
        scene = self.result.scenes.get(name)
        is_carried = scene is not None and scene.scene.place.supports
        return f"{name} on {scene.scene.place.name}" if scene is not None and is_carried else name

    @cached_property
    def motions(self) -> list[Trace]:
        """The components that were assessed, with their ranked pulses."""
        return traces_of(self.result, self.tables)

    @property
    def motion(self) -> Trace | None:
        """The component that stands for the record, the one of the largest peak; None without one."""
        return max(self.motions, key=lambda trace: trace.accelerogram.peak_acceleration, default=None)

    def dominant(self, component: str) -> PulseRow | None:
        """Return the dominant pulse of a component; None without one."""
        ranked = (row for row in self.tables.pulses if row.component == component and row.ranked)
        return min(ranked, key=lambda row: row.rank, default=None)

    @cached_property
    def support_panels(self) -> list[SupportPanel]:
        """The supports that carry a structure."""
        return support_panels(self.result)


def _unique(texts: Iterable[str]) -> str:
    """Return each of the texts once, in a row."""
    return ", ".join(dict.fromkeys(filter(None, texts)))


def failure_page(record: str, message: str) -> PlainPage:
    """Return the page that says why `record` gave no result."""
    text = (
        "Nothing was computed for this record, so no structure was assessed under it. The other records of the run are "
        "not affected. The sentence above is also in summary/failures.csv."
    )
    return PlainPage(
        title=f"Rocking assessment: {record}",
        subtitle="This record gave no result.",
        parts=(Section(notice=message or "No reason was given."), Section(text=text)),
    )


def _against(report: RecordReport) -> tuple[Against, ...]:
    """Return the page of prediction against integration, where anything was compared."""
    compared = comparison_of(report.conclusions, report.structures, report.result, report.motions)
    return (against(compared, report.structures, report.tables.pulses),) if compared else ()


def _vertical_in_words(report: RecordReport) -> str:
    """Return what the vertical component does; "" where a warning above says that there is none which could act."""
    if acting := _unique(row.vertical_component for row in report.tables.record):
        return f"The vertical component {acting} acts on the integrations, not on the closed form."
    missing = any(row.kind is AssessmentKind.VERTICAL_MISSING for row in report.warnings)
    return "" if missing else "The vertical component is left out."


def _assumed(report: RecordReport) -> Iterator[Topic]:
    """Yield what was assumed, by topic, and files and versions; the time of the run is left out."""
    record = report.tables.record
    structures = report.structures.values()
    settings = report.settings
    coefficients = _unique(plain(structure.joints.friction) for structure in structures)
    sliding = f"A contact slides where it needs a friction coefficient above {coefficients}."
    yield Topic(
        "Bodies",
        (f"Bodies are rigid and do not crush. {sliding} Each structure has one degree of freedom.",),
    )
    yield Topic("Cracks", (_CRACKS,))
    if any(structure.joints.hinges_migrate for structure in structures):
        farther = MEASURED["stones_farther"].words
        momentum = MEASURED["arch_momentum"].words
        text = (
            f"Hinges migrate in flight: in another code the rotations of loose stones with a restitution of 0.9 were "
            f"{farther}, and smaller in the others. The restitution of {momentum} that the momentum balance gives for "
            "an arch would be on the unsafe side."
        )
        yield Topic("Arches", (text,))
    if any(structure.joints.courses_taper for structure in structures):
        yield Topic("Spires", (_SPIRES,))
    if report.result.carried:
        missed = MEASURED["missed_on_supports"].words
        yield Topic("Supports", (f"{_SUPPORTS} {missed}.",))
    yield Topic("Impacts", (_IMPACTS,))
    yield Topic("Ground motion", (f"{_GROUND_MOTION} {_vertical_in_words(report)}".rstrip(),))
    text = (
        f"The integration has a relative tolerance of {plain(settings.tolerance)}; the equivalent block uses the "
        f"acceleration scale “{settings.acceleration_scale}”."
    )
    yield Topic("Numerics", (text,))
    yield Topic("Equations", (_EQUATIONS,))
    times = _unique(row.start_time for row in record)
    files = _unique(f"{words(row.file)}, SHA-256 {row.record_sha256}" for row in record)
    hashes = _unique(f"{row.settings_sha256[:16]}…" for row in record)
    sources = [
        "The numbers of this report are rounded from the tables in the same folder, whose rows give the hashes of "
        "file and settings.",
        f"First sample at {times}." if times else "",
        f"File: {files}. rocking {version('rocking')}, settings and structures {hashes}",
    ]
    yield Topic("Sources", (" ".join(filter(None, sources)),))


_CRACKS = (
    "Where cracks or hinges are not given, those that statics chooses decide the verdict, and every other place where "
    "they may form is followed as a mechanism of its own. They stay where they formed."
)
_SPIRES = (
    "The courses of a spire that lifts may throw off its tip, so that only contact dynamics (fidelity: contact) can "
    "show that it stands."
)
_SUPPORTS = (
    "The period of a support is neither known nor random: each period is followed separately. The support is linear "
    "and is not affected by what stands on it. One pulse describes a ringing motion poorly: the closed form missed"
)
_IMPACTS = (
    "An impact keeps the stated ratio of angular velocities (restitution). The mechanism mirrors itself at each "
    "impact."
)
_GROUND_MOTION = "The acceleration is linear between samples and zero after the last one."
_EQUATIONS = (
    "Eqs. 3–6, 8, 9 and 14 of the source paper (DeJong and Dimitrakopoulos, “Towards a unified description of rocking "
    "structures”) are used with the signs and factors with which rocking without loss conserves energy; the "
    "documentation prints both forms. Eq. 15 as printed is valid where the block makes no contact before the pulse "
    "ends."
)


# Page one ------------------------------------------------------------------------------------------------


def page_one(report: RecordReport) -> PageOne:
    """Return the page to look at, below its title."""
    motion = report.motion
    pulse = report.dominant(motion.accelerogram.component) if motion else None
    drawn, others = report.conclusions[:MOST_ROWS], report.conclusions[MOST_ROWS:]
    return PageOne(
        trace=(ground_strip(motion),) if motion else (),
        peaks=_peaks(report),
        sine=Sine(share=percents(pulse.explained_energy) if pulse else "", clause=_rings_beside_dots(drawn)),
        rows=tuple(
            structure_row(conclusion, report.structures.get(conclusion.row.structure)) for conclusion in drawn
        ),
        others=tuple(
            Others(verdict=str(verdict), names=listed(names, _MOST_NAMED))
            for verdict in ORDER
            if (
                names := [
                    conclusion.row.structure
                    for conclusion in others
                    if conclusion.row.decision.verdict is verdict
                ]
            )
        ),
        uncertain=tuple(_uncertain(report)),
        legend=_legend(report, drawn),
    )


def _rings_beside_dots(drawn: Sequence[Conclusion]) -> str:
    """In how many of the rows the closed form ends as the record does, and how many of their falls it sees."""
    cases = [conclusion.case for conclusion in drawn if conclusion.case is not None]
    compared = [row for row in cases if row.agreement is not Agreement.UNKNOWN]
    if not compared:
        return "No sine was found: there are no rings."
    falls = sum(row.integrated_rotation_ratio == math.inf for row in compared)
    sees = sum(row.sees_fall for row in compared)
    both_stand = [
        row
        for row in compared
        if row.agreement is Agreement.SAME and row.integrated_rotation_ratio < math.inf
    ]
    seen = f", and sees {sees} of {counted(falls, 'fall')}" if falls else ""
    return f"The sine ends as the record in {sees + len(both_stand)} of {len(compared)}{seen}."


def _legend(report: RecordReport, drawn: Sequence[Conclusion]) -> str:
    """What the columns mean, and what page two explains. drawn: the structures that have a row."""
    sentences = [
        _reserve_in_words(drawn),
        "Members vary motion and restitution; a range: cracks disagree; grey: mechanism alone.",
    ]
    if any(conclusion.row.decision.verdict is Verdict.CANNOT_BE_TOLD for conclusion in report.conclusions):
        sentences.append("Hatched: what was left out may decide.")
    explained = "; ".join(
        replace(warning, about=listed(names, 1)).brief
        for warning, names in report.left_out.items()
        if warning.kind in TOLD_FIRST
    )
    sentences.append(f"Page 2 on {explained}." if explained else "")
    return " ".join(filter(None, sentences))


def ground_strip(motion: Trace) -> Picture:
    """The acceleration of a component while it shakes, and its dominant pulse, without axes."""
    record = motion.accelerogram
    begin, end = motion.span
    inside = (record.times >= begin) & (record.times <= end)
    shaking = thinned(record.times[inside], record.acceleration[inside], _POINTS)
    width, height = _STRIP
    reach = 1.05 * max(record.peak_acceleration, 1e-9)

    def places(times: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
        across = width * (times - begin) / (end - begin)
        return np.stack([across, height / 2 * (1 + acceleration / reach)], axis=1)

    lines = [svg_path(places(*shaking), height, 'fill="none" stroke="#595959" stroke-width="0.21"')]
    for pulse in motion.pulses[:1]:
        cycle = np.linspace(pulse.start_time, pulse.end_time, 121)
        lines += sine_lines(places(cycle, pulse.acceleration(cycle)), height, 0.53)
    alt = "Acceleration of the ground and the sine that explains most of its energy."
    return drawn_by_hand(lines, width, height, alt)


def structure_row(conclusion: Conclusion, structure: Structure | None) -> PageOneRow:
    """The row of a structure: drawn at _DRAWN of its critical rotation and dashed at rest, its verdict and marks."""
    row = conclusion.row
    decision = row.decision
    drawing: tuple[Picture, ...] = ()
    # One that cannot be drawn keeps its row.
    with suppress(FaultError), one_structure(row.structure):
        drawing = (_turned(row, structure),) if structure is not None else ()

    closed_form, block, whole = conclusion.ratios
    low, high = (_place(ratio) for ratio in (row.rotation_ratio_low, row.rotation_ratio_high))
    period = row.support_period_s
    place = "" if period is None else f"T_b {period:.3g}\u00a0s" if period else "on the ground"
    sizes = sizes_of(row.structure, structure) if structure is not None else ""
    case = conclusion.case
    of_uplift = [f"λ\u00a0{number(case.uplift_multiplier)}", case.crack] if case else []
    of_uplift += [least_uplift(case, structure)] if case and structure else []
    uplift = ", ".join(filter(None, of_uplift))
    return PageOneRow(
        name=row.structure,
        below="; ".join(filter(None, (sizes, uplift, place, _known_crack(structure, row)))),
        drawing=drawing,
        chip=chip(decision.verdict, decision.share_in_words),
        odds=decision.odds,
        marks=Marks(
            form=_place(closed_form),
            block=_place(block),
            whole=_place(whole),
            line=() if low is None or high is None else (low, high),
        ),
        reserve=row.reserve.in_figures if row.reserve else "",
        alone=bool(row.reserve_warnings),
        warning=_beside_the_word(conclusion, structure),
    )


def _beside_the_word(conclusion: Conclusion, structure: Structure | None) -> str:
    """The text at the end of a row; "" where there is nothing to say."""
    warning = conclusion.warning
    if warning.kind in UNSAID:
        return ""
    stands = structure is not None and structure.joints.friction >= structure.joints.stand_on_friction
    if warning.kind is AssessmentKind.CONTACT_SLIDES and stands and conclusion.case is not None:
        warning = RockingWarning.of(ReportKind.STANDS_AS_VOUSSOIRS, needed=conclusion.case.required_friction)
    return warning.brief


def _turned(row: VerdictRow, structure: Structure) -> Picture:
    """A structure with the crack that governs, turned to the side of its largest rotation."""
    crack = crack_named(structure, row.crack)
    broken = cracked(structure, row.crack)
    sign = -1 if row.peak_side == -1 else 1
    side = broken.mechanism().sides[0 if sign > 0 else -1]
    rest = beside(structure, crack.part if crack.description == row.crack else "")
    shapes = sketch(broken, sign * _DRAWN * side.critical_rotation, *_ROOM, rest=rest)
    return drawn_by_hand(shapes, *_ROOM, f"{row.structure}, turned, and at rest.")


def _known_crack(structure: Structure | None, row: VerdictRow) -> str:
    """That the crack of a structure is known, and what the worst other one would do; "" where it is not."""
    known = known_crack(structure)
    if not known or not isinstance(structure, Crackable):
        return known
    if not row.statics_crack or row.statics_crack == structure.crack_in_words:
        return f"{known}; no other is in doubt" if row.members else known
    falls = f"{row.statics_overturning_members} of {row.statics_members}"
    return f"{known}; {row.statics_crack}: {falls} fall"


def _uncertain(report: RecordReport) -> list[str]:
    """Say of the structures that are uncertain why, and what then."""
    uncertain = []
    for conclusion in report.conclusions:
        decision = conclusion.row.decision
        if decision.verdict is Verdict.UNCERTAIN:
            reasons = [f"{decision.share_in_words} fall" if not math.isnan(decision.share) else decision.why]
            reasons += [warning.brief for warning in (*decision.warnings, *decision.would_settle)[:1]]
            uncertain.append(f"{conclusion.row.structure} ({'; '.join(reasons)})")
    if not uncertain:
        return []
    verb, subject = ("is", "it") if len(uncertain) == 1 else ("are", "they")
    return [f"{listed(uncertain, _MOST_UNCERTAIN)} {verb} uncertain: assume that {subject} may overturn."]


def _reserve_in_words(drawn: Sequence[Conclusion]) -> str:
    """Say what the factors of the column are, by those of the first structure that has both; "" without one."""
    reserves = [conclusion.row.reserve for conclusion in drawn if conclusion.row.reserve is not None]
    both = next((reserve for reserve in reserves if reserve.median > reserve.low), None)
    if both is None:
        return ""
    low, median = number(both.low, 2), number(both.median, 2)
    return f"{low}–{median}: at {low} times this record 5 % of members or runs fall, at {median} times half."


def _place(ratio: float) -> float | None:
    """The place of a rotation ratio on the scale, mm; None where there is none."""
    if math.isnan(ratio):
        return None
    return _FALLEN if ratio == math.inf else _UNIT * min(ratio, _FARTHEST)


# Sentences -----------------------------------------------------------------------------------------------


def _title(report: RecordReport) -> tuple[str, str]:
    """Return the title, of earthquake and station, and the line below it."""
    rows = report.tables.record
    drawn = report.motion.accelerogram.component if report.motion else ""
    names = [_unique(getattr(row, which) for row in rows) for which in ("event", "station")]
    title = ": ".join(filter(None, names)) or report.result.record
    distances = [row.epicentral_distance_m / 1000 for row in rows if row.epicentral_distance_m]
    parts = {
        "{}": (day_of(row.event_time) for row in rows if day_of(row.event_time) not in row.event),
        "magnitude {}": (
            f"{plain(row.magnitude)} ({row.magnitude_type})".removesuffix(" ()")
            for row in rows
            if row.magnitude
        ),
        "epicentre at {} km": map(plain, distances),
    }
    texts = [text.format(found) for text, many in parts.items() if (found := _unique(many))]
    shown = f"{report.result.record}, {drawn}" if drawn else report.result.record
    return title, " · ".join([*texts, shown])


def _peaks(report: RecordReport) -> tuple[Peak, ...]:
    """Return the peaks of the component that stands for the record."""
    drawn = report.motion.accelerogram.component if report.motion else ""
    row = next((row for row in report.tables.record if row.component == drawn), None)
    if row is None:
        return ()
    return (
        Peak(value=f"{number(row.peak_acceleration_m_s2 / GRAVITY, 2)} g", name="PGA"),
        Peak(value=printing.quantity(row.peak_velocity_m_s, "m/s"), name="PGV"),
    )


def _components(report: RecordReport) -> PageTable:
    """Return the table of the components: peaks, duration, velocity pulse and dominant sine of each."""
    acceleration = printing.unit_of("m/s²")
    velocity = printing.unit_of("m/s")
    columns = [
        ("Component", "auto", "l"),
        ("PGA [g]", "1", "r"),
        (f"PGV [{velocity.name}]", "1", "r"),
        ("D5–95 [s]", "1", "r"),
        ("T_p [s]", "1", "r"),
        ("Pulse-like", "1", "r"),
        (f"Sine: amplitude [{acceleration.name}]", "1.2", "r"),
        ("period [s]", "1", "r"),
        ("onset [s]", "1", "r"),
        ("energy [%]", "1", "r"),
    ]
    cells = []
    for row in report.tables.record:
        sine = report.dominant(row.component)
        of_sine = [printing.NOTHING] * 4
        if sine is not None:
            of_sine = [
                number(abs(sine.amplitude_m_s2) / acceleration.size),
                number(sine.period_s),
                number(sine.start_time_s),
                percent(sine.explained_energy),
            ]
        cells.append(
            [
                words(row.component),
                number(row.peak_acceleration_m_s2 / GRAVITY),
                number(row.peak_velocity_m_s / velocity.size),
                number(row.significant_duration_s),
                number(row.velocity_pulse_period_s),
                _PULSE_LIKE[row.velocity_pulse_like],
                *of_sine,
            ]
        )
    return printing.table(columns, cells)


_PULSE_LIKE = {None: printing.NOTHING, True: "yes", False: "no"}


_COMPONENTS = (
    "The components. D5–95: significant duration; T_p: period of the velocity pulse of Shahi and Baker (2014). Sine: "
    "the one that explains most of the acceleration energy, with its share of it; same outcome: in how many cases "
    "closed form and integration end alike where a sine explains so much."
)


def _known(report: RecordReport) -> Section:
    """Return the components, and by topic what a reader has to know and the warnings, each once."""
    depends = []
    for period_result in report.result.worst_first:
        ratios = [
            row.integrated_rotation_ratio
            for row in report.tables.variations
            if row.processing
            and (row.structure, row.support_period_s)
            == (period_result.structure, period_result.support_period_s)
        ]
        # What the network has corrected is not processed again.
        corrected = all(accelerogram.processed for accelerogram in report.result.accelerograms)
        if not corrected and any(map(math.isinf, ratios)) and any(map(math.isfinite, ratios)):
            depends.append(report.called(period_result.structure))
    depends = list(dict.fromkeys(depends))
    warning = f"The processing of the record decides whether these overturn: {listed(depends)}."
    carried = sorted(report.result.carried, key=lambda scene: scene.worst.severity, reverse=True)
    topics = {
        "Dominant sine": _pulse_warnings(report),
        "Closed form": _warnings(report.tables.comparison, several=len(report.motions) > 1),
        "Supports": [
            *(f"{scene.sentence}." for scene in carried[:MOST_CARRIED]),
            *(floor_sentences(report.support_panels) if carried else []),
            *_said(report.warnings, FloorKind.HEAVY_ON_SUPPORT),
        ],
        "Contacts": _contacts(report),
        "Models": [
            *(str(replace(warning, about=listed(names))) for warning, names in report.left_out.items()),
            *_taken_as(report.warnings),
        ],
        "Processing": [warning] if depends else [],
        "Warnings": [
            sentence for sentence, kind in warnings_of(report.tables).items() if kind not in TO_CHECK
        ],
    }
    components = _components(report)
    known = tuple(Topic(topic, tuple(texts)) for topic, texts in topics.items() if texts)
    return Section(
        heading="What to know" if components.rows or known else "",
        table=components,
        caption=_COMPONENTS + report.scale_note,
        size=_LETTERS,
        topics=known,
    )


def _contacts(report: RecordReport) -> list[str]:
    """What the contacts of each structure do under any component: where the model fails, and where it need not."""
    failing: dict[str, set[str]] = {}
    needed: dict[str, float] = {}
    for row in report.tables.comparison:
        if row.structure in report.as_stones:
            continue
        name = report.called(row.structure)
        structure = report.structures.get(row.structure)
        stands = structure is not None and structure.joints.friction >= structure.joints.stand_on_friction
        if row.bounces:
            failing.setdefault(name, set()).add("bounces")
        if row.slides and not stands:
            failing.setdefault(name, set()).add("slides")
        if row.slides and stands and not row.bounces:
            needed[name] = max(needed.get(name, 0.0), row.required_friction)
    texts = [f"{name} ({' and '.join(sorted(kinds, reverse=True))})" for name, kinds in failing.items()]
    sentences = [f"The model does not hold, because a contact fails, for {listed(texts)}."] if texts else []
    return sentences + [
        str(RockingWarning.of(ReportKind.STANDS_AS_VOUSSOIRS, name, needed=largest))
        for name, largest in needed.items()
        if name not in failing
    ]


def _would_crush(period_result: PeriodResult) -> bool:
    """Whether a compressive strength of 2 MPa would change a structure that states none.

    λ falls, and so does what overturns it in proportion: as far as the reserve on this record shows.
    """
    reserve = period_result.reserve
    # What no factor overturns, no loss of λ does; to crush an arch takes a fifth of a second.
    if reserve is None or math.isnan(reserve.low):
        return False
    factor = crushing_factor(period_result.scene.structure)
    if factor is None:
        return False
    share = 0.0 if math.isnan(period_result.decision.share) else period_result.decision.share
    reached = [(0.95, reserve.high), (0.5, reserve.median), (0.05, reserve.low)]
    then = next((share for share, at in reached if at <= factor), 0.0)
    return then - share > MOVED or then >= 0.05 > share


def _advice(report: RecordReport) -> Section:
    """Return what would settle the cases that are not sure, each thing to do once with its structures."""
    to_do: dict[str, list[str]] = {}
    for period_result in report.result.worst_first:
        if period_result.decision.verdict.is_sure:
            continue
        for warning in period_result.decision.would_settle:
            to_do.setdefault(str(warning), []).append(report.called(period_result.structure))
    sentences = [
        f"To learn more of {listed(list(dict.fromkeys(names)))}: {thing}." for thing, names in to_do.items()
    ]
    return Section(heading="What to do" if sentences else "", sentences=tuple(sentences))


def warnings_of(tables: RecordRows) -> dict[str, Kind]:
    """Return what file and integrations warn of, each once, with its kind."""
    return {row.sentence: row.kind for row in tables.warnings}


def _said(warnings: Iterable[WarningRow], kind: Kind) -> list[str]:
    """The warnings of one kind in words."""
    return [row.sentence for row in warnings if row.kind is kind]


def _taken_as(warnings: Iterable[WarningRow]) -> list[str]:
    """What structures are taken for, in one sentence on all that are taken for the same."""
    names: dict[Kind, list[str]] = {}
    for row in warnings:
        if row.kind in TAKEN_AS.values():
            names.setdefault(row.kind, []).append(row.about)
    return [str(RockingWarning(kind, listed(taken, _MOST_NAMED))) for kind, taken in names.items()]


def _notices(report: RecordReport) -> list[Notice]:
    """Return the warnings that stand above everything: nothing moves, scale factor, what to check, what failed."""
    tables = report.tables
    notices: list[Notice] = []
    if tables.comparison and all(
        period_result.rotation_ratio == 0 for period_result in report.result.worst_first
    ):
        still = "No structure uplifts: the ground acceleration never reaches an uplift acceleration."
        notices.append(Notice(still, strong=False))
    if any(row.scale_factor != 1 for row in tables.record):
        factors = _unique(plain(row.scale_factor) for row in tables.record)
        text = f"Not the recorded amplitude. The file was multiplied by a declared factor (×\u00a0{factors})."
        notices.append(Notice(text))
    if not tables.comparison:
        notices.append(Notice("No structure could be assessed under this record."))
    if not tables.pulses:
        text = "No pulse could be searched for in this record, so there is no closed-form prediction."
        notices.append(Notice(text))
    of_failures = [f"{row.structure or row.component}: {row.message}" for row in tables.failures]
    failed = list(dict.fromkeys(of_failures))
    if len(failed) > MOST_NOTICED:
        failed[MOST_NOTICED - 1 :] = [
            f"Another {counted(len(failed) - MOST_NOTICED + 1, 'failure')} in failures.csv."
        ]
    return [*notices, *map(Notice, [*to_check(report.warnings), *failed])]


def _pulse_warnings(report: RecordReport) -> list[str]:
    """Say what makes a dominant pulse doubtful, each doubt once with the components that it is about."""
    of_warning: dict[str, list[str]] = {}
    for row in report.tables.record:
        pulse = report.dominant(row.component)
        warnings = [str(RockingWarning(kind)) for kind in pulse.flags] if pulse else []
        if row.pulse_periods_unlike:
            warnings.append(
                "Its period differs from T_p by more than a factor of two: sine and velocity pulse are two features."
            )
        for warning in warnings:
            of_warning.setdefault(warning, []).append(words(row.component))
    several = len(report.tables.record) > 1
    return [f"{listed(names)}: {warning}" if several else warning for warning, names in of_warning.items()]


def _warnings(rows: Sequence[ComparisonRow], several: bool) -> list[str]:
    """Say where the closed form predicts less than happens, and which of its two simplifications is the reason."""
    reasons: dict[str, dict[str, list[str]]] = {}
    compared = [row for row in rows if row.agreement is not Agreement.UNKNOWN]
    for row in sorted(compared, key=lambda row: -row.integrated_rotation_ratio):
        if row.agreement is Agreement.TOO_LOW:
            same = tuple(
                agreement(predicted=simpler, integrated=row.integrated_rotation_ratio) is Agreement.SAME
                for simpler in (row.block_on_record_rotation_ratio, row.mechanism_on_pulse_rotation_ratio)
            )
            # At several periods of a support it is named once.
            of_structure = reasons.setdefault(_BLAME[same], {}).setdefault(row.structure, [])
            if row.component not in of_structure:
                of_structure.append(row.component)
    if not reasons:
        return ["The closed form predicts less than happens for no structure."] if compared else []
    return [
        "The closed form predicts less than happens for "
        + listed(
            [f"{name} ({' and '.join(map(words, of))})" if several else name for name, of in names.items()], 8
        )
        + f": {why}."
        for why, names in reasons.items()
    ]


_BLAME: dict[tuple[bool, ...], str] = {
    (True, True): "either simplification alone gives the right outcome, both together do not",
    (
        True,
        False,
    ): "the equivalent block under the whole record gives the right outcome, so the single pulse is the reason",
    (
        False,
        True,
    ): "the mechanism under the pulse gives the right outcome, so the equivalent block is the reason",
    (
        False,
        False,
    ): "neither the block under the whole record nor the mechanism under the pulse gives the right outcome",
}
"""The cause by whether the block under the record, and the mechanism under the pulse, end as the integration does."""
