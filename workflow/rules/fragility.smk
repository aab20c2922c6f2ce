"""Measure the fragility of every structure under all records of the study."""

# Named here, because to import what holds them takes a quarter of a second at each start.
FRAGILITY_TABLES = ["ida", "fragility", "fragility_summary", "intensity_measures"]


rule fragility:
    output:
        [f"{RESULTS}/fragility/{table}.csv" for table in FRAGILITY_TABLES],
        description=f"{RESULTS}/fragility/datapackage.json",
        pdf=f"{RESULTS}/fragility/fragility.pdf",
        svg=f"{RESULTS}/fragility/fragility.svg",
        seal=f"{RESULTS}/fragility/{SEAL}",
    log:
        f"{SUMMARY}/logs/fragility.log",
    benchmark:
        f"{SUMMARY}/benchmarks/fragility.tsv"
    params:
        **PLAN.params(),
        made_from=PLAN.fragility_made_from,
    message:
        "Scale the records until the structures overturn"
    script:
        "../scripts/fragility.py"
