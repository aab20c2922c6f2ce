"""Check terms: what the checks of a code must know of a structure of a list, and its motion does not ask for."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rocking.errors import ConfigurationError
from rocking.quantities import finite

KEYS = {
    "elastic_period_s": "For the checks of the code: period T_0 of a part that is free to vibrate, s (C8.7.1.7); "
    "left out: it is tied rigidly to what carries it",
    "support_loss_m": "For the checks of the code: horizontal displacement of the corner that moves farthest at which "
    "what it carries falls, m; left out: nothing does",
}
"""Keys of an entry of a structure list, whatever its type, with their meaning."""


@dataclass(frozen=True)
class CheckTerms:
    """elastic_period: T_0, s; 0 of what is tied rigidly. support_loss: m; inf where nothing falls."""

    elastic_period: float = 0.0
    support_loss: float = math.inf


def check_terms(mapping: Mapping[str, object]) -> CheckTerms:
    """Return the check terms of an entry of a structure list. Raises ConfigurationError unless they are above 0.

    >>> check_terms({"type": "block", "elastic_period_s": 0.11}).elastic_period
    0.11
    """
    given = {}
    for key in KEYS:
        if mapping.get(key) is None:
            continue
        unit = key[-1]
        number: Any = mapping[key]
        value = finite(ConfigurationError, key, number, unit)
        if not value > 0:
            raise ConfigurationError(
                f"{key} is {value:g} {unit}, but must be greater than 0; leave it out where there is none."
            )
        given[key] = value
    defaults = CheckTerms()
    return CheckTerms(
        elastic_period=given.get("elastic_period_s", defaults.elastic_period),
        support_loss=given.get("support_loss_m", defaults.support_loss),
    )


def check_terms_schema() -> dict[str, object]:
    """Return the JSON schema of the keys."""
    return {
        key: {"type": "number", "exclusiveMinimum": 0, "description": meaning}
        for key, meaning in KEYS.items()
    }
