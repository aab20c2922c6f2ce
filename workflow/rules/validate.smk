"""Hold predictions against shake-table tests that took no part in the fit."""


rule validate:
    input:
        catalogue=f"{workflow.basedir}/records/shake_table.csv",
    output:
        tables=[
            f"{RESULTS}/validation/{table}.csv"
            for table in (
                "scores",
                "reliability",
                "confusion",
                "failures",
                "identified",
                "members",
                "timing",
                "predictions",
            )
        ],
        description=f"{RESULTS}/validation/datapackage.json",
        pdf=f"{RESULTS}/validation/validation.pdf",
    log:
        f"{SUMMARY}/logs/validate.log",
    benchmark:
        f"{SUMMARY}/benchmarks/validate.tsv"
    params:
        mirror=SETTINGS.mirror,
        package_sha256=PACKAGE,
    message:
        "Predict the overturning of two specimens on a shake table"
    script:
        "../scripts/validate.py"
