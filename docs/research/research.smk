"""What was measured once for this package: tiers, ensembles, a shake table, other codes. Run each by its name."""

RESEARCH = Path(workflow.basedir, "docs", "research")
REAL_RECORDS = [f"{workflow.basedir}/records/{name}.csv" for name in ("near_fault", "fema_p695")]
# Each target: what it says it does, the catalogues that it reads, and the folder and the files that it writes.
TARGETS_OF_RESEARCH = {
    "calibrate": (
        "Calibrate the tiers on real records",
        REAL_RECORDS,
        "calibration",
        [
            f"tier{name}.csv"
            for name in ("s", "_covariances", "_bands", "_scores", "_reliability", "_answers")
        ],
    ),
    "calibrate_ensemble": (
        "Draw thousands of members for each real record",
        REAL_RECORDS,
        "calibration",
        ["ensemble_trials.csv", "ensemble_accuracy.csv", "ensemble_reliability.svg"],
    ),
    "trade_fragility": (
        "Measure the error and the time of every method in a fragility",
        REAL_RECORDS[1:],
        "calibration",
        ["trade_fragility.csv", "trade_fragility.json"],
    ),
    "govern": (
        "Try the governing crack on stacks of courses",
        REAL_RECORDS,
        "cracks",
        ["cracks.csv", "scores.csv", "cracks.json"],
    ),
    "validate": (
        "Predict the overturning of two specimens on a shake table",
        [f"{workflow.basedir}/records/shake_table.csv"],
        "validation",
        ["scores.csv", "predictions.csv", "datapackage.json", "validation.pdf"],
    ),
    "compare": (
        "Run the same cases through every code",
        REAL_RECORDS[:1],
        "comparison",
        ["codes.csv", "datapackage.json", "comparison.pdf"],
    ),
}

for TARGET, (TELLS, CATALOGUES, FOLDER, FILES) in TARGETS_OF_RESEARCH.items():

    rule:
        name:
            TARGET
        input:
            catalogues=CATALOGUES,
            source=sorted(str(path) for path in RESEARCH.rglob("*") if path.suffix in (".py", ".typ")),
        output:
            [f"{RESULTS}/{FOLDER}/{file}" for file in FILES],
        log:
            f"{SUMMARY}/logs/{TARGET}.log",
        benchmark:
            f"{SUMMARY}/benchmarks/{TARGET}.tsv"
        params:
            mirror=SETTINGS.mirror,
            structures=SETTINGS.structures,
            package_sha256=PACKAGE,
        message:
            TELLS
        script:
            "run.py"
