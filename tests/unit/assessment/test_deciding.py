"""What decides: shares of variance against known ones, and the words for them."""

import numpy as np
import pytest

from rocking.assessment.cracks import CrackEnsembles, FollowedCrack, decided_by, deciding, explained
from rocking.assessment.ensemble import Ensemble, Origin
from rocking.assessment.settings import EnsembleSettings

SIGN = np.where(np.arange(64) % 2, 1.0, -1.0)
OFFSET = np.linspace(-0.05, 0.05, 64)
RNG = np.random.default_rng(0)


def _ensemble(falls: np.ndarray, **causes: np.ndarray) -> Ensemble:
    return Ensemble(np.where(falls, np.inf, 0.4), causes, EnsembleSettings())


def _ensembles(*several: Ensemble, given: bool = False) -> CrackEnsembles:
    followed = (
        FollowedCrack(f"crack {k}", float(k), part, counts=not (given and k))
        for k, part in enumerate(several)
    )
    return CrackEnsembles(tuple(followed))


def test_what_is_known_from_one_cause_is_decided_by_it_and_what_is_not_by_none():
    by_sign = _ensembles(_ensemble(SIGN > 0, polarity=SIGN, restitution=OFFSET))
    assert [(trial.name, trial.share) for trial in deciding(by_sign)] == [("polarity", 1.0)]
    assert decided_by(by_sign) == "decided by the sign of the motion (100 %)"
    by_restitution = _ensembles(_ensemble(OFFSET > 0, polarity=SIGN, restitution=OFFSET))
    assert decided_by(by_restitution) == "decided by the restitution (100 %)"
    together = _ensembles(_ensemble((SIGN > 0) == (OFFSET > 0), polarity=SIGN, restitution=OFFSET))
    assert decided_by(together) == "nothing decides on its own", "either alone says nothing"


def test_what_is_alike_whatever_the_cause_explains_nothing_in_the_mean():
    """ε² is the share less what groups explain by accident: before the cut at 0 its mean is 0 without any effect."""
    shares = [explained(RNG.random(64) < 0.3, np.arange(64) % 8) for _ in range(400)]
    assert np.mean(np.array(shares) == 0) > 0.4 and np.mean(shares) < 0.05


@pytest.mark.parametrize("share", [0.2, 0.6])
def test_the_share_is_that_of_the_variance(share):
    """An outcome that follows the sign in a share r of the cases, else a fair coin, has r² of its variance in it."""
    many = 40_000
    sign = np.where(np.arange(many) % 2, 1.0, -1.0)
    follows = RNG.random(many) < share
    falls = np.where(follows, sign > 0, RNG.random(many) < 0.5)
    assert explained(falls, sign) == pytest.approx(share**2, abs=0.02)


def test_which_crack_opens_decides_where_they_disagree_and_none_is_given():
    stands, falls = (_ensemble(np.full(64, choice)) for choice in (False, True))
    assert decided_by(_ensembles(stands, falls)) == "decided by which crack opens (100 %)"
    assert decided_by(_ensembles(stands, falls, given=True)) == "", "all members of it agree"
    assert decided_by(_ensembles(stands)) == "" == decided_by(_ensembles(falls))


def test_a_restitution_that_is_typed_and_another_by_geometry_disagree():
    typed, by_geometry = (
        FollowedCrack("crack", 0.0, _ensemble(np.full(64, falls)), of_geometry=falls)
        for falls in (False, True)
    )
    (found,) = deciding(CrackEnsembles((typed, by_geometry)))
    assert (found.name, found.share, found.origin) == ("restitution", 1.0, Origin.IGNORANCE)
