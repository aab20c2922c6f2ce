"""Measure how far one pulse may be trusted: thresholds of the lights and the reliability table, from real records."""


rule calibrate:
    input:
        catalogue=SETTINGS.calibration_catalogue,
        structures=SETTINGS.structures,
    output:
        [f"{RESULTS}/calibration/{table}.csv" for table in ("comparisons", "thresholds", "reliability")],
    log:
        f"{SUMMARY}/logs/calibrate.log",
    benchmark:
        f"{SUMMARY}/benchmarks/calibrate.tsv"
    params:
        mirror=SETTINGS.mirror,
        package_sha256=PLAN.package_sha256,
    message:
        "Compare predictions with integrations of the real records"
    script:
        "../scripts/calibrate.py"
