"""Read each record, extract its pulse, predict and integrate every structure, and compare."""

# A rule for each job, where wildcards cannot stand: which records a job takes, and so its files, is planned.
for JOB, RECORDS in PLAN.jobs.items():

    rule:
        name:
            f"assess_{JOB}"
        input:
            compiled=COMPILED,
        output:
            tables_of(JOB),
        log:
            f"{SUMMARY}/logs/assess_{JOB}.log",
        benchmark:
            f"{SUMMARY}/benchmarks/assess_{JOB}.tsv"
        params:
            records=RECORDS,
            records_sha256=PLAN.records_sha256(JOB),
            files_sha256=PLAN.files_sha256(JOB),
            structures_sha256=PLAN.structures_sha256,
            settings_sha256=PLAN.settings_sha256,
        message:
            f"Assess {len(RECORDS)} records (job {JOB})"
        script:
            "../scripts/assess.py"
