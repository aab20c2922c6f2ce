"""Write the rotation histories of each record, where the settings ask for them."""

if SETTINGS.histories:
    # A rule for each job, where wildcards cannot stand: which records a job takes, and so its files, is planned.
    for JOB, RECORDS in PLAN.jobs.items():

        rule:
            name:
                f"histories_{JOB}"
            input:
                compiled=COMPILED,
            output:
                [f"{RESULTS}/{record}/histories.csv" for record in RECORDS],
            log:
                f"{SUMMARY}/logs/histories_{JOB}.log",
            benchmark:
                f"{SUMMARY}/benchmarks/histories_{JOB}.tsv"
            params:
                records=RECORDS,
                records_sha256=PLAN.records_sha256(JOB),
                files_sha256=PLAN.files_sha256(JOB),
                structures_sha256=PLAN.structures_sha256,
                settings_sha256=PLAN.settings_sha256,
                package_sha256=PACKAGE,
            message:
                f"Write the histories of {len(RECORDS)} records (job {JOB})"
            script:
                "../scripts/histories.py"
