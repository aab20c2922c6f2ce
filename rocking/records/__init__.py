"""Records: accelerograms, the files they are read from, and the catalogue that lists them."""

from rocking.records.accelerogram import Accelerogram, Source
from rocking.records.catalogue import load_catalogue, open_record, vertical_of
from rocking.records.catalogue_record import CatalogueRecord
from rocking.records.read import read

__all__ = [
    "Accelerogram",
    "CatalogueRecord",
    "Source",
    "load_catalogue",
    "open_record",
    "read",
    "vertical_of",
]
