"""Scene: a structure at a place under the terms of a code. Everything above a single case works on scenes.

Along the periods of a support verdicts stand side by side and are not mixed: a share of periods would be no
probability.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

from rocking.assessment.decide import Verdict
from rocking.errors import ConfigurationError
from rocking.floors.place import GROUND, Place
from rocking.quantities import finite
from rocking.structures import Mechanism, Structure
from rocking.structures.alone import as_structure

KEYS = {
    "elastic_period_s": "For the checks of the code: period T_0 of a part that is free to vibrate, s (C8.7.1.7); "
    "left out: it is tied rigidly to what carries it",
    "support_loss_m": "For the checks of the code: horizontal displacement of the corner that moves farthest at which "
    "what it carries falls, m; left out: nothing does",
}
"""Keys of an entry of a structure list, whatever its type, with their meaning."""


@dataclass(frozen=True, kw_only=True)
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


@dataclass(frozen=True)
class Scene:
    """One structure of a list, where it stands, and what its list says for the checks of a code.

    name: in the list, in every table and report. place: the ground, or a support whose periods are an axis of the
    result. variant_of: the name of the structure of which it is a variant; "" of one that is none.
    """

    name: str
    structure: Structure
    place: Place = GROUND
    terms: CheckTerms = field(default_factory=CheckTerms)
    variant_of: str = ""


def variants_of(scenes: Mapping[str, Scene]) -> dict[str, list[str]]:
    """Return the names of the variants of each structure that has some."""
    groups: dict[str, list[str]] = {}
    for name, scene in scenes.items():
        if scene.variant_of:
            groups.setdefault(scene.variant_of, []).append(name)
    return groups


def on_friction(scenes: Mapping[str, Scene], coefficient: float) -> dict[str, Scene]:
    """Return the scenes with structures on joints of this friction coefficient, where these do not state their own."""
    return {
        name: replace(scene, structure=scene.structure.with_friction(coefficient))
        for name, scene in scenes.items()
    }


def on_the_ground(structures: Mapping[str, Structure | Mechanism]) -> dict[str, Scene]:
    """Return the scenes of structures that no list puts anywhere, by name."""
    return {name: Scene(name, as_structure(each)) for name, each in structures.items()}


def periods_in_words(verdicts: Mapping[float, Verdict]) -> str:
    """Return the verdicts by the period [s] of a support, 0 of the ground, in intervals: one need not change once only.

    "stands on a building of T_b ≤ 0.25 s, is uncertain at T_b 0.3 s, overturns from 0.36 s on (tried to 0.6 s)".
    """
    groups = [
        (verdict, [period for period, _ in many])
        for verdict, many in groupby(sorted(verdicts.items()), lambda pair: pair[1])
    ]
    last = len(groups) - 1
    return ", ".join(
        f"{verdict.predicate} {_interval(periods, place == last)}"
        for place, (verdict, periods) in enumerate(groups)
    )


def _interval(periods: Sequence[float], is_last: bool) -> str:
    """The interval in which one verdict holds; periods: ascending, 0 of the ground."""
    first = periods[0]
    end = periods[-1]
    if end == 0:
        return "on the ground"
    if first == 0:
        whatever = "on the ground and " if is_last else ""
        return f"{whatever}on a building of T_b ≤ {end:.3g} s"
    if first == end:
        return f"at T_b {first:.3g} s"
    return f"from {first:.3g} s on (tried to {end:.3g} s)" if is_last else f"from {first:.3g} to {end:.3g} s"


def placed(structure: str, support_period: float | None) -> str:
    """Return the name of a structure with the period [s] of its support: "parapet, T_b 0.25 s"; 0: its ground."""
    if support_period is None or math.isnan(support_period):
        return structure
    return f"{structure}, T_b {support_period:.3g} s" if support_period else f"{structure}, on the ground"
