"""Write the page to explore the study: one HTML file that needs no network."""


rule explore:
    input:
        tables=tables_of(*PLAN.jobs),
        fragility=FRAGILITY if SETTINGS.fragility.in_every_run else [],
    output:
        page=report(
            f"{SUMMARY}/study.html",
            caption="../report/explore.rst",
            category="Study",
            labels={"document": "page to explore the study"},
        ),
    log:
        f"{SUMMARY}/logs/explore.log",
    benchmark:
        f"{SUMMARY}/benchmarks/explore.tsv"
    params:
        jobs=list(PLAN.jobs),
        records_sha256=PLAN.records_sha256(),
        files_sha256=PLAN.files_sha256(*PLAN.jobs),
        structures_sha256=PLAN.structures_sha256,
        settings_sha256=PLAN.settings_sha256,
        # Where the target fragility is run by hand, its curves come onto the page with the next run.
        fragility_sha256="" if SETTINGS.fragility.in_every_run else PLAN.hashes.of(Path(FRAGILITY)),
        package_sha256=PACKAGE,
    message:
        "Write the page to explore the study"
    script:
        "../scripts/explore.py"
