"""Fit what cheap figures say of overturning to the mechanism under real records, and judge it by leaving sites out."""


rule calibrate:
    output:
        [
            f"{RESULTS}/calibration/{table}.csv"
            for table in (
                "tiers",
                "tier_covariances",
                "tier_bands",
                "tier_scores",
                "tier_reliability",
                "tier_answers",
            )
        ],
    log:
        f"{SUMMARY}/logs/calibrate.log",
    benchmark:
        f"{SUMMARY}/benchmarks/calibrate.tsv"
    params:
        catalogues=[SETTINGS.calibration_catalogue, f"{workflow.basedir}/records/fema_p695.csv"],
        mirror=SETTINGS.mirror,
        package_sha256=PLAN.package_sha256,
    message:
        "Calibrate the tiers on real records"
    script:
        "../scripts/calibrate.py"
