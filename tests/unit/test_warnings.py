"""The catalogue of warnings: each kind has its own code and a sentence that its values fill."""

import ast
import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

import rocking
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.store import decoded, encoded
from rocking.floors.kinds import FloorKind
from rocking.records.kinds import RecordKind
from rocking.signal.kinds import SignalKind
from rocking.warnings import Kind, RockingWarning, every_kind, kind_of

PACKAGE = Path(inspect.getfile(rocking)).parent
TESTS = Path(__file__).parents[1]
for declares in PACKAGE.rglob("kinds.py"):
    import_module(".".join(("rocking", *declares.relative_to(PACKAGE).with_suffix("").parts)))
KINDS = every_kind()


@pytest.mark.parametrize("kind", KINDS.values())
def test_every_sentence_is_filled_by_its_values_alone(kind):
    numbers = dict.fromkeys(kind.value_names, 1.5)
    warning = RockingWarning.of(kind, "wall", **numbers)
    assert kind_of(kind.value) is kind
    assert "{" not in str(warning)
    assert all(warning[name] == 1.5 for name in numbers)


def test_a_kind_that_says_nothing_cannot_be_declared():
    with pytest.raises(ValueError, match="opens has no sentence"):
        Kind._new_member_(Kind, "opens")


def test_no_two_kinds_say_the_same_or_have_one_code():
    assert sum(map(len, Kind.__subclasses__())) == len(KINDS) > 100
    assert len({kind.sentence for kind in KINDS.values()}) == len(KINDS)


def test_values_that_the_sentence_does_not_name_are_refused():
    with pytest.raises(ValueError, match="force"):
        RockingWarning.of(AssessmentKind.CONTACTS_OPEN, force=2.0)


def test_a_kind_that_the_catalogue_does_not_hold_is_refused():
    with pytest.raises(ValueError, match="'contacts open' is of no kind"):
        RockingWarning("contacts open")


def test_a_value_that_is_neither_text_nor_number_is_refused(monkeypatch):
    monkeypatch.setattr(AssessmentKind.CONTACTS_OPEN, "value_names", ("count",))
    with pytest.raises(ValueError, match=r"count is \[1\], but must be a text or a number"):
        RockingWarning.of(AssessmentKind.CONTACTS_OPEN, count=[1])


def test_every_warning_that_the_package_makes_has_the_values_of_its_sentence():
    """Also those that no other test makes: the calls are read from the sources."""
    wrong = []
    for path in PACKAGE.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        for call in ast.walk(ast.parse(text)) if "RockingWarning" in text else ():
            makes = ("RockingWarning", "RockingWarning.of")
            if not (isinstance(call, ast.Call) and ast.unparse(call.func) in makes and call.args):
                continue
            named = ast.unparse(call.args[0]).rpartition(".")[2].lower()
            given = sorted(keyword.arg or "" for keyword in call.keywords if keyword.arg != "about")
            if named in KINDS and "" not in given and given != list(KINDS[named].value_names):
                wrong.append(f"{path.name}:{call.lineno}: {named} with {given}")
    assert not wrong


def test_every_sentence_of_the_catalogue_is_said_somewhere():
    """A kind that no code of the package names, but where it is declared, would be one that nobody creates."""
    sources = (path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py") if path.name != "kinds.py")
    named = set(re.findall(r"\bKind\.([A-Z_]+)\b|\b\w+Kind\.([A-Z_0-9]+)\b", "\n".join(sources)))
    assert set(KINDS) <= {name.lower() for pair in named for name in pair}


def test_what_a_warning_is_about_stands_before_a_sentence_that_does_not_name_it():
    assert str(RockingWarning(AssessmentKind.CONTACTS_OPEN, "pier")) == "pier: contacts open"
    assert str(RockingWarning(RecordKind.VERTICAL_AS_HORIZONTAL, "UD")).startswith("Component UD is vertical")


@pytest.mark.parametrize(("warning", "words"), [
    (
        RockingWarning.of(SignalKind.STEP_UNUSUAL, time_step_s=0.11, shortest_s=1e-4, longest_s=0.1),
        "is 0.11 s: accelerographs",
    ),
    (RockingWarning.of(RecordKind.SAMPLE_ALONE, time_s=1.5, peak_g=3.0591, others_g=0.10197), "at 1.5 s is 3.06 g and"),
    (RockingWarning.of(FloorKind.STILL_RINGING, share=0.0314, after_s=60.0), "at 3.1% of its peak"),
    (
        RockingWarning.of(RecordKind.PEAK_UNLIKE_HEADER, peak_m_s2=9.80665, stated_m_s2=9.9),
        "is 9.80665 m/s², but the header",
    ),
    (RockingWarning.of(RecordKind.RATE_NO_NUMBER, rate="1OO"), "a rate of '1OO', which is not a number"),
    (RockingWarning(RecordKind.LONE_MAY_BE_VERTICAL, "QQX"), "direction of the component QQX is unknown"),
])  # fmt: skip
def test_the_words_give_numbers_as_a_person_reads_them(warning, words):
    assert words in str(warning)


@pytest.mark.parametrize("value", ["wall", 3, 2.5])
def test_a_warning_is_kept_with_its_values(monkeypatch, value):
    monkeypatch.setattr(AssessmentKind.CONTACTS_OPEN, "value_names", ("force",))
    warning = RockingWarning.of(AssessmentKind.CONTACTS_OPEN, "pier", force=value)
    again = decoded(RockingWarning, encoded(warning))
    assert again == warning
    assert type(again["force"]) is type(value)
