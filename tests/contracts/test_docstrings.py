"""The docstrings of the public names have the sections of numpydoc: checked by numpydoc's own validator."""

import inspect
import re
from enum import Enum

import pytest
from numpydoc.validate import validate

import rocking

PASSED_OVER = {
    "ES01",  # no extended summary: the summary alone may say it all
    "EX01",  # no examples: of errors, and of what only a study makes
    "GL01",  # the summary begins on the line of the quotes
    "PR02",  # keywords that a function hands on
    "PR08",  # a description that begins with a letter of the field, such as η
    "RT02",  # a return value has a type and no name
    "RT04",  # likewise
    "SA01",  # no See Also
    "SS06",  # a summary of two lines
}


@pytest.mark.parametrize("name", sorted(rocking.__all__))
def test_the_docstring_has_the_sections_of_numpydoc(name: str) -> None:
    public = getattr(rocking, name)
    found = dict(validate(f"{public.__module__}.{public.__qualname__}")["errors"])
    if isinstance(public, type) and issubclass(public, Enum | BaseException):
        found.pop("PR01", None)  # the arguments of Enum itself, and those of RockingError.__init__
    assert {code: message for code, message in found.items() if code not in PASSED_OVER} == {}


@pytest.mark.parametrize("name", sorted(rocking.__all__))
def test_a_default_is_the_one_that_the_docstring_says(name: str) -> None:
    public = getattr(rocking, name)
    methods = inspect.getmembers(public, callable) if isinstance(public, type) else []
    for documented in (public, *(method for called, method in methods if not called.startswith("_"))):
        parameters = re.findall(r"^(\w+) : .*, default (.+)$", inspect.getdoc(documented) or "", re.M)
        for parameter, said in parameters:
            default = inspect.signature(documented).parameters[parameter].default
            assert said in (str(default), repr(default), f'"{default}"'), (documented, parameter)
