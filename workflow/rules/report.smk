"""Set the PDF of each record, and the one of the whole study."""

# A rule for each job, where wildcards cannot stand: which records a job takes, and so its files, is planned.
for JOB, RECORDS in PLAN.jobs.items():

    rule:
        name:
            f"report_{JOB}"
        input:
            tables=tables_of(JOB),
        output:
            [
                report(
                    f"{RESULTS}/{record}/report.pdf",
                    caption="../report/record.rst",
                    category="Records",
                    labels={"record": record, "document": "report"},
                )
                for record in RECORDS
            ],
        log:
            f"{SUMMARY}/logs/report_{JOB}.log",
        benchmark:
            f"{SUMMARY}/benchmarks/report_{JOB}.tsv"
        params:
            records=RECORDS,
            records_sha256=PLAN.records_sha256(JOB),
            files_sha256=PLAN.files_sha256(JOB),
            structures_sha256=PLAN.structures_sha256,
            settings_sha256=PLAN.settings_sha256,
            package_sha256=PACKAGE,
        message:
            f"Report {len(RECORDS)} records (job {JOB})"
        script:
            "../scripts/report.py"


rule report_summary:
    input:
        tables=[f"{SUMMARY}/{table}.csv" for table in SUMMARIES],
        trade=f"{SUMMARY}/trade.csv" if SETTINGS.trade.in_summary else [],
        fragility=FRAGILITY if SETTINGS.fragility.in_every_run else [],
    output:
        document=report(
            f"{SUMMARY}/summary.pdf",
            caption="../report/summary.rst",
            category="Study",
            labels={"document": "report on all records"},
        ),
        figure=report(
            f"{SUMMARY}/prediction_against_integration.svg",
            caption="../report/scatter.rst",
            category="Study",
            labels={"document": "prediction against integration"},
        ),
    log:
        f"{SUMMARY}/logs/report_summary.log",
    benchmark:
        f"{SUMMARY}/benchmarks/report_summary.tsv"
    params:
        settings=SETTINGS.mapping(),
        # Where the target fragility is run by hand, its curves come into the report with the next run.
        fragility_sha256="" if SETTINGS.fragility.in_every_run else PLAN.hashes.of(Path(FRAGILITY)),
        package_sha256=PACKAGE,
    message:
        "Report on all records"
    script:
        "../scripts/report_summary.py"
