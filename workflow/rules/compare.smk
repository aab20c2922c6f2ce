"""Work against precision: this package beside scipy, OpenSees' RockingBC and LMGC90."""


rule compare:
    input:
        catalogue=SETTINGS.calibration_catalogue,
    output:
        table=f"{RESULTS}/comparison/codes.csv",
        description=f"{RESULTS}/comparison/datapackage.json",
        pdf=f"{RESULTS}/comparison/comparison.pdf",
    log:
        f"{SUMMARY}/logs/compare.log",
    benchmark:
        f"{SUMMARY}/benchmarks/compare.tsv"
    params:
        mirror=SETTINGS.mirror,
        share=SETTINGS.comparison_share,
        package_sha256=PACKAGE,
    message:
        "Run the same cases through every code"
    script:
        "../scripts/compare.py"
