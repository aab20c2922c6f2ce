"""Records: accelerograms, the files that they are read from, and their processing."""

from rocking.records.accelerogram import Accelerogram as Accelerogram
from rocking.records.accelerogram import Source as Source
from rocking.records.direction import RotD as RotD
from rocking.records.direction import aligned as aligned
from rocking.records.direction import rotd as rotd
from rocking.records.processing import displacement as displacement
from rocking.records.read import read as read
