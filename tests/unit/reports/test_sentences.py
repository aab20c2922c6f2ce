"""The catalogue of the pages to sign: whole in both languages, and an Italian page has no English sentence."""

import ast
import inspect
import re
from contextlib import suppress
from dataclasses import fields, is_dataclass
from string import Formatter
from typing import get_args

import numpy as np
import pytest

from rocking import Block, CapacityCurve, DesignSpectrum, Facade, LoadedWall, Wall, check
from rocking.assessment.decide import Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.reserve import Reserve
from rocking.codes.kinds import CheckKind
from rocking.codes.selection import random_sets, search
from rocking.errors import RockingError
from rocking.floors.kinds import FloorKind
from rocking.products.checks import figures, report
from rocking.products.checks.report import CheckedStructure, structures_data
from rocking.products.checks.work import mechanisms_of
from rocking.reports import sentences
from rocking.reports.kinds import ReportKind
from rocking.reports.pages import Language, Picture
from rocking.reports.printing import displaying
from rocking.reports.sentences import Sentences, catalogue
from rocking.structures.kinds import StructureKind
from rocking.structures.structure_list import TYPES, structure_from_config
from rocking.study.settings import Settings
from rocking.warnings import RockingWarning

ITALIAN = Sentences("it")
ITALIAN_TEXTS = catalogue("it")
SPECTRUM = DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35, soil="C")


def named(text):
    return sorted({name for _, name, _, _ in Formatter().parse(text) if name})


@pytest.mark.parametrize(("context", "english"), ITALIAN_TEXTS)
def test_both_languages_name_the_same_values(context, english):
    italian = ITALIAN_TEXTS[context, english]
    assert italian and set(named(italian)) <= {*named(english), "about"}


def test_a_page_says_what_stands_behind_in_the_words_of_its_language():
    front = Facade((3.0,), (0.5,), unit_weight=20e3, behind="cross_walls", restitution=0.6)
    given = next(value for value in front.described.values if value.field.name == "behind")
    assert ITALIAN.described(given) == "elemento a tergo muri trasversali"
    assert "cross walls" in Sentences().described(given)


@pytest.mark.parametrize(
    "refuse",
    [
        lambda: next(random_sets(np.array(["a", "b", "c"]), 7, 10, np.random.default_rng(1))),
        lambda: search(np.full((3, 4), 5.0), [np.array([[0, 1, 2]])], 0.1, 0.3),
        lambda: CapacityCurve((0.0, 0.1), (0.1, 0.0), weight=1e3, restitution=0.9).static_capacity(),
    ],
)
def test_what_is_refused_on_a_page_is_told_in_its_language(refuse):
    with pytest.raises(RockingError) as caught:
        refuse()
    warning = caught.value.warning
    assert str(caught.value) == str(warning)
    assert ITALIAN.reason(warning) != Sentences("en").reason(warning) == str(warning)
    assert ITALIAN.reason("a file is missing.").startswith("(in inglese)")


def test_a_quantity_is_shown_in_the_unit_of_the_study():
    words = Sentences("en")
    assert words.quantity(9.80665, "m/s²") == "9.81\u00a0m/s²"
    with displaying(Settings(display_units="g and cm").for_pages):
        assert words.quantity(9.80665, "m/s²") == "1.00\u00a0g"
        assert words.quantity(0.25, "m") == "25.0\u00a0cm"


def test_numbers_have_the_mark_of_their_language():
    assert Sentences().number(0.4321) == "0.432"
    assert ITALIAN.number(0.4321) == "0,432"
    assert ITALIAN.of(RockingWarning.of(CheckKind.LIMIT_SHARE, share=0.4)) == "0,4 d₀"
    assert ITALIAN.of(RockingWarning.of(CheckKind.DISPLACEMENT_EXCEEDED, exceeding=3, motions=40)).endswith(
        "3 dei 40 accelerogrammi"
    )
    assert ITALIAN.counted(1, "station") == "1 stazione" and ITALIAN.counted(2, "station") == "2 stazioni"


def texts_of(page):
    if isinstance(page, str):
        return [page]
    if isinstance(page, list | tuple):
        return [text for element in page for text in texts_of(element)]
    if not is_dataclass(page) or isinstance(page, Picture):
        return []
    return [text for attribute in fields(page) for text in texts_of(getattr(page, attribute.name))]


def test_an_italian_page_has_no_english_sentence():
    """Words that no Italian sentence holds, in all that the page says and in what its figures do."""
    ties = {"tie_heights": (2.9,), "tie_stiffness": 1e6, "tie_strength": 20e3}
    tied = Facade((3.0,), (0.5,), unit_weight=20e3, floor_loads=(5e3,), **ties)
    pages = [
        CheckedStructure(
            name="A",
            structure=case,
            checked=check(case, SPECTRUM),
            untied=check(case.without_ties(), SPECTRUM) if isinstance(case, Facade) else None,
            overturning_share=0.25,
            records=4,
            stations=3,
            verdicts={Verdict.PROBABLY_STANDS: 2, Verdict.CANNOT_BE_TOLD: 1},
            verdict_warnings=(AssessmentKind.CONTACTS_OPEN,),
            reserves=(
                Reserve(low=0.8, median=1.1, high=1.2, limit=3.0),
                Reserve(low=0.9, median=1.1, high=1.2, limit=3.0),
            ),
            reserve_warnings=(AssessmentKind.CONTACTS_OPEN,),
        )
        for case in (tied, Block.of_size(0.4, 3.0))
    ]
    english = re.compile(
        r"\b(the|of|and|is|are|not|met|by|under|which|with|its|height|thickness|crack|outwards|inwards|falls)\b"
    )
    for page in pages:
        data = structures_data([page], SPECTRUM, Settings(language="it").for_pages_to_sign)
        said = [text for text in texts_of(data) if english.search(text)]
        assert said == []
        drawings = [
            bar.svg for bar in (*data.sheets[0].answers[0].bars, *data.sheets[0].answers[0].basis.figure)
        ]
        drawn = [text for svg in drawings for text in re.findall(r"<text[^>]*>([^<]*)</text>", svg)]
        assert drawn and not [text for text in drawn if english.search(text)]
        assert not [text for text in drawn if re.search(r"\d\.\d", text) and not text.startswith("C8.")]


TIES = {"tie_heights": (2.9,), "tie_stiffness": 1e6, "tie_strength": 20e3}
FRONT = {"storey_heights": (3.0,), "thicknesses": (0.5,), "unit_weight": 20e3, "floor_loads": (5e3,)}
TWO_STOREYS = {
    "storey_heights": (3.5, 3.0), "thicknesses": (0.6, 0.5), "unit_weight": 20e3, "floor_loads": (5e3, 4e3),
}  # fmt: skip
LOADED = {"height": 6.0, "thickness": 0.35, "unit_weight": 18e3, "top_load": 40e3}
HELD = (
    Facade(**FRONT, **TIES),
    Facade(**FRONT, tie_heights=(1.5, 2.9), tie_stiffness=1e6),
    Facade(**FRONT, **TIES, tie_spacing=4.0, unit_length=0.3),
    Facade(**FRONT, **TIES, tie_spacing=4.0, unit_length=0.3, behind="cross_walls", restitution=0.5),
    Facade(**TWO_STOREYS, tie_heights=(3.4, 6.3), tie_stiffness=1e6, tie_strength=20e3),
    Facade(**TWO_STOREYS, tie_heights=(3.4,), tie_stiffness=1e6, behind="floors", restitution=0.5),
    Facade(**TWO_STOREYS, loads_held=True),
    Facade(**FRONT, leaves=(0.2, 0.3), restitution=0.6),
    Facade(**{**FRONT, "thicknesses": (0.6,)}, leaves=(0.2, 0.2, 0.2), bonders=(1.0, 2.0)),
    LoadedWall.of_size(**LOADED, top_slab="flat", restitution=0.5),
    LoadedWall.of_size(**LOADED, **TIES, tie_spacing=4.0, unit_length=0.3, restitution=0.5),
    LoadedWall.of_size(**LOADED, top_friction=0.05),
    Wall.of_size(3.2, 0.25, 1.6, crack="known"),
)
"""Walls with every kind of hold and of opening."""


def every_structure():
    """A structure of each form with the keys that it must have, of its example, and with each word that a key takes."""
    entries = []
    words = set()
    for kind, forms in TYPES.items():
        for form in forms:
            least = {"type": kind, **{key.key: key.value.example for key in form.fields if key.required}}
            entries += [least, {"type": kind, **form.example}]
            for key in form.fields:
                entries += [{**least, key.key: word} for word in key.options if (key.name, word) not in words]
                words |= {(key.name, word) for word in key.options}
    for entry in entries:
        with suppress(RockingError):  # what another key goes with, or a file holds
            structure = structure_from_config(entry)
            structure.mechanism()
            yield structure
    yield from HELD


def printed(structure, *languages):
    """The texts of the page of a structure on which everything is said that there may be to say, in some languages."""
    try:
        checked, refusal = check(structure, SPECTRUM), ""
    except RockingError as error:
        checked, refusal = None, error.warning or str(error)
    has_ties = bool(getattr(structure, "tie_heights", ()))
    page = CheckedStructure(
        name="A",
        structure=structure,
        checked=checked,
        refusal=refusal,
        untied=checked if has_ties else None,
        overturning_share=0.25,
        records=4,
        stations=3,
        verdicts=dict.fromkeys(Verdict, 1),
        mechanisms=mechanisms_of(structure),
        warnings=(*structure.described.warnings, *structure.cautions),
    )
    settings = [Settings(language=language).for_pages_to_sign for language in languages]
    return [texts_of(structures_data([page], SPECTRUM, of_language)) for of_language in settings]


@pytest.mark.process
@pytest.mark.filterwarnings("ignore::rocking.errors.StructureWarning")
@pytest.mark.usefixtures("undrawn")
def test_the_catalogue_holds_what_every_page_prints(monkeypatch):
    asked = set()

    class Asked(dict):
        def get(self, key, default=None):
            asked.add(key)
            return super().get(key, default)

    texts = Asked(ITALIAN_TEXTS)
    monkeypatch.setattr(sentences, "catalogue", lambda language: texts if language == "it" else {})
    for structure in every_structure():
        italian, english = printed(structure, "it", "en")
        assert len(italian) == len(english), "a page says the same in both languages"
        assert not any("Error" in text for text in italian)
    for kind in (*StructureKind, *CheckKind, *ReportKind, FloorKind.HEAVY_ON_SUPPORT, *AssessmentKind):
        ITALIAN.of(RockingWarning.of(kind, "A", **dict.fromkeys(kind.value_names, 1.5)))
    for verdict in Verdict:
        ITALIAN.verdict(verdict)
    for key in (key for forms in TYPES.values() for form in forms for key in form.fields):
        ITALIAN(key.phrase, value="1")
    for module in (report, figures):
        calls = (
            node for node in ast.walk(ast.parse(inspect.getsource(module))) if isinstance(node, ast.Call)
        )
        for call in (call for call in calls if ast.unparse(call.func) == "words" and call.args):
            said = call.args[0]
            either = (said.body, said.orelse) if isinstance(said, ast.IfExp) else (said,)
            asked |= {("", text.value) for text in either if isinstance(text, ast.Constant)}
    lacking = {english for context, english in asked - set(ITALIAN_TEXTS) if english.strip()}
    assert lacking == set()


def test_the_languages_are_those_of_the_setting():
    assert get_args(Language) == ("en", "it")
    for language in get_args(Language):
        assert Settings(language=language).language == language
