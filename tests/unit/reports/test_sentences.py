"""The catalogue of the pages to sign: whole in both languages, and an Italian page has no English sentence."""

import re
from pathlib import Path
from string import Formatter
from typing import get_args

import pytest

import rocking
from rocking import Block, DesignSpectrum, Facade, check
from rocking.assessment.decide import Verdict
from rocking.assessment.reserve import Reserve
from rocking.codes.check import Part
from rocking.remarks import Kind, Remark
from rocking.reports.sentences import Language, Sentences, catalogue
from rocking.reports.structures import CheckedStructure, structures_data
from rocking.structures.structure_list import TYPES
from rocking.study.settings import Settings

ITALIAN = Sentences("it")
SPECTRUM = DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35, soil="C")
DECLARED_ELSEWHERE = ("kind", "field")
"""Whose English text stands where it is declared."""


def named(text):
    return sorted({name for _, name, _, _ in Formatter().parse(text) if name})


@pytest.mark.parametrize("key", catalogue())
def test_both_languages_name_the_same_values(key):
    texts = catalogue()[key]
    english = texts["en"]
    if key.startswith("kind "):
        english = Kind(key.removeprefix("kind ")).sentence
        assert set(named(texts["it"])) <= {*named(english), "about"}
    elif not key.startswith("field "):
        assert named(texts["it"]) == named(english)
    assert texts["it"]


def test_every_word_that_code_looks_up_stands_in_the_catalogue():
    keys = [
        *(f"{place} {word}" for word in Verdict for place in ("predicate", "verdict")),
        *(f"part {part}" for part in Part),
        *(f"field {field.name}" for form in TYPES.values() for each in form for field in each.fields),
    ]
    assert set(keys) <= set(catalogue())


def test_every_sentence_of_the_catalogue_is_looked_up():
    """By its whole key, or by one whose end is a name of a kind, a word, a part or a field."""
    source = "".join(
        (Path(rocking.__file__).parent / "reports" / f"{name}.py").read_text()
        for name in ("structures", "structure_figures", "sentences", "variants")
    )
    prefixes = re.findall(r'f"([a-z ]+ )\{', source)
    looked_up = set(re.findall(r'"([a-zA-Z &,-]+)"', source)) | {
        each.replace("-", " ") for each in re.findall(r'"([a-z-]+)"', source)
    }
    computed = {"linear", "nonlinear", "dynamic", "met", "not met", "not called met"}  # of a check
    computed |= {"study", "client", "project number", "author", "date"}  # what a study is told to be
    unused = [
        key
        for key in catalogue()
        if key not in looked_up | computed and not any(key.startswith(each) for each in prefixes)
    ]
    assert unused == []


def test_numbers_have_the_mark_of_their_language():
    assert Sentences().number(0.4321) == "0.432"
    assert ITALIAN.number(0.4321) == "0,432"
    assert ITALIAN.of(Remark.of(Kind.LIMIT_SHARE, share=0.4)) == "0,4 d₀"
    assert ITALIAN.of(Remark.of(Kind.DISPLACEMENT_EXCEEDED, exceeding=3, motions=40)).endswith(
        "3 dei 40 accelerogrammi"
    )
    assert ITALIAN.counted(1, "station") == "1 stazione" and ITALIAN.counted(2, "station") == "2 stazioni"


def texts_of(data):
    if isinstance(data, str):
        return [] if data.startswith("<?xml") else [data]
    if isinstance(data, dict):
        return [text for key, each in data.items() if key not in ("svg", "alt") for text in texts_of(each)]
    return [text for each in data for text in texts_of(each)] if isinstance(data, list | tuple) else []


def test_an_italian_page_has_no_english_sentence():
    """Words that no Italian sentence holds, in all that the page says and in what its figures do."""
    ties = {"tie_heights": (2.9,), "tie_stiffness": 1e6, "tie_strength": 20e3}
    tied = Facade((3.0,), (0.5,), unit_weight=20e3, floor_loads=(5e3,), **ties)
    pages = [
        CheckedStructure(
            name="A",
            structure=each,
            checked=check(each, SPECTRUM),
            untied=check(each.without_ties(), SPECTRUM) if isinstance(each, Facade) else None,
            overturning_share=0.25,
            records=4,
            stations=3,
            verdicts={Verdict.PROBABLY_STANDS: 2, Verdict.CANNOT_BE_TOLD: 1},
            doubts=(Kind.CONTACTS_OPEN,),
            reserves=(Reserve(0.8, 1.1, 1.2, 3.0), Reserve(0.9, 1.1, 1.2, 3.0)),
            reserve_doubts=(Kind.CONTACTS_OPEN,),
        )
        for each in (tied, Block.of_size(0.4, 3.0))
    ]
    english = re.compile(
        r"\b(the|of|and|is|are|not|met|by|under|which|with|its|height|thickness|crack|outwards|inwards|falls)\b"
    )
    for page in pages:
        data = structures_data([page], SPECTRUM, Settings(language="it").mapping())
        said = [text for text in texts_of(data) if english.search(text)]
        assert said == []
        drawings = [each["svg"] for each in (*data["pages"][0]["bars"], *data["pages"][0]["basis"]["figure"])]
        drawn = [text for svg in drawings for text in re.findall(r"<text[^>]*>([^<]*)</text>", svg)]
        assert drawn and not [text for text in drawn if english.search(text)]
        assert not [text for text in drawn if re.search(r"\d\.\d", text) and not text.startswith("C8.")]


def test_the_languages_are_those_of_the_setting():
    assert get_args(Language) == ("en", "it")
    for each in get_args(Language):
        assert Settings(language=each).language == each
