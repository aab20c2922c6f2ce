"""Hazard curves of OpenQuake and plain ones, the rate under them by a closed form, and files for OpenQuake."""

import csv
import math
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.stats import lognorm, norm

import rocking
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import ConfigurationError
from rocking.fragility.curves import Fragility, fragility_of
from rocking.fragility.hazard import Hazard
from tests.refusals import refused

LEVELS = np.geomspace(0.02, 50.0, 400)
MEDIAN, DISPERSION = 1.2, 0.4
NRML = "{http://openquake.org/xmlns/nrml/0.5}"
HEAD = (
    "#,,,,,\"generated_by='OpenQuake engine 3.23.2', start_date='2025-04-01T10:00:00', checksum=1234567890, "
    "kind='{kind}', investigation_time={time}, imt='{imt}'\"\n"
)


def _lognormal(measure: str = "pgv", unit: str = "m/s") -> Fragility:
    """The curve of four stations, each of which has the same lognormal."""
    shares = np.tile(norm.cdf(np.log(LEVELS / MEDIAN) / DISPERSION), (4, 1))
    return replace(fragility_of(LEVELS, shares, ClusterSample.scattered("abcd")), measure=measure, unit=unit)


def _file(folder, name, levels, rows, *, kind="mean", imt="PGV", time="50.0"):
    columns = ",".join(f"poe-{level:.7f}" for level in levels)
    sites = "".join(
        f"{place},{latitude},0.00000," + ",".join(f"{poe:.6E}" for poe in poes) + "\n"
        for (place, latitude), poes in rows.items()
    )
    path = folder / name
    path.write_text(HEAD.format(kind=kind, imt=imt, time=time) + f"lon,lat,depth,{columns}\n{sites}")
    return path


@pytest.mark.parametrize("slope", [1.5, 2.5, 3.5])
def test_the_rate_of_a_lognormal_under_a_power_law_is_the_closed_form(slope):
    """ν = k₀ x⁻ᵏ and a lognormal of median m and dispersion β: rate = k₀ m⁻ᵏ exp(k²β²/2) (Cornell 1996)."""
    ends = LEVELS[[0, -1]]
    rate = _lognormal().annual_rate(Hazard(ends, 1e-3 * ends**-slope))
    exact = 1e-3 * MEDIAN**-slope * math.exp(slope**2 * DISPERSION**2 / 2)
    assert rate.value == pytest.approx(exact, rel=1e-3)
    assert rate.probability(50)[0] == pytest.approx(1 - math.exp(-50 * exact), rel=1e-3)


def test_a_curve_of_openquake_gives_rates_in_our_unit_with_its_quantiles(tmp_path):
    """Of a Poisson process p = 1 − exp(−νt); PGV is in cm/s there. Probabilities of 0 and 1 tell no rate."""
    levels = np.array([1.0, 5.0, 20.0, 100.0, 500.0])
    rates = np.array([np.inf, 2e-2, 1e-3, 5e-5, 0.0])
    probabilities = -np.expm1(-50 * rates)
    site = (12.5, 41.9)
    mean = _file(tmp_path, "mean.csv", levels, {site: probabilities})
    halves = [
        _file(
            tmp_path, f"{share}.csv", levels, {site: -np.expm1(-50 * rates * scale)}, kind=f"quantile-{share}"
        )
        for share, scale in ((0.15, 0.5), (0.85, 1.5))
    ]
    hazard = Hazard.read(mean, *halves)
    assert hazard.measure == "PGV"
    with refused(ConfigurationError, "quantile", "mean"):
        Hazard.read(mean, mean)
    assert hazard.levels.tolist() == pytest.approx([0.05, 0.2, 1.0], rel=1e-12)
    # the file prints seven digits of a probability, of which the rarest has lost none
    assert hazard.annual_rates.tolist() == pytest.approx([2e-2, 1e-3, 5e-5], rel=1e-5)
    found = _lognormal().annual_rate(hazard)
    assert found.of_quantiles == pytest.approx({0.15: found.value / 2, 0.85: 1.5 * found.value}, rel=1e-5)


@pytest.mark.parametrize("imt", ["SA(0.5)", "Sa_avg2(1.0)", "FIV3(0.7)", "AvgSA"])
@pytest.mark.parametrize("quote", ["'", '""'])
def test_the_first_line_is_read_as_engines_quote_it(tmp_path, imt, quote):
    """Former engines wrote texts in double quotes, which a CSV doubles."""
    path = _file(tmp_path, "curve.csv", [1.0, 2.0], {(1.0, 2.0): [0.2, 0.1]}, imt=imt)
    head, *rest = path.read_text().splitlines(keepends=True)
    path.write_text("".join([head.replace("'", quote), *rest]))
    hazard = Hazard.read(path)
    assert hazard.measure == imt
    assert hazard.levels.tolist() == pytest.approx([0.01, 0.02] if imt.startswith("FIV3") else [1.0, 2.0])


def test_one_site_of_several_is_asked_for(tmp_path):
    rows = {(12.5, 41.9): [0.5, 0.1], (13.0, 42.0): [0.4, 0.05]}
    path = _file(tmp_path, "two.csv", [1.0, 2.0], rows)
    hazard = Hazard.read(path, site=(13.0, 42.0))
    assert hazard.annual_rates == pytest.approx(-np.log([0.6, 0.95]) / 50, rel=1e-6)
    with refused(ConfigurationError, "site", 2):
        Hazard.read(path)
    with refused(ConfigurationError, "site", 0):
        Hazard.read(path, site=(1.0, 2.0))


@pytest.mark.parametrize(
    ("changed", "field", "value"),
    [
        ({"rows": {(1, 2): [0.1, 0.2]}}, "annual_rate", -np.log1p(-0.2) / 50),
        ({"rows": {(1, 2): [0.1, -0.2]}}, "probabilities", 50.0),
        ({"rows": {(1, 2): [1.0, 0.1]}}, "points", 1),
        ({"imt": "MMI"}, "imt", "MMI"),
        ({"imt": "SA(0)"}, "imt", "SA(0)"),
        ({"time": "0"}, "probabilities", 0.0),
    ],
)
def test_a_file_of_openquake_that_is_none_is_refused(tmp_path, changed, field, value):
    rows = changed.pop("rows", {(1, 2): [0.2, 0.1]})
    path = _file(tmp_path, "bad.csv", [1.0, 2.0], rows, **changed)
    with refused(ConfigurationError, field, value):
        Hazard.read(path)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("intensity,annual_rate\n0.1,0.01\n0.2,0.02\n", ("annual_rate", 0.02)),
        ("intensity,annual_rate\n0.1,2\n0.2,0.02\n", ("annual_rate", 2.0)),
        ("#,,\"kind='mean', imt='PGA'\"\nlon,lat,depth,poe-1\n", ("header", "investigation_time")),
        ("#,,\"investigation_time=50.0, imt='PGA'\"\nlon,lat\n1,2\n", ("probabilities", 50.0)),
        ("#,,\"investigation_time=50.0, imt='PGA'\"\nlat,poe-1\n1,2\n", ("format", "OpenQuake")),
    ],
)
def test_a_plain_file_that_is_none_is_one_sentence(tmp_path, text, named):
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    with refused(ConfigurationError, *named):
        Hazard.read(path)


@pytest.mark.parametrize(
    ("head", "level", "measure", "unit"),
    [
        ("level_g", 0.3, "", "g"),
        ("level_m_s2", 0.3 * 9.80665, "", "g"),
        ("PGA (g)", 0.3, "PGA", "g"),
        ("PGA [cm/s²]", 0.3 * 980.665, "PGA", "g"),
        ("pga_gal", 0.3 * 980.665, "PGA", "g"),
        ("SA(0.5) (%g)", 30.0, "SA(0.5)", "g"),
        ("PGV [cm/s]", 30.0, "PGV", "m/s"),
        ("level_cm_s", 30.0, "", "m/s"),
        ("pgv_m_s", 0.3, "PGV", "m/s"),
        ("intensity", 0.3, "", ""),
    ],
)
def test_levels_of_a_plain_file_are_converted_by_the_unit_in_their_head(tmp_path, head, level, measure, unit):
    """0.3 g or 0.3 m/s each; one standard g is 9.80665 m/s² (ISO 80000-3)."""
    path = tmp_path / "hazard.csv"
    for columns in (
        f"{head},annual_rate\n{level!r},0.01\n{10 * level!r},0.001\n",
        f"annual_rate,{head}\n0.01,{level!r}\n0.001,{10 * level!r}\n",
    ):
        path.write_text(columns)
        hazard = Hazard.read(path)
        assert hazard.levels.tolist() == pytest.approx([0.3, 3.0], rel=1e-12)
        assert hazard.annual_rates.tolist() == [0.01, 0.001]
        assert (hazard.measure, hazard.unit) == (measure, unit)
    assert hazard.is_of("pga") == (unit != "m/s" and measure in ("", "PGA"))
    assert hazard.is_of("pgv") == (unit != "g" and measure in ("", "PGV"))


@pytest.mark.parametrize(
    ("text", "named"),
    [
        (
            "level,annual_rate\n0.1,0.01\n0.2,0.002\n",
            ("columns",),
        ),
        ("PGA,annual_rate\n0.1,0.01\n0.2,0.002\n", ("columns",)),
        ("SA(0.5),annual_rate\n0.1,0.01\n0.2,0.002\n", ("columns",)),
        ("level_furlong,annual_rate\n0.1,0.01\n", ("columns",)),
        ("intensity;annual_rate\n10;0.01\n", ("columns",)),
        ("level_g,rate\n0.1,0.01\n", ("columns",)),
        ("level_g,annual_rate,level_m_s2\n0.1,0.01,1\n", ("columns",)),
        (
            "PGA (cm/s),annual_rate\n0.1,0.01\n0.2,0.002\n",
            ("unit", "PGA (cm/s)"),
        ),
        ("level_g,annual_rate\n0.1,abc\n", ("line", 2)),
        ("level_g,annual_rate\n0.1\n", ("line", 2)),
        ("level_g,annual_rate\n0.1,nan\n0.2,0.01\n", ("annual_rate",)),
        ("level_g,annual_rate\n", ("points", 0)),
        ("", ("columns",)),
    ],
)
def test_a_plain_file_without_a_unit_or_numbers_is_one_sentence(tmp_path, text, named):
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    with refused(ConfigurationError, *named):
        Hazard.read(path)


def test_levels_in_g_are_no_levels_of_a_velocity():
    hazard = Hazard(np.array([0.1, 1.0]), np.array([1e-2, 1e-4]), unit="g")
    with refused(ConfigurationError, "intensity_measure", "pgv"):
        _lognormal().annual_rate(hazard)
    assert _lognormal("AvgSA(0.2,2.0)", "g").annual_rate(hazard).value > 0


def test_a_hazard_of_another_measure_is_refused():
    hazard = Hazard(np.array([0.1, 1.0]), np.array([1e-2, 1e-4]), "SA(0.5)")
    with refused(ConfigurationError, "intensity_measure", "pgv"):
        _lognormal().annual_rate(hazard)
    assert _lognormal("SA(0.5)", "g").annual_rate(hazard).value > 0
    of_range = replace(hazard, measure="AvgSA")
    assert _lognormal("AvgSA(0.2,2.0)", "g").annual_rate(of_range).value > 0


def test_the_discrete_nrml_holds_the_curve_in_units_of_openquake(tmp_path):
    curve = _lognormal()
    curve.to_nrml(tmp_path / "pier.xml", name="stone pier & wall")
    (model,) = ElementTree.parse(tmp_path / "pier.xml").getroot()
    assert model.tag == f"{NRML}fragilityModel"
    function = model.find(f"{NRML}fragilityFunction")
    assert (function.get("id"), function.get("format")) == ("stone pier & wall", "discrete")
    imls, poes = function
    assert (
        imls.get("imt") == "PGV" and poes.get("ls") == model.find(f"{NRML}limitStates").text == "overturning"
    )
    assert [float(part) for part in imls.text.split()] == pytest.approx(
        (100 * curve.levels).tolist(), rel=1e-8
    )
    assert [float(one_part) for one_part in poes.text.split()] == pytest.approx(
        curve.probability.tolist(), abs=1e-9
    )


def test_the_lognormal_of_nrml_is_that_of_the_curve(tmp_path):
    """OpenQuake takes mean and standard deviation of the level itself, and makes μ and σ of its logarithm of them."""
    curve = _lognormal("FIV3(0.7)")
    curve.to_nrml(tmp_path / "pier.xml", lognormal=True)
    params = ElementTree.parse(tmp_path / "pier.xml").getroot().find(f".//{NRML}params")
    mean, deviation = float(params.get("mean")), float(params.get("stddev"))
    sigma = math.sqrt(math.log(1 + (deviation / mean) ** 2))
    law = lognorm(sigma, scale=mean / math.sqrt(1 + (deviation / mean) ** 2))
    assert law.cdf(100 * LEVELS) == pytest.approx(curve.lognormal, abs=1e-7)


def test_nrml_says_the_range_of_an_average_and_refuses_what_openquake_lacks(tmp_path):
    _lognormal("AvgSA(0.2,2.0)", "g").to_nrml(tmp_path / "pier.xml")
    (model,) = ElementTree.parse(tmp_path / "pier.xml").getroot()
    assert "AvgSA(0.2,2.0)" in model.find(f"{NRML}description").text
    assert model.find(f".//{NRML}imls").get("imt") == "AvgSA"
    with refused(ConfigurationError, "intensity_measure", "p_pgv"):
        _lognormal("p_pgv", "").to_nrml(tmp_path / "other.xml")
    with refused(ConfigurationError, "name", ""):
        _lognormal().to_nrml(tmp_path / "other.xml", name="")
    assert not (tmp_path / "other.xml").exists()


@pytest.mark.parametrize("name", ["pier.xml", "pier.csv"])
def test_a_curve_replaces_an_earlier_one_and_no_other_file(tmp_path, name):
    curve = _lognormal()
    write = curve.to_nrml if name.endswith("xml") else curve.to_csv
    write(tmp_path / name)
    write(tmp_path / name)
    (tmp_path / name).write_text("<nrml><exposureModel/></nrml>")
    with refused(ConfigurationError, "file", name):
        write(tmp_path / name)
    assert "exposureModel" in (tmp_path / name).read_text()


def test_the_csv_holds_the_curve(tmp_path):
    curve = _lognormal()
    curve.to_csv(tmp_path / "pier.csv")
    with (tmp_path / "pier.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["probability"]) for row in rows] == curve.probability.tolist()
    assert {(row["intensity_measure"], row["unit"], row["threshold"]) for row in rows} == {
        ("pgv", "m/s", "inf")
    }
    assert rocking.Hazard is Hazard


@pytest.mark.parametrize(("weak", "is_stated"), [(0, True), (1, True), (2, False), (4, False)])
def test_a_rate_is_told_where_nine_in_ten_stations_reach_where_half_of_it_is_made(weak, is_stated):
    """All overturn from 1 on, and some reach 0.5 only: 0 of these if never, all from there on if at once."""
    shares = np.tile((LEVELS >= 1.0).astype(float), (10, 1))
    shares[:weak, LEVELS > 0.5] = np.nan
    ends = LEVELS[[0, -1]]
    rate = fragility_of(LEVELS, shares, ClusterSample.scattered("abcdefghij")).annual_rate(
        Hazard(ends, 1e-3 * ends**-2.0)
    )
    assert (rate.reaching, rate.stations, rate.is_stated) == (10 - weak, 10, is_stated)
    assert math.isnan(rate.value) is not is_stated
    # Steps of 2 % in the level are 4 % of a rate that falls with its square.
    if is_stated:
        assert rate.value == pytest.approx(1e-3, rel=0.04)
    else:
        never = (1 - weak / 10) * 1e-3
        at_once = never + weak / 10 * 4e-3
        assert rate.low < never < at_once < rate.high


def test_the_rate_that_no_station_tells_is_at_most_that_of_all_at_once():
    """None falls up to 0.5 and nothing is known above, where the ground is as often as 1e-3/0.5² = 4e-3 a year."""
    shares = np.tile(np.where(LEVELS > 0.5, np.nan, 0.0), (3, 1))
    ends = LEVELS[[0, -1]]
    rate = fragility_of(LEVELS, shares, ClusterSample.scattered("abc")).annual_rate(
        Hazard(ends, 1e-3 * ends**-2.0)
    )
    assert rate.low == 0.0 and rate.high == pytest.approx(4e-3, rel=0.04)
