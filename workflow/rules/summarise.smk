"""Gather the tables of all jobs and describe where they came from."""


rule summarise:
    input:
        tables=tables_of(*PLAN.jobs),
    output:
        [
            report(
                f"{SUMMARY}/{table.file_name}",
                caption="../report/table.rst",
                category="Tables",
                labels={"table": table.file_name, "content": table.description},
            )
            for table in (each.table for each in SUMMARY_TABLES)
        ],
        f"{SUMMARY}/provenance.json",
        f"{SUMMARY}/datapackage.json",
        f"{RESULTS}/datapackage.json",
    log:
        f"{SUMMARY}/logs/summarise.log",
    benchmark:
        f"{SUMMARY}/benchmarks/summarise.tsv"
    params:
        jobs=list(PLAN.jobs),
        records_sha256=PLAN.records_sha256(),
        settings=SETTINGS.mapping(),
        settings_sha256=PLAN.settings_sha256,
        structures_sha256=PLAN.structures_sha256,
        package_sha256=PLAN.package_sha256,
    message:
        "Summarise all records"
    script:
        "../scripts/summarise.py"
