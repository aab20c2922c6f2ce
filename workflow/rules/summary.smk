"""All records: their tables, the report on them, the page to explore and the workbook."""

DOCUMENTS = {
    "summary.pdf": ("summary", "report on all records"),
    "prediction_against_integration.svg": ("scatter", "prediction against integration"),
    "study.html": ("explore", "page to explore the study"),
}


rule summary:
    input:
        unless_sealed("summary"),
        records=OF_RECORDS,
        checks=seal_of("checks") if CHECKS else [],
        fragility=seal_of("fragility") if SETTINGS.fragility.in_every_run else [],
        trade=seal_of("trade") if SETTINGS.trade.in_summary else [],
    output:
        [
            in_report(
                each.table.file_name,
                "table",
                "Tables",
                table=each.table.file_name,
                content=each.table.description,
            )
            for each in SUMMARY_TABLES
        ],
        [
            in_report(name, caption, "Study", document=label)
            for name, (caption, label) in (DOCUMENTS.items() if SETTINGS.reports else ())
        ],
        [f"{SUMMARY}/study.xlsx"] if SETTINGS.reports else [],
        [f"{SUMMARY}/summary_figures.zip"] if SETTINGS.reports and DRAWS else [],
        f"{SUMMARY}/provenance.json",
        f"{SUMMARY}/datapackage.json",
        seal=seal_of("summary"),
    log:
        f"{SUMMARY}/logs/summary.log",
    params:
        product="summary",
        key=key_of("summary"),
    message:
        "Summary of all records"
    script:
        "../scripts/summary.py"
