"""The tree of settings: what it refuses, and that every file made from it says the same."""

import math
from dataclasses import fields, replace
from pathlib import Path
from typing import get_args

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft7Validator

from rocking.assessment.settings import AssessmentSettings
from rocking.codes.design_spectrum import SOILS, TOPOGRAPHIES
from rocking.described import described_values, parts_of
from rocking.errors import ConfigurationError
from rocking.fragility.measures import INTENSITY_MEASURES, MEASURES_IN_WORDS, SPELLINGS
from rocking.reports.pages import Fact
from rocking.signal.processing import UNPROCESSED_DEFAULT
from rocking.study.settings import (
    EXAMPLE,
    Settings,
    StudyDesign,
    StudyFragility,
    commented_yaml,
    json_schema,
    named_files,
    read_settings,
    schema_file,
)
from tests.refusals import refused

ROOT = Path(__file__).parents[3]
SCHEMA = Draft7Validator(json_schema())


def _refusal(config: object) -> str:
    with pytest.raises(ConfigurationError) as caught:
        read_settings(config)
    return str(caught.value)


def _names(kind: type = Settings) -> list[tuple[str, ...]]:
    own = [(said.key,) for said in described_values(kind).values()]
    return own + [(part, *name) for part in parts_of(kind) for name in _names(type(getattr(kind, part)))]


def _config(name: tuple[str, ...], value: object) -> dict[str, object]:
    return {name[0]: _config(name[1:], value)} if len(name) > 1 else {name[0]: value}


def test_what_a_part_of_the_package_takes_by_default_is_the_default_of_a_study() -> None:
    settings = Settings()
    for of_study, of_part in (
        (settings, AssessmentSettings()),
        (settings.processing, UNPROCESSED_DEFAULT),
    ):
        assert {part.name: getattr(of_study, part.name) for part in fields(of_part)} == vars(of_part)


def test_the_names_of_settings_are_those_of_the_codes_and_the_measures() -> None:
    """Settings name them by themselves, so that a study without a design level and fragility needs neither."""
    said = described_values(StudyDesign)
    assert get_args(said["soil"].kind) == tuple(SOILS)
    assert (said["topography"].bounds["ge"], said["topography"].bounds["le"]) == TOPOGRAPHIES
    measure = described_values(StudyFragility)["intensity_measure"]
    assert measure.default == next(iter(INTENSITY_MEASURES))
    for spelling in SPELLINGS:
        StudyFragility(intensity_measure=spelling.replace("T1,T2", "0.2,2.0").replace("(T)", "(0.5)"))
    with refused(ConfigurationError, "intensity_measure", "pulse"):
        StudyFragility(intensity_measure="pulse")
    assert measure.meaning.endswith(MEASURES_IN_WORDS)


def test_the_shipped_files_are_those_that_the_tree_writes() -> None:
    written = {
        "config/config.yaml": commented_yaml(EXAMPLE),
        "workflow/schemas/config.schema.yaml": schema_file(),
    }
    for name, text in written.items():
        assert (ROOT / name).read_text(encoding="utf-8") == text, "make schema"


@pytest.mark.parametrize("settings", [Settings(), EXAMPLE])
def test_the_written_config_reads_back_and_explains_every_line(settings: Settings) -> None:
    text = commented_yaml(settings)
    config = yaml.safe_load(text)
    assert read_settings(config) == settings and read_settings({}) == Settings()
    assert SCHEMA.is_valid(config)
    for line in text.splitlines():
        assert not line or line.endswith(":") or "#" in line, line


@pytest.mark.parametrize("name", _names(), ids=".".join)
def test_every_setting_says_what_it_means_and_its_choices(name: tuple[str, ...]) -> None:
    schema = json_schema()
    for part in name:
        schema = schema["properties"][part]
    assert schema["description"] and "default" in schema
    for choice in schema.get("enum", ()):
        assert choice in schema["description"], f"{choice} is not explained"


def test_all_defects_stand_in_one_message_each_with_its_value_and_what_is_allowed() -> None:
    config = {
        "tolerance": 5,
        "tollerance": 1,
        "results": "",
        "processing": {"apply": "sometimes", "taper": True},
        "pulse": {"lowest_frequency_hz": -1, "choice": "best", "pursuit": 3.0},
        "scale_to": "0.35 g",
        "trade": 3,
        "mirror": math.nan,
    }
    assert set(_refusal(config).splitlines()) == {
        "setting tollerance is 1, but nothing has this name; did you mean tolerance?",
        "setting results is '', but must be a text that is not empty.",
        "setting mirror is nan, but must be a text that is not empty or null.",
        "setting processing.apply is 'sometimes', but must be raw or always or never.",
        "setting processing.taper is True, but must be a number from 0 to 0.5.",
        "setting tolerance is 5, but must be a number from 1e-13 to 0.1.",
        "setting scale_to is '0.35 g', but must be a text like pga 0.35 g or pgv 50 cm/s or null.",
        "setting pulse.lowest_frequency_hz is -1 Hz, but must be a number above 0.",
        "setting pulse.pursuit is 3.0, but must be a whole number from 1 to 200.",
        "setting pulse.choice is 'best', but must be energy or demand or velocity.",
        "setting trade is 3, but must be a mapping of in_summary.",
    }


@pytest.mark.parametrize(("config", "words"), [
    ({"pulse": {"lowest_frequency_hz": 6}}, "highest_frequency is 5 Hz, but must be above"),
    ({"processing": {"low_pass_hz": 0.05}}, "high_pass is 0.1 Hz, but low_pass"),
    ([], "must be a mapping"),
    ({"checks": {"shortest_period_s": 2.0, "longest_period_s": 2.0}}, "shortest_period_s is 2 s, but must be below"),
    ({"checks": {"least_factor": 3.0, "largest_factor": 3.0}}, "least_factor is 3, but must be below"),
    ({"design_spectrum": {"ag_g": 0.2, "f0": 2.4}}, "tc_star_s is missing, but must be given with ag_g."),
    ({"design_spectrum": {"ag_g": 0.2, "tc_star_s": 0.3}}, "f0 is missing, but must be given with ag_g."),
    ({"design_spectrum": {"f0": 2.4}}, "ag_g is missing, but must be given with f0."),
    ({"design_spectrum": {"tc_star_s": 0.3}}, "ag_g is missing, but must be given with tc_star_s."),
    ({"design_spectrum": {"ag_g": 0.2, "points": "a.csv"}}, "points is 'a.csv' together with ag_g = 0.2, but one"),
    ({"scale_to": "pga 0 g"}, "scale_to"),
])  # fmt: skip
def test_settings_that_do_not_go_together_are_refused(config: object, words: str) -> None:
    assert words in _refusal(config)


@pytest.mark.parametrize(
    ("config", "told"),
    [
        (
            {"ensemble": {"members": "6,4"}},
            "must be a whole number from 0 to 4096; a number is written with",
        ),
        (
            {"ensemble": {"members": 6, "4": None}},
            "ensemble.4 is None, but nothing has this name; a comma parts",
        ),
        ({"members": 64}, "did you mean ensemble.members?"),
        ({"pulse": {"pursuit": 4_000_000_000}}, "is 4000000000, but must be a whole number from 1 to 200"),
        ({"pulse": {"candidates": 201}}, "from 1 to 200"),
        ({"pulse": {"alternatives": 201}}, "from 1 to 200"),
        ({"processing": {"time_step_s": 1e-9}}, "from 0.0001 to 1"),
        ({"tolerance": "x" * 300_000}, "xxx… (300002 characters), but must be a number"),
        ({"tolerance": 10**5000}, "a number of thousands of digits, but must be"),
        ({"y" * 300_000: 1}, "yyy… (300002 characters) is 1, but nothing has this name"),
        ({"trade": ["z"] * 1_000_000}, "… (5000000 characters), but must be a mapping"),
    ],
    ids=lambda value: value[:30] if isinstance(value, str) else "",
)
def test_a_refusal_says_what_to_write_and_repeats_no_long_value(config: object, told: str) -> None:
    refusal = _refusal(config)
    assert told in refusal and len(refusal) < 1000


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        (("tolerance",), "1e-7", 1e-7),
        (("reports",), "false", False),
        (("pulse", "alternatives"), "4", 4),
    ],
)
def test_a_text_that_says_a_value_is_that_value(name: tuple[str, ...], text: str, value: object) -> None:
    """So they come from snakemake --config; and YAML 1.1 takes 1e-7 for a text."""
    assert read_settings(_config(name, text)) == read_settings(_config(name, value))


@pytest.mark.parametrize("wrong", ["", 3, None, ["a.csv"]])
@pytest.mark.parametrize("name", ["catalogue", "structures", "results"])
def test_of_defective_settings_the_files_that_they_name_are_looked_at_all_the_same(
    name: str, wrong: object
) -> None:
    config = {"catalogue": "a.csv", "structures": "b.yaml", "results": "c", "tollerance": 1}
    assert named_files(config) == Settings(catalogue="a.csv", structures="b.yaml", results="c")
    default = getattr(Settings(), name)
    assert getattr(named_files(config | {name: wrong}), name) == default


VALUES = (
    st.none()
    | st.booleans()
    | st.sampled_from(["", "raw", "linear", "uplift", "demand", "full"])
    | st.integers(-2, 20_000)
    | st.floats(-1, 2).filter(lambda value: not value.is_integer())
)


@given(st.sampled_from(_names()), VALUES)
def test_the_schema_allows_what_the_tree_allows(name: tuple[str, ...], value: object) -> None:
    """Held against jsonschema, but for what no schema of one value can say, and numbers such as 3.0."""
    config = _config(name, value)
    try:
        read_settings(config)
        refused = ""
    except ConfigurationError as error:
        refused = str(error)
    of_two = any(
        words in refused
        for words in (
            *("must be above", "must be below", "or at least", "low_pass only", "be given with"),
            "must be one of pgv",  # the measures, whose registry stands above the settings
        )
    )
    assert of_two or SCHEMA.is_valid(config) == (not refused), refused


def test_what_a_study_is_told_by_stands_in_every_report_and_changes_no_number() -> None:
    """Whatever declares that it is told, which the job of every document can read."""
    told = {
        setting.name: setting.more["printed_as"]
        for setting in described_values(Settings).values()
        if "printed_as" in setting.more
    }
    assert {"study", "client", "author", "date", "project_number"} <= told.keys()
    settings = replace(Settings(), **{name: f"the {name}" for name in told})
    printed = settings.for_pages.about
    assert printed == tuple(Fact(label=label, text=f"the {name}") for name, label in told.items())
    numbers = Settings.changing_numbers()
    assert settings.values_of(numbers) == Settings().values_of(numbers)
    assert replace(settings, tolerance=1e-7).values_of(numbers) != settings.values_of(numbers)


def test_a_key_in_a_section_beside_its_own_is_told_where_it_belongs() -> None:
    with pytest.raises(ConfigurationError, match=r"design_spectrum\.stations is 5, .*checks\.stations"):
        read_settings({"design_spectrum": {"stations": 5}})


def test_a_step_cannot_read_a_setting_that_it_is_not_made_from() -> None:
    """At its default it would be read as if the study had set it so."""
    settings = replace(Settings(), language="it", tolerance=1e-7)
    handed = settings.only(("tolerance",))
    assert handed.tolerance == 1e-7 and handed.knows("tolerance") and not handed.knows("language")
    with pytest.raises(LookupError, match="the setting language"):
        _ = handed.language
    assert settings.knows("language") and settings.language == "it"
