"""Every structure checked at the design level of the study by the code, with a page of each to sign."""


rule checks:
    input:
        unless_sealed("checks"),
        records=OF_RECORDS,
    output:
        table=f"{SUMMARY}/code_checks.csv",
        description=f"{SUMMARY}/code_checks.json",
        pdf=f"{SUMMARY}/structures.pdf",
        figures=f"{SUMMARY}/structures_figures.zip" if DRAWS else [],
        rows=str(kept_of(Path(RESULTS), "checks")),
        seal=seal_of("checks"),
    log:
        f"{SUMMARY}/logs/checks.log",
    params:
        product="checks",
        key=key_of("checks"),
    message:
        "Check the structures at the design level"
    script:
        "../scripts/checks.py"
