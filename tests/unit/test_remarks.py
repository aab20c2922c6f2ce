"""The catalogue of remarks: each kind has its own code and a sentence that its values fill."""

from string import Formatter

import pytest

from rocking.remarks import Kind, Remark


@pytest.mark.parametrize("kind", Kind)
def test_every_sentence_is_filled_by_its_values_alone(kind):
    names = {name for _, name, _, _ in Formatter().parse(kind.sentence) if name}
    numbers = dict.fromkeys(names - {"about"}, 1.5)
    remark = Remark.of(kind, "wall", **numbers)
    assert Kind(kind.value) is kind
    assert "{" not in str(remark)
    assert all(remark[name] == 1.5 for name in numbers)


def test_no_two_kinds_say_the_same():
    assert len({kind.sentence for kind in Kind}) == len(Kind)


def test_values_that_the_sentence_does_not_name_are_refused():
    with pytest.raises(ValueError, match="force"):
        Remark.of(Kind.CONTACTS_OPEN, force=2.0)
