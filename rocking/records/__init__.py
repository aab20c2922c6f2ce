"""Records: the files that accelerograms are read from."""

from rocking.records.read import read as read
from rocking.signal.accelerogram import Accelerogram as Accelerogram
from rocking.signal.accelerogram import Source as Source
