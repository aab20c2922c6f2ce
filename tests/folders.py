"""A folder of files as its catalogue lists them."""

from rocking.catalogue.folder import catalogue_of_folder


def list_folder(folder, *, unit=None, time_step=None):
    """Return every file under `folder` as it can be read, and the rows of a new catalogue for them."""
    catalogue = catalogue_of_folder(folder, declared={"unit": unit, "time_step": time_step})
    return catalogue.files, catalogue.new
