"""What the README and a page print of a measured trade is what its table says."""

from pathlib import Path

import rocking
from docs.site.generated import measured_trade, pulse_shapes, trade, what_follows
from rocking.products.trade.rows import TradeMethod

README = (Path(rocking.__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_the_readme_prints_the_trade_that_was_measured():
    rows = {row.method: row for row in measured_trade()}
    sine, mechanism = rows[TradeMethod.ONE_SINE], rows[TradeMethod.MECHANISM]
    told = (
        f"{1e3 * sine.preparation_record_s:.2g} ms per record and {1e3 * sine.cpu_s:.2g} ms per structure",
        f"the integration {1e3 * mechanism.cpu_s:.2g} ms per structure",
        f"below {sine.break_even_in_words}",
        f"{sine.wrong_verdicts} of {sine.cases} verdicts wrong against {mechanism.wrong_verdicts}",
        f"{100 * sine.wrong_share_low:.0f} to {100 * sine.wrong_share_high:.0f} % of such cases",
        sine.machine.partition(",")[0],
    )
    for warning in told:
        assert warning in README, warning


def test_the_page_prints_each_method_and_shape_with_the_machine():
    """A header, a rule, and a row each; of no recorded motion one sine dominates."""
    methods = [method for method in TradeMethod if method is not TradeMethod.DOMINANT_SINE]
    assert [row.method for row in measured_trade()] == methods
    assert len(trade().splitlines()) == 2 + len(methods)
    assert what_follows().endswith(f"Measured on {measured_trade()[0].machine}.")
    shapes = pulse_shapes().splitlines()
    assert len(shapes) == 2 + 6 and all(line.count("%") == 4 for line in shapes[2:])
