"""Catalogue: the files of a study listed, joined to stations, and opened as what one earthquake left at each."""

from rocking.catalogue.catalogue import CatalogueRecord as CatalogueRecord
from rocking.catalogue.catalogue import load_catalogue as load_catalogue
from rocking.catalogue.station import Station as Station
from rocking.catalogue.station import open_station as open_station
