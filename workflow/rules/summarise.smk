"""Gather the tables of all jobs, report on all records, and describe where the numbers came from."""

DOCUMENTS = {
    "summary.pdf": ("summary", "report on all records"),
    "prediction_against_integration.svg": ("scatter", "prediction against integration"),
    "study.html": ("explore", "page to explore the study"),
}

SUMMARIES = [
    in_report(table.file_name, "table", "Tables", table=table.file_name, content=table.description)
    for table in (each.table for each in SUMMARY_TABLES)
]
SUMMARIES += [
    in_report(name, caption, "Study", document=label)
    for name, (caption, label) in (DOCUMENTS.items() if SETTINGS.reports else ())
]
SUMMARIES += [f"{SUMMARY}/{name}" for name in ("provenance.json", "datapackage.json", SEAL)]
SUMMARIES += [f"{RESULTS}/datapackage.json", *([f"{SUMMARY}/study.xlsx"] if SETTINGS.reports else [])]
OF_SUMMARY = {
    "jobs": list(PLAN.jobs),
    "made_from": PLAN.summary_made_from,
    # Where the target fragility is run by hand, its curves come into the report with the next run.
    "fragility_sha256": (
        "" if SETTINGS.fragility.in_every_run else PLAN.hashes.of(Path(RESULTS, "fragility", SEAL))
    ),
}
# A lone job has in memory what a process of its own would take two seconds to import.
ALONE = len(PLAN.jobs) == 1 and not (SETTINGS.trade.in_summary or SETTINGS.fragility.in_every_run)

if not ALONE:

    rule summarise:
        input:
            parts=[path for job in PLAN.jobs for path in part_of(job)],
            trade=[f"{SUMMARY}/trade.csv", f"{SUMMARY}/{TRADE_SEAL}"] if SETTINGS.trade.in_summary else [],
            fragility=FRAGILITY if SETTINGS.fragility.in_every_run else [],
        output:
            SUMMARIES,
        log:
            f"{SUMMARY}/logs/summarise.log",
        benchmark:
            f"{SUMMARY}/benchmarks/summarise.tsv"
        params:
            **PLAN.params(),
            **OF_SUMMARY,
        message:
            "Summarise all records"
        script:
            "../scripts/summarise.py"
