"""One record: read it with obspy, extract its pulses, predict each structure, integrate it, and compare the two."""


rule record:
    input:
        unless_sealed("records/{record}"),
    output:
        [f"{RESULTS}/{{record}}/{each.table.file_name}" for each in RECORD_TABLES],
        [f"{RESULTS}/{{record}}/histories.csv"] if SETTINGS.histories else [],
        report=(
            report(
                f"{RESULTS}/{{record}}/report.pdf",
                caption="../report/record.rst",
                category="Records",
                labels={"record": "{record}", "document": "report"},
            )
            if SETTINGS.reports
            else []
        ),
        figures=f"{RESULTS}/{{record}}/report_figures.zip" if SETTINGS.reports and DRAWS else [],
        outcome=str(outcome_of(Path(RESULTS), "{record}")),
        seal=seal_of("records/{record}"),
    log:
        f"{SUMMARY}/logs/records/{{record}}.log",
    params:
        product=product_of("records/{record}"),
        key=key_of("records/{record}"),
    message:
        "Record {wildcards.record}"
    script:
        "../scripts/record.py"
