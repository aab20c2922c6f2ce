"""Gather the tables of all jobs: snakemake.* onto rocking.study.summary."""

from pathlib import Path

from rocking.study.inputs import planned_structures
from rocking.study.parts import part, remove_other_parts
from rocking.study.plan import planned_records
from rocking.study.summary import write_description, write_provenance, write_summary

if __name__ == "__main__":
    params = snakemake.params
    results = Path(params.settings["results"])
    records = planned_records(Path(params.settings["catalogue"]), None, params.records_sha256)
    structures = planned_structures(Path(params.settings["structures"]), params.structures_sha256)
    parts = [part(results, job) for job in params.jobs]
    write_summary(parts, [record.id for record in records], structures, results / "summary")
    write_description(params.jobs, results)
    hashes = {"settings": params.settings_sha256, "package": params.package_sha256}
    read = {record.id: record.sha256 for record in records}
    write_provenance(params.settings, read, hashes, results / "summary")
    remove_other_parts(results, params.jobs)
