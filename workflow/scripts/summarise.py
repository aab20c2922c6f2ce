"""Gather the tables of all records: snakemake.* onto rocking.study.summary."""

from pathlib import Path

from rocking.study.inputs import planned_structures
from rocking.study.summary import write_description, write_provenance, write_summary

if __name__ == "__main__":
    params = snakemake.params
    results = Path(params.settings["results"])
    folders = [results / record for record in params.records]
    structures = planned_structures(Path(params.settings["structures"]), params.structures_sha256)
    write_summary(folders, structures, results / "summary")
    write_description(folders, results / "summary")
    hashes = {"settings": params.settings_sha256, "package": params.package_sha256}
    write_provenance(params.settings, params.records, hashes, results / "summary")
