"""A fragility in the files of other programs: NRML 0.5 of OpenQuake, and CSV."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol
from xml.etree import ElementTree

import numpy as np

from rocking.earthquakes.sample import ClusterSample
from rocking.errors import ConfigurationError
from rocking.fragility.measures import of_openquake
from rocking.quantities import UNPRINTABLE
from rocking.tables import Document

if TYPE_CHECKING:
    from pandas import DataFrame

_NRML = "http://openquake.org/xmlns/nrml/0.5"
_COLUMNS = ("probability", "probability_low", "probability_high", "lognormal")
_HEAD = ("intensity_measure", "unit", "threshold", "level", *_COLUMNS)
_MODEL = {"id": "rocking", "assetCategory": "buildings", "lossCategory": "structural"}
NRML = Document("fragility model", ".xml", lambda content: b'<fragilityModel id="rocking"' in content)
CURVE = Document("table of a curve", ".csv", lambda content: content.startswith(",".join(_HEAD).encode()))


class FragilityCurve(Protocol):
    """What these files hold of a Fragility."""

    @property
    def measure(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def threshold(self) -> float: ...
    @property
    def sample(self) -> ClusterSample: ...
    @property
    def levels(self) -> np.ndarray: ...
    @property
    def probability(self) -> np.ndarray: ...
    @property
    def lognormal_median(self) -> float: ...
    @property
    def dispersion(self) -> float: ...
    @property
    def upper(self) -> "FragilityCurve | None": ...


def nrml(curves: Mapping[str, FragilityCurve], lognormal: bool) -> bytes:
    """Return the fragility model of curves of one threshold, by the names of their classes, NRML 0.5.

    Levels where nothing was tried are left out. A lognormal of median m and dispersion β has the mean m exp(β²/2) and
    the standard deviation mean √(exp(β²) − 1), which are what OpenQuake asks for. Of a curve with an upper end that one
    is written, on the safe side, and the description says so.
    """
    threshold = next(iter(curves.values())).threshold
    state = "overturning" if math.isinf(threshold) else f"rotation_{threshold:g}"
    root = ElementTree.Element("nrml", xmlns=_NRML)
    model = ElementTree.SubElement(root, "fragilityModel", _MODEL)
    over = dict.fromkeys(f"{curve.measure}, {curve.sample.words}" for curve in curves.values())
    ends = [name for name, curve in curves.items() if curve.upper is not None]
    safe = f"; upper ends, in which what cannot be told falls (it slides first, or contacts open): {', '.join(ends)}"
    ElementTree.SubElement(
        model, "description"
    ).text = f"{state} over {'; '.join(over)}{safe if ends else ''}"
    ElementTree.SubElement(model, "limitStates").text = state
    for name, curve in curves.items():
        _add_function(model, curve.upper or curve, name, state, lognormal)
    return _written(root)


def nrml_without(reason: str) -> bytes:
    """Return a fragility model that holds no function, and whose description says why, NRML 0.5."""
    root = ElementTree.Element("nrml", xmlns=_NRML)
    model = ElementTree.SubElement(root, "fragilityModel", _MODEL)
    ElementTree.SubElement(model, "description").text = f"No function: {reason}"
    return _written(root)


def _written(root: ElementTree.Element) -> bytes:
    ElementTree.indent(root)
    content: bytes = ElementTree.tostring(root, encoding="utf-8")
    return b"<?xml version='1.0' encoding='utf-8'?>\n" + content + b"\n"


def _add_function(
    model: ElementTree.Element, curve: FragilityCurve, name: str, state: str, lognormal: bool
) -> None:
    if not name or UNPRINTABLE.search(name):
        raise ConfigurationError(f"name is {name!r}, but must be printable and not empty.", name=name)
    imt, scale = of_openquake(curve.measure)
    tried = np.isfinite(curve.probability)
    levels = curve.levels[tried] * scale
    form = {"format": "continuous", "shape": "logncdf"} if lognormal else {"format": "discrete"}
    function = ElementTree.SubElement(model, "fragilityFunction", {"id": name, **form})
    least = f"{levels[0]:.9g}"
    if lognormal:
        mean = curve.lognormal_median * math.exp(curve.dispersion**2 / 2) * scale
        deviation = mean * math.sqrt(math.expm1(curve.dispersion**2))
        # No damage below a millionth of the median: the lognormal itself has no least level.
        edges = {
            "noDamageLimit": f"{mean * 1e-6:.9g}",
            "minIML": f"{mean * 1e-6:.9g}",
            "maxIML": f"{levels[-1]:.9g}",
        }
        ElementTree.SubElement(function, "imls", {"imt": imt, **edges})
        ElementTree.SubElement(function, "params", ls=state, mean=f"{mean:.9g}", stddev=f"{deviation:.9g}")
    else:
        imls = ElementTree.SubElement(function, "imls", imt=imt, noDamageLimit=least)
        imls.text = " ".join(f"{level:.9g}" for level in levels)
        poes = ElementTree.SubElement(function, "poes", ls=state)
        poes.text = " ".join(f"{probability:.9g}" for probability in curve.probability[tried])


def curve_frame(curve: FragilityCurve) -> "DataFrame":
    """Return the curve as a pandas frame: a row per level, nan where nothing was tried."""
    from pandas import DataFrame  # which takes half a second to import

    of_all = dict(zip(_HEAD, (curve.measure, curve.unit, curve.threshold), strict=False))
    return DataFrame({"level": curve.levels, **{name: getattr(curve, name) for name in _COLUMNS}}).assign(
        **of_all
    )[list(_HEAD)]
