"""What stands on a figure of paper, read back from its SVG as somebody would who holds it: in mm."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np

SVG = "{http://www.w3.org/2000/svg}"
UNITS = 100


@dataclass(frozen=True)
class Written:
    """A text and the mm where it stands."""

    text: str
    x: float
    y: float
    size: float
    anchor: str
    colour: str


def tree(svg: str) -> ElementTree.Element:
    return ElementTree.fromstring(svg)


def texts(svg: str) -> list[Written]:
    return [
        Written(
            "".join(each.itertext()),
            float(each.get("x")) / UNITS,
            float(each.get("y")) / UNITS,
            float(each.get("font-size")) / UNITS * 72 / 25.4,
            each.get("text-anchor"),
            each.get("fill"),
        )
        for each in tree(svg).iter(f"{SVG}text")
    ]


def circles(svg: str, edge: str) -> np.ndarray:
    """Centres (k, 2) of the circles of one colour."""
    found = (each for each in tree(svg).iter(f"{SVG}circle") if each.get("stroke") == edge)
    return np.array([(float(each.get("cx")), float(each.get("cy"))) for each in found]).reshape(-1, 2) / UNITS


def paths(svg: str, edge: str, **said: str) -> list[np.ndarray]:
    """Points (k, 2) of the lines of one colour with the attributes `said`."""
    found = []
    for each in tree(svg).iter(f"{SVG}path"):
        if each.get("stroke") == edge and all(
            each.get(name.replace("_", "-")) == value for name, value in said.items()
        ):
            start, moves = re.fullmatch(r"M(-?\d+ -?\d+)l([^zM]*)z?", each.get("d")).groups()
            steps = np.array(moves.split(), dtype=float).reshape(-1, 2)
            found.append(np.cumsum(np.vstack(([*map(float, start.split())], steps)), axis=0) / UNITS)
    return found


def read_axis(ticks: list[tuple[float, float]], logarithmic: bool):
    """The function from mm to a value that the numbers (mm, value) beside an axis give a reader."""
    places, values = np.array(sorted(ticks)).T
    scaled = np.log(values) if logarithmic else values
    slope, level = np.polyfit(places, scaled, 1)
    # a number stands within a hundredth of a millimetre of its tick
    assert np.abs(slope * places + level - scaled).max() <= abs(slope) * 0.02
    return (
        (lambda place: np.exp(slope * place + level))
        if logarithmic
        else (lambda place: slope * place + level)
    )


def number(text: str) -> float | None:
    try:
        return float(text.replace("−", "-"))
    except ValueError:
        return None
