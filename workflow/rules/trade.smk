"""Measure what accuracy costs, on records and structures of this study, and say which method to buy."""


rule trade:
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
        settings_sha256=PLAN.settings_sha256,
        records_sha256=[PLAN.records_sha256(job) for job in PLAN.jobs],
        files_sha256=PLAN.files_sha256(*PLAN.jobs),
        structures_sha256=PLAN.structures_sha256,
        package_sha256=PACKAGE,
    message:
        "Measure the error and the time of every method"
    script:
        "../scripts/trade.py"
