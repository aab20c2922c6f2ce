"""Reserve: the factor by which a record may be stronger before a structure overturns.

There is no first factor at which a structure falls: most stand again at a somewhat larger one, so that it would move
with the step of the search. The share of the members of an ensemble that overturn is smooth, and the reserve is the
factors on the record at which it reaches 5, 50 and 95 %. It is computed for a structure on the ground, and on a support
at the worst of its periods, by a ladder of amplitudes (`ladder.py`).
"""

import math
from dataclasses import dataclass

SHARES = (0.05, 0.5, 0.95)
"""Shares of the members that overturn at the low, the median and the high factor."""


@dataclass(frozen=True, kw_only=True)
class Reserve:
    """The factors on a record at which 5, 50 and 95 % of the members overturn, with the mechanism that governs.

    nan where fewer overturn at every factor up to the `limit`.

    Parameters
    ----------
    low : float
        Factor at which 5 % of the members overturn.
    median : float
        Factor at which half of them do.
    high : float
        Factor at which 95 % of them do.
    limit : float
        Largest factor that was tried.

    Examples
    --------
    >>> print(rocking.Reserve(low=0.8, median=1.1, high=np.nan, limit=3.0))
    5 % of members fall at 0.8 ×, half at 1.1 × this record, fewer than 95 % up to 3 ×
    >>> print(rocking.Reserve(low=np.nan, median=np.nan, high=np.nan, limit=3.0))
    fewer than 5 % of members fall up to 3 × this record
    """

    low: float
    median: float
    high: float
    limit: float

    def held_to(self, share: float) -> "Reserve":
        """Return the reserve that does not contradict the `share` of members that overturn under the record itself.

        A share that is reached there has a factor of 1 at most, another one of 1 at least: the factors come of a curve
        through members of many records, which need not pass through that share.
        """
        factors = []
        for reached, factor in zip(SHARES, (self.low, self.median, self.high), strict=True):
            if share >= reached:
                factors.append(1.0 if math.isnan(factor) else min(factor, 1.0))
            else:
                factors.append(factor if math.isnan(factor) else max(factor, 1.0))
        low, median, high = factors
        return Reserve(low=low, median=median, high=high, limit=self.limit)

    @property
    def in_figures(self) -> str:
        """The factors at which 5 % and half of the members overturn: "0.28–0.54", "2.5–3+" or "3+"."""
        beyond = f"{self.limit:g}+"
        low, median = (
            beyond if math.isnan(factor) else f"{factor:.0f}" if factor >= 10 else f"{factor:#.2g}"
            for factor in (self.low, self.median)
        )
        return low if low == median else f"{low}–{median}"

    def __str__(self) -> str:
        if math.isnan(self.low):
            return f"fewer than 5 % of members fall up to {self.limit:g} × this record"
        words = f"5 % of members fall at {self.low:.2g} ×"
        if math.isnan(self.median):
            return f"{words}, fewer than half up to {self.limit:g} × this record"
        words = f"{words}, half at {self.median:.2g} × this record"
        if math.isnan(self.high):
            return f"{words}, fewer than 95 % up to {self.limit:g} ×"
        return f"{words}, 95 % at {self.high:.2g} ×"
