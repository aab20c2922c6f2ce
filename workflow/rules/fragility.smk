"""Measure the fragility of every structure under all records of the study."""

from rocking.assessment.rows.of_fragility import FRAGILITY_TABLES


rule fragility:
    output:
        [f"{RESULTS}/fragility/{table}.csv" for table in FRAGILITY_TABLES],
        description=f"{RESULTS}/fragility/datapackage.json",
        pdf=f"{RESULTS}/fragility/fragility.pdf",
        svg=f"{RESULTS}/fragility/fragility.svg",
    log:
        f"{SUMMARY}/logs/fragility.log",
    benchmark:
        f"{SUMMARY}/benchmarks/fragility.tsv"
    params:
        settings_sha256=PLAN.settings_sha256,
        fragility=SETTINGS.mapping()["fragility"],
        records_sha256=[PLAN.records_sha256(job) for job in PLAN.jobs],
        files_sha256=PLAN.files_sha256(*PLAN.jobs),
        structures_sha256=PLAN.structures_sha256,
        package_sha256=PACKAGE,
    message:
        "Scale the records until the structures overturn"
    script:
        "../scripts/fragility.py"
