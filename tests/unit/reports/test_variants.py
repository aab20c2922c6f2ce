"""The strip of the variants: what becomes of each, the difference to the first, and drawings on one scale."""

import math
import re
from dataclasses import replace

import pytest

from rocking import Block, DesignSpectrum, check
from rocking.assessment.conclusion import conclusions, worst_of_each
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import RecordRows
from rocking.assessment.scene import load_scenes, variants_of
from rocking.assessment.variants import VariantRow, variants
from rocking.products.checks.report import CheckedStructure, structures_data
from rocking.reports.explore import explore_page
from rocking.reports.sentences import Sentences
from rocking.reports.summary import summary_data
from rocking.reports.variants import strips
from rocking.study.settings import Settings
from rocking.tables import Row
from tests.unit.assessment import made_rows
from tests.unit.reports.conftest import SETTINGS, summarised

SPECTRUM = DesignSpectrum.ntc(ag=1.0, f0=2.5, tc_star=0.3)
THIN, THICK = Block.of_size(0.3, 3.0), Block.of_size(0.6, 3.0)
STRUCTURES = {"wall": THIN, "wall: thicker": THICK}
GROUPS = {"wall": ["wall: thicker"]}


@pytest.fixture(scope="module")
def made():
    """The wall falls in 48 of 64 members, the thicker one in 16; reserves of .5 and .9."""
    stations = [
        made_rows.station(
            replace(
                made_rows.case("N", math.inf if falls > 32 else 0.5, name, falls=falls),
                reserve=Reserve(low=low, median=2 * low, high=math.nan, limit=3.0),
            )
        )
        for name, falls, low in (("wall", 48, 0.5), ("wall: thicker", 16, 0.9))
    ]
    concluded = worst_of_each(conclusions(made_rows.verdicts(stations), []))
    return variants(GROUPS, concluded)


def test_a_list_says_which_structure_a_variant_is_of(tmp_path):
    path = tmp_path / "structures.yaml"
    path.write_text(
        "- {name: wall, type: block, breadth_m: 0.3, height_m: 3, variants: [{name: thicker, breadth_m: 0.6}]}\n"
        "- {name: pier, type: block, breadth_m: 2, height_m: 9}\n"
    )
    assert variants_of(load_scenes(path)) == GROUPS


def test_each_variant_has_its_difference_to_the_first(made):
    first, thicker = made["wall"]
    assert (first.variant, thicker.variant) == ("wall", "thicker")
    assert math.isnan(first.share_difference) and math.isnan(first.reserve_ratio)
    assert thicker.share_difference == pytest.approx(16 / 64 - 48 / 64)
    assert thicker.reserve_ratio == pytest.approx(0.9 / 0.5)
    assert issubclass(VariantRow, Row)
    _, unknown = variants(GROUPS, [first.conclusion])["wall"]
    assert (unknown.record, unknown.conclusion) == ("", None) and math.isnan(unknown.overturning_share)


def test_the_strip_says_it_in_words(made):
    (strip,) = strips(made, STRUCTURES, notes={"wall: thicker": ("It is checked.",)})
    first, thicker = strip.cells
    assert [first.chip.verdict, first.difference] == ["probably overturns", "the first"]
    assert thicker.difference == "reserve × 1.8, −50 points of share"
    assert (first.notes, thicker.notes) == ((), ("It is checked.", "breadth 0.6 m"))
    (italian,) = strips(made, STRUCTURES, Sentences("it"))
    assert italian.cells[1].difference == "margine × 1,8, −50 punti percentuali"
    assert italian.cells[1].notes == ("larghezza 0,6 m",), "a list would have its commas as semicolons"
    assert italian.cells[0].chip.verdict == "probab. ribalta"


def test_the_drawings_have_one_scale(made):
    """Both walls are 3 m high, and at rest as high in the picture; alone, the thick one would be drawn smaller."""
    (strip,) = strips(made, STRUCTURES)
    heights = []
    for cell in strip.cells:
        at_rest = re.search(r'<polygon points="([^"]*)" fill="none"', cell.drawing.svg).group(1)
        up = [float(point.split(",")[1]) for point in at_rest.split()]
        heights.append(max(up) - min(up))
    assert heights[0] == pytest.approx(heights[1], abs=2e-3)  # of points to three digits


def test_summary_page_to_explore_and_page_to_sign_hold_the_strip(made):
    drawn = strips(made, STRUCTURES)
    difference = drawn[0].cells[1].difference
    data = summary_data(summarised(RecordRows(), {}), SETTINGS, strips=drawn)
    assert data.strips == tuple(drawn)
    assert difference in explore_page([], STRUCTURES, strips=drawn).decode()
    pages = [
        CheckedStructure(
            name=name,
            structure=structure,
            checked=check(structure, SPECTRUM),
            variant_of="" if name == "wall" else "wall",
            worst=made["wall"][place].conclusion,
        )
        for place, (name, structure) in enumerate(STRUCTURES.items())
    ]
    for page in structures_data(pages, SPECTRUM, Settings().for_pages).sheets:
        told = [[cell.difference for cell in strip.cells] for strip in page.answers[0].basis.strips]
        assert told == ([["the first", difference]] if page.name == "wall" else []), "once"
        for strip in page.answers[0].basis.strips:
            ratios = [
                getattr(check(THICK, SPECTRUM), kind).ratio_in_words for kind in ("linear", "nonlinear")
            ]
            assert strip.cells[1].notes[0] == "linear {}, nonlinear {}".format(*ratios)


def test_a_difference_within_the_error_of_the_members_is_not_shown(made):
    """64 members err by 4 of 64 at most, 1 024 by 4 of 1 024: .05 is within both errors, .5 is not."""
    first, own = made["wall"]
    few = {"members": 64, "overturning_members": 48}

    def with_share(variant, share, **counts):
        row = replace(variant.conclusion.row, **counts)
        row = replace(row, decision=replace(row.decision, share=share))
        return replace(variant.conclusion, row=row)

    base = with_share(first, 0.75, **few)
    near = with_share(own, 0.70, members=1024, overturning_members=677)
    far = with_share(own, 0.25, members=1024, overturning_members=256)
    near, far = (variants(GROUPS, [base, other])["wall"][1] for other in (near, far))
    assert not near.shows_difference and far.shows_difference
