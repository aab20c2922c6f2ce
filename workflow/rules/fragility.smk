"""The fragility of every structure under all records of the study."""

# Named here, because to import what holds them takes a quarter of a second at each start.
FRAGILITY_TABLES = ["ida", "fragility", "fragility_summary", "intensity_measures"]


rule fragility:
    input:
        unless_sealed("fragility"),
    output:
        [f"{RESULTS}/fragility/{table}.csv" for table in FRAGILITY_TABLES],
        description=f"{RESULTS}/fragility/datapackage.json",
        pdf=f"{RESULTS}/fragility/fragility.pdf",
        svg=f"{RESULTS}/fragility/fragility.svg",
        figures=f"{RESULTS}/fragility/fragility_figures.zip" if DRAWS else [],
        rows=str(kept_of(Path(RESULTS), "fragility")),
        seal=seal_of("fragility"),
    log:
        f"{SUMMARY}/logs/fragility.log",
    params:
        product="fragility",
        key=key_of("fragility"),
    message:
        "Scale the records until the structures overturn"
    script:
        "../scripts/fragility.py"
