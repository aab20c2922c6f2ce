"""Read each record, assess every structure under it, and report on it: each of these once, in one job."""

# A rule for each job, where wildcards cannot stand: which records a job takes, and so its files, is planned.
for JOB, RECORDS in PLAN.jobs.items():

    rule:
        name:
            f"assess_{JOB}"
        output:
            part=part_of(JOB),
            own=[
                report(
                    path,
                    caption="../report/record.rst",
                    category="Records",
                    labels={"record": Path(path).parent.name, "document": Path(path).stem},
                )
                for path in own_of(JOB)
            ],
            summary=SUMMARIES if ALONE else [],
        log:
            f"{SUMMARY}/logs/assess_{JOB}.log",
        benchmark:
            f"{SUMMARY}/benchmarks/assess_{JOB}.tsv"
        params:
            **PLAN.params(JOB),
            made_from=PLAN.made_from(JOB),
            files=[os.fsencode(path).hex() for path, sha256 in PLAN.files(RECORDS).items() if sha256],
            summary=ALONE and OF_SUMMARY,
        message:
            f"Assess {len(RECORDS)} records (job {JOB})"
        script:
            "../scripts/assess.py"
