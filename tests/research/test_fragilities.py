"""The medians of fragilities: a symmetric population has no bias."""

from docs.research import fragilities
from docs.research.fragilities import population_scores


def test_the_median_of_a_known_population(monkeypatch):
    """Of a lognormal of median 1; 40 intervals of 90 % miss it in 4, and in ten or more once in 500 studies."""
    monkeypatch.setattr(fragilities, "STATIONS", (20,))
    monkeypatch.setattr(fragilities, "TRIALS", 40)
    monkeypatch.setattr(fragilities, "ESTIMATES", 1000)
    monkeypatch.setattr(fragilities, "MANY", 100_000)
    held, bias = population_scores("lognormal")
    assert held.value > 0.75 and held.cases == 40
    assert abs(bias.value) < 0.06, "a step of the levels"
