"""Records: accelerograms, the files they are read from, their processing, and the catalogue that lists them."""

from rocking.records.accelerogram import Accelerogram, Source
from rocking.records.catalogue import catalogue_from_folder, load_catalogue, open_record, vertical_of
from rocking.records.catalogue_record import CatalogueRecord
from rocking.records.processing import Processing, displacement, process, variants, velocity
from rocking.records.read import read
from rocking.records.rotation import RotD, rotate, rotd

__all__ = [
    "Accelerogram",
    "CatalogueRecord",
    "Processing",
    "RotD",
    "Source",
    "catalogue_from_folder",
    "displacement",
    "load_catalogue",
    "open_record",
    "process",
    "read",
    "rotate",
    "rotd",
    "variants",
    "velocity",
    "vertical_of",
]
