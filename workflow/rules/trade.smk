"""Measure what accuracy costs, on records and structures of this study: error against time of every method."""


rule trade:
    input:
        catalogue=SETTINGS.catalogue,
        structures=SETTINGS.structures,
        files=[file for job in PLAN.jobs for file in PLAN.local_files(job)],
    output:
        table=f"{SUMMARY}/trade.csv",
        description=f"{SUMMARY}/trade.json",
        pdf=f"{SUMMARY}/trade.pdf",
        svg=f"{SUMMARY}/trade.svg",
    log:
        f"{SUMMARY}/logs/trade.log",
    benchmark:
        f"{SUMMARY}/benchmarks/trade.tsv"
    params:
        settings=SETTINGS.mapping()["trade"],
        package_sha256=PACKAGE,
    message:
        "Measure the error and the time of every method"
    script:
        "../scripts/trade.py"
