"""Find how far the cheap methods may be trusted: limits chosen on half of the real records, held against the other."""


rule calibrate_fidelity:
    input:
        catalogue=SETTINGS.calibration_catalogue,
        structures=SETTINGS.structures,
    output:
        [f"{RESULTS}/calibration/{table}.csv" for table in ("fidelity", "fidelity_held_out")],
    log:
        f"{SUMMARY}/logs/calibrate_fidelity.log",
    benchmark:
        f"{SUMMARY}/benchmarks/calibrate_fidelity.tsv"
    params:
        mirror=SETTINGS.mirror,
        package_sha256=PLAN.package_sha256,
    message:
        "Try every method on the real records"
    script:
        "../scripts/fidelity.py"
