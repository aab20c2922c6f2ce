"""The table of checks and the pages to sign: one of each structure, findings with both figures, and what is refused."""

import csv
import math
import zipfile
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from rocking import Block, DesignSpectrum, Facade, Wall, check
from rocking.assessment.cracks import mechanisms_of
from rocking.assessment.decide import Decision, Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import MechanismRow, RecordRow, RecordRows
from rocking.assessment.scene import load_scenes, on_the_ground
from rocking.codes.check import DynamicCheck
from rocking.codes.kinds import CheckKind
from rocking.errors import ConfigurationError, RockingError
from rocking.floors.place import place_from_config
from rocking.motion.response import ModelCheck
from rocking.products.checks.conclusion import code_conclusion_in_words, code_conclusions
from rocking.products.checks.figures import bars_figure
from rocking.products.checks.report import CheckedStructure, structures_data
from rocking.products.checks.rows import CodeCheckRow, code_check_rows
from rocking.products.checks.work import Checks, write_checks
from rocking.reports.explore import explore_page
from rocking.reports.pages import Fact
from rocking.reports.sentences import Sentences
from rocking.reports.summary import summary_data
from rocking.structures.kinds import StructureKind
from rocking.structures.structure import AS_DESCRIBED
from rocking.study.job import Study
from rocking.study.kept import Kept, keep, kept_in
from rocking.study.settings import Settings, read_settings
from rocking.study.terminal import wrapped
from rocking.tables import read_table
from rocking.tables.workbook import workbook
from rocking.warnings import Kind, RockingWarning
from tests.made_pools import DESIGN, SETS, made_pool
from tests.refusals import refused
from tests.unit.assessment import made_rows
from tests.unit.assessment.made_rows import filled
from tests.unit.reports.conftest import SETTINGS, summarised

STRUCTURES = {
    "parapet": Block.of_size(0.45, 3.0),
    "front": Facade((3.5, 3.0), (0.6, 0.5), 20e3, floor_loads=(12e3, 6e3)),
}


@pytest.fixture
def study(tmp_path):
    rows = []
    for name, (first, _) in made_pool(12).items():
        lines = [f"{t:.2f} {a:.9f}" for t, a in zip(first.times, first.acceleration, strict=True)]
        (tmp_path / f"{name}.txt").write_text("\n".join(lines) + "\n")
        rows.append({"id": name, "file": f"{name}.txt", "unit": "m/s2", "station": name})
    with (tmp_path / "catalogue.csv").open("w", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    settings = {"catalogue": str(tmp_path / "catalogue.csv"), "processing": {"apply": "never"}}
    return settings, tmp_path


@pytest.mark.usefixtures("undrawn")
def test_a_structure_list_says_what_vibrates_freely_and_what_falls(study):
    """T_0 and the loss of support of an entry are those of `rocking.check`, and other structures keep theirs."""
    settings, folder = study
    listed = folder / "structures.yaml"
    listed.write_text(
        "- {name: plain, type: block, breadth_m: 0.45, height_m: 3.0}\n"
        "- {name: free, type: block, breadth_m: 0.45, height_m: 3.0, elastic_period_s: 0.12, support_loss_m: 0.05}\n"
    )
    structures = load_scenes(listed)
    changed = read_settings(settings | DESIGN)
    write_checks(Study(structures, changed), folder, [], [])
    spectrum = changed.design_spectrum.spectrum()
    rows = {(row.structure, row.check): row for row in read_table(CodeCheckRow, folder)}
    expected = check(STRUCTURES["parapet"], spectrum, elastic_period=0.12, support_loss=0.05)
    for name, by_hand in (("free", expected), ("plain", check(STRUCTURES["parapet"], spectrum))):
        for case, kind in ((by_hand.linear, "linear"), (by_hand.nonlinear, "nonlinear")):
            assert rows[name, kind].level_capacity_m_s2 == pytest.approx(case.capacity, rel=1e-12)
    assert rows["free", "nonlinear"].level_capacity_m_s2 < rows["plain", "nonlinear"].level_capacity_m_s2
    assert structures["free"].structure == structures["plain"].structure
    for wrong in ("elastic_period_s: 0", "support_loss_m: -1", "elastic_period_s: soon"):
        listed.write_text(f"- {{name: free, type: block, breadth_m: 0.45, height_m: 3.0, {wrong}}}\n")
        with pytest.raises(ConfigurationError, match=rf"\(free\): {wrong.split(':')[0]} is "):
            load_scenes(listed)


def test_every_structure_has_its_checks_and_its_page(study):
    settings, folder = study
    told = []
    write_checks(
        Study(on_the_ground(STRUCTURES), read_settings(settings | DESIGN)),
        folder,
        [],
        [],
        told.append,
    )
    rows = read_table(CodeCheckRow, folder)
    assert [(row.structure, row.check) for row in rows] == [
        (name, kind) for name in STRUCTURES for kind in ("linear", "nonlinear", "dynamic")
    ]
    spectrum = read_settings(DESIGN).design_spectrum.spectrum()
    for one_row in rows[:2]:
        alone = getattr(check(STRUCTURES["parapet"], spectrum), one_row.check)
        assert one_row.level_capacity_m_s2 == alone.capacity and one_row.ratio == alone.ratio
        assert one_row.passed == alone.passed and one_row.clause == alone.clause
    assert (folder / "structures.pdf").read_bytes().startswith(b"%PDF")
    assert len(told) == 2 and told[0].startswith("parapet: linear") and "None" not in told[0]


def test_a_page_lists_the_mechanisms_of_its_own_structure(study, monkeypatch):
    """Two of the same cracks, of which one falls in 16 of 64 members and the other in 48, and in no other place."""
    settings, folder = study
    scenes = on_the_ground({"one": STRUCTURES["front"], "other": STRUCTURES["front"]})
    crack = mechanisms_of(STRUCTURES["front"])[0].description
    rows = [
        filled(
            MechanismRow, record="a", structure=name, crack=crack, support_period_s=period, members=64,
            overturning_members=falls, hold_height_m=math.nan, largest_hold_force_n_per_m=math.nan,
        )
        for name, period, falls in (("one", None, 16), ("other", None, 48), ("one", 0.3, 64))
    ]  # fmt: skip
    pages = []
    monkeypatch.setattr(
        "rocking.products.checks.work.structures_data", lambda made, *_: pages.extend(made) or {}
    )
    monkeypatch.setattr("rocking.products.checks.work.write_document", lambda *_: None)
    written = Study(scenes, read_settings(settings | DESIGN))
    write_checks(written, folder, [], [filled(RecordRow, record="a", station="a")], mechanisms=rows)
    shares = [(page.name, page.mechanism_shares[page.mechanisms[0]]) for page in pages]
    assert shares == [("one", 0.25), ("other", 0.75)]


@pytest.mark.usefixtures("undrawn")
def test_without_sets_the_formulas_stand_and_the_page_says_so(study):
    settings, folder = study
    write_checks(
        Study(
            on_the_ground(STRUCTURES),
            read_settings(settings | DESIGN | {"checks": SETS | {"stations": 40}}),
        ),
        folder,
        [],
        [],
    )
    assert {row.check for row in read_table(CodeCheckRow, folder)} == {"linear", "nonlinear"}


def test_checks_without_a_design_level_are_refused(study):
    settings, folder = study
    with refused(ConfigurationError, "design_spectrum"):
        write_checks(Study(on_the_ground(STRUCTURES), read_settings(settings)), folder, [], [])


@pytest.mark.usefixtures("undrawn")
def test_a_fault_in_the_checks_of_a_structure_costs_no_other(study, monkeypatch):
    settings, folder = study
    followed = check

    def check_but_one(structure, spectrum, **terms):
        return followed(structure, spectrum, **terms) if structure is not STRUCTURES["parapet"] else 1 / 0

    monkeypatch.setattr("rocking.products.checks.work.check", check_but_one)
    told = []
    structures = STRUCTURES | {"pier": Block.of_size(0.6, 2.0)}
    changed = read_settings(settings | DESIGN | {"checks": SETS | {"stations": 40}})
    rows, faults = write_checks(Study(on_the_ground(structures), changed), folder, [], [], told.append)
    assert [(fault.structure, fault.stage) for fault in faults] == [("parapet", "document")]
    assert {row.structure for row in rows} == {*structures} - {"parapet"} != set()
    assert any(line.startswith("parapet: ") and "parapet (ZeroDivisionError" in line for line in told)
    assert (folder / "structures.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.usefixtures("undrawn")
def test_a_structure_whose_mechanisms_are_refused_is_told_with_the_reason_and_costs_no_other(
    study, monkeypatch
):
    settings, folder = study

    def refuse(page, *_):
        if page.name == "parapet":
            raise RockingError("its forces are not known.")
        return page

    monkeypatch.setattr("rocking.products.checks.work._with_mechanisms", refuse)
    told = []
    rows, _ = write_checks(
        Study(on_the_ground(STRUCTURES), read_settings(settings | DESIGN)), folder, [], [], told.append
    )
    assert "parapet: its forces are not known." in told
    assert {row.structure for row in rows} == {"front"}


@pytest.mark.usefixtures("undrawn")
def test_a_structure_that_cannot_be_checked_costs_no_other(study):
    settings, folder = study
    points = folder / "site.csv"
    points.write_text("period_s,acceleration_g\n0,0.2\n0.5,0.5\n1.0,0.2\n")
    design = {"design_spectrum": {"points": str(points)}, "checks": {"stations": 40}}
    structures = {"slender": Block.of_size(0.4, 6.0), "stout": Block.of_size(0.4, 0.5)}
    told = []
    write_checks(
        Study(on_the_ground(structures), read_settings(settings | design)),
        folder,
        [],
        [],
        told.append,
    )
    assert "the spectrum ends at 1 s" in told[0]
    assert {row.structure for row in read_table(CodeCheckRow, folder)} == {"stout"}


def found(passed, exceeding=0, **others):
    values = {
        "clause": "C8.7.1.2.1.9", "limit_state": "SLV", "capacity": 0.1, "demand": 0.05 if passed else 0.2,
        "mechanism": AS_DESCRIBED, "unit": "m", "refusal": None if passed else RockingWarning(CheckKind.CHECK_NOT_MET),
        "exceeding": exceeding,
        "motions": 40, "stations": 57,
        "earthquakes": 20, "sets": 200, "share": 1.0 if passed else 0.1, "interval": (0.0, 1.0),
    }  # fmt: skip
    return DynamicCheck(**values | others)


FORMULAS = check(Block.of_size(0.6, 2.0), DesignSpectrum.ntc(1.0, 2.5, 0.3))
WEAK = check(Block.of_size(0.1, 2.0), DesignSpectrum.ntc(1.0, 2.5, 0.3))
FEW = RockingWarning.of(CheckKind.SETS_TOO_FEW, sets=72, asked=200)
UNLIKE = RockingWarning.of(CheckKind.SETS_DISAGREE, share_percent=44.0, sets=200, least_percent=95.0)


@pytest.mark.parametrize(
    ("formulas", "dynamic", "clause", "verified", "parts"),
    [
        (FORMULAS, None, "C8.7.1.2.1.8", True, ["counts too", "decides"]),
        (WEAK, None, "C8.7.1.2.1.8", False, ["counts too", "decides"]),
        (FORMULAS, found(True), "C8.7.1.2.1.9", True, ["counts too", "counts too", "decides"]),
        (WEAK, found(True), "C8.7.1.2.1.9", True, ["not needed", "not needed", "decides"]),
        (FORMULAS, found(False, 3), "C8.7.1.2.1.9", False, ["overruled", "overruled", "decides"]),
        (FORMULAS, found(True, refusal=UNLIKE), "C8.7.1.2.1.9", False, ["overruled", "overruled", "decides"]),
        (FORMULAS, found(True, refusal=FEW), "C8.7.1.2.1.8", True, ["counts too", "decides", "no answer"]),
    ],
    ids=["formulas", "neither", "all", "dynamic alone", "falls", "sets disagree", "few sets"],
)
def test_the_most_detailed_check_that_has_an_answer_decides(formulas, dynamic, clause, verified, parts):
    checked = replace(formulas, dynamic=dynamic)
    assert checked.decisive.clause == clause
    assert checked.verified == verified
    assert [checked.part_of(check) for check in checked.checks] == parts
    (conclusion,) = code_conclusions(code_check_rows("wall", checked))
    assert str(conclusion.warning) == f"{'verified' if verified else 'not verified'} by {clause}"
    beside = "other stations would" in str(conclusion)
    assert beside == (verified and dynamic is not None)


def test_of_a_support_the_worst_period_counts_and_never_the_ground_below_it():
    """At T_b 0.2 s the dynamic check is met, at 0.4 s it is not, and on the ground the ratio is least of all."""
    places = {0.0: found(False, 9), 0.2: found(True), 0.4: found(False, 3)}
    rows = [
        row
        for period, dynamic in places.items()
        for row in code_check_rows("parapet", replace(FORMULAS, dynamic=dynamic), period)
    ]
    (conclusion,) = code_conclusions(rows)
    assert conclusion.period == 0.4
    assert conclusion.name == "parapet, T_b 0.4 s"
    assert not conclusion.verified
    assert {sentence.period for sentence in conclusion.elsewhere} == {0.0, 0.2}
    assert conclusion.ratios["dynamic"] == "0.500"


def test_one_sentence_tells_what_is_verified_and_what_other_stations_would_say():
    rows = [
        row
        for name, low in (("pier", 0.2), ("wall", 0.4))
        for row in code_check_rows(name, replace(FORMULAS, dynamic=found(True, interval=(low, 1.0))))
    ]
    rows += code_check_rows("spire", WEAK)
    verified = "By the code 2 of 3 structures are verified at the design level: pier, wall; these records may exceed it"
    assert code_conclusion_in_words(code_conclusions(rows)) == (
        f"{verified}; 20–100\u00a0% of sets of other stations would agree."
    )
    assert code_conclusion_in_words(code_conclusions(code_check_rows("spire", WEAK))) == (
        "By the code none of 1 structure is verified at the design level."
    )
    assert code_conclusion_in_words([]) == ""


def test_an_interval_that_spans_everything_is_told_as_too_few_stations():
    """ "0–100 %" tells a reader nothing, wherever it would stand."""
    rows = code_check_rows("pier", replace(FORMULAS, dynamic=found(True, interval=(0.004, 1.0))))
    (conclusion,) = code_conclusions(rows)
    assert conclusion.other_sets == RockingWarning(CheckKind.OTHER_SETS_UNKNOWN)
    assert "too few stations" in conclusion.other_share_in_words
    assert "too few stations to speak for others" in code_conclusion_in_words([conclusion])
    (wide,) = code_conclusions(
        code_check_rows("pier", replace(FORMULAS, dynamic=found(True, interval=(0.01, 1.0))))
    )
    assert wide.other_share_in_words == "1–100\u00a0%"


def test_the_same_conclusion_stands_in_terminal_summary_workbook_and_page_to_explore(tmp_path):
    checked = replace(FORMULAS, dynamic=found(True, interval=(0.2, 1.0)))
    rows = list(code_check_rows("pier", checked))
    concluded = code_conclusions(rows)
    sentence = code_conclusion_in_words(concluded)
    keep(tmp_path / "checks.json", Kept({CodeCheckRow: rows}, sentence))
    kept = kept_in(tmp_path / "checks.json", ()).conclusion
    assert " ".join(line.strip(" ") for line in wrapped(kept)) == sentence
    work = Checks()
    beside = {CodeCheckRow: rows}
    panel = work.panel(beside)
    data = summary_data(summarised(RecordRows(), {}), SETTINGS, None, (), [kept], [panel])
    assert data.conclusions == (sentence,) and data.panels == (panel,)
    ((name, *ratios, conclusion, others),) = data.panels[0].parts[0].table.rows
    assert [name.text, conclusion] == ["pier", "verified by C8.7.1.2.1.9"]
    assert ratios == [check.ratio_in_words for check in checked.checks]
    assert others == "20–100\u00a0%"
    notes = {structure: [note] for structure, note in work.notes(beside).items()}
    page = explore_page([], {"pier": STRUCTURES["parapet"]}, "", [kept], notes).decode()
    assert sentence in page and "By the code, at the design level: verified by C8.7.1.2.1.9 (20–100" in page
    with zipfile.ZipFile(BytesIO(workbook({CodeCheckRow: rows}))) as book:
        sheet = book.read("xl/worksheets/sheet2.xml").decode()
    assert "C8.7.1.2.1.9" in sheet and "decides" in sheet


def page_of(checked=FORMULAS, language="en", name="wall", **facts):
    """What the template is given for one page."""
    page = CheckedStructure(name=name, structure=Block.of_size(0.6, 2.0), checked=checked, **facts)
    settings = Settings(language=language).for_pages_to_sign
    (data,) = structures_data([page], DesignSpectrum.ntc(1.0, 2.5, 0.3), settings).sheets
    return data


@pytest.mark.usefixtures("undrawn")
def test_a_page_ends_in_a_sentence():
    met = page_of(replace(FORMULAS, dynamic=found(True, interval=(0.35, 1.0))))
    assert met.headline == "Verified by C8.7.1.2.1.9, and by C8.7.1.2.1.8 and C8.7.1.2.1.7."
    assert "met by 35–100\u00a0%" in " ".join(met.details)
    falls = page_of(replace(FORMULAS, dynamic=found(False, 3)))
    assert falls.headline == "Not verified: d₀ is exceeded under 3 of 40 motions (C8.7.1.2.1.9)."
    assert "Met: linear check and nonlinear check; but C8.7.1.2.1.9" in " ".join(falls.details)
    unlike = page_of(replace(FORMULAS, dynamic=found(True, refusal=UNLIKE, share=0.44)))
    assert unlike.headline.startswith("Not verified: 44\u00a0% of 200 sets of records meet C8.7.1.2.1.9")
    assert page_of(WEAK).headline.startswith("Not verified: C8.7.1.2.1.8 gives 0.")
    assert falls.answers and met.answers, "either is a finding"
    refused = page_of(None, refusal="the spectrum ends at 1 s.")
    assert not refused.answers, "what was not checked is not signed"
    assert "the spectrum ends at 1 s" in refused.details[0]


@pytest.mark.usefixtures("undrawn")
def test_a_study_that_contradicts_the_checks_is_told_with_its_figure():
    often = page_of(overturning_share=0.25, stations=20, records=40, peaks=(1.96, 4.90))
    told = " ".join(often.details)
    assert "met at the design level, whose peak is 0.10 g" in told, "1.0 m/s² on rock, without amplification"
    assert "of 20 stations, act with peaks from 0.20 to 0.50 g, and 25 % of its members overturn" in told
    never = page_of(WEAK, overturning_share=0.0, stations=20, records=40)
    assert "no member overturns" in " ".join(never.details)
    for share, told in ((0.1, False), (0.101, True)):
        details = page_of(overturning_share=share, stations=20, records=40).details
        assert ("stations" in " ".join(details)) is told


@pytest.mark.usefixtures("undrawn")
def test_the_page_of_a_structure_on_a_support_lists_the_other_places():
    """Its own is that of the worst period; 0.1/0.05 m, 0.1/0.2 m; what could not be checked is said with its reason."""
    place = place_from_config({"name": "roof", "period_s": [0.2, 0.6], "participation": 1.3})
    at = dict(zip(("worst", "met", "unknown", "ground"), (*place.supports[1:4], None), strict=True))
    page = CheckedStructure(
        name="wall",
        structure=Block.of_size(0.6, 2.0),
        checked=replace(FORMULAS, dynamic=found(False, 9)),
        place=place,
    )
    met, missed = (replace(FORMULAS, dynamic=found(is_met, 3)) for is_met in (True, False))
    pages = [
        replace(page, support=at["worst"]),
        replace(page, support=at["met"], checked=met, overturning_share=0.25, stations=20),
        replace(page, support=at["unknown"], checked=None, refusal="the spectrum ends at 1 s."),
        replace(page, support=at["ground"], checked=missed),
    ]
    (sheet,) = structures_data(pages, DesignSpectrum.ntc(1.0, 2.5, 0.3), Settings().for_pages_to_sign).sheets
    linear, nonlinear = (f"{check.ratio:.2f}" for check in FORMULAS.checks)
    places = sheet.answers[0].basis.periods
    assert places.heads == ("Place", "linear", "nonlinear", "dynamic", "Conclusion", "Overturns")
    assert [[getattr(cell, "text", cell) for cell in line] for line in places.rows] == [
        ["T_b 0.263 s", linear, nonlinear, "2.00", "verified by C8.7.1.2.1.9", "25\u00a0%"],
        ["T_b 0.302 s", "–", "–", "–", "It could not be checked: the spectrum ends at 1 s.", "–"],
        ["on the ground (for comparison)", linear, nonlinear, "0.500", "not verified by C8.7.1.2.1.9", "–"],
    ]


@pytest.mark.usefixtures("undrawn")
def test_a_structure_that_only_its_tie_holds_says_so():
    strength = {"tie_heights": (2.9,), "tie_stiffness": 1e6, "tie_strength": 20e3}
    tied = Facade((3.0,), (0.5,), unit_weight=20e3, **strength)
    spectrum = DesignSpectrum.ntc(1.0, 2.5, 0.3)
    page = CheckedStructure(name="front", structure=tied, checked=FORMULAS, untied=WEAK)
    (data,) = structures_data([page], spectrum, Settings().for_pages).sheets
    assert data.headline.endswith(", only with its tie.")
    assert "Without its tie C8.7.1.2.1.8 is not met." in data.details
    page = replace(page, untied=FORMULAS)
    (data,) = structures_data([page], spectrum, Settings().for_pages).sheets
    assert "only with" not in data.headline
    bare = tied.without_ties()
    assert not bare.tie_heights and bare.mechanism().positive.ties == ()
    assert bare == Facade((3.0,), (0.5,), unit_weight=20e3)


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("language", ["en", "it"])
def test_a_page_says_that_a_crack_is_known_and_what_the_check_would_be_were_it_not(language):
    spectrum = DesignSpectrum.ntc(0.2 * 9.80665, 2.4, 0.35)
    wall = Wall.of_size(3.2, 0.25, 1.6, crack="known")
    words = Sentences(language)
    told = {}
    for case in (wall, replace(wall, crack=None)):
        page = CheckedStructure(name="wall", structure=case, checked=check(case, spectrum))
        (told[case.crack],) = structures_data(
            [page], spectrum, Settings(language=language).for_pages_to_sign
        ).sheets
    known = words.of(RockingWarning.of(StructureKind.CRACK_KNOWN_AT, height_m=1.6))
    assert f"{known[:1].upper()}{known[1:]}." in told["known"].answers[0].assumptions
    assert not any(known in line.lower() for line in told[None].answers[0].assumptions)
    (other,) = (detail for detail in told["known"].details if words.number(0.888) in detail)
    assert "C8.7.1.2.1.8" in other
    assert told["known"].met and not told[None].met


@pytest.mark.usefixtures("undrawn")
def test_a_check_that_is_met_tells_how_far_its_stations_speak_for_others():
    """Of 57 stations none: at most 5.1 % of all at 95 %, as (1 − .0512)^57 = .05; "" where not met."""
    met = found(True, interval=(0.35, 1.0))
    assert met.caution["stations"] == 57
    assert met.caution["unseen_percent"] == pytest.approx(5.12, abs=0.01)
    assert met.caution["least_percent"] == 35.0
    assert pytest.approx(0.05, rel=2e-3) == (1 - 0.0512) ** 57
    assert found(False).caution is None


def test_the_page_names_the_client_and_what_the_checks_rest_on():
    spectrum = DesignSpectrum.ntc(1.0, 2.5, 0.3)
    checked = check(STRUCTURES["parapet"], spectrum)
    page = CheckedStructure(
        name="parapet",
        structure=STRUCTURES["parapet"],
        checked=checked,
        overturning_share=0.5,
        records=6,
        stations=4,
    )
    settings = Settings(client="The town").for_pages
    data = structures_data([page], spectrum, settings)
    assert Fact(label="client", text="The town") in data.about
    (text,) = data.sheets
    (share,) = text.answers[0].sure
    assert share.value == "50\u00a0%"
    assert "6 records of 4 stations" in share.text
    assert text.answers[0].bars[0].svg.startswith("<?xml") and text.answers[0].basis.figure[0].svg.startswith(
        "<?xml"
    )
    assert f"T_SLV = {checked.limit.period:.3g}" in " ".join(text.answers[0].basis.sentences)
    assert [line[0] for line in text.answers[0].basis.checks.rows] == ["linear", "nonlinear"]


@pytest.mark.usefixtures("undrawn")
def test_the_page_tells_a_reserve_that_was_not_sought_from_one_that_was_not_reached():
    spectrum = DesignSpectrum.ntc(1.0, 2.5, 0.3)

    def share(*reserves: Reserve, warnings: tuple[Kind, ...] = ()) -> str:
        page = CheckedStructure(
            name="parapet",
            structure=STRUCTURES["parapet"],
            checked=check(STRUCTURES["parapet"], spectrum),
            overturning_share=0.5,
            stations=4,
            reserves=reserves,
            reserve_warnings=warnings,
        )
        (data,) = structures_data([page], spectrum, Settings().for_pages).sheets
        lines = [f"{sentence.value} {sentence.text}" for sentence in data.answers[0].sure[1:]]
        return lines[0] if lines else data.answers[0].basis.share

    never = Reserve(low=math.nan, median=math.nan, high=math.nan, limit=3.0)
    low = Reserve(low=0.8, median=1.1, high=math.nan, limit=3.0)
    high = Reserve(low=1.6, median=2.2, high=3.0, limit=3.0)
    assert "No reserve was searched for" in share()
    assert (
        share(never, never) == "3\u00a0× applied to any record lets fewer than 5 % of the members overturn."
    )
    both = share(high, low, never)
    assert both.startswith("0.80\u00a0× applied to the most demanding record lets 5 %")
    assert both.endswith("; the median over 3 records is 1.6\u00a0×.")
    assert "the median over 3 records is > 3\u00a0×" in share(low, never, never)
    assert share(low, warnings=(AssessmentKind.CONTACTS_OPEN,)).endswith("too high where contacts open.")


@pytest.mark.usefixtures("undrawn")
def test_the_page_to_sign_carries_the_caveat_of_page_one(study, monkeypatch):
    """Also where the structure falls as a mechanism, so that its verdict needs no doubt and its reason names none."""
    settings, folder = study
    lifting = replace(
        made_rows.case("N", math.inf, "parapet", falls=64),
        check=ModelCheck(0.3, True, ""),
        reserve=Reserve(low=0.6, median=0.7, high=0.8, limit=3.0),
    )
    station = made_rows.station(lifting)
    verdicts = made_rows.verdicts([station])
    records = [filled(RecordRow, record="a", samples=2)]
    pages = []
    monkeypatch.setattr(
        "rocking.products.checks.work.structures_data", lambda made, *_: pages.extend(made) or {}
    )
    monkeypatch.setattr("rocking.reports.printing.compile_document", lambda *_: b"")
    changed = read_settings(settings | DESIGN)
    write_checks(Study(on_the_ground(STRUCTURES), changed), folder, verdicts, records)
    data = structures_data(pages, DesignSpectrum.ntc(1.0, 2.5, 0.3), Settings().for_pages)
    signed = {
        page.name: " ".join(sentence.text for sentence in text.answers[0].sure)
        for page, text in zip(pages, data.sheets, strict=True)
    }
    caveat = station.reserve_in_words.partition("; ")[2]
    assert caveat
    assert signed["parapet"].endswith(f"{caveat}.")
    assert caveat not in signed["front"]


def test_a_ratio_of_what_hardly_moves_says_that_it_is_large():
    assert found(True, demand=1e-9).ratio_in_words == found(True, demand=0.0).ratio_in_words == "> 100"
    assert found(True, demand=0.05).ratio_in_words == "2.00"


def test_a_front_that_falls_between_two_ties_is_drawn_below_its_bay():
    front = Facade(
        (3.2,), (0.4,), 18e3, floor_loads=(5e3,), restitution=0.6, behind="cross_walls", tie_heights=(3.2,),
        tie_stiffness=2e7, tie_spacing=6.0, unit_length=0.5,
    )  # fmt: skip
    figure = bars_figure(front, check(front, DesignSpectrum.ntc(2.0, 2.5, 0.35)), None, Sentences("en"))
    drawn, bay, _ = (axes.get_position() for axes in figure.axes)
    assert 0 < drawn.y0 < drawn.y1 < bay.y0 < bay.y1 < 1


@pytest.mark.parametrize("share", [0.03, 0.45, 1.3, 4.0])
def test_a_ratio_is_white_within_its_bar_and_black_on_the_paper(share):
    """Far above 1, above it, a little below, and far below: asked of the picture."""
    spectrum = DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    checked = check(STRUCTURES["parapet"], spectrum.at(share * spectrum.level))
    figure = bars_figure(STRUCTURES["parapet"], checked, None, Sentences("en"))
    FigureCanvasAgg(figure).draw()
    axes = figure.axes[1]
    bars = [patch.get_window_extent() for patch in axes.patches[1:]]
    ratios = {f"{one.ratio:.3g}" for one in checked.checks}
    inks = [text for text in axes.texts if text.get_text() in ratios]
    assert len(inks) == len(bars) == len(checked.checks)
    for text, bar in zip(inks, bars, strict=True):
        extent = text.get_window_extent()
        within = bar.x0 < (extent.x0 + extent.x1) / 2 < bar.x1
        assert text.get_color() == ("white" if within else "black")


@pytest.mark.usefixtures("undrawn")
def test_a_page_says_on_what_its_structure_stands_and_what_is_not_checked(tmp_path):
    """On a support its modes; on the ground beside it that the page is no page to sign; of endless ties their force."""
    listed = tmp_path / "structures.yaml"
    listed.write_text(
        "- {name: roof, type: support, period_s: 0.25, participation: 1.3}\n"
        "- {name: parapet, type: block, breadth_m: 0.45, height_m: 3.0, stands_on: roof}\n"
        "- {name: plain, type: block, breadth_m: 0.45, height_m: 3.0}\n"
        "- {name: tied, type: facade, storey_heights_m: [3.0], thicknesses_m: [0.5], unit_weight_kN_m3: 20, "
        "tie_heights_m: [2.9], tie_stiffness_kN_m2: 40}\n"
    )
    spectrum = DesignSpectrum.ntc(1.0, 2.5, 0.3)
    pages = [
        CheckedStructure(
            name=name,
            structure=load_scene.structure,
            checked=check(load_scene.structure, spectrum, support=support),
            place=load_scene.place,
            support=support,
        )
        for name, load_scene in load_scenes(listed).items()
        for support in load_scene.place.axis
    ]
    data = structures_data(pages, spectrum, Settings().for_pages)
    page = {sheet.name: sheet for sheet in data.sheets}
    assert list(page) == ["parapet", "plain", "tied"], "the ground of a support is a line of its page"
    assert "stands on roof, a support of period 0.250" in " ".join(page["parapet"].answers[0].assumptions)
    assert page["parapet"].place == "roof with T_b 0.250 s."
    assert page["plain"].place == ""
    (ground,) = page["parapet"].answers[0].basis.periods.rows
    assert ground[0] == "on the ground (for comparison)"
    assert ground[1] == pages[0].checked.linear.ratio_in_words
    assert page["plain"].answers[0].basis.periods.rows == ()
    (tied,) = [one_page.checked.warning for one_page in pages if one_page.name == "tied"]
    assert tied.kind is StructureKind.TIE_MUST_BEAR
    assert str(tied) in " ".join(page["tied"].answers[0].basis.sentences)
    assert not any("strength" in text for text in page["plain"].answers[0].basis.sentences)


@pytest.mark.parametrize("units", ["SI", "g and cm"])
def test_a_limit_displacement_is_drawn_on_the_capacity_curve_in_every_unit(units, monkeypatch):
    figures = []

    def kept(figure, alt):
        figures.append(figure)
        return {}

    monkeypatch.setattr("rocking.products.checks.report.picture", kept)  # the curve is drawn last
    block = STRUCTURES["parapet"]
    spectrum = DesignSpectrum.ntc(1.0, 2.5, 0.3)
    page = CheckedStructure(name="parapet", structure=block, checked=check(block, spectrum))
    structures_data([page], spectrum, Settings(display_units=units).for_pages)
    (axes,) = (one_axes_ for one_axes_ in figures[-1].axes if one_axes_.get_xlabel())
    curve, *others = axes.lines
    marked = [line.get_xydata()[0] for line in others if line.get_marker() == "o"]
    assert len(marked) == 2
    for displacement, acceleration in marked:
        # a block's curve is straight but for sin φ and cos φ, so that between its points it is met to 1e-3
        assert acceleration == pytest.approx(np.interp(displacement, *curve.get_data()), rel=1e-3)


@pytest.mark.usefixtures("undrawn")
def test_each_page_tells_the_share_of_its_own_structure(study, monkeypatch):
    """One structure overturns under every record and the other under none: no page may take the other's verdicts."""
    settings, folder = study
    shares = {"parapet": 1.0, "front": 0.0}
    verdicts = [
        made_rows.decided(
            Decision(Verdict.OVERTURNS if share else Verdict.STANDS, share, (share, share), ""),
            structure=structure,
            record=record,
        )
        for structure, share in shares.items()
        for record in ("a", "b", "c")
    ]
    records = [filled(RecordRow, record=name, station=name) for name in ("a", "b", "c")]
    pages = {}

    def report(structures, *_):
        pages.update((structure.name, structure) for structure in structures)
        return {}

    monkeypatch.setattr("rocking.products.checks.work.structures_data", report)
    monkeypatch.setattr("rocking.reports.printing.compile_document", lambda *_: b"")
    changed = read_settings(settings | DESIGN)
    write_checks(Study(on_the_ground(STRUCTURES), changed), folder, verdicts, records)
    assert {name: page.overturning_share for name, page in pages.items()} == shares
    assert all(page.records == page.stations == 3 for page in pages.values())
