"""Signal: one component of ground acceleration, and what is computed of it or of a pair."""

from rocking.signal.accelerogram import Accelerogram as Accelerogram
from rocking.signal.accelerogram import Source as Source
from rocking.signal.processing import displacement as displacement
from rocking.signal.rotation import RotD as RotD
from rocking.signal.rotation import aligned as aligned
from rocking.signal.rotation import rotd as rotd
