"""Hold the probabilities of the ensembles against thousands of random draws, on real records."""


rule calibrate_ensemble:
    output:
        [f"{RESULTS}/calibration/{table}.csv" for table in ("ensemble_trials", "ensemble_accuracy")],
        f"{RESULTS}/calibration/ensemble_reliability.svg",
    log:
        f"{SUMMARY}/logs/calibrate_ensemble.log",
    benchmark:
        f"{SUMMARY}/benchmarks/calibrate_ensemble.tsv"
    params:
        catalogues=[SETTINGS.calibration_catalogue, f"{workflow.basedir}/records/fema_p695.csv"],
        structures=SETTINGS.structures,
        structures_sha256=PLAN.structures_sha256,
        mirror=SETTINGS.mirror,
        package_sha256=PLAN.package_sha256,
    message:
        "Draw thousands of members for each real record"
    script:
        "../scripts/calibrate_ensemble.py"
