"""Check every structure at the design level of the study by the code, and set a page of each to sign."""


rule checks:
    input:
        f"{SUMMARY}/verdicts.csv",
        f"{SUMMARY}/record.csv",
    output:
        table=f"{SUMMARY}/code_checks.csv",
        description=f"{SUMMARY}/code_checks.json",
        pdf=f"{SUMMARY}/structures.pdf",
    log:
        f"{SUMMARY}/logs/checks.log",
    benchmark:
        f"{SUMMARY}/benchmarks/checks.tsv"
    params:
        **PLAN.params(),
        design=SETTINGS.mapping()["design_spectrum"],
        points=PLAN.hashes.of(Path(SETTINGS.design_spectrum.points or "")),
        pool=PLAN.hashes.of(Path(SETTINGS.design_spectrum.pool or SETTINGS.catalogue)),
    message:
        "Check the structures at the design level"
    script:
        "../scripts/checks.py"
