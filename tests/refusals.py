"""What a test holds of a refusal: the class of the error, the field and the value that it carries, not its wording."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

ANY = object()
"""Stands for whatever value was refused."""


@contextmanager
def refused(
    error: type[Exception] | tuple[type[Exception], ...], field: str, value: object = ANY
) -> Iterator[pytest.ExceptionInfo]:
    """Hold that what is done within raises `error` about this field and, where it is given, this value."""
    with pytest.raises(error) as caught:
        yield caught
    assert caught.value.field == field
    if value is not ANY:
        np.testing.assert_equal(caught.value.value, value)  # nan is nan
