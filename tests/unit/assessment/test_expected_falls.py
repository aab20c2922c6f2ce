"""How many structures of a class are expected to fall, over records that they share."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest, norm

from rocking.assessment.conclusion import CLASS, falls_in_words
from rocking.assessment.rows import (
    ExpectedFallsRow,
    falls_over,
    falls_under,
    interval_of_mean,
    worst_period_each,
)
from rocking.earthquakes.sample import MADE, ClusterSample
from tests.unit.assessment.made_rows import broken, case, station, verdicts


def under(shares: list[float], structures: int) -> list[ExpectedFallsRow]:
    return [
        ExpectedFallsRow(
            record=f"record {number}",
            structures=structures,
            expected_falls=share * structures,
            without_share=0.0,
        )
        for number, share in enumerate(shares)
    ]


def over(records: list[ExpectedFallsRow]) -> ExpectedFallsRow | None:
    """The mean over records of as many stations of as many earthquakes."""
    return falls_over(records, {record.record: (record.record, record.record) for record in records})


def test_the_shares_of_those_that_have_one_are_added() -> None:
    """48 and 16 of 64 members fall, none of 64, and one structure cannot be told; a variant is not counted."""
    stations = [
        station(case("EW", math.inf, "pier", falls=48)),
        station(case("EW", 0.5, "wall", falls=16), case("NS", 0.1, "wall", falls=0)),
        station(case("EW", 0.1, "arch", falls=0)),
        station(broken("EW", "spire")),
        station(case("EW", 0.1, "pier: tied", falls=64)),
    ]
    row = falls_under(verdicts(stations, "a"), ["pier: tied"])
    assert row is not None
    assert (row.record, row.structures, row.expected_falls, row.without_share) == ("a", 4, 1.0, 1.0)
    assert math.isnan(row.expected_falls_low)
    assert falls_under([]) is None


def test_one_record_has_no_interval() -> None:
    of_all = over(under([0.3], 50))
    assert of_all is not None and of_all.expected_falls == pytest.approx(15)
    assert math.isnan(of_all.expected_falls_low) and math.isnan(of_all.expected_falls_high)
    assert over([]) is None


def test_a_made_record_is_no_earthquake() -> None:
    """The mean and the sentence are of the recorded ones; where all are made, they are of these."""
    names = {"a": ("a", "Kobe"), "b": ("b", "Landers"), "sine": ("sine", MADE)}
    rows = [
        falls_under(verdicts([station(case("EW", 0.5, "pier", falls=falls))], record), made={"sine"})
        for record, falls in (("a", 16), ("sine", 64), ("b", 32))
    ]
    falls = [replace(row, structures=CLASS) for row in rows if row is not None]
    of_all = falls_over(falls, names)
    assert of_all is not None
    assert (of_all.expected_falls, of_all.stations, of_all.earthquakes) == (0.375, 2, 2)
    assert falls_in_words([*falls, of_all]) == falls_in_words([falls[0], falls[2], of_all])
    of_one = falls_over(falls, names | {"b": ("b", "Kobe")})
    assert of_one is not None
    assert "(no interval: all 2 stations are of one earthquake)" in falls_in_words([*falls, of_one])
    alone = falls_over(falls[1:2], names)
    assert alone is not None and (alone.expected_falls, alone.earthquakes) == (1.0, 1)


def test_a_station_is_still_where_no_record_of_it_lifts_anything() -> None:
    ratios = {"a": 0.0, "b": 0.4, "c": 0.0, "d": 0.2}
    rows = [
        falls_under(verdicts([station(case("EW", ratio, "pier", falls=0))], name))
        for name, ratio in ratios.items()
    ]
    stations = {"a": "one", "b": "one", "c": "two", "d": "three"}
    of_all = falls_over(filter(None, rows), {name: (place, "Kobe") for name, place in stations.items()})
    assert of_all is not None and of_all.still == 1


@pytest.mark.parametrize("records", [3, 10])
def test_what_no_record_has_shown_is_bounded_by_their_number(records) -> None:
    """What befalls a part q of all records is met by none of n in (1 - q)^n: 5 % of studies at the end stated.

    Of records that bring down all or none, the ends are those of Clopper and Pearson for k of n.
    """
    ends = 50 * (1 - 0.05 ** (1 / records))
    none, every = over(under([0.0] * records, 50)), over(under([1.0] * records, 50))
    assert none is not None and every is not None
    assert (none.expected_falls_low, none.expected_falls_high) == pytest.approx((0, ends))
    assert (every.expected_falls_low, every.expected_falls_high) == pytest.approx((50 - ends, 50))
    mixed = over(under([1.0] * 2 + [0.0] * (records - 2), 50))
    exact = binomtest(2, records).proportion_ci(0.9, "exact")
    assert mixed is not None
    assert (mixed.expected_falls_low, mixed.expected_falls_high) == pytest.approx(
        (50 * exact.low, 50 * exact.high)
    )


def test_structures_that_fall_together_do_not_narrow_the_interval() -> None:
    """Ten times as many structures with the same shares are the same records: all ends are ten times as large."""
    shares = [0.1, 0.3, 0.2, 0.6, 0.05]
    few, many = (over(under(shares, number)) for number in (30, 300))
    assert few is not None and many is not None
    for name in ("expected_falls", "expected_falls_low", "expected_falls_high"):
        assert getattr(many, name) == pytest.approx(10 * getattr(few, name))


@pytest.mark.parametrize("records", [3, 10])
@pytest.mark.parametrize("median", [0.15, 0.3, 1.0])
def test_the_interval_holds_the_mean_of_records_that_are_drawn(records, median) -> None:
    """Structures of lognormal fragilities under lognormal shaking, which all share; 500 studies of each.

    Asked: 90 %; the error of 500 studies is 2.2 % (90 %). From under 1 % to a half of them fall.
    """
    drawn = np.random.default_rng(7)
    resistance = np.exp(drawn.normal(0, 0.6, 200))

    def share(shaking: np.ndarray) -> np.ndarray:
        return norm.cdf(np.log(shaking[..., None] / resistance) / 0.4).mean(axis=-1)

    truth = 200 * share(median * np.exp(0.6 * norm.ppf((np.arange(2000) + 0.5) / 2000))).mean()
    studies = share(median * np.exp(0.6 * drawn.standard_normal((500, records))))
    held = [over(under(list(shares), 200)) for shares in studies]
    inside = [row.expected_falls_low <= truth <= row.expected_falls_high for row in held if row]
    assert len(inside) == 500 and np.mean(inside) > 0.9 - 0.022


def test_the_upper_end_of_few_that_fall_is_that_of_a_shared_normal_variable() -> None:
    """Φ(μ/√(1 + σ²)) over draws of the μ and σ of a normal sample (Krishnamoorthy & Mathew 2003)."""
    shaking = np.linspace(-2.2, -1.0, 5)
    drawn = np.random.default_rng(5)
    deviations = shaking.std(ddof=1) * np.sqrt(4 / drawn.chisquare(4, 400_000))
    means = shaking.mean() + deviations * drawn.standard_normal(400_000) / math.sqrt(5)
    high = np.quantile(norm.cdf(means / np.sqrt(1 + deviations**2)), 0.95)
    found = interval_of_mean(50 * norm.cdf(shaking), 50, ClusterSample.scattered("abcde"))
    assert found[1] == pytest.approx(50 * high, rel=0.01)


def test_a_class_is_told_in_one_sentence() -> None:
    of_all = {
        "expected_falls_low": 33.2,
        "expected_falls_high": 50.4,
        "stations": 7,
        "earthquakes": 2,
        "still": 3,
    }
    rows = [
        ExpectedFallsRow(record=name, structures=300, expected_falls=falls, without_share=untold, **interval)
        for name, falls, untold, interval in (
            ("a", 30.0, 12.0, {}),
            ("b", 52.0, 11.0, {}),
            ("", 41.0, 11.5, of_all),
        )
    ]
    assert falls_in_words(rows) == (
        "41 of 300 structures are expected to fall under such a record (interval of 2 earthquakes, which holds less "
        "than nine times in ten: 33–50, by the spread over 7 stations "
        "of 2 earthquakes); nothing lifts any of them at 3 of 7 stations; "
        "11.5 more cannot be told per record on average."
    )
    assert falls_in_words([]) == ""
    assert falls_in_words([row for row in map(over, [under([0.2], CLASS - 1)]) if row]) == ""
    one = under([0.2], CLASS)
    of_one = over(one)
    assert of_one is not None
    assert falls_in_words([*one, of_one]) == "4 of 20 structures are expected to fall under the record."


@pytest.mark.parametrize(
    ("shares", "because"),
    [
        ([0.0, 0.0, 0.3], "none is"),
        ([1.0, 1.0, 0.3], "all are"),
        ([0.5, 0.5, 0.5], "the same number is"),
    ],
)
def test_a_wide_interval_says_why(shares, because) -> None:
    rows = under(shares, 40)
    of_all = over(rows)
    assert of_all is not None
    said = falls_in_words([*rows, of_all])
    assert (
        f"; wide, as under most of the records, of 3 stations of 3 earthquakes, {because} expected to fall)"
        in said
    )


def test_stations_of_one_earthquake_say_no_more_than_their_mean() -> None:
    """Of equally many stations each, the interval is that of the means of the earthquakes; one tells nothing."""
    falls = np.array([5.0, 7.0, 20.0, 22.0, 11.0, 13.0])
    pairs = ClusterSample(tuple("abcdef"), ("one", "one", "two", "two", "three", "three"))
    of_means = interval_of_mean(np.array([6.0, 21.0, 12.0]), 50, ClusterSample.scattered("abc"))
    assert interval_of_mean(falls, 50, pairs) == pytest.approx(of_means)
    apart = interval_of_mean(falls, 50, ClusterSample.scattered("abcdef"))
    assert of_means[0] < apart[0] and apart[1] < of_means[1]
    assert interval_of_mean(falls, 50, ClusterSample(tuple("abcdef"), ("one",) * 6)) == (0.0, 50.0)


def test_the_worst_verdict_comes_first() -> None:
    stations = [station(case("EW", 0.1, "arch", falls=0)), station(case("EW", math.inf, "pier", falls=64))]
    assert [row.structure for row in worst_period_each(verdicts(stations, "a"))] == ["pier", "arch"]


def test_one_earthquake_with_nearly_all_stations_says_nothing_of_others():
    stations = tuple(f"station {place}" for place in range(402))
    sample = ClusterSample(stations, ("one",) * 400 + ("two", "three"))
    with np.errstate(all="raise"):
        low, high = interval_of_mean(np.array([5.0] * 400 + [6.0, 7.0]), 12, sample)
    assert (low, high) == (pytest.approx(0.0, abs=1e-9), pytest.approx(12.0))
