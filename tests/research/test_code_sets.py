"""Sets of records of two halves of the stations: what one says, beside what the other does."""

from functools import partial

import pytest

from docs.research import code_checks
from docs.research.code_checks import SetTrial, code_sets
from docs.research.report import Target
from docs.research.scores import Score
from rocking import Block, DesignSpectrum, select
from rocking.errors import ConfigurationError
from rocking.tables import read_table
from tests.made_pools import made_pool
from tests.refusals import refused


def trial(low: float, high: float, other: float) -> SetTrial:
    return SetTrial(
        wall="one",
        split=0,
        pool="first",
        stations=5,
        earthquakes=3,
        share=high,
        share_low=low,
        share_high=high,
        other_share=other,
    )


def test_a_share_is_covered_but_for_one_set_of_two_hundred():
    assert trial(0.4, 0.8, 0.6).covered
    assert trial(0.4, 0.8, 0.8049).covered
    assert not trial(0.4, 0.8, 0.81).covered
    assert not trial(0.4, 0.8, 0.39).covered
    assert not trial(1.0, 1.0, 1.0).sets_disagree
    assert trial(1.0, 1.0, 0.9).sets_disagree


def test_each_half_is_held_beside_the_other(tmp_path, monkeypatch):
    """Each share stands twice, once as stated and once as what the other half says."""
    monkeypatch.setattr(code_checks, "SPECTRUM", DesignSpectrum.ntc(2.0, 2.5, 0.4))
    monkeypatch.setattr(code_checks, "SET_STATIONS", 3)
    monkeypatch.setattr(code_checks, "select", partial(select, periods=(0.6, 0.9)))
    monkeypatch.setattr(code_checks, "SPLITS", 4)
    monkeypatch.setattr(code_checks, "SET_WALLS", {"wall": Block.of_size(0.45, 3.0)})
    records = [(name, component) for name, pair in made_pool(24).items() for component in pair]
    code_sets(Target(tmp_path, lambda _: None, [records], {}))
    rows = read_table(SetTrial, tmp_path)
    assert rows
    for first, second in zip(rows[::2], rows[1::2], strict=True):
        assert (first.pool, second.pool) == ("first", "second")
        assert (first.share, first.other_share) == (second.other_share, second.share)
        assert first.stations == second.stations == 12
    (score, *_) = read_table(Score, tmp_path)
    assert score.value == pytest.approx(sum(row.covered for row in rows) / len(rows))
    monkeypatch.setattr(code_checks, "SET_STATIONS", 13)
    with refused(ConfigurationError, "sites", 24):
        code_sets(Target(tmp_path, lambda _: None, [records], {}))
