"""Redraw the figures of the source paper with their data, and decide its equations by numbers."""


rule paper:
    input:
        catalogue=config["calibration_catalogue"],
    output:
        directory(f"{RESULTS}/paper"),
    log:
        f"{SUMMARY}/logs/paper.log",
    benchmark:
        f"{SUMMARY}/benchmarks/paper.tsv"
    params:
        package_sha256=PACKAGE,
    message:
        "Redraw the figures of the paper"
    script:
        "../scripts/paper.py"
