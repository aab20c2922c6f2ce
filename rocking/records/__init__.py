"""Records: accelerograms, the files they are read from, their processing, and the catalogue that lists them."""

from rocking.records.accelerogram import Accelerogram as Accelerogram
from rocking.records.accelerogram import Source as Source
from rocking.records.catalogue import CatalogueRecord as CatalogueRecord
from rocking.records.catalogue import load_catalogue as load_catalogue
from rocking.records.direction import RotD as RotD
from rocking.records.direction import aligned as aligned
from rocking.records.direction import rotd as rotd
from rocking.records.processing import displacement as displacement
from rocking.records.read import read as read
from rocking.records.station import Station as Station
from rocking.records.station import open_record as open_record
from rocking.records.station import open_station as open_station
