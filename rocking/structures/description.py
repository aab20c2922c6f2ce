"""Description: what a structure says of itself, in the keys, units and texts of a file."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rocking.remarks import Remark
from rocking.structures.fields import Field, Form


class Given(NamedTuple):
    """One value of a description: its field, the value in the unit of a file, and how it would be typed."""

    field: Field
    value: Any
    text: str


@dataclass(frozen=True)
class Description:
    """What one structure says of itself: the form in which it is described, and the values of its keys."""

    form: Form
    values: tuple[Given, ...]

    @property
    def type_name(self) -> str:
        """The `type` in a file."""
        return self.form.type_name

    @property
    def words(self) -> str:
        """The description in words with units: "breadth 0.6 m, height 6.0 m"."""
        shown = [given for given in self.values if given.value is not False]
        return ", ".join(given.field.phrased(given.text) for given in shown)

    @property
    def size(self) -> str:
        """Its sizes in short, as they were typed: "0.6 × 6.0 m", "10 × 1.5 m, 157.5°"."""
        by_unit: dict[str, list[str]] = {}
        for given in self.values:
            if given.field.required and given.field.unit:
                by_unit.setdefault(given.field.suffix, []).append(given.text)
        return ", ".join(" × ".join(texts) + unit for unit, texts in by_unit.items())

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """A remark on each size beyond its plausible range."""
        remarks = (given.field.remark(self.type_name, given.value) for given in self.values)
        return tuple(remark for remark in remarks if remark)

    @property
    def front(self) -> np.ndarray:
        """The outline of its front (k, 2), m, beside the section; (0, 2) where its form knows none."""
        return self.form.front_of({given.field.name: given.value for given in self.values})

    @property
    def entry(self) -> dict[str, object]:
        """The entry of a structure list that describes it, without a name."""
        return {"type": self.type_name, **{given.field.key: given.value for given in self.values}}
