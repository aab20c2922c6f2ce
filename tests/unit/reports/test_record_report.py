"""The report of one record: its numbers, its bytes, and what it says when something is wrong."""

import re
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from rocking.assessment.case import PeriodResult
from rocking.assessment.decide import ORDER, Limit
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import Acts, Agreement
from rocking.assessment.rows import rows_of_record, structure_rows
from rocking.quantities import counted
from rocking.reports import printing
from rocking.reports.kinds import ReportKind
from rocking.reports.pages import PageTable, RecordPage, Section, TableCell
from rocking.reports.printing import MEASURED, compile_document
from rocking.reports.record import RecordReport, failure_page
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Arch, ArchOnPiers, Block, Facade, Frame, Joints, LoadedWall, Spire, Wall
from rocking.structures.crackable import crushing
from rocking.structures.kinds import StructureKind
from rocking.tables import cell
from rocking.warnings import RockingWarning
from tests.unit.assessment.made_rows import failure

from .conftest import HOSTILE, assessed, of_structures, pages, shaken

NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?(?:×10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?")
CSV_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
PLAIN = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")


def printed_numbers(text: str) -> list[tuple[float, float]]:
    """Numbers in a printed text, each with half a unit of its last digit."""
    numbers = []
    for token in NUMBER.findall(text):
        mantissa, _, exponent = token.translate(PLAIN).partition("×10")
        scale = 10.0 ** int(exponent or 0)
        decimals = len(mantissa.partition(".")[2])
        numbers.append((float(mantissa) * scale, 0.5 * 10.0**-decimals * scale))
    return numbers


def csv_numbers(example: RecordReport) -> np.ndarray:
    """Every number in every cell of the tables, in percent, and in g where it is one of m/s²."""
    tables = [getattr(example.tables, field.name) for field in fields(example.tables)]
    rows = [row for table in [*tables, structure_rows(example.structures)] for row in table]
    cells = (cell(getattr(row, name)) for row in rows for name in row.table.column_names)
    numbers = np.array([float(token) for text in cells for token in CSV_NUMBER.findall(text)])
    return np.concatenate([numbers, 100 * numbers, numbers / 9.80665])


def known(data: RecordPage) -> list[str]:
    """Every sentence of the second page, whatever its topic."""
    return [text for topic in data.known.topics for text in topic.texts]


def texts_of(data: RecordPage) -> list[str]:
    """Every table cell but the running numbers of the structures, every sentence, and the figures of page one."""
    texts = [*known(data), *data.advice.sentences, data.page_one.sine.share]
    texts += [peak.value for peak in data.page_one.peaks]
    for row in data.page_one.rows:
        texts += [row.below, row.chip.share, row.reserve, row.warning]
    for row in data.known.table.rows:
        texts += [cell.text if isinstance(cell, TableCell) else cell for cell in row]
    return texts


def with_tables(example: RecordReport, **changed) -> RecordPage:
    """The data of the report with other tables."""
    return replace(example, tables=replace(example.tables, **changed)).page()


@pytest.fixture(scope="module")
def data(example) -> RecordPage:
    return example.page()


def test_every_number_that_is_printed_stands_in_a_csv(example, data):
    structures = "|".join([*map(re.escape, example.structures), "D5–95"])  # names
    numbers = csv_numbers(example)
    printed = [
        printed_number
        for text in texts_of(data)
        for printed_number in printed_numbers(re.sub(structures, "", text))
    ]
    assert len(printed) > 40
    for value, half in printed:
        # rounding to the last printed digit, and the rounding of that comparison itself
        assert np.abs(numbers - value).min() <= half * (1 + 1e-9), value


def test_page_one_has_a_row_for_each_structure_the_worst_first_as_the_tables_have_it(example, data):
    by_name = {row.structure: row for row in example.tables.verdicts}
    words = [by_name[row.name].verdict for row in data.page_one.rows]
    assert words == sorted(words, key=ORDER.index)
    assert sorted(by_name) == sorted(row.name for row in data.page_one.rows)
    for row in data.page_one.rows:
        verdict = by_name[row.name]
        assert row.chip.verdict.removeprefix("? ") == verdict.verdict
        assert row.chip.share == verdict.decision.share_in_words
    falls = sum(word in ("overturns", "probably overturns") for word in words)
    assert data.conclusion.startswith(f"{falls} of {len(words)} structures overturn")


def test_a_mark_stands_where_its_rotation_is_on_a_scale_and_one_fall_no_farther_than_another(example, data):
    """A rotation ratio of 1 is 27 mm; what falls stands in the grey zone, which begins at 33.5 mm."""
    cases = {row.structure: row for row in example.tables.comparison}
    of_marks = {
        "form": "predicted_rotation_ratio",
        "block": "block_on_record_rotation_ratio",
        "whole": "integrated_rotation_ratio",
    }
    fallen: dict[str, set[float]] = {}
    for row in data.page_one.rows:
        for mark, column in of_marks.items():
            ratio = getattr(cases[row.name], column)
            if np.isinf(ratio):
                fallen.setdefault(mark, set()).add(getattr(row.marks, mark))
            else:
                assert getattr(row.marks, mark) == pytest.approx(27 * min(ratio, 1.2))
    (place,) = set.union(*fallen.values())
    assert len(fallen) > 1 and 33.5 < place < 49.5


@pytest.mark.process
@pytest.mark.parametrize("count", [12, 20, 30])
def test_a_client_gets_a_page_to_look_at_of_at_most_330_words(example, count):
    """With as many structures as the shipped example, and more: each is named there under its word."""
    kinds = [*example.structures]
    kind = {f"structure {place}": kinds[place % len(kinds)] for place in range(count)}
    report = of_structures(example, kind)
    first, *_ = pages(report.pdf())
    assert len(first) <= 330
    words = [word[4].strip(",:") for word in first]
    assert f"{count} structures overturn or probably do" in " ".join(words)
    assert {f"{place}" for place in range(count)} <= set(words)
    data = report.page()
    named = [(other.verdict, name) for other in data.page_one.others for name in other.names.split(", ")]
    named += [(row.chip.verdict.removeprefix("? "), row.name) for row in data.page_one.rows]
    assert sorted(named) == sorted(
        (str(verdict.verdict), verdict.structure) for verdict in report.tables.verdicts
    )


@pytest.mark.usefixtures("undrawn")
def test_page_one_counts_in_its_rows_how_the_sine_ends(example):
    """A fall that is over before the sine begins is none that it sees."""
    falling = {"predicted_rotation_ratio": np.inf, "integrated_rotation_ratio": np.inf}
    for acting, sees in ((Acts.DURING, True), (Acts.BEFORE, True), (Acts.AFTER, False)):
        rows = [
            replace(row, **falling, agreement=Agreement.SAME, pulse_acts=acting)
            for row in example.tables.comparison
        ]
        page = with_tables(example, comparison=rows).page_one
        count = len(page.rows)
        seen = count if sees else 0
        assert (
            page.sine.clause
            == f"The sine ends as the record in {seen} of {count}, and sees {seen} of {counted(count, 'fall')}."
        )


@pytest.mark.usefixtures("undrawn")
def test_an_outcome_that_processing_decides_is_told_but_of_what_its_network_has_corrected(example):
    """Such a record is not processed again, so that no processing of ours decides anything."""
    ratios = iter([0.3, np.inf])
    variations = [
        replace(row, integrated_rotation_ratio=next(ratios, 0.3))
        if row.processing and row.structure == "arch 20 m"
        else row
        for row in example.tables.variations
    ]
    corrected = tuple(
        replace(component, accelerogram=replace(component.accelerogram, processed=True))
        for component in example.result.components
    )
    of_network = replace(example, result=replace(example.result, components=corrected))
    for report, rows, decides in (
        (example, variations, True),
        (example, example.tables.variations, False),
        (of_network, variations, False),
    ):
        told = {topic.topic: topic.texts for topic in with_tables(report, variations=rows).known.topics}
        assert ("Processing" in told) is decides
        assert not decides or told["Processing"][0].endswith(" arch 20 m.")


@pytest.mark.usefixtures("undrawn")
def test_the_reason_of_a_miss_is_told_apart(example):
    """The block under the whole record overturns as the mechanism does: the pulse is the reason."""
    changed = {
        "agreement": Agreement.TOO_LOW,
        "integrated_rotation_ratio": np.inf,
        "block_on_record_rotation_ratio": np.inf,
        "mechanism_on_pulse_rotation_ratio": 0.2,
    }
    comparison = [replace(row, **changed) for row in example.tables.comparison]
    told = known(with_tables(example, comparison=comparison))
    (sentence,) = (warning for warning in told if warning.startswith("The closed form predicts less"))
    assert sentence.endswith("so the single pulse is the reason.")


def test_the_report_is_a_tagged_archive_document_of_two_pages_and_the_same_twice(example):
    document = example.pdf()
    assert document.startswith(b"%PDF-1.7") and example.pdf() == document
    assert b"<pdfaid:part>2</pdfaid:part>" in document and b"<pdfaid:conformance>A" in document
    assert max(int(count) for count in re.findall(rb"/Count (\d+)", document)) == 2


def test_every_picture_has_an_alternative_text(data):
    on_page_one = [*data.page_one.trace, *(picture for row in data.page_one.rows for picture in row.drawing)]
    assert len(on_page_one) == 1 + len(data.page_one.rows)
    assert all(len(picture.alt) > 20 for picture in on_page_one)


def extracted(document: bytes) -> str:
    """The text of a PDF, without any white space."""
    return "".join(word[4] for page in pages(document) for word in page)


@pytest.mark.process
def test_hostile_names_are_printed_as_they_are_and_the_factor_wherever_numbers_are(hostile):
    document = hostile.pdf()
    assert hostile.pdf() == document
    text = extracted(document)
    for name in HOSTILE:
        assert "".join(name.split()) in text, name
    for page in pages(document):
        assert "×12.5" in "".join(word[4] for word in page).replace("\u00a0", "")
    notice = hostile.page().notices[0]
    assert "×\u00a012.5" in notice.text and notice.strong


def test_nothing_that_lifts_no_structure_and_no_pulse_are_told_first():
    flat = [Accelerogram(np.zeros(400), 0.01, "EW")]
    cases = {
        "No structure uplifts": ([shaken()], {"squat": Block.of_size(2.0, 2.0)}),
        "No structure could be assessed": ([shaken()], {}),
        "No pulse could be searched for": (flat, {"block": Block.of_size(1.0, 4.0)}),
    }
    for notice, (records, structures) in cases.items():
        report = assessed("one", records, structures)
        data = report.page()
        assert any(notice in one_notice.text for one_notice in data.notices)
        assert report.pdf().startswith(b"%PDF")


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize(("failures", "last"), [
    (2, "s1: m1"), (3, "s2: m2"), (4, "Another 2 failures in failures.csv."),
])  # fmt: skip
def test_few_failures_and_every_factor_are_told_above_everything(example, failures, last):
    rows = [failure("", f"s{k}", f"m{k}", "e") for k in range(failures)]
    (record,) = example.tables.record
    scaled = [
        replace(record, component=name, scale_factor=factor) for name, factor in (("NS", 2.0), ("EW", 3.0))
    ]
    tables = replace(example.tables, failures=rows, record=scaled)
    factors, *told = replace(example, tables=tables).page().notices
    assert factors.text.endswith("a declared factor (×\u00a02, 3).")
    assert [notice.text for notice in told] == [*(f"s{k}: m{k}" for k in range(min(failures - 1, 2))), last]


def test_of_a_hundred_structures_few_are_drawn_and_the_others_named(example):
    names = [f"block {place}" for place in range(100)]
    data = of_structures(example, dict.fromkeys(names, "block 4 m")).page()
    assert len(data.page_one.rows) == 12
    assert data.page_one.others[0].names.endswith(" and 68 others")
    assert data.conclusion == "All 100 structures overturn or probably do."


@pytest.mark.process
@pytest.mark.parametrize("message", ["records/x.at2: #panic(1) $x^$ <b>.", "", "W" * 300])
def test_a_failure_is_one_page_that_says_why(message):
    document = compile_document(failure_page("bad #record$", message))
    assert re.findall(rb"/Count (\d+)", document) == [b"1"]
    assert "".join(message.split()) in extracted(document)


@pytest.mark.usefixtures("undrawn")
def test_a_contact_that_fails_is_told(example):
    comparison = [
        replace(row, slides=True, bounces=True, lifting_friction=0.2, required_friction=0.7)
        for row in example.tables.comparison
    ]
    data = with_tables(example, comparison=comparison)
    failing = f"{next(iter(example.structures))} (slides and bounces)"
    assert any(failing in sentence for sentence in known(data))
    slides = RockingWarning.of(AssessmentKind.CONTACT_SLIDES, lifting=0.2, largest=0.7).brief
    assert slides in {row.warning for row in data.page_one.rows}


@pytest.mark.usefixtures("undrawn")
def test_an_arch_that_stands_on_its_friction_is_no_model_that_fails(example):
    """Where a joint needs more than it has; on less than 0.5, or on piers, the model does not hold."""
    name = next(iter(example.structures))
    comparison = [
        replace(
            row,
            slides=row.structure == name,
            bounces=False,
            lifting_friction=0.49,
            required_friction=0.67,
        )
        for row in example.tables.comparison
    ]
    arch = Arch(radius=15.0, thickness=2.25, embrace_angle=2.75)
    piers = ArchOnPiers(5.0, 0.8, 3.14, pier_width=1.5, pier_height=4.0)
    stands = str(RockingWarning.of(ReportKind.STANDS_AS_VOUSSOIRS, name, needed=0.67))
    for structure, friction, told in ((arch, 0.6, True), (arch, 0.4, False), (piers, 0.6, False)):
        report = replace(
            example,
            structures={**example.structures, name: structure.on_joints(Joints(friction))},
        )
        data = with_tables(report, comparison=comparison)
        texts = known(data)
        assert (stands in texts) is told
        assert any(f"{name} (slides)" in text for text in texts) is not told
        beside = {row.name: row.warning for row in data.page_one.rows}[name]
        assert ("such arches stood" in beside and "0.67" in beside) is told, "page one and two say one thing"
        # What was followed as voussoirs needs neither: these are on the friction that it has.
        verdicts = [replace(row, stack_falls=0, stack_runs=18) for row in example.tables.verdicts]
        texts = known(with_tables(report, comparison=comparison, verdicts=verdicts))
        assert stands not in texts and not any(f"{name} (slides)" in one_text for one_text in texts)


@pytest.mark.usefixtures("undrawn")
def test_of_a_frame_that_was_followed_as_stones_its_contacts_are_known(example):
    """The sentence that nobody knows them stays with a frame of more columns, and where none was followed."""
    name = next(station.structure for station in example.result.worst_first if station.rotation_ratio > 0)
    followed = [replace(row, stack_falls=0, stack_runs=18) for row in example.tables.verdicts]
    scene = example.result.scenes[name]
    for columns, verdicts, told in (
        (2, example.tables.verdicts, True),
        (2, followed, False),
        (4, followed, True),
    ):
        frame = Frame(Block.of_size(breadth=1.1, height=8.0), columns, 0.3)
        periods = tuple(
            replace(period, scene=replace(period.scene, structure=frame)) for period in scene.periods
        )
        result = replace(
            example.result, scenes={**example.result.scenes, name: replace(scene, periods=periods)}
        )
        report = replace(
            example,
            result=result,
            structures={**example.structures, name: frame},
            tables=replace(example.tables, verdicts=verdicts),
        )
        assert (
            any(
                warning.kind is StructureKind.FRAME_CONTACTS and name in names
                for warning, names in report.left_out.items()
            )
            is told
        )


@pytest.mark.usefixtures("undrawn")
def test_a_reserve_that_may_be_too_high_is_grey(example):
    """Of a structure whose contacts open the mechanism knows too little."""
    name = next(
        one_station.structure for one_station in example.result.worst_first if one_station.reserve is not None
    )
    scene = example.result.scenes[name]
    station = scene.worst
    cases = {
        one_case: replace(case, limits=(Limit.untold(RockingWarning(AssessmentKind.CONTACTS_OPEN)),))
        for one_case, case in station.cases.items()
    }
    in_doubt = replace(scene, periods=(PeriodResult.of(station.scene, cases),))
    result = replace(example.result, scenes={**example.result.scenes, name: in_doubt})
    doubtful = replace(example, result=result, tables=rows_of_record(result, "cd" * 32, "CC0-1.0"))
    data = doubtful.page()
    assert [row.name for row in data.page_one.rows if row.alone] == [name]


@pytest.mark.usefixtures("undrawn")
def test_a_front_that_is_free_to_rock_through_its_floors_is_told():
    sizes = {"storey_heights": (3.5, 3.0), "thicknesses": (0.6, 0.5), "unit_weight": 20e3}
    fronts = {
        "floors": Facade(**sizes, floor_loads=(12e3, 6e3)),
        "leaning": Facade(**sizes, floor_loads=(12e3, 6e3), behind="cross_walls", restitution=0.5),
        "free": Facade(**sizes),
    }
    report = assessed("one", [shaken()], fronts)
    told = [part for part in known(report.page()) if str(RockingWarning(StructureKind.FLOORS_BEHIND)) in part]
    assert told == [str(RockingWarning(StructureKind.FLOORS_BEHIND, "floors"))]


def _columns(table: PageTable) -> list[tuple[str, tuple[str, ...]]]:
    """The heads of a table, each with what stands below it."""
    return list(zip(table.heads, zip(*table.rows, strict=True), strict=True))


@pytest.mark.usefixtures("undrawn")
def test_a_report_in_g_and_centimetres_prints_the_same_numbers_in_them(example):
    """Every number is that of SI units over the size of its unit: 9.80665 m/s², .01 m/s and .01 m."""
    settings = replace(example.settings, display_units="g and cm")
    plain = example.page()
    shown = replace(example, settings=settings).page()
    assert "m/s²" not in str(shown.known)
    sizes = {"[m/s²]": ("[g]", 9.80665), "[m/s]": ("[cm/s]", 0.01), "[m]": ("[cm]", 0.01)}
    (row,) = example.tables.record
    pulse = next(one_pulse for one_pulse in example.tables.pulses if one_pulse.rank == 1)
    components = dict(_columns(shown.known.table))
    assert components["PGV [cm/s]"] == (printing.number(row.peak_velocity_m_s / 0.01),)
    assert components["Sine: amplitude [g]"] == (printing.number(abs(pulse.amplitude_m_s2) / 9.80665),)
    pairs = zip(_columns(plain.known.table), _columns(shown.known.table), strict=True)
    for (head, before), (new_head, after) in pairs:
        unit = next((one_size for one_size in sizes if one_size in head), None)
        if unit is None:
            assert (new_head, after) == (head, before)
            continue
        name, size = sizes[unit]
        assert new_head == head.replace(unit, name)
        for old, new in zip(before, after, strict=True):
            ((first, half),) = printed_numbers(old)
            ((second, other),) = printed_numbers(new)
            assert abs(second * size - first) <= 1.001 * (half + other * size), (head, old, new)
    assert example.page() == plain, "the units are those of one report"


@pytest.mark.process
def test_the_report_says_what_to_do_and_by_how_much_the_record_may_be_stronger():
    """The courses of a spire that rocks may be thrown, which contact dynamics tells."""
    spire = Spire(3.0, 15.0, 0.25, crack_height=5.0, crack="known")
    structures = {"spire": spire, "block": Block.of_size(1.0, 4.0)}
    shaking = [shaken("NS", scale_factor=3.0), shaken("EW", scale_factor=2.0)]
    unasked = assessed("two", shaking, structures, fidelity="quick")
    data = unasked.page()
    assert data.advice.sentences == (
        f"To learn more of spire: {RockingWarning(AssessmentKind.CONTACT_DYNAMICS)}.",
    )
    warnings = {row.name: row.warning for row in data.page_one.rows}
    assert warnings["spire"] == RockingWarning(AssessmentKind.CONTACT_DYNAMICS).brief
    first = "".join(word[4] for word in pages(unasked.pdf())[0])
    assert RockingWarning(AssessmentKind.CONTACT_DYNAMICS).brief.replace(" ", "") in first

    report = assessed("two", shaking, structures)
    data = report.page()
    assert data.advice == Section(), "contact dynamics was asked"
    (block,) = (row for row in report.tables.verdicts if row.structure == "block")
    reserves = {row.name: row.reserve for row in data.page_one.rows}
    assert reserves["block"].startswith(printing.number(block.reserve_low, 2))
    first = "".join(word[4] for word in pages(report.pdf())[0])
    assert reserves["block"] in first


@pytest.mark.process
def test_page_one_says_that_a_crack_is_known_and_how_many_members_another_one_would_let_fall():
    wall = Wall.of_size(6.0, 0.4, 3.0)
    both = {"known": replace(wall, crack="known"), "typed": wall}
    report = assessed("one", [shaken("NS").scaled(0.5)], both)
    rows = {row.structure: row for row in report.tables.verdicts}
    below = {row.name: row.below for row in report.page().page_one.rows}
    other = rows["known"]
    assert other.statics_overturning_members > 0
    falls = f"{other.statics_overturning_members} of {other.statics_members}"
    assert below["known"].endswith(f"; crack known at 3 m (survey); {other.statics_crack}: {falls} fall")
    assert "known" not in below["typed"]
    assert rows["typed"].verdict.badness > rows["known"].verdict.badness
    first = " ".join(word[4] for word in pages(report.pdf())[0])
    assert "crack known at 3 m (survey);" in first
    for factor, says in ((3.0, f"{other.statics_crack}: 64 of 64 fall"), (0.12, "no other is in doubt")):
        shaking = [shaken("NS").scaled(factor)]
        (row,) = assessed("one", shaking, {"known": both["known"]}).page().page_one.rows
        assert row.below.endswith(f"; crack known at 3 m (survey); {says}"), factor


@pytest.mark.process
def test_page_one_tells_what_was_typed_and_what_crushing_would_change_before_page_two_explains_it():
    """Crushing is told where the motion is so near what overturns the wall that the loss of λ takes it there."""
    wall = LoadedWall.of_size(3.2, 0.25, 18e3, top_load=6e4, restitution=0.6)
    lost = wall.static_multiplier / crushing(wall).static_multiplier
    typed = Block.of_size(0.6, 4.0, restitution=0.6)
    own = replace(typed, restitution=None).mechanism().restitution
    seen = set()
    for factor in (2.0, 4.3):
        report = assessed("one", [shaken("NS").scaled(factor)], {"typed": typed, "wall": wall})
        told = report.page().page_one.legend
        assert f"typed: restitution 0.6 typed, {own:.2g} by geometry" in told
        (verdict,) = (row for row in report.tables.verdicts if row.structure == "wall")
        tells = "wall: crushing at 2 MPa would matter" in told
        assert tells == (verdict.reserve_low <= lost)
        assert tells == ("crush at 2 MPa" in " ".join(known(report.page())))
        seen.add(tells)
    assert seen == {False, True}
    first, *_ = pages(report.pdf())
    words = " ".join(word[4] for word in first)
    assert "Page 2 on typed: restitution 0.6 typed" in words


def test_every_figure_that_a_campaign_measured_names_where_it_stands():
    """The page of the documents says the figure, and the campaign is there to be run again."""
    root = Path(__file__).parents[3]
    for figure in MEASURED.values():
        assert (root / figure.source).exists()
        page = (root / "docs" / "pages" / figure.page).read_text(encoding="utf-8")
        assert NUMBER.findall(figure.figure)[0] in page


@pytest.mark.parametrize(("pulse_like", "printed"), [(True, "yes"), (False, "no")])
def test_whether_a_record_is_pulse_like_is_printed(example, pulse_like, printed):
    rows = [replace(row, velocity_pulse_like=pulse_like) for row in example.tables.record]
    texts = texts_of(with_tables(example, record=rows))
    assert texts.count(printed) >= len(rows) and {"yes": "no", "no": "yes"}[printed] not in texts
